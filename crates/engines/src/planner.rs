//! From a setup to a planner that is compiled for its types.

use std::{
    num::NonZeroU32,
    sync::Arc,
    time::{Duration, Instant},
};

use mediant_grid::{Centers, Corners, Grid, Lattice, Place, Rules};
use mediant_search::{
    AStar, BlockJps, Blocks, Canonical, Euclidean, Heuristic, Jps, JpsPlus, JumpTable, Jumping,
    LatticeDistance, Locator, PaperCanonical, Planner, Walk, Wavefront, Zero,
};

use crate::{
    Engine, EngineError, HeuristicName, Setup, SharedRule, Variant, rule::pruning, setup::without_index,
};

/// What preprocessing took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Preprocessing {
    /// The time, without that of a planner's scratch memory.
    pub time: Duration,
    /// The memory beyond the map itself.
    pub index_bytes: u64,
}

impl Preprocessing {
    /// This and something else.
    fn and(self, time: Duration, index_bytes: u64) -> Self {
        Self { time: self.time + time, index_bytes: self.index_bytes + index_bytes }
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
    setup.check()?;
    match setup.rules {
        Rules::Center(rule) => lattice_and_planner::<Centers, V>(setup, grid, rule, prebuilt, visit),
        Rules::Corner(gap) => lattice_and_planner::<Corners, V>(setup, grid, gap, prebuilt, visit),
    }
}

fn lattice_and_planner<P: Place, V: Visit>(
    setup: Setup,
    grid: &Arc<Grid>,
    rule: P::Rule,
    prebuilt: Prebuilt,
    visit: V,
) -> Result<V::Output, EngineError> {
    let begin = Instant::now();
    let lattice = Arc::new(Lattice::<P>::new(Arc::clone(grid), setup.k, rule)?);
    let time = begin.elapsed();
    let add_lattice =
        AddTo { visit, preprocessing: Preprocessing { time, index_bytes: lattice.index_bytes() as u64 } };
    with_planner_on(setup, lattice, prebuilt, add_lattice)
}

/// Hands on a planner together with what was spent before it.
struct AddTo<V> {
    visit: V,
    preprocessing: Preprocessing,
}

impl<V: Visit> Visit for AddTo<V> {
    type Output = V::Output;

    fn visit<P: Planner + Send + 'static>(self, planner: P, more: Preprocessing) -> V::Output {
        self.visit.visit(planner, self.preprocessing.and(more.time, more.index_bytes))
    }
}

/// [`with_planner`] on a lattice, which must be that of the setup's k and rules. The preprocessing is what came after the
/// lattice.
///
/// # Errors
/// [`EngineError`] for a setup that does not exist, or an index that is not the engine's for this lattice.
pub fn with_planner_on<P: Place, V: Visit>(
    setup: Setup,
    lattice: Arc<Lattice<P>>,
    prebuilt: Prebuilt,
    visit: V,
) -> Result<V::Output, EngineError> {
    setup.check()?;
    debug_assert_eq!((setup.k, setup.rules), (lattice.k(), lattice.rules()), "the lattice of another setup");
    if prebuilt.index.is_some() {
        setup.index_version()?;
    }
    match setup.heuristic() {
        HeuristicName::Hk => with_heuristic(setup, lattice, LatticeDistance, prebuilt, visit),
        HeuristicName::Euclidean => with_heuristic(setup, lattice, Euclidean, prebuilt, visit),
        HeuristicName::Zero => with_heuristic(setup, lattice, Zero, prebuilt, visit),
    }
}

/// Where each engine's planner is made. `setup` was checked.
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
fn timed<T, E>(make: impl FnOnce() -> Result<T, E>) -> Result<(T, Duration), E> {
    let begin = Instant::now();
    let made = make()?;
    Ok((made, begin.elapsed()))
}

/// The bytes of the index that the engine makes of a map, for [`Prebuilt`].
///
/// # Errors
/// [`EngineError`] for a setup that does not exist, or an engine whose preprocessing is not saved.
pub fn build(setup: Setup, grid: &Arc<Grid>) -> Result<(Vec<u8>, Preprocessing), EngineError> {
    setup.check()?;
    setup.index_version()?;
    let begin = Instant::now();
    let bytes = match setup.rules {
        Rules::Center(rule) => index_of(setup, &Lattice::<Centers>::new(Arc::clone(grid), setup.k, rule)?)?,
        Rules::Corner(gap) => index_of(setup, &Lattice::<Corners>::new(Arc::clone(grid), setup.k, gap)?)?,
    };
    let preprocessing = Preprocessing { time: begin.elapsed(), index_bytes: bytes.len() as u64 };
    Ok((bytes, preprocessing))
}

/// Where each engine's index is made.
fn index_of<P: Place>(setup: Setup, lattice: &Lattice<P>) -> Result<Vec<u8>, EngineError> {
    match setup.engine {
        Engine::JpsPlus => Ok(JumpTable::new(lattice)?.as_bytes().to_vec()),
        engine => Err(without_index(engine).into()),
    }
}
