//! All that a vertex sees.

use crate::{BitMatrix, BitRow, Corners, FreeSpace, Vertex};

use super::{
    interval::{IntervalEnd, Ray},
    row_summary::RowSummary,
    runs::row_ahead,
};

/// The directions in which to look: some of the four closed quadrants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quadrants(u8);

impl Quadrants {
    /// Every direction.
    pub const ALL: Self = Self(0b1_1111);
    /// Both ways along the horizontal line alone.
    pub const LINE: Self = Self(0b1_0000);

    /// The quadrant whose vectors have no x of the sign opposite to `x`, and no such y; signs are ±1.
    #[must_use]
    pub const fn only(x: i32, y: i32) -> Self {
        Self(1 << ((x > 0) as u8 + 2 * (y > 0) as u8))
    }

    /// These and others.
    #[must_use]
    pub const fn and(self, others: Self) -> Self {
        Self(self.0 | others.0)
    }

    /// Whether the quadrant of these signs is among them.
    #[must_use]
    pub const fn has(self, x: i32, y: i32) -> bool {
        self.0 & Self::only(x, y).0 != 0
    }
}

/// The vertices to look for: those in directions in which x and y have the same sign, and those in which they
/// have opposite ones. Along an axis, where one of them is 0, both are.
///
/// Each has a bit for each vertex of the map and a frame of zeros.
#[derive(Clone, Copy, Debug)]
pub struct Targets<'m> {
    /// Where x and y have the same sign.
    pub same: &'m BitMatrix,
    /// Where they have opposite signs.
    pub opposite: &'m BitMatrix,
}

/// The same in all directions.
impl<'m> From<&'m BitMatrix> for Targets<'m> {
    fn from(marks: &'m BitMatrix) -> Self {
        Self { same: marks, opposite: marks }
    }
}

/// Finds the corners of obstacles that a vertex sees: scratch memory for [`seen`](Self::seen).
///
/// The cells around a vertex are looked at row by row. What it sees of a horizontal line is a set of
/// intervals, each bounded by two rays through corners of obstacles, which are followed by additions
/// (`interval.rs` says why they decide exactly); of a row of cells between two lines, words of 64 cells tell
/// where they narrow, split or end. So a vertex costs a few steps for each row that it sees, not one for each
/// cell.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, BitMatrix, Corners, DiagonalGap, FreeSpace, Vertex};
/// use mediant_grid::sight::{Quadrants, RowSummary, VisibilitySweep};
/// let map = AsciiMap::parse("
///     ....
///     .#..
///     ....
/// ")?;
/// let space = FreeSpace::<Corners>::new(Arc::new(map.grid), DiagonalGap::Open);
/// // Column 4 is marked.
/// let marks = BitMatrix::from_words(5, 4, false, |_, _| 1 << 4);
/// let mut seen = Vec::new();
/// let bands = RowSummary::new(space.grid());
/// VisibilitySweep::default().seen(&space, &bands, &marks, Vertex::new(0, 1), Quadrants::ALL, |at| seen.push(at.y));
/// seen.sort();
/// assert_eq!(seen, [0, 1]);
/// # Ok::<(), mediant_grid::GridError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct VisibilitySweep {
    pending: Vec<Piece>,
}

/// What is seen of a line between two rays: an interval whose ends differ.
#[derive(Clone, Copy, Debug)]
struct Piece {
    line: i32,
    left: Edge,
    right: Edge,
}

/// An end of an interval.
#[derive(Clone, Copy, Debug)]
struct Edge {
    end: IntervalEnd,
    /// Whether it follows a wall: then it stays in its column, and becomes a ray where the wall ends.
    is_wall: bool,
}

impl Edge {
    const fn ray(end: IntervalEnd) -> Self {
        Self { end, is_wall: false }
    }

    const fn wall(x: i32) -> Self {
        Self { end: IntervalEnd::standing(x), is_wall: true }
    }

    /// Where it is some lines further on, if nothing is in the way.
    #[inline]
    const fn after(&self, lines: i32) -> Self {
        Self { end: self.end.moved_to(self.end.after(lines)), ..*self }
    }

    /// The ray through it, from a root in column `x`, `n` lines away.
    #[inline]
    fn as_ray(&self, x: i32, n: i32) -> Ray {
        if self.is_wall { Ray { dx: self.end.here.floor() - x, dy: n } } else { self.end.ray }
    }
}

/// One half of what there is to be seen, above or below.
struct Half<'t> {
    space: &'t FreeSpace<Corners>,
    bands: &'t RowSummary,
    marks: Targets<'t>,
    from: Vertex,
    /// 1 below, −1 above.
    down: i32,
}

