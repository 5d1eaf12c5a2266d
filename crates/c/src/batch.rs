//! Many paths at once.

#![allow(unsafe_code, reason = "functions of C")]

use std::{
    num::NonZeroUsize,
    sync::{
        Arc,
        atomic::{AtomicBool, AtomicUsize, Ordering},
    },
    thread,
};

use library::{Answer, Index, Path, Planner, Planners, PointEnds, Query};

use crate::{
    code::Code,
    failure::{Failure, call},
    handles::{Held, Kind, Table},
    index::IndexHandle,
    memory,
    points::{Ends, Point},
    watch::{Watch, Watcher},
};

/// Paths, one after another in three arrays. `{0}` is none.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct BatchHandle {
    /// Its number.
    pub id: u64,
}

/// Paths, one after another.
#[derive(Debug, Default)]
pub(crate) struct Batch {
    /// By query; NaN for one that has an error.
    lengths: Vec<f64>,
    codes: Vec<i32>,
    /// By query, and one more, the number of the path's first point.
    firsts: Vec<usize>,
    points: Vec<Point>,
}

impl Held for Batch {
    type Kept = Arc<Self>;

    fn handles() -> &'static Table<Arc<Self>> {
        static HANDLES: Table<Arc<Batch>> = Table::new(Kind::Batch);
        &HANDLES
    }
}

impl BatchHandle {
    /// Keeps paths, and writes their handle.
    ///
    /// # Safety
    /// As for [`memory::put`].
    pub(crate) unsafe fn put(batch: Batch, place: (&str, *mut Self)) -> Result<(), Failure> {
        let (name, place) = place;
        memory::check_place(name, place)?;
        let id = Batch::handles().share(batch)?;
        // SAFETY: the caller promises it.
        unsafe { memory::put(name, place, Self { id }) }
    }
}

/// The queries that a thread takes at a time.
const PIECE: usize = 256;

/// The paths of many queries, by so many threads; 0 is one for each core. A query with a mistake, such as a
/// blocked end, has a code of its own. The watcher is told how many queries are done.
///
/// # Safety
/// `ends` leads to `count` pairs; `watcher` is null or leads to one; `batch` leads to a handle's memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_index_paths(
    index: IndexHandle,
    ends: *const Ends,
    count: usize,
    threads: usize,
    watcher: *const Watcher,
    batch: *mut BatchHandle,
) -> Code {
    call(|| {
        memory::check_place("batch", batch)?;
        let index = Index::handles().get(index.id)?;
        // SAFETY: the caller promises it.
        let (ends, watch) = unsafe { (memory::array("ends", ends, count)?, Watch::read(watcher)?) };
        let cores = || thread::available_parallelism().map_or(1, NonZeroUsize::get);
        let threads = if threads == 0 { cores() } else { threads };
        let found = paths(&index, ends, threads, &watch)?;
        // SAFETY: as above.
        unsafe { BatchHandle::put(found, ("batch", batch)) }
    })
}

fn paths(index: &Index, ends: &[Ends], threads: usize, watch: &Watch) -> Result<Batch, Failure> {
    let planners = Planners::new(index.clone());
    let (next, done, is_stopped) = (AtomicUsize::new(0), AtomicUsize::new(0), AtomicBool::new(false));
    let pieces = ends.len().div_ceil(PIECE);
    let work = || {
        let mut own = Vec::new();
        while !is_stopped.load(Ordering::Relaxed) {
            let piece = next.fetch_add(1, Ordering::Relaxed);
            if piece >= pieces {
                break;
            }
            if watch.stops() {
                is_stopped.store(true, Ordering::Relaxed);
                break;
            }
            let part = &ends[piece * PIECE..ends.len().min((piece + 1) * PIECE)];
            let Some(found) = planners.with(|planner| Batch::of(planner, part, watch)) else {
                is_stopped.store(true, Ordering::Relaxed);
                break;
            };
            own.push((piece, found));
            let so_far = done.fetch_add(part.len(), Ordering::Relaxed) + part.len();
            watch.tell(so_far, ends.len());
        }
        own
    };
    let threads = threads.clamp(1, pieces.max(1));
    let mut all = thread::scope(|scope| {
        // Where the system gives no more threads, those that are there do the work.
        let others: Vec<_> =
            (1..threads).map_while(|_| thread::Builder::new().spawn_scoped(scope, work).ok()).collect();
        let mut all = work();
        for other in others {
            all.extend(other.join().map_err(|_| Failure::fault())?);
        }
        Ok::<_, Failure>(all)
    })?;
    if is_stopped.into_inner() {
        return Err(Watch::stopped("finding paths"));
    }
    all.sort_unstable_by_key(|(piece, _)| *piece);
    Ok(all
        .into_iter()
        .fold(Batch { firsts: vec![0], ..Batch::default() }, |batch, (_, own)| batch.joined(own)))
}

