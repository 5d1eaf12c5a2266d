//! Time of a query at any angle against memory: next to nothing prepared, a contraction, hub labels, and EHL.

mod published;

use mediant::Setup;
use mediant_bench::{Baseline, Competitor, Kept, machine_ratio};
use mediant_report::{Axis, Chart, Mark, Record, Row, Series, Table, number, stats, thousands};

use self::published::{POINTS, PROGRAMS, Point};
use super::{
    context::Context,
    experiment::{Experiment, Findings, Page, Section},
    setups::setup,
    side_by_side::{SETS, findings},
};
use crate::Error;

/// Memory against time, at any angle.
pub(super) const MEMORY: Experiment = Experiment {
    id: "memory",
    page: Page::Compared,
    title: "The trade of memory against time, at any angle",
    sets: SETS,
    measure,
    show,
};

/// Hub labels, with no labels of vertices; not `levels=labels`, since noise has none.
const LABELS: &str = "subgoal:any:closed";
const CONTRACTION: &str = "subgoal:any:closed,levels=contracted";
const ANYA: &str = "anya:any:closed";
/// The library within budgets of memory, which it uses.
const BUDGETS: [&str; 5] = [
    "subgoal:any:closed,memory=1MB",
    "subgoal:any:closed,memory=5MB",
    "subgoal:any:closed,memory=20MB",
    "subgoal:any:closed,memory=100MB",
    "subgoal:any:closed,memory=1GB",
];
/// The methods, by the names that the page gives them.
const METHODS: [(&str, &str); 3] = [("hub labels", LABELS), ("contraction", CONTRACTION), ("Anya", ANYA)];

fn measure(context: &Context<'_>) -> Result<Findings, Error> {
    let methods = METHODS.map(|(_, text)| text);
    let paths = methods.iter().chain(&BUDGETS).map(|text| Ok(Competitor::Ours(setup(text)?)));
    let distances = methods.iter().map(|text| Ok(Competitor::Distance(setup(text)?)));
    findings(context, paths.chain(distances).collect::<Result<_, Error>>()?)
}

/// The row of a setup on a map.
fn row_of<'a>(record: &'a Record, map: &str, text: &str) -> Option<&'a Row> {
    let competitor = text.parse::<Setup>().map_or_else(|_| text.to_owned(), |setup| setup.to_string());
    record.rows.iter().find(|row| row.is(&[("map", map), ("competitor", &competitor)]))
}

/// The row of a setup on a map; of hub labels only where there are some.
fn on<'a>(record: &'a Record, map: &str, text: &str) -> Option<&'a Row> {
    row_of(record, map, text).filter(|row| text != LABELS || row.text("kept") == Kept::Labels.name())
}

/// The number in a column of such a row.
fn of(record: &Record, map: &str, text: &str, column: &str) -> Option<f64> {
    on(record, map, text)?.number(column)
}

/// The time of the distance alone.
fn distance(record: &Record, map: &str, text: &str) -> Option<f64> {
    let setup = on(record, map, text)?.text("competitor");
    let competitor = format!("distance of {setup}");
    record.number(&[("map", map), ("competitor", &competitor)], "micros")
}

/// How much slower the machine of the record is than that on which EHL ran.
fn scale(record: &Record, map: &str) -> Option<f64> {
    let here = |one: Baseline| record.number(&[("map", map), ("competitor", one.name())], "micros");
    machine_ratio(here, |one| published::baseline(one, map))
}