impl VisibilitySweep {
    /// Tells `found` the marks that the free vertex `from` sees in these quadrants, each once. Marks are
    /// convex corners of obstacles; others may be left out, as may those behind another corner on the same
    /// ray. On the vertical between a quadrant that is asked for and one that is not, what is seen is what
    /// the cells of the first let through. `bands` are those of the free space's grid. Under
    /// [`DiagonalGap::Closed`](crate::DiagonalGap::Closed) no mark may be at a
    /// [gap](FreeSpace::is_closed_gap).
    pub fn seen<'m>(
        &mut self,
        space: &'m FreeSpace<Corners>,
        bands: &'m RowSummary,
        marks: impl Into<Targets<'m>>,
        from: Vertex,
        quadrants: Quadrants,
        mut found: impl FnMut(Vertex),
    ) {
        let marks = marks.into();
        for down in [1, -1] {
            let (left, right) = (quadrants.has(-1, down), quadrants.has(1, down));
            if left || right {
                let half = Half { space, bands, marks, from, down };
                self.pending.clear();
                self.pending.extend(half.first(left, right));
                while let Some(piece) = self.pending.pop() {
                    half.follow(piece, &mut self.pending, &mut found);
                }
            }
        }
        for right in [1, -1] {
            if quadrants.has(right, 1) || quadrants.has(right, -1) || quadrants.0 & Quadrants::LINE.0 != 0 {
                let mark = along_line(space, marks, from, right);
                if let Some(at) = mark.filter(|&at| !space.has_closed_gaps() || space.sees(from, at)) {
                    found(at);
                }
            }
        }
    }
}

/// The nearest marked vertex that can be reached along the horizontal line.
fn along_line(space: &FreeSpace<Corners>, marks: Targets<'_>, from: Vertex, right: i32) -> Option<Vertex> {
    let [above, below] = [1, -1].map(|down| row_ahead(space.grid(), from.y, -down));
    let [same, opposite] = [marks.same, marks.opposite].map(|marks| marks.row(from.y));
    let mut x = from.x;
    loop {
        // Bit i of each: the edge and the vertex i and i + 1 steps on.
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
            return Some(Vertex::new(x + right * (mark as i32 + 1), from.y));
        }
        if edge < 64 {
            return None;
        }
        x += right * 64;
    }
}

