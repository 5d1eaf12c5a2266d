//! The two placements as types: the cells that a segment sweeps under each, and the rule of motion that
//! belongs to each.

use std::fmt::Debug;

use mediant_moves::{FiniteK, Vector};

use crate::{
    CornerRule, DiagonalGap, Grid, PlacementKind, Rules, Vertex,
    bits::{BitIndex, load},
    components::Connectivity,
};

/// Cells that a straight segment sweeps, with the condition under which it is legal.
///
/// Cells are given in the frame of the first octant: the segment starts at the origin and runs right and
/// down, at least as far right as down. Cell (i, j) is in the i-th column and j-th row of cells that it can
/// meet, counted from its start; see [`Placement::cell`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SweptCells {
    /// All cells of row `row` from column `first` to column `last` must be free.
    AllFree {
        /// The row of cells.
        row: i32,
        /// The first column.
        first: i32,
        /// The last column, inclusive.
        last: i32,
    },
    /// At least one of two cells (column, row) must be free.
    EitherFree([(i32, i32); 2]),
}

/// A placement of vertices, as a type parameter of grid graphs and engines: [`Centers`] or [`Corners`].
pub trait Placement: sealed::Sealed + Copy + Debug + Default + Send + Sync + 'static {
    /// The placement as a value.
    const KIND: PlacementKind;
    /// The number of obstacle patterns around a vertex that differ in which single steps are legal.
    #[doc(hidden)]
    const PATTERNS: usize;
    /// The rule of motion that has to be chosen with this placement.
    type Rule: Copy + Debug + Default + PartialEq + Eq + Send + Sync;

    /// Placement and rule as a value.
    fn rules(rule: Self::Rule) -> Rules;

    /// The number of columns and of rows of vertices.
    fn vertices(grid: &Grid) -> (u32, u32);

    /// Whether a path may stand on this vertex; false outside the map.
    fn is_free(grid: &Grid, at: Vertex) -> bool;

    /// The offset on the map, along one axis, of the i-th column or row of [`SweptCells`], for a segment that
    /// runs in direction `sign` (±1) along this axis.
    fn cell(sign: i32, i: i32) -> i32;

    /// Calls `holds` with the cells that the closed segment from the origin to `d` sweeps, where 0 ≤ d.y ≤
    /// d.x and 0 < d.x: from its start to its end, until `holds` returns false. The result is whether it
    /// always returned true: whether the segment is legal.
    fn sweep(rule: Self::Rule, d: Vector, holds: impl FnMut(SweptCells) -> bool) -> bool;

    /// The number of the obstacle pattern around vertex (x, y), below [`PATTERNS`](Self::PATTERNS). `at` is
    /// the bit of cell (x, y).
    #[doc(hidden)]
    fn pattern(words: &[u64], at: BitIndex, bits_per_row: i32) -> usize;

    /// Whether a pattern includes the cell at this offset from cell (x, y).
    #[doc(hidden)]
    fn pattern_holds(dx: i32, dy: i32) -> bool;

    /// Whether the cell at this offset from cell (x, y) is blocked in a pattern. The pattern must include
    /// this cell.
    #[doc(hidden)]
    fn pattern_is_blocked(pattern: usize, dx: i32, dy: i32) -> bool;

    /// Which cells count as neighbors for the question whether there is a path: over N(k), or at any angle
    /// for `None`.
    #[doc(hidden)]
    fn connectivity(rule: Self::Rule, k: Option<FiniteK>) -> Connectivity;

    /// A cell in the same component as this free vertex.
    #[doc(hidden)]
    fn representative(grid: &Grid, rule: Self::Rule, at: Vertex) -> Vertex;

    /// The free space, if it is one of corners.
    #[doc(hidden)]
    fn at_corners(space: &crate::FreeSpace<Self>) -> Option<&crate::FreeSpace<Corners>>
    where
        Self: Sized,
    {
        let _ = space;
        None
    }

    /// Whether paths may not pass through gaps, the vertices where two blocked cells meet diagonally.
    #[doc(hidden)]
    fn closes_gaps(rule: Self::Rule) -> bool;
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Centers {}
    impl Sealed for super::Corners {}
}

