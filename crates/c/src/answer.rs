//! Answers, and the points of paths.

#![allow(unsafe_code, reason = "memory of C")]

use library::{Answer as Inner, Guarantee, Path, Rules};

use crate::{
    code::{PathLimit, PathStatus},
    failure::Failure,
    memory,
    points::Point,
};

/// The answer to a query.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// Whether there is a path.
    pub status: PathStatus,
    /// The limit that stopped the search, if its status is stopped.
    pub stopped_by: PathLimit,
    /// The number of the path's points; 0 without one.
    pub point_count: usize,
    /// The length of the path that was asked for, in cells, or its cost where cells have costs; infinity
    /// where there is none, NaN where the search was stopped.
    pub distance: f64,
    /// The length of the path that is told, in cells, whatever cells cost; 0 without one.
    pub length: f64,
    /// A lower bound on `distance`.
    pub lower_bound: f64,
    /// A lower bound on the length of all paths at any angle; NaN where there is none.
    pub any_angle_lower_bound: f64,
}

impl Answer {
    pub(crate) fn new(answer: &Inner, (guarantee, rules): (Guarantee, Rules)) -> Self {
        let path = told(answer);
        Self {
            status: answer.status().into(),
            stopped_by: answer.stopped_by().into(),
            point_count: path.map_or(0, Path::len),
            distance: answer.distance(guarantee),
            length: path.map_or(0.0, Path::length),
            lower_bound: answer.lower_bound(guarantee),
            any_angle_lower_bound: answer.any_angle_lower_bound(guarantee, rules).unwrap_or(f64::NAN),
        }
    }
}

/// The path of an answer; of a search that was stopped, the best one so far.
pub(crate) fn told(answer: &Inner) -> Option<&Path> {
    answer.path().or_else(|| answer.best())
}

/// Checks the places of a path before the work.
#[inline]
pub(crate) fn check_places(points: *mut Point, room: usize, count: *mut usize) -> Result<(), Failure> {
    memory::check_room("points", points, room)?;
    memory::check_place("count", count)
}

/// Writes the points of a path, as many as there is room for, and how many there are.
///
/// # Safety
/// As for [`memory::fill`] and [`memory::put`].
#[inline]
pub(crate) unsafe fn write(
    path: Option<&Path>,
    (points, room): (*mut Point, usize),
    count: *mut usize,
) -> Result<(), Failure> {
    // SAFETY: the caller promises it.
    unsafe {
        if let Some(path) = path {
            memory::fill("points", points, room, path.points().map(Point::from))?;
        }
        memory::put("count", count, path.map_or(0, Path::len))
    }
}
