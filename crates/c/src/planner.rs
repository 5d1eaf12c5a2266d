//! Planners: queries on an index, at once or in steps.

#![allow(unsafe_code, reason = "functions of C")]

use std::ffi::c_char;

use library::{
    Answer as InnerAnswer, Error, Exceptions, Goals, Guarantee, Index, Path, Planner, PointEnds, Query,
    Stopped, errors::QueryError,
};

use crate::{
    answer::{self, Answer},
    code::Code,
    failure::{Failure, call},
    goals::GoalsHandle,
    handles::{Held, Kind, Table},
    index::{IndexHandle, static_name},
    memory,
    points::{self, Cell, Point},
    watch::{Watch, Watcher},
    words,
};

/// Answers queries on an index, one after another. One call at a time may use it: another one at the same
/// time returns `MEDIANT_CODE_BUSY`. Each thread makes a planner of its own. `{0}` is no planner.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PlannerHandle {
    /// Its number.
    pub id: u64,
}

/// A planner, with its last answer.
pub(crate) struct State {
    planner: Planner,
    /// The path of the last answer.
    path: Option<Path>,
    /// The watcher of the search that was begun, until another query forgets it. The library's planner may
    /// have the search of any query, with a watcher that is gone when that query has ended.
    begun: Option<Watch>,
}

impl Held for State {
    type Kept = Self;

    fn handles() -> &'static Table<Self> {
        static HANDLES: Table<State> = Table::new(Kind::Planner);
        &HANDLES
    }
}

/// Gives a planner to a call.
#[inline]
fn with<R>(
    planner: PlannerHandle,
    work: impl FnOnce(&mut State) -> Result<R, Failure>,
) -> Result<R, Failure> {
    State::handles().alone(planner.id, work)
}

impl State {
    /// The planner, for a query that forgets the last path and the search that was begun.
    #[inline]
    fn ask(&mut self) -> &mut Planner {
        (self.path, self.begun) = (None, None);
        &mut self.planner
    }

    /// The planner, if it has a search that was begun.
    fn searching(&mut self) -> Option<&mut Planner> {
        self.begun.is_some().then_some(&mut self.planner)
    }

    /// The answer as C has it; its path is kept.
    fn told(&mut self, answer: InnerAnswer, guarantee: Guarantee, watch: &Watch) -> Answer {
        let stopped_by = watch.limit_met(answer.stopped_by()).into();
        let rules = self.planner.index().setup().rules();
        let told = Answer { stopped_by, ..Answer::new(&answer, (guarantee, rules)) };
        self.path = match answer {
            InnerAnswer::Stopped(stopped) => Some(stopped.best),
            answer => answer.into_path(),
        };
        told
    }
}

/// A planner on an index, with scratch memory of its own.
///
/// # Safety
/// `planner` leads to a handle's memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_planner_new(index: IndexHandle, planner: *mut PlannerHandle) -> Code {
    call(|| {
        memory::check_place("planner", planner)?;
        let inner = Index::handles().get(index.id)?.try_planner()?;
        let id = State::handles().keep(State { planner: inner, path: None, begun: None })?;
        // SAFETY: the caller promises it.
        unsafe { memory::put("planner", planner, PlannerHandle { id }) }
    })
}

/// Frees a planner.
#[unsafe(no_mangle)]
pub extern "C" fn mediant_planner_free(planner: PlannerHandle) -> Code {
    call(|| State::handles().free_alone(planner.id))
}

/// The shortest path between two points: writes its points, as many as there is room for, how many there are
/// (0 where there is no path), and its length (infinity then; where cells have costs, its cost). With more
/// points than room, `mediant_planner_points` has all of them.
///
/// # Safety
/// `points` leads to memory for `room` points; `count` and `length` lead to memory for a number each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_planner_path(
    planner: PlannerHandle,
    start: Point,
    goal: Point,
    points: *mut Point,
    room: usize,
    count: *mut usize,
    length: *mut f64,
) -> Code {
    call(|| {
        let ends = PointEnds::new(start.inner("start")?, goal.inner("goal")?);
        answer::check_places(points, room, count)?;
        memory::check_place("length", length)?;
        with(planner, |state| {
            state.path = state.ask().find(ends)?.into_path();
            let path = state.path.as_ref();
            // SAFETY: the caller promises it.
            unsafe {
                answer::write(path, (points, room), count)?;
                memory::put("length", length, path.map_or(f64::INFINITY, Path::cost))
            }
        })
    })
}

