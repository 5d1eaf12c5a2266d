//! `cargo xtask verify`: our costs against known ones, on the real benchmark sets.
//!
//! Each instance of the downloaded sets is compared with the optimal length that its scenario states; or with
//! the costs that independent programs found, in a folder of files `KIND-kK-MAP.csv` and `any-GAP-MAP.csv`.
//! An engine that is not optimal must find a path wherever there is one, and none that is shorter than the
//! known cost. How many costs were compared is part of the result, so that a file that is skipped does not
//! look like a success.

mod scenarios;

use std::{
    collections::BTreeMap,
    fmt::Write as _,
    fs, io,
    num::NonZeroUsize,
    path::{Path, PathBuf},
    sync::Arc,
};

use clap::Args;
use mediant::{Engine, Map, Motion, Planner, Setup};
use mediant_formats::{MapFile, Scenario};
use mediant_grid::{CornerRule, DiagonalGap, Rules};
use mediant_moves::K;
use mediant_search::{Ends, QueryError};
use mediant_sets::{Error as SetError, cache, files, progress, root};
use rayon::prelude::*;

/// The options of `cargo xtask verify`.
#[derive(Args, Clone, Debug)]
pub struct Options {
    /// Only these benchmark sets, of those that `download` fetched
    #[arg(long, value_name = "NAME", num_args = 1..)]
    set: Vec<String>,
    /// Of each scenario, only the instances whose index N divides
    #[arg(long, value_name = "N", default_value = "1")]
    every: NonZeroUsize,
    /// Of each set, only every Nth map, the first among them; of reference costs, every Nth file
    #[arg(long, value_name = "N", default_value = "1")]
    every_map: NonZeroUsize,
    /// The engines to verify, one after the other
    #[arg(long, value_name = "NAME", num_args = 1.., default_value = "astar")]
    engine: Vec<Engine>,
    /// Compare with the reference costs in this folder, not with the scenarios' optima
    #[arg(long, value_name = "DIR")]
    oracle: Option<PathBuf>,
    /// Fail unless exactly N costs were compared, over all engines
    #[arg(long, value_name = "N", value_parser = number)]
    expect: Option<u64>,
}

impl Options {
    /// The maps of a set, or an even sample of them.
    fn maps(&self, folder: &Path) -> Result<Vec<PathBuf>, SetError> {
        Ok(files(folder, ".map")?.into_iter().step_by(self.every_map.get()).collect())
    }

    /// Whether every instance is compared.
    const fn is_whole(&self) -> bool {
        self.every.get() == 1 && self.every_map.get() == 1
    }
}

