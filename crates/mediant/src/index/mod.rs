//! Indexes: the parts that an engine prepares in a space.

mod file;
mod hierarchies;
mod parts;
mod repair;
mod shape;
mod source;
mod subgoals;

use std::{num::NonZeroU32, sync::Arc};

use mediant_grid::{Corners, FreeSpace, GridGraph, Identity, Interrupt, names};
use mediant_moves::K;
use mediant_search::{DeadEnds, JumpTable, Smoothing, parts::BlockFinder};
use mediant_subgoal::{Progress, SubgoalPlacement};

pub(crate) use self::parts::{InFreeSpace, OnGridGraph, Prepared};
pub(crate) use self::source::Source;
use crate::{
    call::Call,
    configured::ConfiguredEngine,
    engine::Engine,
    error::Error,
    motion::Motion,
    option::{
        EngineOption, Levels, OptionValue, Variant,
        description::{LEVELS, SIDE},
    },
    scratch,
    setup::Setup,
    setup_error::SetupError,
    shared_rules::{self, Shared},
    space::{Layers, Placed, Space},
    within::NEVER,
};

/// An engine's preparation in a space, before the first query: nothing, a pruning rule, a jump table, dead
/// ends, hub labels, a subgoal graph, clusters or segments. It never changes; all threads can share it, and
/// clones do. [`planner`](Self::planner) makes the planners on it.
///
/// ```
/// use mediant::{Engine, K, Map, Motion, Query};
///
/// let map = Map::from_fn(9, 9, |x, y| x == 4 && y != 8)?;
/// let index = map.space(Motion::corners(K::ANY))?.prepare(Engine::Subgoal)?;
/// // On another day, or in another program:
/// let bytes = index.to_bytes()?;
/// let index = map.space(Motion::corners(K::ANY))?.index_from_bytes(bytes)?;
/// assert!(index.planner().find(Query::new((0, 0), (9, 0)))?.path().is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Index {
    space: Space,
    setup: Setup,
    origin: Origin,
    /// The search space, with the parts prepared on it.
    pub(crate) prepared: Prepared,
    /// The engine that searches in place of the setup's, which kept nothing.
    substitute: Option<Engine>,
}

/// How an index came about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Origin {
    /// It was prepared.
    Prepared,
    /// It was read from bytes or a file.
    Loaded,
    /// It was repaired: only the clusters or segments that an edit of the map touches were made anew.
    Repaired,
    /// It is the index of an equal map.
    Unchanged,
}

names!(Origin:
    Prepared => "prepared",
    Loaded => "loaded",
    Repaired => "repaired",
    Unchanged => "unchanged",
);

impl Space {
    /// Prepares what an engine needs. The index belongs to this space; any number of planners share it.
    ///
    /// # Errors
    /// [`Error::Setup`] for an engine that does not take the space's k or rules, or options that do not fit
    /// together; an error of the engine if the map is too large for its index.
    pub fn prepare(&self, engine: impl Into<ConfiguredEngine>) -> Result<Index, Error> {
        Index::new(self, engine.into(), &|_| {})
    }

    /// [`prepare`](Self::prepare) for a single path: what takes longer than it saves one is left out. That
    /// is the dead ends of [`Engine::Anya`]; all other engines' indexes are the same.
    ///
    /// ```
    /// use mediant::{Engine, K, Map, Motion, Query};
    ///
    /// let space = Map::from_fn(9, 9, |x, y| x == 4 && y != 8)?.space(Motion::corners(K::ANY))?;
    /// let index = space.prepare_for_one_path(Engine::Anya)?;
    /// assert_eq!(index.memory_bytes(), 0);
    /// assert!(index.try_planner()?.find(Query::new((0, 0), (9, 0)))?.path().is_some());
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// As for [`prepare`](Self::prepare).
    pub fn prepare_for_one_path(&self, engine: impl Into<ConfiguredEngine>) -> Result<Index, Error> {
        let source = Source { for_one_path: true, ..Source::new(&|_| {}) };
        Index::from_source(self, engine.into(), source)
    }

