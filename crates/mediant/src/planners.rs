//! Planners that threads share, and many queries at once.

use std::{
    fmt,
    sync::{
        Mutex, PoisonError,
        atomic::{AtomicBool, AtomicUsize, Ordering},
    },
};

use mediant_grid::Point;
use mediant_search::{Answer, Path, Query, QueryError};

use crate::{error::Error, index::Index, memory_check, planner::Planner};

/// Planners on one index that any number of threads share: each query takes one that is idle, or makes one,
/// and gives it back. There are as many as threads that ever searched at the same time.
///
/// It is `Send` and `Sync`, and its methods take `&self`: it can be a `static`, stand in an `Arc`, or be a
/// resource of Bevy, where a [`Planner`] cannot.
///
/// Its index never changes while it is shared, so that a query or a batch has one answer. After an edit of
/// the map its owner lets it [`follow`](Self::follow); who shares it makes the next one, to which this one
/// [hands its planners on](Self::hand_on).
///
/// ```
/// use mediant::{Ends, Engine, K, Map, Motion, Planners};
///
/// let space = Map::from_fn(9, 9, |x, y| x == 4 && y != 8)?.space(Motion::centers(K::N8))?;
/// let planners = Planners::new(space.prepare(Engine::Subgoal)?);
/// let queries: Vec<Ends> = (0..9).map(|y| Ends::new((0, y), (8, y))).collect();
/// let answers = planners.find_all(&queries);
/// assert_eq!(answers[8].as_ref().ok().and_then(|answer| answer.cost()), Some(8.0));
/// assert_eq!(answers[0], planners.find(queries[0]));
/// # Ok::<(), mediant::Error>(())
/// ```
pub struct Planners {
    index: Index,
    idle: Mutex<Vec<Planner>>,
}

/// Progress of a batch of queries, for any thread to read; and a flag that cancels the rest.
#[derive(Debug, Default)]
pub struct BatchProgress {
    done: AtomicUsize,
    is_cancelled: AtomicBool,
}

impl BatchProgress {
    /// The number of queries that were answered.
    #[must_use]
    pub fn done(&self) -> usize {
        self.done.load(Ordering::Relaxed)
    }

    /// Leaves out the queries that no thread has begun with. A query that takes long has
    /// [limits](mediant_search::Limits::cancel) of its own.
    pub fn cancel(&self) {
        self.is_cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether it was cancelled.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.is_cancelled.load(Ordering::Relaxed)
    }
}

impl Planners {
    /// The number of queries that [`find_in_chunks`](Self::find_in_chunks) hands to a thread at once.
    pub const CHUNK: usize = 256;

    /// No planners yet, on this index.
    #[must_use]
    pub const fn new(index: Index) -> Self {
        Self { index, idle: Mutex::new(Vec::new()) }
    }

    /// The index.
    #[must_use]
    pub const fn index(&self) -> &Index {
        &self.index
    }

    /// Whether a planner is idle, so that the next query makes none.
    #[must_use]
    pub fn is_ready(&self) -> bool {
        !self.idle().is_empty()
    }

    /// Makes a planner if none is idle. It has scratch memory for all vertices of the map, which takes a
    /// while on large ones; the next query has it then.
    pub fn make_ready(&self) {
        if !self.is_ready() {
            let planner = self.index.planner();
            self.idle().push(planner);
        }
    }

    /// [`make_ready`](Self::make_ready), if there is room for a planner's scratch memory.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`] where memory is short.
    pub fn try_make_ready(&self) -> Result<(), Error> {
        if !self.is_ready() {
            let planner = self.index.try_planner()?;
            self.idle().push(planner);
        }
        Ok(())
    }

    /// Gives a planner to `work`.
    pub fn with<T>(&self, work: impl FnOnce(&mut Planner) -> T) -> T {
        let mut planner = self.idle().pop().unwrap_or_else(|| self.index.planner());
        let result = work(&mut planner);
        self.idle().push(planner);
        result
    }

    /// [`with`](Self::with), if there is room for a planner's scratch memory where one must be made.
    pub(crate) fn try_with<T>(
        &self,
        work: impl FnOnce(&mut Planner) -> Result<T, Error>,
    ) -> Result<T, Error> {
        let known = self.idle().pop();
        let mut planner = match known {
            Some(planner) => planner,
            None => {
                memory_check::check("the planner", self.index.scratch_bytes())?;
                self.index.planner()
            }
        };
        let result = work(&mut planner);
        self.idle().push(planner);
        result
    }

    /// Continues on another index of the same engine and motion: the one for the map after an edit. Its idle
    /// planners [follow](Planner::follow), and keep their scratch memory.
    ///
    /// # Errors
    /// As for [`Planner::follow`], but that a planner for which there is no room is given up. Nothing is
    /// changed then.
    pub fn follow(&mut self, index: &Index) -> Result<(), Error> {
        *self = self.hand_on(index)?;
        Ok(())
    }

