//! From a setup to a planner that is compiled for its types.

use std::{
    num::NonZeroU32,
    ops::Deref,
    sync::Arc,
    time::{Duration, Instant},
};

use mediant_grid::{Corners, FreeSpace, Grid, GridGraph, Placement};
use mediant_search::{
    AStar, Anya, BlockJps, Blocks, Canonical, Euclidean, HasFreeSpace, Heuristic, Hk, Jps, JpsPlus,
    JumpFinder, JumpTable, Jumping, LazyThetaStar, PaperCanonical, Planner, Smoothed, Smoothing,
    SquaredEuclidean, ThetaStar, Walk, Wavefront, Zero,
};

use crate::{
    Engine, EngineError, Ground, HeuristicName, Hierarchy, Progress, Setup, SharedRule, Variant,
    ground::no_ground, rule::pruning, setup::without_index, squares, subgoal,
};

/// What preprocessing took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Preprocessing {
    /// The time, without that of a planner's scratch memory.
    pub time: Duration,
    /// The memory beyond the map itself.
    pub index_bytes: u64,
    /// The hierarchy of the subgoal graph or the levels of clusters, where there are any: with an index, those of the index.
    pub hierarchy: Option<Hierarchy>,
    /// The side of the lowest clusters or of the segments in cells, where there are any: with an index, those of the index.
    pub side: Option<u32>,
}

impl Preprocessing {
    /// This and something else.
    fn and(self, time: Duration, index_bytes: u64) -> Self {
        Self { time: self.time + time, index_bytes: self.index_bytes + index_bytes, ..self }
    }
}

/// Something to do with a planner, whatever its type.
pub trait Visit {
    /// What comes of it.
    type Output;

    /// Does it.
    fn visit<P: Planner + Send + 'static>(self, planner: P, preprocessing: Preprocessing) -> Self::Output;
}

/// What there is already of what an engine would make.
#[derive(Clone, Debug, Default)]
pub struct Prebuilt {
    /// The bytes that [`build`] gave.
    pub index: Option<Vec<u8>>,
    /// The pruning rule for the k and rules of the setup.
    pub rule: Option<SharedRule>,
}

/// Makes the planner and hands it to the visitor.
///
/// # Errors
/// [`EngineError`] for a setup that does not exist, or an index that is not the engine's for this map.
pub fn with_planner<V: Visit>(
    setup: Setup,
    grid: &Arc<Grid>,
    prebuilt: Prebuilt,
    visit: V,
) -> Result<V::Output, EngineError> {
    let (ground, time) = timed(|| Ground::new(setup, grid))?;
    let preprocessing =
        Preprocessing { time, index_bytes: ground.memory_bytes(), ..Preprocessing::default() };
    with_planner_on(setup, &ground, prebuilt, AddTo { visit, preprocessing })
}

/// Hands on a planner together with what was spent before it.
struct AddTo<V> {
    visit: V,
    preprocessing: Preprocessing,
}

impl<V: Visit> Visit for AddTo<V> {
    type Output = V::Output;

    fn visit<P: Planner + Send + 'static>(self, planner: P, more: Preprocessing) -> V::Output {
        let Preprocessing { time, index_bytes, .. } = self.preprocessing;
        self.visit.visit(planner, more.and(time, index_bytes))
    }
}

/// [`with_planner`] on a ground, which must be that of the setup's k and rules. The preprocessing is what came after the ground.
///
/// # Errors
/// [`EngineError`] for a setup that does not exist, a ground for another one, or an index that is not the engine's for this ground.
pub fn with_planner_on<V: Visit>(
    setup: Setup,
    ground: &Ground,
    prebuilt: Prebuilt,
    visit: V,
) -> Result<V::Output, EngineError> {
    setup.check()?;
    let (expected, found) = ((setup.k, setup.rules), (ground.k(), ground.rules()));
    if expected != found {
        return Err(EngineError::Ground { expected, found });
    }
    if prebuilt.index.is_some() {
        setup.index_version()?;
    }
    let index = prebuilt.index.as_deref();
    match ground {
        _ if matches!(setup.engine, Engine::Subgoal | Engine::SubgoalTheta) => {
            subgoal::with_graph(setup, ground, index, visit)
        }
        _ if matches!(setup.engine, Engine::Hpa | Engine::Chpa) => {
            squares::with_graph(setup, ground, index, visit)
        }
        Ground::Centers(grid_graph) => on_graph(setup, grid_graph, prebuilt, visit),
        Ground::Corners(grid_graph) => on_graph(setup, grid_graph, prebuilt, visit),
        Ground::AnyAngle(space) => on_space(setup, space, visit),
    }
}

