//! Tables I and II: sixteen queries, each answered by four engines under three rules.

mod list;
pub(super) mod pages;

use mediant_bench::{PathFigures, Study};
use mediant_formats::Instance;
use mediant_grid::Vertex;
use mediant_report::{Column, Row};
use mediant_search::Ends;
use serde::{Deserialize, Serialize};

use self::list::plain_astar;
use super::published::{MAPS, Published, rows};
use crate::{
    Error,
    context::{Context, How},
    experiment::Findings,
    maps::Map,
    setups,
};

/// The corner rules.
const RULES: [&str; 3] = ["never", "one", "always"];
/// The engines, and what a row calls them.
const ENGINES: [(&str, &str); 4] =
    [("astar", "A*"), ("jps", "JPS"), ("jps-block", "block JPS"), ("jps-plus", "JPS+")];
/// Other options of JPS: heuristics, tried on the row that does not fit; and the jump points at which a path
/// only turns, which the JPS of 2011 keeps.
const SUSPECTS: [&str; 3] = ["jps:3:one,euclidean", "jps:3:one,zero", KEPT];
const KEPT: &str = "jps:3:one,intermediate";
/// A* whose open list is an unsorted list, [`plain_astar`].
const LIST: &str = "A* in a list";

/// A point as records and pages write it.
fn point((x, y): (i32, i32)) -> String {
    format!("({x}, {y})")
}

/// The answer of one engine to one query.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct Answered {
    start: (i32, i32),
    goal: (i32, i32),
    /// The index of the instance in the scenario.
    index: usize,
    optimum: f64,
    rule: String,
    engine: String,
    cost: f64,
    moves: f64,
    smoothness: f64,
    expanded: f64,
    scanned: f64,
    /// The entries of the open list that [`LIST`] looks at.
    looked: Option<f64>,
    micros: Option<f64>,
}

/// How many instances of a map's scenario have the printed JPS length of a row.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Alike {
    start: (i32, i32),
    goal: (i32, i32),
    one: u64,
}

/// Answers the queries, many times each; then the whole scenarios once, to see which other instance a printed
/// length could belong to.
pub(super) fn measure(ctx: &Context<'_>) -> Result<Findings, Error> {
    let maps = ctx.named("street", &MAPS)?;
    let (passes, repeats) = (ctx.passes(), ctx.quick_or(3, 20));
    let answered = ctx.each("queries", How::Timed, &maps, |map| answers(map, passes, repeats))?;
    let alike = ctx.each("scenarios", How::Counted, &maps, alike)?;
    let mut found = Vec::new();
    for ((map, answered), alike) in maps.iter().zip(&answered).zip(&alike) {
        for answer in answered {
            let is = |alike: &&Alike| (alike.start, alike.goal) == (answer.start, answer.goal);
            let counted = (answer.rule == "one" && answer.engine == "jps").then(|| alike.iter().find(is));
            found.push(row(map, answer, counted.flatten()));
        }
    }
    let drawn = if ctx.is_bundled() {
        "the last two instances of each scenario"
    } else {
        "the rows of tables I and II, each found in its map's scenario"
    };
    Ok(Findings {
        columns: columns(),
        instances: answered.iter().map(|answered| asked(answered).len() as u64).sum(),
        rows: found,
        maps: maps.len(),
        drawn: format!("{drawn}; timed {repeats} times in each pass"),
        seeded: false,
    })
}

/// The queries of the answers, each once.
fn asked(answered: &[Answered]) -> Vec<usize> {
    let mut indices: Vec<usize> = answered.iter().map(|answer| answer.index).collect();
    indices.dedup();
    indices
}

fn columns() -> Vec<Column> {
    vec![
        Column::key("map", "the map"),
        Column::key("start", "where the path begins"),
        Column::key("goal", "where it ends"),
        Column::key("rule", "the corner rule"),
        Column::key(
            "engine",
            "the engine, k = 3 at centers; with options, one that is tried to explain a number; or an A* \
             whose open list is an unsorted list",
        ),
        Column::count("index", "", "of the instance in the map's scenario, from 0"),
        Column::count("optimum", "cells", "length that the scenario states"),
        Column::count("cost", "cells", "length of the path"),
        Column::count("moves", "", "number of steps of the path"),
        Column::count("smoothness", "degrees", "sum of the angles by which the path turns"),
        Column::count("expanded", "", "nodes expanded"),
        Column::count("scanned", "", "vertices looked at by jumps"),
        Column::count(
            "looked",
            "",
            "entries of the open list looked at by an A* that searches it as an unsorted list",
        ),
        Column::count(
            "alike",
            "",
            "instances of the map's scenario with the printed JPS length under this rule",
        ),
        Column::time("micros", "µs", "time of the query"),
    ]
}

