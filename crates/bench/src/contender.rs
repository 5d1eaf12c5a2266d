//! Whoever takes part in a measurement, behind one face.

use std::fmt;

use grid_pathfinding::PathingGrid;
use grid_util::point::Point;
use mediant_grid::{Centers, Corners, Lattice, Rules};
use mediant_moves::KError;
use mediant_search::{AStar, LatticeDistance, Outcome, Planner, Query, QueryError};

use crate::{
    Engine, Problem, Task, Yardstick,
    yardstick::{BoolMap, Length, pathing_grid, solve_on},
};

/// Whoever takes part in a measurement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Contender {
    /// One of our engines.
    Task(Task),
    /// Another crate.
    Yardstick(Yardstick),
}

impl fmt::Display for Contender {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Task(task) => task.fmt(f),
            Self::Yardstick(yardstick) => f.pad(yardstick.name()),
        }
    }
}

/// What a contender makes of a map beforehand.
pub(crate) enum Prepared {
    Centers(Engine, Lattice<Centers>),
    Corners(Engine, Lattice<Corners>),
    Bools(BoolMap),
    Pathing(Box<PathingGrid>),
}

impl Prepared {
    pub(crate) fn new(contender: Contender, problem: &Problem) -> Result<Self, KError> {
        let grid = &problem.grid;
        Ok(match contender {
            Contender::Task(Task { engine, k, rules: Rules::Center(rule) }) => {
                Self::Centers(engine, Lattice::new(grid.clone(), k, rule)?)
            }
            Contender::Task(Task { engine, k, rules: Rules::Corner(gap) }) => {
                Self::Corners(engine, Lattice::new(grid.clone(), k, gap)?)
            }
            Contender::Yardstick(Yardstick::Pathfinding) => Self::Bools(BoolMap::new(grid)),
            Contender::Yardstick(Yardstick::GridPathfinding) => Self::Pathing(Box::new(pathing_grid(grid))),
        })
    }

    /// What answers queries. A yardstick keeps no scratch memory here: it takes it anew for each query, or hides it.
    pub(crate) fn runner(&self) -> Runner<'_> {
        match self {
            Self::Centers(Engine::AStar, lattice) => {
                Runner::AStarCenters(AStar::new(lattice, LatticeDistance))
            }
            Self::Corners(Engine::AStar, lattice) => {
                Runner::AStarCorners(AStar::new(lattice, LatticeDistance))
            }
            Self::Bools(map) => Runner::Bools(map),
            Self::Pathing(pathing) => Runner::Pathing(pathing),
        }
    }
}

/// Answers queries.
pub(crate) enum Runner<'p> {
    AStarCenters(AStar<&'p Lattice<Centers>, LatticeDistance>),
    AStarCorners(AStar<&'p Lattice<Corners>, LatticeDistance>),
    Bools(&'p BoolMap),
    Pathing(&'p PathingGrid),
}

/// An answer as its contender gives it.
pub(crate) enum Answer {
    Outcome(Outcome),
    Cells(Option<(Vec<(u16, u16)>, Length)>),
    Points(Option<Vec<Point>>),
}

impl Runner<'_> {
    pub(crate) fn solve(&mut self, query: Query) -> Result<Answer, QueryError> {
        Ok(match self {
            Self::AStarCenters(planner) => Answer::Outcome(planner.solve(query)?),
            Self::AStarCorners(planner) => Answer::Outcome(planner.solve(query)?),
            Self::Bools(map) => Answer::Cells(map.solve(query)),
            Self::Pathing(pathing) => Answer::Points(solve_on(pathing, query)),
        })
    }
}

impl Answer {
    /// The path's length in cells; `None` where there is no path.
    pub(crate) fn cost(&self) -> Option<f64> {
        match self {
            Self::Outcome(outcome) => outcome.path().map(mediant_search::Path::cost),
            Self::Cells(path) => path.as_ref().map(|(_, length)| length.0),
            Self::Points(path) => path.as_ref().map(|points| {
                let step =
                    |ends: &[Point]| f64::from(ends[0].x - ends[1].x).hypot(f64::from(ends[0].y - ends[1].y));
                points.windows(2).map(step).sum()
            }),
        }
    }
}
