//! Many queries at once, on all cores.

mod goals;

use std::{
    sync::{
        Arc,
        atomic::{AtomicBool, AtomicUsize, Ordering},
    },
    time::Instant,
};

use mediant::{
    Answer, Error, Guarantee, Index, Planner, Planners, Point, PointEnds, Query, Rules, Status,
    errors::QueryError, names,
};
use numpy::PyArray1;
use pyo3::prelude::*;
use rayon::iter::{IntoParallelIterator, ParallelIterator};

pub(crate) use self::goals::{NearestArrays, nearest, table};

use crate::{
    arguments::{Points, integer, word},
    arrays::{PathPoints, rows_array},
    background::{in_pool, is_watched, with_flag},
    errors::{argument, exception, raised, wrong_type},
    keywords::Keywords,
    paths::Paths,
};

/// The number of the status `invalid`, which follows those of answers.
const INVALID: u8 = Status::ALL.len() as u8;

/// The most distances in a table: of 16 GiB.
const MOST_IN_TABLE: usize = 1 << 31;

/// The keywords of a batch.
pub(crate) struct Batch<'py> {
    threads: Option<usize>,
    progress: Option<Bound<'py, PyAny>>,
    raises: bool,
}

/// The questions of a batch: 0, 1, …, `count` − 1.
#[derive(Clone, Copy)]
struct Numbered {
    count: usize,
    /// The number of questions that a thread gets at once.
    chunk: usize,
    /// The number of queries for which each question counts in the progress.
    queries: usize,
}

impl Numbered {
    /// One query each.
    const fn queries(count: usize) -> Self {
        Self { count, chunk: Planners::CHUNK, queries: 1 }
    }
}

/// The treatment of queries with an invalid end.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Invalid {
    Raise,
    None,
}

names!(Invalid: Raise => "raise", None => "none");

