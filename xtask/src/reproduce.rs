//! `cargo xtask reproduce-tables`: the papers' tables and figures, measured here, beside the published values.
//!
//! **The key decision: measuring and showing are two steps.** An `Experiment` measures into a
//! [`Record`], which is written as JSON and is all that its pages and figures are drawn from. So pages are drawn again without measuring
//! (`--render`), a test holds the committed pages against the committed records, and a later run is compared number by number
//! (`--check`).
//!
//! To add an experiment: a module with an `Experiment`, and its line in `EXPERIMENTS`.

mod compared;
mod context;
mod engines;
mod experiment;
mod growth;
mod hammoud;
mod hierarchies;
mod hormazabal;
mod kramm;
mod maps;
mod pages;
mod rivera;
mod setups;
mod teleisa;
#[cfg(test)]
mod tests;

use std::{
    fs,
    path::{Path, PathBuf},
    time::Instant,
};

use clap::Args;
use mediant_report::{Provenance, Record};

use self::{
    context::{Context, Setting},
    experiment::{Experiment, Findings, Page},
};
use crate::{Error, project};

/// All experiments, in the order in which they run and stand on the pages.
const EXPERIMENTS: &[Experiment] = &[
    rivera::TABLES,
    rivera::THETA,
    hormazabal::PLANNERS,
    hormazabal::BRANCHING,
    hormazabal::DISTANCE,
    kramm::RATIOS,
    kramm::BOUNDS,
    hammoud::TABLES,
    hammoud::FIGURES,
    teleisa::RUNS,
    engines::ENGINES,
    growth::GROWTH,
    hierarchies::HPA,
    compared::PROGRAMS,
    compared::CENTRAL64,
];

/// The options of `cargo xtask reproduce-tables`.
#[derive(Args, Clone, Debug)]
pub struct Options {
    /// Only these experiments, or all of these pages
    #[arg(long, value_name = "ID", num_args = 1..)]
    only: Vec<String>,
    /// An even sample of everything: minutes instead of most of an hour
    #[arg(long)]
    quick: bool,
    /// Only these benchmark sets
    #[arg(long, value_name = "NAME", num_args = 1..)]
    sets: Vec<String>,
    /// How many maps are counted at once; times are always taken one by one [default: all cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,
    /// A folder or an address that holds the archives of sets that were not downloaded
    #[arg(long, value_name = "DIR|URL", env = "MEDIANT_MIRROR")]
    mirror: Option<String>,
    /// What instances are drawn by
    #[arg(long, value_name = "N", default_value = "2023")]
    seed: u64,
    /// Where the pages go [default: docs/results, or docs/results/quick of a quick run]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Measure nothing: draw the pages and figures from the records that are there
    #[arg(long, conflicts_with_all = ["quick", "check", "bless"])]
    render: bool,
    /// Take no times; compare the counts of a quick run with those of `docs/results/quick.json`
    #[arg(long, conflicts_with_all = ["out", "bless"])]
    check: bool,
    /// Take no times; write what `--check` compares with
    #[arg(long, hide = true, conflicts_with = "out")]
    bless: bool,
}

/// The folder of the records, in that of the pages.
const DATA: &str = "data";
/// The folder of the figures, in that of the pages.
const FIGURES: &str = "figures";
/// By how much counts may differ: sums of numbers that are rounded the same everywhere, but written as text in between.
const TOLERANCE: f64 = 1e-9;

/// Measures and writes the pages.
///
/// # Errors
/// Those of [`run_in`].
pub fn run(options: &Options) -> Result<(), Error> {
    run_in(&project::root(), options)
}

/// [`run`] in the project at `root`.
///
/// # Errors
/// [`Error::Reproduce`] for an unknown experiment or set, and for counts that are not those of the last run; the errors of downloads and files.
pub fn run_in(root: &Path, options: &Options) -> Result<(), Error> {
    let experiments = chosen(&options.only)?;
    let results = root.join("docs").join("results");
    if options.render {
        return pages::write_all(options.out.as_deref().unwrap_or(&results));
    }
    let checked = options.check || options.bless;
    let quick = options.quick || checked;
    let setting = Setting::new(root, options, quick, !checked)?;
    let needed = || experiments.iter().flat_map(|experiment| experiment.sets.iter().copied());
    setting.provide(needed(), options.mirror.as_deref())?;
    let out =
        options.out.clone().unwrap_or_else(|| if quick { results.join("quick") } else { results.clone() });
    let mut records = Vec::new();
    for experiment in &experiments {
        let record = measure(&setting, experiment)?;
        if !checked {
            write(&out.join(DATA).join(format!("{}.json", record.id)), &record.json())?;
        }
        records.push(record);
    }
    let counts = results.join("quick.json");
    if options.bless {
        bless(&counts, &records)?;
    } else if options.check {
        check(&counts, &records)?;
    } else {
        pages::write_all(&out)?;
        println!("{}", out.join("README.md").display());
    }
    setting.forget()
}

