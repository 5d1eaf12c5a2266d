//! Labels the vertices of a root's cone in an any-angle field, line by line.

use mediant_grid::{
    BitMatrix, Corners, FreeSpace, Interrupt, Interrupted, Vertex, VertexId,
    sight::{Crossing, IntervalEnd, Place, Ray, Side, row_ahead},
};

/// A source, or a corner of an obstacle at which paths bend.
#[derive(Clone, Copy, Debug)]
pub(super) struct Root {
    pub(super) at: Place,
    /// Its number: that of a vertex, or beyond those of all vertices that of a source between them.
    pub(super) number: u32,
    /// Its distance to the nearest source.
    pub(super) g: f64,
}

impl Root {
    /// The distance to a line above or below it, in parts of a cell.
    #[inline]
    const fn away(&self, line: i32, down: i32) -> i32 {
        (Place::parts(line) - self.at.y) * down
    }
}

/// The part of a line that a root sees: an interval between two rays, its ends included.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    line: i32,
    left: IntervalEnd,
    right: IntervalEnd,
}

/// A line of vertices, seen from a root.
#[derive(Clone, Copy, Debug)]
struct Line {
    y: i32,
    /// The number of the vertex in column 0.
    first: usize,
    /// The square of the distance to the root, in parts of a cell.
    away: f64,
}

impl Line {
    /// A line, `n` parts of a cell away from the root.
    #[inline]
    fn new(y: i32, space: &FreeSpace<Corners>, n: i32) -> Self {
        let first = y as usize * (space.grid().width() as usize + 1);
        Self { y, first, away: f64::from(n) * f64::from(n) }
    }

    /// The number of its vertex in a column.
    #[inline]
    const fn number(self, x: i32) -> usize {
        self.first + x as usize
    }

    /// The length of the path by a root to a vertex of it.
    #[inline]
    fn length(self, root: &Root, x: i32) -> f64 {
        let aside = f64::from(Place::parts(x) - root.at.x);
        // Squares of parts, and a product with a power of two, are exact: to the last bit this is in cells.
        root.g + (aside * aside + self.away).sqrt() * PART
    }
}

/// How much longer than the known distance of a vertex a path to it must be before what lies behind is left
/// to others, in cells.
///
/// A path from the root crosses a line at a point x less than 1 from a vertex v of the interval. By the known
/// path to v, x is at most d(v) + |vx| away; by the root it is at least g + |root v| − |vx|. If the second is
/// larger for every |vx| < 1, no shortest path crosses there. That it is not decided to the last bit is what
/// the proof in module `any_angle` needs: of two equally short paths, none is given up for the other.
const MARGIN: f64 = 2.0;

/// The labels of the vertices.
pub(super) struct Labels<'s> {
    pub(super) space: &'s FreeSpace<Corners>,
    /// The convex corners of obstacles, and all gaps: the vertices where a path may not just go straight on.
    pub(super) corners: &'s BitMatrix,
    /// By vertex number: the distance, infinity if none is known.
    pub(super) lengths: &'s mut [f64],
    /// By vertex number: the number of the next root on the way to the source.
    pub(super) toward: &'s mut [u32],
    /// The sources between vertices.
    pub(super) between: &'s [Place],
    pub(super) limit: f64,
    /// The corners that were reached by a shorter path than before, around which paths may bend.
    pub(super) bends: &'s mut Vec<(f64, VertexId)>,
    pub(super) pending: &'s mut Vec<Piece>,
    pub(super) interrupt: &'s Interrupt,
    /// The work since the interrupt was asked: lines, and vertices on them.
    pub(super) unasked: usize,
}

/// The work between two questions of an interrupt.
const WORK: usize = 1 << 13;

/// A part of a cell, in cells. Products with it are exact.
const PART: f64 = 1.0 / Place::parts(1) as f64;

/// Whether a path that comes to a corner along `u` may bend around one of its blocked cells. `turn` is called
/// with the signs of the cell, seen from the corner, and whether the path turns towards the horizontal edge
/// of the cell rather than the vertical one; it returns whether to look for more.
pub(super) fn turns(
    space: &FreeSpace<Corners>,
    at: Vertex,
    from: Place,
    mut turn: impl FnMut((i32, i32), bool),
) {
    let u = from.to(Place::of(at));
    for (x, y) in [(-1, -1), (1, -1), (-1, 1), (1, 1)] {
        if space.grid().is_free(at.x + (x - 1) / 2, at.y + (y - 1) / 2) {
            continue;
        }
        if u.x * x >= 0 && u.y * y < 0 {
            turn((x, y), true);
        }
        if u.x * x < 0 && u.y * y >= 0 {
            turn((x, y), false);
        }
    }
}

