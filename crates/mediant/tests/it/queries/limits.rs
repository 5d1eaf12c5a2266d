//! Limits: what stops a search, and what it says then.

use std::sync::{
    Arc, Mutex, PoisonError,
    atomic::{AtomicBool, AtomicU64, Ordering},
};

use mediant::{
    Answer, Cost, Ends, Engine, Guarantee, K, Limit, Limits, Map, Planner, Query, Setup, Stopped, Vertex,
    errors::QueryError,
    search::{NodeEvent, Observer},
};
use mediant_oracle::{Costs, Explicit};

use super::{Event, Log, World, end, expands_in_clusters, is_exact, maps, on_worlds};
use crate::{planner, setup};

/// The stopped search, if that is the answer.
fn stopped(answer: Result<Answer, QueryError>) -> Option<Stopped> {
    match answer {
        Ok(Answer::Stopped(stopped)) => Some(stopped),
        _ => None,
    }
}

/// The vertex nearest to the goal among the start and those that were reached within the limit on the cost,
/// the first of several.
fn nearest_reached(world: &World, ends: Ends, log: &Log, limit: f64) -> Vertex {
    let reached = log.0.iter().filter_map(|event| match *event {
        Event::Reached(at, g) if g.to_f64() <= limit * (1.0 + 1e-9) => Some(at),
        _ => None,
    });
    let all = [ends.start].into_iter().chain(reached);
    all.min_by_key(|&at| world.distance(at, ends.goal)).expect("the start")
}

/// A query, its answer without limits, and what is known of it.
struct Known<'a> {
    ends: Ends,
    answer: Result<Answer, QueryError>,
    /// The cost of an optimal path of the search's kind; and at any angle, or where that is not known, the
    /// straight line.
    optimum: f64,
    any_angle: f64,
    /// The costs of all paths from the start, of the search's kind and at any angle.
    costs: Costs<'a>,
    any_angle_costs: Costs<'a>,
    /// How many expansions the answer takes.
    expansions: u64,
}

fn check_stopped(
    world: &World,
    setup: Setup,
    planner: &Planner,
    known: &Known<'_>,
    stopped: &Stopped,
    (log, limit): (&Log, f64),
) {
    let &Known { ends, optimum, any_angle, .. } = known;
    let text = || format!("{stopped:?}; {}", world.text(setup, &ends));
    let mut nearest = nearest_reached(world, ends, log, limit);
    if expands_in_clusters(setup) && stopped.by == Limit::Cost && stopped.best.waypoints() == [ends.start] {
        // It has found a path that costs too much, and has forgotten the others.
        nearest = ends.start;
    }
    world.check_path(setup, &stopped.best, (ends.start, nearest), &ends);
    let bound = stopped.lower_bound;
    if is_exact(planner) {
        assert!(bound <= optimum * (1.0 + 1e-9), "the optimum is {optimum}: {}", text());
        assert!(bound >= world.least(ends.start, ends.goal) * (1.0 - 1e-9), "{}", text());
    }
    match planner.guarantee() {
        Guarantee::AtMost(_) => {
            assert!(bound <= any_angle * (1.0 + 1e-9), "the optimum is {any_angle}: {}", text());
            let is_known = planner.bound().is_some() && ends.start != ends.goal;
            assert_eq!(bound > 0.0, is_known, "{}", text());
        }
        _ => {
            assert!(bound >= ends.start.distance(ends.goal) * (1.0 - 1e-9), "{}", text());
            let optimum = if setup.paths() == K::Any { any_angle } else { optimum };
            assert!(bound <= optimum * (1.0 + 1e-9), "the optimum is {optimum}: {}", text());
        }
    }
}

/// Checks that each vertex that was reached can be reached, at that cost.
fn check_reached(world: &World, setup: Setup, known: &Known<'_>, log: &Log) {
    // Costs of reached vertices are those of paths without smoothing.
    let paths = Setup { smoothing: None, ..setup }.paths();
    let costs = if paths == K::Any { &known.any_angle_costs } else { &known.costs };
    for event in &log.0 {
        let Event::Reached(at, g) = *event else { continue };
        let least = costs.to(at);
        assert!(
            least.is_some_and(|least| g.to_f64() >= least * (1.0 - 1e-9)),
            "{at} at {g}, not {least:?}: {}",
            world.text(setup, &known.ends)
        );
    }
}