fn row(map: &Map, answer: &Answered, alike: Option<&Alike>) -> Row {
    Row::new()
        .key("map", &map.name)
        .key("start", point(answer.start))
        .key("goal", point(answer.goal))
        .key("rule", &answer.rule)
        .key("engine", &answer.engine)
        .with("index", answer.index as f64)
        .with("optimum", answer.optimum)
        .with("cost", answer.cost)
        .with("moves", answer.looked.is_none().then_some(answer.moves))
        .with("smoothness", answer.looked.is_none().then_some(answer.smoothness))
        .with("expanded", answer.expanded)
        .with("scanned", (answer.scanned > 0.0).then_some(answer.scanned))
        .with("looked", answer.looked)
        .with("alike", alike.map(|alike| alike.one as f64))
        .with("micros", answer.micros)
}

fn pair(vertex: Vertex) -> (i32, i32) {
    (vertex.x, vertex.y)
}

fn query(instance: &Instance) -> Ends {
    Ends::new(instance.start, instance.goal)
}

/// The published rows of a map.
fn published(map: &Map) -> Vec<Published> {
    rows().filter(|row| map.set == "street" && row.map == map.name).collect()
}

/// The instances of the tables' rows, with their indices; for a map that is in no table, the last two
/// instances.
fn picked(map: &Map) -> Result<Vec<(usize, Instance)>, Error> {
    let instances = map.instances()?;
    let rows = published(map);
    if rows.is_empty() {
        let skip = instances.len().saturating_sub(2);
        return Ok(instances.into_iter().enumerate().skip(skip).collect());
    }
    let find = |row: &Published| {
        let is = |instance: &Instance| (pair(instance.start), pair(instance.goal)) == (row.start, row.goal);
        let at = instances.iter().position(is);
        at.map(|at| (at, instances[at].clone())).ok_or_else(|| {
            let query = format!("{} to {}", point(row.start), point(row.goal));
            Error::Reproduce(format!(
                "the scenario of {} has no instance {query}: download it anew",
                map.name
            ))
        })
    };
    rows.iter().map(find).collect()
}

fn answers(map: &Map, passes: u32, repeats: usize) -> Result<Vec<Answered>, Error> {
    let grid = map.grid()?;
    let mut answered = Vec::new();
    for (index, instance) in picked(map)? {
        // The query is repeated, since a single one is too short for the clock.
        let queries = vec![query(&instance); if passes > 0 { repeats } else { 1 }];
        let mut study = Study::new(&grid, &queries, passes);
        let mut answer = |rule: &str, engine: &str, setup: &str| -> Result<(), Error> {
            let run = setups::run(&mut study, setup)?;
            if let Some(Some(found)) = run.answers.first() {
                answered.push(Answered::new(index, &instance, rule, engine).found(found, run.micros));
            }
            Ok(())
        };
        for rule in RULES {
            for (engine, _) in ENGINES {
                answer(rule, engine, &format!("{engine}:3:{rule}"))?;
            }
        }
        for suspect in SUSPECTS {
            answer("one", suspect, suspect)?;
        }
        if let Some(work) = plain_astar(&grid, query(&instance)) {
            let (cost, expanded, looked) = (work.cost, work.expanded as f64, Some(work.looked as f64));
            let plain = Answered::new(index, &instance, "never", LIST);
            answered.push(Answered { cost, expanded, looked, ..plain });
        }
    }
    Ok(answered)
}

impl Answered {
    fn new(index: usize, instance: &Instance, rule: &str, engine: &str) -> Self {
        Self {
            start: pair(instance.start),
            goal: pair(instance.goal),
            index,
            optimum: instance.optimal,
            rule: rule.to_owned(),
            engine: engine.to_owned(),
            ..Self::default()
        }
    }

    fn found(self, answer: &PathFigures, micros: Option<f64>) -> Self {
        Self {
            cost: answer.cost,
            moves: answer.moves.into(),
            smoothness: answer.smoothness,
            expanded: answer.counters.expanded as f64,
            scanned: answer.counters.scanned as f64,
            micros,
            ..self
        }
    }
}

/// For each row, how many instances have the printed JPS length, to four digits.
fn alike(map: &Map) -> Result<Vec<Alike>, Error> {
    let rows = published(map);
    if rows.is_empty() {
        return Ok(Vec::new());
    }
    let grid = map.grid()?;
    let queries: Vec<Ends> = map.instances()?.iter().map(query).collect();
    let costs = setups::costs(&setups::run(&mut Study::new(&grid, &queries, 0), "jps-block:3:one")?);
    let count = |row: &Published| costs.iter().filter(|&&cost| (cost - row.jps).abs() < 5.1e-5).count();
    Ok(rows.iter().map(|row| Alike { start: row.start, goal: row.goal, one: count(row) as u64 }).collect())
}
