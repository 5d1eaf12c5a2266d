//! The search graph: the vertices of one placement of a grid, joined by the legal moves of N(k).

use std::sync::Arc;

use mediant_moves::{Cost, CostTable, K, KError, Neighborhood, Vector};

use crate::{
    BitMatrix, Components, Demand, Grid, Place, Rules, Vertex, VertexId, line_of_sight, sight::Frame,
    tree::Octant,
};

/// One move of N(k), with what a search wants of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// Its length.
    pub cost: Cost,
    /// What it adds to the number of a vertex.
    offset: i32,
    dx: i16,
    dy: i16,
}

impl Step {
    /// The move itself.
    #[must_use]
    #[inline]
    pub const fn vector(&self) -> Vector {
        Vector::new(self.dx as i32, self.dy as i32)
    }

    /// The vertex that the move leads to from `id`, where it is legal.
    #[must_use]
    #[inline]
    pub const fn target(&self, id: VertexId) -> VertexId {
        VertexId(id.0.wrapping_add_signed(self.offset))
    }

    /// The vertex that the move leads to from `id` when it is taken `times` times, where that is legal.
    #[must_use]
    #[inline]
    pub const fn target_after(&self, id: VertexId, times: u32) -> VertexId {
        VertexId(id.0.wrapping_add_signed(self.offset.wrapping_mul(times as i32)))
    }

    /// The vertex that the move came from when it led to `id`.
    #[must_use]
    #[inline]
    pub const fn source(&self, id: VertexId) -> VertexId {
        VertexId(id.0.wrapping_add_signed(-self.offset))
    }
}

/// The search graph of a grid: placement `P`, its rule of motion, N(k). Immutable; planners share it.
///
/// No edge is stored. A vertex's legal moves are found when it is expanded: those of N(3) by a table over the pattern of
/// cells around it, the others by the octants' trees of mediants (module `tree`).
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Corners, DiagonalGap, Lattice, Vertex};
/// use mediant_moves::K;
/// let map = AsciiMap::parse("
///     ..
///     .#
/// ")?;
/// let lattice = Lattice::<Corners>::new(Arc::new(map.grid), K::new(4)?, DiagonalGap::Open)?;
/// // Of the moves from (1, 1), only those through the blocked cell to the lower right are missing.
/// assert_eq!(lattice.legal_moves(Vertex::new(1, 1)).len(), 16 - 1 - 2 - 6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Lattice<P: Place> {
    grid: Arc<Grid>,
    k: K,
    rule: P::Rule,
    width: u32,
    height: u32,
    steps: Box<[Step]>,
    costs: CostTable,
    /// For each pattern of cells around a vertex, the legal moves of N(min(k, 3)).
    near: Box<[u8]>,
    octants: Box<[Octant]>,
    /// The vertices that no path may pass, if there are any.
    gaps: Option<BitMatrix>,
    components: Components,
}

impl<P: Place> Lattice<P> {
    /// The largest k of a search graph: 4,096 moves, of up to 89 cells.
    pub const MAX_K: u32 = 12;

    /// The search graph of `grid` under `rule` and N(k).
    ///
    /// # Errors
    /// [`KError::TooLarge`] above [`MAX_K`](Self::MAX_K).
    pub fn new(grid: Arc<Grid>, k: K, rule: P::Rule) -> Result<Self, KError> {
        if k.get() > Self::MAX_K {
            return Err(KError::TooLarge { k: k.get(), max: Self::MAX_K });
        }
        let (width, height) = P::vertices(&grid);
        let moves: Vec<Vector> = Neighborhood::new(k)?.iter().collect();
        let steps = moves.iter().map(|&v| Step {
            cost: Cost::of_move(v),
            offset: v.y * width as i32 + v.x,
            dx: v.x as i16,
            dy: v.y as i16,
        });
        Ok(Self {
            steps: steps.collect(),
            costs: CostTable::new(k)?,
            near: (0..P::PATTERNS).map(|pattern| near_moves::<P>(rule, k, &moves, pattern)).collect(),
            octants: octants::<P>(rule, &moves, &grid),
            gaps: P::closes_gaps(rule).then(|| double_corners(&grid)).flatten(),
            components: Components::new(&grid, P::connectivity(rule, k)),
            grid,
            k,
            rule,
            width,
            height,
        })
    }

    /// The map.
    #[must_use]
    pub const fn grid(&self) -> &Arc<Grid> {
        &self.grid
    }

    /// The k of the neighborhood.
    #[must_use]
    pub const fn k(&self) -> K {
        self.k
    }

    /// The rule of motion.
    #[must_use]
    pub const fn rule(&self) -> P::Rule {
        self.rule
    }

    /// Placement and rule as a value.
    #[must_use]
    pub fn rules(&self) -> Rules {
        P::rules(self.rule)
    }

    /// The moves of N(k) in the order of [`Neighborhood`]: a move's index is its place here.
    #[must_use]
    pub const fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// The move at an index that this lattice handed out.
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

    /// The number of vertices, free or not; ids are below it.
    #[must_use]
    pub const fn vertex_count(&self) -> usize {
        self.width as usize * self.height as usize
    }

