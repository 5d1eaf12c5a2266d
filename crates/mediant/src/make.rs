//! The searches of planners, made from an index, each compiled for its types: a line for each engine.
//!
//! How often a search is compiled decides how long the crate takes to build. So only A* is compiled for every
//! heuristic; the other engines are compiled for one type, [`Admissible`], that tells heuristics apart at run
//! time.

use std::{num::NonZeroU32, sync::Arc};

use mediant_grid::{Centers, Corners, FreeSpace, GridGraph, Placement};
use mediant_hierarchy::{ChpaStar, HpaStar, SegmentGraph};
use mediant_moves::K;
use mediant_search::{
    AStar, Anya, BlockJps, Canonical, DeadEnds, Euclidean, Heuristic, Hk, Jps, JpsPlus, LazyThetaStar,
    PaperCanonical, Path, Planner as Search, Smoothing, SquaredEuclidean, ThetaStar, Wavefront, Zero,
    parts::{HasFreeSpace, JumpFinder, JumpPointSearch, StepwiseFinder},
};
use mediant_subgoal::{HubLabelSearch, SubgoalAStar, SubgoalGraph, SubgoalPlacement, SubgoalTheta};

use crate::{
    configured::{ChpaOptions, ConfiguredEngine},
    erased::Erased,
    error::Error,
    goals::ToGoals,
    heuristic::Admissible,
    index::{InFreeSpace, Index, OnGridGraph, Prepared},
    option::HeuristicName,
    setup::Setup,
    setup_error::SetupError,
};

/// A search with scratch memory of its own.
pub(crate) type Boxed = Box<dyn Erased + Send>;

/// Erases the type of a search.
fn boxed(search: impl Search + Send + 'static) -> Boxed {
    Box::new(search)
}

/// The search of an index's planners.
pub(crate) fn search(index: &Index) -> Result<Boxed, Error> {
    let setup = index.search_setup();
    match &index.prepared {
        Prepared::Centers(graph, OnGridGraph::Clusters(clusters)) => {
            let search = HpaStar::new(Arc::clone(graph), Arc::clone(clusters))?;
            let unstraightened = matches!(setup.engine, ConfiguredEngine::Hpa(own) if own.unstraightened);
            Ok(boxed(search.with_straightening(!unstraightened)))
        }
        Prepared::Centers(graph, OnGridGraph::Segments(segments)) => chpa(setup, graph, segments),
        Prepared::Centers(graph, parts) => on_graph(setup, graph, parts),
        Prepared::Corners(graph, parts) => on_graph(setup, graph, parts),
        Prepared::FreeCenters(space, InFreeSpace::Subgoals(graph)) => subgoal(setup, space, graph),
        Prepared::FreeCorners(space, InFreeSpace::Subgoals(graph)) => subgoal(setup, space, graph),
        Prepared::FreeCenters(space, InFreeSpace::Labels(labels)) => {
            Ok(boxed(HubLabelSearch::new(Arc::clone(space), Arc::clone(labels))?))
        }
        Prepared::FreeCorners(space, InFreeSpace::Labels(labels)) => {
            Ok(boxed(HubLabelSearch::new(Arc::clone(space), Arc::clone(labels))?))
        }
        Prepared::FreeCorners(space, InFreeSpace::DeadEnds(dead_ends)) => anya(setup, space, Some(dead_ends)),
        Prepared::FreeCorners(space, InFreeSpace::Nothing) => anya(setup, space, None),
        Prepared::FreeCenters(_, InFreeSpace::DeadEnds(_) | InFreeSpace::Nothing) => Err(not_prepared(setup)),
    }
}

/// The many-goals search of an index with hub labels; `None` for other indexes.
pub(crate) fn to_goals(index: &Index) -> Result<Option<Box<dyn ToGoals + Send>>, Error> {
    Ok(match &index.prepared {
        Prepared::FreeCenters(space, InFreeSpace::Labels(labels)) => {
            Some(Box::new(HubLabelSearch::new(Arc::clone(space), Arc::clone(labels))?))
        }
        Prepared::FreeCorners(space, InFreeSpace::Labels(labels)) => {
            Some(Box::new(HubLabelSearch::new(Arc::clone(space), Arc::clone(labels))?))
        }
        _ => None,
    })
}

