//! Planners made from an index, each compiled for its types: a line for each engine.
//!
//! How often a search is compiled decides how long the crate takes to build. So only A* is compiled for every
//! heuristic; the other engines are compiled for one type, [`Admissible`], that tells heuristics apart at run
//! time.

use std::{num::NonZeroU32, sync::Arc};

use mediant_grid::{Centers, Corners, FreeSpace, GridGraph, Mismatch, Placement};
use mediant_hierarchy::{ChpaStar, HpaStar, SegmentGraph};
use mediant_search::{
    AStar, Anya, BlockJps, Canonical, Euclidean, Heuristic, Hk, Jps, JpsPlus, LazyThetaStar, PaperCanonical,
    Planner as Search, SquaredEuclidean, ThetaStar, Wavefront, Zero,
    parts::{HasFreeSpace, JumpFinder, JumpPointSearch, StepwiseFinder},
};
use mediant_subgoal::{SubgoalAStar, SubgoalGraph, SubgoalPlacement, SubgoalTheta};

use crate::{
    ChpaOptions, ConfiguredEngine, EngineError, HeuristicName, Index, Planner, Setup,
    heuristic::Admissible,
    index::{Parts, Prepared},
    space::no_space,
};

impl Index {
    /// A planner on this index, with scratch memory of its own.
    ///
    /// # Errors
    /// [`EngineError`] if the index does not hold what its engine needs, which no constructor allows.
    pub fn planner(&self) -> Result<Planner, EngineError> {
        let setup = self.setup();
        let planner = match &self.prepared {
            Prepared::Centers(graph, Parts::Clusters(clusters)) => {
                let planner = HpaStar::new(Arc::clone(graph), Arc::clone(clusters))?;
                let unstraightened = matches!(setup.engine, ConfiguredEngine::Hpa(own) if own.unstraightened);
                Some(Planner::of(planner.with_straightening(!unstraightened)))
            }
            Prepared::Centers(graph, Parts::Segments(segments)) => Some(chpa(setup, graph, segments)?),
            Prepared::Centers(graph, parts) => on_graph(setup, graph, parts)?,
            Prepared::Corners(graph, parts) => on_graph(setup, graph, parts)?,
            Prepared::AnyAngle(space, Parts::Subgoals(graph)) => Some(subgoal(setup, space, graph)?),
            Prepared::AnyAngle(space, _) => any_angle(setup, space),
        };
        let planner = planner.ok_or_else(|| no_space(setup))?;
        let Some(smoothing) = setup.smoothing else { return Ok(planner) };
        Ok(match &self.prepared {
            Prepared::Centers(graph, _) => planner.smoothed(Arc::clone(graph), smoothing),
            Prepared::Corners(graph, _) => planner.smoothed(Arc::clone(graph), smoothing),
            Prepared::AnyAngle(space, _) => planner.smoothed(Arc::clone(space), smoothing),
        })
    }
}

/// A planner in a free space, of an engine that prepares nothing.
fn any_angle(setup: Setup, space: &Arc<FreeSpace<Corners>>) -> Option<Planner> {
    matches!(setup.engine, ConfiguredEngine::Anya).then(|| Planner::of(Anya::new(Arc::clone(space))))
}

/// A planner on a subgoal graph.
fn subgoal<S, P>(setup: Setup, space: &Arc<S>, graph: &Arc<SubgoalGraph<P>>) -> Result<Planner, Mismatch>
where
    S: HasFreeSpace<Placement = P> + Send + Sync + 'static,
    P: SubgoalPlacement,
{
    let (space, graph) = (Arc::clone(space), Arc::clone(graph));
    Ok(match setup.engine {
        ConfiguredEngine::SubgoalTheta(_) => Planner::of(SubgoalTheta::new(space, graph)?),
        _ => Planner::of(SubgoalAStar::new(space, graph)?),
    })
}

