//! The baselines: two crates that everyone can run. They ran on the machine of the reference timings too, so
//! that their times tell how much slower or faster this machine is.

use std::{cmp::Ordering, ops::Add};

use grid_pathfinding::PathingGrid;
use grid_util::{grid::ValueGrid, point::Point};
use mediant_grid::{Grid, Vertex};
use mediant_search::Ends;
use pathfinding::{num_traits::Zero, prelude::astar};

/// A crate that was timed together with the programs of the reference timings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Baseline {
    /// `pathfinding::astar` on nodes `(u16, u16)`, with costs in `f64` and the octile heuristic. It solves k
    /// = 3 at centers under `Never`: no corner is cut.
    Pathfinding,
    /// `grid_pathfinding::PathingGrid::get_path_single_goal`. It cuts corners: only its time is compared, not
    /// its paths.
    GridPathfinding,
}

impl Baseline {
    /// Both, in the order of the reference timings.
    pub const ALL: [Self; 2] = [Self::Pathfinding, Self::GridPathfinding];

    /// The crate's name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Pathfinding => "pathfinding",
            Self::GridPathfinding => "grid_pathfinding",
        }
    }
}

/// The length of a path, finite, with the total order that `pathfinding` asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Length(pub(crate) f64);

impl Eq for Length {}

impl PartialOrd for Length {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Length {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0)
    }
}

impl Add for Length {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl Zero for Length {
    fn zero() -> Self {
        Self(0.0)
    }

    fn is_zero(&self) -> bool {
        self.0 == 0.0
    }
}

/// A map as a plain array, one `bool` for each cell.
pub(crate) struct BoolMap {
    width: i32,
    height: i32,
    blocked: Vec<bool>,
}

type Cell = (u16, u16);

impl BoolMap {
    pub(crate) fn new(grid: &Grid) -> Self {
        let (width, height) = (grid.width() as i32, grid.height() as i32);
        let cells = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        Self { width, height, blocked: cells.map(|(x, y)| grid.is_blocked(x, y)).collect() }
    }

    /// Blocks or frees a cell of the map.
    pub(crate) fn set(&mut self, at: Vertex, blocked: bool) {
        self.blocked[(at.y * self.width + at.x) as usize] = blocked;
    }

    fn is_free(&self, x: i32, y: i32) -> bool {
        let inside = (0..self.width).contains(&x) && (0..self.height).contains(&y);
        inside && !self.blocked[(y * self.width + x) as usize]
    }

    /// The successors of a cell and the lengths of the steps to them. A diagonal step needs both cells beside
    /// it free.
    fn successors(&self, (x, y): Cell) -> Vec<(Cell, Length)> {
        let (x, y) = (i32::from(x), i32::from(y));
        let mut found = Vec::with_capacity(8);
        for (dx, dy) in (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy))) {
            let diagonal = dx != 0 && dy != 0;
            let cut = diagonal && !(self.is_free(x + dx, y) && self.is_free(x, y + dy));
            if (dx, dy) != (0, 0) && !cut && self.is_free(x + dx, y + dy) {
                let length = if diagonal { std::f64::consts::SQRT_2 } else { 1.0 };
                found.push((((x + dx) as u16, (y + dy) as u16), Length(length)));
            }
        }
        found
    }

    /// A shortest path cell by cell, and its length. Start and goal must be on the map.
    pub(crate) fn solve(&self, query: Ends) -> Option<(Vec<Cell>, Length)> {
        let cell = |at: Vertex| (at.x as u16, at.y as u16);
        let goal = cell(query.goal);
        let octile = |&(x, y): &Cell| {
            let (dx, dy) = (f64::from(x.abs_diff(goal.0)), f64::from(y.abs_diff(goal.1)));
            Length(dx.max(dy) + (std::f64::consts::SQRT_2 - 1.0) * dx.min(dy))
        };
        astar(&cell(query.start), |&cell| self.successors(cell), octile, |cell| *cell == goal)
    }
}

/// A map as `grid_pathfinding` takes it.
pub(crate) fn pathing_grid(grid: &Grid) -> PathingGrid {
    let mut pathing = PathingGrid::new(grid.width() as usize, grid.height() as usize, false);
    for y in 0..grid.height() as i32 {
        for x in 0..grid.width() as i32 {
            if grid.is_blocked(x, y) {
                pathing.set(x, y, true);
            }
        }
    }
    pathing.generate_components();
    pathing
}

/// Blocks or frees a cell, with the update of components that `grid_pathfinding` asks for.
pub(crate) fn set_cell(pathing: &mut PathingGrid, at: Vertex, blocked: bool) {
    pathing.set(at.x, at.y, blocked);
    pathing.update();
}

/// A path of `grid_pathfinding`, cell by cell.
pub(crate) fn solve_on(pathing: &PathingGrid, query: Ends) -> Option<Vec<Point>> {
    let point = |at: Vertex| Point::new(at.x, at.y);
    pathing.get_path_single_goal(point(query.start), point(query.goal), false)
}
