//! The jump table of JPS+ (Harabor & Grastien 2014, 'Improving Jump Point Search'), for k ≤ 3.
//!
//! The original stores for every vertex and each of the eight moves how far a jump leads: eight or sixteen
//! bytes a vertex. But jumps begin at jump points, and these are few. So a table holds their
//! [`lists`](super::lists), and the [`planes`](super::planes) of [`BlockJps`](crate::BlockJps), by which
//! jumps are made from the start, and where there are no lists.
//!
//! Rule variants: all five. Under closed gaps a jump ends before a gap. The table does not say what paths do
//! at gaps: where they begin or end at one, and at k = 2 where they pass one.

use mediant_grid::{Change, GridGraph, Identity, Interrupt, Interrupted, Placement, room_for, uninterrupted};
use mediant_moves::KError;

use super::{
    block_finder::BlockFinder,
    error::JumpError,
    lists::{JumpLists, Recorder},
    planes::JumpPlanes,
    repair::Stop,
};
use crate::canonical::Pruning;

/// The jumps from all jump points of a grid graph: 2.8 to 5.6 bytes a vertex on the benchmark maps at k = 3.
/// Immutable; share it between planners.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Centers, CornerRule, GridGraph};
/// use mediant_moves::FiniteK;
/// use mediant_search::{Ends, Hk, JpsPlus, JumpTable, Planner};
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
/// let answer = planner.solve(Ends::new((0, 1), (3, 1)))?;
/// assert_eq!(answer.path().map(|path| path.cost()), Some(5.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct JumpTable {
    blocks: BlockFinder,
    lists: JumpLists,
    /// Whether lists have followed a change: then a new table may have others.
    is_repaired: bool,
}

/// In the place of lists: all are found when the table is read.
const NO_LISTS: u32 = u32::MAX;

impl JumpTable {
    /// The largest k that has a table.
    pub const MAX_K: u32 = JumpPlanes::MAX_K;

    /// Finds the jumps on a grid graph.
    ///
    /// # Errors
    /// [`KError::TooLarge`] above [`MAX_K`](Self::MAX_K).
    pub fn new<P: Placement>(graph: &GridGraph<P>) -> Result<Self, KError> {
        JumpPlanes::check_k(graph)?;
        Ok(uninterrupted(|never| Self::of(graph, never)))
    }

    /// [`new`](Self::new), which an interrupt can stop; it asks for each row, and every few jump points.
    ///
    /// # Errors
    /// As for [`new`](Self::new), and [`JumpError::Interrupted`].
    pub fn interruptible<P: Placement>(
        graph: &GridGraph<P>,
        interrupt: &Interrupt,
    ) -> Result<Self, JumpError> {
        JumpPlanes::check_k(graph)?;
        Ok(Self::of(graph, interrupt)?)
    }

    fn of<P: Placement>(graph: &GridGraph<P>, interrupt: &Interrupt) -> Result<Self, Interrupted> {
        let pruning = &Pruning::interruptible(graph, interrupt)?;
        let planes = JumpPlanes::new(graph, pruning, interrupt)?;
        Self::from_planes(graph, pruning, planes, interrupt)
    }

    pub(super) fn from_planes<P: Placement>(
        graph: &GridGraph<P>,
        pruning: &Pruning<P>,
        mut planes: JumpPlanes,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let dead_ends = std::mem::take(&mut planes.dead_ends);
        let blocks = BlockFinder::with_planes(graph, planes);
        let recorder = Recorder { graph, pruning, blocks: &blocks };
        let lists = JumpLists::new(&recorder, &dead_ends, interrupt)?;
        Ok(Self { blocks, lists, is_repaired: false })
    }

    /// The table of the grid graph after a change of the map, by the pruning rule of that grid graph. It
    /// works as long as the change alters where jumps lead, and makes a new table where that would be
    /// quicker.
    ///
    /// It leads to the same costs as a new one. Whether it looks for dead ends, and whether it has lists, was
    /// decided when these were made anew. Its lists have room for those of further edits, a quarter of their
    /// words or a little more.
    ///
    /// # Errors
    /// [`JumpError::Mismatch`] if the change is not from the map of this table to that of the grid graph, or
    /// if the rule was prepared for another one, and [`JumpError::Interrupted`].
    pub fn repaired<P: Placement>(
        &self,
        graph: &GridGraph<P>,
        pruning: &Pruning<P>,
        change: &Change,
        interrupt: &Interrupt,
    ) -> Result<Self, JumpError> {
        if let Some((blocks, altered)) = self.blocks.followed(graph, pruning, change, interrupt)? {
            let recorder = Recorder { graph, pruning, blocks: &blocks };
            let lists = match self.lists.repaired(&recorder, self.blocks.axial_stops(), &altered, interrupt) {
                Ok(lists) => lists,
                Err(Stop::TooMuch) => JumpLists::anew(&recorder, interrupt)?,
                Err(Stop::Interrupted(interrupted)) => return Err(interrupted.into()),
            };
            let is_repaired = self.is_repaired || !altered.zones.is_empty();
            return Ok(Self { blocks, lists, is_repaired });
        }
        let planes = self.blocks.planes_after(graph, pruning, change, interrupt)?;
        // They may not know all dead ends, or not look for them. Those that are made when a table is read do.
        let is_repaired = planes.reach > 0 || JumpPlanes::should_have_dead_ends(graph, &planes.axial);
        Ok(Self { is_repaired, ..Self::from_planes(graph, pruning, planes, interrupt)? })
    }

