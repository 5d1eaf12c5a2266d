//! `cargo xtask soak`: all engines in one process for a long time, on maps that change.
//!
//! A round is a map and a motion, drawn from its seed: every engine that takes them prepares its index, saves
//! and loads it. Then threads that share everything ask for paths, with wishes and limits, in steps, in
//! batches, for fields and tables, and cancel each other. Between such turns the map is edited, and indexes
//! and planners follow.
//!
//! **The key decision: every answer is compared.** The reference, A\* or Anya, is prepared anew after each
//! edit, on a map made from the cells alone; so whatever was repaired, loaded, shared, stopped or forgotten
//! has to agree with what has no past. A soak fails at the first disagreement, at an operation that takes
//! longer than a bound, and when allocated memory grows (`soak/memory.rs`).

mod ask;
mod kind;
mod latency;
mod memory;
mod record;
mod timer;
mod world;

use std::{
    fs, io,
    path::{Path, PathBuf},
    sync::Mutex,
    thread,
    time::{Duration, Instant},
};

use clap::Args;
use mediant_oracle::Rng;
use mediant_sets::{cache, root};

use ask::Asker;
use kind::Kind;
use latency::Log;
pub use memory::COUNTED;
use memory::Memory;
use timer::Timer;
use world::World;

/// The options of `cargo xtask soak`.
#[derive(Args, Clone, Debug)]
pub struct Options {
    /// The time that it takes; a round that has begun is ended
    #[arg(long, value_name = "N", default_value = "0.5")]
    minutes: f64,
    /// The seed of the first round; each next one has the next seed
    #[arg(long, value_name = "N", default_value = "0")]
    seed: u64,
    /// The threads that ask at the same time
    #[arg(long, value_name = "N", default_value = "3")]
    threads: std::num::NonZeroUsize,
    /// The greatest side of a map, in cells
    #[arg(long, value_name = "N", default_value = "128", value_parser = sides())]
    side: u32,
    /// The operations of each thread between two edits
    #[arg(long, value_name = "N", default_value = "60")]
    operations: u32,
    /// Fail when an operation takes longer than this
    #[arg(long, value_name = "N", default_value = "20000")]
    longest_milliseconds: u64,
    /// Lose so much memory in each round, to see that this is found
    #[arg(long, value_name = "N", default_value = "0", hide = true)]
    leak_kibibytes: usize,
    /// Write docs/proof/soak.json
    #[arg(long)]
    record: bool,
}

/// The sides that a map may have at most.
fn sides() -> impl clap::builder::TypedValueParser<Value = u32> {
    clap::value_parser!(u32).range(4..=2000)
}