/// Vertices at cell centers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Centers;

/// Vertices at cell corners.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Corners;

impl Placement for Centers {
    const KIND: PlacementKind = PlacementKind::Center;
    /// The 3 × 3 cells around the vertex, row by row.
    const PATTERNS: usize = 1 << 9;
    type Rule = CornerRule;

    fn rules(rule: CornerRule) -> Rules {
        Rules::Center(rule)
    }

    fn vertices(grid: &Grid) -> (u32, u32) {
        (grid.width(), grid.height())
    }

    fn is_free(grid: &Grid, at: Vertex) -> bool {
        grid.is_free(at.x, at.y)
    }

    fn cell(sign: i32, i: i32) -> i32 {
        sign * i
    }

    /// Row j of cells spans the heights j ± ½, between which the segment runs from d.x/d.y · (j − ½) to
    /// d.x/d.y · (j + ½). It passes through a corner of cells where it leaves the row exactly between two
    /// columns.
    fn sweep(rule: CornerRule, d: Vector, mut holds: impl FnMut(SweptCells) -> bool) -> bool {
        let mut first = 0;
        let (x, y) = (i64::from(d.x), i64::from(d.y));
        // In half cells, the segment leaves row `row` at ((2·row + 1)·dx − dy) / dy.
        let mut leaves = Quotients::new(x - y, 2 * x, 2 * y);
        for row in 0..=d.y {
            let (last, corner) = if row == d.y { (d.x, false) } else { (leaves.ceil(), leaves.rest == 0) };
            let widened = corner && rule == CornerRule::Never;
            let next = last + i32::from(corner);
            let free = SweptCells::AllFree { row, first, last: if widened { next } else { last } };
            let touched = SweptCells::EitherFree([(next, row), (last, row + 1)]);
            if !holds(free) || (corner && rule == CornerRule::One && !holds(touched)) {
                return false;
            }
            first = if corner && !widened { next } else { last };
            leaves.step();
        }
        true
    }

    #[inline]
    fn pattern(words: &[u64], at: BitIndex, bits_per_row: i32) -> usize {
        let row = |offset: i32| load(words, at.offset(offset - 1)) as usize & 7;
        row(-bits_per_row) | row(0) << 3 | row(bits_per_row) << 6
    }

    fn pattern_holds(dx: i32, dy: i32) -> bool {
        dx.abs() <= 1 && dy.abs() <= 1
    }

    fn pattern_is_blocked(pattern: usize, dx: i32, dy: i32) -> bool {
        pattern >> (4 + dx + 3 * dy) & 1 == 1
    }

    /// The cells that a legal move touches form a chain in which neighbors share an edge, except where the
    /// move passes between two blocked cells that meet diagonally, which only [`CornerRule::Always`] allows.
    fn connectivity(rule: CornerRule, k: Option<FiniteK>) -> Connectivity {
        if rule == CornerRule::Always && k != Some(FiniteK::N4) {
            Connectivity::Eight
        } else {
            Connectivity::Four
        }
    }

    fn representative(_: &Grid, _: CornerRule, at: Vertex) -> Vertex {
        at
    }

    fn closes_gaps(_: CornerRule) -> bool {
        false
    }
}

impl Placement for Corners {
    const KIND: PlacementKind = PlacementKind::Corner;
    /// The 2 × 2 cells around the vertex, row by row.
    const PATTERNS: usize = 1 << 4;
    type Rule = DiagonalGap;

    fn rules(rule: DiagonalGap) -> Rules {
        Rules::Corner(rule)
    }

    fn vertices(grid: &Grid) -> (u32, u32) {
        (grid.width() + 1, grid.height() + 1)
    }

    fn is_free(grid: &Grid, at: Vertex) -> bool {
        around(at).iter().any(|cell| grid.is_free(cell.x, cell.y))
    }

    fn cell(sign: i32, i: i32) -> i32 {
        if sign > 0 { i } else { -1 - i }
    }

