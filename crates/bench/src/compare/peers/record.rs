//! The record of a comparison.

use mediant_report::{Column, Machine, Provenance, Record, Row, stats::median};

use super::{
    super::Options,
    Task,
    list::Runner,
    rounds::{Figures, Rounds},
};

/// The file, from the root.
pub(super) const FILE: &str = "docs/results/data/peers.json";

fn columns() -> Vec<Column> {
    vec![
        Column::key("list", "every 20th instance of the scenarios, or the whole files"),
        Column::key("map", "the map"),
        Column::key("program", "another program, or our engine with its motion"),
        Column::key("beside", "our engine beside it; nothing for ours"),
        Column::key("version", "its version or revision; nothing for ours"),
        Column::count("instances", "", "the queries"),
        Column::count("rounds", "", "those in which it was measured"),
        Column::count("differ", "", "those whose path is not the shortest"),
        Column::time("query", "µs", "the mean time of a query: median of warm passes, median of rounds"),
        Column::time("first", "µs", "the same in the first pass of the process"),
        Column::time("prepared", "s", "the preparation"),
        Column::time("size", "MB", "its memory, or the size of its file"),
    ]
}

/// The name of a list.
fn name_of_list(every: u32) -> String {
    if every == 1 { "whole files".to_owned() } else { format!("every {every}th") }
}

/// The record of all rounds.
pub(super) fn record(
    rounds: &Rounds,
    tasks: &[Task],
    runners: &[Runner],
    revision: String,
    options: &Options,
) -> Record {
    let mut rows = Vec::new();
    for task in tasks {
        for runner in runners {
            let figures = rounds.figures(task.every, &task.name, runner.name());
            if !figures.is_empty() {
                rows.push(row(task, runner, &figures));
            }
        }
    }
    let maps = tasks.iter().filter(|task| Some(task.every) == options.lists.first().copied());
    Record {
        id: "peers".to_owned(),
        title: "Mediant beside other programs".to_owned(),
        provenance: Provenance {
            revision,
            machine: Machine::here(),
            maps: maps.count(),
            instances: tasks.iter().map(|task| task.problem.len() as u64).sum(),
            drawn: "the instances of the lists; each program alone on one core, in rounds of several orders"
                .to_owned(),
            passes: Some(options.passes),
            ..Provenance::default()
        },
        columns: columns(),
        rows,
    }
}

fn row(task: &Task, runner: &Runner, figures: &[Figures]) -> Row {
    let (beside, version) = match runner {
        Runner::Ours(..) => (String::new(), String::new()),
        Runner::Theirs(peer, setup) => (setup.to_string(), peer.version.clone()),
    };
    let middle = |figure: &dyn Fn(&Figures) -> Option<f64>| {
        median(&figures.iter().filter_map(figure).collect::<Vec<f64>>())
    };
    let row = Row::new().key("list", name_of_list(task.every)).key("map", &task.name);
    row.key("program", runner.name())
        .key("beside", beside)
        .key("version", version)
        .with("instances", task.problem.len() as f64)
        .with("rounds", figures.len() as f64)
        .with("differ", middle(&|figures| Some(f64::from(figures.differ))))
        .with("query", middle(&|figures| Some(figures.query)))
        .with("first", middle(&|figures| Some(figures.first)))
        .with("prepared", middle(&|figures| figures.prepared))
        .with("size", middle(&|figures| figures.bytes.map(|bytes| bytes / 1e6)))
}