impl Half<'_> {
    /// What is seen of the first line, as far as it is to the left or right.
    fn first(&self, left: bool, right: bool) -> Option<Piece> {
        let (x, ahead) = (self.from.x, self.ahead(self.from.y));
        let start = if left { ahead.run_start(x, 0) } else { x };
        let end = if right { ahead.first_blocked(x, i32::MAX) } else { x };
        // Where nothing is in the way but the quadrant ends, the edge is the vertical through the root.
        let edge = |end| if end == x { Edge::ray(IntervalEnd::standing(x)) } else { Edge::wall(end) };
        let piece = Piece { line: self.from.y + self.down, left: edge(start), right: edge(end) };
        (start < end).then_some(piece)
    }

    /// The row of cells beyond a line.
    fn ahead(&self, line: i32) -> BitRow<'_> {
        row_ahead(self.space.grid(), line, self.down)
    }

    /// Follows an interval from line to line until it ends; where it splits, all but the first part are left
    /// `pending`.
    fn follow(&self, mut piece: Piece, pending: &mut Vec<Piece>, found: &mut impl FnMut(Vertex)) {
        let mut ahead = self.ahead(piece.line);
        let mut marks = [self.marks.same, self.marks.opposite].map(|marks| marks.row(piece.line));
        loop {
            self.end_walls(&mut piece, ahead);
            if piece.line % RowSummary::LINES == 0
                && let Some(next) = self.leap(piece)
            {
                self.report_ends(piece, marks, found);
                ahead = ahead.below(self.down * RowSummary::LINES);
                marks = marks.map(|marks| marks.below(self.down * RowSummary::LINES));
                piece = next;
                continue;
            }
            let [mut left, mut right] = [piece.left, piece.right].map(|edge| edge.after(1));
            let (first, last) = (piece.left.end.here.floor(), piece.right.end.here.ceil());
            let (low, high) = (first.min(left.end.here.floor()), last.max(right.end.here.ceil()));
            if ahead.first_blocked(first, last) == last {
                self.report_ends(piece, marks, found);
                let (start, end) = (ahead.run_start(first, low), ahead.first_blocked(last, high));
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
                self.report(piece, marks, found);
                let mut goes_on = None;
                let mut from = first;
                while from < last {
                    let inside = ahead.first_free(from, last);
                    if inside == last {
                        break;
                    }
                    let start = if inside > first { inside } else { ahead.run_start(inside, low) };
                    let end = ahead.first_blocked(inside, high);
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
            marks = marks.map(|marks| marks.below(self.down));
        }
    }

    /// How far a line is from the root.
    #[inline]
    const fn distance(&self, line: i32) -> i32 {
        (line - self.from.y) * self.down
    }

    /// Makes rays of the edges whose walls end on the piece's line.
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

    /// The interval a band of rows further on, if all its cells on the way are free, and the walls that it
    /// follows go on.
    #[inline]
    fn leap(&self, piece: Piece) -> Option<Piece> {
        let band = piece.line / RowSummary::LINES + (self.down - 1) / 2;
        let (blocked, solid) = (self.bands.blocked.row(band), self.bands.solid.row(band));
        let [left, right] = [piece.left, piece.right].map(|edge| edge.after(RowSummary::LINES));
        let (mut low, mut high) = (
            piece.left.end.here.floor().min(left.end.here.floor()),
            piece.right.end.here.ceil().max(right.end.here.ceil()),
        );
        // Where there is no wall, there is no corner beside the interval either.
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

    /// What of an interval comes through the free cells from column `start` to `end`, on the next line.
    fn through(&self, piece: Piece, start: i32, end: i32) -> Option<Piece> {
        let (x, n) = (self.from.x, self.distance(piece.line));
        let [left, right] = [piece.left, piece.right].map(|edge| edge.after(1));
        // An obstacle that stands in the way clips the interval by the corner that hides most: on its near
        // side if it is away from the vertical through the root, and else on its far side.
        let shaded = |end: i32| Edge::ray(IntervalEnd::new(Ray { dx: end - x, dy: n }, x, n + 1));
        let left = if start > piece.left.end.here.floor() {
            if start > x { shaded(start) } else { Edge::wall(start) }
        } else if left.end.here.floor() < start {
            Edge::wall(start)
        } else {
            left
        };
        let right = if end < piece.right.end.here.ceil() {
            if end < x { shaded(end) } else { Edge::wall(end) }
        } else if right.end.here.ceil() > end {
            Edge::wall(end)
        } else {
            right
        };
        // A single ray touches obstacles on both sides, at vertices that it does not lead beyond.
        let (l, r) = (left.as_ray(x, n + 1), right.as_ray(x, n + 1));
        let widens = i64::from(l.dx) * i64::from(r.dy) < i64::from(r.dx) * i64::from(l.dy);
        widens.then_some(Piece { line: piece.line + self.down, left, right })
    }

    /// Tells the marked vertices of an interval beyond which all cells are free. Those on its near side are,
    /// so that only its ends can be corners of obstacles.
    #[inline]
    fn report_ends(&self, piece: Piece, marks: [BitRow<'_>; 2], found: &mut impl FnMut(Vertex)) {
        for edge in [piece.left, piece.right] {
            let x = edge.end.here.floor();
            if edge.end.here.is_vertex() && self.is_marked(x, marks) {
                found(Vertex::new(x, piece.line));
            }
        }
    }

    /// Whether a vertex of the line of these marks is one to look for.
    #[inline]
    fn is_marked(&self, x: i32, [same, opposite]: [BitRow<'_>; 2]) -> bool {
        match (x - self.from.x) * self.down {
            0 => same.is_blocked(x) || opposite.is_blocked(x),
            1.. => same.is_blocked(x),
            _ => opposite.is_blocked(x),
        }
    }

    /// Tells the marked vertices of an interval.
    fn report(&self, piece: Piece, marks: [BitRow<'_>; 2], found: &mut impl FnMut(Vertex)) {
        let (x, line) = (self.from.x, piece.line);
        let (first, last) = (piece.left.end.here.ceil(), piece.right.end.here.floor());
        let [left, right] = if self.down > 0 { [marks[1], marks[0]] } else { marks };
        if first < x {
            report(left, line, first, last.min(x - 1), found);
        }
        if first <= x && x <= last && self.is_marked(x, marks) {
            found(Vertex::new(x, line));
        }
        if last > x {
            report(right, line, first.max(x + 1), last, found);
        }
    }
}

/// Whether an interval of which an edge may follow a wall still is one: a ray may meet the wall.
#[inline]
const fn widens([left, right]: [Edge; 2]) -> bool {
    left.end.here.floor() < right.end.here.ceil()
}

/// Tells the marks of a row from column `first` to column `last`.
#[inline]
fn report(marks: BitRow<'_>, line: i32, first: i32, last: i32, found: &mut impl FnMut(Vertex)) {
    let mut from = first;
    while from <= last {
        let width = (last - from + 1).min(64);
        let mut bits = marks.word(from) & (!0 >> (64 - width));
        while bits != 0 {
            found(Vertex::new(from + bits.trailing_zeros() as i32, line));
            bits &= bits - 1;
        }
        from += 64;
    }
}