    /// Row j of cells spans the heights j to j + 1. A segment along an axis needs one free cell beside each
    /// of its edges.
    fn sweep(rule: DiagonalGap, d: Vector, mut holds: impl FnMut(SweptCells) -> bool) -> bool {
        if d.y == 0 {
            return (0..d.x).all(|i| holds(SweptCells::EitherFree([(i, 0), (i, -1)])));
        }
        let mut first = 0;
        let (x, y) = (i64::from(d.x), i64::from(d.y));
        let mut end = Quotients::new(x, x, y);
        for row in 0..d.y {
            let (last, vertex) = (end.ceil() - 1, end.rest == 0 && row + 1 < d.y);
            if !holds(SweptCells::AllFree { row, first, last }) {
                return false;
            }
            let gap = SweptCells::EitherFree([(last + 1, row), (last, row + 1)]);
            if vertex && rule == DiagonalGap::Closed && !holds(gap) {
                return false;
            }
            first = end.floor as i32;
            end.step();
        }
        true
    }

    #[inline]
    fn pattern(words: &[u64], at: BitIndex, bits_per_row: i32) -> usize {
        let row = |offset: i32| load(words, at.offset(offset - 1)) as usize & 3;
        row(-bits_per_row) | row(0) << 2
    }

    fn pattern_holds(dx: i32, dy: i32) -> bool {
        (-1..=0).contains(&dx) && (-1..=0).contains(&dy)
    }

    fn pattern_is_blocked(pattern: usize, dx: i32, dy: i32) -> bool {
        pattern >> (3 + dx + 2 * dy) & 1 == 1
    }

    /// The corners of a free cell are joined along its edges. Two free cells that share only a corner are
    /// joined there, unless gaps are closed.
    fn connectivity(rule: DiagonalGap, _: Option<FiniteK>) -> Connectivity {
        match rule {
            DiagonalGap::Open => Connectivity::Eight,
            DiagonalGap::Closed => Connectivity::Four,
        }
    }

    fn representative(grid: &Grid, rule: DiagonalGap, at: Vertex) -> Vertex {
        if rule == DiagonalGap::Closed && grid.is_gap(at) {
            return at;
        }
        let cells = around(at);
        cells.into_iter().find(|cell| grid.is_free(cell.x, cell.y)).unwrap_or(at)
    }

    fn at_corners(space: &crate::FreeSpace<Self>) -> Option<&crate::FreeSpace<Corners>> {
        Some(space)
    }

    fn closes_gaps(rule: DiagonalGap) -> bool {
        rule == DiagonalGap::Closed
    }
}

/// The four cells that meet at a corner vertex. Coordinates wrap, since the vertex of a query can be
/// anywhere: the cells at both ends of the range of `i32` are outside the map, and so blocked.
fn around(at: Vertex) -> [Vertex; 4] {
    [(0, 0), (-1, 0), (0, -1), (-1, -1)]
        .map(|(dx, dy)| Vertex::new(at.x.wrapping_add(dx), at.y.wrapping_add(dy)))
}

/// (start + i · step) / by for i = 0, 1, 2 …, by additions.
struct Quotients {
    floor: i64,
    rest: i64,
    step: (i64, i64),
    by: i64,
}

impl Quotients {
    /// For step ≥ 0 and by > 0.
    #[inline]
    const fn new(start: i64, step: i64, by: i64) -> Self {
        let by = if by > 0 { by } else { 1 };
        let step = (step / by, step % by);
        Self { floor: start.div_euclid(by), rest: start.rem_euclid(by), step, by }
    }

    #[inline]
    fn ceil(&self) -> i32 {
        self.floor as i32 + i32::from(self.rest > 0)
    }

    #[inline]
    fn step(&mut self) {
        self.floor += self.step.0;
        self.rest += self.step.1;
        if self.rest >= self.by {
            self.rest -= self.by;
            self.floor += 1;
        }
    }
}

impl PlacementKind {
    /// Whether a vertex of a grid is free: see [`Placement::is_free`].
    #[must_use]
    pub fn is_free(self, grid: &Grid, at: Vertex) -> bool {
        match self {
            Self::Center => Centers::is_free(grid, at),
            Self::Corner => Corners::is_free(grid, at),
        }
    }
}
