//! The search graph: the vertices of one placement of a grid, joined by the legal moves of N(k).

use std::{ops::Deref, sync::Arc};

use mediant_moves::{Cost, CostTable, FiniteK, KError, Neighborhood, Vector};

use crate::{
    BitMatrix, FreeSpace, Grid, Identity, Placement, Vertex, VertexId,
    per_motion::{self, cost_table},
    tables::Tables,
    tree::Octant,
};

/// A move of N(k) with its cost and its effect on vertex ids.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// Its length.
    pub cost: Cost,
    /// The difference between the ids of the vertices where it ends and starts.
    offset: i32,
    dx: i16,
    dy: i16,
}

impl Step {
    /// A move on a map with so many columns of vertices.
    const fn new(v: Vector, cost: Cost, width: u32) -> Self {
        Self { cost, offset: v.y * width as i32 + v.x, dx: v.x as i16, dy: v.y as i16 }
    }

    /// The move itself.
    #[must_use]
    #[inline]
    pub const fn vector(&self) -> Vector {
        Vector::new(self.dx as i32, self.dy as i32)
    }

    /// The vertex where the move leads from `id`, if it is legal.
    #[must_use]
    #[inline]
    pub const fn target(&self, id: VertexId) -> VertexId {
        VertexId(id.0.wrapping_add_signed(self.offset))
    }

    /// The vertex where `times` repetitions of the move lead from `id`, if they are legal.
    #[must_use]
    #[inline]
    pub const fn target_after(&self, id: VertexId, times: u32) -> VertexId {
        VertexId(id.0.wrapping_add_signed(self.offset.wrapping_mul(times as i32)))
    }

    /// The vertex where the move started if it led to `id`.
    #[must_use]
    #[inline]
    pub const fn source(&self, id: VertexId) -> VertexId {
        VertexId(id.0.wrapping_add_signed(-self.offset))
    }
}

/// The search graph of a grid: its vertices under placement `P` and a rule of motion, joined by the legal
/// moves of N(k). It never changes, and planners share it.
///
/// No edge is stored. The legal moves of a vertex are found when it is expanded: those of N(3) in a table
/// over the pattern of cells around it, the others by a tree of mediants for each octant (module `tree`).
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Corners, DiagonalGap, GridGraph, Vertex};
/// use mediant_moves::FiniteK;
/// let map = AsciiMap::parse("
///     ..
///     .#
/// ")?;
/// let graph = GridGraph::<Corners>::new(Arc::new(map.grid), FiniteK::new(4)?, DiagonalGap::Open)?;
/// // Of the moves from (1, 1), only those through the blocked cell to the lower right are missing.
/// assert_eq!(graph.legal_moves(Vertex::new(1, 1)).len(), 16 - 1 - 2 - 6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct GridGraph<P: Placement> {
    space: FreeSpace<P>,
    k: FiniteK,
    steps: Box<[Step]>,
    costs: CostTable,
    /// For each pattern of cells around a vertex, the legal moves of N(min(k, 3)).
    short: &'static [u8],
    octants: Arc<[Octant]>,
}

/// The free space, which no k changes: the map, vertices, sight, gaps, components.
impl<P: Placement> Deref for GridGraph<P> {
    type Target = FreeSpace<P>;

    #[inline]
    fn deref(&self) -> &FreeSpace<P> {
        &self.space
    }
}

impl<P: Placement> GridGraph<P> {
    /// The largest k of a search graph: 4,096 moves, up to 89 cells long along an axis.
    pub const MAX_K: u32 = per_motion::MAX_K;

    /// The search graph of `grid` under `rule` and N(k).
    ///
    /// # Errors
    /// [`KError::TooLarge`] above [`MAX_K`](Self::MAX_K).
    pub fn new(grid: Arc<Grid>, k: FiniteK, rule: P::Rule) -> Result<Self, KError> {
        Self::check_k(k)?;
        Self::of(FreeSpace::for_k(grid, rule, k.into()), k)
    }

    /// The search graph of N(k) in a free space, which the two then share.
    ///
    /// # Errors
    /// [`KError::TooLarge`] above [`MAX_K`](Self::MAX_K).
    pub fn in_space(space: &FreeSpace<P>, k: FiniteK) -> Result<Self, KError> {
        Self::check_k(k)?;
        Self::of(space.serving(k), k)
    }

    const fn check_k(k: FiniteK) -> Result<(), KError> {
        if k.get() > Self::MAX_K {
            return Err(KError::TooLarge { k: k.get() as u64, max: Self::MAX_K });
        }
        Ok(())
    }

