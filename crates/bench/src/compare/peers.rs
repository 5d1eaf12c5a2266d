//! `cargo xtask compare --peers DIR`: our engines beside programs of others, which are built already.
//!
//! **The key decision: everyone runs alone, and alike.** A program answers the queries of a map in a process
//! of its own, on one core, pass after pass. So does each of our engines: this program runs itself
//! ([`alone`]). Rounds of all are in turn, in another order each time, and the median of the rounds counts.
//! So nobody finds the caches of another, and a drift of the machine affects all.
//!
//! The words that a program takes and says are in [`report`]; `DIR/peers.json` names the programs
//! ([`Peer`](list::Peer)). None comes with this project.
//!
//! Outcomes are kept in `target/compare` while the revision, the list of programs and the passes are the
//! same, so that a run goes on where it was interrupted; programs that failed are tried again, and so is
//! everyone where sources differ from the revision. At the end the record `docs/results/data/peers.json`
//! is written; `cargo xtask describe` draws the tables of README and of `docs/performance.md` from it.

pub(super) mod alone;
mod list;
mod process;
mod record;
mod report;
mod rounds;

use std::{
    fs::{self, File},
    path::{Path, PathBuf},
};

use indicatif::ProgressBar;
use mediant::{Engine, K, Map, Motion, Setup};
use mediant_formats::{MapFile, Scenario};
use mediant_oracle::Rng;
use mediant_report::revision;
use mediant_sets::Archive;

use self::{
    list::{Runner, runners},
    rounds::{Key, Outcome, Rounds},
};
use super::{CompareError, Options, missing_advice};
use crate::{Problem, ProblemError, ReferenceTimings};

const SEED: u64 = 7;

/// The files of one map and one list of its queries, as every program takes them.
struct Task {
    /// An instance is in the list if this divides its index.
    every: u32,
    name: String,
    map: PathBuf,
    scenario: PathBuf,
    problem: Problem,
    /// The lengths of the shortest paths of each motion.
    shortest: Vec<(Motion, Vec<f64>)>,
}

impl Task {
    fn shortest(&self, motion: Motion) -> &[f64] {
        self.shortest.iter().find(|(of, _)| *of == motion).map_or(&[], |(_, lengths)| lengths)
    }
}

/// Measures, and writes the record into the project at `root`.
///
/// # Errors
/// [`CompareError`] for a list of programs that is none, for a map that is not there, and for an engine of
/// ours that fails. A program of others that fails on a map is named at the end, and has no row.
pub(super) fn run(
    root: &Path,
    archive: &Archive,
    folder: &Path,
    options: &Options,
) -> Result<Vec<String>, CompareError> {
    // The sources may change while hours pass.
    let revision = revision(root);
    let peers = list::read(folder)?;
    let runners = runners(&peers)?;
    let scratch = tempfile::tempdir().map_err(CompareError::at_read(&std::env::temp_dir()))?;
    let tasks = tasks(archive, scratch.path(), &runners, options)?;
    let path = options.json.clone().unwrap_or_else(|| root.join(record::FILE));
    let kept = options
        .json
        .as_ref()
        .map_or_else(|| root.join("target/compare/peers.jsonl"), |path| path.with_extension("jsonl"));
    let conditions = format!("{revision} {} {} {peers:?}", options.passes, options.seconds);
    let mut rounds = Rounds::open(&kept, &conditions, !revision.contains("-dirty"))?;
    let bar = ProgressBar::new((tasks.len() * runners.len()) as u64 * u64::from(options.rounds));
    for round in 0..options.rounds {
        for task in &tasks {
            for runner in in_some_order(&runners, round, task) {
                bar.set_message(format!("{} {} {}", task.name, task.every, runner.name()));
                let key = Key::new(task.every, &task.name, runner.name(), round);
                if runner.takes(&task.name) && !rounds.has(&key) {
                    let outcome = measured(runner, folder, task, options)?;
                    rounds.add(key, outcome)?;
                }
                bar.inc(1);
            }
        }
    }
    bar.finish_and_clear();
    let record = record::record(&rounds, &tasks, &runners, revision, options);
    fs::write(&path, record.json()).map_err(|source| CompareError::Write { path, source })?;
    Ok(rounds.refusals())
}