    /// The id of a vertex; `None` outside the map.
    #[must_use]
    pub const fn id(&self, at: Vertex) -> Option<VertexId> {
        if at.x as u32 >= self.width || at.y as u32 >= self.height {
            return None;
        }
        Some(VertexId(at.y as u32 * self.width + at.x as u32))
    }

    /// The vertex with this id.
    #[must_use]
    #[inline]
    pub const fn vertex(&self, id: VertexId) -> Vertex {
        Vertex::new((id.0 % self.width) as i32, (id.0 / self.width) as i32)
    }

    /// Whether a path may stand on this vertex; false outside the map.
    #[must_use]
    pub fn is_free(&self, at: Vertex) -> bool {
        P::is_free(&self.grid, at)
    }

    /// Whether a path leads from one free vertex to another, in constant time.
    #[must_use]
    pub fn connected(&self, from: Vertex, to: Vertex) -> bool {
        if from == to {
            return self.is_free(from);
        }
        let component = |at| {
            let free = self.is_free(at);
            free.then(|| self.components.of(P::representative(&self.grid, self.rule, at))).flatten()
        };
        component(from).is_some_and(|label| component(to) == Some(label))
    }

    /// The memory that this takes beyond the map, in bytes: mostly four a cell for the components.
    #[must_use]
    pub fn index_bytes(&self) -> usize {
        let octants: usize = self.octants.iter().map(Octant::bytes).sum();
        let gaps = self.gaps.as_ref().map_or(0, |gaps| size_of_val(gaps.words()));
        size_of_val(&*self.steps) + size_of_val(&*self.near) + octants + gaps + self.components.bytes()
    }

    /// The components of the cells that [`connected`](Self::connected) looks up.
    #[must_use]
    pub const fn components(&self) -> &Components {
        &self.components
    }

    /// Whether `v` is a move of N(k) and legal at `at`. For a vertex of its own; for all moves of a vertex see
    /// [`legal_moves`](Self::legal_moves).
    #[must_use]
    pub fn is_legal(&self, at: Vertex, v: Vector) -> bool {
        let known = Neighborhood::new(self.k).is_ok_and(|moves| moves.contains(v));
        known && self.id(at).is_some() && self.sees(at, at + v)
    }

    /// Whether the straight segment between two vertices obeys the rules of motion; see [`line_of_sight`].
    #[must_use]
    pub fn sees(&self, from: Vertex, to: Vertex) -> bool {
        line_of_sight::<P>(&self.grid, self.rule, from, to)
    }

    /// All legal moves at a free vertex, as a bit set over their indices; empty for any other vertex.
    #[must_use]
    pub fn legal_moves(&self, at: Vertex) -> MoveSet {
        let mut set = MoveSet { words: [0; MoveSet::WORDS] };
        if self.is_free(at) {
            self.for_each_legal_move(at, |index| set.words[index / 64] |= 1 << (index % 64));
        }
        set
    }

    /// Calls `legal` with the index of each legal move at a free vertex: those of N(3), then octant by octant. Outside the
    /// map there are none; at a blocked vertex it calls as if the vertex were free.
    #[inline]
    pub fn for_each_legal_move(&self, at: Vertex, mut legal: impl FnMut(usize)) {
        if self.id(at).is_none() {
            return;
        }
        let rows = self.grid.rows();
        let (words, bit) = (rows.words(), rows.index(at.x, at.y));
        let mut near = self.near[P::pattern(words, bit, rows.bits_per_row())];
        let spread = self.k.get().saturating_sub(3);
        while near != 0 {
            legal((near.trailing_zeros() as usize) << spread);
            near &= near - 1;
        }
        for octant in &self.octants {
            if octant.transposed {
                let columns = self.grid.columns();
                octant.for_each_legal(columns, columns.index(at.y, at.x), &mut legal);
            } else {
                octant.for_each_legal(rows, bit, &mut legal);
            }
        }
    }

    /// Calls `step` with the index of each move that a path to `goal` may take from `from`: the legal ones, less those that
    /// would break the gap rule. `arrived_by` is the move by which the path reached `from`, `None` at its start.
    #[inline]
    pub fn for_each_successor(
        &self,
        from: Vertex,
        arrived_by: Option<usize>,
        goal: Vertex,
        mut step: impl FnMut(usize),
    ) {
        if !self.has_gaps() {
            return self.for_each_legal_move(from, step);
        }
        self.for_each_legal_move(from, |index| {
            if self.may_step(from, arrived_by, index, goal) {
                step(index);
            }
        });
    }

    /// Whether no path passes `at` because two blocked cells meet there diagonally, under
    /// [`DiagonalGap::Closed`](crate::DiagonalGap::Closed).
    #[must_use]
    #[inline]
    pub fn is_gap(&self, at: Vertex) -> bool {
        self.gaps.as_ref().is_some_and(|gaps| gaps.get(at.x, at.y))
    }

    /// Whether there is any [gap](Self::is_gap).
    #[must_use]
    #[inline]
    pub const fn has_gaps(&self) -> bool {
        self.gaps.is_some()
    }

