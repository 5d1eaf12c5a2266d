//! Work that a flag or a deadline can stop.

use std::path::Path as FilePath;

use mediant_grid::{Clearance, Fit, Outside, Point, Vertex};
use mediant_moves::K;
use mediant_search::{Ends, Limits, Path, PointEnds};
use mediant_subgoal::Progress;

#[cfg(feature = "costs")]
use crate::costs::Costs;
use crate::{
    agent::WidestPath,
    change::Change,
    configured::ConfiguredEngine,
    engine::Engine,
    engines::Source,
    error::Error,
    field::{Field, Fields, Sources},
    goals::Goals,
    index::Index,
    map::Map,
    motion::Motion,
    planner::Planner,
    space::Space,
    table::Table,
};

/// A map, space, index or field whose work stops at a deadline or by a flag: each call that can take long is
/// also a call of this one, with the same result. A stopped call returns [`Error::Stopped`] soon, keeps no
/// memory and leaves no thread at work. Results know nothing of the limits.
///
/// The time, the deadline and the flag of the [`Limits`](crate::Limits) count; those on cost and expansions
/// are of searches.
///
/// ```
/// use std::{sync::{Arc, atomic::{AtomicBool, Ordering}}, time::Duration};
/// use mediant::{Engine, ErrorCode, K, Limits, Map, Motion};
///
/// let cancelled = Arc::new(AtomicBool::new(false));
/// let limits = Limits::new().time(Duration::from_secs(60)).cancel(Arc::clone(&cancelled));
/// let map = Map::from_fn(40, 30, |x, _| x == 20)?;
/// let space = map.within(&limits).space(Motion::corners(K::ANY))?;
/// let index = space.within(&limits).prepare(Engine::Subgoal)?;
/// // Another thread would do this.
/// cancelled.store(true, Ordering::Relaxed);
/// let stopped = space.within(&limits).prepare(Engine::Subgoal).unwrap_err();
/// assert_eq!(stopped.code(), ErrorCode::Cancelled);
/// # Ok::<(), mediant::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Within<'a, T> {
    pub(crate) of: &'a T,
    pub(crate) limits: Limits,
}

impl Map {
    /// This map, for work that stops at a deadline or by a flag.
    #[must_use]
    pub fn within(&self, limits: impl Into<Limits>) -> Within<'_, Self> {
        Within { of: self, limits: limits.into() }
    }
}

#[cfg(feature = "costs")]
impl Costs {
    /// These costs, for work that stops at a deadline or by a flag.
    #[must_use]
    pub fn within(&self, limits: impl Into<Limits>) -> Within<'_, Self> {
        Within { of: self, limits: limits.into() }
    }
}

#[cfg(feature = "costs")]
impl Within<'_, Costs> {
    /// [`Costs::space`].
    ///
    /// # Errors
    /// As for [`Costs::space`], and [`Error::Stopped`].
    pub fn space(&self, motion: impl Into<Motion>) -> Result<Space, Error> {
        Space::of_costs(self.of, motion.into(), self.limits.interrupt())
    }

    /// [`Costs::load`].
    ///
    /// # Errors
    /// As for [`Costs::load`], and [`Error::Stopped`].
    pub fn load(&self, path: impl AsRef<FilePath>) -> Result<Index, Error> {
        self.of.load_index(path.as_ref(), self.limits.interrupt())
    }

    /// [`Costs::index_from_bytes`].
    ///
    /// # Errors
    /// As for [`Costs::index_from_bytes`], and [`Error::Stopped`].
    pub fn index_from_bytes(&self, bytes: Vec<u8>) -> Result<Index, Error> {
        self.of.read_index(bytes, self.limits.interrupt())
    }
}

impl Space {
    /// This space, for work that stops at a deadline or by a flag.
    #[must_use]
    pub fn within(&self, limits: impl Into<Limits>) -> Within<'_, Self> {
        Within { of: self, limits: limits.into() }
    }
}

