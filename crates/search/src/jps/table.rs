//! Precomputed jump distances (JPS+: Harabor & Grastien 2014, 'Improving Jump Point Search'), for k ≤ 3.
//!
//! **One byte for each vertex and even move**, so that the entries of a vertex are one word of 4 bytes at
//! k = 3 (2 bytes at k = 2). Bit 7 says whether the axial jump ends at a jump point or dead; the other bits
//! say after how many steps. 127 stands for more than 126: the jump goes on after 126 steps, where the entry
//! gives the rest.
//!
//! Diagonal jumps are those of [`BlockJps`](crate::BlockJps), by bit planes of twelve bits a vertex: they say
//! from which vertex which axial jump leads on. With a byte for each odd move in their place a table takes 8
//! bytes a vertex instead of 5.5, and a search 0.97 of the time.
//!
//! Jumps pass [dead ends](super::dead_ends), if there are any, but near the goal they do not. There axial
//! jumps are scanned as those of [`BlockJps`](crate::BlockJps), by bit planes of one more byte a vertex.
//!
//! Rule variants: all five. Under closed gaps a jump ends before a gap. The table does not say what paths do
//! at gaps: where they begin or end at one, and at k = 2 where they pass one.

use mediant_grid::{GridGraph, Identity, Mismatch, Placement, Step, Vector, Vertex, VertexId};
use mediant_moves::{FiniteK, KError};

use super::{
    axial::{AxialStops, JumpPointRule},
    dead_ends::DeadEndRows,
    diagonals::DiagonalStops,
    planes::JumpPlanes,
    stop_rows::Leads,
};
use crate::canonical::Pruning;

/// The jumps of a grid graph: 5.5 bytes a vertex at k = 3, 2.75 at k = 2, and one more where jumps pass dead
/// ends. Immutable; share it between planners.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Centers, CornerRule, GridGraph};
/// use mediant_moves::FiniteK;
/// use mediant_search::{Hk, JpsPlus, JumpTable, Planner, Query};
///
/// let map = AsciiMap::parse("
///     ....
///     .##.
///     ....
/// ")?;
/// let graph = GridGraph::<Centers>::new(Arc::new(map.grid), FiniteK::new(3)?, CornerRule::Never)?;
/// let table = JumpTable::new(&graph)?;
/// // The bytes can be saved; they are checked when they come back.
/// let table = JumpTable::from_bytes(&graph, &table.to_bytes())?;
/// let mut planner = JpsPlus::new(&graph, Arc::new(table), Hk)?;
/// let outcome = planner.solve(Query::new((0, 1), (3, 1)))?;
/// assert_eq!(outcome.path().map(|path| path.cost()), Some(5.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct JumpTable {
    /// By vertex and even move: the entry of a move is at `(id · 2^k + index) / 2`.
    entries: Vec<u8>,
    diagonals: DiagonalStops,
    /// Where jumps pass dead ends: the stops of axial jumps near the goal, and how far dead ends reach.
    near_goal: Option<(AxialStops, u32)>,
    k: u32,
    identity: Identity,
}

/// Jump distances that there are not, that belong to another grid graph, or whose bytes are wrong.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum JumpError {
    /// No jump distances for this k.
    #[error("jump distances need k = 2 or 3: {0}")]
    K(#[from] KError),
    /// Something that was made for another grid graph.
    #[error(transparent)]
    Mismatch(#[from] Mismatch),
    /// Bytes that do not begin with what they belong to.
    #[error("these bytes are no jump table: they do not begin with what they belong to; build it anew")]
    Bytes,
    /// Too few or too many entries.
    #[error(
        "a jump table of {found} entries, where this graph needs {expected}: it is cut off; build it anew"
    )]
    Length {
        /// The number of entries needed: 2^(k − 1) for each vertex.
        expected: usize,
        /// The number of entries given.
        found: usize,
    },
    /// An entry that does not fit the map.
    #[error(
        "the jump table says {found:#04x} for move ({}, {}) at {at}, where this graph has {expected:#04x}: \
         the table is damaged; build it anew",
        towards.x,
        towards.y
    )]
    Entry {
        /// The vertex.
        at: Vertex,
        /// The move.
        towards: Vector,
        /// The entry that follows from the map and the entries ahead.
        expected: u8,
        /// The entry given.
        found: u8,
    },
}

