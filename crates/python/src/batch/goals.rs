//! Many starts with the same goals: tables, and the nearest goal of each start.

use std::sync::{Arc, atomic::AtomicBool};

use mediant::{Error, Goals, Index, Limits, Planner, Planners, Point};
use numpy::PyArray1;
use pyo3::prelude::*;

use super::{Batch, Chunk, Numbered, Queries, check, checked, distances, flat, numbered};
use crate::{
    arguments::Points,
    background::{has_labels, on_thread},
    errors::raised,
};

/// The goals, prepared for the index.
fn prepared(py: Python<'_>, index: &Index, goals: Vec<Point>) -> PyResult<Goals> {
    let (index, are_few) = (index.clone(), goals.len() <= Planners::CHUNK);
    let work = move |limits: &Limits| index.within(limits).goals(goals);
    let goals = match are_few {
        true => py.detach(|| work(&Limits::new())),
        false => on_thread(py, Limits::new(), work, |_| Ok(()))?,
    };
    goals.map_err(raised)
}

/// The number of the first vertex that is blocked or outside the map.
fn first_invalid(index: &Index, ends: &[Point]) -> Option<usize> {
    ends.iter().position(|&at| !index.space().is_free(at))
}

/// `Index.table`.
pub(crate) fn table<'py>(
    py: Python<'py>,
    planners: &Arc<Planners>,
    queries: Queries,
    batch: &Batch<'_>,
) -> PyResult<Bound<'py, PyAny>> {
    let shape = (queries.starts.len(), queries.goals.len());
    if queries.count() > 0 && has_labels(planners.index()) {
        return rows(py, planners, queries, batch)?.call_method1("reshape", (shape,));
    }
    distances(py, planners, queries, batch)?.call_method1("reshape", (shape,))
}

/// A table with hub labels: the goals of a start together.
fn rows<'py>(
    py: Python<'py>,
    planners: &Arc<Planners>,
    queries: Queries,
    batch: &Batch<'_>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let index = planners.index();
    let columns = queries.goals.len();
    // The first invalid query in the order of the table is the one that a search for each would name.
    let start = first_invalid(index, &queries.starts);
    let goal = first_invalid(index, &queries.goals).filter(|_| start != Some(0));
    if let Some(number) = goal.or(start.map(|row| row * columns))
        && let Err(error) = planners.with(|planner| planner.distance(queries.ends(number)))
    {
        return Err(numbered("query", number, error.into()));
    }
    let Queries { starts, goals, .. } = queries;
    let goals = prepared(py, index, goals)?;
    let chunk = (Planners::CHUNK / columns).max(1);
    let all = Numbered { count: starts.len(), chunk, queries: columns };
    let answer = move |chunk: &mut Chunk, planner: &mut Planner, row: usize, flag: &Arc<AtomicBool>| {
        let limits = Limits::new().cancel(Arc::clone(flag));
        let distances = planner.within(limits).distances(starts[row], &goals);
        match distances {
            Ok(distances) => chunk.distances.extend(distances),
            Err(error) => _ = chunk.invalid.get_or_insert((row * columns, error)),
        }
    };
    let chunks = checked(batch.run(py, planners, all, answer)?, batch)?;
    Ok(PyArray1::from_vec(py, py.detach(|| flat(&chunks, |chunk| &chunk.distances))))
}

/// The nearest goals of some starts.
#[derive(Default)]
struct Nearest {
    numbers: Vec<i64>,
    distances: Vec<f64>,
    /// The first start of the chunk that is invalid.
    invalid: Option<(usize, Error)>,
}

/// The nearest goals, and the distances to them.
pub(crate) type NearestArrays<'py> = (Bound<'py, PyArray1<i64>>, Bound<'py, PyArray1<f64>>);

/// `Index.nearest`.
pub(crate) fn nearest<'py>(
    py: Python<'py>,
    planners: &Arc<Planners>,
    starts: &Bound<'py, PyAny>,
    goals: &Bound<'py, PyAny>,
    batch: &Batch<'_>,
) -> PyResult<NearestArrays<'py>> {
    let starts = Points::read("starts", starts)?.into_vec();
    let goals = Points::read("goals", goals)?.into_vec();
    let index = planners.index();
    if batch.raises
        && let Some(number) = first_invalid(index, &goals)
        && let Err(error) = index.goals([goals[number]])
    {
        return Err(numbered("goal", number, error));
    }
    // The goals that are left keep their numbers.
    let is_valid = |&(_, at): &(i64, Point)| index.space().is_free(at);
    let (numbers, goals): (Vec<i64>, Vec<Point>) = (0..).zip(goals).filter(is_valid).unzip();
    let (goals, all) = (prepared(py, index, goals)?, Numbered::queries(starts.len()));
    let answer = move |chunk: &mut Nearest, planner: &mut Planner, index: usize, flag: &Arc<AtomicBool>| {
        let limits = Limits::new().cancel(Arc::clone(flag));
        let (number, distance) = match planner.within(limits).nearest(starts[index], &goals) {
            Ok(Some((goal, distance))) => (numbers.get(goal).copied(), distance),
            Ok(None) => (None, f64::INFINITY),
            Err(error) => {
                chunk.invalid.get_or_insert((index, error));
                (None, f64::NAN)
            }
        };
        chunk.numbers.push(number.unwrap_or(-1));
        chunk.distances.push(distance);
    };
    let mut chunks = batch.run(py, planners, all, answer)?;
    if batch.raises {
        check(chunks.iter_mut().map(|chunk| chunk.invalid.take()))?;
    }
    let (numbers, distances) =
        py.detach(|| (flat(&chunks, |chunk| &chunk.numbers), flat(&chunks, |chunk| &chunk.distances)));
    Ok((PyArray1::from_vec(py, numbers), PyArray1::from_vec(py, distances)))
}