impl Index {
    /// This index, for work that stops at a deadline or by a flag.
    #[must_use]
    pub fn within(&self, limits: impl Into<Limits>) -> Within<'_, Self> {
        Within { of: self, limits: limits.into() }
    }
}

impl Field {
    /// This field, for work that stops at a deadline or by a flag.
    #[must_use]
    pub fn within(&self, limits: impl Into<Limits>) -> Within<'_, Self> {
        Within { of: self, limits: limits.into() }
    }
}

impl Within<'_, Field> {
    /// [`Field::repair`]; the field stays as it is.
    ///
    /// # Errors
    /// As for [`Field::repair`], and [`Error::Stopped`].
    pub fn repair(&self, change: &Change) -> Result<Field, Error> {
        self.of.repaired(change, self.limits.interrupt())
    }
}

impl Within<'_, Map> {
    /// [`Map::space`].
    ///
    /// # Errors
    /// As for [`Map::space`], and [`Error::Stopped`].
    pub fn space(&self, motion: impl Into<Motion>) -> Result<Space, Error> {
        Space::new(self.of, motion.into(), self.limits.interrupt())
    }

    /// [`Map::costs`].
    ///
    /// # Errors
    /// As for [`Map::costs`], and [`Error::Stopped`].
    #[cfg(feature = "costs")]
    pub fn costs<C: Into<f64>>(&self, costs: impl IntoIterator<Item = C>) -> Result<Costs, Error> {
        Costs::new(self.of, costs, self.limits.interrupt())
    }

    /// [`Map::path`].
    ///
    /// # Errors
    /// As for [`Map::path`], and [`Error::Stopped`].
    pub fn path(&self, start: impl Into<Vertex>, goal: impl Into<Vertex>) -> Result<Option<Path>, Error> {
        self.of.path_of(Ends::new(start, goal), &self.limits)
    }

    /// [`Map::clearance`].
    ///
    /// # Errors
    /// [`SetupError::LongSide`](crate::errors::SetupError::LongSide) for a map that is for costs alone;
    /// [`Error::Stopped`].
    pub fn clearance(&self, fit: Fit, outside: Outside) -> Result<Clearance, Error> {
        self.of.check_sides("clearance")?;
        let grid = self.of.grid().clone();
        Ok(Clearance::interruptible(grid, fit, outside, self.limits.interrupt())?)
    }

    /// [`Map::for_disc`].
    ///
    /// # Errors
    /// As for [`Map::for_disc`], and [`Error::Stopped`].
    pub fn for_disc(&self, radius: f64, motion: impl Into<Motion>) -> Result<Map, Error> {
        let motion = motion.into();
        motion.check_k()?;
        let clearance = self.clearance(Fit::exact(motion.rules, motion.k), Outside::Blocked)?;
        Ok(clearance.for_disc_interruptible(radius, self.limits.interrupt())?.into())
    }

    /// [`Map::for_square`].
    ///
    /// # Errors
    /// As for [`Map::for_square`], and [`Error::Stopped`].
    pub fn for_square(&self, n: u32) -> Result<Map, Error> {
        self.of.check_sides("clearance")?;
        Ok(self.of.grid().for_square_interruptible(n, self.limits.interrupt())?.into())
    }

    /// [`Map::load`].
    ///
    /// # Errors
    /// As for [`Map::load`], and [`Error::Stopped`].
    pub fn load(&self, path: impl AsRef<FilePath>) -> Result<Index, Error> {
        self.of.load_index(path.as_ref(), self.limits.interrupt())
    }

    /// [`Map::index_from_bytes`].
    ///
    /// # Errors
    /// As for [`Map::index_from_bytes`], and [`Error::Stopped`].
    pub fn index_from_bytes(&self, bytes: Vec<u8>) -> Result<Index, Error> {
        self.of.read_index(bytes, self.limits.interrupt())
    }
}

