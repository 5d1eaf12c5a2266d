//! A callback that panics loses one call: what was shared with it still answers right, and nothing hangs.

use std::{
    panic::{AssertUnwindSafe, catch_unwind, resume_unwind},
    sync::{
        Arc,
        atomic::{AtomicI64, Ordering},
    },
    time::Duration,
};

use mediant::{
    Answer, Engine, Index, K, Limits, Map, Motion, Planners, Query, Rectangle, Space,
    search::{NodeEvent, Observer},
};

const SIDE: u32 = 48;
const ENDS: [[(i32, i32); 2]; 3] = [[(0, 0), (47, 40)], [(5, 40), (40, 3)], [(20, 20), (1, 46)]];

fn map() -> Map {
    Map::from_fn(SIDE, SIDE, |x, y| x % 7 == 3 && y % 5 != 2).expect("a map")
}

/// Each engine with a motion that it takes.
fn spaces() -> Vec<(Engine, Space)> {
    let costs = map().costs((0..SIDE * SIDE).map(|cell| 1 + cell % 3)).expect("costs");
    let plain = [Motion::centers(K::N8), Motion::corners(K::ANY), Motion::corners(K::N8)];
    let plain = plain.map(|motion| map().space(motion).expect("a space"));
    let spaces = [&plain[..], &[costs.space(Motion::centers(K::N8)).expect("a space")]].concat();
    let takes = |engine| spaces.iter().find(|space| space.make_ready(engine).is_ok());
    let all = Engine::ALL.into_iter();
    all.map(|engine| (engine, takes(engine).expect("a motion that it takes").clone())).collect()
}

/// Does some work that panics on purpose; whether it did.
fn panics(work: impl FnOnce()) -> bool {
    let Err(payload) = catch_unwind(AssertUnwindSafe(work)) else { return false };
    let is_ours = payload.downcast_ref::<&str>().is_some_and(|text| *text == "on purpose");
    if !is_ours {
        resume_unwind(payload);
    }
    true
}

/// Without a word on the standard error, as `panic!` would have.
fn fail() -> ! {
    resume_unwind(Box::new("on purpose"))
}

/// Limits whose deadline panics at the question with this number.
fn failing(number: i64) -> Limits {
    let left = AtomicI64::new(number);
    Limits::new().deadline(move || left.fetch_sub(1, Ordering::Relaxed) <= 0 && fail())
}

fn costs(index: &Index) -> Vec<Option<f64>> {
    let mut planner = index.planner();
    ENDS.map(|[start, goal]| planner.distance((start, goal)).expect("free ends")).to_vec()
}

#[test]
fn planners_answer_after_a_deadline_that_panics() {
    for (engine, space) in spaces() {
        let index = space.prepare(engine).expect("an index");
        let known = costs(&index);
        let (mut planner, shared) = (index.planner(), Planners::new(index.clone()));
        let mut panicked = 0;
        for number in 0..4 {
            for [start, goal] in ENDS {
                let query = || Query::new(start, goal).within(failing(number));
                panicked += usize::from(panics(|| drop(planner.find(query()))));
                panics(|| drop(shared.find(query())));
                let wish = || Query::new(start, goal).tolerance(1.5).within(failing(number));
                panics(|| drop(planner.find(wish())));
                panics(|| {
                    planner.begin(query()).expect("free ends");
                    while planner.step(3).expect("begun").is_none() {}
                });
            }
            let after = ENDS.map(|[start, goal]| planner.distance((start, goal)).expect("free ends"));
            assert_eq!(after[..], known[..], "{engine}, question {number}");
            let after = ENDS.map(|[start, goal]| {
                shared.with(|planner| planner.distance((start, goal))).expect("free ends")
            });
            assert_eq!(after[..], known[..], "{engine}, shared, question {number}");
        }
        assert!(panicked > 0, "{engine} asks no deadline");
    }
}

/// An observer that panics at the event with this number.
struct Failing(i64);

impl Observer for Failing {
    fn expanded(&mut self, _: NodeEvent) {
        self.0 -= 1;
        if self.0 <= 0 {
            fail();
        }
    }
}

#[test]
fn planners_answer_after_an_observer_that_panics() {
    for (engine, space) in spaces() {
        let index = space.prepare(engine).expect("an index");
        let known = costs(&index);
        let mut planner = index.planner();
        for number in [1, 2, 5] {
            for [start, goal] in ENDS {
                panics(|| drop(planner.find_observed((start, goal), &mut Failing(number))));
                let after = planner.distance((start, goal)).expect("free ends");
                let at = ENDS.iter().position(|&ends| ends == [start, goal]).expect("one of them");
                assert_eq!(after, known[at], "{engine}, event {number}");
            }
        }
    }
}

