//! Points of free space that need not be vertices: whether they are free, connected, and see each other.
//!
//! At any angle a path may start and end anywhere. It obeys the rules of corner placement all the same: a
//! segment may touch blocked cells, but neither meet the open interior of one nor run along an edge that two
//! of them share.
//!
//! **In integers.** Coordinates are multiples of 1/1024, at most 2²⁵ of them. A segment crosses a line at a
//! quotient whose numerator is a sum of two products of two coordinates, below 2⁵², and whose denominator is
//! a coordinate times 2¹⁰, at most 2³⁵. So floors, ceilings and 'is it a vertex?' are exact in 64 bits.

use mediant_moves::Vector;

use crate::{
    BitMatrix, Corners, DiagonalGap, FreeSpace, Grid, Obstruction, Placement, Point, Vertex, sight::Place,
};

impl FreeSpace<Corners> {
    /// A point in the parts that rays are counted in; `None` outside of the map's rectangle.
    #[doc(hidden)]
    #[must_use]
    pub fn place(&self, at: Point) -> Option<Place> {
        place(self.grid(), at)
    }

    /// Whether a path at any angle may stand at a point: whether one of the cells that it touches is free.
    /// False outside the map. Of a vertex this is [`is_free`](Self::is_free).
    ///
    /// ```
    /// use std::sync::Arc;
    /// use mediant_grid::{AsciiMap, Corners, DiagonalGap, FreeSpace, Point};
    /// let map = AsciiMap::parse(".#")?;
    /// let space = FreeSpace::<Corners>::new(Arc::new(map.grid), DiagonalGap::Open);
    /// let is_free = |x, y| Point::nearest(x, y).is_some_and(|at| space.point_is_free(at));
    /// assert!(is_free(0.5, 0.5) && is_free(1.0, 0.25) && !is_free(1.25, 0.5));
    /// # Ok::<(), mediant_grid::GridError>(())
    /// ```
    #[must_use]
    pub fn point_is_free(&self, at: Point) -> bool {
        self.place(at).is_some_and(|at| at.is_free(self.grid().rows()))
    }

    /// Whether a path at any angle leads from one free point to another, in constant time. Of vertices this
    /// is [`connected`](Self::connected).
    #[must_use]
    pub fn points_connected(&self, from: Point, to: Point) -> bool {
        if from == to {
            return self.point_is_free(from);
        }
        let component = |at| self.component_of(self.place(at)?);
        component(from).is_some_and(|label| component(to) == Some(label))
    }

    fn component_of(&self, at: Place) -> Option<u32> {
        let cell = match at.vertex() {
            Some(vertex) => Corners::representative(self.grid(), self.rule(), vertex),
            // The cells that a place between vertices touches share an edge, or there is one.
            None => {
                let ((left, right), (above, below)) = (at.columns(), at.lines());
                let cells = [(left, above), (right - 1, below - 1)].map(Vertex::from);
                cells.into_iter().find(|cell| self.grid().is_free(cell.x, cell.y))?
            }
        };
        self.components().of(cell)
    }

    /// Whether the straight segment between two points obeys the rules of motion, as
    /// [`sees`](Self::sees) says it of vertices: it is judged for itself, so that a closed gap at which it
    /// begins or ends is not in its way.
    #[must_use]
    pub fn point_sees(&self, from: Point, to: Point) -> bool {
        match [from, to].map(|at| self.place(at).filter(|at| at.is_free(self.grid().rows()))) {
            [Some(from), Some(to)] => self.first_between(from, to).is_none(),
            _ => false,
        }
    }

    /// The first thing on the straight segment between two points, seen from `from`, that the rules of motion
    /// do not allow; `None` if [`point_sees`](Self::point_sees) is true. The order is that of
    /// [`obstruction`](Self::obstruction).
    #[must_use]
    pub fn point_obstruction(&self, from: Point, to: Point) -> Option<Obstruction> {
        let (Some(start), true) = (self.place(from), self.point_is_free(from)) else {
            return Some(Obstruction::End { at: from });
        };
        let Some(end) = self.place(to) else { return Some(Obstruction::End { at: to }) };
        let blocked = || (!self.point_is_free(to)).then_some(Obstruction::End { at: to });
        self.first_between(start, end).or_else(blocked)
    }

