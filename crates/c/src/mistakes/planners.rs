//! Calls of planners.

use std::{
    cell::RefCell,
    ffi::{CStr, c_char},
    rc::Rc,
};

use super::{
    ask,
    draw::{Array, untouched},
    model::{End, IndexModel, MapModel, PlannerModel, SpaceModel, inner_of, is_near, length},
    queries,
    world::World,
};
use crate::{
    answer::Answer,
    code::Code,
    goals::GoalsHandle,
    index::IndexHandle,
    planner::{
        CellExceptions, PlannerHandle, mediant_planner_begin, mediant_planner_best, mediant_planner_distance,
        mediant_planner_distances, mediant_planner_find, mediant_planner_find_except, mediant_planner_follow,
        mediant_planner_nearest, mediant_planner_new, mediant_planner_path, mediant_planner_path_to,
        mediant_planner_points, mediant_planner_progress, mediant_planner_searched_by, mediant_planner_step,
    },
    points::{Cell, Point},
};

/// A planner that was drawn: its handle, what it is, and its index.
type Drawn = (PlannerHandle, Option<Rc<RefCell<PlannerModel>>>, Option<Rc<IndexModel>>);

impl World {
    fn planner(&mut self) -> Drawn {
        let (id, planner) = self.handle(|world| &world.planners);
        let index = planner.as_ref().map(|planner| planner.borrow().index.clone());
        index.iter().for_each(|index| self.maybe(index.maybe()));
        (PlannerHandle { id }, planner, index)
    }
}

/// Makes a planner.
pub(super) fn make(world: &mut World) {
    let (id, index) = world.handle(|world| &world.indexes);
    let place = world.place();
    let code = ask!(mediant_planner_new(IndexHandle { id }, place.at));
    if world.ended("planner_new", code) {
        let (index, points) = (index.expect("right"), Vec::new());
        let model = PlannerModel { index, points, begun: None, is_lost: false, callers: Vec::new() };
        world.planners.add(place.values()[0].id, RefCell::new(model));
    }
}

/// Any call of a planner.
pub(super) fn any(world: &mut World) {
    match world.rng.below(20) {
        0..4 => path(world),
        4..7 => find(world),
        7 => distance(world),
        8 => points(world),
        9..11 => begin(world),
        11..14 => step(world),
        14 => progress(world),
        15 => path_to(world),
        16 => follow(world),
        17 => to_goals(world),
        18 => find_except(world),
        _ => searched_by(world),
    }
}

/// The points that a call wrote, all of them: it asks again for those that had no room.
fn all(planner: PlannerHandle, points: &Array<Point>, count: usize) -> Vec<Point> {
    let mut all = vec![untouched::<Point>(); count + 1];
    let mut told = 0;
    assert_eq!(ask!(mediant_planner_points(planner, all.as_mut_ptr(), count, &raw mut told)), Code::Ok);
    assert_eq!(told, count, "the number of points");
    assert_eq!(all.pop().map(|at| at.x.to_bits()), Some(untouched::<u64>()), "a point beyond its room");
    let first = points.values();
    assert!(first.iter().zip(&all).all(|(a, b)| a == b), "{first:?} of {all:?}");
    assert!(
        first.iter().skip(count).all(|at| at.x.to_bits() == untouched::<u64>()),
        "beyond {count}: {first:?}"
    );
    all
}

fn path(world: &mut World) {
    let (handle, planner, index) = world.planner();
    let space = index.as_ref().map(|index| index.space.clone());
    let (start, goal) = (world.end(space.as_deref(), End::Start), world.end(space.as_deref(), End::Goal));
    let (points, count, length) = (world.room::<Point>(6), world.place::<usize>(), world.place::<f64>());
    let code = ask!(mediant_planner_path(handle, start, goal, points.at, points.count, count.at, length.at));
    lost(planner.as_deref(), code);
    if world.ended("planner_path", code) {
        let (index, found) = (index.expect("right"), all(handle, &points, count.values()[0]));
        index.check_path(&index.space, (start, goal), &found, length.values()[0]);
        planner.expect("right").borrow_mut().points = found;
    } else {
        assert!(
            points.is_untouched() && count.is_untouched() && length.is_untouched(),
            "written after a mistake"
        );
        lost(planner.as_deref(), code);
    }
}