/// Smooths a path.
pub(crate) type Smoother = Box<dyn Fn(&Path) -> Path + Send>;

/// The smoother of an index's paths.
pub(crate) fn smoother(index: &Index, smoothing: Smoothing) -> Smoother {
    match &index.prepared {
        Prepared::Centers(graph, _) => smoother_in(Arc::clone(graph), smoothing),
        Prepared::Corners(graph, _) => smoother_in(Arc::clone(graph), smoothing),
        Prepared::FreeCenters(space, _) => smoother_in(Arc::clone(space), smoothing),
        Prepared::FreeCorners(space, _) => smoother_in(Arc::clone(space), smoothing),
    }
}

fn smoother_in(space: Arc<impl HasFreeSpace + Send + Sync + 'static>, smoothing: Smoothing) -> Smoother {
    Box::new(move |path| smoothing.apply(space.free_space(), path))
}

/// The error for an index that does not hold what its engine searches. No constructor makes one.
fn not_prepared(setup: Setup) -> Error {
    SetupError::without_index(setup.engine.kind()).into()
}

/// Anya, which leaves out dead ends if they were found.
fn anya(
    setup: Setup,
    space: &Arc<FreeSpace<Corners>>,
    dead_ends: Option<&Arc<DeadEnds>>,
) -> Result<Boxed, Error> {
    let space = Arc::clone(space);
    Ok(match (setup.k, dead_ends.map(Arc::clone)) {
        (K::Any, None) => boxed(Anya::new(space)),
        (K::Any, Some(dead_ends)) => boxed(Anya::new(space).without(dead_ends)?),
        (K::Finite(k), None) => boxed(Anya::over(space, k)?),
        (K::Finite(k), Some(dead_ends)) => boxed(Anya::over(space, k)?.without(dead_ends)?),
    })
}

/// A search on a subgoal graph.
fn subgoal<P: SubgoalPlacement>(
    setup: Setup,
    space: &Arc<FreeSpace<P>>,
    graph: &Arc<SubgoalGraph<P>>,
) -> Result<Boxed, Error> {
    let (space, graph) = (Arc::clone(space), Arc::clone(graph));
    Ok(match setup.engine {
        ConfiguredEngine::SubgoalTheta(_) => boxed(SubgoalTheta::new(space, graph)?),
        _ => boxed(SubgoalAStar::new(space, graph)?),
    })
}

/// A search on a grid graph.
fn on_graph<P: SubgoalPlacement>(
    setup: Setup,
    graph: &Arc<GridGraph<P>>,
    parts: &OnGridGraph<P>,
) -> Result<Boxed, Error> {
    let graph = Arc::clone(graph);
    let heuristic = setup.engine.heuristic();
    match (setup.engine, heuristic.ok_or_else(|| not_prepared(setup))?) {
        (ConfiguredEngine::Dijkstra, _) | (ConfiguredEngine::AStar(_), HeuristicName::Zero) => {
            Ok(boxed(AStar::new(graph, Zero)))
        }
        (ConfiguredEngine::AStar(_), HeuristicName::Hk) => Ok(boxed(AStar::new(graph, Hk))),
        (ConfiguredEngine::AStar(_), HeuristicName::Euclidean) => Ok(boxed(AStar::new(graph, Euclidean))),
        (ConfiguredEngine::AStar(_), HeuristicName::SquaredEuclidean) => {
            Ok(boxed(AStar::new(graph, SquaredEuclidean)))
        }
        (ConfiguredEngine::Wavefront, _) => Ok(boxed(Wavefront::new(graph))),
        (_, HeuristicName::Hk) => guided(setup, graph, parts, Admissible::Hk),
        (_, HeuristicName::Euclidean) => guided(setup, graph, parts, Admissible::Euclidean),
        (_, HeuristicName::Zero) => guided(setup, graph, parts, Admissible::Zero),
        // `Setup::check` refuses it: no other search on a grid graph takes a heuristic that overestimates.
        (_, HeuristicName::SquaredEuclidean) => Err(not_prepared(setup)),
    }
}

