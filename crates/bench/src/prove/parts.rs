//! Parts: a map under a family or a law. Their results are kept, so that a run can be interrupted.

use std::{
    fs, io,
    panic::{self, AssertUnwindSafe},
    path::{Path, PathBuf},
    sync::{
        LazyLock, Mutex, PoisonError,
        atomic::{AtomicUsize, Ordering},
    },
    thread,
    time::Instant,
};

use rayon::ThreadPoolBuilder;
use serde::{Deserialize, Serialize};

use super::{Pace, ProveError, sources::Sources, suite::Suite, tally::Tally, terrain::Choice, terrain::read};

/// A map under a family or a law.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub(super) suite: Suite,
    pub(super) set: String,
    pub(super) map: PathBuf,
    pub(super) choice: Choice,
    /// In a sample, the number of the one motion of a family that is asked.
    pub(super) only: Option<usize>,
}

/// The result of a part.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Done {
    pub(super) tally: Tally,
    /// The seconds of a processor that it took.
    pub(super) seconds: f64,
}

impl Part {
    /// The map's name as people call it: `dao/arena.map`.
    fn name(&self) -> String {
        format!("{}/{}", self.set, self.map.file_name().unwrap_or_default().to_string_lossy())
    }

    fn prove(&self, pace: Pace) -> Result<Done, ProveError> {
        let begin = seconds();
        let (of, mut tally) = (self.name(), Tally::default());
        let fault = |fault: String| ProveError::Wrong(format!("{}, {of}: {fault}", self.suite));
        for terrain in read(&self.map, &self.set, self.choice)? {
            let prove = || self.suite.prove((&of, &terrain), self.only, pace, &mut tally);
            // The map on which an engine panics is what its reader needs.
            let proven = panic::catch_unwind(AssertUnwindSafe(prove));
            let proven = proven.map_err(|_| fault("an engine panicked".to_owned()))?;
            proven.map_err(|error| fault(error.to_string()))?;
        }
        Ok(Done { tally, seconds: seconds() - begin })
    }
}

/// The folder in which the results of parts are kept: one file each. Without one nothing is kept.
#[derive(Clone, Debug)]
pub(super) struct Kept {
    pub(super) folder: Option<PathBuf>,
    pub(super) sources: Sources,
}

impl Kept {
    fn file(&self, part: &Part) -> Option<PathBuf> {
        let folder = self.folder.as_ref()?.join(self.sources.of(part.suite.is_law()));
        Some(folder.join(part.suite.to_string()).join(part.name() + ".json"))
    }

    /// The result of a part that was proven before. A file that is none is proven again.
    pub(super) fn get(&self, part: &Part) -> Option<Done> {
        serde_json::from_str(&fs::read_to_string(self.file(part)?).ok()?).ok()
    }

    /// Keeps a result: the whole file or none, whenever the run ends.
    fn put(&self, part: &Part, done: &Done) -> Result<(), ProveError> {
        let Some(file) = self.file(part) else { return Ok(()) };
        let write = |file: &Path| {
            fs::create_dir_all(file.parent().unwrap_or(file))?;
            let unfinished = file.with_extension("part");
            fs::write(&unfinished, serde_json::to_string(done).map_err(io::Error::other)?)?;
            fs::rename(unfinished, file)
        };
        write(&file).map_err(ProveError::at(&file))
    }
}

/// The seconds of a processor that this thread has had, where the system tells them: others may work on the
/// same cores. Elsewhere those of the clock.
fn seconds() -> f64 {
    static BEGIN: LazyLock<Instant> = LazyLock::new(Instant::now);
    let told = fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let nanos = told.split(' ').next().and_then(|nanos| nanos.parse::<u64>().ok());
    nanos.map_or_else(|| BEGIN.elapsed().as_secs_f64(), |nanos| nanos as f64 / 1e9)
}

/// Does `work` with so many threads for all that it does at once; where the system gives none, with those
/// that are there.
pub(super) fn on_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    match ThreadPoolBuilder::new().num_threads(threads).build() {
        Ok(pool) => pool.install(work),
        Err(_) => work(),
    }
}

/// Proves parts in their order, on so many threads at once, until `until`; `told` hears of each, with its
/// number. Each thread
/// has its own for what engines do on several, so that none begins a second map while it waits for the first.
pub(super) fn prove_all(
    parts: &[Part],
    kept: &Kept,
    (pace, threads, until): (Pace, usize, Option<Instant>),
    told: impl FnMut(usize, Done) + Send,
) -> Result<(), ProveError> {
    let (next, told) = (AtomicUsize::new(0), Mutex::new(told));
    let is_over = || until.is_some_and(|until| Instant::now() >= until);
    let work = || {
        while !is_over() {
            let number = next.fetch_add(1, Ordering::Relaxed);
            let Some(part) = parts.get(number) else { break };
            let done = part.prove(pace).and_then(|done| kept.put(part, &done).map(|()| done));
            let done = done.inspect_err(|_| next.store(parts.len(), Ordering::Relaxed))?;
            told.lock().unwrap_or_else(PoisonError::into_inner)(number, done);
        }
        Ok(())
    };
    thread::scope(|scope| {
        let spawn = |_| scope.spawn(|| on_threads(1, work));
        let workers: Vec<_> = (0..threads).map(spawn).collect();
        let ended: Vec<_> = workers.into_iter().map(thread::ScopedJoinHandle::join).collect();
        let panicked = || ProveError::Wrong("a thread panicked".to_owned());
        ended.into_iter().try_for_each(|ended| ended.map_err(|_| panicked())?)
    })
}
