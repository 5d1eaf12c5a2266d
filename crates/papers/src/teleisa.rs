//! Teleiša & Čalnerytė 2023: CHPA* beside A*.
//!
//! The tables of the publication are pictures; what is compared here are the numbers that its text states.

use std::{collections::BTreeMap, sync::Arc};

use mediant_bench::Study;
use mediant_formats::Instance;
use mediant_grid::Grid;
use mediant_oracle::Rng;
use mediant_report::{
    Axis, Chart, Claim, Column, Mark, Record, Row, Series, Table, number, stats, thousands,
};
use mediant_search::Ends;
use serde::{Deserialize, Serialize};

use super::{
    context::{Context, How},
    experiment::{Experiment, Findings, Page, Section},
    maps::Map,
    setups::{Sums, costs, run},
};
use crate::Error;

/// Tables 1 and 2, Figure 6.
pub(super) const RUNS: Experiment = Experiment {
    id: "teleisa2023-runs",
    page: Page::Teleisa2023,
    title: "Tables 1 and 2, Figure 6: A* and CHPA* by their heuristics",
    sets: &["sc1"],
    measure,
    show,
};

/// The maps of Section 4, all of 768 × 768 cells.
const MAPS: [&str; 4] = ["ArcticStation", "BrokenSteppes", "Enigma", "Nightshade"];
/// How many instances the paper draws of each scenario.
const DRAWN: usize = 200;
/// A* with the Manhattan distance, which all others are compared with; with the Euclidean; with its square.
const MD: &str = "astar:2";
const ED: &str = "astar:2,euclidean";
const SED: &str = "astar:2,squared";
/// Pstep 1, 2, 3, 4.
const STEPS: [&str; 4] =
    ["chpa:2,paper,step=1", "chpa:2,paper", "chpa:2,paper,step=3", "chpa:2,paper,step=4"];
const BY_ED: &str = "chpa:2,euclidean,paper";
const BY_ED_SED: &str = "chpa:2,euclidean,second=squared,paper";
const BY_MD_ED: &str = "chpa:2,second=euclidean,paper";
/// The paper's algorithms by their names, and our setups.
const ALGORITHMS: [(&str, &str); 17] = [
    (MD, "A* + MD"),
    (ED, "A* + ED"),
    (SED, "A* + SED"),
    (STEPS[0], "CHPA*, Pstep 1, F1-MD F2-MD"),
    (STEPS[1], "CHPA*, Pstep 2, F1-MD F2-MD"),
    (STEPS[2], "CHPA*, Pstep 3, F1-MD F2-MD"),
    (STEPS[3], "CHPA*, Pstep 4, F1-MD F2-MD"),
    (BY_ED, "CHPA*, Pstep 2, F1-ED F2-ED"),
    (BY_ED_SED, "CHPA*, Pstep 2, F1-ED F2-SED"),
    (BY_MD_ED, "CHPA*, Pstep 2, F1-MD F2-ED"),
    ("chpa:2,step=1", "ours, complete, Pstep 1"),
    ("chpa:2", "ours, complete, Pstep 2"),
    ("chpa:2,side=5", "ours, segments of 5 × 5"),
    ("chpa:2,side=8", "ours, segments of 8 × 8"),
    ("hpa:2", "HPA*"),
    ("hpa:2,unstraightened", "HPA*, unstraightened"),
    ("hpa:2,levels=1", "HPA*, one level"),
];

/// The columns of standard errors, by the draw of the instances, of ratios of nodes to another algorithm's.
const ERRORS: [(&str, &str); 3] = [("error_to_md", MD), ("error_to_sed", SED), ("error_to_chpa", STEPS[1])];

/// The instances of a scenario by length, cut into equal parts, one drawn from each.
fn draw(mut instances: Vec<Instance>, parts: usize, rng: &mut Rng) -> Vec<Ends> {
    instances.sort_by(|a, b| a.optimal.total_cmp(&b.optimal));
    let at = |part: usize| part * instances.len() / parts;
    let drawn = (0..parts).filter(|&part| at(part) < at(part + 1)).map(|part| {
        let instance = &instances[at(part) + rng.below((at(part + 1) - at(part)) as u32) as usize];
        Ends::new(instance.start, instance.goal)
    });
    drawn.collect()
}

