//! Points, cells and rectangles, as C has them.

#![allow(unsafe_code, reason = "arrays of C")]

use library::{Path, Point as Inner, Rectangle, Vertex};

use crate::{failure::Failure, memory};

/// A point: x to the right, y down, in cells. At centers (0, 0) is the middle of the first cell, at corners
/// its top left corner. Numbers are rounded to 1/1024; between vertices ends are for any angle alone.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// To the right.
    pub x: f64,
    /// Down.
    pub y: f64,
}

/// A start and a goal.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ends {
    /// The start.
    pub start: Point,
    /// The goal.
    pub goal: Point,
}

/// A cell, or a vertex: column and row.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cell {
    /// The column, from the left.
    pub x: i32,
    /// The row, from the top.
    pub y: i32,
}

/// A rectangle of cells.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Area {
    /// The first column.
    pub x: u32,
    /// The first row.
    pub y: u32,
    /// The number of columns.
    pub width: u32,
    /// The number of rows.
    pub height: u32,
}

impl Point {
    /// The library's point; `name` is that of the argument.
    #[inline]
    pub(crate) fn inner(self, name: &str) -> Result<Inner, Failure> {
        Inner::nearest(self.x, self.y).ok_or_else(|| far_outside(name))
    }
}

#[cold]
fn far_outside(name: &str) -> Failure {
    use crate::code::Code;
    let code = match name {
        "start" | "starts" | "sources" => Code::StartOutside,
        "goal" | "goals" => Code::GoalOutside,
        _ => Code::Argument,
    };
    Failure { code, text: format!("{name}: an x or y that is no number, or beyond that of any map") }
}

impl From<Inner> for Point {
    #[inline]
    fn from(at: Inner) -> Self {
        Self { x: at.x(), y: at.y() }
    }
}

impl From<Cell> for Vertex {
    fn from(Cell { x, y }: Cell) -> Self {
        Self::new(x, y)
    }
}

impl From<Vertex> for Cell {
    fn from(Vertex { x, y }: Vertex) -> Self {
        Self { x, y }
    }
}

impl From<Area> for Rectangle {
    fn from(Area { x, y, width, height }: Area) -> Self {
        Self::new(x, y, width, height)
    }
}

/// The points of an array.
///
/// # Safety
/// As for [`memory::array`].
pub(crate) unsafe fn read(name: &str, points: *const Point, count: usize) -> Result<Vec<Inner>, Failure> {
    // SAFETY: the caller promises it.
    let points = unsafe { memory::array(name, points, count) }?;
    let mut read = Vec::with_capacity(points.len());
    for at in points {
        read.push(at.inner(name)?);
    }
    Ok(read)
}

/// The path through the points of an array.
///
/// # Safety
/// As for [`memory::array`].
pub(crate) unsafe fn path(points: *const Point, count: usize) -> Result<Path, Failure> {
    // SAFETY: the caller promises it.
    Ok(Path::through(unsafe { read("points", points, count) }?))
}
