//! One cell opens or closes: the edit, the space, the repaired index and the planner that follows.
//! `cargo bench -p mediant-bench --bench edits` writes the table of `docs/measurements/changing.md`.
//!
//! The edits follow one another, each of a random cell, and old versions are given up. After every eighth a
//! path is searched, so that planners are warm; that does not count. The first edit of a chain stands alone:
//! it copies the arrays that the others take turns in.
#![allow(clippy::print_stdout, reason = "a program talks to its user")]
#![allow(clippy::unwrap_used, reason = "a measurement may fail")]

use std::time::Instant;

use mediant::{Engine, K, Map, Motion, Space};
use mediant_bench::compare::changes::rooms;
use mediant_oracle::{Rng, noise};

fn free_cell(rng: &mut Rng, space: &Space) -> (i32, i32) {
    let side = space.map().width();
    loop {
        let at = (rng.below(side) as i32, rng.below(side) as i32);
        if space.is_free(at) {
            return at;
        }
    }
}

/// Prints a row of the table: microseconds.
fn measure(name: &str, map: &Map, (engine, k): (Engine, u32), edits: usize) {
    let motion = if engine == Engine::Anya { Motion::corners(K::ANY) } else { Motion::centers(k) };
    let said = if k == 3 { format!("`{engine}`") } else { format!("`{engine}`, k = {k}") };
    let (mut space, mut rng, side) = (map.space(motion).unwrap(), Rng::new(99), map.width());
    let start = Instant::now();
    let mut index = space.prepare(engine).unwrap();
    let anew = start.elapsed().as_secs_f64() * 1e6;
    let (mut planner, mut times) = (index.planner(), Vec::with_capacity(edits));
    for edit in 0..edits {
        if edit % 8 == 0 {
            let ends = [free_cell(&mut rng, &space), free_cell(&mut rng, &space)];
            planner.path(ends[0], ends[1]).unwrap();
        }
        let at = (rng.below(side) as i32, rng.below(side) as i32);
        let is_blocked = space.map().is_free(at);
        let start = Instant::now();
        let change = space.edit_cells([(at, is_blocked)]).unwrap();
        index = index.repair(&change).unwrap();
        planner.follow(&index).unwrap();
        space = change.after().clone();
        drop(change);
        times.push(start.elapsed().as_secs_f64() * 1e6);
    }
    let first = times.remove(0);
    times.sort_by(f64::total_cmp);
    let mean = times.iter().sum::<f64>() / times.len() as f64;
    let [median, most, worst] =
        [times.len() / 2, times.len() * 99 / 100, times.len() - 1].map(|at| times[at]);
    println!(
        "| {side}², {name} | {said} | {mean:.1} | {median:.1} | {most:.0} | {worst:.0} | {first:.0} | {anew:.0} |"
    );
}

fn main() {
    use Engine as E;
    println!(
        "| map | engine | mean | median | 99 % | worst | first edit | the index anew |\n|---|---|{}",
        "--:|".repeat(6)
    );
    for (side, edits) in [(512, 10_000), (2_048, 2_000), (4_096, 500)] {
        for name in ["noise", "rooms"] {
            let rng = &mut Rng::new(7);
            let map = if name == "noise" { noise(rng, side, side, 20) } else { rooms(rng, side).unwrap() };
            let map = Map::from(map);
            for engine in [E::AStar, E::Canonical, E::JpsBlock, E::JpsPlus, E::Anya, E::Hpa, E::Chpa] {
                measure(name, &map, (engine, 3), edits);
            }
            for (engine, k) in [(E::Canonical, 4), (E::Jps, 4), (E::Canonical, 5), (E::Jps, 5)] {
                measure(name, &map, (engine, k), edits);
            }
        }
    }
}