/// Runs a program on a map. A refusal of one of ours is an error.
fn measured(runner: &Runner, folder: &Path, task: &Task, options: &Options) -> Result<Outcome, CompareError> {
    match process::run(runner, folder, task, options) {
        Ok(report) => Ok(Outcome::of(&report, task.shortest(runner.setup().motion))),
        Err(reason) if runner.is_ours() => {
            Err(CompareError::Alone { engine: runner.name().to_owned(), map: task.name.clone(), reason })
        }
        Err(reason) => Ok(Outcome::Refused(reason)),
    }
}

/// The runners in an order of their own for each round and map.
fn in_some_order<'a>(runners: &'a [Runner], round: u32, task: &Task) -> Vec<&'a Runner> {
    let name: u64 = task.name.bytes().map(u64::from).sum();
    let mut rng = Rng::new(SEED ^ u64::from(round) << 32 ^ u64::from(task.every) << 16 ^ name);
    let mut keyed: Vec<(u64, &Runner)> = runners.iter().map(|runner| (rng.bits(), runner)).collect();
    keyed.sort_by_key(|(key, _)| *key);
    keyed.into_iter().map(|(_, runner)| runner).collect()
}

/// The maps of the other programs' timings, each with each list, as files.
fn tasks(
    archive: &Archive,
    scratch: &Path,
    runners: &[Runner],
    options: &Options,
) -> Result<Vec<Task>, CompareError> {
    let mut motions: Vec<Motion> = Vec::new();
    for motion in runners.iter().map(|runner| runner.setup().motion) {
        if !motions.contains(&motion) {
            motions.push(motion);
        }
    }
    let references = ReferenceTimings::bundled()?;
    let is_asked = |name: &String| options.maps.is_empty() || options.maps.contains(name);
    let rows: Vec<_> = references.maps.iter().filter(|row| is_asked(&row.map)).collect();
    let (mut tasks, mut missing) = (Vec::new(), Vec::new());
    for &every in &options.lists {
        for row in &rows {
            match task(archive, scratch, (&row.set, &row.map), every, &motions)? {
                Some(task) => tasks.push(task),
                None => missing.push((row.set.as_str(), row.map.as_str())),
            }
        }
    }
    // A record has all maps or none of its page's sentences holds.
    if missing.is_empty() { Ok(tasks) } else { Err(CompareError::NoMap(missing_advice(&missing))) }
}

/// Writes the map with `.` and `@` alone, which every program reads alike, and its list as a scenario.
fn task(
    archive: &Archive,
    scratch: &Path,
    (set, name): (&str, &str),
    every: u32,
    motions: &[Motion],
) -> Result<Option<Task>, CompareError> {
    let Some(problem) = Problem::load(archive, set, name, every as usize)? else { return Ok(None) };
    let Some(whole) = archive.scenario(set, name).map_err(ProblemError::from)? else { return Ok(None) };
    let folder = scratch.join(every.to_string());
    fs::create_dir_all(&folder).map_err(CompareError::at_write(&folder))?;
    let (map, scenario) = (folder.join(format!("{name}.map")), folder.join(format!("{name}.map.scen")));
    let create = |path: &PathBuf| File::create(path).map_err(CompareError::at_write(path));
    MapFile::from_grid(problem.grid()).write(create(&map)?).map_err(CompareError::at_write(&map))?;
    let of_list = Scenario::from_bytes(whole).and_then(|whole| {
        Scenario::from_instances(whole.instances().iter().step_by(every as usize).cloned().collect())
    });
    let of_list = of_list.map_err(|source| ProblemError::Scenario { name: name.to_owned(), source })?;
    of_list.write(create(&scenario)?).map_err(CompareError::at_write(&scenario))?;
    let shortest = motions.iter().map(|&motion| Ok((motion, shortest(&problem, motion)?)));
    let shortest = shortest.collect::<Result<_, CompareError>>()?;
    Ok(Some(Task { every, name: name.to_owned(), map, scenario, problem, shortest }))
}

/// By engines that prepare next to nothing.
fn shortest(problem: &Problem, motion: Motion) -> Result<Vec<f64>, CompareError> {
    let engine = if motion.k == K::Any { Engine::Anya } else { Engine::AStar };
    let setup = Setup::new(engine, motion);
    let space = setup.space(&Map::from(problem.grid().clone()))?;
    alone::lengths(&mut setup.prepare(&space)?.planner(), problem)
}