impl Batch {
    /// The paths of some queries, unless the watcher stops one: long ones ask it too.
    fn of(planner: &mut Planner, ends: &[Ends], watch: &Watch) -> Option<Self> {
        let limits = watch.can_stop().then(|| watch.stopping());
        let mut batch = Self::default();
        for ends in ends {
            let found = ends.start.inner("start").and_then(|start| {
                let ends = PointEnds::new(start, ends.goal.inner("goal")?);
                Ok(match &limits {
                    Some(limits) => planner.find(Query::new(ends.start, ends.goal).within(limits.clone()))?,
                    None => planner.find(ends)?,
                })
            });
            let found = match found {
                Ok(Answer::Stopped(_)) => return None,
                found => found.map(Answer::into_path),
            };
            match found {
                Ok(path) => batch.push(path.as_ref(), Code::Ok),
                Err(failure) => batch.push(None, failure.code),
            }
        }
        Some(batch)
    }

    /// The path of a single question.
    pub(crate) fn of_one(path: Option<&Path>) -> Self {
        let mut batch = Self { firsts: vec![0], ..Self::default() };
        batch.push(path, Code::Ok);
        batch
    }

    /// Adds the path of a query, or none.
    fn push(&mut self, path: Option<&Path>, code: Code) {
        let none = if code == Code::Ok { f64::INFINITY } else { f64::NAN };
        self.lengths.push(path.map_or(none, Path::cost));
        self.codes.push(code as i32);
        self.points.extend(path.into_iter().flat_map(Path::points).map(Point::from));
        self.firsts.push(self.points.len());
    }

    /// These paths, and others after them.
    fn joined(mut self, other: Self) -> Self {
        let points = self.points.len();
        self.lengths.extend(other.lengths);
        self.codes.extend(other.codes);
        self.firsts.extend(other.firsts.into_iter().map(|first| first + points));
        self.points.extend(other.points);
        self
    }
}

/// The paths of a batch. All arrays are the library's, and stay until the batch is freed.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Paths {
    /// The number of queries.
    pub count: usize,
    /// By query the length of its path; infinity where there is none, NaN for a query with a mistake.
    pub lengths: *const f64,
    /// By query its code.
    pub codes: *const i32,
    /// By query the number of its first point, and after the last the number of all: path i has the points
    /// from `firsts[i]` up to `firsts[i + 1]`.
    pub firsts: *const usize,
    /// The points of all paths.
    pub points: *const Point,
}

/// The paths of a batch.
///
/// # Safety
/// `paths` leads to memory for it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_batch_paths(batch: BatchHandle, paths: *mut Paths) -> Code {
    call(|| {
        let batch = Batch::handles().get(batch.id)?;
        let Batch { lengths, codes, firsts, points } = &*batch;
        let found = Paths {
            count: lengths.len(),
            lengths: lengths.as_ptr(),
            codes: codes.as_ptr(),
            firsts: firsts.as_ptr(),
            points: points.as_ptr(),
        };
        // SAFETY: the caller promises it.
        unsafe { memory::put("paths", paths, found) }
    })
}

/// Frees a batch.
#[unsafe(no_mangle)]
pub extern "C" fn mediant_batch_free(batch: BatchHandle) -> Code {
    call(|| Batch::handles().free(batch.id))
}
