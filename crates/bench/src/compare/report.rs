//! The results of a comparison, as text and as JSON.

use std::path::Path;

use mediant::Setup;
use mediant_report::{
    Machine, Table, number, revision,
    stats::{geometric_mean, median},
};
use serde::Serialize;

use crate::{Comparison, MapRecord, ReferenceProgram, ReferenceTimings};

/// All figures of a run.
pub(super) struct Results<'a> {
    /// The times of the other programs.
    pub(super) references: &'a ReferenceTimings,
    /// Our engines.
    pub(super) setups: &'a [Setup],
    /// Of each scenario, the instances whose index this divides.
    pub(super) every: u32,
    /// The timed passes, of which the median counts.
    pub(super) passes: u32,
    /// The measurements, map by map.
    pub(super) records: Vec<MapRecord>,
    /// For each map, the comparisons of the setups in their order.
    pub(super) comparisons: Vec<Vec<Comparison>>,
}

/// The tables: times, then for each setup its ratios to the programs that solve the same problem, and to the
/// others.
pub(super) fn text(results: &Results<'_>) -> String {
    let mut lines = vec![format!(
        "Mean time of a query in µs: one thread, warm, paths included; median of {} passes.",
        results.passes
    )];
    lines.extend(times(results).lines());
    lines.push(
        "here/there: the baselines' times by those on the machine of the other programs, geometric mean."
            .into(),
    );
    lines.extend(disturbance(&scales(results)));
    if results.every as usize != results.references.instances.every {
        let every = results.references.instances.every;
        lines.push(format!(
            "The times there are for --every {every}: the ratios compare different instances."
        ));
    }
    lines.extend(door(results));
    for (i, &setup) in results.setups.iter().enumerate() {
        let (same, other): (Vec<_>, Vec<_>) =
            results.references.programs.iter().enumerate().partition(|(_, program)| program.solves(setup));
        if !same.is_empty() {
            let quality = if setup.optimal_over().is_some() { "" } else { ", neither optimally" };
            lines.push(format!(
                "\n{setup} by the scaled time of programs that solve the same problem{quality} (< 1: we are \
                 faster)"
            ));
            lines.extend(ratios(results, i, &same).lines());
            if setup.capabilities().index.is_some() {
                lines.push(format!(
                    "\n{setup}: what comes before the first query, on all cores, by the scaled time and the \
                     index file of these programs"
                ));
                lines.extend(preparation(results, i, &same).lines());
            }
        }
        if !other.is_empty() {
            lines.push(format!("\n{setup} by the scaled time of programs that solve another problem"));
            lines.extend(ratios(results, i, &other).lines());
        }
    }
    lines.join("\n") + "\n"
}

fn times(results: &Results<'_>) -> Table {
    let first = results.records.first().map_or(&[][..], |record| &record.timings);
    let mut heading = vec!["map".to_owned(), "queries".to_owned()];
    heading.extend(first.iter().map(|timing| timing.competitor.clone()));
    heading.push("here/there".to_owned());
    let mut table = Table::new(heading);
    for (record, comparisons) in results.records.iter().zip(&results.comparisons) {
        let mut row = vec![record.map.clone(), record.instances.to_string()];
        row.extend(record.timings.iter().map(|timing| number(timing.micros)));
        row.push(comparisons.first().map_or(String::new(), |comparison| number(comparison.scale)));
        table.row(row);
    }
    let mean = |value: &dyn Fn(&MapRecord) -> Option<f64>| {
        let values: Vec<f64> = results.records.iter().filter_map(value).collect();
        geometric_mean(&values).map_or(String::new(), number)
    };
    let queries: usize = results.records.iter().map(|record| record.instances).sum();
    let mut row = vec!["geometric mean".to_owned(), queries.to_string()];
    row.extend((0..first.len()).map(|i| mean(&|record| record.timings.get(i).map(|timing| timing.micros))));
    row.push(geometric_mean(&scales(results)).map_or(String::new(), number));
    table.row(row);
    table
}

/// The library's overhead over a typed planner, where that was timed: a line for each setup.
fn door(results: &Results<'_>) -> Vec<String> {
    let micros = |record: &MapRecord, name: &str| {
        record.timings.iter().find(|timing| timing.competitor == name).map(|timing| timing.micros)
    };
    let line = |setup: &Setup| {
        let (ours, typed) = (setup.to_string(), format!("typed {setup}"));
        let pair = |record: &MapRecord| micros(record, &ours).zip(micros(record, &typed));
        let pairs: Vec<(f64, f64)> = results.records.iter().filter_map(pair).collect();
        let nanos: Vec<f64> = pairs.iter().map(|(ours, typed)| 1e3 * (ours - typed)).collect();
        let most = nanos.iter().copied().fold(f64::MIN, f64::max);
        let ratio = geometric_mean(&pairs.iter().map(|(ours, typed)| ours / typed).collect::<Vec<_>>())?;
        let median = median(&nanos)?;
        Some(format!(
            "\n{setup}: the library adds {median:.0} ns to a query of the typed planner (median of maps; at \
             most {most:.0}), and takes {ratio:.4} of its time"
        ))
    };
    results.setups.iter().filter_map(line).collect()
}

