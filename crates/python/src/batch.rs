//! Many queries at once, on all cores.

use std::{
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    time::Instant,
};

use mediant::{BatchProgress, Outcome, PlacementKind, Planners, Query, QueryError, Request, Vertex};
use numpy::PyArray1;
use pyo3::{prelude::*, types::PyDict};

use crate::{
    answer,
    arguments::{Points, integer, word},
    arrays::{PathPoints, rows_array},
    background::{in_pool, is_watched, on_thread},
    errors::{argument, exception, raised, wrong_type},
    keywords::{Keywords, Takes},
    paths::Paths,
};

/// The statuses of answers, by number.
const STATUSES: [&str; 5] = ["found", "unreachable", "nearest", "stopped", "invalid"];
const INVALID: u8 = 4;

/// The most distances in a table: of 16 GiB.
const MOST_IN_TABLE: usize = 1 << 31;

/// How a batch runs.
pub(crate) struct Batch<'py> {
    threads: Option<usize>,
    progress: Option<Bound<'py, PyAny>>,
    raises: bool,
}

impl<'py> Batch<'py> {
    /// The keywords of a batch. By default a query with an invalid end is an error.
    pub(crate) fn read(
        threads: Option<&Bound<'py, PyAny>>,
        progress: Option<&Bound<'py, PyAny>>,
        invalid: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Self> {
        let raises =
            invalid.map_or(Ok(true), |value| word("invalid", value, &[("raise", true), ("none", false)]))?;
        Ok(Self { threads: read_threads(threads)?, progress: callback(progress)?, raises })
    }

    /// Answers the queries from 0 up to `count`, and adds each answer to its chunk.
    fn run<C: Default + Send + 'static>(
        &self,
        py: Python<'py>,
        planners: &Arc<Planners>,
        queries: Queries,
        add: impl Fn(&mut C, Result<Outcome, QueryError>) + Send + Sync + 'static,
    ) -> PyResult<Vec<C>> {
        let (count, planners, threads) = (queries.count(), Arc::clone(planners), self.threads);
        let (done, flag) = (Arc::new(BatchProgress::default()), Arc::new(AtomicBool::new(false)));
        // A search that takes long is ended by the flag, too.
        let watch = is_watched(planners.index()).then(|| Arc::clone(&flag));
        let progress = Arc::clone(&done);
        let work = move || {
            let request = |index| queries.request(index, watch.as_ref());
            let find = || planners.find_in_chunks(count, request, &progress, add);
            if count <= Planners::CHUNK { find() } else { in_pool(threads, find) }
        };
        let tell = |done: usize| match &self.progress {
            Some(progress) => progress.call1((done, count)).map(drop),
            None => Ok(()),
        };
        let result = on_thread(py, work, |_| tell(done.done()));
        if result.is_err() {
            done.cancel();
            flag.store(true, Ordering::Relaxed);
        }
        let chunks = result?;
        tell(count)?;
        Ok(chunks)
    }
}

/// The number of threads; `None` for one each core.
pub(crate) fn read_threads(value: Option<&Bound<'_, PyAny>>) -> PyResult<Option<usize>> {
    let Some(value) = value.filter(|value| !value.is_none()) else { return Ok(None) };
    let threads = integer("threads", value, 1)?;
    if threads > 4096 {
        return Err(argument("threads", &format!("expected at most 4096, found {threads}")));
    }
    Ok(Some(threads as usize))
}

/// A function to call, if there is one.
pub(crate) fn callback<'py>(value: Option<&Bound<'py, PyAny>>) -> PyResult<Option<Bound<'py, PyAny>>> {
    let Some(value) = value.filter(|value| !value.is_none()) else { return Ok(None) };
    if value.is_callable() {
        Ok(Some(value.clone()))
    } else {
        Err(wrong_type("progress", "a function", value))
    }
}

