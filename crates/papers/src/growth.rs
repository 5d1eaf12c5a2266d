//! How time and memory grow with the map: one map, tiled.

use std::sync::Arc;

use mediant_bench::Study;
use mediant_grid::{Grid, Rules};
use mediant_report::{Axis, Chart, Column, Mark, Record, Row, Series, Table, number, thousands};

use super::{
    context::{Context, How},
    experiment::{Experiment, Findings, Page, Section},
    maps::{Map, random_queries},
    setups::{Sums, run, setup},
};
use crate::Error;

/// Time and memory on a map that grows.
pub(super) const GROWTH: Experiment = Experiment {
    id: "growth",
    page: Page::Beyond,
    title: "How time and memory grow with the map",
    sets: &["street"],
    measure,
    show,
};

/// The map that is tiled: its streets lead to its borders, so that the tiles are connected.
const MAP: &str = "Berlin_0_256";
/// The bundled map that stands in for it where the set is not there.
const BUNDLED: &str = "town";
/// How many times the map is repeated along each side.
const TILES: [u32; 4] = [1, 2, 4, 8];
const SETUPS: [&str; 11] = [
    "astar:3:never",
    "canonical:3:never",
    "jps-block:3:never",
    "jps-plus:3:never",
    "hpa:3:never",
    "chpa:3:never",
    "subgoal:3:never",
    "theta:3:open",
    "anya:any:open",
    "subgoal:5:open",
    "subgoal:any:open",
];

/// A grid repeated `times` times along each side.
fn tiled(grid: &Grid, times: u32) -> Result<Grid, Error> {
    let (width, height) = (grid.width(), grid.height());
    let blocked = |x: u32, y: u32| !grid.is_free((x % width) as i32, (y % height) as i32);
    Grid::from_fn(width * times, height * times, blocked).map_err(|wrong| Error::Reproduce(wrong.to_string()))
}

fn measure(context: &Context<'_>) -> Result<Findings, Error> {
    let named = context.named("street", &[MAP])?;
    let maps: Vec<Map> =
        named.iter().filter(|map| !context.is_bundled() || map.name == BUNDLED).cloned().collect();
    let (tiles, count) = context.quick_or((&TILES[..3], 8), (&TILES[..], 20));
    let (mut rows, mut instances) = (Vec::new(), 0);
    for &times in tiles {
        let step = format!("{times}x{times}");
        for (cells, measured) in
            context.each(&step, How::Timed, &maps, |map| on_tiles(context, map, times, count))?
        {
            for (setup, sums) in SETUPS.iter().zip(&measured) {
                let row = Row::new().key("tiles", times).key("setup", setup).with("cells", cells);
                rows.push(sums.row(row));
            }
            instances += measured.first().map_or(0, |sums| sums.queries);
        }
    }
    let mut columns = vec![
        Column::key("tiles", "how many times the map stands along each side"),
        Column::key("setup", "the engine with its options"),
        Column::count("cells", "", "cells of the map"),
    ];
    columns.extend(Sums::columns());
    let name = maps.first().map_or(MAP, |map| map.name.as_str());
    let drawn = format!(
        "{name} tiled 1 × 1 to {0} × {0}, {count} solvable queries drawn at random on each",
        tiles.last().unwrap_or(&1)
    );
    Ok(Findings { columns, rows, maps: tiles.len(), instances, drawn, seeded: true })
}

fn on_tiles(context: &Context<'_>, map: &Map, times: u32, count: usize) -> Result<(f64, Vec<Sums>), Error> {
    let grid = Arc::new(tiled(map.grid()?.as_ref(), times)?);
    let reference = setup(SETUPS[0])?;
    let space = reference
        .space(&mediant::Map::from(Arc::clone(&grid)))
        .map_err(|wrong| Error::Reproduce(wrong.to_string()))?;
    let rules: Rules = reference.rules;
    let connected = |query: mediant_search::Query| space.connected(query.start, query.goal);
    let queries = random_queries(&mut context.rng(map), &grid, rules, count, connected);
    let mut study = Study::new(&grid, &queries, context.passes());
    let sums =
        SETUPS.iter().map(|text| Ok(Sums::of(&run(&mut study, text)?, &[]))).collect::<Result<_, Error>>()?;
    Ok((f64::from(grid.width()) * f64::from(grid.height()), sums))
}

fn show(record: &Record) -> Section {
    let mut section = Section::default();
    section.text(
        "Queries are drawn over the whole map, so that paths grow with its sides. Memory counts what an \
         engine prepares besides the map: search graph and index. The scratch of a search comes on top; for \
         engines on the grid graph it is 16 to 24 bytes a vertex.",
    );
    for (column, scale, label, title) in [
        ("micros", 1.0, "mean time of a query, µs", "Time of a query"),
        ("bytes", 1e-6, "prepared, MB", "Memory"),
        ("preparation", 1e3, "time to prepare, ms", "Preparation"),
    ] {
        let mut chart = Chart::new(
            format!("{title} by the size of the map"),
            Axis::new("cells of the map").log(),
            Axis::new(label).log(),
        )
        .note(format!(
            "{}; {} queries in all",
            record.provenance.drawn,
            thousands(record.provenance.instances as f64)
        ));
        for setup in record.distinct("setup") {
            let point = |row: &Row| Some((row.number("cells")?, scale * row.number(column)?));
            let points: Vec<(f64, f64)> = record.select(&[("setup", setup)]).filter_map(point).collect();
            if !points.is_empty() {
                chart.push(Series::new(setup, Mark::Line, points));
            }
        }
        section.figure(
            &format!("growth-{column}"),
            &format!("{title} of each engine by the size of the map"),
            chart.svg(),
        );
    }
    let tiles = record.distinct("tiles");
    let heading =
        ["setup".to_owned()].into_iter().chain(tiles.iter().flat_map(|tiles| {
            [format!("{tiles} × {tiles}, µs"), "MB".to_owned(), "ms to prepare".to_owned()]
        }));
    let mut table = Table::new(heading);
    for setup in record.distinct("setup") {
        let cell = |tiles: &str, column: &str, scale: f64| {
            let value = record.number(&[("tiles", tiles), ("setup", setup)], column);
            value.map_or("–".to_owned(), |value| number(scale * value))
        };
        let cells = tiles.iter().flat_map(|tiles| {
            [cell(tiles, "micros", 1.0), cell(tiles, "bytes", 1e-6), cell(tiles, "preparation", 1e3)]
        });
        table.row([format!("`{setup}`")].into_iter().chain(cells));
    }
    section.table(&table);
    section
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_repeat_the_map() {
        let grid = Grid::from_fn(3, 2, |x, y| (x, y) == (1, 0)).unwrap();
        let twice = tiled(&grid, 2).unwrap();
        assert_eq!((twice.width(), twice.height()), (6, 4));
        let blocked: Vec<(i32, i32)> =
            (0..4).flat_map(|y| (0..6).map(move |x| (x, y))).filter(|&(x, y)| !twice.is_free(x, y)).collect();
        assert_eq!(blocked, [(1, 0), (4, 0), (1, 2), (4, 2)]);
    }
}
