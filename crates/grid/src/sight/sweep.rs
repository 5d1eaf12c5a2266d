//! Everything that a vertex sees.

use crate::{BitRow, Corners, FreeSpace, Vertex};

use super::{
    interval::{IntervalEnd, Ray},
    piece::{Edge, Piece, widens},
    place::Place,
    row_summary::RowSummary,
    runs::row_ahead,
    targets::{Quadrants, Targets},
    visitor::{BoundsOf, RunsOf, TargetsOf, Visitor},
};

/// Finds the corners of obstacles that a vertex sees. It holds the scratch memory of [`seen`](Self::seen).
///
/// The sweep goes over the map row by row, up and down from the vertex. The part of a horizontal line that
/// the vertex sees is a set of intervals. Each is bounded by two rays through corners of obstacles, whose
/// crossings with the next line are found by additions, and yet exactly (`interval.rs` says why). Words of 64
/// cells tell where the intervals narrow, split or end. So a vertex costs a few steps for each row that it
/// sees, not one for each cell.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Corners, DiagonalGap, FreeSpace, Vertex};
/// use mediant_grid::sight::{Quadrants, RowSummary, VisibilitySweep};
///
/// let map = AsciiMap::parse("
///     ....
///     .#..
///     ....
/// ")?;
/// let space = FreeSpace::<Corners>::new(Arc::new(map.grid), DiagonalGap::Open);
/// // Look for the corners of the obstacle.
/// let corners = space.vertex_set(|at| (1..=2).contains(&at.x) && (1..=2).contains(&at.y));
///
/// let (summary, mut seen) = (RowSummary::new(space.grid()), Vec::new());
/// let from = Vertex::new(0, 0);
/// VisibilitySweep::default().seen(&space, &summary, &corners, from, Quadrants::ALL, |at| seen.push(at));
/// seen.sort();
/// // The obstacle hides its corner (2, 2).
/// assert_eq!(seen, [(1, 1), (1, 2), (2, 1)].map(Vertex::from));
/// # Ok::<(), mediant_grid::GridError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct VisibilitySweep {
    pending: Vec<Piece>,
}

/// A sweep over one half of the map: above or below the vertex.
struct Half<'t> {
    space: &'t FreeSpace<Corners>,
    summary: &'t RowSummary,
    from: Place,
    /// 1 for the half below, −1 for the one above.
    down: i32,
}

