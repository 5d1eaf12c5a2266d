//! `cargo xtask prove`: every public instance by every exact engine, and laws that need no known cost.
//!
//! A *family* is a placement at one k, under all of its rules of motion. Each exact engine that solves it is
//! asked the instances of the benchmark sets, and all must agree with the first: over N(k) on the same
//! integer, at any angle on the length up to 2⁻³¹ of it. Each path must hold on the map, and consist of moves
//! of N(k). Between centers at k = 3 the scenario states the length, too. A *law* compares answers with each
//! other: of two k, of both directions, of a map and its mirror image.
//!
//! **The key decision: a part is a map under a family or a law, and a finished part is never done again.**
//! Its counts are kept in `target/prove`, under a digest of the sources that decide them; so a run may end at
//! any moment, and goes on where it ended. The maps of a set are taken in order, and the record says of each
//! family and set how many are done: with the record alone another machine goes on, too. The family or law
//! and the set of which the fewest maps were ever proven come first, so that a short run reaches all of them.

mod families;
mod laws;
mod outcome;
mod parts;
mod records;
mod sources;
mod suite;
mod tally;
mod terrain;

use std::{
    collections::BTreeMap,
    fmt::Write as _,
    io,
    num::NonZeroUsize,
    path::{Path, PathBuf},
    thread,
    time::{Duration, Instant},
};

use clap::Args;
use mediant::{FiniteK, K};
use mediant_sets::{Error as SetError, Manifest, cache, files, root};

use self::{
    families::CONTESTANTS,
    laws::CASES,
    parts::{Done, Kept, Part, prove_all},
    records::State,
    sources::Sources,
    suite::Suite,
    tally::{Tally, WRONG},
    terrain::Choice,
};

/// The options of `cargo xtask prove`.
#[derive(Args, Clone, Debug)]
pub struct Options {
    /// Only these families (`centers-3`, `corners-any`, …); without a law, no laws
    #[arg(long, value_name = "NAME", num_args = 1..)]
    family: Vec<String>,
    /// Only these laws (`symmetry`, …); without a family, no families
    #[arg(long, value_name = "NAME", num_args = 1..)]
    law: Vec<String>,
    /// Only these benchmark sets, of those that `download` fetched
    #[arg(long, value_name = "NAME", num_args = 1..)]
    set: Vec<String>,
    /// Of each scenario, only the instances whose number N divides; nothing is kept then
    #[arg(long, value_name = "N", default_value = "1")]
    every: NonZeroUsize,
    /// Of each set, only every Nth map, the first among them; nothing is kept then
    #[arg(long, value_name = "N", default_value = "1")]
    every_map: NonZeroUsize,
    /// Ask the slow engines every Nth instance, and from k = 6 on a tenth of these; 1 asks them all
    #[arg(long, value_name = "N", default_value = "10")]
    slow: NonZeroUsize,
    /// Begin no further map after so many minutes
    #[arg(long, value_name = "N")]
    minutes: Option<u64>,
    /// A small even sample of all families, laws and sets; nothing is kept then
    #[arg(long, conflicts_with_all = ["every", "every_map", "record"])]
    sample: bool,
    /// Fail unless exactly N answers were compared
    #[arg(long, value_name = "N", value_parser = crate::verify::number)]
    expect: Option<u64>,
    /// Write what is proven so far to docs/proof/instances.json and docs/proof/laws.json
    #[arg(long)]
    record: bool,
}

/// The share of the instances that slow engines are asked.
#[derive(Clone, Copy, Debug)]
struct Pace {
    /// Up to k = 5 and at any angle they are asked every so-manieth instance.
    slow: usize,
    /// From k = 6 on, where a search of all moves takes seconds.
    at_large_k: usize,
}

impl Pace {
    /// Every so-manieth instance, and from k = 6 on a tenth of these; all if `slow` is 1.
    const fn every(slow: usize) -> Self {
        Self { slow, at_large_k: if slow == 1 { 1 } else { 10 * slow } }
    }

    /// A sample has few instances.
    const SAMPLE: Self = Self { slow: 4, at_large_k: 4 };