/// The points of the path that the planner found last: of `mediant_planner_path`, `_find`, `_step`,
/// `_find_except`. Any query forgets it first.
///
/// # Safety
/// `points` leads to memory for `room` points; `count` leads to memory for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_planner_points(
    planner: PlannerHandle,
    points: *mut Point,
    room: usize,
    count: *mut usize,
) -> Code {
    call(|| {
        answer::check_places(points, room, count)?;
        // SAFETY: the caller promises it.
        with(planner, |state| unsafe { answer::write(state.path.as_ref(), (points, room), count) })
    })
}

/// Reads a query.
///
/// # Safety
/// As for the functions that take one.
unsafe fn query(
    (starts, start_count): (*const Point, usize),
    (goals, goal_count): (*const Point, usize),
    wishes: *const c_char,
    watch: &Watch,
) -> Result<Query, Failure> {
    // SAFETY: the caller promises it.
    unsafe {
        let starts = points::read("starts", starts, start_count)?;
        let goals = points::read("goals", goals, goal_count)?;
        let call = words::read("wishes", wishes, words::WISHES)?;
        Ok(words::query(&call, &starts, &goals, watch))
    }
}

/// Answers a query from any of several starts to any of several goals. `wishes` has the parameters `nearest`,
/// `snap`, `tolerance`, `max_cost`, `max_expansions`, `timeout` (in milliseconds), as in
/// `"nearest max_cost=20"`; null is none. `mediant_planner_points` has the path.
///
/// # Safety
/// `starts` and `goals` lead to as many points as they have; `wishes` is a text or null; `watcher` is null or
/// leads to one; `answer` leads to an answer's memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_planner_find(
    planner: PlannerHandle,
    starts: *const Point,
    start_count: usize,
    goals: *const Point,
    goal_count: usize,
    wishes: *const c_char,
    watcher: *const Watcher,
    answer: *mut Answer,
) -> Code {
    call(|| {
        memory::check_place("answer", answer)?;
        // SAFETY: the caller promises it.
        let watch = unsafe { Watch::read(watcher) }?;
        // SAFETY: as above.
        let query = unsafe { query((starts, start_count), (goals, goal_count), wishes, &watch) }?;
        let told = with(planner, |state| {
            let found = state.ask().find(query).map_err(|error| watch.failure(error))?;
            let guarantee = state.planner.guarantee();
            Ok(state.told(found, guarantee, &watch))
        })?;
        // SAFETY: as above.
        unsafe { memory::put("answer", answer, told) }
    })
}

/// The length of the path between two points, without the path: infinity where there is none.
///
/// # Safety
/// `length` leads to memory for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_planner_distance(
    planner: PlannerHandle,
    start: Point,
    goal: Point,
    length: *mut f64,
) -> Code {
    call(|| {
        let ends = PointEnds::new(start.inner("start")?, goal.inner("goal")?);
        memory::check_place("length", length)?;
        let distance = with(planner, |state| Ok(state.ask().distance(ends)?))?;
        // SAFETY: the caller promises it.
        unsafe { memory::put("length", length, distance.unwrap_or(f64::INFINITY)) }
    })
}

/// Begins a search, and forgets the last one. Nothing is expanded yet. Any other query of this planner
/// forgets it. What a watcher calls, and its data, must stay until the search has answered or is forgotten.
///
/// # Safety
/// As for `mediant_planner_find`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_planner_begin(
    planner: PlannerHandle,
    starts: *const Point,
    start_count: usize,
    goals: *const Point,
    goal_count: usize,
    wishes: *const c_char,
    watcher: *const Watcher,
) -> Code {
    call(|| {
        // SAFETY: the caller promises it.
        let watch = unsafe { Watch::read(watcher) }?;
        // SAFETY: as above.
        let query = unsafe { query((starts, start_count), (goals, goal_count), wishes, &watch) }?;
        with(planner, |state| {
            state.ask().begin(query).map_err(|error| watch.failure(error))?;
            state.begun = Some(watch);
            Ok(())
        })
    })
}