impl Within<'_, Space> {
    /// [`Space::prepare`].
    ///
    /// # Errors
    /// As for [`Space::prepare`], and [`Error::Stopped`].
    pub fn prepare(&self, engine: impl Into<ConfiguredEngine>) -> Result<Index, Error> {
        self.prepare_with_progress(engine, &|_| {})
    }

    /// [`Space::prepare_with_progress`].
    ///
    /// # Errors
    /// As for [`Space::prepare_with_progress`], and [`Error::Stopped`].
    pub fn prepare_with_progress(
        &self,
        engine: impl Into<ConfiguredEngine>,
        progress: &(dyn Fn(Progress) + Sync),
    ) -> Result<Index, Error> {
        let source = Source { interrupt: self.limits.interrupt(), ..Source::new(progress) };
        Index::from_source(self.of, engine.into(), source)
    }

    /// [`Space::prepare_for_one_path`].
    ///
    /// # Errors
    /// As for [`Space::prepare_for_one_path`], and [`Error::Stopped`].
    pub fn prepare_for_one_path(&self, engine: impl Into<ConfiguredEngine>) -> Result<Index, Error> {
        let interrupt = self.limits.interrupt();
        let source = Source { for_one_path: true, interrupt, ..Source::new(&|_| {}) };
        Index::from_source(self.of, engine.into(), source)
    }

    /// [`Space::planner`].
    ///
    /// # Errors
    /// As for [`Space::planner`], and [`Error::Stopped`].
    pub fn planner(&self, engine: impl Into<ConfiguredEngine>) -> Result<Planner, Error> {
        self.prepare(engine)?.try_planner()
    }

    /// [`Space::path`].
    ///
    /// # Errors
    /// As for [`Space::path`], and [`Error::Stopped`].
    pub fn path(&self, start: impl Into<Point>, goal: impl Into<Point>) -> Result<Option<Path>, Error> {
        self.of.path_of(PointEnds::new(start, goal), &self.limits)
    }

    /// [`Space::fields`]: these limits stop each of the fields, too, and the time begins here. The only way
    /// to stop a field of costs on several threads, and to [hear](Limits::progress) how far it is:
    ///
    /// ```
    /// use std::num::NonZeroUsize;
    /// use mediant::{ErrorCode, Limits, Map, Motion};
    ///
    /// let space = Map::new(3, 1)?.costs([1, 2, 3])?.space(Motion::centers(3))?;
    /// let late = space.within(Limits::new().deadline(|| true)).fields()?;
    /// let stopped = late.on_threads(NonZeroUsize::MIN.saturating_add(1)).field([(0, 0)]).unwrap_err();
    /// assert_eq!(stopped.code(), ErrorCode::Stopped);
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// As for [`Space::fields`], and [`Error::Stopped`].
    pub fn fields(&self) -> Result<Fields, Error> {
        self.of.fields_of(self.limits.interrupt())
    }

    /// [`Space::field`].
    ///
    /// # Errors
    /// As for [`Space::field`], and [`Error::Stopped`].
    pub fn field<P: Into<Point>>(&self, sources: impl IntoIterator<Item = P>) -> Result<Field, Error> {
        self.field_within(sources, f64::INFINITY)
    }

    /// [`Space::field_within`].
    ///
    /// # Errors
    /// As for [`Space::field_within`], and [`Error::Stopped`].
    pub fn field_within<P: Into<Point>>(
        &self,
        sources: impl IntoIterator<Item = P>,
        limit: f64,
    ) -> Result<Field, Error> {
        self.of.field_of(Sources::of(sources).query().within(limit), self.limits.interrupt())
    }

    /// [`Space::distances`].
    ///
    /// # Errors
    /// As for [`Space::distances`], and [`Error::Stopped`].
    pub fn distances(&self, engine: Engine, start: impl Into<Vertex>) -> Result<Vec<(Vertex, f64)>, Error> {
        self.of.distances_of(engine, start.into(), self.limits.interrupt())
    }

    /// [`Space::widest_path`].
    ///
    /// # Errors
    /// As for [`Space::widest_path`], and [`Error::Stopped`].
    pub fn widest_path(
        &self,
        start: impl Into<Vertex>,
        goal: impl Into<Vertex>,
        surplus: f64,
    ) -> Result<Option<WidestPath>, Error> {
        self.of.widest_path_of([start.into(), goal.into()], surplus, &self.limits)
    }

    /// [`Space::load`].
    ///
    /// # Errors
    /// As for [`Space::load`], and [`Error::Stopped`].
    pub fn load(&self, path: impl AsRef<FilePath>) -> Result<Index, Error> {
        self.of.load_index(path.as_ref(), None, self.limits.interrupt())
    }

    /// [`Space::load_for`].
    ///
    /// # Errors
    /// As for [`Space::load_for`], and [`Error::Stopped`].
    pub fn load_for(
        &self,
        engine: impl Into<ConfiguredEngine>,
        path: impl AsRef<FilePath>,
    ) -> Result<Index, Error> {
        self.of.load_index(path.as_ref(), Some(engine.into()), self.limits.interrupt())
    }

    /// [`Space::index_from_bytes`].
    ///
    /// # Errors
    /// As for [`Space::index_from_bytes`], and [`Error::Stopped`].
    pub fn index_from_bytes(&self, bytes: Vec<u8>) -> Result<Index, Error> {
        self.of.read_index(bytes, self.limits.interrupt())
    }
}

