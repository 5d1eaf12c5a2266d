//! Where graphs of squares, clusters or segments, and the planners on them are made.

use std::{num::NonZeroU32, sync::Arc};

use mediant_grid::{Centers, GridGraph};
use mediant_hierarchy::{ChpaStar, ClusterGraph, Clustering, HpaStar, SegmentGraph};
use mediant_search::{Euclidean, Heuristic, Hk, SquaredEuclidean, Zero};

use crate::{
    Engine, EngineError, Ground, HeuristicName, Hierarchy, Levels, Preprocessing, Setup, Visit,
    ground::no_ground,
    planner::{Smooth, timed},
};

/// Hands on the planner of a setup that was checked, on its graph: that of an index, or a new one.
pub(crate) fn with_graph<V: Visit>(
    setup: Setup,
    ground: &Ground,
    index: Option<&[u8]>,
    visit: V,
) -> Result<V::Output, EngineError> {
    let grid_graph = centers(setup, ground)?;
    let visit = Smooth { visit, space: Arc::clone(grid_graph), smoothing: setup.options.smoothing };
    if setup.engine == Engine::Hpa {
        let (graph, time) = timed(|| clusters(setup, grid_graph, index))?;
        let planner = HpaStar::new(Arc::clone(grid_graph), Arc::clone(&graph))?;
        let planner = planner.with_straightening(!setup.options.refined);
        return Ok(visit.visit(planner, Preprocessing { time, ..about_clusters(&graph) }));
    }
    let (graph, time) = timed(|| segments(setup, grid_graph, index))?;
    let preprocessing = Preprocessing { time, ..about_segments(&graph) };
    let plan = Plan { setup, grid_graph, graph, preprocessing, visit };
    match setup.heuristic() {
        Some(HeuristicName::Hk) => plan.by(Hk),
        Some(HeuristicName::Euclidean) => plan.by(Euclidean),
        Some(HeuristicName::SquaredEuclidean) => plan.by(SquaredEuclidean),
        Some(HeuristicName::Zero) | None => plan.by(Zero),
    }
}

/// The bytes of the graph of a setup that was checked, and what is to be told of it.
pub(crate) fn build(setup: Setup, ground: &Ground) -> Result<(Vec<u8>, Preprocessing), EngineError> {
    let grid_graph = centers(setup, ground)?;
    if setup.engine == Engine::Hpa {
        let graph = clusters(setup, grid_graph, None)?;
        return Ok((graph.to_bytes(), about_clusters(&graph)));
    }
    let graph = segments(setup, grid_graph, None)?;
    Ok((graph.to_bytes(), about_segments(&graph)))
}

fn centers(setup: Setup, ground: &Ground) -> Result<&Arc<GridGraph<Centers>>, EngineError> {
    match ground {
        Ground::Centers(grid_graph) => Ok(grid_graph),
        Ground::Corners(_) | Ground::AnyAngle(_) => Err(no_ground(setup)),
    }
}

/// How many levels of clusters a setup is to have whose lowest are so long; none where nothing is said.
pub(crate) fn levels_of(levels: Option<Levels>, side: u32) -> Option<NonZeroU32> {
    match levels? {
        Levels::Number(number) => Some(number),
        // Each level's clusters are twice as long as those of the one below.
        Levels::All => NonZeroU32::new((Clustering::MAX_SIDE / side).checked_ilog2().unwrap_or(0) + 1),
    }
}

/// The graph of a new index or that of a saved one, whose side and levels must be those that the setup names.
fn clusters(
    setup: Setup,
    grid_graph: &GridGraph<Centers>,
    index: Option<&[u8]>,
) -> Result<Arc<ClusterGraph>, EngineError> {
    let Some(bytes) = index else {
        let default = Clustering::default();
        let side = setup.options.side.map_or(default.side, NonZeroU32::get);
        let levels = levels_of(setup.options.levels, side).map_or(default.levels, NonZeroU32::get);
        return Ok(Arc::new(ClusterGraph::new(grid_graph, Clustering { side, levels })?));
    };
    let graph = ClusterGraph::from_bytes(grid_graph, bytes)?;
    let Clustering { side, levels } = graph.clustering();
    check_side(setup, side)?;
    let found = NonZeroU32::new(levels);
    match levels_of(setup.options.levels, side) {
        expected @ Some(_) if expected != found => {
            let [expected, found] = [expected, found].map(hierarchy);
            Err(EngineError::Hierarchy { expected, found })
        }
        _ => Ok(Arc::new(graph)),
    }
}

fn segments(
    setup: Setup,
    grid_graph: &GridGraph<Centers>,
    index: Option<&[u8]>,
) -> Result<Arc<SegmentGraph>, EngineError> {
    let Some(bytes) = index else {
        let side = setup.options.side.map_or(SegmentGraph::PAPER_SIDE, NonZeroU32::get);
        return Ok(Arc::new(SegmentGraph::new(grid_graph, side)?));
    };
    let graph = SegmentGraph::from_bytes(grid_graph, bytes)?;
    check_side(setup, graph.side())?;
    Ok(Arc::new(graph))
}

fn check_side(setup: Setup, found: u32) -> Result<(), EngineError> {
    match setup.options.side {
        Some(side) if side.get() != found => Err(EngineError::Side { expected: side.get(), found }),
        _ => Ok(()),
    }
}

fn hierarchy(levels: Option<NonZeroU32>) -> Hierarchy {
    Hierarchy::Levels(levels.unwrap_or(NonZeroU32::MIN))
}

fn about_clusters(graph: &ClusterGraph) -> Preprocessing {
    let Clustering { side, levels } = graph.clustering();
    Preprocessing {
        index_bytes: graph.memory_bytes() as u64,
        hierarchy: Some(hierarchy(NonZeroU32::new(levels))),
        side: Some(side),
        ..Preprocessing::default()
    }
}

fn about_segments(graph: &SegmentGraph) -> Preprocessing {
    Preprocessing {
        index_bytes: graph.memory_bytes() as u64,
        side: Some(graph.side()),
        ..Preprocessing::default()
    }
}

/// All that CHPA* is made of but its heuristics.
struct Plan<'l, V> {
    setup: Setup,
    grid_graph: &'l Arc<GridGraph<Centers>>,
    graph: Arc<SegmentGraph>,
    preprocessing: Preprocessing,
    visit: V,
}

impl<V: Visit> Plan<'_, V> {
    fn by(self, first: impl Heuristic + Send + 'static) -> Result<V::Output, EngineError> {
        match self.setup.second() {
            Some(HeuristicName::Hk) => self.by_both(first, Hk),
            Some(HeuristicName::Euclidean) => self.by_both(first, Euclidean),
            Some(HeuristicName::SquaredEuclidean) => self.by_both(first, SquaredEuclidean),
            Some(HeuristicName::Zero) | None => self.by_both(first, Zero),
        }
    }

    fn by_both(
        self,
        first: impl Heuristic + Send + 'static,
        second: impl Heuristic + Send + 'static,
    ) -> Result<V::Output, EngineError> {
        let Self { setup, grid_graph, graph, preprocessing, visit } = self;
        let planner = ChpaStar::new(Arc::clone(grid_graph), graph, first, second)?;
        let planner = planner.with_fallback_policy(setup.fallback_policy());
        let planner = match setup.step() {
            Some(step) => planner.with_step(step),
            None => planner,
        };
        Ok(visit.visit(planner, preprocessing))
    }
}