/// Continues the search by at most so many expansions, and writes whether it has answered: 1 or 0. The answer
/// is written then.
///
/// # Safety
/// `done` leads to memory for a number, `answer` to an answer's.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_planner_step(
    planner: PlannerHandle,
    expansions: u64,
    done: *mut i32,
    answer: *mut Answer,
) -> Code {
    call(|| {
        memory::check_place("done", done)?;
        memory::check_place("answer", answer)?;
        let told = with(planner, |state| {
            let watch = state.begun.clone().ok_or(QueryError::NotBegun)?;
            let found = state.planner.step(expansions).map_err(|error| watch.failure(error))?;
            let guarantee = state.planner.guarantee();
            Ok(found.map(|found| state.told(found, guarantee, &watch)))
        })?;
        // SAFETY: the caller promises it.
        unsafe {
            if let Some(told) = told {
                memory::put("answer", answer, told)?;
            }
            memory::put("done", done, i32::from(told.is_some()))
        }
    })
}

/// The progress of the search that was begun: the number of its expansions, and a lower bound on the length
/// of the path that is sought. 0 without one.
///
/// # Safety
/// Both lead to memory for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_planner_progress(
    planner: PlannerHandle,
    expansions: *mut u64,
    lower_bound: *mut f64,
) -> Code {
    call(|| {
        memory::check_place("lower_bound", lower_bound)?;
        let (so_far, least) = with(planner, |state| {
            let begun = state.searching();
            Ok(begun.map_or((0, 0.0), |planner| (planner.expansions(), planner.lower_bound())))
        })?;
        // SAFETY: the caller promises it.
        unsafe {
            memory::put("expansions", expansions, so_far)?;
            memory::put("lower_bound", lower_bound, least)
        }
    })
}

/// The best path so far of the search that was begun: to a goal, if one was found, else to the vertex nearest
/// to a goal among those that it expanded. No points without a search.
///
/// # Safety
/// As for `mediant_planner_points`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_planner_best(
    planner: PlannerHandle,
    points: *mut Point,
    room: usize,
    count: *mut usize,
) -> Code {
    call(|| {
        answer::check_places(points, room, count)?;
        let best = with(planner, |state| Ok(state.searching().and_then(Planner::best)))?;
        // SAFETY: the caller promises it.
        unsafe { answer::write(best.as_ref(), (points, room), count) }
    })
}

/// The path by which the search that was begun has reached a vertex; no points where it has not.
///
/// # Safety
/// As for `mediant_planner_points`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_planner_path_to(
    planner: PlannerHandle,
    at: Point,
    points: *mut Point,
    room: usize,
    count: *mut usize,
) -> Code {
    call(|| {
        let at = at.inner("at")?;
        answer::check_places(points, room, count)?;
        let path = with(planner, |state| Ok(state.searching().and_then(|planner| planner.path_to(at))))?;
        // SAFETY: the caller promises it.
        unsafe { answer::write(path.as_ref(), (points, room), count) }
    })
}

/// Continues on another index of the same engine and motion, such as a repaired one, with the same scratch
/// memory. The last path and the search that was begun are forgotten.
#[unsafe(no_mangle)]
pub extern "C" fn mediant_planner_follow(planner: PlannerHandle, index: IndexHandle) -> Code {
    call(|| {
        let index = Index::handles().get(index.id)?;
        with(planner, |state| Ok(state.ask().follow(&index)?))
    })
}

/// The name of the engine that answered the last query. It stays for ever.
///
/// # Safety
/// `engine` leads to memory for a pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_planner_searched_by(
    planner: PlannerHandle,
    engine: *mut *const c_char,
) -> Code {
    call(|| {
        let name = static_name(with(planner, |state| Ok(state.planner.searched_by()))?)?;
        // SAFETY: the caller promises it.
        unsafe { memory::put("engine", engine, name) }
    })
}

