//! Limits that stop a search before it has its answer.

use std::{
    fmt,
    sync::{Arc, atomic::AtomicBool},
};

use mediant_grid::{Interrupt, Point, StoppedBy, names};
use mediant_moves::Cost;

use super::error::QueryError;
use crate::{
    limit::greatest_cost_in,
    path::{Measured, Path},
};

/// Limits of a search. None is set at first; the first one that is met stops the search.
///
/// ```
/// use std::{sync::{Arc, atomic::AtomicBool}, time::{Duration, Instant}};
/// use mediant_search::Limits;
///
/// let (begin, cancelled) = (Instant::now(), Arc::new(AtomicBool::new(false)));
/// let limits = Limits::new()
///     .cost(500.0)
///     .expansions(100_000)
///     .deadline(move || begin.elapsed() > Duration::from_millis(5))
///     .cancel(cancelled);
/// # let _ = limits;
/// ```
#[derive(Clone, Default)]
pub struct Limits {
    cost: Option<f64>,
    expansions: Option<u64>,
    /// The deadline and the flag, and the listener.
    interrupt: Interrupt,
}

/// Which limit stopped a search.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Limit {
    /// No path within the limit on its cost was found, or there is none.
    Cost,
    /// The number of expansions.
    Expansions,
    /// The deadline, which is that of a time limit.
    Timeout,
    /// The flag that cancels it.
    Cancelled,
}

impl From<StoppedBy> for Limit {
    fn from(by: StoppedBy) -> Self {
        match by {
            StoppedBy::Cancelled => Self::Cancelled,
            _ => Self::Timeout,
        }
    }
}

names!(Limit: Cost => "cost", Expansions => "expansions", Timeout => "timeout", Cancelled => "cancelled");

/// The answer of a search that was stopped.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Stopped {
    /// The limit.
    pub by: Limit,
    /// The best so far: a path to a goal, if one was found and it was not yet known whether it is the best;
    /// else the path to the vertex nearest to a goal among those that the search expanded within the limit on
    /// the cost, by h_k (at k = ∞ by the straight line), the first of several. At least the start.
    pub best: Path,
    /// A lower bound on the cost of the path that was sought, in cells (on a cost surface in its unit): no
    /// path over N(k) between the ends that were asked for, by an engine of any-angle paths no legal path, is
    /// shorter. Up to the rounding of [`Cost`]. (Of a path that was found,
    /// [`Guarantee::lower_bound`](crate::Guarantee::lower_bound) tells another bound: on all paths at any
    /// angle between its ends.)
    pub lower_bound: f64,
}

/// As `stopped by its limit on expansions: 2 waypoints, 4.24 cells so far, at least 11.07`.
impl fmt::Display for Stopped {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let by = match self.by {
            Limit::Cost => "stopped by its limit on the cost",
            Limit::Expansions => "stopped by its limit on expansions",
            Limit::Timeout => "stopped by its timeout",
            Limit::Cancelled => "cancelled",
        };
        write!(f, "{by}: {} so far, at least {:.2}", Measured(&self.best), self.lower_bound)
    }
}

impl Stopped {
    /// The answer where nothing was searched: what comes before the search was stopped. 0 is the lower bound.
    #[must_use]
    pub fn before_search(by: Limit, start: impl Into<Point>) -> Self {
        Self { by, best: Path::through([start]), lower_bound: 0.0 }
    }
}

impl Limits {
    /// The number of expansions from one look at the deadline to the next.
    pub const EXPANSIONS_PER_LOOK: u64 = 64;

    /// The number of pairs of a start and a goal that are searched from one look at the deadline to the next,
    /// however few expansions they take.
    pub const PAIRS_PER_LOOK: u64 = 16;

    /// No limits.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The greatest cost of a path, in cells; on a cost surface in its own unit. A path that costs exactly as
    /// much is within it: costs are rounded, so all limits leave room for a factor of 1 + 2⁻³¹. An engine
    /// that guarantees nothing of its paths may miss one that costs nearly as much.
    #[must_use]
    pub fn cost(mut self, cells: f64) -> Self {
        self.cost = Some(cells);
        self
    }

    /// The most expansions, as an observer counts them. The goal's is none. Where a planner needs none, as
    /// with hub labels or where the goal is in plain sight, any number of them is enough, also 0: the flag
    /// and the deadline alone stop such queries. HPA* is not stopped while it searches within clusters,
    /// before and after its search between them, and can make more there.
    #[must_use]
    pub fn expansions(mut self, count: u64) -> Self {
        self.expansions = Some(count);
        self
    }

    /// A function that says whether it is time to stop, called at first and after each
    /// [`EXPANSIONS_PER_LOOK`](Self::EXPANSIONS_PER_LOOK) expansions, and, of several starts and goals,
    /// before each [`PAIRS_PER_LOOK`](Self::PAIRS_PER_LOOK)th pair that is searched. Libraries read no clock;
    /// the caller does.
    #[must_use]
    pub fn deadline(mut self, is_over: impl Fn() -> bool + Send + Sync + 'static) -> Self {
        self.interrupt = self.interrupt.deadline(is_over);
        self
    }

    /// A flag by which another thread stops the search. Read before each expansion, and before each pair of
    /// a start and a goal.
    #[must_use]
    pub fn cancel(mut self, flag: Arc<AtomicBool>) -> Self {
        self.interrupt = self.interrupt.cancel(flag);
        self
    }

    /// A function that is told how far work is that tells its progress; searches do not: see
    /// [`Interrupt::progress`].
    #[must_use]
    pub fn progress(mut self, listener: impl Fn(usize, usize) + Send + Sync + 'static) -> Self {
        self.interrupt = self.interrupt.progress(listener);
        self
    }

    /// The deadline and the flag, which also stop what is done before a search: see [`Interrupt`].
    #[must_use]
    pub const fn interrupt(&self) -> &Interrupt {
        &self.interrupt
    }

    /// Checks the limit on the cost.
    pub(super) fn check(&self) -> Result<(), QueryError> {
        if self.cost.is_some_and(|cost| cost.is_nan() || cost < 0.0) {
            return Err(QueryError::CostLimit);
        }
        Ok(())
    }

    /// Whether there are none.
    #[must_use]
    pub const fn are_none(&self) -> bool {
        self.cost.is_none() && self.expansions.is_none() && self.interrupt.is_never()
    }

    /// The greatest cost in this unit, with room for rounding.
    pub(super) fn greatest_cost(&self, unit: f64) -> Cost {
        self.cost.map_or(Cost::MAX, |cost| greatest_cost_in(cost, unit))
    }

    /// The limit that is met after this many expansions.
    pub(super) fn met(&self, expansions: u64, looks_at_deadline: bool) -> Option<Limit> {
        if self.expansions.is_some_and(|most| expansions >= most) {
            return Some(Limit::Expansions);
        }
        if self.interrupt.is_cancelled() {
            return Some(Limit::Cancelled);
        }
        (looks_at_deadline && self.interrupt.is_over()).then_some(Limit::Timeout)
    }
}

/// The deadline, the flag and the listener alone.
impl From<Interrupt> for Limits {
    fn from(interrupt: Interrupt) -> Self {
        Self { cost: None, expansions: None, interrupt }
    }
}

/// The same limits.
impl From<&Self> for Limits {
    fn from(limits: &Self) -> Self {
        limits.clone()
    }
}

impl fmt::Debug for Limits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Limits")
            .field("cost", &self.cost)
            .field("expansions", &self.expansions)
            .field("interrupt", &self.interrupt)
            .finish()
    }
}
