//! Precomputed jump distances (JPS+: Harabor & Grastien 2014, 'Improving Jump Point Search'), for k ≤ 3.
//!
//! **One byte for each vertex and move**, so that the entries of a vertex are one word of 8 bytes at k = 3 (4
//! bytes at k = 2). Bit 7 says whether the jump ends at a jump point or dead; the other bits say after how
//! many steps. 127 stands for more than 126: the jump goes on after 126 steps, where the entry gives the
//! rest.
//!
//! - Even moves (axial jumps) end at a vertex with a forced successor.
//! - Odd moves (diagonal jumps) end at a vertex with a forced successor, or at an intermediate jump point,
//!   from which one of the two axial jumps beside it finds a jump point.
//!
//! Rule variants: all five. Under closed gaps a jump ends before a gap. The table does not say what paths do
//! at gaps: where they begin or end at one, and at k = 2 where they pass one.

use mediant_grid::{GridGraph, Identity, Mismatch, Placement, Step, Vector, Vertex, VertexId};
use mediant_moves::{FiniteK, KError};

use crate::canonical::Pruning;

/// The jump distances of a grid graph with k ≤ 3: 2^k bytes a vertex. Immutable; share it between planners.
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
    /// By vertex and move: the entry of a move is at `id · 2^k + index`.
    entries: Vec<u8>,
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
        /// The number of entries needed: 2^k for each vertex.
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
        let k = checked(graph.k())?;
        let mut entries = vec![0; entry_count(graph.vertex_count(), k)];
        let around = Surroundings::new(graph);
        let ids = 0..graph.vertex_count();
        // A move that increases ids depends on entries of larger ids, so these come first.
        let moves = |parity: usize, adds: bool| {
            let steps = (parity..1 << k).step_by(2);
            steps.filter(|&index| (around.offsets[index] > 0) == adds).collect::<Vec<usize>>()
        };
        // An odd move depends on the two even ones beside it, of which one may decrease ids where the odd one
        // increases them.
        around.pass(&mut entries, ids.clone().rev(), &moves(0, true));
        around.pass(&mut entries, ids.clone(), &[moves(0, false), moves(1, false)].concat());
        around.pass(&mut entries, ids.rev(), &moves(1, true));
        Ok(Self { entries, k, identity: graph.identity() })
    }

    /// The version of the format of [`to_bytes`](Self::to_bytes).
    pub const VERSION: u32 = 2;

    /// The table as bytes: what it belongs to, then the entries, one byte each, by vertex id and then by
    /// move. [`from_bytes`](Self::from_bytes) reads them.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        [&self.identity.to_bytes(), &*self.entries].concat()
    }

    /// The table from its bytes. Every entry is checked against the map and the entry one step ahead, so an
    /// accepted table is the one that [`new`](Self::new) computes.
    ///
    /// # Errors
    /// [`JumpError::Mismatch`] for the table of another grid graph, another [`JumpError`] for bytes that are
    /// no table.
    pub fn from_bytes<P: Placement>(graph: &GridGraph<P>, bytes: &[u8]) -> Result<Self, JumpError> {
        let (found, bytes) = Identity::split_from(bytes).ok_or(JumpError::Bytes)?;
        found.check_equal("the jump table", ("the grid graph", graph.identity()))?;
        let k = checked(graph.k())?;
        let expected = entry_count(graph.vertex_count(), k);
        if bytes.len() != expected {
            return Err(JumpError::Length { expected, found: bytes.len() });
        }
        let around = Surroundings::new(graph);
        for id in 0..graph.vertex_count() {
            for index in 0..1 << k {
                let (expected, found) = (around.entry(bytes, id, index), bytes[id << k | index]);
                if expected != found {
                    let (at, towards) = (graph.vertex(VertexId(id as u32)), graph.step(index).vector());
                    return Err(JumpError::Entry { at, towards, expected, found });
                }
            }
        }
        Ok(Self { entries: bytes.to_vec(), k, identity: found })
    }

    /// What it belongs to: the map, the rules of motion and the k of its grid graph.
    #[must_use]
    pub const fn identity(&self) -> Identity {
        self.identity
    }

    /// After how many steps the jump by a move ends, and whether that is at a jump point. `step` is the move
    /// `index` of the grid graph.
    #[inline]
    pub(crate) fn jump(&self, id: VertexId, step: &Step, index: usize) -> (u32, bool) {
        let mut at = id.index() << self.k | index;
        let mut entry = self.entries.get(at).copied().unwrap_or(0);
        let mut steps = 0;
        // A step adds to every id what it adds to 0.
        let offset = step.target(VertexId(0)).0 as i32 as isize;
        let stride = (offset * isize::from(LEAP)) << self.k;
        while entry & STEPS == STEPS {
            steps += u32::from(LEAP);
            at = at.wrapping_add_signed(stride);
            entry = self.entries.get(at).copied().unwrap_or(0);
        }
        (steps + u32::from(entry & STEPS), entry & FOUND != 0)
    }

    /// The memory that the table of a grid graph with k ≤ 3 uses, in bytes.
    #[must_use]
    pub fn bytes<P: Placement>(graph: &GridGraph<P>) -> usize {
        entry_count(graph.vertex_count(), graph.k().get())
    }

    /// The memory used, in bytes.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        self.entries.len()
    }
}