/// A planner forgets its search and its path at the next query. One with a mistake may be
/// refused before that.
fn lost(planner: Option<&RefCell<PlannerModel>>, code: Code) {
    if let Some(planner) = planner {
        let mut planner = planner.borrow_mut();
        planner.is_lost = true;
        planner.points.clear();
        if code == Code::Ok {
            planner.begun = None;
            planner.callers.clear();
        }
    }
}

fn distance(world: &mut World) {
    let (handle, planner, index) = world.planner();
    let space = index.as_ref().map(|index| index.space.clone());
    let (start, goal) = (world.end(space.as_deref(), End::Start), world.end(space.as_deref(), End::Goal));
    let length = world.place::<f64>();
    let code = ask!(mediant_planner_distance(handle, start, goal, length.at));
    lost(planner.as_deref(), code);
    if world.ended("planner_distance", code) {
        let index = index.expect("right");
        index.check_cost(&index.space, (start, goal), length.values()[0]);
    }
}

/// The points of the last path, if it is known.
fn points(world: &mut World) {
    let (handle, planner, _) = world.planner();
    let (points, count) = (world.room::<Point>(6), world.place::<usize>());
    let code = ask!(mediant_planner_points(handle, points.at, points.count, count.at));
    if world.ended("planner_points", code) {
        let known = planner.expect("right").borrow().points.clone();
        let (found, count) = (points.values(), count.values()[0]);
        if !known.is_empty() {
            assert_eq!(count, known.len());
            assert!(found.iter().zip(&known).all(|(a, b)| a == b), "{found:?}, not {known:?}");
        }
    }
}

fn find(world: &mut World) {
    let (handle, planner, index) = world.planner();
    let space = index.as_ref().map(|index| index.space.clone());
    let mut asked = world.query(space.as_deref());
    let watcher = world.watcher(handle.id);
    asked.begun.can_stop = watcher.can_stop;
    let (starts, goals) = (world.values(&asked.begun.starts), world.values(&asked.begun.goals));
    let place = world.place::<Answer>();
    let words = asked.words.as_ptr();
    let code = ask!(mediant_planner_find(
        handle,
        starts.at,
        starts.count,
        goals.at,
        goals.count,
        words,
        watcher.at,
        place.at
    ));
    watcher.caller.check();
    lost(planner.as_deref(), code);
    if world.ended("planner_find", code) {
        let (index, answer) = (index.expect("right"), place.values()[0]);
        let found = all(handle, &Array::empty(), answer.point_count);
        queries::check(&index, &index.space, &asked.begun, &answer, &found);
        planner.expect("right").borrow_mut().points = found;
    }
}

fn find_except(world: &mut World) {
    let (handle, planner, index) = world.planner();
    let size = index.as_ref().map_or((4, 4), |index| index.space.map.size);
    let cells = |world: &mut World| (0..world.rng.below(4)).map(|_| world.cell(size)).collect::<Vec<_>>();
    let (blocked, free) = (cells(world), cells(world));
    let other = index.as_ref().map(|index| Rc::new(with_cells(&index.space, &blocked, &free)));
    let mut asked = world.query(other.as_deref());
    let free_ends = world.rng.chance(15);
    if free_ends {
        // They are free in this call, if they are cells.
        world.forgive_ends();
    }
    world.maybe(&[Code::EditOutside, Code::Argument]);
    let is_priced = index.as_ref().is_some_and(|index| index.space.map.costs.is_some());
    if is_priced {
        world.maybe(&[Code::EngineWithout, Code::EngineOption, Code::Cost]);
    }
    let watcher = world.watcher(handle.id);
    asked.begun.can_stop = watcher.can_stop;
    if asked.begun.may_stop() {
        // Stopped before the search, nobody has looked at its ends.
        world.forgive_ends();
    }
    let (starts, goals) = (world.values(&asked.begun.starts), world.values(&asked.begun.goals));
    let (blocked, free) = (world.values(&blocked), world.values(&free));
    let given = CellExceptions {
        blocked: blocked.at,
        blocked_count: blocked.count,
        free: free.at,
        free_count: free.count,
        free_ends: i32::from(free_ends),
    };
    let (given, place) = (world.values(&[given]), world.place::<Answer>());
    if given.count != 1 {
        world.forgive(Code::Argument);
    }
    let code = ask!(mediant_planner_find_except(
        handle,
        starts.at,
        starts.count,
        goals.at,
        goals.count,
        given.at,
        asked.words.as_ptr(),
        watcher.at,
        place.at
    ));
    watcher.caller.check();
    lost(planner.as_deref(), code);
    if world.ended("planner_find_except", code) {
        let (index, answer) = (index.expect("right"), place.values()[0]);
        let found = all(handle, &Array::empty(), answer.point_count);
        if !(free_ends || is_priced) {
            // Another engine may have answered, whose paths are as good.
            queries::check(&index, &other.expect("right"), &asked.begun, &answer, &found);
        }
    }
}

