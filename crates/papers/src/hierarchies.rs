//! HPA* (Botea, Müller & Schaeffer 2004) on the maps of games.

use mediant_bench::Study;
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

/// The published claims about HPA*, on all maps of games.
pub(super) const HPA: Experiment = Experiment {
    id: "hpa-games",
    page: Page::Beyond,
    title: "HPA* on the maps of games",
    sets: &["bg512", "dao", "sc1", "wc3maps512"],
    measure,
    show,
};

const KS: [&str; 2] = ["2", "3"];
/// Of each scenario, the instances whose index this divides.
const EVERY: usize = 100;

/// One map at one k: the mean excess of unstraightened and of straightened paths, in %; the nodes and the
/// time of A* over those of HPA*.
#[derive(Clone, Copy, Serialize, Deserialize)]
struct OnMap {
    queries: u64,
    unstraightened: f64,
    straightened: f64,
    nodes: f64,
    time: Option<f64>,
}

fn measure(context: &Context<'_>) -> Result<Findings, Error> {
    let every = context.quick_or(10 * EVERY, EVERY);
    let (mut rows, mut maps_in_all, mut instances) = (Vec::new(), 0, 0);
    for set in context.sets() {
        let maps = context.maps(set, 8)?;
        let measured = context.each(set, How::Timed, &maps, |map| {
            KS.iter().map(|k| on_map(context, map, k, every)).collect::<Result<Vec<_>, _>>()
        })?;
        maps_in_all += maps.len();
        for (at, k) in KS.iter().enumerate() {
            let found: Vec<OnMap> = measured.iter().filter_map(|ks| ks[at]).collect();
            instances += found.iter().map(|map| map.queries).sum::<u64>();
            let mean = |value: fn(&OnMap) -> f64| stats::mean(&found.iter().map(value).collect::<Vec<_>>());
            let times: Vec<f64> = found.iter().filter_map(|map| map.time).collect();
            let nodes: Vec<f64> = found.iter().map(|map| map.nodes).collect();
            let row = Row::new().key("set", set).key("k", k).with("maps", found.len() as f64);
            let row = row
                .with("unstraightened", mean(|map| map.unstraightened))
                .with("straightened", mean(|map| map.straightened));
            let worst = found
                .iter()
                .map(|map| map.straightened)
                .fold(None, |a: Option<f64>, b| Some(a.map_or(b, |a| a.max(b))));
            rows.push(
                row.with("worst", worst)
                    .with("nodes", stats::geometric_mean(&nodes))
                    .with("time", stats::geometric_mean(&times)),
            );
        }
    }
    let columns = vec![
        Column::key("set", "the set of maps"),
        Column::key("k", "the neighborhood"),
        Column::count("maps", "", "maps with a query"),
        Column::count(
            "unstraightened",
            "%",
            "mean excess of unstraightened paths over the optimum, mean of maps",
        ),
        Column::count("straightened", "%", "the same of straightened paths"),
        Column::count("worst", "%", "the largest mean of a map"),
        Column::count("nodes", "", "A*'s nodes over those of HPA*, geometric mean of maps"),
        Column::time("time", "", "A*'s time over that of HPA*, geometric mean of maps"),
    ];
    let drawn =
        format!("of each scenario the instances whose index {every} divides, at k = 2 and 3 between centers");
    Ok(Findings { columns, rows, maps: maps_in_all, instances, drawn, seeded: false })
}

fn on_map(context: &Context<'_>, map: &Map, k: &str, every: usize) -> Result<Option<OnMap>, Error> {
    let grid = map.grid()?;
    let queries = map.queries(every)?;
    let optimal = run(&mut Study::new(&grid, &queries, 0), &format!("astar:{k}"))?;
    let pairs = queries.into_iter().zip(costs(&optimal)).filter(|(_, cost)| *cost > 0.0);
    let (queries, optima): (Vec<Ends>, Vec<f64>) = pairs.unzip();
    if queries.is_empty() {
        return Ok(None);
    }
    let mut study = Study::new(&grid, &queries, context.passes().min(1));
    let astar = Sums::of(&run(&mut study, &format!("astar:{k}"))?, &optima);
    let unstraightened =
        Sums::of(&run(&mut Study::new(&grid, &queries, 0), &format!("hpa:{k},unstraightened"))?, &optima);
    let mut study = Study::new(&grid, &queries, context.passes());
    let hpa = Sums::of(&run(&mut study, &format!("hpa:{k}"))?, &optima);
    let excess = |sums: Sums| 100.0 * (sums.ratios / sums.compared.max(1) as f64 - 1.0);
    Ok(Some(OnMap {
        queries: hpa.queries,
        unstraightened: excess(unstraightened),
        straightened: excess(hpa),
        nodes: astar.expanded / hpa.expanded.max(1.0),
        time: (hpa.micros > 0.0).then(|| astar.micros / hpa.micros),
    }))
}

fn show(record: &Record) -> Section {
    let mut section = Section::default();
    section.text(
        "Botea, Müller & Schaeffer 2004 claim paths within 1 % of the optimum after smoothing, up to ten \
         times faster than A*. Clusters of 10 × 10 cells, 3 levels. Nodes and times are A*'s over those of \
         HPA*.",
    );
    let mut table = Table::new([
        "set",
        "k",
        "maps",
        "unstraightened, longer by",
        "straightened",
        "worst map",
        "fewer nodes",
        "less time",
    ]);
    for row in &record.rows {
        let percent = |column| row.number(column).map_or("–".to_owned(), |value| format!("{value:.2} %"));
        let times =
            |column| row.number(column).map_or("–".to_owned(), |value| format!("{} ×", number(value)));
        table.row([
            row.text("set").to_owned(),
            row.text("k").to_owned(),
            thousands(row.number("maps").unwrap_or_default()),
            percent("unstraightened"),
            percent("straightened"),
            percent("worst"),
            times("nodes"),
            times("time"),
        ]);
    }
    section.table(&table);
    let claims = record.rows.iter().map(|row| {
        let what = format!("{}, k = {}: length over the optimum, at most", row.text("set"), row.text("k"));
        // The claim is a bound: any value below it is as published.
        let ours = row.number("straightened").map(|excess| (100.0 + excess).max(101.0));
        Claim::new("Botea 2004, abstract", what, 101.0, ours).within(0.0).written(1, " %")
    });
    section.claims(claims.collect(), false);
    let sets = record.distinct("set");
    let ticks =
        || sets.iter().enumerate().map(|(at, set)| (at as f64, (*set).to_owned())).collect::<Vec<_>>();
    let mut chart = Chart::new(
        "HPA* against A*",
        Axis::new("set of maps").ticks(ticks()),
        Axis::new("A* over HPA*, times").log(),
    )
    .note(format!(
        "{} instances on {} maps",
        thousands(record.provenance.instances as f64),
        record.provenance.maps
    ));
    for k in KS {
        for (column, name) in [("nodes", "nodes"), ("time", "time")] {
            let point = |(at, set): (usize, &&str)| {
                Some((at as f64, record.number(&[("set", set), ("k", k)], column)?))
            };
            let points: Vec<(f64, f64)> = sets.iter().enumerate().filter_map(point).collect();
            chart.push(Series::new(format!("{name}, k = {k}"), Mark::Points, points));
        }
    }
    section.figure("hpa-games-ratios", "A*'s nodes and time over those of HPA*, by set", chart.svg());
    section
}
