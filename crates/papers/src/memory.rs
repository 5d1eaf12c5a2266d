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

/// Hub labels within more memory than any of the maps needs; not `levels=labels`, since noise has
/// none.
const LABELS: &str = "subgoal:any:closed,memory=1GB";
const CONTRACTION: &str = "subgoal:any:closed,levels=contracted";
const ANYA: &str = "anya:any:closed";
/// The library within budgets of memory; the last is the default budget.
const BUDGETS: [&str; 4] = [
    "subgoal:any:closed,memory=1MB",
    "subgoal:any:closed,memory=4MB",
    "subgoal:any:closed,memory=16MB",
    "subgoal:any:closed",
];
/// The methods, by the names that the page gives them.
const METHODS: [(&str, &str); 3] = [("hub labels", LABELS), ("contraction", CONTRACTION), ("Anya", ANYA)];

fn measure(context: &Context<'_>) -> Result<Findings, Error> {
    let methods = METHODS.map(|(_, text)| text);
    let paths = methods.iter().chain(&BUDGETS).map(|text| Ok(Competitor::Ours(setup(text)?)));
    let distances = methods.iter().map(|text| Ok(Competitor::Distance(setup(text)?)));
    findings(context, paths.chain(distances).collect::<Result<_, Error>>()?)
}

/// The row of a setup on a map; of hub labels only where there are some.
fn on<'a>(record: &'a Record, map: &str, text: &str) -> Option<&'a Row> {
    let competitor = text.parse::<Setup>().map_or_else(|_| text.to_owned(), |setup| setup.to_string());
    let row = record.rows.iter().find(|row| row.is(&[("map", map), ("competitor", &competitor)]))?;
    (text != LABELS || row.text("kept") == Kept::Labels.name()).then_some(row)
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
         and 16 × 16 cells; EHL* merges regions under a budget of memory. Its programs ran on another day \
         and machine, on the same instances. Their times are **scaled** through the two crates that were \
         measured there and are measured here, map by map, as above; their sizes are as measured. EHL was \
         not built on all maps, and its sizes are not known on all maps on which it was. Lower and further \
         to the left is better.",
    );
    section.figure("memory-time", "Time of a query over the size of the index", chart(record).svg());
    section.heading("Map by map");
    section.text(
        "MB of the index, ms to prepare (all cores), µs of a query with its path, and of the distance alone. \
         A dash: the contraction does not come to its end on that map, so there are no hub labels.",
    );
    section.table(&by_map(record));
    section.heading("Within a budget");
    section.text(
        "The option `memory` bounds hub labels. Where they take more, a contraction is kept, and where that \
         would be slower than Anya, nothing. The last row is the default: 48 bytes a cell, but at least \
         32 MB and at most 1 GB.",
    );
    section.table(&budgets(record));
    section.heading("Beside EHL");
    section.text(
        "Scaled times of EHL, and hub labels here on the same map. Below 1 ours is faster, or smaller. A dash: \
         not known.",
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
        let scaled = |point: &Point| {
            Some(((point.megabytes?, point.micros * scale(record, point.map)?), point.map.to_owned()))
        };
        let (points, names): (Vec<_>, Vec<_>) = points.filter_map(scaled).unzip();
        if !points.is_empty() {
            chart
                .push(Series::new(format!("{program}, scaled"), Mark::Points, points).hollow().labels(names));
        }
    }
    chart
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
    for text in BUDGETS {
        let rows: Vec<&Row> = maps.iter().filter_map(|map| on(record, map, text)).collect();
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
    for point in POINTS {
        let Some(scale) = scale(record, point.map) else { continue };
        let of = |column: &str| of(record, point.map, LABELS, column);
        let (ours, size) = (of("micros"), of("index").map(|bytes| bytes / 1e6));
        let micros = scale * point.micros;
        table.row([
            point.program.to_owned(),
            point.map.to_owned(),
            cell(point.megabytes),
            cell(point.seconds.map(|seconds| scale * seconds)),
            number(micros),
            cell(size),
            cell(of("preparation")),
            cell(ours),
            cell(size.zip(point.megabytes).map(|(ours, theirs)| ours / theirs)),
            cell(ours.map(|ours| ours / micros)),
        ]);
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
        let baseline = |one: Baseline, micros: f64| {
            Row::new().key("map", "arena2").key("competitor", one.name()).with("micros", micros)
        };
        let rows = vec![
            row(LABELS, Kept::Labels, 2e6, 1.5),
            row(CONTRACTION, Kept::Contraction, 1e6, 9.0),
            row(ANYA, Kept::Nothing, 0.0, 30.0),
            row(&format!("distance of {LABELS}"), Kept::Labels, 2e6, 0.5),
            baseline(Baseline::Pathfinding, 2.0 * 1558.0),
            baseline(Baseline::GridPathfinding, 8.0 * 94.7),
        ];
        let (id, title) = ("memory".to_owned(), String::new());
        Record { id, title, provenance: Provenance::default(), columns: Vec::new(), rows }
    }

    #[test]
    fn ehl_is_scaled_by_both_baselines() {
        let record = record();
        assert!((scale(&record, "arena2").unwrap() - 4.0).abs() < 1e-12);
        assert_eq!(scale(&record, "hrt201n"), None);
        let text = beside(&record).markdown();
        // 0.34 µs there are 1.36 here, 77 MB stay 77 MB; 5 s are 20.
        assert!(
            text.contains("| EHL-1 | arena2 | 77.0 | 20.0 | 1.36 | 2.00 | 0.010 | 1.50 | 0.026 | 1.10 |"),
            "{text}"
        );
        assert_eq!(text.lines().count(), 2 + 3, "three points on arena2: {text}");
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