    /// Whether a path to `goal` that arrived `from` by the one move may go on by the legal move `index`: false only where that would
    /// pass a [gap](Self::is_gap).
    #[must_use]
    #[inline]
    pub fn may_step(&self, from: Vertex, arrived_by: Option<usize>, index: usize, goal: Vertex) -> bool {
        match &self.gaps {
            None => true,
            Some(gaps) => {
                self.may_leave(gaps, from, arrived_by, index) && self.may_enter(gaps, from, index, goal)
            }
        }
    }

    /// [`DiagonalGap::Closed`](crate::DiagonalGap::Closed): a path that starts at a gap leaves it through the quadrant of
    /// its own cell, and one that came there by an edge goes on within the free cell beside that edge.
    #[inline]
    fn may_leave(&self, gaps: &BitMatrix, from: Vertex, arrived_by: Option<usize>, index: usize) -> bool {
        if !gaps.get(from.x, from.y) {
            return true;
        }
        let v = self.steps[index].vector();
        let Some(arrived_by) = arrived_by else { return self.is_in_own_quadrant(from, v) };
        let back = -self.steps[arrived_by].vector();
        let quadrants = [(1, 1), (1, -1), (-1, 1), (-1, -1)];
        quadrants.iter().any(|&(sx, sy)| {
            let within = |v: Vector| v.x * sx >= 0 && v.y * sy >= 0;
            self.grid.is_free(from.x + (sx - 1) / 2, from.y + (sy - 1) / 2) && within(v) && within(back)
        })
    }

    /// [`DiagonalGap::Closed`](crate::DiagonalGap::Closed): a gap is entered only where the path ends, through the quadrant
    /// of its own cell. At k = 2 also in passing: with only axis moves, from one corner of a cell to the opposite one, there may
    /// be no other way than along its edges. (With diagonal moves a path that stays in one quadrant of a gap is never
    /// shorter than one past it.)
    #[inline]
    fn may_enter(&self, gaps: &BitMatrix, from: Vertex, index: usize, goal: Vertex) -> bool {
        let v = self.steps[index].vector();
        let to = from + v;
        if !gaps.get(to.x, to.y) {
            return true;
        }
        if to == goal { self.is_in_own_quadrant(to, -v) } else { self.k == K::FOUR_CONNECTED }
    }

    fn is_in_own_quadrant(&self, at: Vertex, v: Vector) -> bool {
        v.x >= 0 && v.y >= 0 && self.grid.is_free(at.x, at.y)
    }
}

/// A set of moves of one neighborhood, by index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MoveSet {
    words: [u64; Self::WORDS],
}

impl MoveSet {
    /// Room for the moves of the largest k.
    const WORDS: usize = (1 << Lattice::<crate::Centers>::MAX_K) / 64;

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

    /// The indices in the set, ascending.
    pub fn iter(&self) -> impl Iterator<Item = usize> {
        self.words.iter().zip((0..).step_by(64)).flat_map(|(&word, base)| {
            let bits = std::iter::successors(Some(word), |rest| Some(rest & rest.wrapping_sub(1)));
            bits.take_while(|&rest| rest != 0).map(move |rest| base + rest.trailing_zeros() as usize)
        })
    }
}

/// The legal moves of N(min(k, 3)) at a vertex around which the cells form this pattern, one bit each.
fn near_moves<P: Place>(rule: P::Rule, k: K, moves: &[Vector], pattern: usize) -> u8 {
    let near = moves.iter().step_by(1 << k.get().saturating_sub(3));
    near.enumerate().fold(0, |set, (bit, &v)| {
        let (frame, d) = Frame::of(v);
        let blocked = |i, j| {
            let (along, across) = frame.cell::<P>(i, j);
            let (dx, dy) = if frame.transposed { (across, along) } else { (along, across) };
            P::pattern_is_blocked(pattern, dx, dy)
        };
        let legal = P::sweep(rule, d, |demand| match demand {
            Demand::Free { row, first, last } => (first..=last).all(|column| !blocked(column, row)),
            Demand::EitherFree(cells) => cells.iter().any(|&(column, row)| !blocked(column, row)),
        });
        set | u8::from(legal) << bit
    })
}

/// The trees over the moves beyond N(3); none up to k = 3.
fn octants<P: Place>(rule: P::Rule, moves: &[Vector], grid: &Grid) -> Box<[Octant]> {
    let size = moves.len() / 8;
    let between = moves.chunks_exact(size.max(1)).zip((0..).step_by(size.max(1))).filter(|_| size > 1);
    between.map(|(moves, first)| Octant::new::<P>(rule, &moves[1..], first + 1, grid)).collect()
}

/// Which corner vertices are doubly blocked; `None` when there are none.
fn double_corners(grid: &Grid) -> Option<BitMatrix> {
    let mut gaps = BitMatrix::filled(grid.width() + 1, grid.height() + 1, false);
    let mut any = false;
    for y in 1..grid.height() {
        for x in 1..grid.width() {
            if grid.is_double_corner(Vertex::new(x as i32, y as i32)) {
                gaps.set(x, y, true);
                any = true;
            }
        }
    }
    any.then_some(gaps)
}
