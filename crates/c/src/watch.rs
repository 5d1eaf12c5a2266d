//! Functions of the caller's that are asked, or told, while some work goes on.

#![allow(unsafe_code, reason = "functions of C")]

use std::ffi::c_void;

use library::Limits;

use crate::{failure::Failure, memory};

/// Functions that are called while some work goes on. They may be called from any thread, and must not let
/// an exception out. Each may be null.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Watcher {
    /// Whether to stop: any number but 0 stops the work, which then returns `MEDIANT_CODE_STOPPED`; a search
    /// answers with `MEDIANT_STATUS_STOPPED`. It is asked some hundred times a second or more.
    pub stop: Option<unsafe extern "C" fn(data: *mut c_void) -> i32>,
    /// Is told how much is done of how much, at most some hundred times.
    pub progress: Option<unsafe extern "C" fn(data: *mut c_void, done: u64, total: u64)>,
    /// Is handed to both.
    pub data: *mut c_void,
}

/// The watcher of a call, if it has one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Watch(Option<Watcher>);

// SAFETY: the header says that both functions may be called from any thread.
unsafe impl Send for Watch {}
// SAFETY: as above, and from several at once.
unsafe impl Sync for Watch {}

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
        unsafe { memory::value("watcher", watcher) }.map(|watcher| Self(Some(watcher)))
    }

    /// Limits by which the work asks and tells.
    pub(crate) fn limit(self, limits: Limits) -> Limits {
        let Some(watcher) = self.0 else { return limits };
        let limits = if self.can_stop() { limits.deadline(move || self.stops()) } else { limits };
        match watcher.progress {
            Some(_) => limits.progress(move |done, total| self.tell(done, total)),
            None => limits,
        }
    }

    /// Whether it has a function that may stop the work.
    pub(crate) fn can_stop(self) -> bool {
        self.0.is_some_and(|watcher| watcher.stop.is_some())
    }

    /// Limits by which the work asks, and tells nothing.
    pub(crate) fn stopping(self) -> Limits {
        Limits::new().deadline(move || self.stops())
    }

    /// Whether the work is to stop.
    pub(crate) fn stops(self) -> bool {
        // SAFETY: `read` was promised that it can be called.
        self.0.is_some_and(|Watcher { stop, data, .. }| stop.is_some_and(|stop| unsafe { stop(data) } != 0))
    }

    /// Tells how much is done.
    pub(crate) fn tell(self, done: usize, total: usize) {
        if let Some(Watcher { progress: Some(progress), data, .. }) = self.0 {
            // SAFETY: `read` was promised that it can be called.
            unsafe { progress(data, done as u64, total as u64) };
        }
    }
}
