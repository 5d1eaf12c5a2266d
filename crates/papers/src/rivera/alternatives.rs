//! Other choices that the published program may have made: ties, long moves, jump points, and swamp.

mod pages;

use std::sync::Arc;

use mediant_bench::Study;
use mediant_formats::{MapFile, Tiles};
use mediant_grid::{Centers, CornerRule, Grid, GridGraph};
use mediant_moves::FiniteK;
use mediant_report::{Column, Row};
use mediant_search::Ends;
use serde::{Deserialize, Serialize};

pub(crate) use pages::CAUSES;
pub(super) use pages::show;

use super::{searches::KS, tables};
use crate::{
    Error,
    context::{Context, How},
    experiment::Findings,
    maps::Map,
    plain::{Choices, Estimate, Expands, Found, Legal, Plain, Ties},
    setups::run,
};

/// The engine's choices.
const ENGINE: Choices = Choices {
    estimate: Estimate::Hk,
    ties: Ties::NearerFirst,
    legal: Legal::Segment,
    expands: Expands::Everywhere,
};
const EUCLIDEAN: Choices = Choices { estimate: Estimate::Euclidean, ..ENGINE };
const F_ALONE: Choices = Choices { ties: Ties::Unordered, ..ENGINE };
const CANONICAL: Choices = Choices { expands: Expands::Corners, ..ENGINE };

/// The programs by their names, and what they choose.
const PROGRAMS: [(&str, Choices); 9] = [
    ("A*", ENGINE),
    ("A*, f alone", F_ALONE),
    ("A*, rectangles", Choices { legal: Legal::Rectangle, ..ENGINE }),
    ("A*, Euclidean", EUCLIDEAN),
    ("A*, Euclidean, f alone", Choices { estimate: Estimate::Euclidean, ..F_ALONE }),
    ("canonical A*", CANONICAL),
    ("canonical A*, f alone", Choices { expands: Expands::Corners, ..F_ALONE }),
    ("canonical A*, Euclidean", Choices { expands: Expands::Corners, ..EUCLIDEAN }),
    ("canonical A*, Euclidean, around corners", Choices { expands: Expands::AroundCorners, ..EUCLIDEAN }),
];
/// On StarCraft, where a search is long, the programs whose jump points the paper lets compare, at this k.
const COMPARED_ON_STARCRAFT: [&str; 3] =
    ["A*, Euclidean", "canonical A*, Euclidean", "canonical A*, Euclidean, around corners"];
const K_ON_STARCRAFT: u32 = 7;
/// With swamp blocked, and free, at this k.
const K_OF_SWAMP: u32 = 3;
const SWAMP: [(&str, &str); 2] = [("free", "GS."), ("blocked", "G.")];

/// Sums over the problems of a map.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
struct Part {
    problems: f64,
    cost: f64,
    moves: f64,
    expanded: f64,
    percolations: f64,
}

impl Part {
    fn add(&mut self, found: Found) {
        self.problems += 1.0;
        self.cost += found.cost;
        self.moves += f64::from(found.moves);
        self.expanded += found.expanded as f64;
        self.percolations += found.percolations as f64;
    }

    fn sum(parts: impl Iterator<Item = Self>) -> Self {
        parts.fold(Self::default(), |a, b| Self {
            problems: a.problems + b.problems,
            cost: a.cost + b.cost,
            moves: a.moves + b.moves,
            expanded: a.expanded + b.expanded,
            percolations: a.percolations + b.percolations,
        })
    }

    fn row(self, row: Row) -> Row {
        let mean = |sum: f64| (self.problems > 0.0).then(|| sum / self.problems);
        row.with("problems", self.problems)
            .with("cost", mean(self.cost))
            .with("moves", mean(self.moves))
            .with("expanded", mean(self.expanded))
            .with("percolations", mean(self.percolations))
    }
}

/// The programs that run on a set, with their k.
fn searches(set: &str) -> Vec<(&'static str, Choices, u32)> {
    let on_starcraft = set == "sc1";
    let is_asked =
        |name: &str, k| !on_starcraft || k == K_ON_STARCRAFT && COMPARED_ON_STARCRAFT.contains(&name);
    let all = PROGRAMS.into_iter().flat_map(|(name, choices)| KS.map(|k| (name, choices, k)));
    all.filter(|&(name, _, k)| is_asked(name, k)).collect()
}

/// The number of problems of a map: the first ones of the tables', since their order is random.
fn problems(context: &Context<'_>, set: &str) -> usize {
    if set == "sc1" { context.quick_or(1, 6) } else { 2 }
}

