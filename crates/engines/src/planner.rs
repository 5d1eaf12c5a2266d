//! From a setup to a planner that is compiled for its types.

use std::{
    num::NonZeroU32,
    ops::Deref,
    sync::Arc,
    time::{Duration, Instant},
};

use mediant_grid::{Corners, Grid, Lattice, Place, Terrain};
use mediant_search::{
    AStar, Anya, BlockJps, Blocks, Canonical, Euclidean, Heuristic, Jps, JpsPlus, JumpTable, Jumping,
    LatticeDistance, LazyThetaStar, Locator, OnTerrain, PaperCanonical, Planner, Smoothed, Smoothing,
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
    let preprocessing = Preprocessing { time, index_bytes: ground.index_bytes(), ..Preprocessing::default() };
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
        Ground::Centers(lattice) => on_lattice(setup, lattice, prebuilt, visit),
        Ground::Corners(lattice) => on_lattice(setup, lattice, prebuilt, visit),
        Ground::AnyAngle(terrain) => on_terrain(setup, terrain, visit),
    }
}

/// Hands on a planner that smooths its paths, if they are to be smoothed.
pub(crate) struct Smooth<L, V> {
    pub(crate) visit: V,
    pub(crate) terrain: L,
    pub(crate) smoothing: Option<Smoothing>,
}

impl<L, V> Visit for Smooth<L, V>
where
    L: Deref<Target: OnTerrain> + Send + 'static,
    V: Visit,
{
    type Output = V::Output;

    fn visit<P: Planner + Send + 'static>(self, planner: P, preprocessing: Preprocessing) -> V::Output {
        self.visit.visit(Smoothed::new(planner, self.terrain, self.smoothing), preprocessing)
    }
}

/// Where the planners for every direction are made. `setup` was checked.
fn on_terrain<V: Visit>(
    setup: Setup,
    terrain: &Arc<Terrain<Corners>>,
    visit: V,
) -> Result<V::Output, EngineError> {
    let visit = Smooth { visit, terrain: Arc::clone(terrain), smoothing: setup.options.smoothing };
    match setup.engine {
        Engine::Anya => Ok(visit.visit(Anya::new(Arc::clone(terrain)), Preprocessing::default())),
        _ => Err(no_ground(setup)),
    }
}

fn on_lattice<P: Place, V: Visit>(
    setup: Setup,
    lattice: &Arc<Lattice<P>>,
    prebuilt: Prebuilt,
    visit: V,
) -> Result<V::Output, EngineError> {
    let lattice = Arc::clone(lattice);
    let visit = Smooth { visit, terrain: Arc::clone(&lattice), smoothing: setup.options.smoothing };
    match setup.heuristic() {
        Some(HeuristicName::Hk) => with_heuristic(setup, lattice, LatticeDistance, prebuilt, visit),
        Some(HeuristicName::Euclidean) => with_heuristic(setup, lattice, Euclidean, prebuilt, visit),
        Some(HeuristicName::Zero) | None => with_heuristic(setup, lattice, Zero, prebuilt, visit),
        // Nothing else on a lattice takes it: no other search need be compiled for it.
        Some(HeuristicName::SquaredEuclidean) => {
            Ok(visit.visit(AStar::new(lattice, SquaredEuclidean), Preprocessing::default()))
        }
    }
}

/// Where the planners for N(k) are made. `setup` was checked.
fn with_heuristic<P: Place, H: Heuristic + Send + 'static, V: Visit>(
    setup: Setup,
    lattice: Arc<Lattice<P>>,
    heuristic: H,
    prebuilt: Prebuilt,
    visit: V,
) -> Result<V::Output, EngineError> {
    let nothing = Preprocessing::default();
    Ok(match setup.engine {
        Engine::AStar | Engine::Dijkstra => visit.visit(AStar::new(lattice, heuristic), nothing),
        Engine::Wavefront => visit.visit(Wavefront::new(lattice), nothing),
        Engine::Canonical if setup.variant() == Some(Variant::Paper) => {
            visit.visit(PaperCanonical::new(lattice, heuristic), nothing)
        }
        Engine::Canonical => {
            let (pruning, took) = pruning(&lattice, prebuilt.rule);
            visit.visit(Canonical::with_pruning(lattice, pruning, heuristic), took)
        }
        Engine::Jps => {
            let (pruning, took) = pruning(&lattice, prebuilt.rule);
            let planner = Jps::with_locator(lattice, pruning, Walk, heuristic);
            visit.visit(with_options(planner, setup), took)
        }
        Engine::JpsBlock => {
            let (pruning, took) = pruning(&lattice, prebuilt.rule);
            let (blocks, more) = timed(|| Blocks::new(&*lattice, &pruning))?;
            let bytes = blocks.bytes() as u64;
            let planner = BlockJps::with_locator(lattice, pruning, blocks, heuristic);
            visit.visit(with_options(planner, setup), took.and(more, bytes))
        }
        Engine::JpsPlus => {
            let (pruning, took) = pruning(&lattice, prebuilt.rule);
            let (table, more) = timed(|| match prebuilt.index {
                None => JumpTable::new(&*lattice).map_err(EngineError::from),
                Some(bytes) => JumpTable::from_bytes(&*lattice, bytes).map_err(EngineError::from),
            })?;
            let bytes = table.bytes() as u64;
            let planner = JpsPlus::with_locator(lattice, pruning, Arc::new(table), heuristic);
            visit.visit(with_options(planner, setup), took.and(more, bytes))
        }
        Engine::Theta => visit.visit(ThetaStar::new(lattice, heuristic), nothing),
        Engine::LazyTheta => visit.visit(LazyThetaStar::new(lattice, heuristic), nothing),
        Engine::Anya | Engine::Subgoal | Engine::SubgoalTheta | Engine::Hpa | Engine::Chpa => {
            return Err(no_ground(setup));
        }
    })
}

fn with_options<P: Place, H: Heuristic, J: Locator<P>>(
    planner: Jumping<Arc<Lattice<P>>, H, P, J>,
    setup: Setup,
) -> Jumping<Arc<Lattice<P>>, H, P, J> {
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
            (Engine::JpsPlus, Ground::Centers(lattice)) => Ok((jump_table(lattice)?, nothing)),
            (Engine::JpsPlus, Ground::Corners(lattice)) => Ok((jump_table(lattice)?, nothing)),
            (engine, _) => Err(EngineError::from(without_index(engine))),
        }
    })?;
    let index_bytes = bytes.len() as u64;
    Ok((bytes, Preprocessing { time, index_bytes, ..about }))
}

fn jump_table<P: Place>(lattice: &Lattice<P>) -> Result<Vec<u8>, EngineError> {
    Ok(JumpTable::new(lattice)?.as_bytes().to_vec())
}
