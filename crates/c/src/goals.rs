//! Goals that many starts ask for, and tables.

#![allow(unsafe_code, reason = "functions of C")]

use std::sync::Arc;

use library::{Goals, Index};

use crate::{
    code::Code,
    failure::call,
    handles::{Held, Kind, Table},
    index::IndexHandle,
    memory,
    points::{self, Point},
    watch::{Watch, Watcher},
    words,
};

/// Goals that are prepared for an index. They never change; planners of indexes with the same map and motion
/// share them. `{0}` is none.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct GoalsHandle {
    /// Its number.
    pub id: u64,
}

impl Held for Goals {
    type Kept = Arc<Self>;

    fn handles() -> &'static Table<Arc<Self>> {
        static HANDLES: Table<Arc<Goals>> = Table::new(Kind::Goals);
        &HANDLES
    }
}

/// Prepares goals that many starts ask for.
///
/// # Safety
/// `points` leads to `count` points; `goals` leads to a handle's memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_goals_new(
    index: IndexHandle,
    points: *const Point,
    count: usize,
    goals: *mut GoalsHandle,
) -> Code {
    call(|| {
        memory::check_place("goals", goals)?;
        let index = Index::handles().get(index.id)?;
        // SAFETY: the caller promises it.
        let made = index.goals(unsafe { points::read("goals", points, count) }?)?;
        let id = Goals::handles().share(made)?;
        // SAFETY: as above.
        unsafe { memory::put("goals", goals, GoalsHandle { id }) }
    })
}

/// Frees goals.
#[unsafe(no_mangle)]
pub extern "C" fn mediant_goals_free(goals: GoalsHandle) -> Code {
    call(|| Goals::handles().free(goals.id))
}

/// The lengths of the paths from each of many starts to each of many goals, a row for each start; infinity
/// where none leads. On all cores.
///
/// # Safety
/// `starts` and `goals` lead to as many points as they have; `watcher` is null or leads to one; `lengths`
/// leads to memory for `start_count` · `goal_count` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_index_table(
    index: IndexHandle,
    starts: *const Point,
    start_count: usize,
    goals: *const Point,
    goal_count: usize,
    watcher: *const Watcher,
    lengths: *mut f64,
) -> Code {
    call(|| {
        let room = start_count.saturating_mul(goal_count);
        memory::check_room("lengths", lengths, room)?;
        let index = Index::handles().get(index.id)?;
        // SAFETY: the caller promises it.
        let (starts, goals, watch) = unsafe {
            let starts = points::read("starts", starts, start_count)?;
            (starts, points::read("goals", goals, goal_count)?, Watch::read(watcher)?)
        };
        let table = index.within(words::limits(&watch)).table(starts, goals);
        let table = table.map_err(|error| watch.failure(error))?;
        // SAFETY: as above.
        unsafe { memory::fill("lengths", lengths, room, table.values().iter().copied()) }
    })
}
