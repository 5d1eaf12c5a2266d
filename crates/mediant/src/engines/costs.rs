//! A*, Dijkstra's algorithm and both kinds of Theta* on costs of cells.

use std::sync::Arc;

#[cfg(feature = "all-engines")]
use mediant_costs::CostTheta;
use mediant_costs::{CostAStar, CostGraph};
use mediant_grid::{Identity, Interrupt, Vertex};
use mediant_search::{End, Ends, Guarantee, Observer, Path, Planner, QueryError, SearchStatus};

use super::{Boxed, EngineIndex, boxed, following, shared};
use crate::{
    change::Change, configured::ConfiguredEngine, engine::Engine, error::Error, option::HeuristicName,
    setup_error::SetupError, space::Space, surface::Surface,
};

/// A space with costs, and which of the engines searches it.
pub(super) struct CostIndex {
    space: Space,
    graph: Arc<CostGraph>,
    engine: Engine,
    is_guided: bool,
}

impl CostIndex {
    pub(super) fn new(space: &Space, surface: &Surface, engine: ConfiguredEngine) -> Result<Self, Error> {
        let is_guided = match engine {
            ConfiguredEngine::AStar(own)
            | ConfiguredEngine::Theta(own)
            | ConfiguredEngine::LazyTheta(own) => match own.heuristic.unwrap_or_default() {
                HeuristicName::Hk => true,
                HeuristicName::Zero => false,
                _ => return Err(SetupError::HEURISTIC_ON_COSTS.into()),
            },
            ConfiguredEngine::Dijkstra => false,
            _ => return Err(SetupError::on_costs(engine.kind()).into()),
        };
        let (space, graph) = (space.clone(), Arc::clone(&surface.graph));
        Ok(Self { space, graph, engine: engine.kind(), is_guided })
    }
}

/// Makes a search on costs one of another graph.
macro_rules! follow {
    ($index:ident, $search:ident, $of:ty) => {
        following($search, |search: &mut CostSearch<$of>| {
            search.search.follow(Arc::clone(&$index.graph));
            search.follow(&$index.space);
            Ok::<_, Error>(())
        })
    };
}

impl EngineIndex for CostIndex {
    fn search(&self) -> Result<Boxed, Error> {
        let graph = Arc::clone(&self.graph);
        #[cfg(feature = "all-engines")]
        if let Engine::Theta | Engine::LazyTheta = self.engine {
            let search = match self.engine {
                Engine::Theta => CostTheta::new(graph),
                _ => CostTheta::lazy(graph),
            };
            let search = if self.is_guided { search } else { search.unguided() };
            return Ok(boxed(CostSearch::new(search, &self.space)));
        }
        let search = if self.is_guided { CostAStar::new(graph) } else { CostAStar::dijkstra(graph) };
        Ok(boxed(CostSearch::new(search, &self.space)))
    }

    fn follow(&self, search: &mut Boxed) -> Result<bool, Error> {
        #[cfg(feature = "all-engines")]
        if let Engine::Theta | Engine::LazyTheta = self.engine {
            return follow!(self, search, CostTheta);
        }
        follow!(self, search, CostAStar)
    }

    fn scratch_bytes(&self) -> usize {
        #[cfg(feature = "all-engines")]
        if let Engine::Theta | Engine::LazyTheta = self.engine {
            return CostTheta::scratch_bytes(&self.graph);
        }
        CostAStar::scratch_bytes(&self.graph)
    }

    fn with_options(&self, engine: ConfiguredEngine) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        let surface = self.space.surface().filter(|_| engine.kind() == self.engine);
        surface.map(|surface| shared(Self::new(&self.space, surface, engine))).transpose()
    }

    fn repaired(&self, change: &Change, _: &Interrupt) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        let space = change.after().clone();
        let graph = space.surface().map(|surface| Arc::clone(&surface.graph));
        graph.map(|graph| shared(Ok(Self { space, graph, ..*self }))).transpose()
    }
}

/// A search on costs that knows from the connected components whether there is a way. In a space without
/// costs every cell costs 1, and its paths have lengths.
pub(super) struct CostSearch<S> {
    pub(super) search: S,
    space: Space,
    /// Whether there is no way between the ends that were asked for last.
    is_apart: bool,
}

impl<S: Planner> CostSearch<S> {
    pub(super) fn new(search: S, space: &Space) -> Self {
        Self { search, space: space.clone(), is_apart: true }
    }

    /// Forgets the last query: the search is one of this space now.
    pub(super) fn follow(&mut self, space: &Space) {
        (self.space, self.is_apart) = (space.clone(), true);
    }
}

impl<S: Planner> Planner for CostSearch<S> {
    fn begin(&mut self, query: Ends, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        self.is_apart = true;
        self.space.check_end(End::Start, query.start)?;
        self.space.check_end(End::Goal, query.goal)?;
        if !self.space.connected(query.start, query.goal) {
            return Ok(SearchStatus::Unreachable);
        }
        self.is_apart = false;
        self.search.begin(query, observer)
    }

    fn begin_from(
        &mut self,
        starts: &[Vertex],
        goal: Vertex,
        observer: &mut impl Observer,
    ) -> Option<SearchStatus> {
        let status = self.search.begin_from(starts, goal, observer);
        self.is_apart &= status.is_none();
        status
    }

    fn proceed(&mut self, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        if self.is_apart { Ok(SearchStatus::Unreachable) } else { self.search.proceed(observer) }
    }

    fn path_to(&mut self, at: Vertex) -> Option<Path> {
        if self.is_apart {
            return None;
        }
        let path = self.search.path_to(at)?;
        Some(if self.space.has_costs() { path } else { Path::new(path.into_waypoints()) })
    }

    fn guarantee(&self) -> Guarantee {
        match (self.search.guarantee(), self.space.has_costs()) {
            (Guarantee::Cheapest(k), false) => Guarantee::Optimal(k),
            (guarantee, _) => guarantee,
        }
    }

    fn identity(&self) -> Identity {
        self.space.identity()
    }
}