/// A search on a grid graph with a heuristic that never overestimates.
fn guided<P: SubgoalPlacement>(
    setup: Setup,
    graph: Arc<GridGraph<P>>,
    parts: &OnGridGraph<P>,
    heuristic: Admissible,
) -> Result<Boxed, Error> {
    Ok(match (setup.engine, parts) {
        (ConfiguredEngine::Theta(_), _) => boxed(ThetaStar::new(graph, heuristic)),
        (ConfiguredEngine::LazyTheta(_), _) => boxed(LazyThetaStar::new(graph, heuristic)),
        (ConfiguredEngine::Canonical(_), OnGridGraph::Nothing) => {
            boxed(PaperCanonical::new(graph, heuristic))
        }
        (ConfiguredEngine::Canonical(_), OnGridGraph::Pruning(pruning)) => {
            boxed(Canonical::with_pruning(graph, Arc::clone(pruning), heuristic)?)
        }
        (ConfiguredEngine::Jps(own), OnGridGraph::Pruning(pruning)) => {
            let search = Jps::with_finder(graph, Arc::clone(pruning), StepwiseFinder, heuristic)?;
            jumping(search, own.jump_limit, own.keep_intermediate)
        }
        (ConfiguredEngine::JpsBlock(own), OnGridGraph::Blocks(pruning, blocks)) => {
            let search = BlockJps::with_finder(graph, Arc::clone(pruning), blocks.clone(), heuristic)?;
            jumping(search, own.jump_limit, own.keep_intermediate)
        }
        (ConfiguredEngine::JpsPlus(own), OnGridGraph::Table(pruning, table)) => {
            let search = JpsPlus::with_finder(graph, Arc::clone(pruning), Arc::clone(table), heuristic)?;
            jumping(search, None, own.keep_intermediate)
        }
        _ => return Err(not_prepared(setup)),
    })
}

/// A jump point search with its options.
fn jumping<P: Placement, H: Heuristic + Send + 'static, J: JumpFinder<P> + Send + 'static>(
    planner: JumpPointSearch<Arc<GridGraph<P>>, H, P, J>,
    limit: Option<NonZeroU32>,
    keep_intermediate: bool,
) -> Boxed
where
    JumpPointSearch<Arc<GridGraph<P>>, H, P, J>: Search + Send + 'static,
{
    let planner = planner.with_jump_limit(limit.map(NonZeroU32::get));
    boxed(planner.with_intermediate(keep_intermediate))
}

/// CHPA*, compiled for each phase with and without a heuristic that overestimates.
fn chpa(setup: Setup, graph: &Arc<GridGraph<Centers>>, segments: &Arc<SegmentGraph>) -> Result<Boxed, Error> {
    let ConfiguredEngine::Chpa(own) = setup.engine else { return Err(not_prepared(setup)) };
    let admissible = |name| match name {
        Some(HeuristicName::SquaredEuclidean) => None,
        Some(HeuristicName::Hk) => Some(Admissible::Hk),
        Some(HeuristicName::Euclidean) => Some(Admissible::Euclidean),
        Some(HeuristicName::Zero) | None => Some(Admissible::Zero),
    };
    let squared = SquaredEuclidean;
    match (admissible(setup.engine.heuristic()), admissible(setup.engine.second())) {
        (Some(first), Some(second)) => chpa_by(own, graph, segments, first, second),
        (Some(first), None) => chpa_by(own, graph, segments, first, squared),
        (None, Some(second)) => chpa_by(own, graph, segments, squared, second),
        (None, None) => chpa_by(own, graph, segments, squared, squared),
    }
}

/// CHPA* with the heuristics of both phases.
fn chpa_by(
    own: ChpaOptions,
    graph: &Arc<GridGraph<Centers>>,
    segments: &Arc<SegmentGraph>,
    first: impl Heuristic + Send + 'static,
    second: impl Heuristic + Send + 'static,
) -> Result<Boxed, Error> {
    let engine = ConfiguredEngine::Chpa(own);
    let planner = ChpaStar::new(Arc::clone(graph), Arc::clone(segments), first, second)?;
    let planner = planner.with_fallback_policy(engine.fallback_policy().unwrap_or_default());
    Ok(boxed(match engine.step() {
        Some(step) => planner.with_step(step),
        None => planner,
    }))
}
