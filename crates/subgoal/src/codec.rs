//! A subgoal graph as bytes.
//!
//! All numbers are `u32`, little endian: the code of the hierarchy, the number of subgoals, that of arcs; for each subgoal twice the number of
//! its arcs, plus 1 if it belongs to the core; for each arc where it leads and over what (2³² − 1 for an edge). The subgoals themselves follow from
//! the map, and the costs from the subgoals.

use std::num::NonZeroU32;

use mediant_grid::FreeSpace;
use mediant_moves::{Cost, K};

use crate::{
    Hierarchy, SubgoalError, SubgoalGraph, SubgoalPlacement,
    contract::NONE,
    graph::{Step, UpwardArc},
    norm::Norm,
    placement::Edges,
    planner::is_free,
    subgoals::Subgoals,
};

impl<P: SubgoalPlacement> SubgoalGraph<P> {
    /// The version of what [`to_bytes`](Self::to_bytes) writes.
    pub const VERSION: u32 = 1;

    /// The graph without what follows from the map, for [`from_bytes`](Self::from_bytes).
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let count = self.subgoals();
        let mut numbers = Vec::with_capacity(3 + count + 2 * self.arcs());
        numbers.extend([code(self.hierarchy()), count as u32, self.arcs() as u32]);
        let of = |id| 2 * self.up(id).len() as u32 + u32::from(self.is_core(id));
        numbers.extend((0..count as u32).map(of));
        numbers.extend((0..count as u32).flat_map(|id| self.up(id)).flat_map(|arc| [arc.to, arc.mid]));
        numbers.into_iter().flat_map(u32::to_le_bytes).collect()
    }

    /// The graph that gave these bytes for the same free space and directions. It answers exactly as that one.
    ///
    /// Whatever the bytes are, the paths of what is read are legal. But whether they were made of this map and k, and are not damaged, only the
    /// file knows that holds them: see `IndexFile` of `mediant-formats`.
    ///
    /// # Errors
    /// [`SubgoalError`] for bytes that are no subgoal graph on this free space. Little more is allocated than the bytes take.
    pub fn from_bytes(space: &FreeSpace<P>, k: impl Into<K>, bytes: &[u8]) -> Result<Self, SubgoalError> {
        let k = k.into();
        P::check(space, k)?;
        let norm = Norm::new(k)?;
        let subgoals = Subgoals::new(P::prepare(space));
        let (words, rest) = bytes.as_chunks::<4>();
        let mut numbers = words.iter().map(|&word| u32::from_le_bytes(word));
        let header = numbers.next().zip(numbers.next()).zip(numbers.next());
        let ((hierarchy, count), total) = header.ok_or(SubgoalError::Bytes("they are too few"))?;
        let hierarchy = named(hierarchy);
        if count as usize != subgoals.len() {
            return Err(SubgoalError::Bytes("they are for another number of subgoals"));
        }
        if !rest.is_empty() || numbers.len() as u64 != u64::from(count) + 2 * u64::from(total) {
            return Err(SubgoalError::Bytes(
                "their number is not that of the subgoals and arcs that they tell of",
            ));
        }
        let mut offsets = Vec::with_capacity(count as usize + 1);
        let mut sum = 0_u32;
        for of in numbers.by_ref().take(count as usize) {
            offsets.push(2 * sum + (of & 1));
            sum = sum
                .checked_add(of / 2)
                .filter(|&sum| sum <= total)
                .ok_or(SubgoalError::Bytes("they tell of more arcs than there are"))?;
        }
        if sum != total {
            return Err(SubgoalError::Bytes("they tell of fewer arcs than there are"));
        }
        offsets.push(2 * sum);
        let mut arcs = Vec::with_capacity(total as usize);
        while let Some((to, mid)) = numbers.next().zip(numbers.next()) {
            if to >= count || mid != NONE && mid >= count {
                return Err(SubgoalError::Bytes("an arc leads to no subgoal"));
            }
            arcs.push(UpwardArc::to(to, mid));
        }
        let graph = Self {
            subgoals,
            norm,
            k,
            edges: P::edges(k, hierarchy),
            hierarchy,
            offsets: offsets.into_boxed_slice(),
            arcs: arcs.into_boxed_slice(),
        };
        let graph = graph.with_costs(space)?;
        let is_free = |id: u32, arc: &UpwardArc| {
            let [from, to] = [id, arc.to].map(|id| graph.subgoals.vertex(id));
            let is_free = || match graph.edges {
                Edges::Direct => is_free(space, k, from, to),
                Edges::Taut => space.sees(from, to),
            };
            arc.mid != NONE || from != to && is_free()
        };
        // Also those that are there in one direction alone, as they should not be.
        if (0..count).all(|id| graph.up(id).iter().all(|arc| is_free(id, arc))) {
            Ok(graph)
        } else {
            Err(SubgoalError::Bytes("an obstacle is in the way of an edge"))
        }
    }

    /// The same with the costs of the arcs, from the lowest subgoal up.
    pub(crate) fn with_costs(mut self, space: &FreeSpace<P>) -> Result<Self, SubgoalError> {
        let count = self.subgoals() as u32;
        let mut below = vec![0_u32; count as usize];
        for id in 0..count {
            for arc in self.up(id) {
                if self.is_core(id) && !self.is_core(arc.to) {
                    return Err(SubgoalError::Bytes("an arc leads out of the core"));
                }
                if !self.is_core(id) {
                    below[arc.to as usize] += 1;
                }
            }
        }
        let is_lowest = |id: &u32| below[*id as usize] == 0 && !self.is_core(*id);
        let mut order: Vec<u32> = (0..count).filter(is_lowest).collect();
        let mut next = 0;
        while let Some(&id) = order.get(next) {
            next += 1;
            for arc in self.up(id) {
                let below = &mut below[arc.to as usize];
                *below -= 1;
                if *below == 0 && !self.is_core(arc.to) {
                    order.push(arc.to);
                }
            }
        }
        if order.len() + self.core() != count as usize {
            return Err(SubgoalError::Bytes("some subgoals are above one another"));
        }
        // A shortest way over N(2) visits each vertex once at most, and the others are shorter. Shortcuts are not always shortest ways, but nearly. The
        // bound keeps crafted bytes, in which each shortcut has twice the length of the one below, from making paths without end.
        let most = (space.vertex_count() as u64).saturating_mul(16 << Cost::FRACTION_BITS);
        // What is over a subgoal that is lower has its cost already.
        let mut known = vec![false; count as usize];
        order.extend((0..count).filter(|&id| self.is_core(id)));
        for id in order {
            let first = (self.offsets[id as usize] / 2) as usize;
            for number in first..first + self.up(id).len() {
                let UpwardArc { to, mid, .. } = self.arcs[number];
                let way = if mid == NONE {
                    let v = self.subgoals.vertex(id).to(self.subgoals.vertex(to));
                    let step = Step::of(v);
                    UpwardArc {
                        cost: self.norm.length(v).to_bits(),
                        first: step,
                        last: step,
                        ..UpwardArc::to(to, mid)
                    }
                } else {
                    let halves = self.arc(mid, id).zip(self.arc(mid, to)).filter(|_| known[mid as usize]);
                    let (a, b) =
                        halves.ok_or(SubgoalError::Bytes("a shortcut leads over no subgoal below it"))?;
                    let cost = a.cost.checked_add(b.cost).filter(|&cost| cost <= most);
                    let cost = cost.ok_or(SubgoalError::Bytes("a way is too long"))?;
                    UpwardArc { cost, first: a.last.back(), last: b.last, ..UpwardArc::to(to, mid) }
                };
                self.arcs[number] = way;
            }
            known[id as usize] = !self.is_core(id);
        }
        Ok(self)
    }
}

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
