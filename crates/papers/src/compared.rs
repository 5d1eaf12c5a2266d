//! Our engines beside other programs: what `cargo xtask compare` measures, as a page; and the figures that
//! Central64 publishes.

use mediant::Setup;
use mediant_bench::{
    Baseline, Comparison, Competitor, MapRecord, Problem, PublishedRow, ReferenceTimings, Study, Timing,
    measure as side_by_side,
};
use mediant_report::{
    Axis, Chart, Claim, Column, Mark, Record, Row, Series, Table, number, stats, thousands,
};
use mediant_search::Query;
use mediant_sets::Archive;
use serde::{Deserialize, Serialize};

use super::{
    context::{Context, How},
    experiment::{Experiment, Findings, Page, Section},
    maps::Map,
    setups::{Sums, costs, run, setup},
};
use crate::Error;

/// Our engines beside the programs of `benchdata/reference_timings.json`.
pub(super) const PROGRAMS: Experiment = Experiment {
    id: "compared-programs",
    page: Page::Compared,
    title: "Thirteen programs, on the same instances",
    sets: &["dao", "bg512", "wc3maps512", "sc1", "random", "room", "street"],
    measure: measure_programs,
    show: show_programs,
};

/// Our engines beside the figures that Autodesk's Central64 publishes.
pub(super) const CENTRAL64: Experiment = Experiment {
    id: "compared-central64",
    page: Page::Compared,
    title: "Central64 on Dragon Age: Origins",
    sets: &["dao"],
    measure: measure_central,
    show: show_central,
};

const SETUPS: [&str; 15] = [
    "astar:3:never",
    "canonical:3:never",
    "jps:3:never",
    "jps-block:3:never",
    "jps-plus:3:never",
    "subgoal:3:never",
    "hpa:3:never",
    "chpa:3:never",
    "anya:any:closed",
    "anya:any:open",
    "subgoal:any:closed",
    "subgoal:any:open",
    "theta:3:open",
    "lazy-theta:3:open",
    "subgoal-theta:3:open",
];
/// The maps of a quick run: small ones.
const QUICK: [&str; 4] = ["arena2", "hrt201n", "AR0011SR", "Berlin_0_256"];

fn references() -> Result<ReferenceTimings, Error> {
    ReferenceTimings::bundled().map_err(|wrong| Error::Reproduce(wrong.to_string()))
}

/// A timing in the form in which an interrupted run keeps it.
#[derive(Serialize, Deserialize)]
struct Kept {
    competitor: String,
    queries: u64,
    micros: f64,
    cost: f64,
    seconds: Option<f64>,
    bytes: Option<f64>,
}

fn measure_programs(context: &Context<'_>) -> Result<Findings, Error> {
    let references = references()?;
    let mut competitors =
        SETUPS.iter().map(|text| Ok(Competitor::Ours(setup(text)?))).collect::<Result<Vec<_>, Error>>()?;
    if context.passes() > 0 {
        competitors.extend(Baseline::ALL.map(Competitor::Baseline));
    }
    let sets = context.sets();
    let mut maps = Vec::new();
    if context.is_bundled() {
        maps = context.maps("bundled", usize::MAX)?;
    }
    for row in &references.maps {
        let wanted = context.quick_or(QUICK.contains(&row.map.as_str()), true);
        if wanted && sets.contains(&row.set.as_str()) {
            maps.extend(context.named(&row.set, &[&row.map])?);
        }
    }
    let measured = context.each("maps", How::Timed, &maps, |map| {
        let archive = Archive::new(map.path.parent().and_then(std::path::Path::parent).map(Into::into));
        let folder =
            map.path.parent().and_then(std::path::Path::file_name).unwrap_or_default().to_string_lossy();
        let wrong = |wrong: &dyn std::error::Error| Error::Reproduce(wrong.to_string());
        let problem = Problem::load(&archive, &folder, &map.name, references.instances.every)
            .map_err(|error| wrong(&error))?;
        let problem = problem.ok_or_else(|| Error::Reproduce(format!("{}: no scenario", map.name)))?;
        let passes = context.passes() as usize;
        let record = side_by_side(&problem, &competitors, passes).map_err(|error| wrong(&error))?;
        let keep = |timing: &Timing| Kept {
            competitor: timing.competitor.clone(),
            queries: record.instances as u64,
            micros: timing.micros,
            cost: timing.mean_cost,
            seconds: timing.preparation.map(|made| made.seconds),
            bytes: timing.preparation.map(|made| made.bytes as f64),
        };
        Ok(record.timings.iter().map(keep).collect::<Vec<_>>())
    })?;
    let timed = context.passes() > 0;
    let row = |map: &Map, kept: &Kept| {
        let row = Row::new().key("map", &map.name).key("set", &map.set).key("competitor", &kept.competitor);
        let row = row.with("queries", kept.queries as f64).with("cost", kept.cost).with("bytes", kept.bytes);
        row.with("micros", timed.then_some(kept.micros)).with("preparation", kept.seconds)
    };
    let rows = maps
        .iter()
        .zip(&measured)
        .flat_map(|(map, all)| all.iter().map(move |kept| row(map, kept)))
        .collect();
    let columns = vec![
        Column::key("map", "the map"),
        Column::key("set", "its set"),
        Column::key("competitor", "our engine, or a crate that was measured on both machines"),
        Column::count("queries", "", "queries"),
        Column::count("cost", "cells", "mean length of a path"),
        Column::count("bytes", "bytes", "what is prepared of the map, beyond the map"),
        Column::time("micros", "µs", "mean time of a query"),
        Column::time("preparation", "s", "time to prepare the map, on all cores"),
    ];
    let instances = measured.iter().filter_map(|all| all.first()).map(|kept| kept.queries).sum();
    let drawn = format!("of each scenario the instances whose index {} divides", references.instances.every);
    Ok(Findings { columns, rows, maps: maps.len(), instances, drawn, seeded: false })
}