    fn at(self, k: K) -> usize {
        if k.finite().is_some_and(|k| k > FiniteK::N32) { self.at_large_k } else { self.slow }
    }
}

/// A failure of `prove`.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ProveError {
    /// Answers that differ, another number of comparisons than expected, or a name that is none.
    #[error("{0}")]
    Wrong(String),
    /// A benchmark set that cannot be read.
    #[error(transparent)]
    Set(#[from] SetError),
    /// A map or scenario that cannot be read.
    #[error(transparent)]
    Read(#[from] mediant_formats::ReadError),
    /// A record that cannot be read.
    #[error(transparent)]
    Record(#[from] mediant_report::RecordError),
    /// A file or folder that cannot be read or written.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// The fault.
        source: io::Error,
    },
    /// The report cannot be printed.
    #[error("the output: {0}")]
    Print(#[from] io::Error),
}

impl ProveError {
    fn at(path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::Io { path, source }
    }
}

/// The folders that a run uses.
#[derive(Clone, Debug)]
pub struct Places {
    /// The sets, each in a folder of its name.
    pub cache: PathBuf,
    /// The project, whose sources decide what is found.
    pub root: PathBuf,
    /// The results of parts.
    pub kept: PathBuf,
    /// The records.
    pub records: PathBuf,
}

impl Places {
    fn of_project() -> Self {
        let root = root();
        let (kept, records) = (root.join("target/prove"), root.join("docs/proof"));
        Self { cache: cache(&root), root, kept, records }
    }
}

/// Proves, and prints what was compared.
///
/// # Errors
/// As for [`run_in`].
pub fn run(options: &Options) -> Result<(), ProveError> {
    run_in(&Places::of_project(), options, &mut io::stdout())
}

/// [`run`] on the sets, results and records in these folders, printing to `out`.
///
/// # Errors
/// [`ProveError`]; above all, answers that differ or a count that is not the expected one.
pub fn run_in(
    places: &Places,
    options: &Options,
    out: &mut (dyn io::Write + Send),
) -> Result<(), ProveError> {
    let until = options.minutes.map(|minutes| Instant::now() + Duration::from_secs(60 * minutes));
    let pace = if options.sample { Pace::SAMPLE } else { Pace::every(options.slow.get()) };
    let sources = Sources::read(&places.root, pace)?;
    let is_whole = options.every.get() == 1 && options.every_map.get() == 1 && !options.sample;
    if options.record && !is_whole {
        return Err(ProveError::Wrong("a record is of all instances: without --every".to_owned()));
    }
    let kept = Kept { folder: is_whole.then(|| places.kept.clone()), sources: sources.clone() };
    let mut recorded =
        if is_whole { records::recorded(&places.records, &sources)? } else { Default::default() };
    let mut shares: Vec<Share> = Vec::new();
    for (suite, set, parts) in shares_of(places, options)? {
        let before = recorded.remove(&(suite.to_string(), set.clone()));
        let state = State::of(&parts, &kept, before);
        shares.push((suite, set, parts, state));
    }
    let parts = unproven(&shares, &kept, &records::reach(&places.records)?);
    let now = prove_now(&parts, &kept, (pace, until), out)?;
    let (mut states, mut beyond) = (Vec::new(), Tally::default());
    for (suite, set, parts, before) in shares {
        let state = match is_whole {
            true => State::of(&parts, &kept, Some(before)),
            false => now.iter().fold(State { of: parts.len(), ..before }, |state, (part, done)| {
                if (part.suite, &part.set) == (suite, &set) { state.with(done) } else { state }
            }),
        };
        // Maps beyond the first ones are in no state yet, but wrong all the same.
        let later = parts.iter().skip(state.maps).filter_map(|part| kept.get(part));
        later.filter(|done| done.tally.get(WRONG) > 0).for_each(|done| beyond.add(&done.tally));
        states.push((suite, set, state));
    }
    let mut total = tell(&states, out)?;
    total.add(&beyond);
    if !is_whole {
        // Records of other runs have none.
        writeln!(out, "digest of the families' answers: {:016x}", total.digest_of_answers())?;
    }
    if options.record {
        records::write((&places.root, &places.records), &sources, pace, &states)?;
    }
    // A run may end before its first map does.
    if comparisons(&total) == 0 && options.minutes.is_some() && !parts.is_empty() {
        return Ok(());
    }
    judge(&total, options.expect)
}

/// A family or a law on a set: its parts, and how many are proven.
type Share = (Suite, String, Vec<Part>, State);

/// The parts that are not proven yet, those first that no sources ever proved. A part that others proved
/// counts as the first that they did not: before that is reached, the record tells nothing new.
fn unproven(shares: &[Share], kept: &Kept, reach: &BTreeMap<(String, String), usize>) -> Vec<Part> {
    let mut parts = Vec::new();
    for (suite, set, all, state) in shares {
        let reached = reach.get(&(suite.to_string(), set.clone())).copied().unwrap_or(0);
        let rest = all.iter().enumerate().skip(state.maps).filter(|(_, part)| kept.get(part).is_none());
        parts.extend(rest.map(|(number, part)| (number.max(reached), part.clone())));
    }
    parts.sort_by_key(|(rank, _)| *rank);
    parts.into_iter().map(|(_, part)| part).collect()
}

/// Proves these parts, and tells of mismatches at once. The results are in the order of the parts.
fn prove_now(
    parts: &[Part],
    kept: &Kept,
    (pace, until): (Pace, Option<Instant>),
    out: &mut (dyn io::Write + Send),
) -> Result<Vec<(Part, Done)>, ProveError> {
    let threads = thread::available_parallelism().map_or(1, NonZeroUsize::get);
    let bar = mediant_sets::progress("maps", parts.len());
    let (mut printed, mut found) = (Ok(()), Vec::new());
    prove_all(parts, kept, (pace, threads, until), |number, done| {
        for wrong in done.tally.mismatches() {
            printed = writeln!(out, "wrong: {wrong}");
        }
        found.push((number, done));
        bar.inc(1);
    })?;
    bar.finish_and_clear();
    printed?;
    found.sort_by_key(|(number, _)| *number);
    Ok(found.into_iter().map(|(number, done)| (parts[number].clone(), done)).collect())
}

/// The comparisons of a tally: by engines, with scenarios, of laws.
fn comparisons(tally: &Tally) -> u64 {
    CONTESTANTS.iter().chain(&["scenario", CASES]).map(|name| tally.get(name)).sum()
}

/// Prints the states, and returns the counts of all.
fn tell(states: &[(Suite, String, State)], out: &mut dyn io::Write) -> Result<Tally, ProveError> {
    let mut total = Tally::default();
    for (suite, set, State { maps, of, done }) in states.iter().filter(|(_, _, state)| state.maps > 0) {
        let (compared, wrong) = (comparisons(&done.tally), done.tally.get(WRONG));
        writeln!(
            out,
            "{suite:<14} {set:<12} {maps:>4} of {of:>3} maps, {compared:>9} comparisons, {wrong} wrong, \
             {:.0} s of one core",
            done.seconds
        )?;
        total.add(&done.tally);
    }
    Ok(total)
}

fn judge(total: &Tally, expect: Option<u64>) -> Result<(), ProveError> {
    let compared = comparisons(total);
    if total.get(WRONG) > 0 {
        let mut text = format!("{} of {compared} comparisons are wrong", total.get(WRONG));
        for mismatch in total.mismatches().iter().take(10) {
            let _ = write!(text, "\n  {mismatch}");
        }
        return Err(ProveError::Wrong(text));
    }
    match expect {
        Some(expected) if expected != compared => {
            Err(ProveError::Wrong(format!("expected {expected} comparisons, made {compared}")))
        }
        _ if compared == 0 => {
            Err(ProveError::Wrong("nothing was compared: cargo xtask download fetches the sets".to_owned()))
        }
        _ => Ok(()),
    }
}

/// The families and laws that are asked for.
fn suites(options: &Options) -> Result<Vec<Suite>, ProveError> {
    let named: Vec<&String> = options.family.iter().chain(&options.law).collect();
    let all = Suite::all();
    for name in &named {
        let is_of_laws = options.law.contains(name);
        if !all.iter().any(|suite| suite.is_law() == is_of_laws && suite.to_string() == **name) {
            let names: Vec<String> =
                all.iter().filter(|suite| suite.is_law() == is_of_laws).map(Suite::to_string).collect();
            return Err(ProveError::Wrong(format!("`{name}` is none of {}", names.join(", "))));
        }
    }
    Ok(all
        .into_iter()
        .filter(|suite| named.is_empty() || named.iter().any(|name| **name == suite.to_string()))
        .collect())
}

/// The parts of each family and law on each set, in order.
fn shares_of(places: &Places, options: &Options) -> Result<Vec<(Suite, String, Vec<Part>)>, ProveError> {
    let manifest = Manifest::read(&Manifest::path(&root()))?;
    for name in &options.set {
        manifest.set(name)?;
        if !places.cache.join(name).is_dir() {
            return Err(ProveError::Wrong(format!(
                "set {name} is not there: cargo xtask download --set {name}"
            )));
        }
    }
    let asked = |name: &String| options.set.is_empty() || options.set.contains(name);
    let sets = manifest.sets.into_iter().map(|set| set.name).filter(asked);
    let sets: Vec<String> = sets.filter(|name| places.cache.join(name).is_dir()).collect();
    let mut shares = Vec::new();
    for (number, suite) in suites(options)?.into_iter().enumerate() {
        for (at, set) in sets.iter().enumerate() {
            let mut maps = files(&places.cache.join(set), ".map")?;
            let mut choice = Choice::Every(options.every.get() * suite.every());
            if options.sample && !suite.is_quick_on(set) {
                continue;
            }
            if options.sample {
                (maps, choice) = (sampled(maps, number), Choice::Few(SAMPLED));
            }
            let only = options.sample.then_some(at);
            let part = |map| Part { suite, set: set.clone(), map, choice, only };
            let parts = maps.into_iter().step_by(options.every_map.get()).map(part).collect();
            shares.push((suite, set.clone(), parts));
        }
    }
    Ok(shares)
}

/// The instances of a map in a sample.
const SAMPLED: usize = 20;

/// One of the smallest maps of a set: another one for another suite.
fn sampled(mut maps: Vec<PathBuf>, number: usize) -> Vec<PathBuf> {
    maps.sort_by_key(|map| (map.metadata().map_or(u64::MAX, |metadata| metadata.len()), map.clone()));
    maps.truncate(4);
    let at = number % maps.len().max(1);
    maps.into_iter().skip(at).take(1).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slow_engines_are_asked_less_from_k_6_on() {
        let finite = |k| K::Finite(FiniteK::new(k).expect("k is at least 2"));
        let of = |pace: Pace| [finite(3), finite(5), finite(6), finite(8), K::Any].map(|k| pace.at(k));
        assert_eq!(of(Pace::every(10)), [10, 10, 100, 100, 10]);
        assert_eq!(of(Pace::every(1)), [1; 5], "all instances");
        assert_eq!(of(Pace::SAMPLE), [4; 5]);
    }

    /// Of one set 5 maps, 2 of them by the record; of another one 3, of which other sources proved 2.
    #[test]
    fn what_was_never_proven_comes_first() {
        let sources = Sources::read(&root(), Pace::every(10)).expect("the sources are here");
        let kept = Kept { folder: None, sources };
        let suite = Suite::all()[0];
        let share = |set: &str, maps: usize, proven: usize| {
            let part = |number: usize| Part {
                suite,
                set: set.to_owned(),
                map: PathBuf::from(number.to_string()),
                choice: Choice::Every(1),
                only: None,
            };
            let state = State { maps: proven, of: maps, ..State::default() };
            (suite, set.to_owned(), (0..maps).map(part).collect(), state)
        };
        let reach = BTreeMap::from([((suite.to_string(), "b".to_owned()), 2)]);
        let parts = unproven(&[share("a", 5, 2), share("b", 3, 0), share("c", 1, 0)], &kept, &reach);
        let names: Vec<String> =
            parts.iter().map(|part| format!("{}{}", part.set, part.map.display())).collect();
        assert_eq!(names, ["c0", "a2", "b0", "b1", "b2", "a3", "a4"]);
    }
}