fn show(record: &Record) -> Section {
    let mut section = Section::default();
    section.text(
        "All methods find shortest paths at any angle between corners, gaps closed. Anya prepares little. A \
         contraction hierarchy and hub labels are made from the same subgoals; hub labels store what a \
         search in the hierarchy would find. The index is what is kept beyond the map and its search space.",
    );
    section.text(
        "EHL (Du, Shen & Cheema 2023) stores hub labels for regions of cells: of 1 × 1 cells (EHL-1), 4 × 4 \
         and 16 × 16 cells; EHL* merges regions until the labels take 20 or 5 % of what EHL-1 takes. Its \
         programs ran beside Mediant on the same machine and day, on the nine maps on which EHL-1 can be \
         built in minutes. Their times are **scaled** through the two crates that were measured then and \
         with this record, map by map, as above. Lower and further to the left is better.",
    );
    section.figure("memory-time", "Time of a query over the size of the index", chart(record).svg());
    section.text(
        "With the option `memory` Mediant uses what it may: what hub labels leave goes to labels of vertices. \
         The means over those nine maps are a curve:",
    );
    section.figure("memory-curve", "Time within budgets of memory", curve(record).svg());
    section.heading("Map by map");
    section.text(
        "MB of the index, ms to prepare (all cores), µs of a query with its path, and of the distance alone. \
         A dash: the contraction does not come to its end on that map, so there are no hub labels.",
    );
    section.table(&by_map(record));
    section.heading("Within a budget");
    section.text(
        "The option `memory` says how much hub labels may take. Where they take more, a contraction is kept, \
         and where that would be slower than Anya, nothing. What they leave goes to labels of vertices. The \
         last row is the default: hub labels may take 64 bytes a cell, but at least 48 MB and at most 1 GB, \
         and vertices have no labels.",
    );
    section.table(&budgets(record));
    section.heading("Beside EHL");
    section.text(
        "Scaled times of EHL, and on the same map that of Mediant within the largest of the budgets above of \
         which it takes no more memory than EHL; where each takes more, the hub labels alone. Below 1 ours is \
         faster, or smaller.",
    );
    section.table(&beside(record));
    section
}

fn chart(record: &Record) -> Chart {
    let provenance = &record.provenance;
    let mut chart = Chart::new(
        "Memory against time, at any angle",
        Axis::new("index, MB").log(),
        Axis::new("mean time of a query, µs").log(),
    )
    .note(format!(
        "one mark per map: {} maps, {} instances; with paths; EHL scaled to this machine",
        provenance.maps,
        thousands(provenance.instances as f64)
    ));
    let maps = record.distinct("map");
    for (name, text) in METHODS {
        let point =
            |map: &&str| Some((of(record, map, text, "index")? / 1e6, of(record, map, text, "micros")?));
        let points: Vec<(f64, f64)> = maps.iter().filter_map(point).collect();
        if !points.is_empty() {
            chart.push(Series::new(name, Mark::Points, points));
        }
    }
    let alone = |map: &&str| Some((of(record, map, LABELS, "index")? / 1e6, distance(record, map, LABELS)?));
    let alone: Vec<(f64, f64)> = maps.iter().filter_map(alone).collect();
    if !alone.is_empty() {
        // The mark of the hub labels, hollow.
        chart.push(Series::new("hub labels, distance alone", Mark::Points, alone).style(0).hollow());
    }
    for program in PROGRAMS {
        let points = POINTS.iter().filter(|point| point.program == program);
        let scaled = |point: &Point| Some((point.megabytes, point.micros[0] * scale(record, point.map)?));
        let points: Vec<_> = points.filter_map(scaled).collect();
        if !points.is_empty() {
            chart.push(Series::new(format!("{program}, scaled"), Mark::Points, points).hollow());
        }
    }
    chart
}

/// Geometric means over the maps of EHL: time over memory, one point a budget, and one a program.
fn curve(record: &Record) -> Chart {
    let mut chart = Chart::new(
        "Memory against time, means of the maps of EHL-1",
        Axis::new("index, MB").log(),
        Axis::new("mean time of a query, µs").log(),
    )
    .note("any angle, gaps closed; with paths; EHL scaled to this machine".to_owned());
    let of_program = |program: &'static str| POINTS.iter().filter(move |point| point.program == program);
    let ours = |text: &str| {
        let of_map = |point: &Point| {
            let row = on(record, point.map, text)?;
            Some((row.number("index")? / 1e6, row.number("micros")?))
        };
        mean_of(of_program(PROGRAMS[0]).map(of_map))
    };
    let mut budgets: Vec<_> = [LABELS].into_iter().chain(BUDGETS).filter_map(ours).collect();
    budgets.sort_by(|(memory, _), (other, _)| memory.total_cmp(other));
    chart.push(Series::new("Mediant", Mark::Line, budgets));
    for program in PROGRAMS {
        let scaled = |point: &Point| Some((point.megabytes, point.micros[0] * scale(record, point.map)?));
        let mean = mean_of(of_program(program).map(scaled));
        chart.push(Series::new(program, Mark::Points, mean).hollow());
    }
    chart
}

