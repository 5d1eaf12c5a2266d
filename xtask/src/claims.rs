//! `cargo xtask claims`: what the papers on hierarchical planners claim, and what is found here, as Markdown.
//!
//! Lengths and numbers of nodes are the same on every run and platform; times are not.

use std::{
    hint::black_box,
    num::NonZeroUsize,
    path::{Path, PathBuf},
    sync::Arc,
    time::Instant,
};

use clap::Args;
use mediant_engines::{Ground, Prebuilt, Setup, Solver};
use mediant_formats::{Instance, MapFile, Scenario};
use mediant_grid::Grid;
use mediant_oracle::Rng;
use mediant_search::{Counters, Outcome, Query};

use crate::{
    Error, project,
    verify::{files, progress},
};

/// What `claims` is asked for.
#[derive(Args, Clone, Debug)]
pub struct Options {
    /// Which of the instances of each segment of a scenario are drawn
    #[arg(long, value_name = "N", default_value = "2023")]
    seed: u64,
    /// For HPA*, of each scenario, only the instances whose index N divides
    #[arg(long, value_name = "N", default_value = "100")]
    every: NonZeroUsize,
}

/// The maps of Teleiša & Čalnerytė 2023, Section 4, all of 768 × 768 tiles.
const MAPS: [&str; 4] = ["ArcticStation", "BrokenSteppes", "Enigma", "Nightshade"];
/// How many instances they draw of each scenario.
const DRAWN: usize = 200;
/// Their algorithms, and ours: the first is what the others are compared with.
const RUNS: [(&str, &str); 17] = [
    ("A* + MD", "astar:2"),
    ("A* + ED", "astar:2,euclidean"),
    ("A* + SED", "astar:2,squared"),
    ("CHPA*, Pstep 1, F1-MD F2-MD", "chpa:2,paper,step=1"),
    ("CHPA*, Pstep 2, F1-MD F2-MD", "chpa:2,paper,step=2"),
    ("CHPA*, Pstep 3, F1-MD F2-MD", "chpa:2,paper,step=3"),
    ("CHPA*, Pstep 4, F1-MD F2-MD", "chpa:2,paper,step=4"),
    ("CHPA*, Pstep 2, F1-ED F2-ED", "chpa:2,euclidean,paper"),
    ("CHPA*, Pstep 2, F1-ED F2-SED", "chpa:2,euclidean,second=squared,paper"),
    ("CHPA*, Pstep 2, F1-MD F2-ED", "chpa:2,second=euclidean,paper"),
    ("complete, Pstep 1, F1-MD F2-MD", "chpa:2,step=1"),
    ("complete, Pstep 2, F1-MD F2-MD", "chpa:2"),
    ("complete, segments of 5 × 5", "chpa:2,side=5"),
    ("complete, segments of 8 × 8", "chpa:2,side=8"),
    ("HPA*", "hpa:2"),
    ("HPA*, as refined", "hpa:2,refined"),
    ("HPA*, one level", "hpa:2,levels=1"),
];
/// The sets of game maps.
const GAMES: [&str; 4] = ["bg512", "dao", "sc1", "wc3maps512"];

/// Sums over queries.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    queries: u32,
    /// Of those that were answered by a path: their number, its length, and the optimal one.
    found: u32,
    length: f64,
    optimal: f64,
    /// The sum and the largest of the lengths over the optimal ones.
    ratios: f64,
    worst: f64,
    counters: Counters,
    seconds: f64,
}

impl Sums {
    /// The mean number of nodes that were expanded.
    fn expanded(self) -> f64 {
        self.counters.expanded as f64 / f64::from(self.queries)
    }

    /// By how much its paths are longer than optimal ones.
    fn excess(self) -> f64 {
        self.length / self.optimal - 1.0
    }

    fn micros(self) -> f64 {
        self.seconds * 1e6 / f64::from(self.queries)
    }
}

