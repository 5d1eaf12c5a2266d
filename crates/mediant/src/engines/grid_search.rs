//! A*, Dijkstra's algorithm and the wavefront, which search a grid graph as it is.

use std::sync::Arc;

use mediant_grid::{GridGraph, Interrupt, Placement};
#[cfg(feature = "publications")]
use mediant_search::SquaredEuclidean;
use mediant_search::{AStar, Heuristic, parts::NodeStore};
#[cfg(feature = "all-engines")]
use mediant_search::{Euclidean, Hk, Wavefront, Zero};

use super::{Boxed, EngineIndex, boxed, following, shared, with_options};
#[cfg(not(feature = "all-engines"))]
use crate::heuristic::Admissible;
use crate::{
    change::Change,
    configured::ConfiguredEngine,
    engine::Engine,
    error::Error,
    option::{
        HeuristicName,
        slot::{Options, Slot},
    },
    space::PlacementOfSpace,
};

/// Options of a search that takes only a heuristic.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct GuidedOptions {
    /// The heuristic; h_k by default.
    pub heuristic: Option<HeuristicName>,
}

impl Options for GuidedOptions {
    fn slots(&mut self) -> Vec<Slot<'_>> {
        vec![Slot::heuristic(&mut self.heuristic)]
    }
}

/// A grid graph, and which of the engines searches it.
pub(super) struct GridSearchIndex<P: Placement> {
    graph: Arc<GridGraph<P>>,
    engine: GridSearch,
}

#[derive(Clone, Copy)]
enum GridSearch {
    AStar(HeuristicName),
    Dijkstra,
    #[cfg(feature = "all-engines")]
    Wavefront,
}

impl<P: Placement> GridSearchIndex<P> {
    pub(super) fn a_star(graph: &Arc<GridGraph<P>>, own: GuidedOptions) -> Result<Self, Error> {
        Self::new(graph, GridSearch::AStar(own.heuristic.unwrap_or_default()))
    }

    pub(super) fn dijkstra(graph: &Arc<GridGraph<P>>) -> Result<Self, Error> {
        Self::new(graph, GridSearch::Dijkstra)
    }

    #[cfg(feature = "all-engines")]
    pub(super) fn wavefront(graph: &Arc<GridGraph<P>>) -> Result<Self, Error> {
        Self::new(graph, GridSearch::Wavefront)
    }

    fn new(graph: &Arc<GridGraph<P>>, engine: GridSearch) -> Result<Self, Error> {
        Ok(Self { graph: Arc::clone(graph), engine })
    }

    /// A*, compiled for each heuristic.
    #[cfg(feature = "all-engines")]
    fn by_heuristic(&self, name: HeuristicName) -> Result<Boxed, Error> {
        let graph = Arc::clone(&self.graph);
        Ok(match name {
            HeuristicName::Hk => boxed(AStar::new(graph, Hk)),
            HeuristicName::Euclidean => boxed(AStar::new(graph, Euclidean)),
            HeuristicName::Zero => boxed(AStar::new(graph, Zero)),
            #[cfg(feature = "publications")]
            HeuristicName::SquaredEuclidean => boxed(AStar::new(graph, SquaredEuclidean)),
        })
    }

    /// A*, compiled once: a module for WebAssembly is 6 kB smaller as it travels.
    #[cfg(not(feature = "all-engines"))]
    fn by_heuristic(&self, name: HeuristicName) -> Result<Boxed, Error> {
        Ok(boxed(AStar::new(Arc::clone(&self.graph), Admissible::new(Engine::AStar, Some(name))?)))
    }

    /// The same, for a search that follows.
    #[cfg(feature = "all-engines")]
    fn follow_by_heuristic(&self, name: HeuristicName, search: &mut Boxed) -> Result<bool, Error> {
        match name {
            HeuristicName::Hk => self.follow_by::<Hk>(search),
            HeuristicName::Euclidean => self.follow_by::<Euclidean>(search),
            HeuristicName::Zero => self.follow_by::<Zero>(search),
            #[cfg(feature = "publications")]
            HeuristicName::SquaredEuclidean => self.follow_by::<SquaredEuclidean>(search),
        }
    }

    #[cfg(not(feature = "all-engines"))]
    fn follow_by_heuristic(&self, _: HeuristicName, search: &mut Boxed) -> Result<bool, Error> {
        self.follow_by::<Admissible>(search)
    }

    fn follow_by<H: Heuristic + 'static>(&self, search: &mut Boxed) -> Result<bool, Error> {
        following(search, |search: &mut AStar<Arc<GridGraph<P>>, H>| {
            search.follow(Arc::clone(&self.graph));
            Ok::<_, Error>(())
        })
    }
}

impl<P: PlacementOfSpace> EngineIndex for GridSearchIndex<P> {
    fn search(&self) -> Result<Boxed, Error> {
        match self.engine {
            GridSearch::AStar(name) => self.by_heuristic(name),
            GridSearch::Dijkstra => self.by_heuristic(HeuristicName::Zero),
            #[cfg(feature = "all-engines")]
            GridSearch::Wavefront => Ok(boxed(Wavefront::new(Arc::clone(&self.graph)))),
        }
    }

    fn follow(&self, search: &mut Boxed) -> Result<bool, Error> {
        match self.engine {
            GridSearch::AStar(name) => self.follow_by_heuristic(name, search),
            GridSearch::Dijkstra => self.follow_by_heuristic(HeuristicName::Zero, search),
            #[cfg(feature = "all-engines")]
            GridSearch::Wavefront => following(search, |search: &mut Wavefront<Arc<GridGraph<P>>>| {
                search.follow(Arc::clone(&self.graph));
                Ok::<_, Error>(())
            }),
        }
    }

    fn scratch_bytes(&self) -> usize {
        match self.engine {
            GridSearch::AStar(_) | GridSearch::Dijkstra => NodeStore::<()>::bytes(self.graph.vertex_count()),
            #[cfg(feature = "all-engines")]
            GridSearch::Wavefront => Wavefront::scratch_bytes(&*self.graph),
        }
    }

    fn with_options(&self, engine: ConfiguredEngine) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        with_options(match (self.engine, engine) {
            (GridSearch::AStar(_), ConfiguredEngine::AStar(own)) => Self::a_star(&self.graph, own),
            (GridSearch::Dijkstra, ConfiguredEngine::Dijkstra) => Self::dijkstra(&self.graph),
            #[cfg(feature = "all-engines")]
            (GridSearch::Wavefront, ConfiguredEngine::Wavefront) => Self::wavefront(&self.graph),
            _ => return Ok(None),
        })
    }

    fn repaired(&self, change: &Change, _: &Interrupt) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        let graph = P::layers(change.after(), Engine::AStar)?.graph(self.graph.k())?;
        shared(Self::new(graph, self.engine)).map(Some)
    }
}