const fn checked(k: FiniteK) -> Result<u32, KError> {
    let (k, max) = (k.get(), JumpTable::MAX_K);
    if k > max { Err(KError::TooLarge { k, max }) } else { Ok(k) }
}

/// The number of entries; on 32-bit targets, for maps too large for a table, more than can be allocated.
const fn entry_count(vertices: usize, k: u32) -> usize {
    vertices.saturating_mul(1 << k)
}

/// What an entry depends on besides the entries ahead.
struct Surroundings {
    k: u32,
    /// By move: what it adds to an id.
    offsets: Vec<isize>,
    /// By vertex: the pattern of cells around it.
    patterns: Vec<u16>,
    /// By pattern: what it decides.
    local: Vec<PatternRule>,
}

/// What the pattern of cells around a vertex decides, one bit a move.
#[derive(Clone, Copy, Debug, Default)]
struct PatternRule {
    /// The moves that are legal there.
    legal: u8,
    /// The moves with a forced successor when they lead there.
    forced: u8,
    /// Whether it is a closed gap.
    gap: bool,
}

impl Surroundings {
    fn new<P: Placement>(graph: &GridGraph<P>) -> Self {
        let pruning = Pruning::new(graph);
        let (k, rows) = (graph.k().get(), graph.grid().rows());
        let (words, bits_per_row) = (rows.words(), rows.bits_per_row());
        let mut local: Vec<Option<PatternRule>> = vec![None; P::PATTERNS];
        let patterns = (0..graph.vertex_count()).map(|id| {
            let at = graph.vertex(VertexId(id as u32));
            let pattern = P::pattern(words, rows.index(at.x, at.y), bits_per_row);
            // The rules of motion are asked once for each pattern that occurs.
            local[pattern].get_or_insert_with(|| PatternRule {
                legal: graph.legal_moves(at).iter().fold(0, |set, index| set | 1 << index),
                forced: (0..1 << k)
                    .filter(|&index| pruning.has_forced_at(pattern, index))
                    .fold(0, |set, index| set | 1 << index),
                gap: graph.is_closed_gap(at),
            });
            pattern as u16
        });
        let patterns = patterns.collect();
        Self {
            k,
            offsets: graph.steps().iter().map(|step| step.target(VertexId(0)).0 as i32 as isize).collect(),
            patterns,
            local: local.into_iter().map(Option::unwrap_or_default).collect(),
        }
    }

    /// Computes the entries of these moves at every vertex. `ids` are ordered so that each vertex comes after
    /// those to which the moves lead.
    fn pass(&self, entries: &mut [u8], ids: impl Iterator<Item = usize>, moves: &[usize]) {
        for id in ids {
            for &index in moves {
                entries[id << self.k | index] = self.entry(entries, id, index);
            }
        }
    }

    /// The entry of a move, from the entries of the vertex to which it leads.
    #[inline]
    fn entry(&self, entries: &[u8], id: usize, index: usize) -> u8 {
        let legal = self.local[usize::from(self.patterns[id])].legal;
        if legal >> index & 1 == 0 {
            return 0;
        }
        let to = id.wrapping_add_signed(self.offsets[index]);
        let there = &self.local[usize::from(self.patterns[to])];
        if there.gap {
            return 0;
        }
        let ahead = &entries[to << self.k..(to + 1) << self.k];
        let last = ahead.len() - 1;
        let beside = (ahead[(index + 1) & last] | ahead[(index + last) & last]) & FOUND != 0;
        if there.forced >> index & 1 == 1 || (index % 2 == 1 && beside) {
            return FOUND | 1;
        }
        extended(ahead[index])
    }
}
