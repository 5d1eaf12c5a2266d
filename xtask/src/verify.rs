//! `cargo xtask verify`: our costs against known ones, on the real benchmark sets.
//!
//! Every instance of the sets that `download` fetched against the optimal length that its scenario states, or the costs of
//! independent programs in a folder of `PLACEMENT-kK-MAP.csv` files. How many were compared is part of the result: a file
//! that is skipped in silence must not look like a success.

use std::{
    collections::BTreeMap,
    fmt::Write as _,
    fs,
    num::NonZeroUsize,
    path::{Path, PathBuf},
    sync::Arc,
};

use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use mediant_bench::{Engine, Task};
use mediant_formats::{MapFile, Scenario, scenario_tolerance};
use mediant_grid::{CornerRule, DiagonalGap, Rules};
use mediant_moves::K;
use mediant_search::Query;
use rayon::prelude::*;

use crate::{Error, manifest::Manifest, project};

/// What `verify` is asked for.
#[derive(Args, Clone, Debug)]
pub struct Options {
    /// Only these benchmark sets, of those that `download` fetched
    #[arg(long, value_name = "NAME", num_args = 1..)]
    set: Vec<String>,
    /// Of each scenario, only the instances whose index N divides
    #[arg(long, value_name = "N", default_value = "1")]
    every: NonZeroUsize,
    /// Compare with the reference costs in this folder, not with the scenarios' optima
    #[arg(long, value_name = "DIR")]
    oracle: Option<PathBuf>,
    /// Fail unless exactly N costs were compared
    #[arg(long, value_name = "N", value_parser = number)]
    expect: Option<u64>,
}

/// A number that may be written with underscores.
fn number(text: &str) -> Result<u64, std::num::ParseIntError> {
    text.replace('_', "").parse()
}

/// What came of one file's comparisons.
#[derive(Clone, Debug, Default)]
struct Tally {
    compared: u64,
    /// Instances of [`OTHER_MAPS`] that are no query: an end is on a blocked cell.
    blocked: u64,
    /// Instances of [`OTHER_MAPS`] whose reference is shorter than any path on the map.
    shorter: u64,
    /// The largest difference that counts as agreement, relative to the known cost.
    worst: f64,
    mismatches: Vec<String>,
}

