//! Hub labels: the end of the search.
//!
//! The label of a subgoal is a list of *hubs*, other subgoals, with the cost of a path to each. The first and
//! the last subgoal of any shortest path have a hub in common that is on such a path. So a distance is the
//! least sum over two lists, and nothing is searched (Abraham, Delling, Goldberg & Werneck 2011; for
//! any-angle paths Du, Shen & Cheema 2023, who keep labels for regions of cells; here they are kept for
//! subgoals alone).
//!
//! # Which hubs
//!
//! The hubs of the contraction hierarchy: h is a hub of c if it is the highest subgoal on all shortest paths
//! between them. On the shortest paths between two subgoals the highest subgoal is a hub of both ([`merge`]).
//! The graph has taut edges only, so it need not have shortest paths between subgoals that no shortest path
//! of a query passes one after the other; their labels may be missing, or longer. Costs are compared as in
//! the contraction, by (h_k, Euclidean length).
//!
//! # A query
//!
//! The subgoals that start and goal see are looked up ([`SeenIndex`]). Each subgoal that the start sees
//! writes the costs to its hubs into an array, and each that the goal sees reads them ([`join`]). Two rules
//! leave labels unread and lose no shortest path:
//!
//! - *Bends.* A path from the start over c goes on along an edge. If the bend at c is not taut, it is no
//!   shortest path. The labels of a subgoal are grouped by the first edge of their paths. The edges on one
//!   side of a corner are sorted by their angle to its wall, so the groups that a path may follow are the
//!   first ones. The lexicographically shortest path is taut, so it survives; its cost h_k is exact.
//! - *Bounds.* A path over c costs at least h(s, c) + h(c, t). Once a path is known that costs no more, the
//!   labels of c need not be read. The subgoals with the least bound at both ends go first: most often they
//!   give a path that is nearly as short as the shortest.
//!
//! # The path
//!
//! A group knows the next subgoal on the way to its hubs, and this subgoal has the same hub ([`whole`]). A
//! step beside each label says which of that subgoal's labels leads on ([`chain`]).
//!
//! # With more memory
//!
//! Most of a query is what it does with each of the subgoals that its ends see. Vertices can have labels of
//! their own, of which there are as many as fit ([`vertices`]): then an end reads the list of its hubs.

mod between;
mod build;
mod candidates;
mod chain;
mod codec;
mod join;
mod lines;
mod lists;
mod many;
mod merge;
mod near;
mod pack;
mod planner;
mod reader;
#[cfg(test)]
mod tests;
mod vertices;
mod whole;

use std::sync::Arc;

use mediant_grid::{Identity, Mismatch, Vertex};
use mediant_moves::K;
use mediant_search::parts::{HasFreeSpace, Metric};

pub(crate) use self::reader::LabelReader;
pub use self::{
    many::{Goals, GoalsError},
    planner::HubLabelSearch,
};
use self::{
    pack::Packed,
    vertices::{OfVertex, VertexLabels},
};
use crate::{
    placement::{EdgeCriterion, SubgoalPlacement},
    seen::SeenIndex,
    subgoals::Subgoals,
};

/// The parts of an index that depend on the map and its rules, and at corners not on k.
#[derive(Clone, Debug)]
pub(crate) struct Geometry {
    pub(crate) subgoals: Subgoals,
    pub(crate) seen: SeenIndex,
}

impl Geometry {
    fn memory_bytes(&self) -> usize {
        self.subgoals.memory_bytes() + self.seen.memory_bytes()
    }
}

/// Hub labels of a subgoal graph, with an index of what each vertex sees: queries without a search. It is
/// immutable, and any number of planners can share it.
#[derive(Clone, Debug)]
pub struct HubLabels<P: SubgoalPlacement> {
    identity: Identity,
    geometry: Arc<Geometry>,
    metric: Metric,
    k: K,
    criterion: EdgeCriterion,
    packed: Packed,
    vertices: VertexLabels,
    placement: std::marker::PhantomData<P>,
}

impl<P: SubgoalPlacement> HubLabels<P> {
    /// The number of subgoals.
    #[must_use]
    pub fn subgoals(&self) -> usize {
        self.geometry.subgoals.len()
    }

    /// The number of labels: hubs of all subgoals, without each subgoal itself.
    #[must_use]
    pub const fn labels(&self) -> usize {
        self.packed.labels.len()
    }

    /// The neighborhood.
    #[must_use]
    pub const fn k(&self) -> K {
        self.k
    }

    /// The metric of N(k).
    pub(crate) const fn metric(&self) -> Metric {
        self.metric
    }

    /// The identity: map and rules of motion of its free space, and its k.
    #[must_use]
    pub const fn identity(&self) -> Identity {
        self.identity
    }

    /// The number of labels of vertices: see [`with_vertices`](Self::with_vertices).
    #[must_use]
    pub fn labels_of_vertices(&self) -> usize {
        self.vertices.len()
    }

    /// The labels of a vertex, if it has any.
    #[inline]
    fn labels_of(&self, at: Vertex) -> Option<OfVertex<'_>> {
        self.vertices.of(self.geometry.seen.columns, at)
    }

    /// The memory used, in bytes. A geometry that labels for several k share counts for each.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        self.geometry.memory_bytes() + self.packed.memory_bytes() + self.vertices.memory_bytes()
    }

    /// Checks that they are the labels of a free space.
    pub(crate) fn check(&self, space: &(impl HasFreeSpace + ?Sized)) -> Result<(), Mismatch> {
        self.identity.check("the hub labels", ("the space", space.identity()))
    }
}
