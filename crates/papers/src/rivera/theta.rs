//! A* over N(k) beside Theta*, on the scenarios of Dragon Age: Origins.

use mediant_bench::Study;
use mediant_report::{Axis, Chart, Claim, Column, Mark, Record, Row, Series, Table, number, thousands};
use serde::{Deserialize, Serialize};

use super::{causes, searches::KS};
use crate::{
    Error,
    context::{Context, How},
    experiment::{Findings, Section},
    maps::Map,
    setups::{Sums, run},
};

/// One of so many instances is timed.
const TIMED: usize = 60;
/// The setup of Theta* of the paper: the octile distance as its heuristic.
const THETA: &str = "theta:3:open";
/// The keys of A* and of Theta* in the column `search`.
const A_STAR: &str = "astar";
const THETA_STAR: &str = "theta";
/// The paper says that from this k on A* finds shorter paths than Theta*, and that at this k it is so many
/// times as fast.
const BETTER_FROM: u32 = 5;
const FASTER_BY: f64 = 1.37;

/// Sums over the instances of a map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Lengths {
    instances: f64,
    cost: f64,
    /// The sum of the ratios length / optimum.
    ratios: f64,
    /// How many paths are shorter than those of Theta*, and how many longer.
    shorter: f64,
    longer: f64,
}

/// A* by k, then Theta*.
fn searches() -> impl Iterator<Item = (&'static str, u32)> {
    KS.into_iter().map(|k| (A_STAR, k)).chain([(THETA_STAR, 3)])
}

pub(super) fn measure(context: &Context<'_>) -> Result<Findings, Error> {
    let mut maps = Vec::new();
    for set in context.sets() {
        maps.extend(context.maps(set, 12)?);
    }
    let every = context.quick_or(20, 1);
    let lengths = context.each("lengths", How::Counted, &maps, |map| lengths(map, every))?;
    let timed =
        context.each("times", How::Timed, &maps, |map| times(map, every.max(TIMED), context.passes()))?;
    let row = |(at, (search, k)): (usize, (&str, u32))| {
        let sum = |of: fn(&Lengths) -> f64| lengths.iter().map(|map| of(&map[at])).sum::<f64>();
        let instances = sum(|map| map.instances);
        let mut sums = Sums::default();
        timed.iter().for_each(|map| sums.add(&map[at]));
        let mean = |sum: f64, of: u64| (of > 0).then(|| sum / of as f64);
        Row::new()
            .key("search", search)
            .key("k", k)
            .with("cost", sum(|map| map.cost) / instances)
            .with("excess", 100.0 * (sum(|map| map.ratios) / instances - 1.0))
            .with("shorter", 100.0 * sum(|map| map.shorter) / instances)
            .with("longer", 100.0 * sum(|map| map.longer) / instances)
            .with("timed", sums.queries as f64)
            .with("expanded", mean(sums.expanded, sums.found))
            .with("percolations", mean(sums.percolations, sums.found))
            .with("micros", mean(sums.micros, sums.timed))
    };
    let rows = searches().enumerate().map(row).collect();
    let instances = lengths.iter().filter_map(|map| map.first()).map(|map| map.instances as u64).sum();
    let which = if every == 1 {
        "all of the scenarios".to_owned()
    } else {
        format!("every {every}th of the scenarios")
    };
    let drawn = format!("{which}, between corners; expansions and times on every {}th", every.max(TIMED));
    Ok(Findings { columns: columns(), rows, maps: maps.len(), instances, drawn, seeded: false })
}

fn columns() -> Vec<Column> {
    vec![
        Column::key("search", "A* with h_k, or Theta* with the octile distance"),
        Column::key("k", "it searches N(k)"),
        Column::count("cost", "cells", "mean length of a path"),
        Column::count("excess", "%", "mean of the lengths over those of shortest any-angle paths, less 1"),
        Column::count("shorter", "%", "instances with a path that is shorter than that of Theta*"),
        Column::count("longer", "%", "instances with a longer one"),
        Column::count("timed", "", "instances that the following are over"),
        Column::count("expanded", "", "mean number of nodes expanded"),
        Column::count("percolations", "", "mean number of swaps in the heap"),
        Column::time("micros", "µs", "mean time of a query"),
    ]
}

/// The lengths of all searches. A*'s are the optima over N(k), which subgoal graphs find in less time.
fn lengths(map: &Map, every: usize) -> Result<Vec<Lengths>, Error> {
    let (grid, queries) = (map.grid()?, map.queries(every)?);
    let mut study = Study::new(&grid, &queries, 0);
    let mut costs = |setup: &str| -> Result<Vec<Option<f64>>, Error> {
        Ok(run(&mut study, setup)?.answers.iter().map(|answer| answer.map(|answer| answer.cost)).collect())
    };
    let optima = costs("subgoal:any:open")?;
    let theta = costs(THETA)?;
    let mut all = Vec::new();
    for (search, k) in searches() {
        let found = if search == THETA_STAR { theta.clone() } else { costs(&format!("subgoal:{k}:open"))? };
        let mut sums = Lengths::default();
        for ((cost, optimum), theta) in found.iter().zip(&optima).zip(&theta) {
            let (Some(cost), Some(optimum), Some(theta)) = (cost, optimum, theta) else { continue };
            sums.instances += 1.0;
            sums.cost += cost;
            sums.ratios += cost / optimum;
            // By more than rounding.
            sums.shorter += f64::from(*cost < theta * (1.0 - 1e-9));
            sums.longer += f64::from(*cost > theta * (1.0 + 1e-9));
        }
        all.push(sums);
    }
    Ok(all)
}