/// The geometric means of pairs; `None` if one is missing.
fn mean_of(pairs: impl Iterator<Item = Option<(f64, f64)>>) -> Option<(f64, f64)> {
    let (first, second): (Vec<f64>, Vec<f64>) = pairs.collect::<Option<Vec<_>>>()?.into_iter().unzip();
    stats::geometric_mean(&first).zip(stats::geometric_mean(&second))
}

fn cell(value: Option<f64>) -> String {
    value.map_or("–".to_owned(), number)
}

fn by_map(record: &Record) -> Table {
    let mut table = Table::new([
        "map",
        "hub labels, MB",
        "ms",
        "µs",
        "distance, µs",
        "contraction, MB",
        "ms",
        "µs",
        "distance, µs",
        "Anya, µs",
        "distance, µs",
    ]);
    let values = |map: &str| -> Vec<Option<f64>> {
        let method = |text: &str| {
            [
                of(record, map, text, "index").map(|bytes| bytes / 1e6),
                of(record, map, text, "preparation").map(|seconds| 1e3 * seconds),
                of(record, map, text, "micros"),
                distance(record, map, text),
            ]
        };
        let [_, _, path, length] = method(ANYA);
        [method(LABELS), method(CONTRACTION)].into_iter().flatten().chain([path, length]).collect()
    };
    let maps = record.distinct("map");
    let all: Vec<Vec<Option<f64>>> = maps.iter().map(|map| values(map)).collect();
    for (map, values) in maps.iter().zip(&all) {
        table.row([(*map).to_owned()].into_iter().chain(values.iter().copied().map(cell)));
    }
    // Over the maps that have all figures: else the means were of other maps in each column.
    let whole: Vec<&Vec<Option<f64>>> =
        all.iter().filter(|values| values.iter().all(Option::is_some)).collect();
    let mean =
        |at: usize| stats::geometric_mean(&whole.iter().filter_map(|values| values[at]).collect::<Vec<_>>());
    if let Some(columns) = whole.first().map(|values| values.len()) {
        let name = format!("**geometric mean** of {} maps", whole.len());
        table.row([name].into_iter().chain((0..columns).map(mean).map(cell)));
    }
    table
}

fn budgets(record: &Record) -> Table {
    let mut table = Table::new([
        "budget",
        "maps with hub labels",
        "with a contraction",
        "with nothing",
        "MB in all",
        "MB, most",
        "µs, geometric mean",
    ]);
    let maps = record.distinct("map");
    for text in BUDGETS.into_iter().chain([LABELS]) {
        let rows: Vec<&Row> = maps.iter().filter_map(|map| row_of(record, map, text)).collect();
        if rows.is_empty() {
            continue;
        }
        let kept = |kept: Kept| rows.iter().filter(|row| row.text("kept") == kept.name()).count().to_string();
        let sizes: Vec<f64> = rows.iter().filter_map(|row| Some(row.number("index")? / 1e6)).collect();
        let micros: Vec<f64> = rows.iter().filter_map(|row| row.number("micros")).collect();
        let budget = text.split_once("memory=").map_or("default", |(_, budget)| budget);
        table.row([
            budget.to_owned(),
            kept(Kept::Labels),
            kept(Kept::Contraction),
            kept(Kept::Nothing),
            number(sizes.iter().sum()),
            cell(sizes.iter().copied().reduce(f64::max)),
            cell(stats::geometric_mean(&micros)),
        ]);
    }
    table
}

/// The row of the largest budget of which the index takes at most so many bytes; that of the hub labels alone
/// if there is none.
fn within<'a>(record: &'a Record, map: &str, bytes: f64) -> Option<&'a Row> {
    let rows = BUDGETS.into_iter().rev().filter_map(|text| on(record, map, text));
    let fits = |row: &&Row| row.number("index").is_some_and(|size| size <= bytes);
    rows.filter(|row| row.text("kept") == Kept::Labels.name()).find(fits).or_else(|| on(record, map, LABELS))
}

