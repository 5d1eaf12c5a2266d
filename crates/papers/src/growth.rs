//! How time and memory grow with the map: maps, tiled.

use std::sync::Arc;

use mediant_bench::{Kept, Run, Study};
use mediant_grid::{Grid, Rules};
use mediant_report::{Axis, Chart, Column, Mark, Record, Row, Series, Table, number, thousands};
use serde::{Deserialize, Serialize};

use super::{
    context::{Context, How},
    experiment::{Experiment, Findings, Page, Section},
    maps::{Map, random_queries},
    setups::{Sums, run, setup},
};
use crate::Error;

/// Time and memory on maps that grow.
pub(super) const GROWTH: Experiment = Experiment {
    id: "growth",
    page: Page::Beyond,
    title: "How time and memory grow with the map",
    sets: &["street"],
    measure,
    show,
};

/// A map that is tiled, and what is measured on it.
struct Family {
    /// The map. Its streets lead to its borders, so that the tiles are connected.
    map: &'static str,
    /// How many times it is repeated along each side.
    tiles: &'static [u32],
    /// The queries on each.
    queries: usize,
    /// Whether the page says the time per waypoint.
    is_told_by_waypoint: bool,
    setups: &'static [&'static str],
}

/// Every engine; and, over a map as large as maps of games are, those that answer a query in the shortest
/// time, with more queries, since a few microseconds are hard to measure.
const FAMILIES: [Family; 2] = [
    Family {
        map: "Berlin_0_256",
        tiles: &[1, 2, 4, 8],
        queries: 20,
        is_told_by_waypoint: false,
        setups: &[
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
            ANY_ANGLE,
            LABELS,
            CONTRACTED,
        ],
    },
    Family {
        map: "Moscow_2_1024",
        tiles: &[1, 2, 4],
        queries: 200,
        is_told_by_waypoint: true,
        setups: &[
            "jps-block:3:never",
            "jps-plus:3:never",
            "subgoal:3:never",
            "subgoal:3:never,levels=contracted",
            "anya:any:open",
            ANY_ANGLE,
            LABELS,
            CONTRACTED,
        ],
    },
];
const ANY_ANGLE: &str = "subgoal:any:open";
/// Hub labels, whatever memory they take, so that large maps have them too.
const LABELS: &str = "subgoal:any:open,levels=labels";
const CONTRACTED: &str = "subgoal:any:open,levels=contracted";
/// The bundled map that stands in for the first where the set is not there.
const BUNDLED: &str = "town";

/// A grid repeated `times` times along each side.
fn tiled(grid: &Grid, times: u32) -> Result<Grid, Error> {
    let (width, height) = (grid.width(), grid.height());
    let blocked = |x: u32, y: u32| !grid.is_free((x % width) as i32, (y % height) as i32);
    Grid::from_fn(width * times, height * times, blocked).map_err(|wrong| Error::Reproduce(wrong.to_string()))
}

/// A setup's times and memory on the tiled map.
#[derive(Serialize, Deserialize)]
struct OnTiles {
    cells: f64,
    sums: Sums,
    /// The mean number of waypoints of a path.
    waypoints: Option<f64>,
    kept: Option<Kept>,
}

impl OnTiles {
    fn new(grid: &Grid, run: &Run) -> Self {
        let sums = Sums::of(run, &[]);
        let waypoints = run.answers.iter().flatten().map(|answer| f64::from(answer.waypoints)).sum::<f64>();
        Self {
            cells: f64::from(grid.width()) * f64::from(grid.height()),
            sums,
            waypoints: (sums.found > 0).then(|| waypoints / sums.found as f64),
            kept: run.preparation.kept,
        }
    }

    fn row(&self, row: Row) -> Row {
        let row = self.kept.iter().fold(row, |row, kept| row.key("kept", kept.name()));
        self.sums.row(row.with("cells", self.cells).with("waypoints", self.waypoints))
    }
}