#[test]
fn spaces_and_indexes_are_right_after_preparations_that_panic() {
    for (engine, space) in spaces() {
        let known = costs(&space.prepare(engine).expect("an index"));
        // Anew: what a space prepares once for all is asked for only once.
        let fresh = spaces().into_iter().find(|(other, _)| *other == engine).expect("it is there").1;
        for number in [0, 1, 3, 10, 40] {
            panics(|| drop(fresh.within(failing(number)).prepare(engine)));
            let told = AtomicI64::new(number);
            let listen = |_| {
                if told.fetch_sub(1, Ordering::Relaxed) <= 0 {
                    fail()
                }
            };
            panics(|| drop(fresh.prepare_with_progress(engine, &listen)));
        }
        let index = fresh.prepare(engine).expect("an index");
        assert_eq!(costs(&index), known, "{engine}");
        let close = Rectangle::new(20, 10, 6, 6);
        assert!(panics(|| drop(fresh.edit(close, |x, _| x == 22 && fail()))), "{engine}");
        let change = fresh.edit(close, |_, _| true);
        let change = change.or_else(|_| fresh.edit_costs([((22, 12), None::<f64>)])).expect("an edit");
        let after = costs(&change.after().prepare(engine).expect("an index"));
        for number in [0, 1, 3, 10] {
            panics(|| drop(index.within(failing(number)).repair(&change)));
        }
        assert_eq!(costs(&index.repair(&change).expect("an index")), after, "{engine}, repaired");
        assert_eq!(costs(&index), known, "{engine}, as before");
    }
}

#[test]
fn batches_tables_and_fields_are_right_after_callbacks_that_panic() {
    let space = map().space(Motion::corners(K::ANY)).expect("a space");
    let shared = Planners::new(space.prepare(Engine::Subgoal).expect("an index"));
    let queries: Vec<Query> =
        (0..900).map(|number| ENDS[number % 3]).map(|[start, goal]| Query::new(start, goal)).collect();
    let known: Vec<Option<f64>> = costs(shared.index());
    for number in [0, 100, 700] {
        let mut some = queries.clone();
        some[number as usize] = some[number as usize].clone().within(failing(0));
        assert!(panics(|| drop(shared.find_all(&some))), "query {number}");
        let all = shared.find_all(&queries);
        for (answer, known) in all.iter().zip(known.iter().cycle()) {
            let cost = answer.as_ref().expect("free ends").cost();
            // Lengths of paths are sums in floating point, distances are not.
            let is_equal = cost.zip(*known).is_some_and(|(cost, known)| (cost - known).abs() < 1e-6);
            assert!(is_equal, "query {number}: {cost:?}, not {known:?}");
        }
        let index = shared.index();
        let ends = || (0..SIDE as i32).map(|y| (0, y));
        panics(|| drop(index.within(failing(number)).table(ends(), ends())));
        panics(|| drop(space.within(failing(number)).field([(0, 0)])));
        let table = index.table([ENDS[0][0]], [ENDS[0][1]]).expect("free ends");
        assert_eq!(table.get(0, 0), known[0]);
    }
    assert!(panics(|| drop(Map::from_fn(9, 9, |x, _| x == 5 && fail()))));
}

#[test]
fn clocks_that_jump_stop_or_do_not() {
    for (engine, space) in spaces() {
        let index = space.prepare(engine).expect("an index");
        let (known, mut planner) = (costs(&index), index.planner());
        for [start, goal] in ENDS {
            let at = ENDS.iter().position(|&ends| ends == [start, goal]).expect("one of them");
            // Ahead for one look, then back before the begin.
            for late in 0..3 {
                let look = AtomicI64::new(0);
                let limits = Limits::new().deadline(move || look.fetch_add(1, Ordering::Relaxed) == late);
                let answer = planner.find(Query::new(start, goal).within(limits)).expect("free ends");
                let is_right =
                    matches!(answer, Answer::Stopped(_)) || answer.cost().is_some() == known[at].is_some();
                assert!(is_right, "{engine}: {answer}");
            }
            let longest = Limits::new().time(Duration::MAX);
            let answer = planner.find(Query::new(start, goal).within(longest)).expect("free ends");
            assert!(!matches!(answer, Answer::Stopped(_)), "{engine}: {answer}");
            let none = Limits::new().time(Duration::ZERO).cancel(Arc::default());
            planner.find(Query::new(start, goal).within(none)).expect("free ends");
            assert_eq!(planner.distance((start, goal)).expect("free ends"), known[at], "{engine}");
        }
    }
}
