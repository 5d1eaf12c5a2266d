//! `cargo xtask mutants`: do the tests notice when the code is changed?
//!
//! cargo-mutants lists small changes of the code, the mutants: another operator, another value of a function,
//! no arm of a match. A test has to fail for each.
//!
//! **The key decision: all mutants are compiled at once.** Compiling each alone, as cargo-mutants does, takes
//! ten seconds, and there are thousands. So all are put into a copy of the sources, each behind a question
//! for the active mutant (`schema`), and one number in the environment makes it active. Each test is run once
//! to see to which mutants it comes; a mutant is tried by these tests alone, the shortest first, and random
//! suites on a few maps before they are run on all. A suite that counts what it finds fails on a few; with a
//! mutant it has to fail somewhere else then.
//!
//! Outcomes are kept in `target/mutants` while the file of the mutant is the same, so that a run goes on
//! where it was, and at the end of a run in `docs/proof/mutants.tsv` (`kept`), where another machine finds
//! them. `--again` tries those that survived, with the tests of today. `--record` writes the counts to
//! `docs/proof/mutants.json`, once all were tried. Each survivor is explained in `mutants/explained.json`, or
//! the run says that it is not.

mod kept;
mod list;
mod record;
mod schema;
mod suite;
mod tree;
mod trial;

use std::{
    collections::HashMap,
    fs,
    io::Write,
    path::{Path, PathBuf},
    sync::{
        Mutex, PoisonError,
        atomic::{AtomicUsize, Ordering},
    },
    thread,
    time::{Duration, Instant},
};

use clap::Args;
use mediant_sets::root;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use self::{
    list::{Mutant, mutants},
    suite::{Form, Test},
    tree::{Built, MutatedProject},
    trial::{Bench, Outcome},
};
use crate::Error;

/// The options of `cargo xtask mutants`.
#[derive(Args, Clone, Debug)]
pub struct Options {
    /// Groups of files; all without any
    groups: Vec<String>,
    /// Begin no further mutant after so many minutes; 0: tell what is known
    #[arg(long, value_name = "N")]
    minutes: Option<f64>,
    /// The seconds of tests that a mutant may take
    #[arg(long, value_name = "N", default_value = "60")]
    longest: f64,
    /// The tests that run at the same time
    #[arg(long, value_name = "N", default_value = "2")]
    threads: usize,
    /// Try those again that survived without a reason, or to which no test came
    #[arg(long)]
    again: bool,
    /// Write the counts to docs/proof/mutants.json
    #[arg(long)]
    record: bool,
}

/// A mutant's outcome, as it is kept.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Tried {
    key: String,
    /// The digest of its file.
    source: String,
    outcome: Outcome,
}

/// Tries mutants.
///
/// # Errors
/// [`Error::Lacking`] without cargo-mutants, or for a group that is none; [`Error::Step`] if the copy cannot
/// be compiled; [`Error::Survivors`] for mutants that survive, and are not explained; [`Error::Io`] for
/// files.
pub fn run(options: &Options) -> Result<(), Error> {
    let groups: Vec<&str> = list::groups().collect();
    if let Some(unknown) = options.groups.iter().find(|name| !groups.contains(&&***name)) {
        let mend = format!("one of {}", groups.join("; "));
        return Err(Error::Lacking { what: format!("no group is called {unknown}"), mend });
    }
    let until = options.minutes.map(|minutes| Instant::now() + Duration::from_secs_f64(60.0 * minutes));
    let mutants = mutants()?;
    let sources = digests(&mutants)?;
    let folder = root().join("target/mutants");
    let file = folder.join("outcomes.jsonl");
    let kept_file = root().join(kept::FILE);
    let mut known = kept::read(&kept_file, &mutants, &sources);
    known.extend(outcomes(&file, &sources));
    let tell = |known: &HashMap<String, Outcome>| {
        kept::write(&kept_file, &mutants, &sources, known).map_err(Error::at(&kept_file))?;
        record::tell(&mutants, known, options.record)
    };
    if options.minutes == Some(0.0) {
        return tell(&known);
    }
    let project = MutatedProject::new(&mutants)?;
    let built = project.build(&mutants)?;
    let tests = tests(&built, &folder, options.threads)?;
    let explained = record::explained()?;
    let is_asked = |mutant: &&Mutant| {
        options.groups.is_empty() || options.groups.iter().any(|name| name == mutant.group)
    };
    let is_open = |mutant: &&Mutant| match known.get(&mutant.key()) {
        Some(Outcome::Survived(..)) => options.again && !explained.iter().any(|reason| reason.holds(mutant)),
        Some(Outcome::Unreached) => options.again,
        Some(_) => false,
        None => true,
    };
    let mut open: Vec<&Mutant> = mutants.iter().filter(is_asked).filter(is_open).collect();
    open.sort_by_key(|mutant| groups.iter().position(|group| *group == mutant.group));
    println!("{} mutants, {} tests; {} to be tried", mutants.len(), tests.len(), open.len());
    let bench = Bench::new(&built.programs, &tests, built.places, options.longest);
    bench.remember(known.iter().filter_map(|(key, outcome)| Some((key.split_once(':')?.0, outcome))));
    let out = fs::OpenOptions::new().append(true).create(true).open(&file).map_err(Error::at(&file))?;
    let out = Mutex::new(out);
    let tried = in_parallel(options.threads, &open, |_, mutant| {
        if until.is_some_and(|until| Instant::now() > until) {
            return Ok(None);
        }
        let source = sources[&*mutant.file].clone();
        let tried = Tried { key: mutant.key(), source, outcome: bench.trial(mutant)? };
        if let Outcome::Survived(..) | Outcome::Unreached = tried.outcome {
            println!("{:?}: {}", tried.outcome, tried.key);
        }
        let line = serde_json::to_string(&tried).unwrap_or_default() + "\n";
        let mut out = out.lock().unwrap_or_else(PoisonError::into_inner);
        out.write_all(line.as_bytes()).map_err(Error::at(&file))?;
        Ok(Some(tried))
    })?;
    known.extend(tried.into_iter().flatten().map(|tried| (tried.key, tried.outcome)));
    tell(&known)
}