    /// [`may_turn`](Self::may_turn) for points. Only a vertex can be a closed gap.
    #[must_use]
    pub fn may_turn_at(&self, before: Option<Point>, at: Point, after: Option<Point>) -> bool {
        let Some(vertex) = at.vertex().filter(|&at| self.is_closed_gap(at)) else { return true };
        let is_end = before.is_none() || after.is_none();
        let quadrants = [(1, 1), (1, -1), (-1, 1), (-1, -1)];
        quadrants.into_iter().take(if is_end { 1 } else { 4 }).any(|(x, y)| {
            let holds = |other: Option<Point>| {
                other.is_none_or(|other| {
                    let ((to_x, to_y), (at_x, at_y)) = (other.parts(), at.parts());
                    (to_x - at_x) * i64::from(x) >= 0 && (to_y - at_y) * i64::from(y) >= 0
                })
            };
            let is_free = self.grid().is_free(vertex.x + (x - 1) / 2, vertex.y + (y - 1) / 2);
            is_free && holds(before) && holds(after)
        })
    }

    /// The first thing between two places of the map that is in the way.
    #[doc(hidden)]
    #[must_use]
    pub fn first_between(&self, from: Place, to: Place) -> Option<Obstruction> {
        first_between(self.grid(), self.has_closed_gaps(), from, to)
    }
}

/// A point in the parts that rays are counted in; `None` outside of the map's rectangle.
fn place(grid: &Grid, at: Point) -> Option<Place> {
    let (x, y) = at.parts();
    let on_map = |parts: i64, cells: u32| (0..=i64::from(cells) * Point::PARTS).contains(&parts);
    let is_on_map = on_map(x, grid.width()) && on_map(y, grid.height());
    is_on_map.then_some(Place { x: x as i32, y: y as i32 })
}

/// Whether the segment between the centers of two cells obeys the rules of corner placement.
pub(crate) fn centers_see(grid: &Grid, gap: DiagonalGap, from: Vertex, to: Vertex) -> bool {
    let center = |at: Vertex| {
        let is_small = grid.width().max(grid.height()) <= Grid::MAX_SIDE;
        place(grid, Point::from(at).at_corners()).filter(|_| is_small && grid.is_free(at.x, at.y))
    };
    match [from, to].map(center) {
        [Some(from), Some(to)] => first_between(grid, gap == DiagonalGap::Closed, from, to).is_none(),
        _ => false,
    }
}

/// The first thing between two places of a map that is in the way.
fn first_between(grid: &Grid, gaps: bool, from: Place, to: Place) -> Option<Obstruction> {
    let d = from.to(to);
    let transposed = d.y.unsigned_abs() > d.x.unsigned_abs();
    let matrix = if transposed { grid.columns() } else { grid.rows() };
    let turned = |at: Place| if transposed { Place { x: at.y, y: at.x } } else { at };
    let found = Strips { matrix, gaps, from: turned(from), to: turned(to) }.first()?;
    let placed = |(u, v): (i32, i32)| if transposed { (v, u) } else { (u, v) };
    Some(match found {
        Found::Cell(cell) => {
            let (x, y) = placed(cell);
            Obstruction::Cell { x, y }
        }
        Found::Between(cells) => Obstruction::Between { cells: cells.map(placed) },
    })
}

/// A segment that is at least as long along the rows of a matrix as across them, which it crosses one after
/// another.
struct Strips<'g> {
    matrix: &'g BitMatrix,
    /// Whether gaps are closed.
    gaps: bool,
    from: Place,
    to: Place,
}

/// Where a segment crosses one line after another: only the first of them takes divisions.
#[derive(Default)]
struct Crossings {
    /// The column of vertices at or to the left of the crossing, and how far it is from there.
    column: i32,
    rest: i64,
    /// The measure of a cell in the units of that: the segment's height in parts, in parts. 0 before the
    /// first line.
    cell: i64,
    /// From line to line.
    step: (i32, i64),
}

