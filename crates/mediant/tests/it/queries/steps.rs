//! A search in steps is the search at once, and what is abandoned leaves nothing behind.

use mediant::{
    Answer, Cost, Ends, Engine, Planner, Query, Setup, Vertex, errors::QueryError, search::Observer,
};

use super::{Event, Log, World, end, expands_in_clusters, is_exact, maps, on_worlds, start};
use crate::{planner, setup};

/// The answer of a search in steps of so many expansions, and its events.
pub(super) fn in_steps(
    planner: &mut Planner,
    query: &Query,
    size: u64,
) -> Result<(Answer, Vec<Event>), QueryError> {
    let mut log = Log::default();
    planner.begin(query.clone())?;
    loop {
        if let Some(answer) = planner.step_observed(size, &mut log)? {
            return Ok((answer, log.0));
        }
    }
}

/// The answer of a search that runs to its end, and its events.
fn at_once(planner: &mut Planner, query: impl Into<Query>) -> Result<(Answer, Vec<Event>), QueryError> {
    let mut log = Log::default();
    let answer = planner.find_observed(query, &mut log)?;
    Ok((answer, log.0))
}

fn check_steps(world: &World, setup: Setup, planner: &mut Planner, ends: Ends) {
    let text = || world.text(setup, &ends);
    let query = Query::between([ends.start], [ends.goal]);
    let plain = at_once(planner, ends);
    let watched = at_once(planner, query.clone());
    assert_eq!(
        watched.clone().map(|(answer, events)| (answer, Log(events).of_search())),
        plain,
        "{}",
        text()
    );
    for size in [1, 3, 1000] {
        assert_eq!(in_steps(planner, &query, size), watched, "steps of {size}: {}", text());
    }
    // The answer is there once more, without any event.
    if let Ok((answer, _)) = &plain {
        let (mut log, expansions) = (Log::default(), planner.expansions());
        assert_eq!(planner.step_observed(9, &mut log).as_ref(), Ok(&Some(answer.clone())), "{}", text());
        assert_eq!(planner.finish().as_ref(), Ok(answer), "{}", text());
        assert_eq!((log.0, planner.expansions()), (Vec::new(), expansions), "{}", text());
        assert_eq!(planner.best().as_ref(), answer.path().or(planner.best().as_ref()), "{}", text());
    } else {
        assert_eq!(planner.finish(), plain.clone().map(|(answer, _)| answer), "{}", text());
    }
    check_state(world, setup, planner, ends, plain.as_ref().ok().map(|(answer, _)| answer));
}

/// Checks what can be read between steps, and that reading it changes nothing.
fn check_state(world: &World, setup: Setup, planner: &mut Planner, ends: Ends, answer: Option<&Answer>) {
    let text = || world.text(setup, &ends);
    planner.begin(ends).expect("both ends are free");
    assert_eq!(planner.expansions(), 0, "{}", text());
    let (mut log, mut bound, mut expansions) = (Log::default(), planner.lower_bound(), 0);
    let optimum = world.optimum(ends.start, ends.goal).filter(|_| is_exact(planner));
    loop {
        let state = (planner.best(), planner.lower_bound(), planner.expansions());
        let best = state.0.as_ref().expect("at least the start");
        world.check_path(setup, best, (ends.start, end(best)), &ends);
        let nothing = planner.step_observed(0, &mut log);
        if log.expansions() == expansions && nothing == Ok(None) {
            let mut after = (planner.best(), planner.lower_bound(), planner.expansions());
            if expansions == 0 && after.1 > state.1 {
                // Now it is known what the first expansion is.
                after.1 = state.1;
            }
            assert_eq!(after, state, "no step, no progress: {}", text());
        } else if nothing == Ok(None) {
            assert!(expands_in_clusters(setup) && expansions == 0, "no step, no expansion: {}", text());
        }
        assert!(state.1 >= bound, "the bound falls to {} from {bound}: {}", state.1, text());
        assert!(
            optimum.is_none_or(|optimum| state.1 <= optimum * (1.0 + 1e-9)),
            "a bound of {}: {}",
            state.1,
            text()
        );
        (bound, expansions) = (state.1, log.expansions());
        match planner.step_observed(1, &mut log) {
            Ok(None) => {
                let made = log.expansions() - expansions;
                assert!(
                    made == 1 || setup.engine.kind() == Engine::Chpa && made == 0,
                    "{made} expansions: {}",
                    text()
                );
            }
            Ok(Some(last)) => {
                assert_eq!(Some(&last), answer, "{}", text());
                assert!(planner.lower_bound() >= bound, "the bound falls at the end: {}", text());
                break;
            }
            Err(_) => {
                assert!(answer.is_none(), "{}", text());
                break;
            }
        }
        assert_eq!(planner.expansions(), log.expansions(), "{}", text());
        expansions = log.expansions();
    }
}