/// The outcomes that a file holds of mutants whose sources are as they were; the last one of a mutant counts.
fn outcomes(file: &Path, sources: &HashMap<&str, String>) -> HashMap<String, Outcome> {
    let text = fs::read_to_string(file).unwrap_or_default();
    let tried = text.lines().filter_map(|line| serde_json::from_str::<Tried>(line).ok());
    let is_same = |tried: &Tried| sources.values().any(|source| *source == tried.source);
    tried.filter(is_same).map(|tried| (tried.key, tried.outcome)).collect()
}

/// A digest of each file that has mutants, with its path, but without the tests at its end: an outcome stays
/// while these become more.
fn digests(mutants: &[Mutant]) -> Result<HashMap<&str, String>, Error> {
    let mut digests = HashMap::new();
    for Mutant { file, .. } in mutants {
        if !digests.contains_key(&**file) {
            let path = root().join(file);
            let source = fs::read_to_string(&path).map_err(Error::at(&path))?;
            let code = source.split_once("\n#[cfg(test)]\nmod tests {\n").map_or(&*source, |(code, _)| code);
            digests.insert(&**file, hex(Sha256::new().chain_update(file).chain_update(code)));
        }
    }
    Ok(digests)
}

/// The tests of the programs, with their times and places; kept while all sources are the same.
fn tests(built: &Built, folder: &Path, threads: usize) -> Result<Vec<Test>, Error> {
    let file: PathBuf = suite::file(folder, &built.digest);
    let known = fs::read_to_string(&file).ok().and_then(|text| serde_json::from_str(&text).ok());
    if let Some(tests) = known {
        return Ok(tests);
    }
    let mut tests = suite::tests(&built.programs, folder, threads)?;
    let order = |test: &Test| test.form == Form::Whole;
    tests.sort_by(|one, other| order(one).cmp(&order(other)).then(one.seconds.total_cmp(&other.seconds)));
    fs::write(&file, serde_json::to_string(&tests).unwrap_or_default()).map_err(Error::at(&file))?;
    Ok(tests)
}

fn hex(digest: Sha256) -> String {
    digest.finalize().iter().take(6).map(|byte| format!("{byte:02x}")).collect()
}

/// The results of `work` for all items, in their order, by so many threads, each with its number.
fn in_parallel<T: Sync, R: Send>(
    threads: usize,
    items: &[T],
    work: impl Fn(usize, &T) -> Result<R, Error> + Sync,
) -> Result<Vec<R>, Error> {
    let next = AtomicUsize::new(0);
    let done = Mutex::new(Vec::new());
    thread::scope(|scope| {
        for worker in 0..threads.max(1) {
            let (next, done, work) = (&next, &done, &work);
            scope.spawn(move || {
                while let number = next.fetch_add(1, Ordering::Relaxed)
                    && let Some(item) = items.get(number)
                {
                    let result = work(worker, item);
                    done.lock().unwrap_or_else(PoisonError::into_inner).push((number, result));
                }
            });
        }
    });
    let mut done = done.into_inner().unwrap_or_else(PoisonError::into_inner);
    done.sort_by_key(|(number, _)| *number);
    done.into_iter().map(|(_, result)| result).collect()
}