impl Tally {
    fn compare(
        &mut self,
        what: impl FnOnce() -> String,
        found: Option<f64>,
        known: Option<f64>,
        tolerance: f64,
    ) {
        self.compared += 1;
        let agrees = match (found, known) {
            (Some(found), Some(known)) => {
                let difference = (found - known).abs();
                let agrees = difference <= tolerance;
                if agrees {
                    self.worst = self.worst.max(difference / known.max(1.0));
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
        self.worst = self.worst.max(other.worst);
        self.mismatches.extend(other.mismatches);
        self
    }
}

/// Compares, and prints what was compared.
///
/// # Errors
/// [`Error::Verify`] for a cost that differs or a count that is not the expected one; the errors of reading files.
pub fn run(options: &Options) -> Result<(), Error> {
    let cache = project::root().join("benchdata/cache");
    let total = match &options.oracle {
        Some(folder) => against_references(&cache, folder)?,
        None => against_scenarios(&cache, options)?,
    };
    if !total.mismatches.is_empty() {
        let mut text = format!("{} of {} costs differ", total.mismatches.len(), total.compared);
        for mismatch in total.mismatches.iter().take(10) {
            let _ = write!(text, "\n  {mismatch}");
        }
        return Err(Error::Verify(text));
    }
    match options.expect {
        Some(expected) if expected != total.compared => {
            Err(Error::Verify(format!("expected {expected} comparisons, made {}", total.compared)))
        }
        _ if total.compared == 0 => {
            Err(Error::Verify("nothing was compared: cargo xtask download fetches the sets".to_owned()))
        }
        _ => Ok(()),
    }
}

/// k = 3 between centers, no corner cut: the problem of the scenario files.
const SCENARIOS: Task =
    Task { engine: Engine::AStar, k: K::EIGHT_CONNECTED, rules: Rules::Center(CornerRule::Never) };

fn against_scenarios(cache: &Path, options: &Options) -> Result<Tally, Error> {
    let manifest = Manifest::read(&Manifest::path(&project::root()))?;
    let asked = |name: &String| options.set.is_empty() || options.set.contains(name);
    for name in &options.set {
        manifest.set(name)?;
    }
    let mut total = Tally::default();
    for set in manifest.sets.iter().filter(|set| asked(&set.name)) {
        let folder = cache.join(&set.name);
        if !folder.is_dir() {
            if !options.set.is_empty() {
                return Err(Error::Verify(format!(
                    "set {0} is not there: cargo xtask download --set {0}",
                    set.name
                )));
            }
            continue;
        }
        let maps = files(&folder, ".map")?;
        let bar = progress(&set.name, maps.len());
        let tallies: Vec<Tally> = maps
            .par_iter()
            .map(|map| scenario_of(map, options.every.get(), set.name == OTHER_MAPS).inspect(|_| bar.inc(1)))
            .collect::<Result<_, _>>()?;
        bar.finish_and_clear();
        let tally = tallies.into_iter().fold(Tally::default(), Tally::add);
        let seen = tally.compared + tally.blocked + tally.shorter;
        if options.every.get() == 1 && set.instances.is_some_and(|instances| instances != seen) {
            return Err(Error::Verify(format!("set {}: {seen} instances, not all that it has", set.name)));
        }
        if options.every.get() == 1 && set.name == OTHER_MAPS && (tally.blocked, tally.shorter) != KNOWN {
            let (blocked, shorter) = (tally.blocked, tally.shorter);
            let wrong =
                format!("{blocked} blocked and {shorter} shorter references in {OTHER_MAPS}, not {KNOWN:?}");
            return Err(Error::Verify(wrong));
        }
        println!(
            "{:<12} {:>3} maps, {:>7} costs compared with the scenarios' optima: {} differ, the others by at most {:.1e} of the cost",
            set.name,
            maps.len(),
            tally.compared,
            tally.mismatches.len(),
            tally.worst,
        );
        if tally.blocked + tally.shorter > 0 {
            println!(
                "{:<12} not compared, since made on other maps: {} instances with a blocked end, {} with a shorter reference",
                "", tally.blocked, tally.shorter
            );
        }
        total = total.add(tally);
    }
    println!("{:<12} {} costs compared", "in all", total.compared);
    Ok(total)
}

/// The set whose scenarios were made on other maps than those it holds: their program could stand on cells that the files
/// block. 2,446 instances start or end on such a cell, many of them on a cliff line `@` one cell wide, and yet have an
/// optimal length. So a reference may be shorter than the best path on the map as it is, and never longer.
const OTHER_MAPS: &str = "wc3maps512";
/// How many instances of [`OTHER_MAPS`] have a blocked end, and how many others have a shorter reference: independent
/// programs (`--oracle`) agree with us there.
const KNOWN: (u64, u64) = (2_446, 5_182);

/// One map with its scenario. The scenarios carry as few as six digits, and say 0 where there is no path (173 instances of
/// set dao).
fn scenario_of(path: &Path, every: usize, other_map: bool) -> Result<Tally, Error> {
    let grid = Arc::new(MapFile::read(path)?.to_grid());
    let scenario = Scenario::read(path.with_extension("map.scen"))?;
    let instances: Vec<_> = scenario.instances().iter().enumerate().step_by(every).collect();
    let queries = instances.iter().map(|(_, instance)| Query::new(instance.start, instance.goal));
    let mut tally = Tally::default();
    let mut known = instances.iter();
    SCENARIOS
        .solve_all(&grid, queries, |found| {
            let Some((index, instance)) = known.next() else { return };
            let reachable = instance.optimal > 0.0 || instance.start == instance.goal;
            let optimal = reachable.then_some(instance.optimal);
            let what = || format!("{} instance {index}", path.display());
            match found {
                Err(_) if other_map => tally.blocked += 1,
                Ok(Some(cost))
                    if other_map && cost > instance.optimal + 2.0 * scenario_tolerance(instance.optimal) =>
                {
                    tally.shorter += 1;
                }
                found => {
                    tally.compare(what, found.unwrap_or(None), optimal, scenario_tolerance(instance.optimal));
                }
            }
        })
        .map_err(|wrong| Error::Verify(format!("{}: {wrong}", path.display())))?;
    Ok(tally)
}

/// What the name of a reference file says.
fn reference_task(name: &str) -> Option<(Task, &str)> {
    let (placement, rest) = name.strip_suffix(".csv")?.split_once("-k")?;
    let (k, map) = rest.split_once('-')?;
    let rules = match placement {
        "center" => Rules::Center(CornerRule::Never),
        "corner" => Rules::Corner(DiagonalGap::Open),
        _ => return None,
    };
    Some((Task { engine: Engine::AStar, k: K::new(k.parse().ok()?).ok()?, rules }, map))
}

fn against_references(cache: &Path, folder: &Path) -> Result<Tally, Error> {
    let mut maps = BTreeMap::new();
    for set in fs::read_dir(cache).map_err(Error::at(cache))? {
        let set = set.map_err(Error::at(cache))?.path();
        if set.is_dir() {
            for map in files(&set, ".map")? {
                maps.insert(map.file_stem().unwrap_or_default().to_string_lossy().into_owned(), map);
            }
        }
    }
    let references = files(folder, ".csv")?;
    let bar = progress("references", references.len());
    let tallies: Vec<Option<Tally>> = references
        .par_iter()
        .map(|file| reference(file, &maps).inspect(|_| bar.inc(1)))
        .collect::<Result<_, _>>()?;
    bar.finish_and_clear();
    let other = tallies.iter().filter(|tally| tally.is_none()).count();
    let total = tallies.into_iter().flatten().fold(Tally::default(), Tally::add);
    println!(
        "{} files, {} costs compared with independent programs: {} differ, the others by at most {:.1e} of the cost; {other} files are of engines to come",
        references.len() - other,
        total.compared,
        total.mismatches.len(),
        total.worst
    );
    Ok(total)
}

/// One file of reference costs; `None` for one that no engine of ours answers to.
fn reference(file: &Path, maps: &BTreeMap<String, PathBuf>) -> Result<Option<Tally>, Error> {
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    let Some((task, map)) = reference_task(&name) else { return Ok(None) };
    let wrong = |wrong: String| Error::Verify(format!("{name}: {wrong}"));
    let Some(path) = maps.get(map) else {
        return Err(wrong(format!("map {map} is not in the cache: cargo xtask download")));
    };
    let text = fs::read_to_string(file).map_err(Error::at(file))?;
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
    let mut queries = Vec::with_capacity(rows.len());
    for (index, _) in &rows {
        let instance =
            scenario.instances().get(*index).ok_or_else(|| wrong(format!("no instance {index}")))?;
        queries.push(Query::new(instance.start, instance.goal));
    }
    let mut tally = Tally::default();
    let mut known = rows.iter();
    task.solve_all(&grid, queries, |found| {
        if let Some(&(index, cost)) = known.next() {
            let what = || format!("{name} instance {index}");
            // Those programs know no blocked ends: they say that there is no path.
            tally.compare(what, found.unwrap_or(None), (cost >= 0.0).then_some(cost), 1e-6 * cost.max(1.0));
        }
    })
    .map_err(|error| wrong(error.to_string()))?;
    Ok(Some(tally))
}

/// The files of a folder with this ending, sorted.
fn files(folder: &Path, ending: &str) -> Result<Vec<PathBuf>, Error> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).map_err(Error::at(folder))? {
        let path = entry.map_err(Error::at(folder))?.path();
        if path.to_string_lossy().ends_with(ending) {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

fn progress(name: &str, len: usize) -> ProgressBar {
    let style = ProgressStyle::with_template("{prefix:<12} {bar:40} {pos}/{len} {eta} left");
    let bar = ProgressBar::new(len as u64).with_prefix(name.to_owned());
    style.map_or(bar.clone(), |style| bar.with_style(style))
}
