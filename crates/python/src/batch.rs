//! Many queries at once, on all cores.

use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};

use mediant::{BatchProgress, Outcome, PlacementKind, Planners, Query, QueryError, Request, Vertex};
use numpy::{PyArray1, PyArray2};
use pyo3::{
    exceptions::PyIndexError,
    prelude::*,
    types::{PyList, PySlice, PyTuple},
};

use crate::{
    answer,
    arguments::{Points, integer, word},
    arrays::{PathPoints, rows_array},
    background::{in_pool, is_watched, on_thread},
    errors::{argument, exception, raised, wrong_type},
    keywords::Keywords,
};

/// The statuses of answers, by number.
const STATUSES: [&str; 5] = ["found", "unreachable", "nearest", "stopped", "invalid"];
const INVALID: u8 = 4;

/// The most distances in a table: of 16 GiB.
const MOST_IN_TABLE: usize = 1 << 31;

/// The answers of `Index.paths`, in the order of the queries: a sequence of arrays or None, in flat arrays.
///
/// Attributes
/// ----------
/// points : numpy.ndarray
///     The points of all paths, one after the other: shape (m, 2), int32.
/// offsets : numpy.ndarray
///     Shape (n + 1,), int64: path i has the points from ``offsets[i]`` up to ``offsets[i + 1]``. Where there
///     is no path the two are equal.
/// distances : numpy.ndarray
///     Shape (n,), float64: lengths in cells; ``inf`` where no path leads, ``nan`` where a limit stopped the
///     search or an end is invalid.
/// statuses : numpy.ndarray
///     Shape (n,), uint8: 0 found, 1 unreachable, 2 nearest, 3 stopped, 4 invalid.
///
/// Examples
/// --------
/// >>> import mediant
/// >>> index = mediant.Grid.from_rows(["..#.", "..#."]).prepare()
/// >>> paths = index.paths([(0, 0), (0, 0)], [(1, 1), (0, 3)])
/// >>> len(paths), paths[0].tolist(), paths[1]
/// (2, [[0, 0], [1, 1]], None)
/// >>> paths.offsets.tolist(), paths.statuses.tolist()
/// ([0, 2, 2], [0, 1])
#[pyclass(frozen, module = "mediant")]
pub(crate) struct Paths {
    /// The points of all paths, shape (m, 2).
    #[pyo3(get)]
    points: Py<PyAny>,
    /// Where each path begins in the points, and where the last one ends.
    #[pyo3(get)]
    offsets: Py<PyArray1<i64>>,
    /// The lengths in cells.
    #[pyo3(get)]
    distances: Py<PyArray1<f64>>,
    /// What became of the queries, by number.
    #[pyo3(get)]
    statuses: Py<PyArray1<u8>>,
}

#[pymethods]
impl Paths {
    fn __len__(&self, py: Python<'_>) -> PyResult<usize> {
        self.distances.bind(py).len()
    }

    fn __getitem__<'py>(&self, index: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let py = index.py();
        let count = self.__len__(py)? as isize;
        if let Ok(slice) = index.cast::<PySlice>() {
            let range = slice.indices(count)?;
            let numbers = (0..range.slicelength as isize).map(|at| range.start + at * range.step);
            let paths: Vec<_> = numbers.map(|at| self.path(py, at)).collect::<PyResult<_>>()?;
            return Ok(PyList::new(py, paths)?.into_any());
        }
        let index: isize =
            index.extract().map_err(|_| wrong_type("index", "an integer or a slice", index))?;
        let at = if index < 0 { index + count } else { index };
        if !(0..count).contains(&at) {
            return Err(PyIndexError::new_err(format!("path {index} of {count}")));
        }
        Ok(self.path(py, at)?.into_pyobject(py)?)
    }

    fn __iter__<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        let builtins = slf.py().import("builtins")?;
        let numbers = builtins.getattr("range")?.call1((slf.len()?,))?;
        builtins.getattr("map")?.call1((slf.getattr("__getitem__")?, numbers))
    }

    /// By the four arrays, for pickle.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let (py, paths) = (slf.py(), slf.get());
        let arrays = (&paths.points, &paths.offsets, &paths.distances, &paths.statuses).into_pyobject(py)?;
        Ok((slf.get_type().getattr("_of_arrays")?, arrays))
    }

    /// The answers with these arrays.
    #[staticmethod]
    fn _of_arrays(
        points: Bound<'_, PyArray2<i32>>,
        offsets: Bound<'_, PyArray1<i64>>,
        distances: Bound<'_, PyArray1<f64>>,
        statuses: Bound<'_, PyArray1<u8>>,
    ) -> PyResult<Self> {
        let count = distances.len()?;
        if offsets.len()? != count + 1 || statuses.len()? != count {
            return Err(argument("offsets", "expected one more than there are distances and statuses"));
        }
        Ok(Self {
            points: points.into_any().unbind(),
            offsets: offsets.unbind(),
            distances: distances.unbind(),
            statuses: statuses.unbind(),
        })
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        Ok(format!("<mediant.Paths of {} queries>", self.__len__(py)?))
    }
}