/// Prints the tables.
///
/// # Errors
/// [`Error::Verify`] where a set was not downloaded; the errors of reading files.
pub fn run(options: &Options) -> Result<(), Error> {
    let cache = project::root().join("benchdata/cache");
    chpa(&cache, options.seed)?;
    hpa(&cache, options.every)
}

/// The folder of a set that was downloaded.
fn folder(cache: &Path, set: &str) -> Result<PathBuf, Error> {
    let folder = cache.join(set);
    let absent = || Error::Verify(format!("set {set} is not there: cargo xtask download --set {set}"));
    folder.is_dir().then_some(folder).ok_or_else(absent)
}

fn read(map: &Path) -> Result<(Arc<Grid>, Vec<Instance>), Error> {
    let scenario = Scenario::read(map.with_extension("map.scen"))?;
    Ok((Arc::new(MapFile::read(map)?.to_grid()), scenario.instances().to_vec()))
}

/// The instances of a scenario by length, cut into equal parts, one drawn from each.
fn draw(mut instances: Vec<Instance>, rng: &mut Rng) -> Vec<Query> {
    instances.sort_by(|a, b| a.optimal.total_cmp(&b.optimal));
    let at = |part: usize| part * instances.len() / DRAWN;
    let drawn = (0..DRAWN).filter(|&part| at(part) < at(part + 1)).map(|part| {
        let instance = &instances[at(part) + rng.below((at(part + 1) - at(part)) as u32) as usize];
        Query::new(instance.start, instance.goal)
    });
    drawn.collect()
}

/// Adds what a setup makes of queries whose optimal lengths are known; timed `repeats` times, of which the best counts.
fn add(
    sums: &mut Sums,
    setup: &str,
    grid: &Arc<Grid>,
    queries: &[(Query, f64)],
    repeats: u32,
) -> Result<(), Error> {
    let wrong = |wrong: String| Error::Verify(format!("{setup}: {wrong}"));
    let setup: Setup = setup.parse().map_err(|error| wrong(format!("{error}")))?;
    let ground = Ground::new(setup, grid).map_err(|error| wrong(error.to_string()))?;
    let mut solver =
        Solver::on(setup, &ground, Prebuilt::default()).map_err(|error| wrong(error.to_string()))?;
    for &(query, optimal) in queries {
        sums.queries += 1;
        let Ok((outcome, counters)) = solver.solve_counted(query) else { continue };
        sums.counters.expanded += counters.expanded;
        sums.counters.fallbacks += counters.fallbacks;
        if let Outcome::Found(path) = outcome {
            let ratio = if optimal > 0.0 { path.cost() / optimal } else { 1.0 };
            sums.found += 1;
            sums.length += path.cost();
            sums.optimal += optimal;
            sums.ratios += ratio;
            sums.worst = sums.worst.max(ratio);
        }
    }
    let mut best = f64::INFINITY;
    for _ in 0..repeats {
        let begin = Instant::now();
        for &(query, _) in queries {
            let _ = black_box(solver.solve(query));
        }
        best = best.min(begin.elapsed().as_secs_f64());
    }
    sums.seconds += best;
    Ok(())
}

/// The queries that have a path, with the length of a shortest one by A* for `k`.
fn with_optima(k: u32, grid: &Arc<Grid>, queries: Vec<Query>) -> Result<Vec<(Query, f64)>, Error> {
    let setup: Setup = format!("astar:{k}").parse().map_err(|error| Error::Verify(format!("{error}")))?;
    let mut solver =
        Solver::new(setup, grid, Prebuilt::default()).map_err(|error| Error::Verify(error.to_string()))?;
    let optimal = |query| solver.solve(query).ok()?.path().map(|path| (query, path.cost()));
    Ok(queries.into_iter().filter_map(optimal).collect())
}