/// Hands on a planner that smooths its paths, if they are to be smoothed.
pub(crate) struct Smooth<L, V> {
    pub(crate) visit: V,
    pub(crate) space: L,
    pub(crate) smoothing: Option<Smoothing>,
}

impl<L, V> Visit for Smooth<L, V>
where
    L: Deref<Target: HasFreeSpace> + Send + 'static,
    V: Visit,
{
    type Output = V::Output;

    fn visit<P: Planner + Send + 'static>(self, planner: P, preprocessing: Preprocessing) -> V::Output {
        self.visit.visit(Smoothed::new(planner, self.space, self.smoothing), preprocessing)
    }
}

/// Where the planners for every direction are made. `setup` was checked.
fn on_space<V: Visit>(
    setup: Setup,
    space: &Arc<FreeSpace<Corners>>,
    visit: V,
) -> Result<V::Output, EngineError> {
    let visit = Smooth { visit, space: Arc::clone(space), smoothing: setup.options.smoothing };
    match setup.engine {
        Engine::Anya => Ok(visit.visit(Anya::new(Arc::clone(space)), Preprocessing::default())),
        _ => Err(no_ground(setup)),
    }
}

fn on_graph<P: Placement, V: Visit>(
    setup: Setup,
    grid_graph: &Arc<GridGraph<P>>,
    prebuilt: Prebuilt,
    visit: V,
) -> Result<V::Output, EngineError> {
    let grid_graph = Arc::clone(grid_graph);
    let visit = Smooth { visit, space: Arc::clone(&grid_graph), smoothing: setup.options.smoothing };
    match setup.heuristic() {
        Some(HeuristicName::Hk) => with_heuristic(setup, grid_graph, Hk, prebuilt, visit),
        Some(HeuristicName::Euclidean) => with_heuristic(setup, grid_graph, Euclidean, prebuilt, visit),
        Some(HeuristicName::Zero) | None => with_heuristic(setup, grid_graph, Zero, prebuilt, visit),
        // Nothing else on a grid graph takes it: no other search need be compiled for it.
        Some(HeuristicName::SquaredEuclidean) => {
            Ok(visit.visit(AStar::new(grid_graph, SquaredEuclidean), Preprocessing::default()))
        }
    }
}