/// The queries of a batch: from each start to the goal of the same number, or in a table to each goal.
pub(crate) struct Queries {
    starts: Vec<Vertex>,
    goals: Vec<Vertex>,
    is_table: bool,
    keywords: Keywords,
}

impl Queries {
    /// Pairs of a start and a goal. One single point stands for all queries.
    pub(crate) fn pairs<'py>(
        function: &str,
        starts: &Bound<'py, PyAny>,
        goals: &Bound<'py, PyAny>,
        wishes: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Self> {
        let keywords = Keywords::read(function, wishes, Takes::WISHES)?;
        let (starts, goals) = (Points::read("starts", starts)?, Points::read("goals", goals)?);
        let is_one = |ends: &Points| matches!(ends, Points::One(_));
        let has_single = is_one(&starts) || is_one(&goals);
        let (starts, goals) = (starts.into_vec(), goals.into_vec());
        if starts.len() != goals.len() && !has_single {
            let (expected, found) = (starts.len(), goals.len());
            let wrong = format!("expected {expected} points, as many as starts, or one; found {found}");
            return Err(argument("goals", &wrong));
        }
        Ok(Self { starts, goals, is_table: false, keywords })
    }

    /// From each start to each goal.
    pub(crate) fn table(starts: &Bound<'_, PyAny>, goals: &Bound<'_, PyAny>) -> PyResult<Self> {
        let starts = Points::read("starts", starts)?.into_vec();
        let goals = Points::read("goals", goals)?.into_vec();
        let (rows, columns) = (starts.len(), goals.len());
        if rows.checked_mul(columns).is_none_or(|count| count > MOST_IN_TABLE) {
            let wrong = format!("a table of {rows} × {columns} distances: at most {MOST_IN_TABLE} fit");
            return Err(argument("goals", &wrong));
        }
        Ok(Self { starts, goals, is_table: true, keywords: Keywords::default() })
    }

    fn count(&self) -> usize {
        let (starts, goals) = (self.starts.len(), self.goals.len());
        match (starts, goals) {
            (0, _) | (_, 0) => 0,
            _ if self.is_table => starts * goals,
            _ => starts.max(goals),
        }
    }

    fn query(&self, index: usize) -> Query {
        let Self { starts, goals, .. } = self;
        if self.is_table {
            return Query::new(starts[index / goals.len()], goals[index % goals.len()]);
        }
        let at = |ends: &[Vertex]| ends[if ends.len() == 1 { 0 } else { index }];
        Query::new(at(starts), at(goals))
    }

    /// A query with its wishes. The flag cancels it.
    fn request(&self, index: usize, watch: Option<&Arc<AtomicBool>>) -> Request {
        let (query, keywords) = (self.query(index), &self.keywords);
        if keywords.has_no_wishes() && watch.is_none() {
            return query.into();
        }
        let mut limits = keywords.limits();
        if let Some(flag) = watch {
            limits = limits.cancel(Arc::clone(flag));
        }
        if let Some(seconds) = keywords.timeout() {
            let begin = Instant::now();
            limits = limits.deadline(move || begin.elapsed().as_secs_f64() >= seconds);
        }
        keywords.wish(query.into(), limits)
    }
}

/// The answers of some queries.
#[derive(Default)]
struct Chunk {
    points: Vec<i32>,
    /// The number of points of each path.
    lengths: Vec<u32>,
    distances: Vec<f64>,
    statuses: Vec<u8>,
    /// The first query of the chunk that is invalid.
    invalid: Option<(usize, QueryError)>,
}

impl Chunk {
    fn add(
        &mut self,
        answer: &Result<Outcome, QueryError>,
        points: Option<PathPoints>,
        placement: PlacementKind,
    ) {
        let known = self.points.len();
        let (status, distance) = match answer {
            Ok(outcome) => {
                if let (Some(points), Some(path)) = (points, outcome.path()) {
                    points.add(path, placement, &mut self.points);
                }
                let name = answer::status(outcome);
                let status = STATUSES.iter().position(|&status| status == name).unwrap_or_default();
                (status as u8, answer::distance(outcome))
            }
            Err(error) => {
                self.invalid.get_or_insert((self.statuses.len(), *error));
                (INVALID, f64::NAN)
            }
        };
        self.statuses.push(status);
        self.distances.push(distance);
        if points.is_some() {
            self.lengths.push(((self.points.len() - known) / 2) as u32);
        }
    }
}