    /// The version of the format of [`to_bytes`](Self::to_bytes).
    pub const VERSION: u32 = 6;

    /// The table as bytes: what it belongs to, then the lists. [`from_bytes`](Self::from_bytes) reads them,
    /// and makes the rest from the map. The bytes of a repaired table are those of no list: then it makes
    /// these as well.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        uninterrupted(|never| self.to_bytes_interruptible(never))
    }

    /// [`to_bytes`](Self::to_bytes), which an interrupt can stop.
    ///
    /// # Errors
    /// [`Interrupted`], with nothing kept.
    pub fn to_bytes_interruptible(&self, interrupt: &Interrupt) -> Result<Vec<u8>, Interrupted> {
        let mut bytes = self.identity().to_bytes().to_vec();
        if self.is_repaired {
            bytes.extend(NO_LISTS.to_le_bytes());
            return Ok(bytes);
        }
        let count = self.lists.words().count() * size_of::<u32>();
        room_for::<u8>(count + bytes.len(), Interrupted::WRITING)?;
        bytes.reserve_exact(count);
        for (number, word) in self.lists.words().enumerate() {
            interrupt.check_every(1 << 16, number, Interrupted::WRITING)?;
            bytes.extend(word.to_le_bytes());
        }
        Ok(bytes)
    }

    /// The table from its bytes. Every word is checked, so an accepted table is the one that
    /// [`new`](Self::new) makes.
    ///
    /// # Errors
    /// [`JumpError::Mismatch`] for the table of another grid graph, another [`JumpError`] for bytes that are
    /// no table.
    pub fn from_bytes<P: Placement>(graph: &GridGraph<P>, bytes: &[u8]) -> Result<Self, JumpError> {
        Self::from_bytes_interruptible(graph, bytes, &Interrupt::NEVER)
    }

    /// [`from_bytes`](Self::from_bytes), which an interrupt can stop.
    ///
    /// # Errors
    /// As for [`from_bytes`](Self::from_bytes), and [`JumpError::Interrupted`].
    pub fn from_bytes_interruptible<P: Placement>(
        graph: &GridGraph<P>,
        bytes: &[u8],
        interrupt: &Interrupt,
    ) -> Result<Self, JumpError> {
        let (found, bytes) = Identity::split_from(bytes).ok_or(JumpError::Bytes)?;
        found.check_equal("the jump table", ("the grid graph", graph.identity()))?;
        let table = Self::interruptible(graph, interrupt)?;
        if bytes == NO_LISTS.to_le_bytes() {
            return Ok(table);
        }
        let expected = table.lists.words().count() * 4;
        if bytes.len() != expected {
            return Err(JumpError::Length { expected, found: bytes.len() });
        }
        let found = bytes.as_chunks().0.iter().map(|&word| u32::from_le_bytes(word));
        let differing = table.lists.words().zip(found).enumerate().find(|(_, (is, was))| is != was);
        if let Some((place, (expected, found))) = differing {
            let (id, index) = table.lists.place_of(place);
            let (at, by) = (graph.vertex(id), graph.step(index).vector());
            return Err(JumpError::Entry { at, by, expected, found });
        }
        Ok(table)
    }

    /// The identity of its grid graph: map, rules of motion and k.
    #[must_use]
    pub const fn identity(&self) -> Identity {
        self.blocks.identity
    }

    /// The same table, to which no lists are added beyond so many words.
    #[cfg(test)]
    pub(super) fn with_list_limit(self, most: usize) -> Self {
        Self { lists: self.lists.with_limit(most), ..self }
    }

    #[inline]
    pub(super) const fn blocks(&self) -> &BlockFinder {
        &self.blocks
    }

    #[inline]
    pub(super) const fn lists(&self) -> &JumpLists {
        &self.lists
    }

    /// The memory that a new table of a grid graph with k ≤ 3 uses at most, in bytes.
    #[must_use]
    pub fn bytes<P: Placement>(graph: &GridGraph<P>) -> usize {
        BlockFinder::bytes(graph).saturating_add(JumpLists::most_bytes(graph))
    }

    /// The memory used, in bytes.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        self.blocks.memory_bytes() + self.lists.memory_bytes()
    }
}
