//! One way to stop what takes long.

use std::{
    alloc::{Layout, handle_alloc_error},
    fmt,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
};

/// A flag that another thread sets, and a deadline: either stops work that takes long. Neither is set at
/// first, and then nothing stops it.
///
/// **One way for all work.** Whatever can take longer than some milliseconds has a form that takes an
/// interrupt, from the components of a map to the preparation of an engine. It asks again and again, at most
/// some hundred thousand cells or a few thousand searched nodes apart. Once it hears 'stop', it gives up what
/// it has made and returns [`Interrupted`]; nothing goes on on other threads. Unused, an interrupt costs a
/// test of two pointers a row.
///
/// **Memory** that grows with the map is asked for before it is taken. Where there is no room for it, the
/// work ends as if it were stopped, by [`StoppedBy::Memory`].
///
/// **Progress** goes the other way along with it: some work tells its [listener](Self::progress), if there is
/// one, how far it is.
///
/// ```
/// use std::sync::{Arc, atomic::{AtomicBool, Ordering}};
/// use mediant_grid::{Clearance, Fit, Grid, Interrupt, Outside, StoppedBy};
///
/// let grid = Arc::new(Grid::from_fn(500, 400, |x, y| x * y % 7 == 1)?);
/// let flag = Arc::new(AtomicBool::new(false));
/// let interrupt = Interrupt::new().cancel(Arc::clone(&flag));
/// let measure = || Clearance::interruptible(Arc::clone(&grid), Fit::Centers, Outside::Open, &interrupt);
/// assert!(measure().is_ok());
/// // What another thread would do.
/// flag.store(true, Ordering::Relaxed);
/// assert_eq!(measure().unwrap_err().by, StoppedBy::Cancelled);
/// # Ok::<(), mediant_grid::GridError>(())
/// ```
#[derive(Clone, Default)]
pub struct Interrupt {
    cancel: Option<Arc<AtomicBool>>,
    deadline: Option<Arc<dyn Fn() -> bool + Send + Sync>>,
    listener: Option<Arc<dyn Fn(usize, usize) + Send + Sync>>,
}

/// The flag, the deadline, or a lack of memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum StoppedBy {
    /// The flag.
    Cancelled,
    /// The deadline.
    Deadline,
    /// There is no room for what the work would make next. Nothing of it was allocated.
    Memory {
        /// The bytes that it would take.
        bytes: u64,
    },
}

/// Work that was stopped before it was done.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[error("{} while {during}", match by {
    StoppedBy::Cancelled => "cancelled",
    StoppedBy::Deadline => "out of time",
    StoppedBy::Memory { .. } => "no room for what is made",
})]
pub struct Interrupted {
    /// The cause.
    pub by: StoppedBy,
    /// The stage, such as 'measuring clearances'.
    pub during: &'static str,
}

impl Interrupted {
    /// The stage in which an index is made into bytes, or written to a file, whatever its engine.
    pub const WRITING: &'static str = "writing the index";
}

impl Interrupt {
    /// An interrupt that stops nothing.
    pub const NEVER: Self = Self::new();

    /// An interrupt that stops nothing yet.
    #[must_use]
    pub const fn new() -> Self {
        Self { cancel: None, deadline: None, listener: None }
    }

    /// A flag by which another thread stops the work.
    #[must_use]
    pub fn cancel(self, flag: Arc<AtomicBool>) -> Self {
        Self { cancel: Some(flag), ..self }
    }

    /// A function that says whether it is time to stop. Any of the threads that work asks it often, and after
    /// its first yes it must go on saying yes. Libraries read no clock; the caller does.
    #[must_use]
    pub fn deadline(self, is_over: impl Fn() -> bool + Send + Sync + 'static) -> Self {
        Self { deadline: Some(Arc::new(is_over)), ..self }
    }

    /// A function that is told how far the work is: how much of it is done, and how much there is at most.
    /// Work that tells its progress says so, and whether it is done with less than all. It is told at most
    /// some hundred times, first with 0, then never less than before.
    #[must_use]
    pub fn progress(self, listener: impl Fn(usize, usize) + Send + Sync + 'static) -> Self {
        Self { listener: Some(Arc::new(listener)), ..self }
    }

    /// The same flag and deadline without the listener: for a part of the work.
    #[must_use]
    pub fn unheard(&self) -> Self {
        Self { listener: None, ..self.clone() }
    }

    /// Whether somebody is told how far the work is.
    #[must_use]
    pub const fn is_heard(&self) -> bool {
        self.listener.is_some()
    }

    /// Tells how much is done of how much, if somebody listens.
    pub fn tell(&self, done: usize, total: usize) {
        if let Some(listener) = &self.listener {
            listener(done, total);
        }
    }

    /// Whether nothing can stop the work.
    #[must_use]
    pub const fn is_never(&self) -> bool {
        self.cancel.is_none() && self.deadline.is_none()
    }

    /// Whether the flag is set. The deadline is not asked.
    #[must_use]
    #[inline]
    pub fn is_cancelled(&self) -> bool {
        self.cancel.as_ref().is_some_and(|flag| flag.load(Ordering::Relaxed))
    }

    /// Whether the deadline is over. The flag is not looked at.
    #[must_use]
    #[inline]
    pub fn is_over(&self) -> bool {
        self.deadline.as_ref().is_some_and(|is_over| is_over())
    }

    /// Asks whether to go on with some work.
    ///
    /// # Errors
    /// [`Interrupted`] if not: with the flag, if it is set, else with the deadline.
    #[inline]
    pub fn check(&self, during: &'static str) -> Result<(), Interrupted> {
        if self.is_never() { Ok(()) } else { self.ask(during) }
    }

    #[cold]
    fn ask(&self, during: &'static str) -> Result<(), Interrupted> {
        let by = if self.is_cancelled() {
            StoppedBy::Cancelled
        } else if self.is_over() {
            StoppedBy::Deadline
        } else {
            return Ok(());
        };
        Err(Interrupted { by, during })
    }

    /// Asks once for each so many steps, of which this is the one with that number.
    ///
    /// # Errors
    /// As for [`check`](Self::check).
    #[inline]
    pub fn check_every(&self, steps: usize, step: usize, during: &'static str) -> Result<(), Interrupted> {
        if step.is_multiple_of(steps) { self.check(during) } else { Ok(()) }
    }
}

impl fmt::Debug for Interrupt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut fields = f.debug_struct("Interrupt");
        fields.field("cancel", &self.cancel).field("deadline", &self.deadline.is_some());
        fields.field("listener", &self.listener.is_some()).finish()
    }
}

/// The result of work that was handed [`Interrupt::NEVER`].
#[doc(hidden)]
pub fn uninterrupted<T>(work: impl FnOnce(&Interrupt) -> Result<T, Interrupted>) -> T {
    match work(&Interrupt::NEVER) {
        Ok(done) => done,
        // As always in Rust where there is no error to return.
        Err(Interrupted { by: StoppedBy::Memory { bytes }, .. }) => {
            handle_alloc_error(Layout::array::<u8>(bytes as usize).unwrap_or(Layout::new::<u8>()))
        }
        Err(Interrupted { .. }) => unreachable!("nothing else stops this work"),
    }
}