/// The results on one map: for each algorithm its sums, and of each query the nodes and the length.
#[derive(Serialize, Deserialize)]
struct Part {
    sums: Vec<Sums>,
    nodes: Vec<Vec<f64>>,
    lengths: Vec<Vec<f64>>,
}

fn measure(context: &Context<'_>) -> Result<Findings, Error> {
    let maps = context.named("sc1", &MAPS)?;
    let parts = problems_of(context);
    let measured = context.each("runs", How::Timed, &maps, |map| on_map(context, map, parts))?;
    let place = |setup: &str| ALGORITHMS.iter().position(|(text, _)| *text == setup).unwrap_or(0);
    // The standard error, by the draw of the instances, of the ratio of means to another algorithm's.
    let error = |values: fn(&Part) -> &Vec<Vec<f64>>, at: usize, base: usize| {
        let pairs = |part| values(part)[at].iter().copied().zip(values(part)[base].iter().copied());
        let pairs = measured.iter().flat_map(pairs).filter(|pair: &(f64, f64)| pair.0 > 0.0 && pair.1 > 0.0);
        let (ratio, error) = stats::ratio_of_means(&pairs.collect::<Vec<_>>())?;
        Some(error / ratio)
    };
    let mut rows = Vec::new();
    for (at, (setup, _)) in ALGORITHMS.iter().enumerate() {
        let mut sums = Sums::default();
        measured.iter().for_each(|part| sums.add(&part.sums[at]));
        let mut row = sums.row(Row::new().key("setup", setup));
        row = row.with("cost_error", error(|part| &part.lengths, at, place(MD)));
        for (column, base) in ERRORS {
            row = row.with(column, error(|part| &part.nodes, at, place(base)));
        }
        rows.push(row);
    }
    let mut columns = vec![Column::key("setup", "the engine with its options")];
    columns.extend(Sums::columns());
    let about = |what: &str, base: &str| {
        format!("standard error of {what} over that of {base}, by the draw, a part of it")
    };
    columns.push(Column::count("cost_error", "", &about("cost", MD)));
    columns.extend(ERRORS.map(|(column, base)| Column::count(column, "", &about("expanded", base))));
    let instances = measured.iter().map(|part| part.sums[0].queries).sum();
    let drawn = format!(
        "each scenario by length, cut into {parts} parts, one instance drawn of each; k = 2 between centers"
    );
    Ok(Findings { columns, rows, maps: maps.len(), instances, drawn, seeded: true })
}

/// The number of instances that are drawn of a scenario.
fn problems_of(context: &Context<'_>) -> usize {
    context.quick_or(20, DRAWN)
}

/// The instances drawn of a map's scenario, those that have a path, with their optima.
fn problems(
    context: &Context<'_>,
    map: &Map,
    grid: &Arc<Grid>,
    parts: usize,
) -> Result<(Vec<Ends>, Vec<f64>), Error> {
    let queries = draw(map.instances()?, parts, &mut context.rng(map));
    let optimal = run(&mut Study::new(grid, &queries, 0), MD)?;
    let pairs = queries
        .into_iter()
        .zip(costs(&optimal))
        .filter(|(query, cost)| *cost > 0.0 && query.start != query.goal);
    Ok(pairs.unzip())
}

fn on_map(context: &Context<'_>, map: &Map, parts: usize) -> Result<Part, Error> {
    let grid = map.grid()?;
    let (queries, optima) = problems(context, map, &grid, parts)?;
    let mut study = Study::new(&grid, &queries, context.passes());
    let mut part = Part { sums: Vec::new(), nodes: Vec::new(), lengths: Vec::new() };
    for (setup, _) in ALGORITHMS {
        let run = run(&mut study, setup)?;
        part.sums.push(Sums::of(&run, &optima));
        let nodes = |answer: &Option<mediant_bench::PathFigures>| {
            answer.map_or(0.0, |answer| answer.counters.expanded as f64)
        };
        part.nodes.push(run.answers.iter().map(nodes).collect());
        part.lengths.push(costs(&run));
    }
    Ok(part)
}

// Why our numbers differ from theirs.

