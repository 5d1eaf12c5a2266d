//! A* and Dijkstra's algorithm over elevation.

use std::sync::Arc;

use mediant_costs::WalkingAStar;
use mediant_grid::{Identity, Interrupt, Vertex};
use mediant_search::{End, Ends, Guarantee, Observer, Path, Planner, QueryError, SearchStatus};

use super::{Boxed, EngineIndex, boxed, shared};
use crate::{
    change::Change, configured::ConfiguredEngine, error::Error, option::HeuristicName,
    setup_error::SetupError, space::Space, walk::Walk,
};

/// A space with elevations, and whether its searches are guided.
pub(super) struct WalkingIndex {
    space: Space,
    walk: Walk,
    is_guided: bool,
}

impl WalkingIndex {
    pub(super) fn new(space: &Space, walk: &Walk, engine: ConfiguredEngine) -> Result<Self, Error> {
        let is_guided = match engine {
            ConfiguredEngine::AStar(own) => match own.heuristic.unwrap_or_default() {
                HeuristicName::Hk => true,
                HeuristicName::Zero => false,
                _ => return Err(SetupError::HEURISTIC_ON_COSTS.into()),
            },
            ConfiguredEngine::Dijkstra => false,
            _ => return Err(SetupError::Walking { engine: engine.kind() }.into()),
        };
        Ok(Self { space: space.clone(), walk: walk.clone(), is_guided })
    }
}

impl EngineIndex for WalkingIndex {
    fn search(&self) -> Result<Boxed, Error> {
        let graph = Arc::clone(&self.walk.graph);
        let search = if self.is_guided { WalkingAStar::new(graph) } else { WalkingAStar::dijkstra(graph) };
        Ok(boxed(WalkingSearch { search, space: self.space.clone(), is_apart: true }))
    }

    fn follow(&self, _: &mut Boxed) -> Result<bool, Error> {
        Ok(false)
    }

    fn scratch_bytes(&self) -> usize {
        WalkingAStar::scratch_bytes(&self.walk.graph)
    }

    fn with_options(&self, engine: ConfiguredEngine) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        shared(Self::new(&self.space, &self.walk, engine)).map(Some)
    }

    fn repaired(&self, change: &Change, _: &Interrupt) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        let space = change.after().clone();
        let walk = space.walk().cloned();
        walk.map(|walk| shared(Ok(Self { space, walk, is_guided: self.is_guided }))).transpose()
    }
}

/// A search over elevation that knows from the connected components whether there is a way: each move can be
/// made both ways, if not in the same time.
struct WalkingSearch {
    search: WalkingAStar,
    space: Space,
    /// Whether there is no way between the ends that were asked for last.
    is_apart: bool,
}

// It begins at one start alone: a search that leads back from goals would find other times.
impl Planner for WalkingSearch {
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

    fn proceed(&mut self, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        if self.is_apart { Ok(SearchStatus::Unreachable) } else { self.search.proceed(observer) }
    }

    fn path_to(&mut self, at: Vertex) -> Option<Path> {
        if self.is_apart { None } else { self.search.path_to(at) }
    }

    fn guarantee(&self) -> Guarantee {
        self.search.guarantee()
    }

    fn identity(&self) -> Identity {
        self.search.identity()
    }
}