pub(super) fn measure(context: &Context<'_>) -> Result<Findings, Error> {
    let (mut rows, mut count, mut instances) = (Vec::new(), 0, 0.0);
    for set in context.sets() {
        let maps = tables::maps(context, set)?;
        count += maps.len();
        if set != "wc3maps512" {
            let parts = context.each("programs", How::Counted, &maps, |map| programs(context, map))?;
            for (at, (name, _, k)) in searches(set).into_iter().enumerate() {
                let sum = Part::sum(parts.iter().map(|part| part[at]));
                instances += if at == 0 { sum.problems } else { 0.0 };
                rows.push(sum.row(Row::new().key("set", set).key("program", name).key("k", k)));
            }
        }
        if matches!(set, "wc3maps512" | "bundled") {
            let parts = context.each("swamp", How::Counted, &maps, |map| swamp(context, map))?;
            let names = SWAMP.into_iter().flat_map(|(name, _)| ["A*", "A*, Euclidean"].map(|a| (a, name)));
            for (at, (name, swamp)) in names.enumerate() {
                let sum = Part::sum(parts.iter().map(|part| part[at]));
                instances += if at % 2 == 0 { sum.problems } else { 0.0 };
                let name = format!("{name}, swamp {swamp}");
                rows.push(sum.row(Row::new().key("set", set).key("program", name).key("k", K_OF_SWAMP)));
            }
        }
    }
    let drawn =
        "the first random problems of each map in the tables: 2 of BG, 6 of StarCraft; all 50 of WC3, \
                 and 50 more with swamp blocked"
            .to_owned();
    let (columns, instances) = (columns(), instances as u64);
    Ok(Findings { columns, rows, maps: count, instances, drawn, seeded: true })
}

fn columns() -> Vec<Column> {
    vec![
        Column::key("set", "the set of maps"),
        Column::key("program", "the search, and what it chooses otherwise than the engine"),
        Column::key("k", "the neighborhood has 2^k moves"),
        Column::count("problems", "", "problems"),
        Column::count("cost", "cells", "mean length of a path"),
        Column::count("moves", "", "mean number of moves of a path"),
        Column::count("expanded", "", "mean number of expansions"),
        Column::count("percolations", "", "mean number of swaps in the heap"),
    ]
}

/// The sums of each program on a map.
fn programs(context: &Context<'_>, map: &Map) -> Result<Vec<Part>, Error> {
    let grid = map.grid()?;
    let queries = tables::queries(context, map, &grid, problems(context, &map.set))?;
    let one = |(name, choices, k): (&str, Choices, u32)| {
        let wrong =
            |wrong: &dyn std::fmt::Display| Error::Reproduce(format!("{}, {name}: {wrong}", map.name));
        let k = FiniteK::new(k).map_err(|error| wrong(&error))?;
        let graph = GridGraph::<Centers>::new(Arc::clone(&grid), k, CornerRule::Never);
        let graph = graph.map_err(|error| wrong(&error))?;
        let (mut plain, mut part) = (Plain::new(&graph, choices), Part::default());
        for &query in &queries {
            part.add(plain.solve(query).ok_or_else(|| wrong(&"a problem with a path and no answer"))?);
        }
        Ok(part)
    };
    searches(&map.set).into_iter().map(one).collect()
}

/// With swamp free and blocked: A* with h_k, and with the Euclidean heuristic.
fn swamp(context: &Context<'_>, map: &Map) -> Result<Vec<Part>, Error> {
    let mut parts = Vec::new();
    for (_, free) in SWAMP {
        let grid = with_free(map, free)?;
        let queries = tables::queries(context, map, &grid, context.quick_or(20, 50))?;
        for option in ["", ",euclidean"] {
            parts.push(by_engine(&grid, &queries, &format!("astar:{K_OF_SWAMP}:never{option}"))?);
        }
    }
    Ok(parts)
}

/// A map on which the cells with these characters are free.
fn with_free(map: &Map, free: &str) -> Result<Arc<Grid>, Error> {
    let wrong = |wrong: &dyn std::fmt::Display| Error::Reproduce(format!("{}: {wrong}", map.name));
    let tiles = Tiles::new(Some(free), None).map_err(|error| wrong(&error))?;
    let text = std::fs::read(&map.path).map_err(Error::at(&map.path))?;
    Ok(Arc::new(MapFile::from_bytes(text, tiles).map_err(|error| wrong(&error))?.to_grid()))
}

fn by_engine(grid: &Arc<Grid>, queries: &[Ends], setup: &str) -> Result<Part, Error> {
    let mut part = Part::default();
    for answer in run(&mut Study::new(grid, queries, 0), setup)?.answers {
        let answer = answer.ok_or_else(|| Error::Reproduce(format!("{setup}: no answer")))?;
        let (expanded, percolations) = (answer.counters.expanded, answer.counters.percolations);
        part.add(Found { cost: answer.cost, moves: answer.moves, expanded, percolations });
    }
    Ok(part)
}
