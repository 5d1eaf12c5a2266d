//! The index: the subgoals, the arcs between them, and looking both up.

use mediant_grid::{FreeSpace, Identity, Mismatch, Vertex};
use mediant_moves::{Cost, K};
use mediant_search::parts::HasFreeSpace;

use crate::{
    arc::{NONE, PackedArc, UpwardArc},
    hierarchy::Hierarchy,
    placement::{BuildContext, EdgeCriterion, EdgeKind, EdgeTables, SubgoalPlacement},
    subgoals::Subgoals,
};
use mediant_search::parts::Metric;

/// The most arcs that a graph can have: its offsets hold twice their number.
pub(crate) const MAX_ARCS: u32 = u32::MAX / 2;

/// A subgoal graph: the index that planners search. It is immutable, and any number of planners can share it.
///
/// Its vertices are subgoals. Subgoals outside of the core store their arcs to subgoals above them, those of
/// the core their arcs to one another.
#[derive(Clone, Debug)]
pub struct SubgoalGraph<P: SubgoalPlacement> {
    pub(crate) identity: Identity,
    pub(crate) subgoals: Subgoals,
    pub(crate) tables: P::Tables,
    pub(crate) metric: Metric,
    pub(crate) k: K,
    pub(crate) criterion: EdgeCriterion,
    pub(crate) hierarchy: Hierarchy,
    /// Twice the number of each subgoal's first arc, plus 1 if the subgoal belongs to the core.
    pub(crate) offsets: Box<[u32]>,
    pub(crate) arcs: Box<[UpwardArc]>,
}

impl<P: SubgoalPlacement> SubgoalGraph<P> {
    /// The number of subgoals.
    #[must_use]
    pub const fn subgoals(&self) -> usize {
        self.subgoals.len()
    }

    /// The subgoals, row by row.
    pub fn vertices(&self) -> impl Iterator<Item = Vertex> {
        (0..self.subgoals() as u32).map(|id| self.subgoals.vertex(id))
    }

    /// The stored arcs that are not shortcuts, each once.
    pub fn edges(&self) -> impl Iterator<Item = (Vertex, Vertex)> {
        (0..self.subgoals() as u32).flat_map(move |id| {
            // Arcs within the core are stored at both ends.
            let is_edge = move |arc: &&UpwardArc| arc.middle == NONE && (id < arc.to || !self.is_core(id));
            let ends = move |arc: &UpwardArc| (self.subgoals.vertex(id), self.subgoals.vertex(arc.to));
            self.up(id).iter().filter(is_edge).map(ends)
        })
    }

    /// The number of stored arcs: from a subgoal of the core to others of the core, and from any other
    /// subgoal to those above it.
    #[must_use]
    pub const fn arcs(&self) -> usize {
        self.arcs.len()
    }

    /// The number of subgoals in the core of a contraction, or on the highest level.
    #[must_use]
    pub fn core(&self) -> usize {
        (0..self.subgoals() as u32).filter(|&id| self.is_core(id)).count()
    }

    /// The number of arcs between subgoals of the core, each counted in both directions. Divided by
    /// [`core`](Self::core) it is the branching factor of the highest level.
    #[must_use]
    pub fn core_arcs(&self) -> usize {
        (0..self.subgoals() as u32).filter(|&id| self.is_core(id)).map(|id| self.up(id).len()).sum()
    }

    /// Whether its core is small, or a small share of its subgoals. On noise the core is large, and every
    /// search passes it.
    pub(crate) fn has_small_core(&self) -> bool {
        /// The most subgoals of a core that is small whatever its share.
        const FEW: usize = 256;
        /// A core of at most one in so many subgoals is a small share.
        const SHARE: usize = 16;
        let core = self.core();
        core <= FEW || core <= self.subgoals() / SHARE
    }

    /// The neighborhood.
    #[must_use]
    pub const fn k(&self) -> K {
        self.k
    }

    /// The identity: map and rules of motion of its free space, and its k.
    #[must_use]
    pub const fn identity(&self) -> Identity {
        self.identity
    }

    /// Checks that it is the graph of a free space.
    pub(crate) fn check(&self, space: &(impl HasFreeSpace + ?Sized)) -> Result<(), Mismatch> {
        self.identity.check("the subgoal graph", ("the space", space.identity()))
    }

    /// The hierarchy.
    #[must_use]
    pub const fn hierarchy(&self) -> Hierarchy {
        self.hierarchy
    }

    /// The memory used, in bytes.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        self.subgoals.memory_bytes()
            + self.tables.memory_bytes()
            + size_of_val(&*self.offsets)
            + size_of_val(&*self.arcs)
    }

    /// Whether a subgoal belongs to the core.
    #[inline]
    pub(crate) fn is_core(&self, id: u32) -> bool {
        self.offsets[id as usize] & 1 == 1
    }

    /// The stored arcs of a subgoal: upward, or within the core.
    #[inline]
    pub(crate) fn up(&self, id: u32) -> &[UpwardArc] {
        let [first, end] = [id, id + 1].map(|id| (self.offsets[id as usize] / 2) as usize);
        &self.arcs[first..end]
    }

    /// The stored arc from one subgoal to another.
    pub(crate) fn arc(&self, from: u32, to: u32) -> Option<UpwardArc> {
        self.up(from).iter().copied().find(|arc| arc.to == to)
    }

    /// Finds the edges that join the start or goal of a query to subgoals.
    pub(crate) fn query_edges(
        &self,
        space: &FreeSpace<P>,
        scratch: &mut P::Scratch,
        at: Vertex,
        edges: &mut Vec<(u32, Cost)>,
    ) {
        let Self { subgoals, tables, metric, k, criterion, .. } = self;
        edges.clear();
        // A subgoal is in the graph already. But its taut edges are not enough: a path that begins or ends
        // there need not be taut there.
        match subgoals.id(at).filter(|_| *criterion == EdgeCriterion::Direct) {
            Some(id) => edges.push((id, Cost::ZERO)),
            None => {
                let (metric, k, criterion) = (*metric, *k, *criterion);
                let context = BuildContext { space, subgoals, tables, metric, k, criterion };
                P::edges_from(context, scratch, at, EdgeKind::Query, |id, cost| edges.push((id, cost)));
            }
        }
    }

    /// Visits the vertices of the subgoals that an arc passes, in order, except the first. `pending` is
    /// scratch memory.
    pub(crate) fn unpack(
        &self,
        arc: PackedArc,
        pending: &mut Vec<PackedArc>,
        visit: &mut impl FnMut(Vertex),
    ) {
        // A stack: the next arc is the last.
        pending.clear();
        pending.push(arc);
        while let Some(PackedArc { from, to, middle }) = pending.pop() {
            let halves = (middle != NONE).then(|| self.arc(middle, from).zip(self.arc(middle, to))).flatten();
            match halves {
                None => visit(self.subgoals.vertex(to)),
                Some((first, second)) => {
                    pending.push(PackedArc { from: middle, to, middle: second.middle });
                    pending.push(PackedArc { from, to: middle, middle: first.middle });
                }
            }
        }
    }
}