impl<'py> Batch<'py> {
    /// The keywords of a batch. By default a query with an invalid end is an error.
    pub(crate) fn read(
        threads: Option<&Bound<'py, PyAny>>,
        progress: Option<&Bound<'py, PyAny>>,
        invalid: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Self> {
        let raises = invalid.map_or(Ok(Invalid::Raise), |value| word("invalid", value))? == Invalid::Raise;
        Ok(Self { threads: read_threads(threads)?, progress: callback(progress)?, raises })
    }

    /// Has all questions answered: `answer` adds the answer to that of this number to its chunk. The flag
    /// ends a search that takes long. `Planners::find_in_chunks` would do, if all answers were paths.
    fn run<C: Default + Send + 'static>(
        &self,
        py: Python<'py>,
        planners: &Arc<Planners>,
        all: Numbered,
        answer: impl Fn(&mut C, &mut Planner, usize, &Arc<AtomicBool>) + Send + Sync + 'static,
    ) -> PyResult<Vec<C>> {
        py.detach(|| planners.try_make_ready()).map_err(raised)?;
        let (done, flag) = (Arc::new(AtomicUsize::new(0)), Arc::new(AtomicBool::new(false)));
        let (planners, threads) = (Arc::clone(planners), self.threads);
        let (counter, cancelled) = (Arc::clone(&done), Arc::clone(&flag));
        let Numbered { count, chunk, queries } = all;
        let work = move || {
            let answer_chunk = |number: usize| {
                let (first, mut result) = (number * chunk, C::default());
                planners.with(|planner| {
                    for index in first..count.min(first + chunk) {
                        if cancelled.load(Ordering::Relaxed) {
                            break;
                        }
                        answer(&mut result, planner, index, &cancelled);
                        counter.fetch_add(queries, Ordering::Relaxed);
                    }
                });
                result
            };
            let chunks = count.div_ceil(chunk);
            // A single piece of work needs no pool.
            if chunks <= 1 {
                return (0..chunks).map(answer_chunk).collect();
            }
            in_pool(threads, || (0..chunks).into_par_iter().map(answer_chunk).collect())
        };
        let tell = |done: usize| match &self.progress {
            Some(progress) => progress.call1((done, count * queries)).map(drop),
            None => Ok(()),
        };
        let chunks = with_flag(py, &flag, work, |_| tell(done.load(Ordering::Relaxed)))?;
        tell(count * queries)?;
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
    starts: Vec<Point>,
    goals: Vec<Point>,
    is_table: bool,
    keywords: Keywords,
}

impl Queries {
    /// Pairs of a start and a goal. One single point stands for all queries.
    pub(crate) fn pairs<'py>(
        starts: &Bound<'py, PyAny>,
        goals: &Bound<'py, PyAny>,
        keywords: Keywords,
    ) -> PyResult<Self> {
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

    fn ends(&self, index: usize) -> PointEnds {
        let Self { starts, goals, .. } = self;
        if self.is_table {
            return PointEnds::new(starts[index / goals.len()], goals[index % goals.len()]);
        }
        let at = |ends: &[Point]| ends[if ends.len() == 1 { 0 } else { index }];
        PointEnds::new(at(starts), at(goals))
    }

    /// Whether all ends are vertices.
    fn are_whole(&self) -> bool {
        self.starts.iter().chain(&self.goals).all(|at| at.vertex().is_some())
    }

    /// Whether their searches are watched.
    fn are_watched(&self, index: &Index) -> bool {
        is_watched(index, self.keywords.call.wishes().is_none())
    }

    /// A query with its wishes. The flag cancels it.
    fn query(&self, index: usize, watch: Option<&Arc<AtomicBool>>) -> Query {
        let (ends, wishes) = (self.ends(index), self.keywords.call.wishes());
        let mut limits = wishes.limits();
        if let Some(flag) = watch {
            limits = limits.cancel(Arc::clone(flag));
        }
        if let Some(seconds) = wishes.timeout {
            let begin = Instant::now();
            limits = limits.deadline(move || begin.elapsed().as_secs_f64() >= seconds);
        }
        wishes.query(&[ends.start], &[ends.goal], limits)
    }
}

/// The answers of some queries.
#[derive(Default)]
struct Chunk {
    points: Vec<i32>,
    /// The points of its paths instead, where these may lead through points between vertices.
    decimals: Vec<f64>,
    /// The number of points of each path.
    lengths: Vec<u32>,
    distances: Vec<f64>,
    statuses: Vec<u8>,
    /// The first query of the chunk that is invalid.
    invalid: Option<(usize, Error)>,
}

impl Chunk {
    fn add_path(
        &mut self,
        index: usize,
        answer: &Result<Answer, QueryError>,
        (points, rules, guarantee): (PathPoints, Rules, Guarantee),
        are_whole: bool,
    ) {
        let known = self.points.len() + self.decimals.len();
        if let Some(path) = answer.as_ref().ok().and_then(Answer::path) {
            match are_whole {
                true => points.add(path, rules, &mut self.points),
                false => self.decimals.extend(path.points().flat_map(|at| [at.y(), at.x()])),
            }
        }
        self.statuses.push(answer.as_ref().map_or(INVALID, |answer| answer.status() as u8));
        self.lengths.push(((self.points.len() + self.decimals.len() - known) / 2) as u32);
        let distance = answer.as_ref().map(|answer| answer.distance(guarantee)).map_err(Clone::clone);
        self.add_distance(index, distance);
    }