/// The experiments of these names, or of the pages of these names; all for none.
fn chosen(names: &[String]) -> Result<Vec<&'static Experiment>, Error> {
    let is =
        |experiment: &Experiment, name: &String| experiment.id == name || experiment.page.file() == *name;
    if let Some(name) = names.iter().find(|name| !EXPERIMENTS.iter().any(|experiment| is(experiment, name))) {
        let known: Vec<&str> = EXPERIMENTS.iter().map(|experiment| experiment.id).collect();
        let pages = Page::ALL.map(Page::file).join(", ");
        let there = format!("there are {}, and the pages {pages}", known.join(", "));
        return Err(Error::Reproduce(format!("unknown experiment `{name}`: {there}")));
    }
    let asked = |experiment: &&Experiment| names.is_empty() || names.iter().any(|name| is(experiment, name));
    Ok(EXPERIMENTS.iter().filter(asked).collect())
}

fn measure(setting: &Setting, experiment: &'static Experiment) -> Result<Record, Error> {
    let context = Context::new(setting, experiment);
    if context.is_bundled() {
        eprintln!(
            "{}: none of the sets {} is there. It runs on the maps that come with the project: these are not the paper's.",
            experiment.id,
            experiment.sets.join(", ")
        );
    }
    let begin = Instant::now();
    let Findings { columns, rows, maps, instances, drawn, seeded } = (experiment.measure)(&context)?;
    eprintln!("{:<24} {:.0} s", experiment.id, begin.elapsed().as_secs_f64());
    let provenance = Provenance {
        revision: project::revision(&setting.root),
        machine: project::machine(),
        sets: context.sets().into_iter().map(str::to_owned).collect(),
        maps,
        instances,
        drawn,
        seed: seeded.then_some(setting.seed),
        quick: setting.quick,
        bundled: context.is_bundled(),
        passes: (setting.timed
            && columns.iter().any(|column| column.kind == mediant_report::ColumnKind::Time))
        .then_some(context.passes()),
    };
    let record = Record {
        id: experiment.id.to_owned(),
        title: experiment.title.to_owned(),
        provenance,
        columns,
        rows,
    };
    record.check().map_err(|wrong| Error::Reproduce(wrong.to_string()))?;
    Ok(record)
}

/// Writes a file, and the folder that it is in.
fn write(path: &Path, text: &str) -> Result<(), Error> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(Error::at(folder))?;
    }
    fs::write(path, text).map_err(Error::at(path))
}

/// The records of a folder of results, in the order of the experiments.
fn records(out: &Path) -> Result<Vec<(&'static Experiment, Record)>, Error> {
    let mut found = Vec::new();
    for experiment in EXPERIMENTS {
        let path = out.join(DATA).join(format!("{}.json", experiment.id));
        if path.is_file() {
            let text = fs::read_to_string(&path).map_err(Error::at(&path))?;
            let wrong = |wrong| Error::Reproduce(format!("{}: {wrong}", path.display()));
            found.push((experiment, Record::parse(&text).map_err(wrong)?));
        }
    }
    Ok(found)
}

/// Writes the counts that `--check` compares with; those of experiments that were not run stay.
fn bless(path: &Path, records: &[Record]) -> Result<(), Error> {
    let mut known = if path.is_file() { blessed(path)? } else { Vec::new() };
    known.retain(|old| !records.iter().any(|new| new.id == old.id));
    known.extend(records.iter().map(Record::counts));
    known.sort_by_key(|record| EXPERIMENTS.iter().position(|experiment| experiment.id == record.id));
    let texts: Vec<String> = known.iter().map(Record::json).collect();
    write(path, &format!("[\n{}]\n", texts.join(",\n")))
}

fn blessed(path: &Path) -> Result<Vec<Record>, Error> {
    let text = fs::read_to_string(path).map_err(Error::at(path))?;
    serde_json::from_str(&text).map_err(|wrong| Error::Reproduce(format!("{}: {wrong}", path.display())))
}

fn check(path: &Path, records: &[Record]) -> Result<(), Error> {
    let known = blessed(path)?;
    let mut numbers = 0;
    let mut differences = Vec::new();
    for record in records {
        match known.iter().find(|known| known.id == record.id) {
            None => differences.push(format!("{}: not in {}", record.id, path.display())),
            Some(known) => {
                differences.extend(record.differences(known, TOLERANCE).iter().map(ToString::to_string));
            }
        }
        numbers += record.counts().rows.iter().map(|row| row.values().count()).sum::<usize>();
    }
    if differences.is_empty() {
        println!("{numbers} numbers of {} experiments are those of the last run", records.len());
        return Ok(());
    }
    let shown = differences.iter().take(20).map(|difference| format!("\n  {difference}")).collect::<String>();
    Err(Error::Reproduce(format!(
        "{} numbers are not those of {}:{shown}\n--bless writes the new ones, once it is known why",
        differences.len(),
        path.display()
    )))
}
