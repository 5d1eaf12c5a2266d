//! A subgoal graph as bytes.
//!
//! First the [`Identity`] of the graph, 32 bytes. All else is numbers, `u32`, little endian: the code of the
//! hierarchy, the number of subgoals and the number of arcs; then, for each subgoal, twice the number of its
//! arcs, plus 1 if it belongs to the core; then, for each arc, the subgoal that it leads to and its middle
//! node (2³² − 1 for an edge). The subgoals themselves follow from the map, and the costs from the subgoals.

use std::num::NonZeroU32;

use mediant_grid::{FreeSpace, Identity, Interrupt, Interrupted, room_for, uninterrupted};
use mediant_moves::K;

use crate::{
    arc::{NONE, UpwardArc},
    edge_path::is_free,
    error::SubgoalError,
    graph::{MAX_ARCS, SubgoalGraph},
    hierarchy::Hierarchy,
    placement::{EdgeCriterion, SubgoalPlacement},
    subgoals::Subgoals,
};
use mediant_search::parts::Metric;

impl<P: SubgoalPlacement> SubgoalGraph<P> {
    /// The version of the format that [`to_bytes`](Self::to_bytes) writes.
    pub const VERSION: u32 = 5;

    /// The graph without what follows from the map, for [`from_bytes`](Self::from_bytes).
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        uninterrupted(|never| self.to_bytes_interruptible(never))
    }

    /// [`to_bytes`](Self::to_bytes), which an interrupt can stop.
    ///
    /// # Errors
    /// [`Interrupted`], with nothing kept.
    pub fn to_bytes_interruptible(&self, interrupt: &Interrupt) -> Result<Vec<u8>, Interrupted> {
        let count = self.subgoals();
        // On 32 bits this cannot overflow: in memory an arc takes three times as much.
        let length = Identity::BYTES + 4 * (3 + count + 2 * self.arcs());
        room_for::<u8>(length, Interrupted::WRITING)?;
        let mut bytes = Vec::with_capacity(length);
        bytes.extend(self.identity.to_bytes());
        let mut write = |number: u32| bytes.extend(number.to_le_bytes());
        [code(self.hierarchy()), count as u32, self.arcs() as u32].into_iter().for_each(&mut write);
        for id in 0..count as u32 {
            interrupt.check_every(1 << 16, id as usize, Interrupted::WRITING)?;
            write(2 * self.up(id).len() as u32 + u32::from(self.is_core(id)));
        }
        for (number, arc) in self.arcs.iter().enumerate() {
            interrupt.check_every(1 << 16, number, Interrupted::WRITING)?;
            write(arc.to);
            write(arc.middle);
        }
        Ok(bytes)
    }

    /// The graph that [`to_bytes`](Self::to_bytes) wrote for the same free space and k. It answers exactly as
    /// the one that was written.
    ///
    /// Whatever the bytes are, the paths of the graph are legal. But damage is not always found: `IndexFile`
    /// of `mediant-formats`, which holds them in a file, finds it.
    ///
    /// # Errors
    /// [`SubgoalError::Mismatch`] for the bytes of a graph of another map, rule of motion or k, before
    /// anything else is looked at; another [`SubgoalError`] if they are no subgoal graph of this free space.
    /// Besides the memory of the map's subgoals, reading allocates a small multiple of the length of `bytes`.
    pub fn from_bytes(space: &FreeSpace<P>, k: impl Into<K>, bytes: &[u8]) -> Result<Self, SubgoalError> {
        Self::from_bytes_interruptible(space, k, bytes, &Interrupt::NEVER)
    }

    /// [`from_bytes`](Self::from_bytes), which an interrupt can stop.
    ///
    /// # Errors
    /// As for [`from_bytes`](Self::from_bytes), and [`SubgoalError::Interrupted`].
    pub fn from_bytes_interruptible(
        space: &FreeSpace<P>,
        k: impl Into<K>,
        bytes: &[u8],
        interrupt: &Interrupt,
    ) -> Result<Self, SubgoalError> {
        let k = k.into();
        let identity = Identity { k: Some(k), ..space.identity() };
        let bytes = after_identity(bytes, identity)?;
        P::check(space, k)?;
        let metric = Metric::new(k)?;
        let marks = P::subgoals(space, interrupt)?;
        let tables = P::tables(space, &marks, interrupt)?;
        let subgoals = Subgoals::new(marks, interrupt)?;
        let (words, rest) = bytes.as_chunks::<4>();
        let mut numbers = words.iter().map(|&word| u32::from_le_bytes(word));
        let header = numbers.next().zip(numbers.next()).zip(numbers.next());
        let ((hierarchy, count), total) = header.ok_or(SubgoalError::Bytes("they are too few"))?;
        match hierarchy {
            LABELS => return Err(SubgoalError::Bytes("they are hub labels, no graph")),
            NOTHING => return Err(SubgoalError::Bytes("they say that there is no graph")),
            _ => {}
        }
        let hierarchy = named(hierarchy);
        if count as usize != subgoals.len() {
            return Err(SubgoalError::Bytes("they are for another number of subgoals"));
        }
        if !rest.is_empty() || numbers.len() as u64 != u64::from(count) + 2 * u64::from(total) {
            return Err(SubgoalError::Bytes(
                "their length does not fit the numbers of subgoals and arcs that they begin with",
            ));
        }
        if total > MAX_ARCS {
            return Err(SubgoalError::Arcs { count: total as usize, most: MAX_ARCS });
        }
        let offsets = read_offsets(&mut numbers, count, total)?;
        let arcs = read_arcs(&mut numbers, count, total, interrupt)?;
        let criterion = P::edge_criterion(k, hierarchy);
        let graph = Self { identity, subgoals, tables, metric, k, criterion, hierarchy, offsets, arcs };
        let graph = graph.with_costs(space, interrupt)?;
        if graph.edges_are_free(space, interrupt)? {
            Ok(graph)
        } else {
            Err(SubgoalError::Bytes("an obstacle is in the way of an edge"))
        }
    }

    /// Whether no obstacle is in the way of an edge.
    fn edges_are_free(&self, space: &FreeSpace<P>, interrupt: &Interrupt) -> Result<bool, Interrupted> {
        let is_free = |id: u32, arc: &UpwardArc| {
            let [from, to] = [id, arc.to].map(|id| self.subgoals.vertex(id));
            let is_free = || match self.criterion {
                EdgeCriterion::Direct => is_free(space, self.k, from, to),
                EdgeCriterion::Taut => space.sees(from, to),
            };
            arc.middle != NONE || from != to && is_free()
        };
        // Not by `edges`, which skips one direction of each edge of the core: in crafted bytes the other may
        // be missing.
        for id in 0..self.subgoals() as u32 {
            interrupt.check_every(64, id as usize, DURING)?;
            if !self.up(id).iter().all(|arc| is_free(id, arc)) {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

/// The stage that an interrupted call names.
pub(crate) const DURING: &str = "reading subgoals";

/// The bytes behind the identity with which they begin, if that is the expected one.
pub(crate) fn after_identity(bytes: &[u8], expected: Identity) -> Result<&[u8], SubgoalError> {
    let (found, rest) = Identity::split_from(bytes)
        .ok_or(SubgoalError::Bytes("they do not begin with what they belong to"))?;
    found.check_equal("the subgoal graph", ("the space", expected))?;
    Ok(rest)
}

/// Reads how many arcs each of `count` subgoals has, `total` together.
fn read_offsets(
    numbers: &mut impl Iterator<Item = u32>,
    count: u32,
    total: u32,
) -> Result<Box<[u32]>, SubgoalError> {
    room_for::<u32>(count as usize + 1, DURING)?;
    let mut offsets = Vec::with_capacity(count as usize + 1);
    let mut sum = 0_u32;
    for of in numbers.take(count as usize) {
        offsets.push(2 * sum + (of & 1));
        sum = sum
            .checked_add(of / 2)
            .filter(|&sum| sum <= total)
            .ok_or(SubgoalError::Bytes("their subgoals have more arcs than there are"))?;
    }
    if sum != total {
        return Err(SubgoalError::Bytes("their subgoals have fewer arcs than there are"));
    }
    offsets.push(2 * sum);
    Ok(offsets.into_boxed_slice())
}

/// Reads `total` arcs between `count` subgoals.
fn read_arcs(
    numbers: &mut impl Iterator<Item = u32>,
    count: u32,
    total: u32,
    interrupt: &Interrupt,
) -> Result<Box<[UpwardArc]>, SubgoalError> {
    let mut arcs = Vec::new();
    // In memory an arc takes three times as much as in the bytes, which may be more than 32 bits can address.
    room_for::<UpwardArc>(total as usize, DURING)?;
    arcs.reserve_exact(total as usize);
    while let Some((to, middle)) = numbers.next().zip(numbers.next()) {
        if to >= count || middle != NONE && middle >= count {
            return Err(SubgoalError::Bytes("an arc leads to no subgoal"));
        }
        interrupt.check_every(1 << 16, arcs.len(), DURING)?;
        arcs.push(UpwardArc::without_cost(to, middle));
    }
    Ok(arcs.into_boxed_slice())
}

/// The code of [hub labels](crate::HubLabels), which are no graph.
pub(crate) const LABELS: u32 = u32::MAX - 1;

/// The code where [nothing](crate::PreparedSubgoals::Nothing) was kept.
pub(crate) const NOTHING: u32 = u32::MAX - 2;

/// The least code of what has no number of levels.
pub(crate) const LEAST_CODE: u32 = NOTHING;

const fn code(hierarchy: Hierarchy) -> u32 {
    match hierarchy {
        Hierarchy::Contracted => 0,
        Hierarchy::Levels(levels) => levels.get(),
        Hierarchy::AllLevels => u32::MAX,
    }
}

const fn named(code: u32) -> Hierarchy {
    match NonZeroU32::new(code) {
        None => Hierarchy::Contracted,
        Some(NonZeroU32::MAX) => Hierarchy::AllLevels,
        Some(levels) => Hierarchy::Levels(levels),
    }
}
