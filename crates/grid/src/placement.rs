//! The two placements as types: what a segment sweeps under each, and which rule of motion each has.

use std::fmt::Debug;

use mediant_moves::{FiniteK, Vector};

use crate::{
    BitIndex, CornerRule, DiagonalGap, Grid, PlacementKind, Rules, Vertex, components::Connectivity, load,
};

/// What a straight segment asks of the map, in the frame of the first octant: the segment starts at the origin and runs
/// right and down, right at least as far as down. Cell (i, j) is the i-th column and j-th row of cells that it can meet,
/// counted from its start; see [`Placement::cell`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Demand {
    /// All cells of row `row` from column `first` to column `last` must be free.
    Free {
        /// The row of cells.
        row: i32,
        /// The first column.
        first: i32,
        /// The last column, itself included.
        last: i32,
    },
    /// At least one of two cells (column, row) must be free.
    EitherFree([(i32, i32); 2]),
}

/// A placement of vertices, as a type parameter of grid graphs and engines: [`Centers`] or [`Corners`].
pub trait Placement: sealed::Sealed + Copy + Debug + Default + Send + Sync + 'static {
    /// The placement as a value.
    const KIND: PlacementKind;
    /// How many obstacle patterns there are around a vertex, as far as single steps are concerned.
    #[doc(hidden)]
    const PATTERNS: usize;
    /// The rule of motion that this placement leaves open.
    type Rule: Copy + Debug + Default + PartialEq + Eq + Send + Sync;

    /// The rule as a value of the closed enum.
    fn rules(rule: Self::Rule) -> Rules;

    /// How many vertices lie in a row and in a column of the grid.
    fn vertices(grid: &Grid) -> (u32, u32);

    /// Whether a path may stand on this vertex; false outside the map.
    fn is_free(grid: &Grid, at: Vertex) -> bool;

    /// The offset, along one axis, of the i-th cell in direction `sign` (±1).
    fn cell(sign: i32, i: i32) -> i32;

    /// Tells `demand` what the closed segment from the origin to `d` asks of the map (with 0 ≤ d.y ≤ d.x, 0 < d.x), from
    /// its start to its end, until one answer is false. Whether all were true.
    fn sweep(rule: Self::Rule, d: Vector, demand: impl FnMut(Demand) -> bool) -> bool;

    /// The number of the obstacle pattern around a vertex, below [`PATTERNS`](Self::PATTERNS). `at` is the bit of cell
    /// (x, y).
    #[doc(hidden)]
    fn pattern(words: &[u64], at: BitIndex, bits_per_row: i32) -> usize;

    /// Whether a pattern holds the cell at this offset from cell (x, y).
    #[doc(hidden)]
    fn pattern_holds(dx: i32, dy: i32) -> bool;

    /// Whether the cell at this offset from cell (x, y) is blocked in a pattern; only for cells that the pattern holds.
    #[doc(hidden)]
    fn pattern_is_blocked(pattern: usize, dx: i32, dy: i32) -> bool;

    /// Which cells belong together, when it comes to whether there is any path at all: over N(k), or without k at any angle.
    fn connectivity(rule: Self::Rule, k: Option<FiniteK>) -> Connectivity;

    /// A cell whose component is that of this free vertex.
    #[doc(hidden)]
    fn representative(grid: &Grid, rule: Self::Rule, at: Vertex) -> Vertex;

    /// Whether paths may not pass the vertices where two blocked cells meet diagonally.
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

    /// Row j of cells spans the heights j ± ½, where the segment runs over the columns around d.x/d.y · (j ± ½). It
    /// passes through a corner point where it leaves the row exactly between two columns.
    fn sweep(rule: CornerRule, d: Vector, mut demand: impl FnMut(Demand) -> bool) -> bool {
        let mut first = 0;
        let (x, y) = (i64::from(d.x), i64::from(d.y));
        // In half cells, the segment leaves row `row` at ((2·row + 1)·dx − dy) / dy.
        let mut leaves = Quotients::new(x - y, 2 * x, 2 * y);
        for row in 0..=d.y {
            let (last, corner) = if row == d.y { (d.x, false) } else { (leaves.ceil(), leaves.rest == 0) };
            let widened = corner && rule == CornerRule::Never;
            let next = last + i32::from(corner);
            let free = Demand::Free { row, first, last: if widened { next } else { last } };
            let touched = Demand::EitherFree([(next, row), (last, row + 1)]);
            if !demand(free) || (corner && rule == CornerRule::One && !demand(touched)) {
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

    /// A move's touched cells form a chain in which neighbors share an edge, except where it cuts a corner between two
    /// blocked cells.
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

    /// Row j of cells spans the heights j to j + 1. Along an axis, one of the two cells beside each edge must be free.
    fn sweep(rule: DiagonalGap, d: Vector, mut demand: impl FnMut(Demand) -> bool) -> bool {
        if d.y == 0 {
            return (0..d.x).all(|i| demand(Demand::EitherFree([(i, 0), (i, -1)])));
        }
        let mut first = 0;
        let (x, y) = (i64::from(d.x), i64::from(d.y));
        let mut end = Quotients::new(x, x, y);
        for row in 0..d.y {
            let (last, vertex) = (end.ceil() - 1, end.rest == 0 && row + 1 < d.y);
            if !demand(Demand::Free { row, first, last }) {
                return false;
            }
            let gap = Demand::EitherFree([(last + 1, row), (last, row + 1)]);
            if vertex && rule == DiagonalGap::Closed && !demand(gap) {
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

    /// The corners of a free cell are joined along its edges; a shared corner joins two cells unless gaps are closed.
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

    fn closes_gaps(rule: DiagonalGap) -> bool {
        rule == DiagonalGap::Closed
    }
}

/// The four cells that meet at a corner vertex. Wrapping: a query's vertex may be anywhere, and what lies outside the map is
/// blocked on both ends.
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
    /// With step ≥ 0 and by > 0.
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
