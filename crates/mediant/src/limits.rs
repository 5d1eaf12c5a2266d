//! Limits of queries, and of whatever else can take long.

use std::{
    fmt,
    sync::{Arc, atomic::AtomicBool},
};

use mediant_grid::Interrupt;
use mediant_search::Limits as SearchLimits;

/// Limits of a query, or of a call [within](crate::Within) them. None is set at first; the first one that is
/// met stops the work.
///
/// ```
/// use std::time::Duration;
/// use mediant::{Engine, Limits, Map, Motion, Query};
///
/// let space = Map::new(40, 30)?.space(Motion::centers(3))?;
/// let mut planner = space.planner(Engine::AStar)?;
/// let budget = Limits::new().time(Duration::from_millis(5)).expansions(100_000);
/// let answer = planner.find(Query::new((0, 0), (39, 29)).within(budget))?;
/// assert!(answer.path().is_some());
/// # Ok::<(), mediant::Error>(())
/// ```
#[derive(Clone, Default)]
pub struct Limits {
    limits: SearchLimits,
    #[cfg(all(feature = "clock", not(target_family = "wasm")))]
    time: Option<std::time::Duration>,
}

impl Limits {
    /// No limits.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The greatest cost of a path: see [`mediant_search::Limits::cost`].
    #[must_use]
    pub fn cost(mut self, cells: f64) -> Self {
        self.limits = self.limits.cost(cells);
        self
    }

    /// The most expansions: see [`mediant_search::Limits::expansions`].
    #[must_use]
    pub fn expansions(mut self, count: u64) -> Self {
        self.limits = self.limits.expansions(count);
        self
    }

    /// The most time. It begins when the limits are given to a query, or to a call of
    /// [`Within`](crate::Within): the same limits can be given to many.
    ///
    /// This is the only place in which the library reads a clock. Where there is none, as in WebAssembly,
    /// [`deadline`](Self::deadline) asks the caller's.
    #[cfg(all(feature = "clock", not(target_family = "wasm")))]
    #[must_use]
    pub const fn time(mut self, most: std::time::Duration) -> Self {
        self.time = Some(most);
        self
    }

    /// Whether it is time to stop, by a clock of the caller's: see [`mediant_search::Limits::deadline`].
    #[must_use]
    pub fn deadline(mut self, is_over: impl Fn() -> bool + Send + Sync + 'static) -> Self {
        self.limits = self.limits.deadline(is_over);
        self
    }

    /// A flag by which another thread stops the work: see [`mediant_search::Limits::cancel`].
    #[must_use]
    pub fn cancel(mut self, flag: Arc<AtomicBool>) -> Self {
        self.limits = self.limits.cancel(flag);
        self
    }

    /// A function that is told how far the work is: how much of it is done, and how much there is at most, at
    /// first and at the end and at most some hundred times between. It limits nothing. Told are calls within
    /// these limits alone, and of them
    ///
    /// - fields where cells have costs, or a walk leads over elevation: the vertices that have their cost, of
    ///   those that are not blocked (at corners of all). Others are never reached, or cost more than the
    ///   field's limit. So it need not end with all of them.
    /// - indexes of [`Engine::Landmarks`](crate::Engine::Landmarks): the landmarks.
    ///   [`Space::prepare_with_progress`](crate::Space::prepare_with_progress) is for indexes of subgoals.
    ///
    /// ```
    /// use std::sync::{Arc, Mutex};
    /// use mediant::{Limits, Map, Motion};
    ///
    /// let told = Arc::new(Mutex::new(Vec::new()));
    /// let listens = Arc::clone(&told);
    /// let limits = Limits::new().progress(move |done, total| listens.lock().unwrap().push((done, total)));
    /// let space = Map::new(3, 2)?.costs([1, 2, 3, 4, 5, 6])?.space(Motion::centers(3))?;
    /// let field = space.within(&limits).field([(0, 0)])?;
    /// assert_eq!(*told.lock().unwrap(), [(0, 6), (6, 6)]);
    /// # Ok::<(), mediant::Error>(())
    /// ```
    #[must_use]
    pub fn progress(mut self, listener: impl Fn(usize, usize) + Send + Sync + 'static) -> Self {
        self.limits = self.limits.progress(listener);
        self
    }

    /// The time, the deadline, the flag and the listener, as the typed crates ask them. Begins the time.
    #[must_use]
    pub fn interrupt(&self) -> Interrupt {
        SearchLimits::from(self).interrupt().clone()
    }
}

/// Begins the time.
impl From<&Limits> for SearchLimits {
    fn from(limits: &Limits) -> Self {
        let begun = limits.limits.clone();
        #[cfg(all(feature = "clock", not(target_family = "wasm")))]
        if let Some(most) = limits.time {
            let (begin, own) = (std::time::Instant::now(), begun.interrupt().clone());
            return begun.deadline(move || begin.elapsed() >= most || own.is_over());
        }
        begun
    }
}

/// Begins the time.
impl From<Limits> for SearchLimits {
    fn from(limits: Limits) -> Self {
        (&limits).into()
    }
}

impl From<SearchLimits> for Limits {
    fn from(limits: SearchLimits) -> Self {
        Self {
            limits,
            #[cfg(all(feature = "clock", not(target_family = "wasm")))]
            time: None,
        }
    }
}

impl fmt::Debug for Limits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.limits.fmt(f)
    }
}