/// The bit of an entry whose jump ends at a jump point.
const FOUND: u8 = 0x80;
/// The bits for the number of steps.
const STEPS: u8 = 0x7f;
/// The steps that are taken at once for an entry with [`STEPS`], of whose jump at least that many are left:
/// one less, so that its end is not passed.
const LEAP: u8 = STEPS - 1;

/// The entry of a vertex, if the next vertex of the jump is no jump point and has the entry `next`.
#[inline]
const fn extended(next: u8) -> u8 {
    if next & STEPS >= LEAP { next | STEPS } else { next + 1 }
}

impl JumpTable {
    /// The largest k that has a table.
    pub const MAX_K: u32 = 3;

    /// Computes the table of a grid graph; each entry follows from the entry one step ahead.
    ///
    /// # Errors
    /// [`KError::TooLarge`] above [`MAX_K`](Self::MAX_K).
    pub fn new<P: Placement>(graph: &GridGraph<P>) -> Result<Self, KError> {
        checked(graph.k())?;
        let pruning = &Pruning::new(graph);
        if JumpPlanes::may_have_dead_ends(graph) {
            return Ok(Self::from_planes(graph, JumpPlanes::new(graph, pruning)?));
        }
        // Without what only dead ends need.
        let dead_ends = DeadEndRows::default();
        let diagonals = DiagonalStops::new(graph, pruning, [&Leads::new(graph, &dead_ends); 2]);
        Ok(Self::from_parts(graph, diagonals, &dead_ends, None))
    }

    pub(super) fn from_planes<P: Placement>(graph: &GridGraph<P>, planes: JumpPlanes) -> Self {
        let JumpPlanes { axial, diagonals, dead_ends, reach } = planes;
        Self::from_parts(graph, diagonals, &dead_ends, (reach > 0).then_some((axial, reach)))
    }

    fn from_parts<P: Placement>(
        graph: &GridGraph<P>,
        diagonals: DiagonalStops,
        dead_ends: &DeadEndRows,
        near_goal: Option<(AxialStops, u32)>,
    ) -> Self {
        let mut entries = vec![0; entry_count(graph.vertex_count(), graph.k().get())];
        for index in (0..graph.steps().len()).step_by(2) {
            fill(&mut entries, graph, index, dead_ends);
        }
        Self { entries, diagonals, near_goal, k: graph.k().get(), identity: graph.identity() }
    }

    /// The version of the format of [`to_bytes`](Self::to_bytes).
    pub const VERSION: u32 = 4;

