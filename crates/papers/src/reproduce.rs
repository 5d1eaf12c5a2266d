//! `cargo xtask reproduce-tables`: measures, writes the records, and draws or checks.

use std::{
    path::{Path, PathBuf},
    time::Instant,
};

use clap::Args;
use mediant_report::{ColumnKind, Machine, Provenance, Record, revision};
use mediant_sets::root;

use crate::{
    Error,
    catalog::chosen,
    check::{bless, check},
    context::{Context, Request, Setting},
    experiment::{Experiment, Findings},
    pages,
    records::{DATA, write},
};

/// The options of `cargo xtask reproduce-tables`.
#[derive(Args, Clone, Debug)]
pub struct Options {
    /// Only these experiments, or all of these pages
    #[arg(long, value_name = "ID", num_args = 1..)]
    only: Vec<String>,
    /// All but these experiments, or those of these pages
    #[arg(long, value_name = "ID", num_args = 1..)]
    without: Vec<String>,
    /// An even sample of everything: minutes instead of most of an hour
    #[arg(long)]
    quick: bool,
    /// Only these benchmark sets
    #[arg(long, value_name = "NAME", num_args = 1..)]
    sets: Vec<String>,
    /// How many maps are counted at once; times are always taken map by map [default: all cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,
    /// A folder or an address that holds the archives of sets that were not downloaded
    #[arg(long, value_name = "DIR|URL", env = "MEDIANT_MIRROR")]
    mirror: Option<String>,
    /// The seed of what is drawn at random
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

/// Measures and writes the pages.
///
/// # Errors
/// As for [`run_in`].
pub fn run(options: &Options) -> Result<(), Error> {
    run_in(&root(), options)
}

/// [`run`] in the project at `root`.
///
/// # Errors
/// [`Error::Reproduce`] for an unknown experiment, and for counts that differ from the last run;
/// [`Error::Set`] for an unknown set and for downloads; the errors of files.
pub fn run_in(root: &Path, options: &Options) -> Result<(), Error> {
    let experiments = chosen(&options.only, &options.without)?;
    let results = root.join("docs").join("results");
    if options.render {
        return pages::write_all(options.out.as_deref().unwrap_or(&results));
    }
    let checked = options.check || options.bless;
    let quick = options.quick || checked;
    let request = Request { quick, timed: !checked, seed: options.seed, sets: options.sets.clone() };
    let setting = Setting::new(root, request, options.jobs.unwrap_or(0).into())?;
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

fn measure(setting: &Setting, experiment: &'static Experiment) -> Result<Record, Error> {
    let context = Context::new(setting, experiment.id, experiment.sets);
    if context.is_bundled() {
        eprintln!(
            "{}: none of the sets {} is there. It runs on the maps that come with the project: these are not \
             the paper's.",
            experiment.id,
            experiment.sets.join(", ")
        );
    }
    let begin = Instant::now();
    let Findings { columns, rows, maps, instances, drawn, seeded } = (experiment.measure)(&context)?;
    eprintln!("{:<24} {:.0} s", experiment.id, begin.elapsed().as_secs_f64());
    let provenance = Provenance {
        revision: revision(&setting.root),
        machine: Machine::here(),
        sets: context.sets().into_iter().map(str::to_owned).collect(),
        maps,
        instances,
        drawn,
        seed: seeded.then_some(setting.request.seed),
        quick: setting.request.quick,
        bundled: context.is_bundled(),
        passes: (setting.request.timed && columns.iter().any(|column| column.kind == ColumnKind::Time))
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