fn beside(record: &Record) -> Table {
    let mut table = Table::new([
        "program",
        "map",
        "MB",
        "s to prepare, scaled",
        "µs, scaled",
        "ours, MB",
        "s",
        "µs",
        "ours over theirs, MB",
        "µs",
    ])
    .names(2);
    for program in PROGRAMS {
        let mut ratios = Vec::new();
        for point in POINTS.iter().filter(|point| point.program == program) {
            let Some(scale) = scale(record, point.map) else { continue };
            let ours = within(record, point.map, 1e6 * point.megabytes);
            let of = |column: &str| ours.and_then(|row| row.number(column));
            let (size, micros) = (of("index").map(|bytes| bytes / 1e6), scale * point.micros[0]);
            let ratio = [size.map(|size| size / point.megabytes), of("micros").map(|ours| ours / micros)];
            ratios.extend(ratio[0].zip(ratio[1]));
            table.row([
                program.to_owned(),
                point.map.to_owned(),
                number(point.megabytes),
                number(scale * point.seconds),
                number(micros),
                cell(size),
                cell(of("preparation")),
                cell(of("micros")),
                cell(ratio[0]),
                cell(ratio[1]),
            ]);
        }
        if let Some((size, micros)) = mean_of(ratios.into_iter().map(Some)) {
            let empty = || String::new();
            let means = [number(size), number(micros)];
            let name = [program.to_owned(), "**geometric mean**".to_owned()];
            table.row(name.into_iter().chain(std::iter::repeat_with(empty).take(6)).chain(means));
        }
    }
    table
}

#[cfg(test)]
mod tests {
    use mediant_report::Provenance;

    use super::*;

    fn record() -> Record {
        let row = |competitor: &str, kept: Kept, index: f64, micros: f64| {
            let row = Row::new().key("map", "arena2").key("competitor", competitor).key("kept", kept.name());
            row.with("index", index).with("micros", micros).with("preparation", 0.01)
        };
        let baseline = |one: Baseline| {
            let micros = 2.0 * published::baseline(one, "arena2").expect("EHL ran there");
            Row::new().key("map", "arena2").key("competitor", one.name()).with("micros", micros)
        };
        let rows = vec![
            row(LABELS, Kept::Labels, 2e5, 1.5),
            row(BUDGETS[0], Kept::Labels, 1e6, 1.25),
            row(BUDGETS[1], Kept::Labels, 5e6, 0.75),
            row(CONTRACTION, Kept::Contraction, 1e5, 9.0),
            row(ANYA, Kept::Nothing, 0.0, 30.0),
            row(&format!("distance of {LABELS}"), Kept::Labels, 2e5, 0.5),
            baseline(Baseline::Pathfinding),
            baseline(Baseline::GridPathfinding),
        ];
        let (id, title) = ("memory".to_owned(), String::new());
        Record { id, title, provenance: Provenance::default(), columns: Vec::new(), rows }
    }

    #[test]
    fn ehl_is_scaled_by_both_baselines_and_stands_beside_no_more_memory() {
        let record = record();
        assert!((scale(&record, "arena2").unwrap() - 2.0).abs() < 1e-12);
        assert_eq!(scale(&record, "hrt201n"), None);
        let text = beside(&record).markdown();
        assert_eq!(text.lines().count(), 2 + 2 * PROGRAMS.len(), "one point each on arena2: {text}");
        let ours = |program: &str| {
            let row = text.lines().find(|line| line.starts_with(&format!("| {program} | arena2 |")));
            row.and_then(|row| row.split(" | ").nth(7)).map(str::to_owned)
        };
        // 95 and 3.6 MB.
        assert_eq!(ours("EHL-1").as_deref(), Some("0.750"), "{text}");
        assert_eq!(ours("EHL-16").as_deref(), Some("1.25"), "{text}");
    }

    #[test]
    fn labels_are_shown_only_where_there_are_some() {
        let mut record = record();
        assert_eq!(of(&record, "arena2", LABELS, "micros"), Some(1.5));
        assert_eq!(distance(&record, "arena2", LABELS), Some(0.5));
        record.rows[0] = record.rows[0].clone().key("kept", Kept::Nothing.name());
        assert_eq!(of(&record, "arena2", LABELS, "micros"), None);
        assert_eq!(distance(&record, "arena2", LABELS), None);
        assert_eq!(of(&record, "arena2", CONTRACTION, "micros"), Some(9.0));
        for text in BUDGETS.into_iter().chain(METHODS.map(|(_, text)| text)) {
            assert_eq!(text.parse::<Setup>().unwrap().to_string(), text);
        }
    }
}