impl VisibilitySweep {
    /// Calls `found` once with each target that the vertex `from` sees in these quadrants. A vertex that is
    /// not free sees nothing.
    ///
    /// Targets should be convex corners of obstacles. Others may be missed, and so may a target behind
    /// another corner on the same ray. No target may be at a [closed gap](FreeSpace::is_closed_gap). Where
    /// only one of the two quadrants beside a vertical is given, sight along this vertical depends on the
    /// cells of this quadrant alone.
    ///
    /// `summary` must be that of the same map, and the sets of the targets must be of this free space; else
    /// the result has no meaning.
    pub fn seen<'m>(
        &mut self,
        space: &'m FreeSpace<Corners>,
        summary: &'m RowSummary,
        marks: impl Into<Targets<'m>>,
        from: impl Into<Place>,
        quadrants: Quadrants,
        mut found: impl FnMut(Vertex),
    ) {
        let (from, marks) = (from.into(), marks.into());
        if !from.is_free(space.grid().rows()) {
            return;
        }
        self.sweep(space, summary, from, quadrants, &mut TargetsOf { marks, from, found: &mut found });
        for right in [1, -1] {
            if let Some(near) = on_line(from, right).filter(|_| quadrants.contains_horizontal(right)) {
                let (x, is_mark) = along_line(space, marks, near, right);
                // The vertices between both.
                let (low, high) = if right > 0 { (near.x + 1, x - 1) } else { (x + 1, near.x - 1) };
                let passes_gap = || space.grid().rows().any_gap(near.y, low, high);
                if is_mark && !(space.has_closed_gaps() && passes_gap()) {
                    found(Vertex::new(x, near.y));
                }
            }
        }
    }

    /// Calls `run` with every run of vertices on one horizontal line that the vertex `from` sees in these
    /// quadrants: the line, and its first and last column. Runs may share vertices. A vertex that is not free
    /// sees nothing.
    ///
    /// Along the horizontal line through `from` a run ends at the nearest of `marks`. A vertex that is seen
    /// only between two obstacles which both touch the line of sight may be missed. Under closed gaps the
    /// last vertex of a run may be a gap that cannot be entered from there. For the rest, see
    /// [`seen`](Self::seen).
    pub fn runs<'m>(
        &mut self,
        space: &'m FreeSpace<Corners>,
        summary: &'m RowSummary,
        marks: impl Into<Targets<'m>>,
        from: Vertex,
        quadrants: Quadrants,
        run: impl FnMut(i32, i32, i32),
    ) {
        self.runs_and_cells(space, summary, marks, from, quadrants, run, |_, _, _| {});
    }

    /// [`runs`](Self::runs), and calls `cells` with runs of cells: the row, the first column, and the one
    /// after the last. All cells are among them of whose inside a part is seen, but none of whose four
    /// vertices is in a run. Others may be, and some more than once.
    #[expect(clippy::too_many_arguments, reason = "those of `runs`, and one more")]
    pub fn runs_and_cells<'m>(
        &mut self,
        space: &'m FreeSpace<Corners>,
        summary: &'m RowSummary,
        marks: impl Into<Targets<'m>>,
        from: Vertex,
        quadrants: Quadrants,
        mut run: impl FnMut(i32, i32, i32),
        mut cells: impl FnMut(i32, i32, i32),
    ) {
        if !space.is_free(from) {
            return;
        }
        let visitor = &mut RunsOf { run: &mut run, cells: &mut cells, interval: None };
        self.sweep(space, summary, Place::of(from), quadrants, visitor);
        let marks = marks.into();
        for right in [1, -1] {
            if quadrants.contains_horizontal(right) {
                let (mut end, _) = along_line(space, marks, from, right);
                if space.has_closed_gaps() {
                    let is_gap = |x| space.is_closed_gap(Vertex::new(x, from.y));
                    let mut x = from.x;
                    while x != end {
                        x += right;
                        if is_gap(x) {
                            end = x;
                        }
                    }
                }
                if end != from.x {
                    run(from.y, end.min(from.x + right), end.max(from.x + right));
                }
            }
        }
    }

    /// The corners of a box of vertices such that [`seen`](Self::seen), asked with the same arguments, finds
    /// the same in the same order on every map that has the same cells around each vertex of the box, and the
    /// same targets there.
    #[must_use]
    pub fn bounds<'m>(
        &mut self,
        space: &'m FreeSpace<Corners>,
        summary: &'m RowSummary,
        marks: impl Into<Targets<'m>>,
        from: Vertex,
        quadrants: Quadrants,
    ) -> [Vertex; 2] {
        let mut bounds = BoundsOf { low: from, high: from };
        if space.is_free(from) {
            self.sweep(space, summary, Place::of(from), quadrants, &mut bounds);
            let marks = marks.into();
            for right in [1, -1] {
                if quadrants.contains_horizontal(right) {
                    let (x, _) = along_line(space, marks, from, right);
                    bounds.add(from.y, x, x);
                }
            }
        }
        [bounds.low, bounds.high]
    }

    /// Follows all intervals above and below a place.
    fn sweep<'m>(
        &mut self,
        space: &'m FreeSpace<Corners>,
        summary: &'m RowSummary,
        from: Place,
        quadrants: Quadrants,
        visitor: &mut impl Visitor<'m>,
    ) {
        for down in [1, -1] {
            let (left, right) = (quadrants.contains(-1, down), quadrants.contains(1, down));
            if left || right {
                let half = Half { space, summary, from, down };
                self.pending.clear();
                self.pending.extend(half.first(left, right));
                while let Some(piece) = self.pending.pop() {
                    half.follow(piece, &mut self.pending, visitor);
                }
            }
        }
    }
}

/// The vertex from which a place sees along its line to the right (`right` = 1) or to the left (−1), itself
/// or the nearest one behind it; `None` for a place between two lines.
fn on_line(from: Place, right: i32) -> Option<Vertex> {
    let ((left, after), (y, below)) = (from.columns(), from.lines());
    (y == below).then_some(Vertex::new(if right > 0 { left } else { after }, y))
}

