//! Every wish of a query, against brute force.

use mediant::{Answer, Guarantee, Limit, Limits, Planner, Query, Vertex};
use mediant_oracle::{Rng, seeds};

use super::{World, ends};

/// The answer in steps of one expansion; the bound and the best so far are looked at after each.
fn in_steps(world: &World, planner: &mut Planner, query: &Query, optimum: Option<u64>) -> Answer {
    let about = &world.about;
    planner.begin(query).unwrap_or_else(|error| panic!("{error}: {about}"));
    let mut last = 0.0;
    loop {
        if let Some(answer) = planner.step(1).expect("A* never gives up") {
            return answer;
        }
        let bound = planner.lower_bound();
        assert!(bound >= last * (1.0 - 1e-9), "a bound of {bound} after {last}: {about}");
        if let Some(optimum) = optimum {
            assert!(bound <= world.to_f64(optimum) * (1.0 + 1e-9), "{query}: {bound}: {about}");
        }
        last = bound;
        let best = planner.best().expect("a search was begun");
        assert_eq!(world.space.cost(&best), Some(best.cost()), "{best}: {about}");
    }
}

/// Checks a query against the best pair of ends.
fn check(
    world: &World,
    planner: &mut Planner,
    query: &Query,
    best: Option<(u64, Vertex, Vertex)>,
    (is_nearest, is_any): (bool, bool),
) {
    let about = format!("{query}, {:?}: {}", planner.index().setup().engine.kind(), world.about);
    let answer = planner.find(query).unwrap_or_else(|error| panic!("{error}: {about}"));
    let stepped = in_steps(world, planner, query, best.map(|(cost, ..)| cost));
    assert_eq!(stepped, answer, "{about}");
    let Some((cost, start, goal)) = best else {
        assert_eq!(answer, Answer::Unreachable, "{about}");
        return;
    };
    let path = match &answer {
        Answer::Found(path) if !is_nearest => path,
        Answer::Nearest(path) if is_nearest => path,
        _ => panic!("{answer:?}: {about}"),
    };
    world.check_path(path, cost);
    if !is_any {
        assert_eq!(ends(path), (start, goal), "{about}");
    }
    let guarantee = planner.guarantee();
    assert_eq!(guarantee, Guarantee::Cheapest(world.k));
    assert_eq!(answer.distance(guarantee), path.cost());
    assert_eq!(answer.any_angle_lower_bound(guarantee, world.rules), None);
    assert_eq!(planner.bound(), None);
    if !is_nearest {
        assert_eq!(answer.lower_bound(guarantee), path.cost());
    }
    // Limits.
    let cost = world.to_f64(cost);
    for (limit, is_found) in [(cost * 0.999, cost == 0.0), (cost, true), (cost * 1.001, true)] {
        let limited = planner.find(query.clone().within(Limits::new().cost(limit))).expect("it was answered");
        if is_found {
            // A tolerance may lead to another end that is as near.
            assert_eq!(limited.cost(), answer.cost(), "{limited:?} within {limit}: {about}");
            continue;
        }
        let Answer::Stopped(stopped) = limited else { panic!("{limited:?} within {limit}: {about}") };
        assert_eq!(stopped.by, Limit::Cost, "{about}");
        let bound = stopped.lower_bound;
        assert!(bound > limit && bound <= cost * (1.0 + 1e-9), "{stopped:?} within {limit}: {about}");
        assert!(stopped.best.cost() <= limit * (1.0 + 1e-9), "{stopped:?}: {about}");
        assert_eq!(world.space.cost(&stopped.best), Some(stopped.best.cost()), "{about}");
    }
    if let Answer::Stopped(stopped) =
        planner.find(query.clone().within(Limits::new().expansions(3))).expect("it was answered")
    {
        assert!(stopped.by == Limit::Expansions && stopped.lower_bound <= cost * (1.0 + 1e-9), "{about}");
    }
}

#[test]
fn every_wish_is_that_of_brute_force() {
    let mut found = 0;
    for seed in seeds(140) {
        let world = World::new(seed);
        let mut rng = Rng::new(seed);
        let mut planners = world.planners();
        let (starts, goals) = (world.free(&mut rng, 3), world.free(&mut rng, 3));
        let (Some(&start), Some(&goal)) = (starts.first(), goals.first()) else { continue };
        let best = world.best(&[start], &[goal]);
        let several = world.best(&starts, &goals);
        let tolerance = f64::from(1 + rng.below(4));
        let near: Vec<Vertex> = world
            .vertices()
            .into_iter()
            .filter(|&at| at.distance(goal) <= tolerance && world.space.is_free(at))
            .collect();
        let near_best = world.best(&[start], &near);
        let shut = world.any(&mut rng);
        let from = world.costs_from(start);
        let reached = world.vertices().into_iter().zip(&from).filter(|(_, cost)| cost.is_some());
        let least = reached.clone().map(|(at, _)| world.distance(at, shut)).min();
        let nearest: Vec<Vertex> =
            reached.filter(|&(at, _)| Some(world.distance(at, shut)) == least).map(|(at, _)| at).collect();
        let nearest_best = world.best(&[start], &nearest);
        let snapped = |at: Vertex| {
            let free = world.vertices().into_iter().filter(|&at| world.space.is_free(at));
            free.min_by_key(|&free| world.distance(free, at)).expect("some vertex is free")
        };
        let snapped_best = world.best(&[snapped(shut)], &[goal]);
        for planner in &mut planners {
            check(&world, planner, &Query::new(start, goal), best, (false, false));
            let query = Query::between(starts.clone(), goals.clone());
            check(&world, planner, &query, several, (false, false));
            check(&world, planner, &Query::new(start, goal).tolerance(tolerance), near_best, (false, true));
            let is_reached = world.oracle.index(shut).is_some_and(|at| from[at].is_some());
            check(&world, planner, &Query::new(start, shut).nearest(), nearest_best, (!is_reached, false));
            check(&world, planner, &Query::new(shut, goal).snap(), snapped_best, (false, false));
        }
        let [planner, dijkstra, _] = &mut planners;
        let distance = best.map(|(cost, ..)| world.to_f64(cost));
        assert_eq!(planner.distance((start, goal)), Ok(distance), "{}", world.about);
        let (guided, blind) = (planner.find_counted((start, goal)), dijkstra.find_counted((start, goal)));
        let [(_, guided), (_, blind)] = [guided, blind].map(|found| found.expect("both are free"));
        assert!(guided.expanded <= blind.expanded, "{}", world.about);
        assert_eq!(best.is_none(), !world.space.connected(start, goal), "{}", world.about);
        if best.is_none() {
            assert_eq!(blind.expanded, 0, "the components know: {}", world.about);
        }
        let table = planner.index().table(starts.clone(), goals.clone()).expect("all are free");
        for (row, &start) in starts.iter().enumerate() {
            for (column, &goal) in goals.iter().enumerate() {
                let cost =
                    world.best(&[start], &[goal]).map_or(f64::INFINITY, |(cost, ..)| world.to_f64(cost));
                assert_eq!(table.get(row, column), Some(cost), "{start} → {goal}: {}", world.about);
            }
        }
        let prepared = planner.index().goals(goals.clone()).expect("all are free");
        let nearest = planner.nearest(start, &prepared).expect("it is free");
        let expected = world.best(&[start], &goals).map(|(cost, _, goal)| {
            (goals.iter().position(|&at| at == goal).expect("one of them"), world.to_f64(cost))
        });
        assert_eq!(nearest, expected, "{}", world.about);
        found += usize::from(best.is_some());
    }
    assert!(found > 80, "only {found}");
}