/// A space whose map has other cells.
fn with_cells(space: &SpaceModel, blocked: &[Cell], free: &[Cell]) -> SpaceModel {
    let mut map = MapModel::clone(&space.map);
    for (cells, is_blocked) in [(blocked, true), (free, false)] {
        for at in cells {
            if let Some(at) = map.index(at.x.into(), at.y.into()) {
                map.blocked[at] = is_blocked;
            }
        }
    }
    space.with_cells(map)
}

fn begin(world: &mut World) {
    let (handle, planner, index) = world.planner();
    let space = index.map(|index| index.space.clone());
    let mut asked = world.query(space.as_deref());
    let watcher = world.watcher(handle.id);
    asked.begun.can_stop = watcher.can_stop;
    let (starts, goals) = (world.values(&asked.begun.starts), world.values(&asked.begun.goals));
    let code = ask!(mediant_planner_begin(
        handle,
        starts.at,
        starts.count,
        goals.at,
        goals.count,
        asked.words.as_ptr(),
        watcher.at
    ));
    watcher.caller.check();
    lost(planner.as_deref(), code);
    if let Some(planner) = planner {
        planner.borrow_mut().callers.push(watcher.caller);
        if code == Code::Ok {
            let mut planner = planner.borrow_mut();
            (planner.begun, planner.is_lost) = (Some(asked.begun), false);
        }
    }
    world.ended("planner_begin", code);
}

fn step(world: &mut World) {
    let (handle, planner, index) = world.planner();
    let (done, place) = (world.place::<i32>(), world.place::<Answer>());
    let expansions = [0, 1, 3, 10, 1000, u64::MAX][world.rng.below(6) as usize];
    let begun = planner.as_ref().and_then(|planner| planner.borrow().begun.clone());
    match &planner {
        Some(_) if begun.is_none() => world.wrong(Code::NotBegun),
        Some(planner) if planner.borrow().is_lost => world.maybe(&[Code::NotBegun]),
        _ => {}
    }
    let code = ask!(mediant_planner_step(handle, expansions, done.at, place.at));
    planner.iter().for_each(|planner| planner.borrow().callers.iter().for_each(|caller| caller.check()));
    if !world.ended("planner_step", code) {
        return;
    }
    let (index, planner) = (index.expect("right"), planner.expect("right"));
    if done.values()[0] == 0 {
        assert!(place.is_untouched(), "an answer of a search that has none");
        assert!(expansions < u64::MAX, "no end");
    } else if let Some(begun) = begun {
        let answer = place.values()[0];
        let found = all(handle, &Array::empty(), answer.point_count);
        queries::check(&index, &index.space, &begun, &answer, &found);
        let mut planner = planner.borrow_mut();
        planner.points = found;
    }
}

fn progress(world: &mut World) {
    let (handle, planner, _) = world.planner();
    let (expansions, bound) = (world.place::<u64>(), world.place::<f64>());
    let code = ask!(mediant_planner_progress(handle, expansions.at, bound.at));
    if world.ended("planner_progress", code) {
        let (expansions, bound) = (expansions.values()[0], bound.values()[0]);
        assert!(expansions < 1 << 40 && bound >= 0.0);
        let is_begun = planner.expect("right").borrow().begun.is_some();
        assert!(is_begun || (expansions, bound) == (0, 0.0), "{expansions}, {bound} of no search");
    }
}