/// Returns how often a subgoal graph knows a path to the goal before its answer.
fn check_expansions(world: &World, setup: Setup, planner: &mut Planner, known: &Known<'_>) -> usize {
    let &Known { ends, expansions: n, .. } = known;
    let (mut last, mut known_paths) = (0.0, 0);
    let mut limits = [0, 1, n / 2, n.saturating_sub(1), n, n + 1];
    limits.sort_unstable();
    for most in limits {
        let text = || format!("{most} of {n} expansions: {}", world.text(setup, &ends));
        let mut log = Log::default();
        let answer = planner.find_observed(ends.within(Limits::new().expansions(most)), &mut log);
        assert_eq!(planner.expansions(), log.expansions(), "{}", text());
        check_reached(world, setup, known, &log);
        let Some(stopped) = stopped(answer.clone()) else {
            assert_eq!(answer, known.answer, "{}", text());
            assert!(most >= n || expands_in_clusters(setup), "{}", text());
            continue;
        };
        assert!(stopped.by == Limit::Expansions && most < n, "{}", text());
        assert!(log.expansions() == most || expands_in_clusters(setup), "{}", text());
        check_stopped(world, setup, planner, known, &stopped, (&log, f64::INFINITY));
        assert!(stopped.lower_bound >= last, "not {last} any more, {stopped:?}: {}", text());
        last = stopped.lower_bound;
        known_paths += usize::from(setup.engine.kind() == Engine::Subgoal && end(&stopped.best) == ends.goal);
        // The answer is the same in steps, and the state of the search is that of the answer.
        planner.begin(ends.within(Limits::new().expansions(most))).expect("both ends are free");
        while planner.step(2) == Ok(None) {}
        assert_eq!(planner.finish(), Ok(Answer::Stopped(stopped.clone())), "{}", text());
        assert_eq!(planner.best(), Some(stopped.best), "{}", text());
        assert!((planner.lower_bound() - last).abs() <= 1e-9, "{}", text());
    }
    known_paths
}

fn check_cost(world: &World, setup: Setup, planner: &mut Planner, known: &Known<'_>) {
    let &Known { ends, optimum, .. } = known;
    // Smoothed paths are those of a search that is optimal.
    let is_optimal = is_exact(planner) || matches!(planner.guarantee(), Guarantee::AtMost(_));
    let cost = match &known.answer {
        Ok(answer) if !is_optimal => answer.cost().unwrap_or(0.0),
        _ => optimum,
    };
    for limit in [cost, cost * (1.0 - 1e-6), cost * (1.0 + 1e-6), cost / 2.0, 0.0, f64::INFINITY] {
        let text = || format!("the limit is {limit}, the optimum {optimum}: {}", world.text(setup, &ends));
        let mut log = Log::default();
        let answer = planner.find_observed(ends.within(Limits::new().cost(limit)), &mut log);
        if is_optimal {
            assert_eq!(matches!(answer, Ok(Answer::Found(_))), optimum <= limit * (1.0 + 1e-9), "{}", text());
        }
        let Some(stopped) = stopped(answer.clone()) else {
            assert_eq!(answer, known.answer, "{}", text());
            let found = answer.ok().and_then(|answer| answer.cost());
            assert!(found.is_none_or(|cost| cost <= limit * (1.0 + 1e-6)), "{}", text());
            continue;
        };
        assert!(stopped.by == Limit::Cost && limit < f64::INFINITY, "{stopped:?}, {}", text());
        check_stopped(world, setup, planner, known, &stopped, (&log, limit));
        if is_optimal {
            assert!(stopped.best.cost() <= limit + 1e-9, "{stopped:?}, {}", text());
        }
        if is_exact(planner) {
            assert!(stopped.lower_bound > limit * (1.0 - 1e-6), "{stopped:?}, {}", text());
        }
    }
}

/// Sets a flag after some expansions, and says how many there were.
struct Flag {
    after: u64,
    expansions: Arc<AtomicU64>,
    flag: Arc<AtomicBool>,
    log: Log,
}

impl Flag {
    fn new(after: u64) -> Self {
        Self { after, expansions: Arc::default(), flag: Arc::default(), log: Log::default() }
    }
}