    /// Tables that depend on the rules and k alone are those of the process.
    fn of(space: FreeSpace<P>, k: FiniteK) -> Result<Self, KError> {
        let (grid, tables) = (space.grid(), Tables::of::<P>(space.rule(), k)?);
        let (width, _) = P::vertices(grid);
        Ok(Self {
            steps: tables.moves().iter().map(|&(v, cost)| Step::new(v, cost, width)).collect(),
            costs: cost_table(k)?.clone(),
            short: tables.short(),
            octants: tables.octants::<P>([grid.rows(), grid.columns()].map(BitMatrix::bits_per_row)),
            space,
            k,
        })
    }

    /// The identity: its map, rules and k.
    #[must_use]
    pub fn identity(&self) -> Identity {
        Identity { k: Some(self.k.into()), ..self.space.identity() }
    }

    /// The k of the neighborhood.
    #[must_use]
    pub const fn k(&self) -> FiniteK {
        self.k
    }

    /// The moves of N(k), by index: in the order of [`Neighborhood`].
    #[must_use]
    pub const fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// The move with this index.
    ///
    /// # Panics
    /// If there is none: indices are below 2^k.
    #[must_use]
    #[inline]
    pub fn step(&self, index: usize) -> &Step {
        &self.steps[index]
    }

    /// The costs of the moves, and h_k.
    #[must_use]
    pub const fn costs(&self) -> &CostTable {
        &self.costs
    }

    /// The memory used beyond the map, in bytes: mostly that of the components. With it count the tables
    /// that the graphs of the process share.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        let octants: usize = self.octants.iter().map(Octant::memory_bytes).sum();
        size_of_val(&*self.steps) + size_of_val(self.short) + octants + self.space.memory_bytes()
    }

    /// Whether `v` is a move of N(k) and legal at `at`. To test all moves of a vertex,
    /// [`legal_moves`](Self::legal_moves) is faster.
    #[must_use]
    pub fn is_legal(&self, at: Vertex, v: Vector) -> bool {
        let known = Neighborhood::new(self.k).is_ok_and(|moves| moves.contains(v));
        known && self.id(at).is_some() && self.sees(at, at + v)
    }

    /// The legal moves at a free vertex, as a set of their indices; the empty set for any other vertex.
    #[must_use]
    pub fn legal_moves(&self, at: Vertex) -> MoveSet {
        let mut set = MoveSet { words: [0; MoveSet::WORDS] };
        if self.is_free(at) {
            self.for_each_legal_move(at, |index| set.words[index / 64] |= 1 << (index % 64));
        }
        set
    }

    /// Calls `legal` with the index of each legal move at a free vertex: first those of N(3), then octant by
    /// octant. Outside the map there are none. At a vertex that is blocked, the result has no meaning.
    #[inline]
    pub fn for_each_legal_move(&self, at: Vertex, mut legal: impl FnMut(usize)) {
        if self.id(at).is_none() {
            return;
        }
        let rows = self.grid().rows();
        let (words, bit) = (rows.words(), rows.index(at.x, at.y));
        let mut short = self.short[P::pattern(words, bit, rows.bits_per_row())];
        // Between two neighbors of N(3), N(k) has 2^(k − 3) − 1 moves more.
        let shift = self.k.get().saturating_sub(3);
        while short != 0 {
            legal((short.trailing_zeros() as usize) << shift);
            short &= short - 1;
        }
        for octant in &*self.octants {
            if octant.transposed {
                let columns = self.grid().columns();
                octant.for_each_legal(columns, columns.index(at.y, at.x), &mut legal);
            } else {
                octant.for_each_legal(rows, bit, &mut legal);
            }
        }
    }

    /// Calls `step` with the index of each move that a path to `goal` may take from `from`: the legal moves,
    /// without those that [closed gaps](FreeSpace::is_closed_gap) forbid. `arrived_by` is the index of the
    /// move by which the path reached `from`, `None` at its start.
    #[inline]
    pub fn for_each_successor(
        &self,
        from: Vertex,
        arrived_by: Option<usize>,
        goal: Vertex,
        mut step: impl FnMut(usize),
    ) {
        if !self.has_closed_gaps() {
            return self.for_each_legal_move(from, step);
        }
        self.for_each_legal_move(from, |index| {
            if self.may_step(from, arrived_by, index, goal) {
                step(index);
            }
        });
    }

    /// Whether a path to `goal` that reached `from` by the move `arrived_by` may go on by the legal move
    /// `index`: false only where it would pass through a [closed gap](FreeSpace::is_closed_gap). Both moves
    /// are indices of this graph; `arrived_by` is `None` at the start of the path.
    #[must_use]
    #[inline]
    pub fn may_step(&self, from: Vertex, arrived_by: Option<usize>, index: usize, goal: Vertex) -> bool {
        if !self.has_closed_gaps() {
            return true;
        }
        let moved = |index: usize| self.steps[index].vector();
        let before = arrived_by.map(|by| from + -moved(by));
        let to = from + moved(index);
        self.may_turn(before, from, Some(to)) && self.may_enter(from, to, goal)
    }

    /// A closed gap is entered only where the path ends. At k = 2 also in passing: with axis moves alone, the
    /// way from one corner of a cell to the opposite one may have to lead along the edges of the cell and
    /// past a gap. (With diagonal moves, a path that touches a gap and stays in one of its quadrants is never
    /// shorter than one that avoids the gap.)
    #[inline]
    fn may_enter(&self, from: Vertex, to: Vertex, goal: Vertex) -> bool {
        if !self.is_closed_gap(to) {
            return true;
        }
        if to == goal { self.may_turn(Some(from), to, None) } else { self.k == FiniteK::N4 }
    }
}