impl Within<'_, Index> {
    /// [`Index::save`]. An older file stays where this is stopped.
    ///
    /// # Errors
    /// As for [`Index::save`], and [`Error::Stopped`].
    pub fn save(&self, path: impl AsRef<FilePath>) -> Result<(), Error> {
        self.of.write(path.as_ref(), self.limits.interrupt())
    }

    /// [`Index::to_bytes`].
    ///
    /// # Errors
    /// [`Error::Stopped`], and the errors of [`Index::to_bytes`].
    pub fn to_bytes(&self) -> Result<Vec<u8>, Error> {
        self.of.bytes(self.limits.interrupt())
    }

    /// [`Index::repair`]; the index stays as it is.
    ///
    /// # Errors
    /// As for [`Index::repair`], and [`Error::Stopped`].
    pub fn repair(&self, change: &Change) -> Result<Index, Error> {
        self.of.repaired(change, self.limits.interrupt())
    }

    /// [`Index::finish`]; the index stays as it is.
    ///
    /// # Errors
    /// As for [`Index::finish`], and [`Error::Stopped`].
    pub fn finish(&self) -> Result<Index, Error> {
        self.of.finished(self.limits.interrupt())
    }

    /// [`Index::for_k`].
    ///
    /// # Errors
    /// As for [`Index::for_k`], and [`Error::Stopped`].
    pub fn for_k(&self, k: K) -> Result<Index, Error> {
        self.of.prepared_for_k(k, self.limits.interrupt())
    }

    /// [`Index::goals`].
    ///
    /// # Errors
    /// As for [`Index::goals`], and [`Error::Stopped`].
    pub fn goals<G: Into<Point>>(&self, goals: impl IntoIterator<Item = G>) -> Result<Goals, Error> {
        self.of.goals_of(goals.into_iter().map(Into::into).collect(), self.limits.interrupt())
    }

    /// [`Index::table`].
    ///
    /// # Errors
    /// As for [`Index::table`], and [`Error::Stopped`].
    pub fn table<S: Into<Point>, G: Into<Point>>(
        &self,
        starts: impl IntoIterator<Item = S>,
        goals: impl IntoIterator<Item = G>,
    ) -> Result<Table, Error> {
        let starts: Vec<Point> = starts.into_iter().map(Into::into).collect();
        let goals: Vec<Point> = goals.into_iter().map(Into::into).collect();
        self.of.table_of(&starts, &goals, &self.limits)
    }
}
