//! Our engines beside the figures that Central64 publishes.

use mediant_bench::{PublishedRow, ReferenceTimings, Study};
use mediant_report::{
    Axis, Chart, Claim, Column, Mark, Record, Row, Series, Table, number, stats, thousands,
};
use mediant_search::Ends;

use super::{
    context::{Context, How},
    experiment::{Experiment, Findings, Page, Section},
    setups::{Sums, costs, run},
};
use crate::Error;

/// Our engines beside the figures that Autodesk's Central64 publishes.
pub(super) const CENTRAL64: Experiment = Experiment {
    id: "compared-central64",
    page: Page::Compared,
    title: "Central64 on Dragon Age: Origins",
    sets: &["dao"],
    measure: measure_central,
    show: show_central,
};

/// A variant that Central64 publishes, its k, and our setup.
const VARIANTS: [(&str, u32, &str); 8] = [
    ("A* with smoothing", 3, "astar:3:open,smooth"),
    ("A* with smoothing", 4, "astar:4:open,smooth"),
    ("A* with smoothing", 5, "astar:5:open,smooth"),
    ("A* with smoothing", 6, "astar:6:open,smooth"),
    ("bounded JPS with smoothing", 3, "jps:3:open,smooth"),
    ("bounded JPS with smoothing", 4, "jps:4:open,smooth"),
    ("bounded JPS with smoothing", 5, "jps:5:open,smooth"),
    ("bounded JPS with smoothing", 6, "jps:6:open,smooth"),
];
/// Our setups without a counterpart. Setups that differ in smoothing alone stand together, so that they share
/// an index.
const OURS: [&str; 11] = [
    "jps-block:3:open,smooth",
    "anya:any:open",
    "subgoal:3:open,smooth",
    "subgoal:3:open,taut",
    "subgoal:4:open,smooth",
    "subgoal:4:open,taut",
    "subgoal:5:open,smooth",
    "subgoal:5:open,taut",
    "subgoal:6:open,smooth",
    "subgoal:6:open,taut",
    "subgoal:any:open",
];

fn central_setups() -> impl Iterator<Item = &'static str> {
    VARIANTS.iter().map(|(.., setup)| *setup).chain(OURS)
}

fn measure_central(context: &Context<'_>) -> Result<Findings, Error> {
    let every = context.quick_or(200, 40);
    let mut maps = Vec::new();
    for set in context.sets() {
        maps.extend(context.maps(set, 20)?);
    }
    let measured = context.each("maps", How::Timed, &maps, |map| {
        let grid = map.grid()?;
        let queries = map.queries(every)?;
        let optima = costs(&run(&mut Study::new(&grid, &queries, 0), "subgoal:any:open")?);
        let solvable = queries.into_iter().zip(optima).filter(|(_, optimum)| *optimum > 0.0);
        let (queries, optima): (Vec<Ends>, Vec<f64>) = solvable.unzip();
        let mut study = Study::new(&grid, &queries, context.passes());
        central_setups()
            .map(|text| Ok(Sums::of(&run(&mut study, text)?, &optima)))
            .collect::<Result<Vec<_>, Error>>()
    })?;
    let row = |(at, setup): (usize, &'static str)| {
        let on_maps: Vec<&Sums> =
            measured.iter().map(|sums| &sums[at]).filter(|sums| sums.compared > 0).collect();
        let mean = |value: &dyn Fn(&Sums) -> f64| {
            stats::mean(&on_maps.iter().map(|sums| value(sums)).collect::<Vec<_>>())
        };
        let micros = mean(&|sums| sums.micros / sums.timed.max(1) as f64).filter(|_| context.passes() > 0);
        let excess = mean(&|sums| 100.0 * (sums.ratios / sums.compared as f64 - 1.0));
        Row::new()
            .key("setup", setup)
            .with("maps", on_maps.len() as f64)
            .with("excess", excess)
            .with("micros", micros)
    };
    let rows = central_setups().enumerate().map(row).collect();
    let columns = vec![
        Column::key("setup", "the engine with its options"),
        Column::count("maps", "", "maps with a query"),
        Column::count("excess", "%", "mean excess over the shortest at any angle of a map, mean of maps"),
        Column::time("micros", "µs", "mean time of a query of a map, mean of maps"),
    ];
    let instances = measured.iter().filter_map(|sums| sums.first()).map(|sums| sums.queries).sum();
    let drawn = format!(
        "of each scenario the instances whose index {every} divides, between corners, gap open; mean of a \
         map, then over maps"
    );
    Ok(Findings { columns, rows, maps: maps.len(), instances, drawn, seeded: false })
}