    /// [`prepare`](Self::prepare), which calls `progress` from any thread. Only subgoal graphs report
    /// progress.
    ///
    /// # Errors
    /// As for [`prepare`](Self::prepare).
    pub fn prepare_with_progress(
        &self,
        engine: impl Into<ConfiguredEngine>,
        progress: &(dyn Fn(Progress) + Sync),
    ) -> Result<Index, Error> {
        Index::new(self, engine.into(), progress)
    }
}

impl Index {
    pub(crate) fn new(
        space: &Space,
        engine: ConfiguredEngine,
        progress: &(dyn Fn(Progress) + Sync),
    ) -> Result<Self, Error> {
        Self::from_source(space, engine, Source::new(progress))
    }

    /// Prepares a new index, or reads a saved one.
    pub(crate) fn from_source(
        space: &Space,
        engine: ConfiguredEngine,
        source: Source<'_>,
    ) -> Result<Self, Error> {
        let Motion { k, rules, .. } = space.motion();
        let setup = Setup::new(engine, k, rules);
        setup.check()?;
        let (prepared, substitute) = match prepared(setup, space, source)? {
            Some(prepared) => (prepared, None),
            None => {
                let engine = subgoals::substitute(space.motion());
                let source = Source { bytes: None, ..source };
                let prepared = prepared(Setup { engine: engine.into(), ..setup }, space, source)?;
                (prepared.ok_or_else(|| SetupError::without_index(engine))?, Some(engine))
            }
        };
        prepared.check_shape(setup.engine)?;
        let space = space.clone();
        if source.bytes.is_none() {
            return Ok(Self { space, setup, origin: Origin::Prepared, prepared, substitute });
        }
        let setup = Setup { engine: prepared.with_shape(engine)?, ..setup };
        Ok(Self { space, setup, origin: Origin::Loaded, prepared, substitute })
    }

    /// The index for another k, with the same map, rules, options and smoothing. Hub labels at corners share
    /// what does not depend on k, most of the work and often most of the memory: the other k costs its labels
    /// alone. The dead ends of Anya are the same for every k. All else is prepared anew.
    ///
    /// ```
    /// use mediant::{Engine, K, Map, Motion};
    ///
    /// let space = Map::from_fn(40, 30, |x, _| x == 20)?.space(Motion::corners(K::ANY))?;
    /// let any = space.prepare(Engine::Subgoal)?;
    /// let coarse = any.for_k(K::N8)?;
    /// assert_eq!(coarse.space().motion(), Motion::corners(K::N8));
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// As for [`Map::space`](crate::Map::space) and [`Space::prepare`].
    pub fn for_k(&self, k: K) -> Result<Self, Error> {
        self.prepared_for_k(k, &NEVER)
    }

    pub(crate) fn prepared_for_k(&self, k: K, interrupt: &Interrupt) -> Result<Self, Error> {
        let space = Space::new(self.space.map(), Motion::of(k, self.setup.rules), interrupt)?;
        let source = Source { beside: Some(&self.prepared), interrupt, ..self.source() };
        Ok(Self::from_source(&space, self.setup.engine, source)?.with_smoothing(self.setup.smoothing))
    }