fn measure(context: &Context<'_>) -> Result<Findings, Error> {
    let (mut rows, mut instances, mut maps_in_all, mut drawn) = (Vec::new(), 0, 0, Vec::new());
    // A quick run takes smaller maps; a bundled map stands in for the first family alone.
    let (families, quick) = (if context.is_bundled() { 1 } else { FAMILIES.len() }, context.quick_or(2, 0));
    for family in FAMILIES.iter().take(families) {
        let named = context.named("street", &[family.map])?;
        let maps: Vec<Map> =
            named.iter().filter(|map| !context.is_bundled() || map.name == BUNDLED).cloned().collect();
        let tiles = &family.tiles[..family.tiles.len() - quick];
        let count = context.quick_or(8, family.queries);
        for &times in tiles {
            let step = format!("{times}x{times}");
            let on_map = |map: &Map| on_tiles(context, map, times, count, family.setups);
            for (map, measured) in maps.iter().zip(context.each(&step, How::Timed, &maps, on_map)?) {
                for (setup, one) in family.setups.iter().zip(&measured) {
                    let row = Row::new().key("map", &map.name).key("tiles", times).key("setup", setup);
                    rows.push(one.row(row));
                }
                instances += measured.first().map_or(0, |one| one.sums.queries);
            }
        }
        maps_in_all += tiles.len();
        let name = maps.first().map_or(family.map, |map| map.name.as_str());
        let most = tiles.last().unwrap_or(&1);
        drawn.push(format!("{name} tiled 1 × 1 to {most} × {most}, {count} solvable queries on each"));
    }
    let mut columns = vec![
        Column::key("map", "the map"),
        Column::key("tiles", "how many times the map stands along each side"),
        Column::key("setup", "the engine with its options"),
        Column::key("kept", "what engine subgoal keeps: labels, contraction, or nothing where that is best"),
        Column::count("cells", "", "cells of the map"),
        Column::count("waypoints", "", "mean number of waypoints of a path, with both ends"),
    ];
    columns.extend(Sums::columns());
    let drawn = format!("{}, drawn at random", drawn.join("; "));
    Ok(Findings { columns, rows, maps: maps_in_all, instances, drawn, seeded: true })
}

fn on_tiles(
    context: &Context<'_>,
    map: &Map,
    times: u32,
    count: usize,
    setups: &[&str],
) -> Result<Vec<OnTiles>, Error> {
    let grid = Arc::new(tiled(map.grid()?.as_ref(), times)?);
    let reference = setup("astar:3:never")?;
    let space = reference
        .space(&mediant::Map::from(Arc::clone(&grid)))
        .map_err(|wrong| Error::Reproduce(wrong.to_string()))?;
    let rules: Rules = reference.rules();
    let connected = |query: mediant_search::Ends| space.connected(query.start, query.goal);
    let queries = random_queries(&mut context.rng(map), &grid, rules, count, connected);
    let mut study = Study::new(&grid, &queries, context.passes());
    setups.iter().map(|text| Ok(OnTiles::new(&grid, &run(&mut study, text)?))).collect()
}

fn show(record: &Record) -> Section {
    let mut section = Section::default();
    section.text(
        "Queries are drawn over the whole map, so that paths grow with its sides. Memory counts what an \
         engine prepares besides the map: search graph and index. The scratch of a search comes on top; for \
         engines on the grid graph it is 16 to 24 bytes a vertex.",
    );
    section.text(
        "`subgoal` keeps hub labels where they fit its budget, 48 bytes a cell but at least 32 MB here, else a \
         contraction hierarchy; `levels=labels` allows any amount, and `levels=contracted` always keeps a contraction. \
         In the tables `*` marks a contraction in place of labels, `†` a map on which nothing is kept and \
         another engine searches.",
    );
    for map in record.distinct("map") {
        section.heading(&format!("{map}, tiled"));
        let by_waypoint = FAMILIES.iter().any(|family| family.map == map && family.is_told_by_waypoint);
        if by_waypoint {
            section.text(
                "A path has more waypoints on a larger map. The time per waypoint says what is left of the \
                 growth besides.",
            );
        }
        for measure in MEASURES.into_iter().filter(|measure| by_waypoint || measure.word != WAYPOINT) {
            let (title, word) = (measure.title, measure.word);
            section.figure(
                &format!("growth-{map}-{word}"),
                &format!("{title} of each engine by the size of the map, {map} tiled"),
                chart(record, map, measure).svg(),
            );
            section.table(&table(record, map, measure));
        }
    }
    section
}

/// A quantity of the rows that is shown.
#[derive(Clone, Copy)]
struct Measure {
    word: &'static str,
    title: &'static str,
    unit: &'static str,
    of: fn(&Row) -> Option<f64>,
    /// Whether the table says by how much it grows from the first tile to the last.
    is_compared: bool,
}

