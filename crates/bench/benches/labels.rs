//! Labels of the map before an edit: how many queries they answer, and how fast.
//! `cargo bench -p mediant-bench --bench labels` writes the tables of `docs/measurements/subgoal.md`, for the
//! maps of games in `benchdata/cache`; others are passed over, and named.
//!
//! Each edit is one of the map as it was prepared, so that labels are one edit old; then 200 cells follow one
//! another, and nothing is finished. Cells open or close, wherever they are.
#![allow(clippy::print_stdout, reason = "a program talks to its user")]
#![allow(clippy::unwrap_used, reason = "a measurement may fail")]

use std::time::Instant;

use mediant::{Change, Ends, Engine, Index, K, Map, Motion, Planner, Rectangle, Space};
use mediant_formats::{MapFile, Scenario};
use mediant_oracle::Rng;
use mediant_sets::Archive;

const MAPS: [(&str, &str); 11] = [
    ("bg512", "AR0011SR"),
    ("bg512", "AR0205SR"),
    ("bg512", "AR0700SR"),
    ("sc1", "ArcticStation"),
    ("sc1", "Cauldron"),
    ("sc1", "TheFrozenSea"),
    ("dao", "arena2"),
    ("dao", "brc202d"),
    ("dao", "hrt201n"),
    ("dao", "lak303d"),
    ("dao", "orz900d"),
];
const EDITS: usize = 40;
/// After so many cells the share is told.
const CURVE: [usize; 5] = [1, 10, 50, 100, 200];

fn micros(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e6
}

/// Sums of times in microseconds, and their number.
#[derive(Clone, Copy, Default)]
struct Mean(f64, usize);

impl Mean {
    fn add(&mut self, micros: f64) {
        *self = Self(self.0 + micros, self.1 + 1);
    }

    fn of(self) -> f64 {
        self.0 / self.1.max(1) as f64
    }
}

/// The times of those queries which the labels of the map before answer, or do not: by one planner, then by
/// another, so that both have them in their caches.
fn times(planners: [&mut Planner; 2], queries: &[Ends], answered: (&[bool], bool), sums: [&mut Mean; 2]) {
    let (by_labels, wanted) = answered;
    for (planner, sum) in planners.into_iter().zip(sums) {
        for (&query, _) in queries.iter().zip(by_labels).filter(|(_, by_labels)| **by_labels == wanted) {
            let start = Instant::now();
            let found = planner.find(query);
            let time = micros(start);
            std::hint::black_box(found.is_ok());
            sum.add(time);
        }
    }
}

/// Which queries the labels of the map before answer, or that it has no path.
fn answered(planner: &mut Planner, queries: &[Ends]) -> Vec<bool> {
    let mut is_by_labels = |&query| match planner.find(query) {
        Ok(answer) if answer.path().is_some() => planner.searched_by() == Engine::Subgoal,
        _ => true,
    };
    queries.iter().map(&mut is_by_labels).collect()
}

fn share(by_labels: &[bool]) -> f64 {
    by_labels.iter().filter(|&&by_labels| by_labels).count() as f64 / by_labels.len() as f64
}

/// Cells that open or close.
fn flip(space: &Space, at: Rectangle) -> Change {
    space.edit(at, |x, y| space.map().is_free((x as i32, y as i32))).unwrap()
}

