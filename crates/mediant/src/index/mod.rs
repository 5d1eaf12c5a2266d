//! Indexes: the parts that an engine prepares in a space.

mod file;
mod repair;

use std::{
    fmt,
    num::NonZeroU32,
    panic::{RefUnwindSafe, UnwindSafe},
    sync::Arc,
};

use mediant_grid::{Identity, Interrupt, names};
use mediant_moves::K;
use mediant_search::Smoothing;
use mediant_subgoal::Progress;

use crate::{
    call::Call,
    configured::ConfiguredEngine,
    engine::Engine,
    engines::{self, Boxed, EngineIndex, Source},
    error::Error,
    labeled::HasLabels,
    motion::Motion,
    never::NEVER,
    option::{
        EngineOption, Levels, OptionValue,
        table::{LANDMARKS, LEVELS, SIDE},
    },
    setup::Setup,
    setup_error::SetupError,
    space::Space,
};

/// An engine's preparation in a space, before the first query: nothing, a pruning rule, a jump table, dead
/// ends, hub labels, a subgoal graph, clusters, segments or landmarks. It never changes; all threads can
/// share it, and clones do. [`planner`](Self::planner) makes the planners on it.
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
#[derive(Clone)]
pub struct Index {
    space: Space,
    setup: Setup,
    origin: Origin,
    /// The engine's preparation, which makes the searches of planners.
    prepared: Arc<dyn EngineIndex>,
}

/// How an index came about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Origin {
    /// It was prepared.
    Prepared,
    /// It was read from bytes or a file.
    Loaded,
    /// It was repaired: only what an edit of the map touches was made anew.
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
    /// is the dead ends of [`Engine::Anya`] and [`Engine::JpsBlock`]; all other engines' indexes are the
    /// same. [Repairs](Index::repair) leave out the same. Those of block-based JPS take 0.5 to 0.6 of the
    /// instructions, its queries 1.1 to 1.6 times as many: that pays where some thirty to seventy queries or
    /// fewer come between two changes.
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
        let setup = Setup::new(engine, space.motion());
        space.check_setup(&setup)?;
        let prepared = engines::prepare(setup, space, source)?;
        let space = space.clone();
        if source.bytes.is_none() {
            return Ok(Self { space, setup, origin: Origin::Prepared, prepared });
        }
        let setup = Setup { engine: prepared.as_prepared().unwrap_or(engine), ..setup };
        Ok(Self { space, setup, origin: Origin::Loaded, prepared })
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
        let space = self.space.with_motion(Motion::of(k, self.setup.rules()), interrupt)?;
        let source = Source { interrupt, ..self.source() };
        let setup = Setup { motion: space.motion(), ..self.setup };
        space.check_setup(&setup)?;
        let prepared = match self.prepared.for_k(setup, &space, source)? {
            Some(prepared) => prepared,
            None => engines::prepare(setup, &space, source)?,
        };
        Ok(Self { space, setup, origin: Origin::Prepared, prepared })
    }

    /// To prepare another index as this one was.
    fn source(&self) -> Source<'static> {
        Source { for_one_path: self.prepared.is_for_one_path(), ..Source::new(&|_| {}) }
    }

    /// The same index for planners with other options of its engine, such as another heuristic. Options that
    /// are not named take their defaults, except those that decided what was prepared: the levels, the side
    /// and the landmarks stay as they are. The smoothing stays, too.
    ///
    /// # Errors
    /// [`Error::Setup`] for another engine, or options that do not fit together; [`Error::Levels`],
    /// [`Error::Side`] and [`Error::LandmarkCount`] for options that decide what is prepared, if the index
    /// has others.
    pub fn with_options(self, engine: impl Into<ConfiguredEngine>) -> Result<Self, Error> {
        let setup = Setup { engine: engine.into(), ..self.setup };
        self.space.check_setup(&setup)?;
        let (engine, known) = (setup.engine, self.setup.engine.kind());
        let prepared = self.prepared.with_options(engine)?;
        let prepared = prepared.ok_or(SetupError::OtherEngine { engine: engine.kind(), known })?;
        let engine = prepared.as_prepared().unwrap_or(engine);
        Ok(Self { setup: Setup { engine, ..setup }, prepared, ..self })
    }

    /// The same index for planners that smooth their paths, or do not. Where cells have costs there is
    /// [`Smoothing::Linear`], by segments that never raise the cost. A planner that is to pull paths taut
    /// says that it does not: [`QueryError::Smoothing`](mediant_search::QueryError::Smoothing).
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
        self.space.check_setup(&Setup { engine, smoothing: call.smoothing(), ..self.setup })?;
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
    /// prepares little searches. Its paths are as good: the setup's guarantee holds. Where an index is not
    /// [finished](Self::is_finished), each query may have [another engine](crate::Planner::searched_by).
    #[must_use]
    pub fn searched_by(&self) -> Engine {
        self.prepared.substitute().unwrap_or_else(|| self.setup.engine.kind())
    }

    /// The setup of its planners' searches: with the engine that [searches](Self::searched_by).
    pub(crate) fn search_setup(&self) -> Setup {
        let engine = self.prepared.substitute().map_or(self.setup.engine, ConfiguredEngine::from);
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

    /// The scratch memory that each of its planners takes when it is made, in bytes. Where the system hands
    /// memory out only when it is written, as most do, a planner uses no more of it than searches touch;
    /// what depends on a search alone, such as the open list, comes on top.
    #[must_use]
    pub fn scratch_bytes(&self) -> u64 {
        self.prepared.scratch_bytes() as u64
    }

    /// The engine that answered the last query of a search.
    pub(crate) fn answered_by(&self, search: &Boxed) -> Engine {
        self.prepared.answered_by(search).unwrap_or_else(|| self.setup.engine.kind())
    }

    /// A search for a planner.
    pub(crate) fn search(&self) -> Result<Boxed, Error> {
        self.prepared.search()
    }

    /// Makes a search of another index with the same options one of this index: see [`EngineIndex::follow`].
    pub(crate) fn follow(&self, search: &mut Boxed) -> Result<bool, Error> {
        self.prepared.follow(search)
    }

    /// Its hub labels, if it has any, for many goals. These are vertices of the labels: between centers at
    /// any angle no goal is.
    pub(crate) fn labels(&self) -> Option<&dyn HasLabels> {
        if self.space.is_between_centers() { None } else { self.prepared.labels() }
    }

    /// The value of an option, as [`ConfiguredEngine::value`], but levels, side and landmarks as they are in
    /// the index: where the setup leaves them out, a saved index decides them.
    #[must_use]
    pub fn value(&self, option: &EngineOption) -> Option<OptionValue> {
        match option.name {
            name if name == LEVELS.name => self.prepared.levels().map(OptionValue::Levels),
            name if name == SIDE.name => {
                self.prepared.side().and_then(NonZeroU32::new).map(OptionValue::Number)
            }
            name if name == LANDMARKS.name => self.prepared.landmarks().map(OptionValue::Number),
            _ => self.setup.engine.value(option),
        }
    }
}

// An index never changes, so a panic elsewhere cannot leave it half changed.
impl UnwindSafe for Index {}
impl RefUnwindSafe for Index {}

impl fmt::Debug for Index {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { setup, origin, .. } = self;
        let mut fields = f.debug_struct("Index");
        fields.field("setup", setup).field("origin", origin).field("memory_bytes", &self.memory_bytes());
        fields.finish_non_exhaustive()
    }
}