/// How far a vertex sees along the horizontal line to the right (`right` = 1) or to the left (−1), closed
/// gaps aside: the column of the nearest target, or of the last vertex before an edge that is closed, and
/// whether it is a target.
fn along_line(space: &FreeSpace<Corners>, marks: Targets<'_>, from: Vertex, right: i32) -> (i32, bool) {
    let [above, below] = [1, -1].map(|down| row_ahead(space.grid().rows(), from.y, -down));
    let [same, opposite] = [marks.same, marks.opposite].map(|marks| marks.row(from.y));
    let mut x = from.x;
    loop {
        // Bit i of `closed` is the edge from i to i + 1 steps ahead, bit i of `marked` the vertex i + 1 steps
        // ahead.
        let (closed, marked) = if right > 0 {
            (above.word(x) & below.word(x), same.word(x + 1) | opposite.word(x + 1))
        } else {
            let first = (x - 64).max(-64);
            let shift = (first - (x - 64)) as u32;
            let closed = above.word(first) & below.word(first);
            (
                (closed.checked_shl(shift).unwrap_or(0) | ((1_u64 << shift) - 1)).reverse_bits(),
                (same.word(first) | opposite.word(first)).checked_shl(shift).unwrap_or(0).reverse_bits(),
            )
        };
        let (edge, mark) = (closed.trailing_zeros(), marked.trailing_zeros());
        if mark < edge {
            return (x + right * (mark as i32 + 1), true);
        }
        if edge < 64 {
            return (x + right * edge as i32, false);
        }
        x += right * 64;
    }
}

impl<'t> Half<'t> {
    /// The interval of the first line that is seen, to the left, to the right or both.
    fn first(&self, left: bool, right: bool) -> Option<Piece> {
        let line = self.from.line(self.down);
        let (start, end) = self.from.run(self.ahead(line));
        // Only a vertex is looked from into one quadrant alone.
        let (x, _) = self.from.columns();
        let (start, end) = (if left { start } else { x }, if right { end } else { x });
        // Where the quadrant ends and no obstacle is in the way, the interval ends at the vertical through
        // the root.
        let edge = |end| {
            let is_above = Place::parts(end) == self.from.x;
            if is_above { Edge::ray(IntervalEnd::standing(end)) } else { Edge::wall(end) }
        };
        let piece = Piece { line: line + self.down, left: edge(start), right: edge(end) };
        (start < end).then_some(piece)
    }