fn one_edit(name: &str, index: &Index, other: Engine, queries: &[Ends], side: u32) {
    let (space, mut rng) = (index.space(), Rng::new(5));
    let (mut new, mut earlier) = (index.planner(), index.planner());
    let mut searching = space.planner(other).unwrap();
    let search = searching.index().clone();
    let (mut shares, mut repair) = (Vec::new(), Mean::default());
    let [mut by_new, mut by_earlier, mut by_search, mut by_both] = [Mean::default(); 4];
    let size = [space.map().width(), space.map().height()];
    for edit in 0..=EDITS {
        let [x, y] = size.map(|length| rng.below(length - side + 1));
        let change = flip(space, Rectangle::new(x, y, side, side));
        let start = Instant::now();
        let repaired = index.repair(&change).unwrap();
        // The first one prepares the other engine, too.
        if edit == 0 {
            continue;
        }
        repair.add(micros(start));
        earlier.follow(&repaired).unwrap();
        searching.follow(&search.repair(&change).unwrap()).unwrap();
        let by_labels = answered(&mut earlier, queries);
        shares.push(share(&by_labels));
        times([&mut new, &mut earlier], queries, (&by_labels, true), [&mut by_new, &mut by_earlier]);
        times([&mut searching, &mut earlier], queries, (&by_labels, false), [&mut by_search, &mut by_both]);
    }
    let mean = shares.iter().sum::<f64>() / shares.len() as f64;
    let least = shares.iter().copied().fold(1.0, f64::min);
    println!(
        "| {name} | {side} × {side} | {:.1} % | {:.1} % | {:.2} | {:.2} | {:.0} | {:.0} | {:.0} |",
        mean * 100.0,
        least * 100.0,
        by_earlier.of(),
        by_new.of(),
        by_both.of(),
        by_search.of(),
        repair.of(),
    );
}

fn curve(name: &str, index: &Index, queries: &[Ends], prepared: f64) {
    let (mut space, mut index, mut rng) = (index.space().clone(), index.clone(), Rng::new(38));
    let (mut planner, mut repair, mut told) = (index.planner(), Mean::default(), String::new());
    for edit in 1..=CURVE[CURVE.len() - 1] {
        let (x, y) = (rng.below(space.map().width()), rng.below(space.map().height()));
        let change = flip(&space, Rectangle::new(x, y, 1, 1));
        let start = Instant::now();
        index = index.repair(&change).unwrap();
        repair.add(micros(start));
        space = change.after().clone();
        if CURVE.contains(&edit) {
            planner.follow(&index).unwrap();
            told += &format!(" {:.0} % |", share(&answered(&mut planner, queries)) * 100.0);
        }
    }
    println!(
        "| {name} |{told} {:.0} | {:.0} | {:.2} % |",
        repair.of(),
        prepared,
        repair.of() / prepared * 100.0
    );
}

fn main() {
    let folder = std::env::args().skip(1).find(|argument| !argument.starts_with("--"));
    let here = concat!(env!("CARGO_MANIFEST_DIR"), "/../../benchdata/cache");
    let archive = Archive::new([folder.unwrap_or_else(|| here.to_owned()).into()]);
    for (motion, other) in
        [(Motion::corners(K::ANY), Engine::Anya), (Motion::centers(K::N8), Engine::JpsBlock)]
    {
        let mut prepared = Vec::new();
        for (set, name) in MAPS {
            let (Ok(Some(map)), Ok(Some(scenario))) = (archive.map(set, name), archive.scenario(set, name))
            else {
                println!("{name} is not there: cargo xtask download");
                continue;
            };
            let map = Map::from(MapFile::parse(&map).unwrap().to_grid());
            let ends = Scenario::parse(&scenario).unwrap();
            let ends = ends.instances().iter().map(|instance| Ends::new(instance.start, instance.goal));
            let space = map.space(motion).unwrap();
            let start = Instant::now();
            let index = space.prepare(Engine::Subgoal).unwrap();
            prepared.push((name, index, ends.step_by(10).collect::<Vec<_>>(), micros(start)));
        }
        println!(
            "\n{motion}\n\n| map | edit | by labels | at least | µs | *new labels* | others, µs | *`{other}`* | repair, µs \
             |\n|---|---|{}",
            "--:|".repeat(7)
        );
        for (name, index, ends, _) in &prepared {
            [1, 10].into_iter().for_each(|side| one_edit(name, index, other, ends, side));
        }
        println!(
            "\n| map |{} repair, µs | anew, µs | |\n|---|{}",
            CURVE.map(|edit| format!(" {edit} |")).concat(),
            "--:|".repeat(8)
        );
        for (name, index, ends, anew) in &prepared {
            curve(name, index, ends, *anew);
        }
    }
}