    /// To prepare another index as this one was.
    fn source(&self) -> Source<'static> {
        Source { for_one_path: self.prepared.is_for_one_path(), ..Source::new(&|_| {}) }
    }

    /// The same index for planners with other options of its engine, such as another heuristic. Options that
    /// are not named take their defaults, except those that decided what was prepared: the levels and the
    /// side stay as they are. The smoothing stays, too.
    ///
    /// # Errors
    /// [`Error::Setup`] for another engine, or options that do not fit together; [`Error::Levels`] and
    /// [`Error::Side`] for options that decide what is prepared, if the index has others.
    pub fn with_options(self, engine: impl Into<ConfiguredEngine>) -> Result<Self, Error> {
        let setup = Setup { engine: engine.into(), ..self.setup };
        setup.check()?;
        self.prepared.check(setup, self.setup)?;
        Ok(Self { setup: Setup { engine: self.prepared.with_shape(setup.engine)?, ..setup }, ..self })
    }

    /// The same index for planners that smooth their paths, or do not.
    #[must_use]
    pub fn with_smoothing(self, smoothing: Option<Smoothing>) -> Self {
        Self { setup: Setup { smoothing, ..self.setup }, ..self }
    }

    /// The same index with the options and the smoothing of a call.
    ///
    /// # Errors
    /// As for [`with_options`](Self::with_options).
    pub fn with_call(&self, call: &Call) -> Result<Self, Error> {
        let engine = call.configured(self.setup.engine.kind())?;
        Ok(self.clone().with_options(engine)?.with_smoothing(call.smoothing()))
    }

    /// The levels of its subgoal graph or clusters, or what it has instead; `None` for an index without any.
    #[must_use]
    pub fn levels(&self) -> Option<Levels> {
        match self.value(&LEVELS) {
            Some(OptionValue::Levels(levels)) => Some(levels),
            _ => None,
        }
    }

    /// The space that it belongs to.
    #[must_use]
    pub const fn space(&self) -> &Space {
        &self.space
    }

    /// The identity: its map, rules and k.
    #[must_use]
    pub fn identity(&self) -> Identity {
        self.space.identity()
    }

    /// The engine with its options, its motion and smoothing. Of an index that was read, or has got other
    /// options, the levels and the side are named: [`Setup::prepare`] makes the same index again.
    #[must_use]
    pub const fn setup(&self) -> Setup {
        self.setup
    }

    /// The engine of its planners. It is that of the [`setup`](Self::setup), but for subgoals of a map on
    /// which they would be slow, as on noise: nothing is kept of them there, and the best engine that
    /// prepares little searches. Its paths are as good: the setup's guarantee holds.
    #[must_use]
    pub const fn searched_by(&self) -> Engine {
        match self.substitute {
            Some(engine) => engine,
            None => self.setup.engine.kind(),
        }
    }

    /// The setup of its planners' searches: with the engine that [searches](Self::searched_by).
    pub(crate) fn search_setup(&self) -> Setup {
        let engine = self.substitute.map_or(self.setup.engine, ConfiguredEngine::from);
        Setup { engine, ..self.setup }
    }

    /// How it came about: [`repair`](Self::repair) says so what could be repaired.
    #[must_use]
    pub const fn origin(&self) -> Origin {
        self.origin
    }

    /// The memory that it uses beyond the space, in bytes: once, however many planners and clones share it.
    /// It includes the pruning rule of its k and rules, which all indexes of the process share.
    #[must_use]
    pub fn memory_bytes(&self) -> u64 {
        self.prepared.memory_bytes() as u64
    }

    /// The value of an option, as [`ConfiguredEngine::value`], but levels and side as they are in the index:
    /// where the setup leaves them out, a saved index decides them.
    #[must_use]
    pub fn value(&self, option: &EngineOption) -> Option<OptionValue> {
        let (levels, side) = self.prepared.shape();
        match option.name {
            name if name == LEVELS.name => levels.map(OptionValue::Levels),
            name if name == SIDE.name => side.and_then(NonZeroU32::new).map(OptionValue::Number),
            _ => self.setup.engine.value(option),
        }
    }
}