const TIES: &str = "A guess that nobody can check: how ties are broken. Ours takes, of nodes with equal f, the one \
                    nearest to the goal. The paper does not say which its program takes, and the numbers of \
                    nodes of A* and of CHPA* depend on it.";
const PER_NODE: &str = "A guess that nobody can check: the time of a node. The published numbers need a node of \
                        CHPA* to cost a quarter of a node of A*: 3 % of the time for 13 % of the nodes. Here \
                        both cost the same, as the open list is a heap. A list that is searched from end to \
                        end would make the difference. Which list the paper's program has is not published.";
const CHECKPOINTS: &str = "A guess that nobody can check: where the checkpoints are. The paper does not say in \
                           which order the tiles of a wall are tried. Ours, from its middle outwards, loses \
                           so little at Pstep 1 that there is little to win back. Among free tiles no order \
                           can lose any length, as the path stays monotone from checkpoint to checkpoint. \
                           What is left are the walls: the paper itself reports obstacles that its windows \
                           do not recognize, and extremely long paths there. Ours gives such queries up \
                           (column *gave up*).";

fn claims(record: &Record) -> Vec<Claim> {
    const TABLE_1: &str = "Section 5, Table 1";
    const FIGURE_6: &str = "Section 5, Figure 6";
    let get = |setup: &str, column: &str| record.number(&[("setup", setup)], column);
    let ratio = |column: &'static str, of: &str, to: &str| Some(get(of, column)? / get(to, column)?);
    let claim = |source: &str, what: &str, published: f64, ours: Option<f64>| {
        Claim::new(source, what, published, ours.map(|ratio| 100.0 * ratio)).written(1, " %")
    };
    let tiles = |what: &str, published: f64, of: &str, to: &str, error: Option<f64>| {
        claim(TABLE_1, &format!("tiles of {what}"), published, ratio("expanded", of, to))
            .standard_error(error)
            .because(TIES)
    };
    // The excess is over the optimum of the same queries, so that those that gave up do not count.
    let excess = |setup: &str| Some(1.0 + get(setup, "excess")? / 100.0);
    let by = |of: &str, to: &str| Some(excess(of)? / excess(to)?);
    let step = |what: &str, published: f64, at: usize| {
        let [length, nodes] = [by(STEPS[at], STEPS[at - 1]), ratio("expanded", STEPS[at], STEPS[at - 1])];
        let ours = if what == "length" { length } else { nodes };
        let what = format!("{what} at Pstep {} over Pstep {at}", at + 1);
        claim(FIGURE_6, &what, published, ours).because(CHECKPOINTS)
    };
    let long = claim(TABLE_1, "length of A* + SED over A* + MD", 119.0, ratio("cost", SED, MD));
    let time = claim("Section 5, Table 2", "time of CHPA* over A* + MD", 3.0, ratio("micros", STEPS[1], MD));
    vec![
        long.standard_error(get(SED, "cost_error")),
        tiles("A* + SED over A* + MD", 20.0, SED, MD, get(SED, "error_to_md")),
        tiles("A* + MD over A* + ED", 67.0, MD, ED, get(ED, "error_to_md")),
        claim(TABLE_1, "length of CHPA* by ED over the optimum", 104.0, excess(BY_ED)),
        tiles("CHPA* by ED over A* + SED", 108.0, BY_ED, SED, get(BY_ED, "error_to_sed")),
        tiles("CHPA* by ED over CHPA* by MD", 134.0, BY_ED, STEPS[1], get(BY_ED, "error_to_chpa")),
        claim(TABLE_1, "length of CHPA* by ED over CHPA* by MD", 99.8, by(BY_ED, STEPS[1])),
        claim(TABLE_1, "length of CHPA* by MD over A* + SED", 86.0, by(STEPS[1], SED)),
        tiles("CHPA* by MD over A* + SED", 80.0, STEPS[1], SED, get(STEPS[1], "error_to_sed")),
        claim("Section 5, Table 2", "length of CHPA* over A* + MD", 102.0, excess(STEPS[1])),
        time.of_times(true).because(PER_NODE),
        step("length", 92.0, 1),
        step("length", 98.5, 2),
        step("length", 99.5, 3),
        step("nodes", 99.5, 1),
        step("nodes", 101.5, 2),
        step("nodes", 101.5, 3),
    ]
}