/// The comparisons of a record, as `compare` makes them: by map, by setup.
fn comparisons(record: &Record, references: &ReferenceTimings) -> Vec<(String, Vec<Option<Comparison>>)> {
    let timing = |row: &Row| Timing {
        competitor: row.text("competitor").to_owned(),
        micros: row.number("micros").unwrap_or(f64::NAN),
        passes: Vec::new(),
        mean_cost: row.number("cost").unwrap_or(f64::NAN),
        preparation: None,
    };
    let on_map = |map: &&str| {
        let timings: Vec<Timing> = record.select(&[("map", map)]).map(timing).collect();
        let record = MapRecord { map: (*map).to_owned(), set: String::new(), instances: 0, timings };
        let compare = |setup: &&str| {
            let timing = record.timings.iter().find(|timing| timing.competitor == canonical(setup))?;
            Comparison::new(references, &record, timing)
        };
        ((*map).to_owned(), SETUPS.iter().map(compare).collect())
    };
    record.distinct("map").iter().map(on_map).collect()
}

/// The full text of a setup.
fn canonical(text: &str) -> String {
    text.parse::<Setup>().map_or_else(|_| text.to_owned(), |setup| setup.to_string())
}

fn show_programs(record: &Record) -> Section {
    let mut section = Section::default();
    let Ok(references) = ReferenceTimings::bundled() else { return section };
    section.text(
        "Ratios, never times: two crates that anyone can run were measured on the machine of the other \
         programs, and here in the same passes as our engines; their times tell the ratio of the machines, \
         map by map. Below 1, ours is faster. Only programs that solve the same problem are compared: the \
         same directions and rules, both optimally or neither.",
    );
    let compared = comparisons(record, &references);
    let mut table =
        Table::new(["ours", "program", "geometric mean", "best map", "worst map", "maps"]).names(2);
    let mut means: Vec<(&'static str, String, f64)> = Vec::new();
    for (at, text) in SETUPS.iter().enumerate() {
        let Ok(parsed) = text.parse::<Setup>() else { continue };
        for (which, program) in
            references.programs.iter().enumerate().filter(|(_, program)| program.solves(parsed))
        {
            let ratio = |(map, all): &(String, Vec<Option<Comparison>>)| {
                let ratio = all[at].as_ref()?.ratios.get(which).copied().flatten()?;
                ratio.is_finite().then(|| (map.clone(), ratio))
            };
            let mut ratios: Vec<(String, f64)> = compared.iter().filter_map(ratio).collect();
            ratios.sort_by(|a, b| a.1.total_cmp(&b.1));
            let values: Vec<f64> = ratios.iter().map(|ratio| ratio.1).collect();
            let (Some(mean), Some(best), Some(worst)) =
                (stats::geometric_mean(&values), ratios.first(), ratios.last())
            else {
                continue;
            };
            let extreme = |(map, ratio): &(String, f64)| format!("{} ({map})", number(*ratio));
            table.row([
                format!("`{text}`"),
                program.name.clone(),
                number(mean),
                extreme(best),
                extreme(worst),
                values.len().to_string(),
            ]);
            means.push((text, program.name.clone(), mean));
        }
    }
    section.table(&table);
    let (octile, any_angle): (Vec<_>, Vec<_>) =
        means.into_iter().partition(|(setup, ..)| setup.ends_with(":never"));
    for (name, title, means) in [
        ("octile", "Octile-optimal engines: k = 3 between centers", octile),
        ("any-angle", "Engines of any angle, between corners", any_angle),
    ] {
        if !means.is_empty() {
            let chart = ratio_chart(record, title, &means);
            section.figure(
                &format!("compared-programs-{name}"),
                &format!("{title}: our time over that of other programs"),
                chart.svg(),
            );
        }
    }
    section.heading("Times here");
    section.text("Mean time of a query in µs.");
    section.table(&times(record));
    section.heading("Prepared");
    section
        .text("What comes before the first query, on all cores: milliseconds, and megabytes beyond the map.");
    section.table(&prepared(record));
    section
}

/// A row for each program, a point for each setup of ours: its geometric mean over the maps.
fn ratio_chart(record: &Record, title: &str, means: &[(&'static str, String, f64)]) -> Chart {
    let mut programs: Vec<&str> = Vec::new();
    for (_, program, _) in means {
        if !programs.contains(&program.as_str()) {
            programs.push(program);
        }
    }
    let rows = programs.len() as f64;
    let place = |program: &str| {
        programs.iter().position(|name| *name == program).map_or(-1.0, |at| rows - 1.0 - at as f64)
    };
    let mut chart = Chart::new(
        title,
        Axis::new("our time over the other program's, scaled to one machine; below 1 ours is faster").log(),
        Axis::new("")
            .ticks(programs.iter().map(|name| (place(name), (*name).to_owned())))
            .range(-0.7, rows - 0.3),
    )
    .note(format!(
        "geometric means over {} maps, {} instances",
        record.provenance.maps,
        thousands(record.provenance.instances as f64)
    ));
    for setup in SETUPS {
        let points: Vec<(f64, f64)> = means
            .iter()
            .filter(|(ours, ..)| *ours == setup)
            .map(|(_, program, mean)| (*mean, place(program)))
            .collect();
        if !points.is_empty() {
            chart.push(Series::new(setup, Mark::Points, points));
        }
    }
    chart.push(Series::new("equal", Mark::Reference, [(1.0, -0.7), (1.0, rows - 0.3)]));
    chart
}

fn times(record: &Record) -> Table {
    let maps = record.distinct("map");
    let heading = ["competitor".to_owned()].into_iter().chain(maps.iter().map(|map| (*map).to_owned()));
    let mut table = Table::new(heading.chain(["geometric mean".to_owned()]));
    for competitor in record.distinct("competitor") {
        let micros: Vec<Option<f64>> = maps
            .iter()
            .map(|map| record.number(&[("map", map), ("competitor", competitor)], "micros"))
            .collect();
        let all: Vec<f64> = micros.iter().flatten().copied().collect();
        let mean = stats::geometric_mean(&all);
        let cells = micros.into_iter().chain([mean]).map(|value| value.map_or("–".to_owned(), number));
        table.row([format!("`{competitor}`")].into_iter().chain(cells));
    }
    table
}

fn prepared(record: &Record) -> Table {
    let mut table = Table::new(["engine", "ms, mean", "ms, most", "MB, mean", "MB, most"]);
    for competitor in record.distinct("competitor") {
        let values = |column: &str, scale: f64| -> Vec<f64> {
            record
                .select(&[("competitor", competitor)])
                .filter_map(|row| Some(scale * row.number(column)?))
                .collect()
        };
        let (times, sizes) = (values("preparation", 1e3), values("bytes", 1e-6));
        let most = |values: &[f64]| values.iter().copied().reduce(f64::max);
        if sizes.is_empty() {
            continue;
        }
        let cells = [stats::mean(&times), most(&times), stats::mean(&sizes), most(&sizes)];
        let cells = cells.map(|value| value.map_or("–".to_owned(), number));
        table.row([format!("`{competitor}`")].into_iter().chain(cells));
    }
    table
}

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
/// Our setups without a counterpart. Those that differ in smoothing alone stand together, so that they share
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
        let (queries, optima): (Vec<Query>, Vec<f64>) = solvable.unzip();
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