/// The first invalid query of all, as an exception.
fn check(chunks: &[Chunk]) -> PyResult<()> {
    let invalid = chunks.iter().zip(0..).find_map(|(chunk, number)| {
        chunk.invalid.map(|(index, error)| (number * Planners::CHUNK + index, error))
    });
    let Some((index, error)) = invalid else { return Ok(()) };
    let one = raised(error);
    Python::attach(|py| {
        let code: String = one.value(py).getattr("code")?.extract()?;
        let text = format!("query {index}: {}", one.value(py));
        Err(exception("QueryError", &text, &code))
    })
}

/// All values of the chunks, one after the other.
fn flat<T: Copy>(chunks: &[Chunk], values: impl Fn(&Chunk) -> &Vec<T>) -> Vec<T> {
    let mut all = Vec::with_capacity(chunks.iter().map(|chunk| values(chunk).len()).sum());
    chunks.iter().for_each(|chunk| all.extend_from_slice(values(chunk)));
    all
}

/// The answers of a batch, in chunks.
fn chunks(
    py: Python<'_>,
    planners: &Arc<Planners>,
    queries: Queries,
    points: Option<PathPoints>,
    batch: &Batch<'_>,
) -> PyResult<Vec<Chunk>> {
    let placement = planners.index().setup().rules.placement();
    let add = move |chunk: &mut Chunk, answer| chunk.add(&answer, points, placement);
    let chunks = batch.run(py, planners, queries, add)?;
    if batch.raises {
        check(&chunks)?;
    }
    Ok(chunks)
}

/// `Index.paths`.
pub(crate) fn paths(
    py: Python<'_>,
    planners: &Arc<Planners>,
    queries: Queries,
    points: PathPoints,
    batch: &Batch<'_>,
) -> PyResult<Paths> {
    let chunks = chunks(py, planners, queries, Some(points), batch)?;
    let (points, offsets, distances, statuses) = py.detach(|| {
        let mut end = 0;
        let ends = chunks.iter().flat_map(|chunk| &chunk.lengths).map(|&length| {
            end += i64::from(length);
            end
        });
        let offsets: Vec<i64> = std::iter::once(0).chain(ends).collect();
        let points = flat(&chunks, |chunk| &chunk.points);
        (points, offsets, flat(&chunks, |chunk| &chunk.distances), flat(&chunks, |chunk| &chunk.statuses))
    });
    Ok(Paths {
        points: rows_array(py, points, 2)?.unbind(),
        offsets: PyArray1::from_vec(py, offsets).unbind(),
        distances: PyArray1::from_vec(py, distances).unbind(),
        statuses: PyArray1::from_vec(py, statuses).unbind(),
    })
}

/// `Index.distances`, and `Index.table` as one row.
pub(crate) fn distances<'py>(
    py: Python<'py>,
    planners: &Arc<Planners>,
    queries: Queries,
    batch: &Batch<'_>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let chunks = chunks(py, planners, queries, None, batch)?;
    Ok(PyArray1::from_vec(py, flat(&chunks, |chunk| &chunk.distances)))
}

/// `Index.table`.
pub(crate) fn table<'py>(
    py: Python<'py>,
    planners: &Arc<Planners>,
    queries: Queries,
    batch: &Batch<'_>,
) -> PyResult<Bound<'py, PyAny>> {
    let shape = (queries.starts.len(), queries.goals.len());
    distances(py, planners, queries, batch)?.call_method1("reshape", (shape,))
}