impl Observer for Flag {
    fn expanded(&mut self, node: NodeEvent) {
        self.log.expanded(node);
        if self.expansions.fetch_add(1, Ordering::Relaxed) + 1 == self.after {
            self.flag.store(true, Ordering::Relaxed);
        }
    }

    fn reached(&mut self, at: Vertex, g: Cost) {
        self.log.reached(at, g);
    }
}

fn check_cancelled(world: &World, setup: Setup, planner: &mut Planner, known: &Known<'_>) {
    let &Known { ends, expansions: n, .. } = known;
    let text = || world.text(setup, &ends);
    let set = Limits::new().cancel(Arc::new(AtomicBool::new(true)));
    let at_first = stopped(planner.find(ends.within(set))).unwrap_or_else(|| panic!("{}", text()));
    assert_eq!((at_first.by, planner.expansions()), (Limit::Cancelled, 0), "{}", text());
    assert_eq!(at_first.best.waypoints(), [ends.start], "{}", text());

    for after in [1, n / 2, n.saturating_sub(1)].into_iter().filter(|&after| after > 0 && after < n) {
        let mut observer = Flag::new(after);
        let limits = Limits::new().cancel(observer.flag.clone());
        match stopped(planner.find_observed(ends.within(limits), &mut observer)) {
            Some(stopped) => {
                assert_eq!(stopped.by, Limit::Cancelled, "{}", text());
                assert!(planner.expansions() == after || expands_in_clusters(setup), "{}", text());
                check_stopped(world, setup, planner, known, &stopped, (&observer.log, f64::INFINITY));
            }
            None => assert!(expands_in_clusters(setup), "{}", text()),
        }
    }
}

/// Returns how often the deadline was looked at after the first time.
fn check_deadline(world: &World, setup: Setup, planner: &mut Planner, known: &Known<'_>) -> usize {
    let &Known { ends, expansions: n, .. } = known;
    let text = || format!("{n} expansions: {}", world.text(setup, &ends));
    let is_known = |answer: &Result<Answer, QueryError>| answer == &known.answer;
    let looks = Arc::new(Mutex::new(Vec::new()));
    // Asks how many expansions there were at each look; the deadline is over from one of them on.
    let ask = |planner: &mut Planner, over: usize| {
        let mut observer = Flag::new(u64::MAX);
        let (seen, expansions) = (looks.clone(), observer.expansions.clone());
        let deadline = move || {
            let mut seen = seen.lock().unwrap_or_else(PoisonError::into_inner);
            seen.push(expansions.load(Ordering::Relaxed));
            seen.len() > over
        };
        let answer = planner.find_observed(ends.within(Limits::new().deadline(deadline)), &mut observer);
        let seen = std::mem::take(&mut *looks.lock().unwrap_or_else(PoisonError::into_inner));
        (answer, seen, observer.log)
    };
    let (answer, all, _) = ask(planner, usize::MAX);
    assert!(is_known(&answer), "{}", text());
    let each = mediant_search::Limits::EXPANSIONS_PER_LOOK;
    assert_eq!(all.first(), Some(&0), "{}", text());
    let last = all[all.len() - 1];
    // Searches within clusters are not interrupted.
    let is_even = all.windows(2).all(|ends| ends[1] == ends[0] + each) && n - last <= each;
    assert!(is_even || expands_in_clusters(setup), "{all:?}: {}", text());
    assert!(all.windows(2).all(|ends| ends[1] >= ends[0] + each), "{all:?}: {}", text());
    for over in 0..all.len() {
        let (answer, seen, log) = ask(planner, over);
        assert_eq!(seen, all[..=over], "{}", text());
        let stopped = stopped(answer).unwrap_or_else(|| panic!("{}", text()));
        assert_eq!((stopped.by, planner.expansions()), (Limit::Timeout, all[over]), "{}", text());
        check_stopped(world, setup, planner, known, &stopped, (&log, f64::INFINITY));
    }
    all.len() - 1
}

