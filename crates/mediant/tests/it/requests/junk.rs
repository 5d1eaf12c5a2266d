//! Whatever is asked, the answer is a value or an error, and what it says of itself is true.

use std::sync::{Arc, atomic::AtomicBool};

use mediant::{Limit, Limits, Outcome, Path, Planner, Request, Setup, Vertex};
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

fn request(world: &World, rng: &mut Rng) -> (Request, f64) {
    let some = |rng: &mut Rng| -> Vec<Vertex> {
        let count = if rng.chance(60) { 1 } else { rng.below(4) };
        (0..count).map(|_| vertex(world, rng)).collect()
    };
    let (starts, goals) = (some(rng), some(rng));
    let mut request = Request::between(starts, goals);
    let (mut limits, mut limit) = (Limits::new(), f64::INFINITY);
    if rng.chance(70) {
        request = request.snap();
    }
    if rng.chance(60) {
        request = request.nearest();
    }
    if rng.chance(40) {
        request = request.tolerance(number(rng));
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
    (request.within(limits), limit)
}

/// Checks an answer by itself.
fn check(world: &World, setup: Setup, request: &Request, limit: f64, answer: &Outcome) {
    let legal = |path: &Path| world.check_path(setup, path, (start(path), end(path)), request);
    match answer {
        Outcome::Found(path) | Outcome::Nearest(path) => {
            legal(path);
            assert!(path.cost() <= limit * (1.0 + 1e-6), "{path}: {}", world.text(setup, request));
        }
        Outcome::Stopped(stopped) => {
            legal(&stopped.best);
            let is_bound = stopped.lower_bound >= 0.0 && stopped.lower_bound.is_finite();
            assert!(is_bound, "{stopped:?}: {}", world.text(setup, request));
            let by_cost = stopped.by == Limit::Cost;
            assert!(!by_cost || limit < f64::INFINITY, "{stopped:?}: {}", world.text(setup, request));
        }
        _ => {}
    }
}

/// The answer in steps of random sizes, with a look at the state between them.
fn in_steps(planner: &mut Planner, request: &Request, rng: &mut Rng) -> Option<Outcome> {
    planner.begin(request.clone()).ok()?;
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
                let (request, limit) = request(world, rng);
                let answer = planner.find(request.clone());
                let text = || world.text(setup, &request);
                assert_eq!(
                    in_steps(&mut planner, &request, rng).as_ref(),
                    answer.as_ref().ok(),
                    "{}",
                    text()
                );
                assert_eq!(planner.find(request.clone()), answer, "{}", text());
                let Ok(answer) = answer else { continue };
                check(world, setup, &request, limit, &answer);
                answers[match answer {
                    Outcome::Found(_) => 0,
                    Outcome::Nearest(_) => 1,
                    Outcome::Stopped(_) => 2,
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