const WAYPOINT: &str = "waypoint";
const MEASURES: [Measure; 4] = [
    Measure {
        word: "time",
        title: "Time of a query",
        unit: "mean time of a query, µs",
        of: |row| row.number("micros"),
        is_compared: false,
    },
    Measure {
        word: WAYPOINT,
        title: "Time of a query per waypoint",
        unit: "mean time of a query over the mean number of waypoints, µs",
        of: |row| Some(row.number("micros")? / row.number("waypoints")?),
        is_compared: true,
    },
    Measure {
        word: "memory",
        title: "Memory",
        unit: "prepared, MB",
        of: |row| Some(1e-6 * row.number("bytes")?),
        is_compared: false,
    },
    Measure {
        word: "preparation",
        title: "Preparation",
        unit: "time to prepare, ms",
        of: |row| Some(1e3 * row.number("preparation")?),
        is_compared: false,
    },
];

/// The different texts of a key column on a map.
fn distinct<'a>(record: &'a Record, map: &str, column: &str) -> Vec<&'a str> {
    let mut texts: Vec<&str> = Vec::new();
    for row in record.rows.iter().filter(|row| row.text("map") == map) {
        if !texts.contains(&row.text(column)) {
            texts.push(row.text(column));
        }
    }
    texts
}

fn chart(record: &Record, map: &str, measure: Measure) -> Chart {
    let instances: f64 = distinct(record, map, "tiles")
        .iter()
        .filter_map(|tiles| record.number(&[("map", map), ("tiles", tiles)], "queries"))
        .sum();
    let mut chart = Chart::new(
        format!("{} by the size of the map", measure.title),
        Axis::new("cells of the map").log(),
        Axis::new(measure.unit).log(),
    )
    .note(format!("{map}, tiled; {} queries in all", thousands(instances)));
    for setup in distinct(record, map, "setup") {
        let point = |row: &Row| Some((row.number("cells")?, (measure.of)(row)?));
        let points: Vec<(f64, f64)> =
            record.select(&[("map", map), ("setup", setup)]).filter_map(point).collect();
        if !points.is_empty() {
            // With spaces at which the legend may break it.
            chart.push(Series::new(setup.replace(',', ", "), Mark::Line, points));
        }
    }
    chart
}

fn table(record: &Record, map: &str, measure: Measure) -> Table {
    let tiles = distinct(record, map, "tiles");
    let heading = tiles.iter().map(|tiles| format!("{tiles} × {tiles}"));
    let growth = match tiles.as_slice() {
        [first, .., last] if measure.is_compared => {
            Some((*first, *last, format!("{last} × {last} over {first} × {first}")))
        }
        _ => None,
    };
    let heading = [measure.unit.to_owned()].into_iter().chain(heading);
    let mut table = Table::new(heading.chain(growth.iter().map(|(.., name)| name.clone())));
    for setup in distinct(record, map, "setup") {
        let row = |tiles: &str| {
            record.rows.iter().find(|row| row.is(&[("map", map), ("tiles", tiles), ("setup", setup)]))
        };
        let value = |tiles: &str| row(tiles).and_then(measure.of);
        let cell = |tiles: &&str| {
            let is_default = !setup.contains("levels=");
            let mark = match row(tiles).map(|row| row.text("kept")) {
                Some(kept) if kept == Kept::Contraction.name() && is_default => "*",
                Some(kept) if kept == Kept::Nothing.name() => "†",
                _ => "",
            };
            value(tiles).map_or("–".to_owned(), |value| format!("{}{mark}", number(value)))
        };
        let ratio = growth.iter().map(|(first, last, _)| {
            let ratio = value(last).zip(value(first)).map(|(last, first)| last / first);
            ratio.map_or("–".to_owned(), number)
        });
        table.row([format!("`{setup}`")].into_iter().chain(tiles.iter().map(cell)).chain(ratio));
    }
    table
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

    #[test]
    fn times_are_told_per_waypoint_and_by_what_is_kept() {
        let row = |tiles: u32, kept: Kept, micros: f64, waypoints: f64| {
            let row = Row::new().key("map", "m").key("tiles", tiles).key("setup", ANY_ANGLE);
            row.key("kept", kept.name()).with("micros", micros).with("waypoints", waypoints)
        };
        let rows = vec![row(1, Kept::Labels, 2.0, 4.0), row(4, Kept::Contraction, 9.0, 12.0)];
        let provenance = mediant_report::Provenance::default();
        let (id, title) = ("growth".to_owned(), String::new());
        let record = Record { id, title, provenance, columns: Vec::new(), rows };
        let text = table(&record, "m", MEASURES[1]).markdown();
        assert!(text.contains("| 1 × 1 | 4 × 4 | 4 × 4 over 1 × 1 |"), "{text}");
        assert!(text.contains("| `subgoal:any:open` | 0.500 | 0.750* | 1.50 |"), "{text}");
        assert_eq!(distinct(&record, "m", "tiles"), ["1", "4"]);
    }
}