/// A planner on a grid graph; `None` if the parts are not the engine's.
fn on_graph<P: SubgoalPlacement>(
    setup: Setup,
    graph: &Arc<GridGraph<P>>,
    parts: &Parts<P>,
) -> Result<Option<Planner>, Mismatch> {
    if let Parts::Subgoals(subgoals) = parts {
        return Ok(Some(subgoal(setup, graph, subgoals)?));
    }
    let graph = Arc::clone(graph);
    let Some(heuristic) = setup.engine.heuristic() else { return Ok(None) };
    Ok(match (setup.engine, heuristic) {
        (ConfiguredEngine::Dijkstra, _) | (ConfiguredEngine::AStar(_), HeuristicName::Zero) => {
            Some(Planner::of(AStar::new(graph, Zero)))
        }
        (ConfiguredEngine::AStar(_), HeuristicName::Hk) => Some(Planner::of(AStar::new(graph, Hk))),
        (ConfiguredEngine::AStar(_), HeuristicName::Euclidean) => {
            Some(Planner::of(AStar::new(graph, Euclidean)))
        }
        (ConfiguredEngine::AStar(_), HeuristicName::SquaredEuclidean) => {
            Some(Planner::of(AStar::new(graph, SquaredEuclidean)))
        }
        (ConfiguredEngine::Wavefront, _) => Some(Planner::of(Wavefront::new(graph))),
        (_, HeuristicName::Hk) => guided(setup.engine, graph, parts, Admissible::Hk)?,
        (_, HeuristicName::Euclidean) => guided(setup.engine, graph, parts, Admissible::Euclidean)?,
        (_, HeuristicName::Zero) => guided(setup.engine, graph, parts, Admissible::Zero)?,
        // `ConfiguredEngine::check` refuses it: no other search on a grid graph takes a heuristic that overestimates.
        (_, HeuristicName::SquaredEuclidean) => None,
    })
}

/// A planner on a grid graph with a heuristic that never overestimates; `None` if the parts are not the
/// engine's.
fn guided<P: SubgoalPlacement>(
    engine: ConfiguredEngine,
    graph: Arc<GridGraph<P>>,
    parts: &Parts<P>,
    heuristic: Admissible,
) -> Result<Option<Planner>, Mismatch> {
    Ok(Some(match (engine, parts) {
        (ConfiguredEngine::Theta(_), _) => Planner::of(ThetaStar::new(graph, heuristic)),
        (ConfiguredEngine::LazyTheta(_), _) => Planner::of(LazyThetaStar::new(graph, heuristic)),
        (ConfiguredEngine::Canonical(_), Parts::Nothing) => {
            Planner::of(PaperCanonical::new(graph, heuristic))
        }
        (ConfiguredEngine::Canonical(_), Parts::Pruning(pruning)) => {
            Planner::of(Canonical::with_pruning(graph, Arc::clone(pruning), heuristic)?)
        }
        (ConfiguredEngine::Jps(own), Parts::Pruning(pruning)) => {
            let planner = Jps::with_finder(graph, Arc::clone(pruning), StepwiseFinder, heuristic)?;
            jumping(planner, own.jump_limit, own.keep_intermediate)
        }
        (ConfiguredEngine::JpsBlock(own), Parts::Blocks(pruning, blocks)) => {
            let planner = BlockJps::with_finder(graph, Arc::clone(pruning), blocks.clone(), heuristic)?;
            jumping(planner, own.jump_limit, own.keep_intermediate)
        }
        (ConfiguredEngine::JpsPlus(own), Parts::Table(pruning, table)) => {
            let planner = JpsPlus::with_finder(graph, Arc::clone(pruning), Arc::clone(table), heuristic)?;
            jumping(planner, None, own.keep_intermediate)
        }
        _ => return Ok(None),
    }))
}

/// A jump point search with its options.
fn jumping<P: Placement, H: Heuristic + Send + 'static, J: JumpFinder<P> + Send + 'static>(
    planner: JumpPointSearch<Arc<GridGraph<P>>, H, P, J>,
    limit: Option<NonZeroU32>,
    keep_intermediate: bool,
) -> Planner
where
    JumpPointSearch<Arc<GridGraph<P>>, H, P, J>: Search + Send + 'static,
{
    let planner = planner.with_jump_limit(limit.map(NonZeroU32::get));
    Planner::of(planner.with_intermediate(keep_intermediate))
}

/// CHPA*, compiled for each phase with and without a heuristic that overestimates.
fn chpa(
    setup: Setup,
    graph: &Arc<GridGraph<Centers>>,
    segments: &Arc<SegmentGraph>,
) -> Result<Planner, EngineError> {
    let ConfiguredEngine::Chpa(own) = setup.engine else { return Err(no_space(setup)) };
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
) -> Result<Planner, EngineError> {
    let engine = ConfiguredEngine::Chpa(own);
    let planner = ChpaStar::new(Arc::clone(graph), Arc::clone(segments), first, second)?;
    let planner = planner.with_fallback_policy(engine.fallback_policy().unwrap_or_default());
    Ok(Planner::of(match engine.step() {
        Some(step) => planner.with_step(step),
        None => planner,
    }))
}