impl Crossings {
    /// Goes to the next line, or to the first one.
    #[inline]
    fn go_to(&mut self, line: i32, &Strips { from, .. }: &Strips<'_>, d: Vector) {
        if self.cell == 0 {
            let height = i64::from(d.y.abs());
            let cell = height << Place::PLACES;
            let aside = i64::from((Place::parts(line) - from.y).abs());
            let first = i64::from(from.x) * height + aside * i64::from(d.x);
            let parts = |n: i64| (n.div_euclid(cell) as i32, n.rem_euclid(cell));
            let ((column, rest), step) = (parts(first), parts(i64::from(d.x) << Place::PLACES));
            *self = Self { column, rest, cell, step };
            return;
        }
        (self.column, self.rest) = (self.column + self.step.0, self.rest + self.step.1);
        let carry = self.rest >= self.cell;
        self.column += i32::from(carry);
        self.rest -= if carry { self.cell } else { 0 };
    }

    /// The columns of vertices around the crossing.
    #[inline]
    const fn columns(&self) -> (i32, i32) {
        (self.column, self.column + (self.rest != 0) as i32)
    }
}

/// Cells in the way, as (column, row) of the matrix.
enum Found {
    Cell((i32, i32)),
    Between([(i32, i32); 2]),
}

impl Strips<'_> {
    fn first(&self) -> Option<Found> {
        let d = self.from.to(self.to);
        if d.y == 0 {
            return if self.from.lines().0 == self.from.lines().1 { self.on_line() } else { self.in_row() };
        }
        let down = d.y.signum();
        let last = self.to.line(-down);
        let (mut line, mut here) = (self.from.line(down), self.from.columns());
        let mut crossings = Crossings::default();
        loop {
            let is_last = line + down == last;
            if !is_last {
                crossings.go_to(line + down, self, d);
            }
            let next = if is_last { self.to.columns() } else { crossings.columns() };
            let row = line + (down - 1) / 2;
            let (first, end) = (here.0.min(next.0), here.1.max(next.1));
            if self.matrix.any(row, first, end - 1) {
                return self.first_cell(row, (first, end));
            }
            if is_last {
                return None;
            }
            line += down;
            if self.gaps && next.0 == next.1 {
                let gap = self.gap(next.0, line);
                if gap.is_some() {
                    return gap;
                }
            }
            here = next;
        }
    }

    /// A segment within a row.
    fn in_row(&self) -> Option<Found> {
        let (first, end) = self.columns();
        self.first_cell(self.from.lines().0, (first, end))
    }

    /// The columns of vertices around a segment.
    fn columns(&self) -> (i32, i32) {
        let [a, b] = [self.from, self.to].map(Place::columns);
        (a.0.min(b.0), a.1.max(b.1))
    }

    fn rightwards(&self) -> bool {
        self.from.x < self.to.x
    }

    /// The first blocked cell of a row between two columns of vertices.
    fn first_cell(&self, row: i32, (first, end): (i32, i32)) -> Option<Found> {
        let is_blocked = |&column: &i32| self.matrix.get(column, row);
        let found = match self.rightwards() {
            true => (first..end).find(is_blocked),
            false => (first..end).rev().find(is_blocked),
        };
        found.map(|column| Found::Cell((column, row)))
    }

    /// A segment along a line: it may not run between two blocked cells, nor pass a closed gap.
    fn on_line(&self) -> Option<Found> {
        let ((first, end), line) = (self.columns(), self.from.lines().0);
        let edges = self.matrix.any_edge(line, first, end - 1);
        let gaps = self.gaps && self.matrix.any_gap(line, first + 1, end - 1);
        if first == end || !edges && !gaps {
            return None;
        }
        let between = |column: i32| {
            let cells = [(column, line - 1), (column, line)];
            cells.iter().all(|&(x, y)| self.matrix.get(x, y)).then_some(Found::Between(cells))
        };
        let gap = |x: i32| if self.gaps && first < x && x < end { self.gap(x, line) } else { None };
        match self.rightwards() {
            true => (first..end).find_map(|column| gap(column).or_else(|| between(column))),
            false => (first..end).rev().find_map(|column| gap(column + 1).or_else(|| between(column))),
        }
    }

    /// The two cells of a gap.
    fn gap(&self, x: i32, y: i32) -> Option<Found> {
        let falling = [(x - 1, y - 1), (x, y)];
        let rising = [(x, y - 1), (x - 1, y)];
        let [blocked, others] = [falling, rising].map(|cells| cells.map(|(x, y)| self.matrix.get(x, y)));
        match (blocked, others) {
            ([true, true], [false, false]) => Some(Found::Between(falling)),
            ([false, false], [true, true]) => Some(Found::Between(rising)),
            _ => None,
        }
    }
}