/// Asks every planner of random worlds; so many queries to each.
fn on_queries<R: Send>(
    queries: usize,
    check: impl Fn(&World, Setup, &mut Planner, &Known<'_>) -> R + Sync,
) -> Vec<R> {
    let all = on_worlds(maps(1), |world, rng| {
        let any_angle = Explicit::new(&world.grid, world.space.motion().rules, None);
        let mut checked = Vec::new();
        for (setup, mut planner) in world.planners() {
            for _ in 0..queries {
                let Some(ends) = world.ends(rng) else { continue };
                let costs = world.oracle.costs_from(ends.start);
                let Some(optimum) = costs.to(ends.goal) else { continue };
                planner.begin(ends).expect("both ends are free");
                let answer = planner.finish();
                let expansions = planner.expansions();
                let any_angle_costs = any_angle.costs_from(ends.start);
                let any_angle = any_angle_costs.to(ends.goal).expect("there is a way");
                let known = Known { ends, answer, optimum, any_angle, costs, any_angle_costs, expansions };
                checked.push(check(world, setup, &mut planner, &known));
            }
        }
        checked
    });
    all.into_iter().flatten().collect()
}

#[test]
fn so_many_expansions_are_made_and_no_more() {
    let known_paths = on_queries(2, check_expansions);
    assert!(known_paths.len() > 1000);
    assert!(known_paths.iter().sum::<usize>() > 10, "the best path so far is seldom one to the goal");
}

#[test]
fn no_path_costs_more_than_the_limit() {
    assert!(on_queries(2, check_cost).len() > 1000);
}

#[test]
fn a_flag_cancels_a_search() {
    assert!(on_queries(2, check_cancelled).len() > 1000);
}

#[test]
fn a_deadline_is_looked_at_now_and_then() {
    let looks: usize = on_queries(1, check_deadline).into_iter().sum();
    assert!(looks > 20, "{looks} looks after the first");
}

#[test]
fn a_limit_is_a_number() {
    for text in ["astar", "anya", "subgoal", "hpa", "chpa"] {
        let mut planner = planner(setup(text));
        let ends = Ends::new((0, 0), (8, 4));
        for cost in [f64::NAN, -f64::NAN, -1.0, -f64::MIN_POSITIVE, f64::NEG_INFINITY] {
            let query = ends.within(Limits::new().cost(cost));
            assert_eq!(planner.find(query.clone()), Err(QueryError::CostLimit), "{text}, {cost}");
            assert_eq!(planner.begin(query), Err(QueryError::CostLimit), "{text}, {cost}");
        }
        let found = planner.find(ends);
        for cost in [1e300, f64::INFINITY, f64::MAX] {
            assert_eq!(planner.find(ends.within(Limits::new().cost(cost))), found, "{text}, {cost}");
        }
        let still = Ends::new((0, 0), (0, 0));
        for cost in [0.0, -0.0] {
            let answer = planner.find(still.within(Limits::new().cost(cost)));
            assert_eq!(answer.map(|answer| answer.cost()), Ok(Some(0.0)), "{text}, {cost}");
        }
    }
}

#[test]
fn what_came_near_a_goal_too_dear_stays_the_best_while_another_is_searched() {
    // The goal behind the wall is two cells from where the search turns back; the other one is far.
    let rows = ["...#.", "...#.", "...#.", "...#.", ".....", "...#.", "...#.", "...#.", "...#."];
    let map = Map::from_rows(rows).expect("a map");
    let goals = [Vertex::new(4, 0), Vertex::new(0, 8)];
    let mut planner = setup("astar:2:never").planner(&map).expect("a planner");
    planner.begin(Query::between([(0, 0)], goals).within(Limits::new().cost(10.0))).expect("free ends");
    let (mut distances, mut answer) = (Vec::new(), None);
    while answer.is_none() {
        answer = planner.step(1).expect("free ends");
        let at = end(&planner.best().expect("a search was begun"));
        distances.push(goals.iter().map(|goal| at.x.abs_diff(goal.x) + at.y.abs_diff(goal.y)).min());
    }
    assert!(distances.is_sorted_by(|before, after| before >= after), "{distances:?}");
    let beside = distances.iter().filter(|&&distance| distance == Some(2)).count();
    assert!(beside > 9, "while the first goal is searched, and while the second is: {distances:?}");
    assert_eq!(answer.as_ref().and_then(Answer::cost), Some(8.0), "the goal that is not too dear");
}
