//! Work with the GIL released, which Ctrl-C can end.

use std::{
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicBool, AtomicUsize, Ordering},
        mpsc::{self, RecvTimeoutError},
    },
    thread::{self, JoinHandle},
    time::{Duration, Instant},
};

use mediant::{Index, Limits, options::Levels};
use pyo3::prelude::*;

/// The interval between two looks at the signals.
pub(crate) const LOOK: Duration = Duration::from_millis(20);

/// The time that an interruption waits for the work to end. Most work ends within some milliseconds; this is
/// for work that cannot be stopped, such as a write to a disk.
const PATIENCE: Duration = Duration::from_millis(200);

/// Up to this many cells, whatever is not a preparation takes a few milliseconds.
const QUICK_CELLS: u64 = 1 << 20;

/// Whether hub labels answer: in microseconds on a map of any size.
pub(crate) fn has_labels(index: &Index) -> bool {
    index.levels() == Some(Levels::Labels) && index.setup().smoothing.is_none()
}

/// Whether a search on an index can take so long that it is watched: more expansions, each of more moves,
/// than can be made in about 20 ms. Preparation saves most of them. A plain query is one from a vertex to
/// another without wishes.
pub(crate) fn is_watched(index: &Index, is_plain: bool) -> bool {
    if is_plain && has_labels(index) {
        return false;
    }
    let (map, setup) = (index.space().map(), index.setup());
    let vertices = u64::from(map.width()) * u64::from(map.height());
    let moves = setup.k().finite().map_or(16, |k| 1 << k.get().min(16));
    // An engine that searches in place of the setup's has prepared nothing.
    let is_prepared = setup.index_version().is_ok() && index.searched_by() == setup.engine.kind();
    let saved = if is_prepared { 16 } else { 1 };
    vertices * moves / saved > 1 << 21
}

/// Does work on a map of so many cells with the GIL released; on a large one on another thread, while this
/// one looks at signals. The work is handed the limits by which it is stopped.
pub(crate) fn detached<T: Send + 'static>(
    py: Python<'_>,
    cells: u64,
    limits: Limits,
    work: impl FnOnce(&Limits) -> T + Send + 'static,
) -> PyResult<T> {
    if cells <= QUICK_CELLS {
        Ok(py.detach(|| work(&limits)))
    } else {
        on_thread(py, limits, work, |_| Ok(()))
    }
}

/// Does work on another thread, while this one looks at signals, and calls `look`. If either raises, the
/// limits that the work is handed stop it, and it has ended when this returns.
pub(crate) fn on_thread<T: Send + 'static>(
    py: Python<'_>,
    limits: Limits,
    work: impl FnOnce(&Limits) -> T + Send + 'static,
    look: impl FnMut(Python<'_>) -> PyResult<()>,
) -> PyResult<T> {
    let flag = Arc::new(AtomicBool::new(false));
    let limits = limits.cancel(Arc::clone(&flag));
    with_flag(py, &flag, move || work(&limits), look)
}

/// [`on_thread`] for work that knows the flag by which it is stopped.
pub(crate) fn with_flag<T: Send + 'static>(
    py: Python<'_>,
    flag: &AtomicBool,
    work: impl FnOnce() -> T + Send + 'static,
    mut look: impl FnMut(Python<'_>) -> PyResult<()>,
) -> PyResult<T> {
    let (sender, mut receiver) = mpsc::channel();
    let worker = thread::Builder::new().name("mediant".to_owned()).spawn(move || {
        // Nobody waits any more after an interruption.
        let _ = sender.send(work());
    })?;
    loop {
        let received;
        (received, receiver) = py.detach(move || (receiver.recv_timeout(LOOK), receiver));
        match received {
            Ok(result) => return Ok(result),
            Err(RecvTimeoutError::Timeout) => {
                if let Err(error) = py.check_signals().and_then(|()| look(py)) {
                    flag.store(true, Ordering::Relaxed);
                    py.detach(|| wait_for(&worker));
                    return Err(error);
                }
            }
            // The work panicked: so does this, as a `PanicException`.
            Err(RecvTimeoutError::Disconnected) => match worker.join() {
                Err(panic) => std::panic::resume_unwind(panic),
                Ok(()) => return Err(crate::errors::exception("MediantError", "the work was lost", "other")),
            },
        }
    }
}

/// The progress of some work: the part that is done, and the whole.
#[derive(Clone, Default)]
pub(crate) struct Heard(Arc<[AtomicUsize; 2]>);

impl Heard {
    /// Limits whose work tells it.
    pub(crate) fn hear(&self, limits: &Limits) -> Limits {
        let heard = self.clone();
        limits.clone().progress(move |done, total| {
            let [of_done, of_total] = &*heard.0;
            of_done.store(done, Ordering::Relaxed);
            of_total.store(total, Ordering::Relaxed);
        })
    }

    /// Calls a function with both, if the work has told them.
    pub(crate) fn tell(&self, progress: &Bound<'_, PyAny>) -> PyResult<()> {
        let [done, total] = &*self.0;
        let (done, total) = (done.load(Ordering::Relaxed), total.load(Ordering::Relaxed));
        if total > 0 { progress.call1((done, total)).map(drop) } else { Ok(()) }
    }
}

/// Waits until a thread has ended, but not for ever.
fn wait_for(worker: &JoinHandle<()>) {
    let begin = Instant::now();
    while !worker.is_finished() && begin.elapsed() < PATIENCE {
        thread::sleep(Duration::from_millis(1));
    }
}

/// Does work in a pool of threads of its own: as many as asked for, or one for each core.
pub(crate) fn in_pool<T: Send>(threads: Option<usize>, work: impl FnOnce() -> T + Send) -> T {
    let builder = rayon::ThreadPoolBuilder::new;
    let pool = builder().num_threads(threads.unwrap_or(0)).build();
    // Where the system gives no more threads, this one does it all.
    match pool.or_else(|_| builder().num_threads(1).use_current_thread().build()) {
        Ok(pool) => pool.install(work),
        Err(_) => work(),
    }
}

/// The exception that interrupted a watched search, if one did.
#[derive(Clone, Default)]
pub(crate) struct Interruption(Arc<Mutex<Option<PyErr>>>);

impl Interruption {
    /// The limits with a deadline: so many seconds after a call began, or when a signal's handler raises.
    pub(crate) fn watch(&self, limits: Limits, timeout: Option<(Instant, f64)>) -> Limits {
        let slot = self.0.clone();
        let next = Mutex::new(Instant::now() + LOOK);
        limits.deadline(move || {
            let now = Instant::now();
            if timeout.is_some_and(|(begin, seconds)| (now - begin).as_secs_f64() >= seconds) {
                return true;
            }
            let mut next = next.lock().unwrap_or_else(PoisonError::into_inner);
            if now < *next {
                return false;
            }
            *next = now + LOOK;
            let Err(error) = Python::attach(|py| py.check_signals()) else { return false };
            *slot.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
            true
        })
    }

    /// The exception of the signal.
    pub(crate) fn take(&self) -> Option<PyErr> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}