/// A set of moves of one neighborhood, by their indices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MoveSet {
    words: [u64; Self::WORDS],
}

impl MoveSet {
    /// Room for the moves of the largest k.
    const WORDS: usize = (1 << per_motion::MAX_K) / 64;

    /// The number of moves in the set.
    #[must_use]
    pub fn len(&self) -> usize {
        self.words.iter().map(|word| word.count_ones() as usize).sum()
    }

    /// Whether the set is empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.words.iter().all(|&word| word == 0)
    }

    /// Whether the move at this index is in the set.
    #[must_use]
    pub fn contains(&self, index: usize) -> bool {
        self.words.get(index / 64).is_some_and(|word| word >> (index % 64) & 1 == 1)
    }

    /// The indices in the set, in ascending order.
    pub fn iter(&self) -> impl Iterator<Item = usize> {
        self.words.iter().zip((0..).step_by(64)).flat_map(|(&word, base)| {
            let bits = std::iter::successors(Some(word), |rest| Some(rest & rest.wrapping_sub(1)));
            bits.take_while(|&rest| rest != 0).map(move |rest| base + rest.trailing_zeros() as usize)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Centers, CornerRule, Corners, DiagonalGap};

    /// Of two maps with as many words a row and a column, and of a third with more.
    fn graphs<P: Placement>(rule: P::Rule, k: u32) -> [GridGraph<P>; 3] {
        let k = FiniteK::new(k).expect("k is at least 2");
        [(4, 4), (60, 9), (70, 9)].map(|(width, height)| {
            let grid = Grid::from_fn(width, height, |x, y| (x + y) % 5 == 4).expect("a valid size");
            GridGraph::new(Arc::new(grid), k, rule).expect("k is at most 12")
        })
    }

    fn share_their_tables<P: Placement>(rules: &[P::Rule]) {
        for (&rule, k) in rules.iter().flat_map(|rule| (2..=12).map(move |k| (rule, k))) {
            let [small, other, wide] = graphs::<P>(rule, k);
            assert!(std::ptr::eq(small.short, other.short), "{rule:?}, k = {k}");
            assert!(std::ptr::eq(small.short, wide.short), "{rule:?}, k = {k}");
            // Up to k = 3 there are no masks.
            assert!(Arc::ptr_eq(&small.octants, &other.octants), "{rule:?}, k = {k}");
            assert_eq!(Arc::ptr_eq(&small.octants, &wide.octants), k <= 3, "{rule:?}, k = {k}");
        }
    }

    #[test]
    fn graphs_share_their_tables() {
        share_their_tables::<Centers>(&[CornerRule::Never, CornerRule::One, CornerRule::Always]);
        share_their_tables::<Corners>(&[DiagonalGap::Open, DiagonalGap::Closed]);
    }

    #[test]
    fn the_memory_of_a_graph_has_its_parts() {
        for graph in graphs::<Corners>(DiagonalGap::Open, 5) {
            let octants: usize = graph.octants.iter().map(Octant::memory_bytes).sum();
            let tables = size_of_val(&*graph.steps) + octants;
            assert!(octants > 0 && graph.memory_bytes() >= tables + graph.space.memory_bytes());
        }
    }
}
