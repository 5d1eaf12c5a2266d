//! `cargo xtask compare`: our engines, two crates that everyone can run, and, through those, the programs of
//! `benchdata/reference_timings.json`.

pub mod changes;
pub mod costs;
mod peers;
mod report;

use std::{
    fs,
    io::{self, Write},
    path::{Path, PathBuf},
};

use clap::Args;
use indicatif::ProgressBar;
use mediant::Setup;
use mediant_grid::GridError;
use mediant_report::RecordError;
use mediant_search::QueryError;
use mediant_sets::{Archive, cache, root};

use self::report::Results;
use crate::{
    Baseline, Comparison, Competitor, MapRecord, MeasureError, Problem, ProblemError, ReferenceTimings,
    ReferenceTimingsError, TypedEngine, measure,
};

/// The options of `cargo xtask compare`.
#[derive(Args, Clone, Debug)]
pub struct Options {
    /// Our engines: ENGINE[:K[:RULE]][,OPTION…], RULE one of never, one, always (centers), open, closed
    /// (corners), OPTION one of euclidean, zero, squared, paper, limit=N, intermediate, levels=N, levels=all,
    /// levels=contracted, levels=labels, memory=BYTES, side=N, unstraightened, second=NAME, step=N, detour=N,
    /// smooth, taut
    #[arg(long, value_name = "SETUP", num_args = 1.., default_value = "astar")]
    engines: Vec<Setup>,
    /// Only these maps
    #[arg(long, value_name = "NAME", num_args = 1..)]
    maps: Vec<String>,
    /// Of each scenario, only the instances whose index N divides; the other programs' times are for 20
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..))]
    every: u32,
    /// The timed passes of each competitor over a map, of which the median counts
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..=999))]
    passes: u32,
    /// Also time those of our engines that have a typed planner here as such (subgoal with
    /// levels=contracted), to see what the library adds
    #[arg(long)]
    typed: bool,
    /// A folder that holds the archives (SET-map.zip, SET-scen.zip) of sets that were not downloaded
    #[arg(long, value_name = "DIR", env = "MEDIANT_MIRROR")]
    mirror: Option<PathBuf>,
    /// Instead, time engines on maps that change, and write docs/results/changes.md with its record
    #[arg(long, group = "study", conflicts_with_all = ["engines", "maps", "typed", "json"])]
    changes: bool,
    /// Instead, measure cost surfaces, and write docs/results/costs.md with its record
    #[arg(long, group = "study", conflicts_with_all = ["engines", "maps", "typed", "json"])]
    costs: bool,
    /// With --changes or --costs: measure nothing, but draw the page again from its record
    #[arg(long, requires = "study")]
    render: bool,
    /// Instead, time our engines beside the programs that DIR/peers.json names, each alone in its process,
    /// and write docs/results/data/peers.json
    #[arg(long, value_name = "DIR", group = "study", conflicts_with_all = ["engines", "typed", "every"])]
    peers: Option<PathBuf>,
    /// With --peers: the lists, each of the instances whose index N divides
    #[arg(long, value_name = "N", num_args = 1.., default_values_t = [20, 1], requires = "peers")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..))]
    lists: Vec<u32>,
    /// With --peers: the rounds, of which the median counts
    #[arg(long, value_name = "N", default_value_t = 3, requires = "peers")]
    rounds: u32,
    /// With --peers: the seconds of passes after the first, if --passes are over sooner
    #[arg(long, value_name = "S", default_value_t = 1.0, requires = "peers")]
    seconds: f64,
    /// With --peers: the minutes after which a program is stopped on a map
    #[arg(long, value_name = "N", default_value_t = 30.0, requires = "peers")]
    minutes: f64,
    /// Be one of the programs that --peers runs
    #[arg(long, value_name = "WORD", num_args = 1.., hide = true, allow_hyphen_values = true, group = "study")]
    alone: Vec<String>,
    /// Also write all figures to this file; with --peers, the record to this one alone
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

