//! The one call from a map to a path, as every language has it.

#![allow(unsafe_code, reason = "functions of C")]

use std::ffi::c_char;

use library::{Error, Ground};

use crate::{
    answer::{self, Answer},
    batch::{Batch, BatchHandle},
    code::{Code, PathLimit, PathStatus},
    failure::call,
    handles::Held,
    map::MapHandle,
    memory,
    points::{self, Point},
    watch::{Watch, Watcher},
    words,
};

/// A path from any of several starts to any of several goals, in one call. Space and engine are chosen by
/// what is asked, and kept with the map for the next call. `words` has parameters of all kinds, as in
/// `"k=any gap=closed nearest"`; null is none. The path is a batch with this path alone, as that of
/// `mediant_space_path`. For many paths prepare an index, and ask a planner.
///
/// # Safety
/// `starts` and `goals` lead to as many points as they have; `words` is a text or null; `watcher` is null or
/// leads to one; `path` leads to a handle's memory, `answer` to an answer's.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_map_find(
    map: MapHandle,
    starts: *const Point,
    start_count: usize,
    goals: *const Point,
    goal_count: usize,
    words: *const c_char,
    watcher: *const Watcher,
    path: *mut BatchHandle,
    answer: *mut Answer,
) -> Code {
    call(|| {
        memory::check_place("path", path)?;
        memory::check_place("answer", answer)?;
        let ground = Ground::handles().get(map.id)?;
        // SAFETY: the caller promises it.
        let (starts, goals, call, watch) = unsafe {
            (
                points::read("starts", starts, start_count)?,
                points::read("goals", goals, goal_count)?,
                words::read("words", words, words::ALL)?,
                Watch::read(watcher)?,
            )
        };
        let setup = ground.setup(&call)?;
        // Its time is that of all.
        let query = words::query(&call, &starts, &goals, &watch);
        let (found, told) = match ground.keep_planners(&setup, words::preparing(&call, &watch)) {
            Err(Error::Stopped { by, .. }) => {
                (Batch::of_one(None), Answer::stopped(watch.limit_met(Some(by)).into()))
            }
            Err(error) => return Err(error.into()),
            Ok(planners) => {
                let found = planners.find(query).map_err(|error| watch.failure(error))?;
                let mut told = Answer::new(&found, (setup.guarantee(), setup.rules()));
                told.stopped_by = watch.limit_met(found.stopped_by()).into();
                (Batch::of_one(answer::told(&found)), told)
            }
        };
        // SAFETY: the caller promises it.
        unsafe {
            BatchHandle::put(found, ("path", path))?;
            memory::put("answer", answer, told)
        }
    })
}

impl Answer {
    /// Where the work was stopped before the search.
    pub(crate) const fn stopped(stopped_by: PathLimit) -> Self {
        Self {
            status: PathStatus::Stopped,
            stopped_by,
            point_count: 0,
            distance: f64::NAN,
            length: 0.0,
            lower_bound: 0.0,
            any_angle_lower_bound: f64::NAN,
        }
    }
}
