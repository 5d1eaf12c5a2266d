//! Figures 8 to 13: six engines over all street maps, under two rules.

pub(super) mod pages;

use mediant_bench::Study;
use mediant_report::{Column, Row};
use mediant_search::Ends;
use serde::{Deserialize, Serialize};

use crate::{
    Error,
    context::{Context, How},
    experiment::Findings,
    maps::Map,
    setups::{self, Sums},
};

/// The corner rules: that of the scenarios and the paper's A*, and that of its JPS.
const RULES: [&str; 2] = ["never", "one"];
/// The engines, and what the page calls them.
const ENGINES: [(&str, &str); 6] = [
    ("astar", "A*"),
    ("jps", "JPS"),
    ("jps-block", "block JPS"),
    ("jps-plus", "JPS+"),
    ("dijkstra", "Dijkstra"),
    ("wavefront", "wavefront"),
];
/// Of the scenario of a map of side 256, one of so many instances is asked.
const EVERY: u32 = 27;
/// A quick run takes one of so many maps of a size, and one of so many of the instances.
const SPARSE: (usize, usize) = (10, 3);

/// The sums on a map, in the order of [`RULES`] and [`ENGINES`].
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Part {
    side: u32,
    sums: Vec<Sums>,
}

/// Answers an even sample of each map's scenario by each engine under each rule.
pub(super) fn measure(ctx: &Context<'_>) -> Result<Findings, Error> {
    let mut maps = Vec::new();
    for set in ctx.sets() {
        maps.extend(sample(ctx.maps(set, usize::MAX)?, ctx.quick_or(SPARSE.0, 1)));
    }
    let (passes, sparse) = (ctx.passes(), ctx.quick_or(SPARSE.1, 1));
    let parts = ctx.each("maps", How::Timed, &maps, |map| part(map, passes, sparse))?;
    let mut rows = Vec::new();
    for (map, part) in maps.iter().zip(&parts) {
        let setups = RULES.into_iter().flat_map(|rule| ENGINES.map(|(engine, _)| (rule, engine)));
        rows.extend(
            setups.zip(&part.sums).map(|((rule, engine), sums)| row(part.side, map, rule, engine, sums)),
        );
    }
    let every = [256, 512, 1024].map(|side| every(side, sparse).to_string());
    Ok(Findings {
        columns: columns(),
        rows,
        maps: maps.len(),
        instances: parts.iter().filter_map(|part| part.sums.first()).map(|sums| sums.queries).sum(),
        drawn: format!(
            "of the scenarios, which are sorted by length, one instance in {} on maps of 256 × 256 cells, in \
             {} on 512 × 512, in {} on 1024 × 1024, the same for all engines",
            every[0], every[1], every[2]
        ),
        seeded: false,
    })
}

/// An even sample of the maps of each size. A map's name ends in its size.
fn sample(maps: Vec<Map>, every: usize) -> Vec<Map> {
    let size = |map: &Map| map.name.rsplit('_').next().unwrap_or_default().to_owned();
    let mut seen: Vec<(String, usize)> = Vec::new();
    let mut sampled = Vec::new();
    for map in maps {
        let size = size(&map);
        let at = seen.iter().position(|(other, _)| *other == size).unwrap_or_else(|| {
            seen.push((size, 0));
            seen.len() - 1
        });
        if seen[at].1.is_multiple_of(every) {
            sampled.push(map);
        }
        seen[at].1 += 1;
    }
    sampled
}

/// The step between the instances that are asked on a map of that side. It grows with the number of cells, so
/// that each size takes about as long.
fn every(side: u32, sparse: usize) -> usize {
    let area = u64::from(side).pow(2) * u64::from(EVERY) / 256_u64.pow(2);
    usize::try_from(area).unwrap_or(usize::MAX).saturating_mul(sparse).max(1)
}

fn part(map: &Map, passes: u32, sparse: usize) -> Result<Part, Error> {
    let grid = map.grid()?;
    let side = grid.width().max(grid.height());
    let every = every(side, sparse);
    // From the middle of the first group, so that the shortest queries weigh no more than the longest.
    let instances = map.instances()?.into_iter().skip(every / 2).step_by(every);
    let queries: Vec<Ends> = instances
        .filter(|instance| instance.start != instance.goal)
        .map(|instance| Ends::new(instance.start, instance.goal))
        .collect();
    let mut study = Study::new(&grid, &queries, passes);
    let mut sums = Vec::new();
    for rule in RULES {
        for (engine, _) in ENGINES {
            let run = setups::run(&mut study, &format!("{engine}:3:{rule}"))?;
            sums.push(Sums::of(&run, &[]));
        }
    }
    Ok(Part { side, sums })
}

fn columns() -> Vec<Column> {
    vec![
        Column::key("size", "cells of a side of the map, the longer one"),
        Column::key("map", "the map"),
        Column::key("rule", "the corner rule"),
        Column::key("engine", "the engine, k = 3 at centers"),
        Column::count("queries", "", "queries"),
        Column::count("found", "", "queries that were answered by a path; means are over these"),
        Column::count("cost", "cells", "mean length of a path"),
        Column::count("smoothness", "degrees", "mean sum of the angles by which a path turns"),
        Column::count("expanded", "", "mean number of nodes expanded"),
        Column::count("scanned", "", "mean number of vertices looked at by jumps"),
        Column::count("bytes", "bytes", "size of what is prepared of a map, beyond the map"),
        Column::time("micros", "µs", "mean time of a query"),
        Column::time("preparation", "s", "time to prepare a map"),
    ]
}

fn row(side: u32, map: &Map, rule: &str, engine: &str, sums: &Sums) -> Row {
    let mean = |sum: f64, of: u64| (of > 0).then(|| sum / of as f64);
    let found = |sum: f64| mean(sum, sums.found);
    Row::new()
        .key("size", side)
        .key("map", &map.name)
        .key("rule", rule)
        .key("engine", engine)
        .with("queries", sums.queries as f64)
        .with("found", sums.found as f64)
        .with("cost", found(sums.cost))
        .with("smoothness", found(sums.smoothness))
        .with("expanded", found(sums.expanded))
        .with("scanned", found(sums.scanned).filter(|&scanned| scanned > 0.0))
        .with("bytes", (engine == "jps-plus").then_some(sums.bytes))
        .with("micros", mean(sums.micros, sums.timed))
        .with("preparation", (engine == "jps-plus").then_some(sums.seconds))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    #[test]
    fn each_size_is_sampled() {
        let names = ["A_0_1024", "A_0_256", "A_0_512", "A_1_1024", "A_1_256", "A_1_512", "A_2_256", "cave"];
        let maps = names.map(|name| Map::new("street", Path::new(&format!("{name}.map")))).to_vec();
        let names =
            |every| sample(maps.clone(), every).into_iter().map(|map| map.name).collect::<Vec<String>>();
        assert_eq!(names(1).len(), 8);
        assert_eq!(names(2), ["A_0_1024", "A_0_256", "A_0_512", "A_2_256", "cave"]);
    }

    #[test]
    fn larger_maps_are_asked_less() {
        assert_eq!([256, 512, 1024].map(|side| every(side, 1)), [27, 108, 432]);
        assert_eq!((every(512, 3), every(10, 1), every(72, 1)), (324, 1, 2));
    }
}