/// For each map, the time of the baselines here over their time on the machine of the other programs.
fn scales(results: &Results<'_>) -> Vec<f64> {
    results.comparisons.iter().filter_map(|all| Some(all.first()?.scale)).collect()
}

/// A warning if the ratio of the machines varies more from map to map than it does between idle machines,
/// where it stays within 1.15. Other work on the machine slows the baselines more than engines whose data fit
/// into the caches, and so makes these look better.
fn disturbance(scales: &[f64]) -> Option<String> {
    let (least, most) =
        scales.iter().fold((f64::MAX, 0.0_f64), |(a, b), &scale| (a.min(scale), b.max(scale)));
    let factor = most / least;
    (factor > 1.3).then(|| {
        format!(
            "CAUTION: here/there differs by a factor of {factor:.2} from map to map: was the machine \
             busy? Measure again."
        )
    })
}

/// The ratios of the setup with index `setup` to some of the programs.
fn ratios(results: &Results<'_>, setup: usize, programs: &[(usize, &ReferenceProgram)]) -> Table {
    let mut heading = vec!["map".to_owned()];
    heading.extend(programs.iter().map(|(_, program)| program.name.clone()));
    let mut table = Table::new(heading);
    let comparisons = || results.comparisons.iter().filter_map(|all| all.get(setup));
    let ratio = |comparison: &Comparison, program: usize| comparison.ratios.get(program).copied().flatten();
    for comparison in comparisons() {
        let mut row = vec![comparison.map.clone()];
        row.extend(programs.iter().map(|(program, _)| cell(ratio(comparison, *program))));
        table.row(row);
    }
    let mean = |(program, _): &(usize, _)| {
        let values: Vec<f64> = comparisons().filter_map(|comparison| ratio(comparison, *program)).collect();
        cell(geometric_mean(&values))
    };
    let mut row = vec!["geometric mean".to_owned()];
    row.extend(programs.iter().map(mean));
    table.row(row);
    table
}

/// The preparation of the setup with index `setup`, and its ratios to the programs that prepare something.
fn preparation(results: &Results<'_>, setup: usize, programs: &[(usize, &ReferenceProgram)]) -> Table {
    let prepares =
        |name: &String| results.references.maps.iter().any(|row| row.preprocessing.contains_key(name));
    let programs: Vec<_> = programs.iter().filter(|(_, program)| prepares(&program.name)).collect();
    let heading = ["map", "ms", "MB"].map(str::to_owned).into_iter();
    let columns = programs
        .iter()
        .flat_map(|(_, program)| ["time", "size"].map(|what| format!("{} {what}", program.name)));
    let mut table = Table::new(heading.chain(columns));
    let mut all: Vec<Vec<Option<f64>>> = Vec::new();
    for (record, comparisons) in results.records.iter().zip(&results.comparisons) {
        let (Some(timing), Some(comparison)) = (record.timings.get(setup), comparisons.get(setup)) else {
            continue;
        };
        let ours = timing.preparation;
        let mut values = vec![ours.map(|ours| 1e3 * ours.seconds), ours.map(|ours| ours.bytes as f64 / 1e6)];
        for (program, _) in &programs {
            let ratio = comparison.preparation.get(*program).copied().flatten();
            values.extend([ratio.map(|ratio| ratio.time), ratio.and_then(|ratio| ratio.bytes)]);
        }
        table.row([record.map.clone()].into_iter().chain(values.iter().copied().map(cell)));
        all.push(values);
    }
    let mean = |column: usize| {
        let values: Vec<f64> = all.iter().filter_map(|row| row[column]).collect();
        cell(geometric_mean(&values))
    };
    table.row(["geometric mean".to_owned()].into_iter().chain((0..2 + 2 * programs.len()).map(mean)));
    table
}

fn cell(value: Option<f64>) -> String {
    value.map_or("–".to_owned(), number)
}

/// The file that `--json` asks for.
#[derive(Serialize)]
struct Figures<'a> {
    /// The revision by `git describe`, with `-dirty` if files differ from it.
    revision: String,
    machine: Machine,
    unit: &'static str,
    every: u32,
    passes: u32,
    engines: Vec<String>,
    /// The programs that `ratios` are about, in their order.
    programs: Vec<&'a str>,
    records: &'a [MapRecord],
    comparisons: &'a [Vec<Comparison>],
}

pub(super) fn json(root: &Path, results: &Results<'_>) -> String {
    let figures = Figures {
        revision: revision(root),
        machine: Machine::here(),
        unit: "microseconds a query",
        every: results.every,
        passes: results.passes,
        engines: results.setups.iter().map(Setup::to_string).collect(),
        programs: results.references.programs.iter().map(|program| program.name.as_str()).collect(),
        records: &results.records,
        comparisons: &results.comparisons,
    };
    // Numbers, strings and lists only: this cannot fail.
    serde_json::to_string_pretty(&figures).unwrap_or_default() + "\n"
}
