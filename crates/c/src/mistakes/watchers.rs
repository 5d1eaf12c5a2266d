//! Watchers that stop, that change their mind, and that call the library from inside a call.

use std::{
    ffi::c_void,
    ptr,
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicU64, Ordering},
    },
    thread,
};

use super::{ask, world::World};
use crate::{
    code::Code,
    map::{MapHandle, mediant_map_free, mediant_map_new, mediant_map_size},
    planner::{PlannerHandle, mediant_planner_distance, mediant_planner_free},
    points::Point,
    watch::Watcher,
};

/// The data of a watcher's functions.
#[derive(Debug)]
pub(super) struct Caller {
    asked: AtomicU64,
    told: Mutex<(u64, u64)>,
    /// It says 'stop' at this question, and at no other.
    stop_at: u64,
    /// The planner whose call this is: it is busy. 0 for none.
    planner: u64,
    /// Whether it calls the library.
    calls: bool,
    /// The mistake that was seen in a function that cannot panic.
    wrong: Mutex<Option<String>>,
}

/// A watcher of a call.
pub(super) struct Drawn {
    pub(super) caller: Arc<Caller>,
    /// The memory that `at` leads to, for as long as the call.
    _raw: Box<Watcher>,
    pub(super) at: *const Watcher,
    /// Whether it may stop the work.
    pub(super) can_stop: bool,
}

unsafe extern "C" fn stop(data: *mut c_void) -> i32 {
    // SAFETY: a caller is shared, and stays until no work has it.
    let caller = unsafe { &*data.cast::<Caller>() };
    let asked = caller.asked.fetch_add(1, Ordering::Relaxed) + 1;
    if caller.calls && asked < 3 {
        caller.call(asked == 1);
    }
    i32::from(asked == caller.stop_at)
}

unsafe extern "C" fn progress(data: *mut c_void, done: u64, total: u64) {
    // SAFETY: as above.
    let caller = unsafe { &*data.cast::<Caller>() };
    let mut told = caller.told.lock().unwrap_or_else(PoisonError::into_inner);
    if done > total {
        caller.note(format!("{done} of {total} are done"));
    }
    *told = (done, total);
}

impl Caller {
    fn note(&self, wrong: String) {
        *self.wrong.lock().unwrap_or_else(PoisonError::into_inner) = Some(wrong);
    }

    /// Calls the library from inside its call, in this thread or in another one.
    fn call(&self, in_another: bool) {
        let planner = PlannerHandle { id: self.planner };
        let work = || {
            let (at, mut length) = (Point { x: 0.0, y: 0.0 }, 0.0);
            let busy = if self.planner == 0 { Code::Handle } else { Code::Busy };
            let codes = ask!((
                mediant_planner_distance(planner, at, at, &raw mut length),
                mediant_planner_free(planner)
            ));
            if codes != (busy, busy) {
                self.note(format!("{codes:?} of a planner that is in a call, not {busy:?}"));
            }
            let (mut map, mut width, mut height) = (MapHandle { id: 0 }, 0, 0);
            let codes = ask!([
                mediant_map_new(3, 2, ptr::null(), &raw mut map),
                mediant_map_size(map, &raw mut width, &raw mut height),
                mediant_map_free(map)
            ]);
            if codes != [Code::Ok; 3] || (width, height) != (3, 2) {
                self.note(format!("{codes:?} of another map, {width} × {height}"));
            }
        };
        if in_another {
            thread::scope(|scope| scope.spawn(work).join().expect("no panic"));
        } else {
            work();
        }
    }

    /// Fails if a function could not do what it should.
    pub(super) fn check(&self) {
        let wrong = self.wrong.lock().unwrap_or_else(PoisonError::into_inner);
        assert_eq!(*wrong, None, "in a watcher");
    }
}

impl World {
    /// A watcher for work that a planner does, or none.
    pub(super) fn watcher(&mut self, planner: u64) -> Drawn {
        let stop_at = match self.rng.below(4) {
            0 => 1,
            1 => 1 + u64::from(self.rng.below(20)),
            _ => u64::MAX,
        };
        let calls = self.rng.chance(30);
        let (asked, told, wrong) = (AtomicU64::new(0), Mutex::default(), Mutex::default());
        let caller = Arc::new(Caller { asked, told, stop_at, planner, calls, wrong });
        let raw = Box::new(Watcher {
            stop: self.rng.chance(80).then_some(stop),
            progress: self.rng.chance(60).then_some(progress),
            data: Arc::as_ptr(&caller).cast_mut().cast(),
        });
        let can_stop = raw.stop.is_some() && stop_at < u64::MAX;
        let at = &raw const *raw;
        match self.rng.below(100) {
            0..60 => Drawn { caller, _raw: raw, at: ptr::null(), can_stop: false },
            60 => {
                self.wrong(Code::Argument);
                Drawn { caller, _raw: raw, at: at.wrapping_byte_add(1), can_stop: false }
            }
            _ => {
                if can_stop {
                    self.maybe(&[Code::Cancelled]);
                }
                Drawn { caller, _raw: raw, at, can_stop }
            }
        }
    }
}
