//! Whatever is asked, the answer is a value or an error, and what it says of itself is true.

use std::sync::{Arc, atomic::AtomicBool};

use mediant::{Answer, Limit, Limits, Path, Planner, Query, Setup, Vertex};
use mediant_oracle::Rng;

use super::{World, end, maps, on_worlds, start};

/// A vertex near the map, or as far from it as can be.
fn vertex(world: &World, rng: &mut Rng) -> Vertex {
    let extremes = [i32::MIN, i32::MIN + 1, -1, i32::MAX - 1, i32::MAX];
    let (width, height) = world.size();
    let axis = |rng: &mut Rng, length: i32| {
        let inside = rng.below(length as u32) as i32;
        if rng.chance(8) { rng.pick(&extremes).copied().unwrap_or(inside) } else { inside }
    };
    Vertex::new(axis(rng, width), axis(rng, height))
}

fn number(rng: &mut Rng) -> f64 {
    let odd = [0.0, -0.0, f64::MIN_POSITIVE, 1e300, f64::INFINITY, f64::NAN, -1.0];
    if rng.chance(20) { rng.pick(&odd).copied().unwrap_or(0.0) } else { f64::from(rng.below(60)) / 2.0 }
}

fn query(world: &World, rng: &mut Rng) -> (Query, f64) {
    let some = |rng: &mut Rng| -> Vec<Vertex> {
        let count = if rng.chance(60) { 1 } else { rng.below(4) };
        (0..count).map(|_| vertex(world, rng)).collect()
    };
    let (starts, goals) = (some(rng), some(rng));
    let mut query = Query::between(starts, goals);
    let (mut limits, mut limit) = (Limits::new(), f64::INFINITY);
    if rng.chance(70) {
        query = query.snap();
    }
    if rng.chance(60) {
        query = query.nearest();
    }
    if rng.chance(40) {
        query = query.tolerance(number(rng));
    }
    if rng.chance(40) {
        limit = number(rng);
        limits = limits.cost(limit);
    }
    if rng.chance(30) {
        limits = limits.expansions(u64::from(rng.below(30)));
    }
    if rng.chance(10) {
        limits = limits.cancel(Arc::new(AtomicBool::new(rng.chance(50))));
    }
    if rng.chance(10) {
        let is_over = rng.chance(50);
        limits = limits.deadline(move || is_over);
    }
    (query.within(limits), limit)
}

/// Checks an answer by itself.
fn check(world: &World, setup: Setup, query: &Query, limit: f64, answer: &Answer) {
    let legal = |path: &Path| world.check_path(setup, path, (start(path), end(path)), query);
    match answer {
        Answer::Found(path) | Answer::Nearest(path) => {
            legal(path);
            assert!(path.cost() <= limit * (1.0 + 1e-6), "{path}: {}", world.text(setup, query));
        }
        Answer::Stopped(stopped) => {
            legal(&stopped.best);
            let is_bound = stopped.lower_bound >= 0.0 && stopped.lower_bound.is_finite();
            assert!(is_bound, "{stopped:?}: {}", world.text(setup, query));
            let by_cost = stopped.by == Limit::Cost;
            assert!(!by_cost || limit < f64::INFINITY, "{stopped:?}: {}", world.text(setup, query));
        }
        _ => {}
    }
}

/// The answer in steps of random sizes, with a look at the state between them.
fn in_steps(planner: &mut Planner, query: &Query, rng: &mut Rng) -> Option<Answer> {
    planner.begin(query.clone()).ok()?;
    loop {
        let expansions = planner.expansions();
        if let Some(answer) = planner.step(u64::from(rng.below(7))).ok()? {
            return Some(answer);
        }
        assert!(planner.best().is_some() && planner.lower_bound() >= 0.0);
        assert!(planner.expansions() >= expansions);
    }
}

#[test]
fn nothing_that_is_asked_is_too_odd() {
    let answers = on_worlds(maps(1), |world, rng| {
        let mut answers = [0_u32; 4];
        for (setup, mut planner) in world.planners() {
            for _ in 0..8 {
                let (query, limit) = query(world, rng);
                let answer = planner.find(query.clone());
                let text = || world.text(setup, &query);
                assert_eq!(in_steps(&mut planner, &query, rng).as_ref(), answer.as_ref().ok(), "{}", text());
                assert_eq!(planner.find(query.clone()), answer, "{}", text());
                let Ok(answer) = answer else { continue };
                check(world, setup, &query, limit, &answer);
                answers[match answer {
                    Answer::Found(_) => 0,
                    Answer::Nearest(_) => 1,
                    Answer::Stopped(_) => 2,
                    _ => 3,
                }] += 1;
            }
        }
        answers
    });
    for kind in 0..4 {
        assert!(answers.iter().map(|answers| answers[kind]).sum::<u32>() > 60, "{kind}: {answers:?}");
    }
}