    fn add_distance(&mut self, index: usize, answer: Result<f64, QueryError>) {
        self.distances.push(answer.unwrap_or_else(|error| {
            self.invalid.get_or_insert((index, error.into()));
            f64::NAN
        }));
    }
}

/// The error of a query, or another part of a call, that has this number.
fn numbered(part: &str, number: usize, error: Error) -> PyErr {
    let one = raised(error);
    Python::attach(|py| {
        let code: String = match one.value(py).getattr("code").and_then(|code| code.extract()) {
            Ok(code) => code,
            Err(error) => return error,
        };
        exception("QueryError", &format!("{part} {number}: {}", one.value(py)), &code)
    })
}

/// The first invalid query of all, as an exception.
fn check(invalid: impl Iterator<Item = Option<(usize, Error)>>) -> PyResult<()> {
    match invalid.flatten().next() {
        Some((number, error)) => Err(numbered("query", number, error)),
        None => Ok(()),
    }
}

/// All values of the chunks, one after the other.
fn flat<C, T: Copy>(chunks: &[C], values: impl Fn(&C) -> &Vec<T>) -> Vec<T> {
    let mut all = Vec::with_capacity(chunks.iter().map(|chunk| values(chunk).len()).sum());
    chunks.iter().for_each(|chunk| all.extend_from_slice(values(chunk)));
    all
}

/// The chunks of answers, if none of them is an error that is raised.
fn checked(mut chunks: Vec<Chunk>, batch: &Batch<'_>) -> PyResult<Vec<Chunk>> {
    if batch.raises {
        check(chunks.iter_mut().map(|chunk| chunk.invalid.take()))?;
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
    let index = planners.index();
    let (setup, is_watched) = (index.setup(), queries.are_watched(index));
    let rules = setup.rules();
    let is_between_centers = matches!(rules, Rules::CenterGap(_));
    let are_whole = points == PathPoints::Touched || queries.are_whole() && !is_between_centers;
    let all = Numbered::queries(queries.count());
    let answer = move |chunk: &mut Chunk, planner: &mut Planner, index: usize, flag: &Arc<AtomicBool>| {
        let found = planner.find(queries.query(index, is_watched.then_some(flag)));
        chunk.add_path(index, &found, (points, rules, planner.guarantee()), are_whole);
    };
    let chunks = checked(batch.run(py, planners, all, answer)?, batch)?;
    let (points, decimals, offsets, distances, statuses) = py.detach(|| {
        let mut end = 0;
        let ends = chunks.iter().flat_map(|chunk| &chunk.lengths).map(|&length| {
            end += i64::from(length);
            end
        });
        let offsets: Vec<i64> = std::iter::once(0).chain(ends).collect();
        let points = flat(&chunks, |chunk| &chunk.points);
        let decimals = flat(&chunks, |chunk| &chunk.decimals);
        (
            points,
            decimals,
            offsets,
            flat(&chunks, |chunk| &chunk.distances),
            flat(&chunks, |chunk| &chunk.statuses),
        )
    });
    Ok(Paths {
        points: if are_whole { rows_array(py, points, 2)? } else { rows_array(py, decimals, 2)? }.unbind(),
        offsets: PyArray1::from_vec(py, offsets).unbind(),
        distances: PyArray1::from_vec(py, distances).unbind(),
        statuses: PyArray1::from_vec(py, statuses).unbind(),
    })
}

/// `Index.distances`, and `Index.table` as one row. Paths are made only where a query has wishes, or is
/// watched.
pub(crate) fn distances<'py>(
    py: Python<'py>,
    planners: &Arc<Planners>,
    queries: Queries,
    batch: &Batch<'_>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let is_watched = queries.are_watched(planners.index());
    let is_plain = queries.keywords.call.wishes().is_none() && !is_watched;
    let all = Numbered::queries(queries.count());
    let answer = move |chunk: &mut Chunk, planner: &mut Planner, index: usize, flag: &Arc<AtomicBool>| {
        let found = if is_plain {
            planner.distance(queries.ends(index)).map(|distance| distance.unwrap_or(f64::INFINITY))
        } else {
            let query = queries.query(index, is_watched.then_some(flag));
            planner.find(query).map(|answer| answer.distance(planner.guarantee()))
        };
        chunk.add_distance(index, found);
    };
    let chunks = checked(batch.run(py, planners, all, answer)?, batch)?;
    Ok(PyArray1::from_vec(py, py.detach(|| flat(&chunks, |chunk| &chunk.distances))))
}