fn show(record: &Record) -> Section {
    let mut section = Section::default();
    section.text(
        "The publication's tables are pictures, whose numbers its text does not repeat; these are the \
         numbers that it states in words. MD, ED and SED are the Manhattan, Euclidean and squared Euclidean \
         distances; F1 and F2 the heuristics of the two phases. Lengths of runs that gave up on some queries \
         are compared on the others.",
    );
    section.claims(claims(record), true);
    let base = record.rows.first();
    let against =
        |row: &Row, column: &str| match (row.number(column), base.and_then(|row| row.number(column))) {
            (Some(value), Some(base)) => format!("{:+.1} %", 100.0 * (value / base - 1.0)),
            _ => "–".to_owned(),
        };
    let names: BTreeMap<&str, &str> = ALGORITHMS.into_iter().collect();
    let mut table = Table::new([
        "algorithm",
        "setup",
        "longer than optimal",
        "at most",
        "nodes",
        "against A* + MD",
        "µs",
        "against A* + MD",
        "gave up",
        "left the plan",
    ])
    .names(2);
    for row in &record.rows {
        let value = |column| row.number(column).unwrap_or_default();
        let setup = row.text("setup");
        table.row([
            names.get(setup).copied().unwrap_or_default().to_owned(),
            format!("`{setup}`"),
            format!("{:.2} %", value("excess")),
            format!("{:.2} ×", value("worst")),
            thousands(value("expanded")),
            against(row, "expanded"),
            row.number("micros").map_or("–".to_owned(), number),
            against(row, "micros"),
            thousands(value("queries") - value("found")),
            thousands(value("fallbacks")),
        ]);
    }
    section.heading("All runs");
    section.table(&table);
    section.heading("Figure 6: Pstep");
    section.figure("teleisa2023-runs-pstep", "Length and nodes of CHPA* by Pstep", chart(record).svg());
    section
}

/// Figure 6.
fn chart(record: &Record) -> Chart {
    let points = |column: &'static str| {
        let first = record.number(&[("setup", STEPS[0])], column);
        let point = move |(step, setup): (usize, &&str)| {
            let value = record.number(&[("setup", setup)], column)?;
            let value = if column == "excess" { value } else { 100.0 * (value / first? - 1.0) };
            Some(((step + 1) as f64, value))
        };
        STEPS.iter().enumerate().filter_map(point).collect::<Vec<_>>()
    };
    let ticks = || (1..=4).map(|step| (f64::from(step), step.to_string()));
    let note = format!(
        "{} instances on {} maps, k = 2",
        thousands(record.provenance.instances as f64),
        record.provenance.maps
    );
    Chart::new(
        "CHPA* by Pstep",
        Axis::new("Pstep: segments from checkpoint to checkpoint").ticks(ticks()),
        Axis::new("difference, %"),
    )
    .note(note)
    .series(Series::new("length over the optimum", Mark::Line, points("excess")))
    .series(Series::new("nodes, against Pstep 1", Mark::Line, points("expanded")))
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
            let drawn = draw(instances(count), DRAWN, &mut Rng::new(1));
            assert_eq!(drawn.len(), DRAWN);
            for (part, query) in drawn.iter().enumerate() {
                let [first, beyond] = [part, part + 1].map(|part| (part * count as usize / DRAWN) as i32);
                assert!(of_part.contains(&(beyond - first)));
                assert!((first..beyond).contains(&query.start.x), "part {part} of {count}: {query:?}");
            }
        }
        let [same, again, other] = [1, 1, 2].map(|seed| draw(instances(1_003), DRAWN, &mut Rng::new(seed)));
        assert_eq!(same, again);
        assert_ne!(same, other);
        // Fewer than there are parts: each once.
        assert_eq!(draw(instances(11), DRAWN, &mut Rng::new(1)).len(), 11);
    }

    #[test]
    fn each_algorithm_is_one() {
        for (setup, _) in ALGORITHMS {
            assert!(crate::setups::setup(setup).unwrap().check().is_ok(), "{setup}");
        }
        let setups: BTreeMap<&str, &str> = ALGORITHMS.into_iter().collect();
        assert_eq!(setups.len(), ALGORITHMS.len());
    }
}