/// Checks that a search which is left at any time changes nothing of what comes after.
fn check_abandoned(world: &World, setup: Setup, planner: &mut Planner, [first, second]: [Ends; 2]) {
    let text = || world.text(setup, &[first, second]);
    let index = planner.index().clone();
    let fresh = at_once(&mut index.planner(), second);
    let watched = at_once(&mut index.planner(), second.nearest());
    planner.begin(first).expect("both ends are free");
    _ = planner.finish();
    let all = planner.expansions();
    for expansions in [0, 1, 7, all / 2, all.saturating_sub(1)] {
        let abandon = |planner: &mut Planner| {
            planner.begin(first).expect("both ends are free");
            _ = planner.step(expansions);
            _ = planner.best();
        };
        abandon(planner);
        assert_eq!(at_once(planner, second), fresh, "after {expansions}: {}", text());
        assert_eq!(planner.step(1), Err(QueryError::NotBegun), "the search was forgotten: {}", text());
        abandon(planner);
        assert_eq!(at_once(planner, second.nearest()), watched, "after {expansions}: {}", text());
        abandon(planner);
        assert_eq!(in_steps(planner, &second.nearest(), 2), watched, "after {expansions}: {}", text());
        abandon(planner);
        let nowhere = Vertex::new(-1, -1);
        assert!(planner.begin(Query::new(nowhere, nowhere)).is_err(), "{}", text());
        assert_eq!(planner.step(1), Err(QueryError::NotBegun), "{}", text());
    }
}

#[test]
fn steps_are_the_search_at_once() {
    let asked = on_worlds(maps(1), |world, rng| {
        let mut asked = 0;
        for (setup, mut planner) in world.planners() {
            for _ in 0..2 {
                let Some(ends) = world.ends(rng) else { continue };
                check_steps(world, setup, &mut planner, ends);
                asked += 1;
            }
        }
        asked
    });
    assert!(asked.iter().sum::<u32>() > 1000, "{asked:?}");
}

#[test]
fn abandoned_searches_leave_nothing_behind() {
    on_worlds(maps(1), |world, rng| {
        for (setup, mut planner) in world.planners() {
            if let Some(queries) = world.ends(rng).zip(world.ends(rng)) {
                check_abandoned(world, setup, &mut planner, queries.into());
            }
        }
    });
}

#[test]
fn nothing_is_known_without_a_search() {
    let planners =
        || ["astar", "anya", "subgoal", "hpa", "chpa", "theta:5:open,taut"].map(|text| planner(setup(text)));
    for mut planner in planners() {
        let nothing = |planner: &mut Planner| {
            assert_eq!(planner.step(5), Err(QueryError::NotBegun));
            assert_eq!(planner.finish(), Err(QueryError::NotBegun));
            assert_eq!((planner.best(), planner.lower_bound(), planner.expansions()), (None, 0.0, 0));
        };
        nothing(&mut planner);
        assert!(
            planner.begin(Query::new((0, 0), (6, 0))).is_err()
                == planner.find(Query::new((0, 0), (6, 0))).is_err()
        );
        planner.find(Query::new((0, 0), (8, 4))).expect("both ends are free");
        nothing(&mut planner);
        planner.begin(Query::new((0, 0), (8, 4))).expect("both ends are free");
        assert_eq!(planner.best().as_ref().map(start), Some(Vertex::new(0, 0)));
    }
}

#[test]
fn a_planner_that_gave_up_says_so_again() {
    let mut planner = planner(setup("chpa:2:never,paper"));
    let ends = Ends::new((0, 0), (8, 4));
    let error = planner.find(ends).expect_err("the windows of its segments join too little");
    assert_eq!(planner.find(ends.nearest()), Err(error));
    planner.begin(ends).expect("both ends are free");
    let stepped = loop {
        match planner.step(1) {
            Ok(None) => {}
            stepped => break stepped,
        }
    };
    assert_eq!(stepped, Err(error));
    assert_eq!((planner.step(1), planner.finish()), (Err(error), Err(error)));
    assert_eq!(planner.best().map(|best| start(&best)), Some(ends.start));
}

/// An observer may pause steps, as often as it likes, but not a search that is to give its answer.
#[test]
fn an_observer_may_pause_steps() {
    struct Pauses(u64);
    impl Observer for Pauses {
        fn pauses(&mut self, _: Cost) -> bool {
            self.0 += 1;
            self.0 % 2 == 1
        }
    }
    struct Unasked;
    impl Observer for Unasked {
        fn pauses(&mut self, _: Cost) -> bool {
            panic!("one that always wants to pause would keep the answer away");
        }
    }
    on_worlds(maps(1), |world, rng| {
        let Some(ends) = world.ends(rng) else { return };
        for (setup, mut planner) in world.planners() {
            let answer = planner.find(ends);
            assert_eq!(planner.find_observed(ends.snap(), &mut Unasked), answer);
            planner.begin(ends).expect("both ends are free");
            let (mut observer, mut steps) = (Pauses(0), 0);
            let paused = loop {
                steps += 1;
                match planner.step_observed(u64::MAX, &mut observer) {
                    Ok(None) => {}
                    Ok(Some(answer)) => break Ok(answer),
                    Err(error) => break Err(error),
                }
            };
            assert_eq!(paused, answer, "{}", world.text(setup, &ends));
            assert_eq!(steps, 1 + observer.0.div_ceil(2), "{}", world.text(setup, &ends));
        }
    });
}