impl Labels<'_> {
    /// The place of a root.
    #[inline]
    pub(super) fn place(&self, number: u32) -> Option<Place> {
        match (number as usize).checked_sub(self.lengths.len()) {
            None => Some(Place::of(self.space.vertex(VertexId(number)))),
            Some(index) => self.between.get(index).copied(),
        }
    }

    /// The number of the root before this one, if this distance is the one that is known; a source's own.
    #[inline]
    pub(super) fn parent(&self, number: u32, length: f64) -> Option<u32> {
        match self.lengths.get(number as usize) {
            None => Some(number),
            Some(known) if known.to_bits() != length.to_bits() => None,
            Some(_) => self.toward.get(number as usize).copied(),
        }
    }

    /// Labels a vertex of a line that a root sees, if the path by the root is shorter.
    #[inline]
    fn label(&mut self, root: &Root, line: Line, x: i32) {
        let (index, at) = (line.number(x), Vertex::new(x, line.y));
        let length = line.length(root, x);
        let (Some(known), Some(toward)) = (self.lengths.get_mut(index), self.toward.get_mut(index)) else {
            return;
        };
        if length >= *known || length > self.limit {
            return;
        }
        if self.space.is_closed_gap(at) {
            if self.space.may_turn_at(Some(root.at.into()), at.into(), None) {
                (*known, *toward) = (length, root.number);
            }
            return;
        }
        (*known, *toward) = (length, root.number);
        if self.corners.get(x, line.y) {
            let mut bends = false;
            turns(self.space, at, root.at, |_, _| bends = true);
            if bends {
                self.bends.push((length, VertexId(index as u32)));
            }
        }
    }

    /// Whether a path may go on from a vertex of a line, or past it, and be a shortest one.
    ///
    /// The known path may end at a closed gap, and not go on. But beside a gap, where a root sees it, the row
    /// ahead is blocked.
    #[inline]
    fn may_go_on(&self, root: &Root, line: Line, x: i32) -> bool {
        let Some(&known) = self.lengths.get(line.number(x)) else { return false };
        line.length(root, x) <= known.min(self.limit) + MARGIN
    }

    /// Labels vertices of a line. Between corners nothing is decided but which path is shorter, for several
    /// vertices at once.
    #[inline]
    fn label_between(&mut self, root: &Root, line: Line, (mut x, last): (i32, i32)) {
        let corners = self.corners.row(line.y);
        while x <= last {
            let corner = x + corners.word(x).trailing_zeros() as i32;
            let end = corner.min(last + 1);
            let numbers = line.number(x)..line.number(end);
            let (lengths, toward) = (self.lengths.get_mut(numbers.clone()), self.toward.get_mut(numbers));
            let labels = lengths.unwrap_or_default().iter_mut().zip(toward.unwrap_or_default());
            for ((known, toward), x) in labels.zip(x..) {
                let length = line.length(root, x);
                let is_less = length < *known && length <= self.limit;
                *known = if is_less { length } else { *known };
                *toward = if is_less { root.number } else { *toward };
            }
            x = end;
            if corners.is_blocked(x) && x <= last {
                self.label(root, line, x);
                x += 1;
            }
        }
    }

    /// Labels the vertices on the horizontal line of a root, if it is on one, to one side.
    pub(super) fn along_line(&mut self, root: &Root, right: i32) {
        let ((left, after), (y, below)) = (root.at.columns(), root.at.lines());
        let mut x = if right > 0 { left } else { after };
        if y != below {
            return;
        }
        let line = Line::new(y, self.space, 0);
        let [above, below] = [-1, 1].map(|down| row_ahead(self.space.grid().rows(), y, down));
        loop {
            let cell = x + (right - 1) / 2;
            if above.is_blocked(cell) && below.is_blocked(cell) {
                return;
            }
            x += right;
            let goes_on = self.may_go_on(root, line, x);
            self.label(root, line, x);
            if !goes_on || self.space.is_closed_gap(Vertex::new(x, y)) {
                return;
            }
        }
    }

    /// Labels all that a root sees above or below it.
    pub(super) fn in_half(&mut self, root: &Root, down: i32) -> Result<(), Interrupted> {
        let line = root.at.line(down);
        let (start, end) = root.at.run(row_ahead(self.space.grid().rows(), line, down));
        if start >= end {
            return Ok(());
        }
        let away = root.away(line + down, down);
        let [left, right] = [start, end].map(|x| IntervalEnd::corner(x, root.at.x, away));
        self.follow(root, down, Piece { line: line + down, left, right })
    }

    /// Labels what a root at a vertex sees above or below it. `left` and `right` are the rays between which
    /// it looks; `None` for the horizontal.
    pub(super) fn in_cone(
        &mut self,
        root: &Root,
        down: i32,
        left: Option<Ray>,
        right: Option<Ray>,
    ) -> Result<(), Interrupted> {
        let at = root.at.floor();
        let ahead = row_ahead(self.space.grid().rows(), at.y, down);
        let (from, away) = (root.at.x, Place::parts(1));
        let on_line = |ray| IntervalEnd::new(ray, from, away);
        let corner = |x| IntervalEnd::corner(x, from, away);
        // A ray that leads to the right leaves the vertex through the cell on its right.
        let looks = |cell: i32| !ahead.is_blocked(cell);
        let goes_left = left.is_none_or(|ray| ray.dx < 0) && looks(at.x - 1);
        let goes_right = right.is_none_or(|ray| ray.dx > 0) && looks(at.x);
        let start = if goes_left { ahead.run_start(at.x, 0) } else { at.x };
        let end = if goes_right { ahead.first_blocked(at.x, i32::MAX) } else { at.x };
        let clipped =
            |end: IntervalEnd, side: Side, x: i32| if side.is_outside(end.here, x) { corner(x) } else { end };
        let left = left.map_or(corner(start), |ray| clipped(on_line(ray), Side::Left, start));
        let right = right.map_or(corner(end), |ray| clipped(on_line(ray), Side::Right, end));
        if widens(left, right) {
            self.follow(root, down, Piece { line: at.y + down, left, right })
        } else {
            Ok(())
        }
    }

    /// Labels an interval, and what is seen through it.
    fn follow(&mut self, root: &Root, down: i32, piece: Piece) -> Result<(), Interrupted> {
        self.pending.clear();
        self.pending.push(piece);
        while let Some(piece) = self.pending.pop() {
            if let Some(piece) = self.label_line(root, down, piece) {
                self.cross_row(root, down, piece);
            }
            if self.unasked >= WORK {
                self.unasked = 0;
                self.interrupt.check("finding the distances of a field")?;
            }
        }
        Ok(())
    }

    /// Labels the vertices of an interval. Returns the part of it behind which there may be vertices whose
    /// shortest path leads through it.
    #[inline]
    fn label_line(&mut self, root: &Root, down: i32, piece: Piece) -> Option<Piece> {
        let (first, last) = (piece.left.here.ceil(), piece.right.here.floor());
        self.unasked += (last - first).max(0) as usize + 1;
        if first > last {
            return Some(piece);
        }
        let n = root.away(piece.line, down);
        let line = Line::new(piece.line, self.space, n);
        let low = (first..=last).find(|&x| self.may_go_on(root, line, x))?;
        let high = (low + 1..=last).rev().find(|&x| self.may_go_on(root, line, x)).unwrap_or(low);
        self.label_between(root, line, (low, high));
        let corner = |x| IntervalEnd::corner(x, root.at.x, n);
        let left = if low > first { corner(low - 1) } else { piece.left };
        let right = if high < last { corner(high + 1) } else { piece.right };
        Some(Piece { left, right, ..piece })
    }

    /// Finds the parts of the next line that are seen through the runs of free cells ahead.
    #[inline]
    fn cross_row(&mut self, root: &Root, down: i32, Piece { line, left, right }: Piece) {
        let n = root.away(line, down);
        let ahead = row_ahead(self.space.grid().rows(), line, down);
        let corner = |x: i32, n: i32| IntervalEnd::corner(x, root.at.x, n);
        let after = n + Place::parts(1);
        let (first, last) = (left.here.floor(), right.here.ceil());
        let (low, high) = (left.next().floor().min(first), right.next().ceil().max(last));
        let mut column = first;
        loop {
            column = ahead.first_free(column, last);
            if column >= last {
                return;
            }
            let start = if column == first { ahead.run_start(column, low) } else { column };
            let stop = ahead.first_blocked(column, high);
            let left = if start > first { corner(start, n) } else { left };
            let right = if stop < last { corner(stop, n) } else { right };
            let (next_left, next_right): (Crossing, Crossing) = (left.next(), right.next());
            if next_left.floor() < stop && next_right.ceil() > start {
                let is_wall = Side::Left.is_outside(next_left, start);
                let left = if is_wall { corner(start, after) } else { left.moved_to(next_left) };
                let is_wall = Side::Right.is_outside(next_right, stop);
                let right = if is_wall { corner(stop, after) } else { right.moved_to(next_right) };
                self.pending.push(Piece { line: line + down, left, right });
            }
            column = stop + 1;
        }
    }
}

/// Whether an interval has a length.
fn widens(left: IntervalEnd, right: IntervalEnd) -> bool {
    right.ray.is_right_of(left.ray)
}