fn times(map: &Map, every: usize, passes: u32) -> Result<Vec<Sums>, Error> {
    let (grid, queries) = (map.grid()?, map.queries(every)?);
    let mut study = Study::new(&grid, &queries, passes);
    let one = |(search, k): (&str, u32)| {
        let setup = if search == THETA_STAR { THETA.to_owned() } else { format!("astar:{k}:open") };
        Ok(Sums::of(&run(&mut study, &setup)?, &[]))
    };
    searches().map(one).collect()
}

/// A number of a search.
fn of(record: &Record, search: &str, k: u32, column: &str) -> Option<f64> {
    record.number(&[("search", search), ("k", &k.to_string())], column)
}

pub(super) fn show(record: &Record) -> Section {
    let mut section = Section::default();
    section.text(
        "A* with h_k beside Theta* with the octile distance, between corners. Excess: mean of the lengths \
         over those of shortest any-angle paths, less 1.",
    );
    section.table(&table(record));
    if let Some(svg) = chart(record) {
        let alternative = "Excess of the paths over the any-angle optimum against the time of a query, of A* \
                           for each k and of Theta*";
        section.figure("rivera2017-theta-excess", alternative, svg);
    }
    section.claims(claims(record), true);
    section
}

fn table(record: &Record) -> Table {
    let mut table = Table::new([
        "search",
        "2^k",
        "cost",
        "excess (%)",
        "shorter than Theta* (%)",
        "longer (%)",
        "expansions",
        "µs",
        "ns an expansion",
        "times as fast as Theta*",
    ]);
    let theta = of(record, THETA_STAR, 3, "micros");
    for (search, k) in searches() {
        let text = |column, digits: usize| {
            of(record, search, k, column).map_or(String::new(), |number| format!("{number:.digits$}"))
        };
        let (micros, expanded) = (of(record, search, k, "micros"), of(record, search, k, "expanded"));
        let beside = |column| if search == THETA_STAR { String::new() } else { text(column, 1) };
        let ratio = |(a, b): (f64, f64)| number(a / b);
        table.row([
            if search == THETA_STAR { "Theta*" } else { "A*" }.to_owned(),
            (1 << k).to_string(),
            text("cost", 2),
            text("excess", 3),
            beside("shorter"),
            beside("longer"),
            expanded.map_or(String::new(), thousands),
            micros.map_or(String::new(), number),
            micros.map(|micros| 1000.0 * micros).zip(expanded).map_or(String::new(), ratio),
            theta.zip(micros).map_or(String::new(), ratio),
        ]);
    }
    table
}

fn chart(record: &Record) -> Option<String> {
    let point = |(search, k): (&str, u32)| {
        Some((of(record, search, k, "micros")? / 1000.0, of(record, search, k, "excess")?))
    };
    let timed = of(record, THETA_STAR, 3, "timed")?;
    let theta = point((THETA_STAR, 3))?;
    let a_star = KS.map(|k| (k, point((A_STAR, k)))).into_iter().filter_map(|(k, at)| Some((k, at?)));
    let a_star: Vec<(u32, (f64, f64))> = a_star.collect();
    let labels = a_star.iter().map(|(k, _)| (1_u32 << k).to_string()).collect::<Vec<_>>();
    let chart = Chart::new(
        "Length of paths against time",
        Axis::new("time of a query (ms)"),
        Axis::new("excess over the any-angle optimum (%)").log(),
    )
    .note(format!(
        "{} instances; times of {}",
        thousands(record.provenance.instances as f64),
        thousands(timed)
    ))
    .series(Series::new("A* over 2^k neighbors", Mark::Line, a_star.iter().map(|(_, at)| *at)).labels(labels))
    .series(Series::new("Theta*", Mark::Points, [theta]));
    Some(chart.svg())
}

fn claims(record: &Record) -> Vec<Claim> {
    let source = "Empirical Findings, Theta*";
    let better = |k: u32| Some(of(record, A_STAR, k, "cost")? < of(record, THETA_STAR, 3, "cost")?);
    let from = KS.into_iter().find(|&k| better(k) == Some(true)).map(f64::from);
    let all_after = KS.into_iter().filter(|&k| k >= BETTER_FROM).all(|k| better(k) == Some(true));
    let faster = |k: u32| Some(of(record, THETA_STAR, 3, "micros")? / of(record, A_STAR, k, "micros")?);
    let slower = || KS.into_iter().filter(|&k| k > BETTER_FROM).map(|k| faster(k).map(|faster| faster < 1.0));
    let slower: Option<Vec<bool>> = slower().collect();
    vec![
        Claim::new(
            source,
            "smallest k whose paths are shorter than those of Theta*, as are those of all greater k",
            f64::from(BETTER_FROM),
            from.filter(|_| all_after),
        )
        .within(0.0)
        .written(0, ""),
        Claim::new(source, "A* over 32 neighbors: times as fast as Theta*", FASTER_BY, faster(BETTER_FROM))
            .of_times(true)
            .because(causes::THETA_TIME),
        Claim::new(
            source,
            "of 64 and 128 neighbors: with how many A* is slower than Theta*",
            2.0,
            slower.map(|slower| slower.into_iter().filter(|&slower| slower).count() as f64),
        )
        .within(0.0)
        .written(0, " of 2")
        .of_times(true)
        .because(causes::THETA_TIME),
    ]
}
