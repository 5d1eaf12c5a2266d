//! Paths at any angle on costs, by both kinds of Theta\* and smoothed: against the least costs over N(k).

use mediant::{
    Answer, Engine, Guarantee, Index, Limits, Planner, Query, Setup, Smoothing, Vertex,
    options::{ConfiguredEngine, GuidedOptions, HeuristicName},
};
use mediant_oracle::{Rng, seeds};

use super::{World, ends, space};

/// Planners whose paths turn at any angle.
fn planners(world: &World) -> Vec<Planner> {
    let zero = GuidedOptions { heuristic: Some(HeuristicName::Zero) };
    let engines: [ConfiguredEngine; 6] = [
        Engine::Theta.into(),
        Engine::LazyTheta.into(),
        ConfiguredEngine::Theta(zero),
        Engine::AStar.into(),
        Engine::Landmarks.into(),
        Engine::LazyTheta.into(),
    ];
    let index = |(number, engine)| {
        let index = world.space.prepare(engine).unwrap_or_else(|error| panic!("{error}"));
        index.with_smoothing((number > 2).then_some(Smoothing::Linear))
    };
    engines.into_iter().enumerate().map(index).map(|index: Index| index.planner()).collect()
}

/// Checks an answer: its path is legal, states its cost and its length, and costs no more than this.
fn check(world: &World, planner: &mut Planner, query: &Query, least: Option<u64>) -> Option<f64> {
    let about = format!("{query}, {}: {}", planner.index().setup(), world.about);
    let answer = planner.find(query).unwrap_or_else(|error| panic!("{error}: {about}"));
    let Some(least) = least else {
        assert_eq!(answer, Answer::Unreachable, "{about}");
        return None;
    };
    let path = answer.path().unwrap_or_else(|| panic!("{answer}: {about}"));
    assert_eq!(world.space.check(path), Ok(()), "{path}: {about}");
    assert_eq!(world.space.cost(path), Some(path.cost()), "{path}: {about}");
    let length: f64 = path.waypoints().windows(2).map(|ends| ends[0].distance(ends[1])).sum();
    assert!((path.length() - length).abs() < 1e-9 * (1.0 + length), "{path}: {about}");
    assert!(path.cost() <= world.to_f64(least), "{path}, not {}: {about}", world.to_f64(least));
    let guarantee = planner.guarantee();
    assert_eq!(guarantee, Guarantee::AtMostCheapest(world.k));
    assert_eq!((planner.bound(), answer.lower_bound(guarantee)), (None, 0.0));
    assert_eq!(answer.any_angle_lower_bound(guarantee, world.rules), None);
    // In steps it is the same, and the bounds hold.
    planner.begin(query).expect("it was answered");
    let stepped = loop {
        if let Some(answer) = planner.step(1).expect("it never gives up") {
            break answer;
        }
        assert!(planner.lower_bound() <= path.cost() * (1.0 + 1e-9), "{about}");
        let best = planner.best().expect("a search was begun");
        assert_eq!(world.space.cost(&best), Some(best.cost()), "{best}: {about}");
    };
    assert_eq!(stepped, answer, "{about}");
    let few = planner.find(query.clone().within(Limits::new().expansions(2))).expect("it was answered");
    if let Answer::Stopped(stopped) = few {
        assert!(stopped.lower_bound <= path.cost() * (1.0 + 1e-9), "{stopped:?}: {about}");
        assert_eq!(world.space.cost(&stopped.best), Some(stopped.best.cost()), "{about}");
    }
    Some(path.cost())
}

#[test]
fn no_path_over_the_moves_is_cheaper() {
    let (mut compared, mut cheaper) = (0, 0);
    for seed in seeds(100) {
        let world = World::new(seed);
        let mut rng = Rng::new(seed);
        let mut planners = planners(&world);
        let (starts, goals) = (world.free(&mut rng, 2), world.free(&mut rng, 2));
        let (Some(&start), Some(&goal)) = (starts.first(), goals.first()) else { continue };
        let best = world.best(&[start], &[goal]).map(|(cost, ..)| cost);
        let several = world.best(&starts, &goals).map(|(cost, ..)| cost);
        let shut = world.any(&mut rng);
        for planner in &mut planners {
            let found = check(&world, planner, &Query::new(start, goal), best);
            if let (Some(found), Some(best)) = (found, best) {
                compared += 1;
                cheaper += usize::from(found < world.to_f64(best) * (1.0 - 1e-9));
                assert_eq!(planner.distance((start, goal)), Ok(Some(found)), "{}", world.about);
                let mirrored = planner.path(goal, start).expect("both are free").expect("there is a way");
                assert_eq!(ends(&mirrored), (goal, start), "{}", world.about);
            }
            check(&world, planner, &Query::between(starts.clone(), goals.clone()), several);
            // Ends in and around walls.
            let nearest = planner.find(Query::new(start, shut).nearest()).expect("the start is free");
            let path = nearest.path().expect("the start itself can be reached");
            let end: Vertex = ends(path).1;
            assert!(world.space.connected(start, end) || start == end, "{path}: {}", world.about);
            assert_eq!(world.space.cost(path), Some(path.cost()), "{path}: {}", world.about);
        }
    }
    assert!(compared > 200 && cheaper > 50, "{cheaper} cheaper of {compared}");
}

/// A path by smoothing, on a setup as text, and what is refused.
#[test]
fn setups_smooth_on_costs() {
    let space = space();
    let query = [(0, 0), (3, 2)];
    let smooth: Setup = "astar,smooth".parse().expect("a setup");
    let mut planner = smooth.prepare(&space).and_then(|index| index.try_planner()).expect("it smooths");
    let smoothed = planner.path(query[0], query[1]).expect("free").expect("there is a way");
    let plain = space.path(query[0], query[1]).expect("free").expect("there is a way");
    assert!(smoothed.cost() <= plain.cost() && smoothed.len() <= plain.len(), "{smoothed}, {plain}");
    let taut: Setup = "astar,taut".parse().expect("a setup");
    let error = taut.prepare(&space).and_then(|index| index.try_planner()).expect_err("it has no costs");
    assert!(error.to_string().contains("no taut smoothing: smooth linearly"), "{error}");
}
