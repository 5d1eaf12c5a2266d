//! Where subgoal graphs and the planners on them are made.

use std::sync::Arc;

use mediant_grid::FreeSpace;
use mediant_search::HasFreeSpace;
use mediant_subgoal::{Hierarchy, Progress, SubgoalAStar, SubgoalGraph, SubgoalPlacement, SubgoalTheta};

use crate::{
    Engine, EngineError, Ground, Preprocessing, Setup, Visit,
    planner::{Smooth, timed},
    setup::without_index,
};

/// Hands on the planner of a setup that was checked, on its graph: that of an index, or a new one.
pub(crate) fn with_graph<V: Visit>(
    setup: Setup,
    ground: &Ground,
    index: Option<&[u8]>,
    visit: V,
) -> Result<V::Output, EngineError> {
    match ground {
        Ground::Centers(grid_graph) => on(setup, grid_graph, index, visit),
        Ground::Corners(grid_graph) => on(setup, grid_graph, index, visit),
        Ground::AnyAngle(space) => on(setup, space, index, visit),
    }
}

fn on<T, P, V>(
    setup: Setup,
    ground: &Arc<T>,
    index: Option<&[u8]>,
    visit: V,
) -> Result<V::Output, EngineError>
where
    T: HasFreeSpace<Placement = P> + Send + Sync + 'static,
    P: SubgoalPlacement + Send + Sync + 'static,
    V: Visit,
{
    let (graph, preprocessing) = graph(setup, ground.free_space(), index)?;
    let visit = Smooth { visit, space: Arc::clone(ground), smoothing: setup.options.smoothing };
    let ground = Arc::clone(ground);
    Ok(match setup.engine {
        Engine::SubgoalTheta => visit.visit(SubgoalTheta::new(ground, graph), preprocessing),
        _ => visit.visit(SubgoalAStar::new(ground, graph), preprocessing),
    })
}

/// The graph of a setup, and what it took.
fn graph<P: SubgoalPlacement>(
    setup: Setup,
    space: &FreeSpace<P>,
    index: Option<&[u8]>,
) -> Result<(Arc<SubgoalGraph<P>>, Preprocessing), EngineError> {
    let (graph, time) = timed(|| match index {
        None => new_graph(setup, space, &|_| {}),
        Some(bytes) => saved_graph(setup, space, bytes),
    })?;
    let preprocessing = Preprocessing {
        time,
        index_bytes: graph.memory_bytes() as u64,
        hierarchy: Some(graph.hierarchy()),
        side: None,
    };
    Ok((Arc::new(graph), preprocessing))
}

fn new_graph<P: SubgoalPlacement>(
    setup: Setup,
    space: &FreeSpace<P>,
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<SubgoalGraph<P>, EngineError> {
    let hierarchy = setup.hierarchy().ok_or_else(|| without_index(setup.engine))?;
    Ok(SubgoalGraph::with_progress(space, setup.k, hierarchy, &|step| progress(step))?)
}

/// The graph in an index, which must have the levels that the setup names; one that names none takes those that there are.
fn saved_graph<P: SubgoalPlacement>(
    setup: Setup,
    space: &FreeSpace<P>,
    bytes: &[u8],
) -> Result<SubgoalGraph<P>, EngineError> {
    let graph = SubgoalGraph::from_bytes(space, setup.k, bytes)?;
    let found = graph.hierarchy();
    let needs_levels = setup.engine == Engine::SubgoalTheta && found == Hierarchy::Contracted;
    match setup.hierarchy() {
        Some(expected) if expected != found && (setup.options.levels.is_some() || needs_levels) => {
            Err(EngineError::Hierarchy { expected, found })
        }
        _ => Ok(graph),
    }
}

/// The bytes of the graph of a setup that was checked.
pub(crate) fn build(
    setup: Setup,
    ground: &Ground,
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<Vec<u8>, EngineError> {
    match ground {
        Ground::Centers(grid_graph) => new_graph(setup, grid_graph, progress).map(|graph| graph.to_bytes()),
        Ground::Corners(grid_graph) => new_graph(setup, grid_graph, progress).map(|graph| graph.to_bytes()),
        Ground::AnyAngle(space) => new_graph(setup, space, progress).map(|graph| graph.to_bytes()),
    }
}
