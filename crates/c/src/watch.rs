//! Functions of the caller's that are asked, or told, while some work goes on.

#![allow(unsafe_code, reason = "functions of C")]

use std::{
    ffi::c_void,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
};

use library::{Error, Limit, Limits};

use crate::{code::Code, failure::Failure, memory};

/// Functions that are called while some work goes on. They may be called from any thread, and must not let
/// an exception out. They may call the library, but for the planner whose call they are in: it is busy. Each
/// may be null.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Watcher {
    /// Whether to stop: any number but 0 stops the work, which then returns `MEDIANT_CODE_CANCELLED`; a
    /// search answers with `MEDIANT_STATUS_STOPPED` and `MEDIANT_LIMIT_CANCELLED`. It is asked some hundred
    /// times a second or more, and not again once it has said so.
    pub stop: Option<unsafe extern "C" fn(data: *mut c_void) -> i32>,
    /// Is told how much is done of how much, at most some hundred times.
    pub progress: Option<unsafe extern "C" fn(data: *mut c_void, done: u64, total: u64)>,
    /// Is handed to both.
    pub data: *mut c_void,
}

/// The watcher of a call, if it has one.
#[derive(Clone, Debug, Default)]
pub(crate) struct Watch(Option<Watched>);

#[derive(Clone, Debug)]
struct Watched {
    watcher: Watcher,
    /// Whether it has said that the work is to stop. Work that was told so may not be told otherwise.
    has_stopped: Arc<AtomicBool>,
}

// SAFETY: the header says that both functions may be called from any thread.
unsafe impl Send for Watched {}
// SAFETY: as above, and from several at once.
unsafe impl Sync for Watched {}

impl Watch {
    /// The watcher of an argument; null is none.
    ///
    /// # Safety
    /// A pointer that is neither null nor misaligned leads to a watcher, whose functions can be called with
    /// its data from any thread until the work has ended.
    pub(crate) unsafe fn read(watcher: *const Watcher) -> Result<Self, Failure> {
        if watcher.is_null() {
            return Ok(Self(None));
        }
        // SAFETY: the caller promises it.
        let watcher = unsafe { memory::value("watcher", watcher) }?;
        Ok(Self(Some(Watched { watcher, has_stopped: Arc::default() })))
    }

    /// Limits by which the work asks and tells.
    pub(crate) fn limit(&self, limits: Limits) -> Limits {
        let Some(Watched { watcher, .. }) = &self.0 else { return limits };
        let limits = match watcher.stop {
            Some(_) => {
                let own = self.clone();
                limits.deadline(move || own.stops())
            }
            None => limits,
        };
        match watcher.progress {
            Some(_) => {
                let own = self.clone();
                limits.progress(move |done, total| own.tell(done, total))
            }
            None => limits,
        }
    }

    /// Whether it has a function that may stop the work.
    pub(crate) fn can_stop(&self) -> bool {
        self.0.as_ref().is_some_and(|Watched { watcher, .. }| watcher.stop.is_some())
    }

    /// Limits by which the work asks, and tells nothing.
    pub(crate) fn stopping(&self) -> Limits {
        let own = self.clone();
        Limits::new().deadline(move || own.stops())
    }

    /// Whether the work is to stop.
    pub(crate) fn stops(&self) -> bool {
        let Some(Watched { watcher, has_stopped }) = &self.0 else { return false };
        let says_so = || {
            // SAFETY: `read` was promised that it can be called.
            let says_so = watcher.stop.is_some_and(|stop| unsafe { stop(watcher.data) } != 0);
            has_stopped.fetch_or(says_so, Ordering::Relaxed);
            says_so
        };
        has_stopped.load(Ordering::Relaxed) || says_so()
    }

    /// Tells how much is done.
    pub(crate) fn tell(&self, done: usize, total: usize) {
        if let Some(Watched { watcher: Watcher { progress: Some(progress), data, .. }, .. }) = self.0 {
            // SAFETY: `read` was promised that it can be called.
            unsafe { progress(data, done as u64, total as u64) };
        }
    }

    /// The limit that stopped a search: the library takes what its caller says for the end of its time.
    pub(crate) fn limit_met(&self, by: Option<Limit>) -> Option<Limit> {
        by.map(|by| if by == Limit::Timeout && self.has_stopped() { Limit::Cancelled } else { by })
    }

    /// The failure of watched work.
    pub(crate) fn failure(&self, error: impl Into<Error>) -> Failure {
        match error.into() {
            Error::Stopped { by: Limit::Timeout, during } if self.has_stopped() => Self::stopped(during),
            error => error.into(),
        }
    }

    /// The failure of work that a watcher stopped.
    pub(crate) fn stopped(during: &str) -> Failure {
        Failure { code: Code::Cancelled, text: format!("stopped by its watcher while {during}") }
    }

    fn has_stopped(&self) -> bool {
        self.0.as_ref().is_some_and(|watched| watched.has_stopped.load(Ordering::Relaxed))
    }
}