/// Where the planners for N(k) are made. `setup` was checked.
fn with_heuristic<P: Placement, H: Heuristic + Send + 'static, V: Visit>(
    setup: Setup,
    grid_graph: Arc<GridGraph<P>>,
    heuristic: H,
    prebuilt: Prebuilt,
    visit: V,
) -> Result<V::Output, EngineError> {
    let nothing = Preprocessing::default();
    Ok(match setup.engine {
        Engine::AStar | Engine::Dijkstra => visit.visit(AStar::new(grid_graph, heuristic), nothing),
        Engine::Wavefront => visit.visit(Wavefront::new(grid_graph), nothing),
        Engine::Canonical if setup.variant() == Some(Variant::Paper) => {
            visit.visit(PaperCanonical::new(grid_graph, heuristic), nothing)
        }
        Engine::Canonical => {
            let (pruning, took) = pruning(&grid_graph, prebuilt.rule);
            visit.visit(Canonical::with_pruning(grid_graph, pruning, heuristic), took)
        }
        Engine::Jps => {
            let (pruning, took) = pruning(&grid_graph, prebuilt.rule);
            let planner = Jps::with_finder(grid_graph, pruning, Walk, heuristic);
            visit.visit(with_options(planner, setup), took)
        }
        Engine::JpsBlock => {
            let (pruning, took) = pruning(&grid_graph, prebuilt.rule);
            let (blocks, more) = timed(|| Blocks::new(&*grid_graph, &pruning))?;
            let bytes = blocks.memory_bytes() as u64;
            let planner = BlockJps::with_finder(grid_graph, pruning, blocks, heuristic);
            visit.visit(with_options(planner, setup), took.and(more, bytes))
        }
        Engine::JpsPlus => {
            let (pruning, took) = pruning(&grid_graph, prebuilt.rule);
            let (table, more) = timed(|| match prebuilt.index {
                None => JumpTable::new(&*grid_graph).map_err(EngineError::from),
                Some(bytes) => JumpTable::from_bytes(&*grid_graph, bytes).map_err(EngineError::from),
            })?;
            let bytes = table.memory_bytes() as u64;
            let planner = JpsPlus::with_finder(grid_graph, pruning, Arc::new(table), heuristic);
            visit.visit(with_options(planner, setup), took.and(more, bytes))
        }
        Engine::Theta => visit.visit(ThetaStar::new(grid_graph, heuristic), nothing),
        Engine::LazyTheta => visit.visit(LazyThetaStar::new(grid_graph, heuristic), nothing),
        Engine::Anya | Engine::Subgoal | Engine::SubgoalTheta | Engine::Hpa | Engine::Chpa => {
            return Err(no_ground(setup));
        }
    })
}

fn with_options<P: Placement, H: Heuristic, J: JumpFinder<P>>(
    planner: Jumping<Arc<GridGraph<P>>, H, P, J>,
    setup: Setup,
) -> Jumping<Arc<GridGraph<P>>, H, P, J> {
    let limit = setup.options.jump_limit.map(NonZeroU32::get);
    planner.with_jump_limit(limit).with_intermediate(setup.options.intermediate)
}

/// What `make` makes, and how long it took.
pub(crate) fn timed<T, E>(make: impl FnOnce() -> Result<T, E>) -> Result<(T, Duration), E> {
    let begin = Instant::now();
    let made = make()?;
    Ok((made, begin.elapsed()))
}

/// The bytes of the index that the engine makes of a map, for [`Prebuilt`].
///
/// # Errors
/// [`EngineError`] for a setup that does not exist, or an engine whose preprocessing is not saved.
pub fn build(setup: Setup, grid: &Arc<Grid>) -> Result<(Vec<u8>, Preprocessing), EngineError> {
    build_with_progress(setup, grid, &|_| {})
}

/// [`build`], telling `progress` how far it is, from any thread. Engines that build fast tell nothing.
///
/// # Errors
/// As [`build`].
pub fn build_with_progress(
    setup: Setup,
    grid: &Arc<Grid>,
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<(Vec<u8>, Preprocessing), EngineError> {
    setup.check()?;
    setup.index_version()?;
    let nothing = Preprocessing::default();
    let ((bytes, about), time) = timed(|| {
        let ground = Ground::new(setup, grid)?;
        match (setup.engine, &ground) {
            (Engine::Subgoal | Engine::SubgoalTheta, _) => {
                let hierarchy = setup.hierarchy();
                let bytes = subgoal::build(setup, &ground, progress)?;
                Ok((bytes, Preprocessing { hierarchy, ..nothing }))
            }
            (Engine::Hpa | Engine::Chpa, _) => squares::build(setup, &ground),
            (Engine::JpsPlus, Ground::Centers(grid_graph)) => Ok((jump_table(grid_graph)?, nothing)),
            (Engine::JpsPlus, Ground::Corners(grid_graph)) => Ok((jump_table(grid_graph)?, nothing)),
            (engine, _) => Err(EngineError::from(without_index(engine))),
        }
    })?;
    let index_bytes = bytes.len() as u64;
    Ok((bytes, Preprocessing { time, index_bytes, ..about }))
}

fn jump_table<P: Placement>(grid_graph: &GridGraph<P>) -> Result<Vec<u8>, EngineError> {
    Ok(JumpTable::new(grid_graph)?.as_bytes().to_vec())
}