/// A failure of `verify`.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum VerifyError {
    /// Costs that differ from the known ones, another number of comparisons than expected, or a file that
    /// makes no sense.
    #[error("{0}")]
    Wrong(String),
    /// A benchmark set that cannot be read.
    #[error(transparent)]
    Set(#[from] SetError),
    /// A map or scenario that cannot be read.
    #[error(transparent)]
    Read(#[from] mediant_formats::ReadError),
    /// The report cannot be printed.
    #[error("the output: {0}")]
    Print(#[from] io::Error),
}

/// A number that may be written with underscores.
pub(crate) fn number(text: &str) -> Result<u64, std::num::ParseIntError> {
    text.replace('_', "").parse()
}

/// How the costs of an engine must relate to the known ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Relation {
    /// They are equal.
    Equal,
    /// They are equal or greater.
    AtLeast,
}

impl Relation {
    /// The relation of a setup's costs to the optimal ones for its k; none for any-angle paths that may be
    /// longer than the shortest.
    fn of(setup: Setup) -> Option<Self> {
        match setup.optimal_over() {
            _ if setup.check().is_err() => None,
            Some(k) => (k == setup.k()).then_some(Self::Equal),
            None => (setup.paths() == setup.k()).then_some(Self::AtLeast),
        }
    }
}

/// The comparisons of a file, or of several.
#[derive(Clone, Debug, Default)]
struct Tally {
    compared: u64,
    /// Instances of [`OTHER_MAPS`] that are invalid queries: an end is on a blocked cell.
    blocked: u64,
    /// Instances of [`OTHER_MAPS`] whose reference is shorter than any path on the map.
    shorter: u64,
    /// Instances of [`OTHER_MAPS`] whose reference is longer than a path on the map.
    longer: u64,
    /// The largest difference among the costs that agree, relative to the known cost.
    worst: f64,
    /// The sums of all costs found, and of the known ones.
    sums: [f64; 2],
    mismatches: Vec<String>,
}

impl Tally {
    fn compare(
        &mut self,
        relation: Relation,
        what: impl FnOnce() -> String,
        found: Option<f64>,
        known: Option<f64>,
        tolerance: f64,
    ) {
        self.compared += 1;
        let agrees = match (found, known) {
            (Some(found), Some(known)) => {
                let (difference, shorter) = ((found - known).abs(), known - found);
                let agrees = if relation == Relation::Equal { difference } else { shorter } <= tolerance;
                if agrees {
                    self.worst = self.worst.max(difference / known.max(1.0));
                    self.sums = [self.sums[0] + found, self.sums[1] + known];
                }
                agrees
            }
            (None, None) => true,
            _ => false,
        };
        if !agrees {
            let text = |cost: Option<f64>| cost.map_or("no path".to_owned(), |cost| format!("{cost:.6}"));
            self.mismatches.push(format!("{}: found {}, known {}", what(), text(found), text(known)));
        }
    }

    fn add(mut self, other: Self) -> Self {
        self.compared += other.compared;
        self.blocked += other.blocked;
        self.shorter += other.shorter;
        self.longer += other.longer;
        self.worst = self.worst.max(other.worst);
        self.sums = [self.sums[0] + other.sums[0], self.sums[1] + other.sums[1]];
        self.mismatches.extend(other.mismatches);
        self
    }

    /// How far the costs are from the known ones.
    fn distance(&self, relation: Relation) -> String {
        let wrong = self.mismatches.len();
        match relation {
            Relation::Equal => {
                format!("{wrong} differ, the others by at most {:.1e} of the cost", self.worst)
            }
            Relation::AtLeast => {
                let longer = (self.sums[0] / self.sums[1].max(1.0) - 1.0) * 100.0;
                let worst = self.worst * 100.0;
                format!("{wrong} are wrong, the others {longer:.3} % longer in all and {worst:.1} % at most")
            }
        }
    }
}

/// Compares, and prints what was compared.
///
/// # Errors
/// As for [`run_in`].
pub fn run(options: &Options) -> Result<(), VerifyError> {
    run_in(&cache(&root()), options, &mut io::stdout().lock())
}

/// [`run`] on the sets in the folder `cache`, each in a folder of its name, printing to `out`.
///
/// # Errors
/// [`VerifyError`]; above all, a cost that differs or a count that is not the expected one.
pub fn run_in(cache: &Path, options: &Options, out: &mut dyn io::Write) -> Result<(), VerifyError> {
    let mut total = Tally::default();
    for &engine in &options.engine {
        writeln!(out, "{engine}")?;
        total = total.add(match &options.oracle {
            Some(folder) => against_references(cache, folder, options.every_map, engine, out)?,
            None => scenarios::against_scenarios(cache, options, engine, out)?,
        });
    }
    if !total.mismatches.is_empty() {
        let mut text = format!("{} of {} costs differ", total.mismatches.len(), total.compared);
        for mismatch in total.mismatches.iter().take(10) {
            let _ = write!(text, "\n  {mismatch}");
        }
        return Err(VerifyError::Wrong(text));
    }
    match options.expect {
        Some(expected) if expected != total.compared => {
            Err(VerifyError::Wrong(format!("expected {expected} comparisons, made {}", total.compared)))
        }
        _ if total.compared == 0 => {
            Err(VerifyError::Wrong("nothing was compared: cargo xtask download fetches the sets".to_owned()))
        }
        _ => Ok(()),
    }
}

/// The cost of a query's answer; `None` where there is no path.
fn cost(planner: &mut Planner, query: Ends) -> Result<Option<f64>, QueryError> {
    planner.find(query).map(|answer| answer.path().map(|path| path.cost()))
}

/// The setup and the map that the name of a reference file states.
fn reference_setup(name: &str, engine: Engine) -> Option<(Setup, &str)> {
    let (kind, rest) = name.strip_suffix(".csv")?.split_once('-')?;
    let (part, map) = rest.split_once('-')?;
    let k = || part.strip_prefix('k')?.parse::<K>().ok();
    let (k, rules) = match (kind, part) {
        ("any", "open") => (K::Any, Rules::Corner(DiagonalGap::Open)),
        ("any", "closed") => (K::Any, Rules::Corner(DiagonalGap::Closed)),
        ("center", _) => (k()?, Rules::Center(CornerRule::Never)),
        ("corner", _) => (k()?, Rules::Corner(DiagonalGap::Open)),
        _ => return None,
    };
    Some((Setup::new(engine, Motion::new(k, rules)), map))
}

fn against_references(
    cache: &Path,
    folder: &Path,
    every: NonZeroUsize,
    engine: Engine,
    out: &mut dyn io::Write,
) -> Result<Tally, VerifyError> {
    let mut maps = BTreeMap::new();
    for set in fs::read_dir(cache).map_err(SetError::at(cache))? {
        let set = set.map_err(SetError::at(cache))?.path();
        if set.is_dir() {
            for map in files(&set, ".map")? {
                maps.insert(map.file_stem().unwrap_or_default().to_string_lossy().into_owned(), map);
            }
        }
    }
    let references: Vec<PathBuf> = files(folder, ".csv")?.into_iter().step_by(every.get()).collect();
    let bar = progress("references", references.len());
    let tallies: Vec<Compared> = references
        .par_iter()
        .map(|file| reference(file, engine, &maps).inspect(|_| bar.inc(1)))
        .collect::<Result<_, _>>()?;
    bar.finish_and_clear();
    let (mut total, mut files, mut unsupported, mut unknown) = (Tally::default(), 0, 0, 0);
    let mut weakest = Relation::Equal;
    for compared in tallies {
        match compared {
            Compared::Costs(tally, relation) => {
                files += 1;
                if relation == Relation::AtLeast {
                    weakest = relation;
                }
                total = total.add(tally);
            }
            Compared::Unsupported => unsupported += 1,
            Compared::Unknown => unknown += 1,
        }
    }
    writeln!(
        out,
        "{files} files, {} costs compared with independent programs: {}",
        total.compared,
        total.distance(weakest)
    )?;
    writeln!(
        out,
        "not compared: {unsupported} files of problems that {engine} does not solve, {unknown} whose names \
         say no problem"
    )?;
    Ok(total)
}

/// The result of a file of reference costs.
enum Compared {
    Costs(Tally, Relation),
    /// The engine does not search this k, or finds longer paths at any angle.
    Unsupported,
    /// Its name states no problem.
    Unknown,
}

fn reference(file: &Path, engine: Engine, maps: &BTreeMap<String, PathBuf>) -> Result<Compared, VerifyError> {
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    let Some((setup, map)) = reference_setup(&name, engine) else { return Ok(Compared::Unknown) };
    let Some(relation) = Relation::of(setup) else { return Ok(Compared::Unsupported) };
    let wrong = |wrong: String| VerifyError::Wrong(format!("{name}: {wrong}"));
    let Some(path) = maps.get(map) else {
        return Err(wrong(format!("map {map} is not in the cache: cargo xtask download")));
    };
    let text = fs::read_to_string(file).map_err(SetError::at(file))?;
    let row = |line: &str| -> Option<(usize, f64)> {
        let (index, cost) = line.split_once(',')?;
        Some((index.parse().ok()?, cost.parse().ok()?))
    };
    let rows: Vec<(usize, f64)> = text
        .lines()
        .skip(1)
        .map(|line| row(line).ok_or_else(|| wrong(format!("no index and cost: `{line}`"))))
        .collect::<Result<_, _>>()?;
    let grid = Arc::new(MapFile::read(path)?.to_grid());
    let scenario = Scenario::read(path.with_extension("map.scen"))?;
    let mut tally = Tally::default();
    let mut planner =
        setup.planner(&Map::from(Arc::clone(&grid))).map_err(|error| wrong(error.to_string()))?;
    for &(index, known) in &rows {
        let instance = scenario.instances().get(index);
        let instance = instance.ok_or_else(|| wrong(format!("no instance {index}")))?;
        let found = cost(&mut planner, Ends::new(instance.start, instance.goal)).unwrap_or(None);
        let what = || format!("{setup}, {name} instance {index}");
        // For a blocked end, those programs report that there is no path.
        tally.compare(relation, what, found, (known >= 0.0).then_some(known), 1e-6 * known.max(1.0));
    }
    Ok(Compared::Costs(tally, relation))
}