/// The experiments of Teleiša & Čalnerytė 2023, Section 5.
fn chpa(cache: &Path, seed: u64) -> Result<(), Error> {
    let mut sums = [Sums::default(); RUNS.len()];
    let mut rng = Rng::new(seed);
    let set = folder(cache, "sc1")?;
    let bar = progress("chpa", MAPS.len() * RUNS.len());
    for map in MAPS {
        let (grid, instances) = read(&set.join(format!("{map}.map")))?;
        let queries = with_optima(2, &grid, draw(instances, &mut rng))?;
        for ((_, setup), sums) in RUNS.iter().zip(&mut sums) {
            add(sums, setup, &grid, &queries, 3)?;
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    println!(
        "Teleiša & Čalnerytė 2023: {}, {DRAWN} instances of each, seed {seed}, k = 2\n",
        MAPS.join(", ")
    );
    println!(
        "| | setup | longer than optimal | at most | expanded | against A* + MD | µs | against A* + MD | gave up | fell back |"
    );
    println!("|---|---|--:|--:|--:|--:|--:|--:|--:|--:|");
    for ((name, setup), run) in RUNS.iter().zip(sums) {
        println!(
            "| {name} | `{setup}` | {:.2} % | {:.2} × | {:.0} | {:+.1} % | {:.0} | {:+.1} % | {} | {} |",
            100.0 * run.excess(),
            run.worst,
            run.expanded(),
            100.0 * (run.expanded() / sums[0].expanded() - 1.0),
            run.micros(),
            100.0 * (run.micros() / sums[0].micros() - 1.0),
            run.queries - run.found,
            run.counters.fallbacks,
        );
    }
    chpa_claims(&sums);
    Ok(())
}

/// What the paper says of its runs, beside what these came to.
fn chpa_claims(sums: &[Sums; RUNS.len()]) {
    let run = |name: &str| RUNS.iter().zip(sums).find(|((_, setup), _)| *setup == name).map(|(_, run)| *run);
    let runs = [
        "astar:2",
        "astar:2,euclidean",
        "astar:2,squared",
        "chpa:2,paper,step=1",
        "chpa:2,paper,step=2",
        "chpa:2,euclidean,paper",
    ];
    let [md, ed, sed, first, second, by_ed] = runs.map(|name| run(name).unwrap_or_default());
    let less = |a: f64, b: f64| format!("{:.1} %", 100.0 * (1.0 - a / b));
    let more = |a: f64, b: f64| format!("{:.1} %", 100.0 * (a / b - 1.0));
    println!("\n| claim | paper | here |\n|---|--:|--:|");
    for (claim, paper, here) in [
        ("A* + SED: longer paths than A* + MD", "19 %", more(sed.length, md.length)),
        ("A* + SED: fewer tiles than A* + MD", "80 %", less(sed.expanded(), md.expanded())),
        ("A* + MD: fewer tiles than A* + ED", "33 %", less(md.expanded(), ed.expanded())),
        ("CHPA*, Pstep 2: longer than optimal", "2 to 4 %", more(second.length, second.optimal)),
        ("CHPA*, Pstep 2: fewer nodes than A* + MD", "over 80 %", less(second.expanded(), md.expanded())),
        ("CHPA*, Pstep 2: less time than A* + MD", "97 %", less(second.seconds, md.seconds)),
        ("CHPA* by ED: more nodes than A* + SED", "8 %", more(by_ed.expanded(), sed.expanded())),
        ("CHPA* by ED: more nodes than by MD", "34 %", more(by_ed.expanded(), second.expanded())),
        ("Pstep 2: shorter paths than Pstep 1", "8 %", less(1.0 + second.excess(), 1.0 + first.excess())),
        ("Pstep 2: fewer nodes than Pstep 1", "0.5 %", less(second.expanded(), first.expanded())),
    ] {
        println!("| {claim} | {paper} | {here} |");
    }
}

/// What Botea, Müller & Schaeffer 2004 claim: up to ten times faster than A*, within 1 % of optimal after smoothing.
fn hpa(cache: &Path, every: NonZeroUsize) -> Result<(), Error> {
    println!("\nHPA* on the maps of games, each {every}th instance of the scenarios, means over maps\n");
    println!(
        "| k | set | maps | as refined, longer than optimal | smoothed | worst map | fewer nodes than A* | less time |"
    );
    println!("|--:|---|--:|--:|--:|--:|--:|--:|");
    for k in [2, 3] {
        for set in GAMES {
            let maps = files(&folder(cache, set)?, ".map")?;
            let bar = progress(set, maps.len());
            let (mut count, mut sums, mut worst) = (0, [0.0; 4], 0.0_f64);
            for map in &maps {
                if let Some(means) = hpa_on(map, k, every)? {
                    count += 1;
                    sums.iter_mut().zip(means).for_each(|(sum, mean)| *sum += mean);
                    worst = worst.max(means[1]);
                }
                bar.inc(1);
            }
            bar.finish_and_clear();
            let [refined, smoothed, nodes, time] = sums.map(|sum| sum / f64::from(count));
            println!(
                "| {k} | {set} | {count} | {:.2} % | {:.2} % | {:.2} % | {:.1} × | {:.1} × |",
                100.0 * refined,
                100.0 * smoothed,
                100.0 * worst,
                nodes.exp(),
                time.exp()
            );
        }
    }
    Ok(())
}

/// On one map: by how much paths are longer than optimal, as refined and smoothed, and the logarithms of A*'s nodes and time over those of HPA*.
fn hpa_on(map: &Path, k: u32, every: NonZeroUsize) -> Result<Option<[f64; 4]>, Error> {
    let (grid, instances) = read(map)?;
    let queries = instances.iter().step_by(every.get()).filter(|instance| instance.start != instance.goal);
    let queries = queries.map(|instance| Query::new(instance.start, instance.goal)).collect();
    let queries = with_optima(k, &grid, queries)?;
    if queries.is_empty() {
        return Ok(None);
    }
    let [mut astar, mut hpa, mut refined] = [Sums::default(); 3];
    add(&mut astar, &format!("astar:{k}"), &grid, &queries, 1)?;
    add(&mut hpa, &format!("hpa:{k}"), &grid, &queries, 3)?;
    add(&mut refined, &format!("hpa:{k},refined"), &grid, &queries, 0)?;
    let mean = |run: Sums| run.ratios / f64::from(run.found) - 1.0;
    let nodes = (astar.expanded() / hpa.expanded().max(1.0)).ln();
    Ok(Some([mean(refined), mean(hpa), nodes, (astar.seconds / hpa.seconds).ln()]))
}

#[cfg(test)]
mod tests {
    use mediant_grid::Vertex;

    use super::*;

    /// Of `count` lengths, in another order; where an instance starts says its length.
    fn instances(count: i32) -> Vec<Instance> {
        let instance = |i: i32| {
            let length = i * 7 % count;
            let (start, goal) = (Vertex::new(length, 0), Vertex::new(0, 0));
            let optimal = f64::from(length);
            Instance { bucket: 0, map: "map".into(), width: 1, height: 1, start, goal, optimal }
        };
        (0..count).map(instance).collect()
    }

    #[test]
    fn one_instance_is_drawn_from_each_part_of_the_lengths() {
        // 1,003 is no multiple of 200: three parts have one more than the others' five.
        for (count, of_part) in [(1_003, 5..=6), (200, 1..=1)] {
            let drawn = draw(instances(count), &mut Rng::new(1));
            assert_eq!(drawn.len(), DRAWN);
            for (part, query) in drawn.iter().enumerate() {
                let [first, beyond] = [part, part + 1].map(|part| (part * count as usize / DRAWN) as i32);
                assert!(of_part.contains(&(beyond - first)));
                assert!((first..beyond).contains(&query.start.x), "part {part} of {count}: {query:?}");
            }
        }
        let [same, again, other] = [1, 1, 2].map(|seed| draw(instances(1_003), &mut Rng::new(seed)));
        assert_eq!(same, again);
        assert_ne!(same, other);
        // Fewer than there are parts: each once.
        assert_eq!(draw(instances(11), &mut Rng::new(1)).len(), 11);
    }
}