    /// The row of cells beyond a line.
    fn ahead(&self, line: i32) -> BitRow<'t> {
        row_ahead(self.space.grid().rows(), line, self.down)
    }

    /// Follows an interval from line to line until it ends. Where it splits, all parts but the first are
    /// added to `pending`.
    fn follow<V: Visitor<'t>>(&self, mut piece: Piece, pending: &mut Vec<Piece>, visitor: &mut V) {
        let mut ahead = self.ahead(piece.line);
        let mut line = visitor.line(piece.line);
        loop {
            self.end_walls(&mut piece, ahead);
            if piece.line % RowSummary::LINES == 0
                && let Some(next) = self.leap(piece)
            {
                visitor.band(piece, self.down, line);
                ahead = ahead.below(self.down * RowSummary::LINES);
                line = V::below(line, self.down * RowSummary::LINES);
                piece = next;
                continue;
            }
            let [mut left, mut right] = [piece.left, piece.right].map(|edge| edge.after(1));
            let (first, last) = (piece.left.end.here.floor(), piece.right.end.here.ceil());
            let (low, high) = (first.min(left.end.here.floor()), last.max(right.end.here.ceil()));
            if ahead.first_blocked(first, last) == last {
                visitor.between_free_cells(piece, self.down, line);
                let (start, end) = (ahead.run_start(first, low), ahead.first_blocked(last, high));
                visitor.looks_at(piece.line, start, end);
                if low < start {
                    left = Edge::wall(start);
                }
                if end < high {
                    right = Edge::wall(end);
                }
                if !widens([left, right]) {
                    return;
                }
                piece = Piece { line: piece.line + self.down, left, right };
            } else {
                visitor.interval(piece, self.down, line);
                let mut goes_on = None;
                let mut from = first;
                while from < last {
                    let inside = ahead.first_free(from, last);
                    if inside == last {
                        break;
                    }
                    let start = if inside > first { inside } else { ahead.run_start(inside, low) };
                    let end = ahead.first_blocked(inside, high);
                    visitor.looks_at(piece.line, start, end);
                    if let Some(part) = self.through(piece, start, end) {
                        match goes_on {
                            None => goes_on = Some(part),
                            Some(_) => pending.push(part),
                        }
                    }
                    from = end;
                }
                let Some(part) = goes_on else { return };
                piece = part;
            }
            ahead = ahead.below(self.down);
            line = V::below(line, self.down);
        }
    }

    /// The distance of a line from the root, in parts of a cell.
    #[inline]
    const fn distance(&self, line: i32) -> i32 {
        (Place::parts(line) - self.from.y) * self.down
    }

    /// Turns ends that follow a wall into rays if the wall ends on this line.
    #[inline]
    fn end_walls(&self, piece: &mut Piece, ahead: BitRow<'_>) {
        let n = self.distance(piece.line);
        for (edge, beside) in [(&mut piece.left, -1), (&mut piece.right, 0)] {
            let x = edge.end.here.floor();
            if edge.is_wall && !ahead.is_blocked(x + beside) {
                *edge = Edge::ray(IntervalEnd::corner(x, self.from.x, n));
            }
        }
    }

    /// The interval one band of rows further on, if all cells on the way are free and the walls that it
    /// follows go on. `None` otherwise.
    #[inline]
    fn leap(&self, piece: Piece) -> Option<Piece> {
        let band = piece.line / RowSummary::LINES + (self.down - 1) / 2;
        let (blocked, solid) = (self.summary.blocked.row(band), self.summary.solid.row(band));
        let [left, right] = [piece.left, piece.right].map(|edge| edge.after(RowSummary::LINES));
        let (mut low, mut high) = (
            piece.left.end.here.floor().min(left.end.here.floor()),
            piece.right.end.here.ceil().max(right.end.here.ceil()),
        );
        // Without a wall, the column beside the interval must be free too, so that there is no corner of an
        // obstacle on its rim.
        if !left.is_wall {
            low -= 1;
        } else if !solid.is_blocked(low - 1) {
            return None;
        }
        if !right.is_wall {
            high += 1;
        } else if !solid.is_blocked(high) {
            return None;
        }
        let line = piece.line + self.down * RowSummary::LINES;
        let is_free = widens([left, right]) && blocked.first_blocked(low, high) == high;
        is_free.then_some(Piece { line, left, right })
    }

    /// The part of an interval that continues to the next line through the free cells from column `start` to
    /// `end`.
    fn through(&self, piece: Piece, start: i32, end: i32) -> Option<Piece> {
        let (x, n) = (self.from.x, self.distance(piece.line));
        let [left, right] = [piece.left, piece.right].map(|edge| edge.after(1));
        // An obstacle that stands in the way clips the interval at the corner that hides most. If the
        // obstacle is between the vertical through the root and the interval, this is its corner on this
        // line. Otherwise it is its corner on the next line, up to which the interval follows the obstacle as
        // a wall.
        let next = n + Place::parts(1);
        let shaded = |end: i32| Edge::ray(IntervalEnd::new(Ray::through(end, x, n), x, next));
        let left = if start > piece.left.end.here.floor() {
            if Place::parts(start) > x { shaded(start) } else { Edge::wall(start) }
        } else if left.end.here.floor() < start {
            Edge::wall(start)
        } else {
            left
        };
        let right = if end < piece.right.end.here.ceil() {
            if Place::parts(end) < x { shaded(end) } else { Edge::wall(end) }
        } else if right.end.here.ceil() > end {
            Edge::wall(end)
        } else {
            right
        };
        // An interval that has shrunk to a single ray touches obstacles on both sides, and ends at the
        // vertex.
        let widens = right.as_ray(x, next).is_right_of(left.as_ray(x, next));
        widens.then_some(Piece { line: piece.line + self.down, left, right })
    }
}