/// Prepares the parts of a setup's engine in a space; `None` if subgoals kept nothing.
fn prepared(setup: Setup, space: &Space, source: Source<'_>) -> Result<Option<Prepared>, Error> {
    Ok(Some(match space.placed() {
        Placed::Centers(layers) => match setup.engine {
            ConfiguredEngine::Hpa(_) => {
                let graph = layers.graph(setup.finite_k()?)?;
                let clusters = hierarchies::clusters(setup.engine, graph, source)?;
                Prepared::Centers(Arc::clone(graph), OnGridGraph::Clusters(clusters))
            }
            ConfiguredEngine::Chpa(own) => {
                let graph = layers.graph(setup.finite_k()?)?;
                let segments = hierarchies::segments(own, graph, source)?;
                Prepared::Centers(Arc::clone(graph), OnGridGraph::Segments(segments))
            }
            ConfiguredEngine::Subgoal(_) | ConfiguredEngine::SubgoalTheta(_) => {
                let parts = subgoals::subgoals(setup, &layers.free, source, None)?;
                return Ok(parts.map(|parts| Prepared::FreeCenters(Arc::clone(&layers.free), parts)));
            }
            _ => {
                let (graph, parts) = on_grid_graph(setup, layers, source)?;
                Prepared::Centers(graph, parts)
            }
        },
        Placed::Corners(layers) => match setup.engine {
            ConfiguredEngine::Anya => {
                let parts = match source.beside.and_then(Prepared::dead_ends) {
                    Some(dead_ends) => InFreeSpace::DeadEnds(Arc::clone(dead_ends)),
                    None if source.for_one_path => InFreeSpace::Nothing,
                    None => dead_ends(&layers.free, source.interrupt)?,
                };
                Prepared::FreeCorners(Arc::clone(&layers.free), parts)
            }
            ConfiguredEngine::Subgoal(_) | ConfiguredEngine::SubgoalTheta(_) => {
                let beside = source.beside.and_then(Prepared::labels);
                let parts = subgoals::subgoals(setup, &layers.free, source, beside)?;
                return Ok(parts.map(|parts| Prepared::FreeCorners(Arc::clone(&layers.free), parts)));
            }
            _ => {
                let (graph, parts) = on_grid_graph(setup, layers, source)?;
                Prepared::Corners(graph, parts)
            }
        },
    }))
}

/// The dead ends of a map, which Anya leaves out.
fn dead_ends(space: &FreeSpace<Corners>, interrupt: &Interrupt) -> Result<InFreeSpace<Corners>, Error> {
    scratch::check("the index", DeadEnds::bytes(space) as u64)?;
    Ok(InFreeSpace::DeadEnds(Arc::new(DeadEnds::interruptible(space, interrupt)?)))
}

/// The grid graph, and what an engine prepares of it, if it takes either placement.
fn on_grid_graph<P: SubgoalPlacement + Shared>(
    setup: Setup,
    layers: &Layers<P>,
    source: Source<'_>,
) -> Result<(Arc<GridGraph<P>>, OnGridGraph<P>), Error> {
    let graph = layers.graph(setup.finite_k()?)?;
    let pruning = || shared_rules::pruning(graph, source.interrupt);
    let parts = match setup.engine {
        ConfiguredEngine::AStar(_)
        | ConfiguredEngine::Dijkstra
        | ConfiguredEngine::Wavefront
        | ConfiguredEngine::Theta(_)
        | ConfiguredEngine::LazyTheta(_) => OnGridGraph::Nothing,
        ConfiguredEngine::Canonical(own) if own.variant == Some(Variant::Paper) => OnGridGraph::Nothing,
        ConfiguredEngine::Canonical(_) | ConfiguredEngine::Jps(_) => OnGridGraph::Pruning(pruning()?),
        ConfiguredEngine::JpsBlock(_) => {
            let pruning = pruning()?;
            scratch::check("the index", BlockFinder::bytes(graph) as u64)?;
            let blocks = BlockFinder::interruptible(graph, &pruning, source.interrupt)?;
            OnGridGraph::Blocks(pruning, blocks)
        }
        ConfiguredEngine::JpsPlus(_) => {
            scratch::check("the index", JumpTable::bytes(graph) as u64)?;
            let table = match source.bytes {
                None => JumpTable::interruptible(graph, source.interrupt)?,
                Some(bytes) => JumpTable::from_bytes_interruptible(graph, bytes, source.interrupt)?,
            };
            OnGridGraph::Table(pruning()?, Arc::new(table))
        }
        // `Setup::check` has refused these at corners, and they are not handed here at centers.
        ConfiguredEngine::Anya
        | ConfiguredEngine::Subgoal(_)
        | ConfiguredEngine::SubgoalTheta(_)
        | ConfiguredEngine::Hpa(_)
        | ConfiguredEngine::Chpa(_) => return Err(SetupError::without_index(setup.engine.kind()).into()),
    };
    Ok((Arc::clone(graph), parts))
}
