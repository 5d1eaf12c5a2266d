//! The scratch memory of planners: how much, and whether it can be had.

use mediant_grid::{GridGraph, VertexId};
use mediant_hierarchy::{ChpaStar, HpaStar};
use mediant_search::{Anya, ThetaStar, Wavefront, parts::NodeStore};
use mediant_subgoal::{HubLabelSearch, SubgoalAStar, SubgoalGraph, SubgoalPlacement, SubgoalTheta};

use crate::{
    configured::ConfiguredEngine,
    engine::Engine,
    error::Error,
    index::{InFreeSpace, Index, OnGridGraph, Prepared},
};

impl Index {
    /// The scratch memory that each of its planners takes when it is made, in bytes. Where the system hands
    /// memory out only when it is written, as most do, a planner uses no more of it than searches touch;
    /// what depends on a search alone, such as the open list, comes on top.
    #[must_use]
    pub fn scratch_bytes(&self) -> u64 {
        let engine = self.search_setup().engine;
        let bytes = match &self.prepared {
            Prepared::Centers(_, OnGridGraph::Clusters(clusters)) => HpaStar::scratch_bytes(clusters),
            Prepared::Centers(graph, OnGridGraph::Segments(segments)) => {
                ChpaStar::scratch_bytes(graph, segments)
            }
            Prepared::Centers(graph, _) => on_graph(engine, graph),
            Prepared::Corners(graph, _) => on_graph(engine, graph),
            Prepared::FreeCenters(_, InFreeSpace::Subgoals(graph)) => on_subgoals(engine, graph),
            Prepared::FreeCorners(_, InFreeSpace::Subgoals(graph)) => on_subgoals(engine, graph),
            Prepared::FreeCenters(_, InFreeSpace::Labels(labels)) => HubLabelSearch::scratch_bytes(labels),
            Prepared::FreeCorners(_, InFreeSpace::Labels(labels)) => HubLabelSearch::scratch_bytes(labels),
            Prepared::FreeCorners(space, InFreeSpace::DeadEnds(dead_ends)) => {
                Anya::scratch_bytes(space) + dead_ends.scratch_bytes()
            }
            Prepared::FreeCorners(space, InFreeSpace::Nothing) => Anya::scratch_bytes(space),
            // No constructor makes one.
            Prepared::FreeCenters(_, InFreeSpace::DeadEnds(_) | InFreeSpace::Nothing) => 0,
        };
        bytes as u64
    }
}

fn on_graph<P: SubgoalPlacement>(engine: ConfiguredEngine, graph: &GridGraph<P>) -> usize {
    match engine.kind() {
        Engine::Jps | Engine::JpsBlock | Engine::JpsPlus => {
            NodeStore::<VertexId>::bytes(graph.vertex_count())
        }
        Engine::Wavefront => Wavefront::scratch_bytes(graph),
        Engine::Theta | Engine::LazyTheta => ThetaStar::<&GridGraph<P>, ()>::scratch_bytes(graph),
        _ => NodeStore::<()>::bytes(graph.vertex_count()),
    }
}

fn on_subgoals<P: SubgoalPlacement>(engine: ConfiguredEngine, graph: &SubgoalGraph<P>) -> usize {
    match engine {
        ConfiguredEngine::SubgoalTheta(_) => SubgoalTheta::scratch_bytes(graph),
        _ => SubgoalAStar::scratch_bytes(graph),
    }
}

/// Checks that there is so much memory, by asking for it. (Another thread may take it before it is used.)
pub(crate) fn check(what: &'static str, bytes: u64) -> Result<(), Error> {
    let room = usize::try_from(bytes).is_ok_and(|bytes| Vec::<u8>::new().try_reserve_exact(bytes).is_ok());
    if room { Ok(()) } else { Err(Error::OutOfMemory { what, bytes }) }
}