/// A comparison that could not be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CompareError {
    /// Damaged reference timings.
    #[error(transparent)]
    ReferenceTimings(#[from] ReferenceTimingsError),
    /// A map or scenario that cannot be measured on.
    #[error(transparent)]
    Problem(#[from] ProblemError),
    /// A wrong answer.
    #[error(transparent)]
    Measure(#[from] MeasureError),
    /// A call of the library that failed.
    #[error(transparent)]
    Library(Box<mediant::Error>),
    /// A record that cannot be read.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// Paths of another length than those of the first engine.
    #[error("{engine} on map `{map}`: expected paths of length {expected} in all, found {found}")]
    Lengths {
        /// The engine and the motion.
        engine: String,
        /// The map.
        map: String,
        /// The length of the first engine's paths.
        expected: f64,
        /// The length of its own.
        found: f64,
    },
    /// A map that has no reference timings.
    #[error("no figures of other programs for map `{name}`: there are some for {known}")]
    UnknownMap {
        /// The name that was asked for.
        name: String,
        /// All names.
        known: String,
    },
    /// A list of other programs that is none.
    #[error("{}: {wrong}", path.display())]
    Peers {
        /// The file.
        path: PathBuf,
        /// In words, the fault.
        wrong: String,
    },
    /// One of our engines that cannot do a map alone.
    #[error("{engine} on map `{map}`: {reason}")]
    Alone {
        /// The engine and the motion.
        engine: String,
        /// The map.
        map: String,
        /// In words, why.
        reason: String,
    },
    /// None of the maps is there.
    #[error("none of the maps is there: {0}")]
    NoMap(String),
    /// The record cannot be read.
    #[error("{}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// The figures cannot be written.
    #[error("{}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// The tables cannot be printed.
    #[error("the output: {0}")]
    Print(#[from] io::Error),
}

/// Measures what the options name, and prints the tables.
///
/// # Errors
/// As for [`run_in`].
pub fn run(options: &Options) -> Result<(), CompareError> {
    run_in(&root(), options, &mut io::stdout().lock())
}

/// [`run`] in the project at `root`, printing to `out`. Maps that are not there are named at the end.
///
/// # Errors
/// [`CompareError`]; above all, an answer that is wrong.
pub fn run_in(root: &Path, options: &Options, out: &mut impl Write) -> Result<(), CompareError> {
    // An address as mirror is for `download`; here only a folder can be read.
    let mirror = options.mirror.clone().filter(|mirror| mirror.is_dir());
    let folders = [Some(cache(root)), mirror];
    let archive = Archive::new(folders.into_iter().flatten());
    if options.changes {
        return if options.render { changes::render(root) } else { changes::run(root, &archive) };
    }
    if options.costs {
        return if options.render { costs::render(root, &archive) } else { costs::run(root, &archive) };
    }
    if !options.alone.is_empty() {
        return Ok(write!(out, "{}", peers::alone::run(&options.alone)?)?);
    }
    if let Some(folder) = &options.peers {
        for refusal in peers::run(root, &archive, folder, options)? {
            writeln!(out, "not measured: {refusal}")?;
        }
        return Ok(());
    }
    let references = ReferenceTimings::bundled()?;
    let names: Vec<&str> = references.maps.iter().map(|row| row.map.as_str()).collect();
    if let Some(name) = options.maps.iter().find(|name| !names.contains(&name.as_str())) {
        return Err(CompareError::UnknownMap { name: name.clone(), known: names.join(", ") });
    }
    let write = |path: &PathBuf, text: String| {
        fs::write(path, text).map_err(|source| CompareError::Write { path: path.clone(), source })
    };
    if let Some(path) = &options.json {
        // An error of writing should come before minutes of measuring, not after.
        write(path, String::new())?;
    }
    let Measured { records, missing } = measure_all(&references, &archive, options)?;
    let advice = missing_advice(&missing);
    if records.is_empty() {
        return Err(CompareError::NoMap(advice));
    }
    let compare = |record: &MapRecord| {
        let timings = record.timings.iter().take(options.engines.len());
        timings.filter_map(|timing| Comparison::new(&references, record, timing)).collect()
    };
    let comparisons = records.iter().map(compare).collect();
    let results = Results {
        references: &references,
        setups: &options.engines,
        every: options.every,
        passes: options.passes,
        records,
        comparisons,
    };
    out.write_all(report::text(&results).as_bytes())?;
    if !missing.is_empty() {
        writeln!(out, "\nMissing: {advice}")?;
    }
    match &options.json {
        None => Ok(()),
        Some(path) => write(path, report::json(root, &results)),
    }
}

impl CompareError {
    /// Names the file or folder that cannot be read.
    fn at_read(path: &Path) -> impl FnOnce(io::Error) -> Self {
        move |source| Self::Read { path: path.to_owned(), source }
    }

    /// Names the file or folder that cannot be written.
    fn at_write(path: &Path) -> impl FnOnce(io::Error) -> Self {
        move |source| Self::Write { path: path.to_owned(), source }
    }
}

impl From<mediant::Error> for CompareError {
    fn from(error: mediant::Error) -> Self {
        Self::Library(Box::new(error))
    }
}

impl From<QueryError> for CompareError {
    fn from(error: QueryError) -> Self {
        mediant::Error::from(error).into()
    }
}

impl From<GridError> for CompareError {
    fn from(error: GridError) -> Self {
        mediant::Error::from(error).into()
    }
}

/// The maps that were measured, and those that are missing.
#[derive(Default)]
struct Measured<'a> {
    records: Vec<MapRecord>,
    /// The set and the name of each missing map.
    missing: Vec<(&'a str, &'a str)>,
}

fn measure_all<'a>(
    references: &'a ReferenceTimings,
    archive: &Archive,
    options: &Options,
) -> Result<Measured<'a>, CompareError> {
    let ours = options.engines.iter().copied().map(Competitor::Ours);
    let typed = options.engines.iter().filter(|_| options.typed).copied().filter_map(TypedEngine::of);
    let competitors = ours.chain(Baseline::ALL.map(Competitor::Baseline)).chain(typed.map(Competitor::Typed));
    let competitors: Vec<Competitor> = competitors.collect();
    let rows =
        references.maps.iter().filter(|row| options.maps.is_empty() || options.maps.contains(&row.map));
    let rows: Vec<_> = rows.collect();
    let bar = ProgressBar::new(rows.len() as u64);
    let mut measured = Measured::default();
    for row in rows {
        bar.set_message(row.map.clone());
        match Problem::load(archive, &row.set, &row.map, options.every as usize)? {
            Some(problem) => measured.records.push(measure(&problem, &competitors, options.passes as usize)?),
            None => measured.missing.push((row.set.as_str(), row.map.as_str())),
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(measured)
}

/// Which maps are missing, and how to get them.
fn missing_advice(missing: &[(&str, &str)]) -> String {
    let names: Vec<&str> = missing.iter().map(|(_, map)| *map).collect();
    let mut sets: Vec<&str> = missing.iter().map(|(set, _)| *set).collect();
    sets.dedup();
    format!("{}; `cargo xtask download --set {}` fetches them", names.join(", "), sets.join(" "))
}

#[cfg(test)]
mod tests;
