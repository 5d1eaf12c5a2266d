//! Errors of cost surfaces.

use mediant_grid::{Interrupted, Mismatch, Rules};
use mediant_moves::FiniteK;
use mediant_search::QueryError;

/// The reason why there is no cost surface of some numbers, or no search graph of it.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CostsError {
    /// A side is 0 or longer than 2²⁰ cells, or there are more than 2³² − 2²⁴ cells.
    #[error(
        "a cost surface of {width} columns and {height} rows: each side must have 1 to 1,048,576 cells, and both \
         together about 4.2 billion at most, a frame included"
    )]
    Size {
        /// The number of columns.
        width: u64,
        /// The number of rows.
        height: u64,
    },
    /// Rules under which no move over N(k) is one.
    #[error("no path over N(k) has {rules}: choose a corner rule between centers, or placement corner")]
    Rules {
        /// The rules.
        rules: Rules,
    },
    /// Another number of costs than cells.
    #[error("there are {found} costs for {expected} cells: give one for each cell, row by row")]
    Count {
        /// The number of costs.
        found: usize,
        /// The number of cells.
        expected: u64,
    },
    /// A cost that is no number from 10⁻¹²⁰ to 10¹²⁰.
    #[error(
        "the cost of cell ({x}, {y}) is {cost}: it must be a positive number, from 1e-120 to 1e120; a cell \
         that cannot be entered is marked as blocked, not by its cost"
    )]
    Cost {
        /// The column.
        x: u32,
        /// The row.
        y: u32,
        /// The cost.
        cost: f64,
    },
    /// Costs between which the integers of paths do not fit.
    #[error(
        "costs from {least} to {greatest} on one map: at most 65,536 times as much is exact on every map; raise the \
         least cost, lower the greatest, or mark the dearest cells as blocked"
    )]
    Range {
        /// The least.
        least: f64,
        /// The greatest.
        greatest: f64,
    },
    /// The width or the height of a cell is no number from 10⁻¹²⁰ to 10¹²⁰, or one is more than 65,536
    /// times the other.
    #[error(
        "cells of {x} × {y}: width and height must be positive numbers, from 1e-120 to 1e120, and neither more than \
         65,536 times the other"
    )]
    CellSize {
        /// The width.
        x: f64,
        /// The height.
        y: f64,
    },
    /// A k above the greatest.
    #[error("k = {k} on a cost surface: choose k = 2 to {max}")]
    K {
        /// The k.
        k: FiniteK,
        /// The greatest.
        max: u32,
    },
    /// A cell outside the map.
    #[error("cell ({x}, {y}) is outside the map")]
    Outside {
        /// The column.
        x: u32,
        /// The row.
        y: u32,
    },
    /// A setting that is no number, or not one that it can have.
    #[error("`{name}` is {value}: it must be {expected}")]
    Setting {
        /// Its name.
        name: &'static str,
        /// The value.
        value: f64,
        /// The numbers that it can have.
        expected: &'static str,
    },
    /// Costs would not reach as far as the robot does.
    #[error(
        "`inflation_radius` is {inflation} and `inscribed_radius` {inscribed}: cells between them would seem free, and \
         a robot on them would touch an obstacle; choose an inflation radius of at least the inscribed one"
    )]
    SmallInflation {
        /// The inflation radius.
        inflation: f64,
        /// The inscribed radius.
        inscribed: f64,
    },
    /// A costmap with a side that is too long for its obstacles to be inflated.
    #[error(
        "a costmap of {width} × {height} cells: obstacles can be inflated up to {max} cells a side; split it"
    )]
    Inflated {
        /// The number of columns.
        width: u32,
        /// The number of rows.
        height: u32,
        /// The longest side.
        max: u32,
    },
    /// It was stopped before it was done.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
}

/// The reason why a field on a cost surface cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CostFieldError {
    /// A source is blocked or outside the map.
    #[error(transparent)]
    Query(#[from] QueryError),
    /// The limit is negative or not a number.
    #[error("the limit of a field is {limit}: choose a cost from 0 on, or infinity")]
    Limit {
        /// The limit.
        limit: f64,
    },
    /// Two fields that do not belong together.
    #[error(transparent)]
    Mismatch(#[from] Mismatch),
    /// It was stopped before it was done.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
}