    /// Planners on another index of the same engine and motion, to which the idle ones of these
    /// [follow](Planner::follow): for who shares these with threads that still ask. These stay on their
    /// index, and make planners anew if they are asked again.
    ///
    /// ```
    /// use std::sync::{Arc, RwLock};
    /// use mediant::{Engine, Map, Motion, Planners, Rectangle};
    ///
    /// let space = Map::from_fn(40, 30, |x, _| x == 20)?.space(Motion::default())?;
    /// let planners = RwLock::new(Arc::new(Planners::new(space.prepare(Engine::JpsBlock)?)));
    /// // Any thread takes the planners that are there when it asks.
    /// let now = || Arc::clone(&planners.read().unwrap_or_else(|error| error.into_inner()));
    /// assert!(now().path((0, 0), (39, 0))?.is_none());
    /// // A door opens.
    /// let change = space.edit(Rectangle::new(20, 7, 1, 2), |_, _| false)?;
    /// let next = now().hand_on(&now().index().repair(&change)?)?;
    /// *planners.write().unwrap_or_else(|error| error.into_inner()) = Arc::new(next);
    /// assert!(now().path((0, 0), (39, 0))?.is_some());
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// As for [`follow`](Self::follow).
    pub fn hand_on(&self, index: &Index) -> Result<Self, Error> {
        self.index.check_successor(index)?;
        let mut idle = std::mem::take(&mut *self.idle());
        // At once, so that none keeps a map in memory that nobody else has.
        idle.retain_mut(|planner| planner.follow(index).is_ok());
        Ok(Self { index: index.clone(), idle: Mutex::new(idle) })
    }

    fn idle(&self) -> std::sync::MutexGuard<'_, Vec<Planner>> {
        // A thread that panics while it holds the lock leaves the list whole.
        self.idle.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Answers a query or a query.
    ///
    /// # Errors
    /// As for [`Planner::find`].
    pub fn find(&self, query: impl Into<Query>) -> Result<Answer, QueryError> {
        self.with(|planner| planner.find(query))
    }

    /// The path from `start` to `goal`, if there is one: [`find`](Self::find) for a plain query.
    ///
    /// # Errors
    /// As for [`Planner::find`].
    pub fn path(&self, start: impl Into<Point>, goal: impl Into<Point>) -> Result<Option<Path>, QueryError> {
        self.with(|planner| planner.path(start, goal))
    }

    /// Answers many queries or queries, in their order; with the feature `parallel` on all cores. The
    /// answers are the same on any number of threads.
    pub fn find_all<R>(&self, queries: &[R]) -> Vec<Result<Answer, QueryError>>
    where
        R: Clone + Into<Query> + Sync,
    {
        let (progress, add) = (BatchProgress::default(), |all: &mut Vec<_>, answer| all.push(answer));
        let query = |index: usize| queries[index].clone();
        self.find_in_chunks(queries.len(), query, &progress, add).into_iter().flatten().collect()
    }

    /// Answers the queries 0, 1, …, `count` − 1, and hands each answer to `add`, which adds it to the result
    /// of its chunk: to a sum, or to flat arrays. The results come in the order of the chunks, each of
    /// [`CHUNK`](Self::CHUNK) queries. After a cancellation some are cut short.
    pub fn find_in_chunks<R, C>(
        &self,
        count: usize,
        query: impl Fn(usize) -> R + Sync,
        progress: &BatchProgress,
        add: impl Fn(&mut C, Result<Answer, QueryError>) + Sync,
    ) -> Vec<C>
    where
        R: Into<Query>,
        C: Default + Send,
    {
        in_order(count.div_ceil(Self::CHUNK), |chunk| {
            let first = chunk * Self::CHUNK;
            let mut result = C::default();
            self.with(|planner| {
                for index in first..count.min(first + Self::CHUNK) {
                    if progress.is_cancelled() {
                        break;
                    }
                    add(&mut result, planner.find(query(index)));
                    progress.done.fetch_add(1, Ordering::Relaxed);
                }
            });
            result
        })
    }
}

/// Maps each number below `count` by `work`, in order; with the feature `parallel` on all cores.
pub(crate) fn in_order<T: Send>(count: usize, work: impl Fn(usize) -> T + Sync) -> Vec<T> {
    // A single piece of work needs no pool, and makes none.
    #[cfg(feature = "parallel")]
    if count > 1 && mediant_grid::threads::are_there() {
        use rayon::iter::{IntoParallelIterator, ParallelIterator};
        return (0..count).into_par_iter().map(&work).collect();
    }
    (0..count).map(work).collect()
}

impl fmt::Debug for Planners {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Planners").field("setup", &self.index.setup()).finish_non_exhaustive()
    }
}
