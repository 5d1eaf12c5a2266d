//! Where the system gives no threads, one does it all, with the same results.

use std::{env, process::Command};

use mediant::{
    Ends, Engine, K, Map, Motion, Planners,
    grid::{Fit, Outside},
};

/// Set in the process that has no room for the stacks of its threads.
const ALONE: &str = "MEDIANT_TEST_ALONE";
const SIDE: u32 = 60;

/// A text of all that threads would share: labels, levels, a batch, a table, clearances.
fn results() -> String {
    let map = Map::from_fn(SIDE, SIDE, |x, y| x % 7 == 3 && y % 5 != 2).expect("a map");
    let space = map.space(Motion::corners(K::ANY)).expect("a space");
    let index = space.prepare(Engine::Subgoal).expect("an index");
    let bytes = index.to_bytes().expect("bytes");
    let sum = bytes.iter().fold(0_u64, |sum, &byte| sum.wrapping_mul(31).wrapping_add(byte.into()));
    let ends: Vec<_> = (0..600).map(|n| Ends::new((0, n % 60), (59, n * 7 % 60))).collect();
    let answers = Planners::new(index.clone()).find_all(&ends);
    let length: f64 =
        answers.iter().map(|answer| answer.as_ref().expect("free ends").cost().unwrap_or(-1.0)).sum();
    let row = |x| (0..60).map(move |y| (x, y));
    let table = index.table(row(0), row(59)).expect("free ends");
    let clearance = map.clearance(Fit::Centers, Outside::Open);
    let widest = (0..60).map(|y| clearance.distance((30, y).into())).fold(0.0, f64::max);
    format!("{sum} {length} {} {widest}", table.values().iter().sum::<f64>())
}

#[test]
fn one_thread_does_what_the_system_gives_no_threads_for() {
    let results = results();
    if env::var_os(ALONE).is_some() {
        println!("results: {results}.");
        return;
    }
    let program = env::current_exe().expect("the name of this program");
    let name = "no_threads::one_thread_does_what_the_system_gives_no_threads_for";
    // 16 GB of stacks do not fit in 2.
    let child = Command::new("sh")
        .args(["-c", "ulimit -v 2000000 && exec \"$0\" --exact \"$1\" --nocapture --test-threads 1"])
        .arg(program)
        .arg(name)
        .env(ALONE, "1")
        .env("RAYON_NUM_THREADS", "8192")
        .output()
        .expect("a shell");
    let printed = String::from_utf8_lossy(&child.stdout);
    assert!(printed.contains(&format!("results: {results}.")), "{results}\n{child:?}");
}