impl Paths {
    /// One of the paths.
    fn path<'py>(&self, py: Python<'py>, at: isize) -> PyResult<Option<Bound<'py, PyAny>>> {
        let offset = |at: isize| -> PyResult<isize> { self.offsets.bind(py).get_item(at)?.extract() };
        let (first, end) = (offset(at)?, offset(at + 1)?);
        let points = || self.points.bind(py).get_item(PySlice::new(py, first, end, 1));
        (first < end).then(points).transpose()
    }
}

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

/// The queries of a batch.
enum Queries {
    /// From each start to the goal of the same number.
    Pairs { starts: Vec<Vertex>, goals: Vec<Vertex>, keywords: Keywords },
    /// From each start to each goal.
    Table { starts: Vec<Vertex>, goals: Vec<Vertex> },
}

impl Queries {
    fn count(&self) -> usize {
        match self {
            Self::Pairs { starts, goals, .. } => {
                starts.len().max(goals.len()) * usize::from(!starts.is_empty() && !goals.is_empty())
            }
            Self::Table { starts, goals } => starts.len() * goals.len(),
        }
    }

    fn request(&self, index: usize, watch: Option<&Arc<AtomicBool>>) -> Request {
        let (query, keywords) = match self {
            // One start or goal stands for all queries.
            Self::Pairs { starts, goals, keywords } => {
                let at = |ends: &[Vertex]| ends[if ends.len() == 1 { 0 } else { index }];
                (Query::new(at(starts), at(goals)), Some(keywords))
            }
            Self::Table { starts, goals } => {
                (Query::new(starts[index / goals.len()], goals[index % goals.len()]), None)
            }
        };
        let has_no_wishes = keywords.is_none_or(Keywords::has_no_wishes);
        if has_no_wishes && watch.is_none() {
            return query.into();
        }
        let limits = keywords.map(Keywords::limits).unwrap_or_default();
        let limits = match watch {
            Some(flag) => limits.cancel(Arc::clone(flag)),
            None => limits,
        };
        let limits = match keywords.and_then(Keywords::timeout) {
            Some(seconds) => {
                let begin = std::time::Instant::now();
                limits.deadline(move || begin.elapsed().as_secs_f64() >= seconds)
            }
            None => limits,
        };
        match keywords {
            Some(keywords) => keywords.wish(query.into(), limits),
            None => query.within(limits),
        }
    }
}

/// The pairs of starts and goals, of which one may stand for all.
fn pairs(starts: Points, goals: Points, keywords: Keywords) -> PyResult<Queries> {
    let is_one = |ends: &Points| matches!(ends, Points::One(_));
    let (counts, ones) =
        ((starts.as_slice().len(), goals.as_slice().len()), (is_one(&starts), is_one(&goals)));
    if counts.0 != counts.1 && !ones.0 && !ones.1 {
        let wrong = format!("expected {} points, as many as starts, or one; found {}", counts.0, counts.1);
        return Err(argument("goals", &wrong));
    }
    Ok(Queries::Pairs { starts: starts.into_vec(), goals: goals.into_vec(), keywords })
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

/// The chunks of a batch of pairs.
fn chunks(
    py: Python<'_>,
    planners: &Arc<Planners>,
    (starts, goals): (Points, Points),
    points: Option<PathPoints>,
    (keywords, batch): (Keywords, &Batch<'_>),
) -> PyResult<Vec<Chunk>> {
    let placement = planners.index().setup().rules.placement();
    let queries = pairs(starts, goals, keywords)?;
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
    ends: (Points, Points),
    points: PathPoints,
    (keywords, batch): (Keywords, &Batch<'_>),
) -> PyResult<Paths> {
    let chunks = chunks(py, planners, ends, Some(points), (keywords, batch))?;
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

/// `Index.distances`.
pub(crate) fn distances<'py>(
    py: Python<'py>,
    planners: &Arc<Planners>,
    ends: (Points, Points),
    (keywords, batch): (Keywords, &Batch<'_>),
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let chunks = chunks(py, planners, ends, None, (keywords, batch))?;
    Ok(PyArray1::from_vec(py, flat(&chunks, |chunk| &chunk.distances)))
}

/// `Index.table`.
pub(crate) fn table<'py>(
    py: Python<'py>,
    planners: &Arc<Planners>,
    (starts, goals): (Points, Points),
    batch: &Batch<'_>,
) -> PyResult<Bound<'py, PyAny>> {
    let placement = planners.index().setup().rules.placement();
    let (starts, goals) = (starts.into_vec(), goals.into_vec());
    let shape = (starts.len(), goals.len());
    if shape.0.checked_mul(shape.1).is_none_or(|count| count > MOST_IN_TABLE) {
        let wrong = format!("a table of {} × {} distances: at most {MOST_IN_TABLE} fit", shape.0, shape.1);
        return Err(argument("goals", &wrong));
    }
    let add = move |chunk: &mut Chunk, answer| chunk.add(&answer, None, placement);
    let chunks = batch.run(py, planners, Queries::Table { starts, goals }, add)?;
    check(&chunks)?;
    PyArray1::from_vec(py, flat(&chunks, |chunk| &chunk.distances)).call_method1("reshape", (shape,))
}