/// A failure of `soak`.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SoakError {
    /// A wrong answer, or one that took too long.
    #[error("{0}")]
    Wrong(String),
    /// Memory that grows.
    #[error("allocated memory grows: {0}")]
    Memory(String),
    /// An engine that refuses what it has to do.
    #[error(transparent)]
    Library(#[from] mediant::Error),
    /// A query that is refused.
    #[error(transparent)]
    Query(#[from] mediant::errors::QueryError),
    /// The seed and the map of any of these.
    #[error("seed {seed}, {world}: {error}")]
    In {
        /// The seed of the round.
        seed: u64,
        /// The map.
        world: String,
        /// The failure.
        error: Box<Self>,
    },
    /// A file that cannot be written or read.
    #[error("{path}: {error}", path = path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// Why.
        error: io::Error,
    },
    /// The report cannot be printed.
    #[error("the output: {0}")]
    Print(#[from] io::Error),
}

impl SoakError {
    fn at(path: &Path) -> impl FnOnce(io::Error) -> Self {
        |error| Self::File { path: path.to_owned(), error }
    }
}

/// The measurements of a soak.
#[derive(Debug, Default)]
struct Soak {
    log: Log,
    rounds: u64,
    edits: u64,
    /// After each round.
    memory: Vec<Memory>,
}

impl Soak {
    /// The medians of memory by quarter of the rounds, in bytes; `None` where it is not told.
    fn quarters(&self, of: impl Fn(&Memory) -> Option<u64>) -> Option<[f64; 4]> {
        memory::quarters(&self.memory.iter().filter_map(of).collect::<Vec<u64>>())
    }
}

/// Soaks, and prints what was measured.
///
/// # Errors
/// As for [`run_in`].
pub fn run(options: &Options) -> Result<(), SoakError> {
    let folder = root();
    run_in(&folder, &cache(&folder), options, &mut io::stdout().lock())
}

/// [`run`] with the benchmark sets in the folder `cache`, printing to `out`. A record is written below
/// `root`.
///
/// # Errors
/// [`SoakError`]; above all, engines that disagree, memory that grows, and operations that take too long.
pub fn run_in(
    root: &Path,
    cache: &Path,
    options: &Options,
    out: &mut dyn io::Write,
) -> Result<(), SoakError> {
    let folder = std::env::temp_dir().join(format!("mediant-soak-{}", std::process::id()));
    fs::create_dir_all(&folder).map_err(SoakError::at(&folder))?;
    let soak = soak(options, &folder, &world::map_files(cache));
    let removed = fs::remove_dir_all(&folder).map_err(SoakError::at(&folder));
    let soak = soak?;
    removed?;
    record::print(&soak, out)?;
    if let Some(quarters) = soak.quarters(|memory| Some(memory.allocated))
        && !memory::is_flat(&quarters)
    {
        return Err(SoakError::Memory(record::by_quarter(&quarters)));
    }
    if options.record {
        record::write(root, options, &soak)?;
    }
    Ok(())
}

/// Rounds until the time is over, four at least.
fn soak(options: &Options, folder: &Path, files: &[PathBuf]) -> Result<Soak, SoakError> {
    let begin = Instant::now();
    // Its own samples shall not count as growth.
    let mut soak = Soak { memory: Vec::with_capacity(1 << 16), ..Soak::default() };
    while soak.rounds < 4 || begin.elapsed().as_secs_f64() < options.minutes * 60.0 {
        round(options, (folder, files), &mut soak)?;
        soak.rounds += 1;
        std::mem::forget(vec![1_u8; options.leak_kibibytes << 10]);
        soak.memory.push(Memory::now());
    }
    Ok(soak)
}

/// A map, with some edits.
fn round(options: &Options, (folder, files): (&Path, &[PathBuf]), soak: &mut Soak) -> Result<(), SoakError> {
    /// The turns of a round, each with an edit before the next one.
    const TURNS: u64 = 3;
    let seed = options.seed + soak.rounds;
    let within = |world: &str, error| SoakError::In { seed, world: world.to_owned(), error: Box::new(error) };
    let mut rng = Rng::new(seed);
    let longest = Duration::from_millis(options.longest_milliseconds);
    let mut timer = Timer::new(longest, folder);
    let world = World::draw(seed, &mut rng, (options.side, files), &mut timer);
    let mut world = world.map_err(|error| within("preparing", error))?;
    let name = world.name.clone();
    for turn in 0..TURNS {
        let log = ask_by_threads(options, &world, &mut rng, folder).map_err(|error| within(&name, error))?;
        soak.log.merge(&log);
        if turn + 1 < TURNS {
            world.edit(&mut rng, &mut timer).map_err(|error| within(&name, error))?;
            ask_followers(&mut world, &mut rng).map_err(|error| within(&name, error))?;
            soak.edits += 1;
        }
    }
    soak.log.merge(&timer.log);
    Ok(())
}

/// Each planner that follows answers as the reference does.
fn ask_followers(world: &mut World, rng: &mut Rng) -> Result<(), SoakError> {
    world.ask_followers(rng, |world, runner, [start, goal], found| {
        let known = world.reference.with(|planner| planner.distance((start, goal)))?;
        ask::compare(world, runner, || format!("{start} → {goal} after an edit"), [found, known])
    })
}

/// The operations of all threads on one map.
fn ask_by_threads(options: &Options, world: &World, rng: &mut Rng, folder: &Path) -> Result<Log, SoakError> {
    let flags: Vec<_> = (0..options.threads.get()).map(|_| Mutex::default()).collect();
    let longest = Duration::from_millis(options.longest_milliseconds);
    let askers: Vec<Asker<'_>> = (0..flags.len())
        .map(|number| {
            let (rng, timer) = (Rng::new(rng.bits()), Timer::new(longest, folder));
            Asker { world, rng, timer, flags: &flags, number }
        })
        .collect();
    let work = |mut asker: Asker<'_>| -> Result<Log, SoakError> {
        for _ in 0..options.operations {
            asker.step()?;
        }
        Ok(asker.timer.log)
    };
    let mut log = Log::default();
    thread::scope(|scope| {
        let threads: Vec<_> = askers.into_iter().map(|asker| scope.spawn(move || work(asker))).collect();
        for thread in threads {
            let done = thread.join().map_err(|_| SoakError::Wrong("a thread panicked".to_owned()))?;
            log.merge(&done?);
        }
        Ok(log)
    })
}