/// The lengths of the paths to each of many goals, in their order, as many as there is room for, and how many
/// there are; infinity where none leads.
///
/// # Safety
/// `lengths` leads to memory for `room` numbers; `count` leads to memory for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_planner_distances(
    planner: PlannerHandle,
    start: Point,
    goals: GoalsHandle,
    lengths: *mut f64,
    room: usize,
    count: *mut usize,
) -> Code {
    call(|| {
        memory::check_place("count", count)?;
        memory::check_room("lengths", lengths, room)?;
        let (start, goals) = (start.inner("start")?, Goals::handles().get(goals.id)?);
        let found = with(planner, |state| Ok(state.ask().distances(start, &goals)?))?;
        // SAFETY: the caller promises it.
        unsafe {
            memory::put("count", count, found.len())?;
            memory::fill("lengths", lengths, room, found)
        }
    })
}

/// The goal to which the path is shortest, by its number, and the length of that path: infinity if there is
/// no way to any.
///
/// # Safety
/// `goal` and `length` lead to memory for a number each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_planner_nearest(
    planner: PlannerHandle,
    start: Point,
    goals: GoalsHandle,
    goal: *mut usize,
    length: *mut f64,
) -> Code {
    call(|| {
        memory::check_place("length", length)?;
        let (start, goals) = (start.inner("start")?, Goals::handles().get(goals.id)?);
        let nearest = with(planner, |state| Ok(state.ask().nearest(start, &goals)?))?;
        let (number, cells) = nearest.unwrap_or((0, f64::INFINITY));
        // SAFETY: the caller promises it.
        unsafe {
            memory::put("goal", goal, number)?;
            memory::put("length", length, cells)
        }
    })
}

/// Cells that count otherwise than on the map, for one query.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct CellExceptions {
    /// Cells that count as blocked.
    pub blocked: *const Cell,
    /// The number of these.
    pub blocked_count: usize,
    /// Cells that count as free.
    pub free: *const Cell,
    /// The number of these.
    pub free_count: usize,
    /// Whether the cells at start and goal count as free: 1 or 0.
    pub free_ends: i32,
}

/// Answers a query as on the map with some cells edited: as `mediant_planner_find`.
///
/// # Safety
/// As for `mediant_planner_find`; `exceptions` leads to one, whose arrays have as many cells as it says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_planner_find_except(
    planner: PlannerHandle,
    starts: *const Point,
    start_count: usize,
    goals: *const Point,
    goal_count: usize,
    exceptions: *const CellExceptions,
    wishes: *const c_char,
    watcher: *const Watcher,
    answer: *mut Answer,
) -> Code {
    call(|| {
        memory::check_place("answer", answer)?;
        // SAFETY: the caller promises it.
        let watch = unsafe { Watch::read(watcher) }?;
        // SAFETY: as above.
        let (query, except) = unsafe {
            let query = query((starts, start_count), (goals, goal_count), wishes, &watch)?;
            let given = memory::value("exceptions", exceptions)?;
            let blocked = memory::array("blocked", given.blocked, given.blocked_count)?;
            let free = memory::array("free", given.free, given.free_count)?;
            let except = Exceptions::new().blocked(blocked.iter().copied()).free(free.iter().copied());
            (query, if given.free_ends != 0 { except.free_ends() } else { except })
        };
        let first = query.starts().first().copied().unwrap_or_default();
        let told = with(planner, |state| {
            let (found, guarantee) = match state.ask().find_except(query, &except) {
                Err(Error::Stopped { by, .. }) => {
                    (InnerAnswer::Stopped(Stopped::before_search(by, first)), Guarantee::Suboptimal)
                }
                found => found.map(|found| (found.answer, found.guarantee))?,
            };
            Ok(state.told(found, guarantee, &watch))
        })?;
        // SAFETY: as above.
        unsafe { memory::put("answer", answer, told) }
    })
}