/// Why the excess differs: how much longer the paths of one k are with another smoothing.
fn smoothing(record: &Record) -> String {
    let excess = |setup: String| record.number(&[("setup", &setup)], "excess");
    let list = |how: &str| {
        let texts =
            (3..=6).filter_map(|k| Some(format!("{:.3}", excess(format!("subgoal:{k}:open,{how}"))?)));
        texts.collect::<Vec<_>>().join(", ")
    };
    format!(
        "The smoothing. Ours is one pass along the path (Botea et al. 2004). Shortest paths over N(k), k = 3 \
         to 6, as another engine finds them, are {} % longer than the shortest at any angle after this pass, \
         and {} % once they are pulled taut. The published numbers lie between: they smooth more than one \
         pass does, less than until nothing can be pulled shorter.",
        list("smooth"),
        list("taut")
    )
}

fn show_central(record: &Record) -> Section {
    let mut section = Section::default();
    let Some(published) =
        ReferenceTimings::bundled().ok().and_then(|references| references.published.into_iter().next())
    else {
        return section;
    };
    section.text(format!(
        "{} ({}, 4 to 64 neighbors, nothing prepared) publishes the mean of a map, then over the 156 maps, \
         on a {}. Times are of two machines: read their shape, not their ratio. The excess is over the \
         shortest path at any angle.",
        published.name, published.language, published.machine
    ));
    let heading = ["variant", "k", "published, µs", "excess", "ours", "µs", "excess", ""];
    let mut table = Table::new(heading);
    let percent = |value: Option<f64>| value.map_or("–".to_owned(), |value| format!("{value:.3} %"));
    let ours = |setup: Option<&str>| {
        let get = |column: &str| record.number(&[("setup", setup?)], column);
        let name = setup.map_or("–".to_owned(), |setup| format!("`{setup}`"));
        [name, get("micros").map_or("–".to_owned(), number), percent(get("excess"))]
    };
    let mut claims = Vec::new();
    for row in &published.rows {
        let setup = variant(row);
        let theirs =
            [row.variant.clone(), row.k.to_string(), thousands(row.micros), percent(row.excess_percent)];
        let claim = row.excess_percent.filter(|_| setup.is_some()).map(|theirs| {
            let excess = setup.and_then(|setup| record.number(&[("setup", setup)], "excess"));
            let what = format!("{}, k = {}", row.variant, row.k);
            Claim::new("Central64, excess", what, theirs, excess)
                .exact(3)
                .written(3, " %")
                .because(smoothing(record))
        });
        let mark = claim.as_ref().map_or("", |claim| claim.verdict().mark()).to_owned();
        table.row(theirs.into_iter().chain(ours(setup)).chain([mark]));
        claims.extend(claim);
    }
    for setup in OURS {
        table.row(["", "", "–", "–"].map(str::to_owned).into_iter().chain(ours(Some(setup))));
    }
    section.table(&table);
    section.claims(claims, false);
    let chart = central_chart(record, &published.rows);
    section.figure("compared-central64-time", "Time against excess of Central64 and of ours", chart.svg());
    section
}

/// Our setup for a published variant.
fn variant(row: &PublishedRow) -> Option<&'static str> {
    let is_it = |(variant, k, _): &&(&str, u32, &str)| *variant == row.variant && *k == row.k;
    VARIANTS.iter().find(is_it).map(|(.., setup)| *setup)
}

fn central_chart(record: &Record, published: &[PublishedRow]) -> Chart {
    let mut chart = Chart::new(
        "Central64 and ours on Dragon Age: Origins",
        Axis::new("mean time of a query, µs").log(),
        Axis::new("mean excess over the shortest at any angle, %").log(),
    )
    .note(format!(
        "{} maps, {} instances of ours; labelled with k; two machines",
        record.provenance.maps,
        thousands(record.provenance.instances as f64)
    ));
    let ours = |setup: &str| {
        let get = |column: &str| record.number(&[("setup", setup)], column);
        Some((get("micros")?, get("excess")?))
    };
    let smoothed = || published.iter().filter(|row| row.variant == VARIANTS[0].0);
    let theirs = smoothed().filter_map(|row| Some((row.micros, row.excess_percent?)));
    let labels = || smoothed().map(|row| row.k.to_string());
    chart.push(Series::new("Central64, A* with smoothing", Mark::Line, theirs).labels(labels()));
    for name in ["A* with smoothing", "bounded JPS with smoothing"] {
        let rows = || published.iter().filter(|row| row.variant == name);
        let points = rows().filter_map(|row| ours(variant(row)?));
        let labels = rows().map(|row| row.k.to_string());
        chart.push(Series::new(format!("ours, {name}"), Mark::Line, points).labels(labels));
    }
    for how in ["smooth", "taut"] {
        let setups =
            || OURS.into_iter().filter(|setup| setup.starts_with("subgoal:") && setup.ends_with(how));
        let labels = setups().map(|setup| setup["subgoal:".len()..].chars().take(1).collect());
        let name = format!("ours, subgoal graph, {how}");
        chart.push(Series::new(name, Mark::Line, setups().filter_map(ours)).labels(labels));
    }
    for setup in ["anya:any:open", "subgoal:any:open"] {
        chart.push(Series::new(format!("ours, {setup}"), Mark::Points, ours(setup)));
    }
    chart
}