/// A path to what was reached, and the best one so far.
fn path_to(world: &mut World) {
    let (handle, planner, index) = world.planner();
    let space = index.map(|index| index.space.clone());
    let (points, count) = (world.room::<Point>(40), world.place::<usize>());
    let (name, code) = if world.rng.chance(50) {
        ("planner_best", ask!(mediant_planner_best(handle, points.at, points.count, count.at)))
    } else {
        let at = world.end(space.as_deref(), End::Other);
        ("planner_path_to", ask!(mediant_planner_path_to(handle, at, points.at, points.count, count.at)))
    };
    if world.ended(name, code) {
        let (count, space) = (count.values()[0], space.expect("right"));
        let found: Vec<Point> = points.values().into_iter().take(count).collect();
        let begun = planner.expect("right").borrow().begun.clone();
        assert!(begun.is_some() || count == 0, "{name}: {found:?} of no search");
        if let (true, Some(begun)) = (found.len() == count && count > 0, begun) {
            let ends = (found[0], found[count - 1]);
            space.check(&found, ends, length(&found), false);
            assert!(
                begun.starts.iter().any(|&start| inner_of(start) == inner_of(ends.0)) || begun.is_moved(),
                "{name}: {found:?} of {begun:?}"
            );
        }
    }
}

fn follow(world: &mut World) {
    let (handle, planner, index) = world.planner();
    let (id, to) = world.handle(|world| &world.indexes);
    let is_other = |index: &Rc<IndexModel>, to: &Rc<IndexModel>| {
        index.space.motion != to.space.motion || index.setup.engine.kind() != to.setup.engine.kind()
    };
    if index.as_ref().zip(to.as_ref()).is_some_and(|(index, to)| is_other(index, to)) {
        world.wrong(Code::Mismatch);
        world.wrong(Code::EngineOption);
    }
    world.maybe(&[Code::EngineOption, Code::Mismatch, Code::IndexOptions]);
    let code = mediant_planner_follow(handle, IndexHandle { id });
    lost(planner.as_deref(), code);
    if world.ended("planner_follow", code) {
        planner.expect("right").borrow_mut().index = to.expect("right");
    }
}

fn searched_by(world: &mut World) {
    let (handle, ..) = world.planner();
    let place = world.place::<*const c_char>();
    let code = ask!(mediant_planner_searched_by(handle, place.at));
    if world.ended("planner_searched_by", code) {
        // SAFETY: it is a text that stays for ever.
        let name = unsafe { CStr::from_ptr(place.values()[0]) }.to_str().expect("UTF-8");
        assert!(name.parse::<library::Engine>().is_ok(), "the engine {name}");
    }
}

fn to_goals(world: &mut World) {
    let (handle, planner, index) = world.planner();
    let (id, goals) = world.handle(|world| &world.goals);
    let space = index.as_ref().map(|index| index.space.clone());
    let start = world.end(space.as_deref(), End::Start);
    if let (Some(space), Some(goals)) = (&space, &goals) {
        let is_same = Rc::ptr_eq(&space.map, &goals.space.map) && space.motion == goals.space.motion;
        let is_alike = space.map == goals.space.map && space.motion == goals.space.motion;
        match (is_same, is_alike) {
            (true, _) => {}
            (_, true) => world.maybe(&[Code::Mismatch]),
            _ => world.wrong(Code::Mismatch),
        }
    }
    if world.rng.chance(50) {
        let enough = goals.as_ref().map_or(2, |goals| goals.goals.len());
        let (lengths, count) = (world.room::<f64>(enough), world.place::<usize>());
        let code = ask!(mediant_planner_distances(
            handle,
            start,
            GoalsHandle { id },
            lengths.at,
            lengths.count,
            count.at
        ));
        lost(planner.as_deref(), code);
        if world.ended("planner_distances", code) {
            let (index, goals) = (index.expect("right"), goals.expect("right"));
            assert_eq!(count.values()[0], goals.goals.len());
            for (&goal, cost) in goals.goals.iter().zip(lengths.values()) {
                index.check_cost(&index.space, (start, goal), cost);
            }
        }
        return;
    }
    let (goal, place) = (world.place::<usize>(), world.place::<f64>());
    let code = ask!(mediant_planner_nearest(handle, start, GoalsHandle { id }, goal.at, place.at));
    lost(planner.as_deref(), code);
    if world.ended("planner_nearest", code) {
        let (index, goals) = (index.expect("right"), goals.expect("right"));
        let costs = goals.goals.iter().filter_map(|&goal| index.space.cost(start, goal));
        let (least, found) = (costs.fold(f64::INFINITY, f64::min), place.values()[0]);
        if found.is_finite() {
            index.check_cost(&index.space, (start, goals.goals[goal.values()[0]]), found);
        }
        assert!(!index.is_exact() || is_near(found, least), "{found}, not {least}");
        let is_known = least.is_finite() || !index.is_beyond_moves();
        assert!(!is_known || found.is_finite() == least.is_finite(), "{found}, not {least}");
    }
}