    /// The table as bytes: what it belongs to, then the entries, one byte each, by vertex id and then by even
    /// move. [`from_bytes`](Self::from_bytes) reads them, and makes the rest from the map, which takes less
    /// time than reading it would.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        [&self.identity.to_bytes(), &*self.entries].concat()
    }

    /// The table from its bytes. Every entry is checked, so an accepted table is the one that
    /// [`new`](Self::new) computes.
    ///
    /// # Errors
    /// [`JumpError::Mismatch`] for the table of another grid graph, another [`JumpError`] for bytes that are
    /// no table.
    pub fn from_bytes<P: Placement>(graph: &GridGraph<P>, bytes: &[u8]) -> Result<Self, JumpError> {
        let (found, bytes) = Identity::split_from(bytes).ok_or(JumpError::Bytes)?;
        found.check_equal("the jump table", ("the grid graph", graph.identity()))?;
        let expected = entry_count(graph.vertex_count(), checked(graph.k())?);
        if bytes.len() != expected {
            return Err(JumpError::Length { expected, found: bytes.len() });
        }
        let table = Self::new(graph)?;
        let differs = table.entries.iter().zip(bytes).position(|(expected, found)| expected != found);
        if let Some(place) = differs {
            let moves = 1 << (table.k - 1);
            let (at, index) = (graph.vertex(VertexId((place / moves) as u32)), place % moves * 2);
            let (expected, found) = (table.entries[place], bytes[place]);
            return Err(JumpError::Entry { at, towards: graph.step(index).vector(), expected, found });
        }
        Ok(table)
    }

    /// What it belongs to: the map, the rules of motion and the k of its grid graph.
    #[must_use]
    pub const fn identity(&self) -> Identity {
        self.identity
    }

    /// After how many steps the axial jump by a move ends, and whether that is at a jump point. `step` is the
    /// even move `index` of the grid graph.
    #[inline]
    pub(crate) fn jump(&self, id: VertexId, step: &Step, index: usize) -> (u32, bool) {
        let at = (id.index() << self.k | index) >> 1;
        let entry = self.entries.get(at).copied().unwrap_or(0);
        if entry & STEPS == STEPS {
            return self.long_jump(at, step);
        }
        (u32::from(entry & STEPS), entry & FOUND != 0)
    }

    /// [`jump`](Self::jump) from the vertex of an entry that does not say it all.
    #[cold]
    fn long_jump(&self, mut at: usize, step: &Step) -> (u32, bool) {
        // A step adds to every id what it adds to 0.
        let offset = step.target(VertexId(0)).0 as i32 as isize;
        let stride = (offset * isize::from(LEAP)) << (self.k - 1);
        let (mut entry, mut steps) = (STEPS, 0);
        while entry & STEPS == STEPS {
            steps += u32::from(LEAP);
            at = at.wrapping_add_signed(stride);
            entry = self.entries.get(at).copied().unwrap_or(0);
        }
        (steps + u32::from(entry & STEPS), entry & FOUND != 0)
    }

    /// Where jumps pass dead ends: the stops of axial jumps near the goal, and how far dead ends reach.
    #[inline]
    pub(super) const fn near_goal(&self) -> Option<&(AxialStops, u32)> {
        self.near_goal.as_ref()
    }

    /// Where diagonal jumps stop.
    #[inline]
    pub(crate) const fn diagonals(&self) -> &DiagonalStops {
        &self.diagonals
    }

    /// The memory that the table of a grid graph with k ≤ 3 uses at most, in bytes.
    #[must_use]
    pub fn bytes<P: Placement>(graph: &GridGraph<P>) -> usize {
        let entries = entry_count(graph.vertex_count(), graph.k().get());
        let near_goal = if JumpPlanes::may_have_dead_ends(graph) { AxialStops::bytes(graph) } else { 0 };
        entries.saturating_add(DiagonalStops::bytes(graph)).saturating_add(near_goal)
    }

    /// The memory used, in bytes.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        let near_goal = self.near_goal.as_ref().map_or(0, |(axial, _)| axial.memory_bytes());
        self.entries.len() + self.diagonals.memory_bytes() + near_goal
    }
}

const fn checked(k: FiniteK) -> Result<u32, KError> {
    let (k, max) = (k.get(), JumpTable::MAX_K);
    if k > max { Err(KError::TooLarge { k, max }) } else { Ok(k) }
}

/// The number of entries; on 32-bit targets, for maps too large for a table, more than can be allocated.
const fn entry_count(vertices: usize, k: u32) -> usize {
    vertices.saturating_mul(1 << (k - 1))
}

/// Computes the entries of an even move, 64 vertices at a time, each after the one that lies ahead.
fn fill<P: Placement>(entries: &mut [u8], graph: &GridGraph<P>, index: usize, dead_ends: &DeadEndRows) {
    let (width, height) = P::vertices(graph.grid());
    let (v, rows, rule) = (graph.step(index).vector(), graph.grid().rows(), JumpPointRule::of(graph));
    let (moves, quarter) = (graph.steps().len() / 2, index >> (graph.k().get() - 2));
    let ascends = v.x + v.y > 0;
    // Whether a row, or the words of one, are gone through from the last on.
    let in_order = |i: u32, count: u32| if ascends { count - 1 - i } else { i };
    let stride = (v.y as isize * width as isize + v.x as isize) * moves as isize;
    for y in (0..height).map(|i| in_order(i, height)) {
        let ahead = y as i32 + v.y;
        if !(0..height as i32).contains(&ahead) {
            continue;
        }
        for word in (0..width.div_ceil(64)).map(|i| in_order(i, width.div_ceil(64))) {
            let first = word * 64;
            let next = (first as i32 + v.x, ahead);
            let ends = rule.ends_in_row::<P>(rows, next, v);
            let jump = ends.jump & !dead_ends.in_row(quarter, next);
            let count = (width - first).min(64);
            for bit in (0..count).map(|i| in_order(i, count)) {
                let x = first + bit;
                if !(0..width as i32).contains(&(x as i32 + v.x)) {
                    continue;
                }
                let place = (y as usize * width as usize + x as usize) * moves + index / 2;
                let is = |bits: u64| bits >> bit & 1 == 1;
                entries[place] = match (is(ends.dead), is(jump)) {
                    (true, _) => 0,
                    (false, true) => FOUND | 1,
                    (false, false) => extended(entries[place.wrapping_add_signed(stride)]),
                };
            }
        }
    }
}
