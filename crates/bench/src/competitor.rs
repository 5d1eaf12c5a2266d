//! The competitors of a measurement, behind one interface.

use std::{fmt, sync::Arc, time::Instant};

use grid_pathfinding::PathingGrid;
use grid_util::point::Point;
use mediant::{Error, Map, Planner, Setup};
use mediant_grid::Grid;
use mediant_search::{Answer, Ends, QueryError};

use crate::{
    Baseline, Preparation, Problem,
    baseline::{BoolMap, Length, pathing_grid, solve_on},
    typed::{Typed, TypedEngine},
};

/// A competitor of a measurement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Competitor {
    /// One of our engines.
    Ours(Setup),
    /// One of our engines, which is asked for the length of the path alone. It shares the index of the same
    /// setup before it, if that is asked for paths.
    Distance(Setup),
    /// The same engine as a planner of the typed crates, without the library.
    Typed(TypedEngine),
    /// Another crate.
    Baseline(Baseline),
}

impl fmt::Display for Competitor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Ours(setup) => setup.fmt(f),
            Self::Distance(setup) => write!(f, "distance of {setup}"),
            Self::Typed(engine) => engine.fmt(f),
            Self::Baseline(baseline) => f.pad(baseline.name()),
        }
    }
}

/// A competitor made ready for the queries of one map. Only ours keep scratch memory: a baseline allocates it
/// for each query, or hides it.
pub(crate) enum Runner {
    Ours(Box<Planner>, Preparation),
    Distance(Box<Planner>, Preparation),
    Typed(Box<Typed>),
    Bools(BoolMap),
    Pathing(Box<PathingGrid>),
}

/// An answer as its competitor gives it.
pub(crate) enum CompetitorAnswer {
    Answer(Answer),
    Cells(Option<(Vec<(u16, u16)>, Length)>),
    Points(Option<Vec<Point>>),
    Length(Option<f64>),
}

/// A planner on an index of its own.
fn prepared(setup: Setup, grid: &Arc<Grid>) -> Result<(Box<Planner>, Preparation), Error> {
    let begin = Instant::now();
    let space = setup.space(&Map::from(Arc::clone(grid)))?;
    let index = setup.prepare(&space)?;
    let seconds = begin.elapsed().as_secs_f64();
    Ok((Box::new(index.planner()), Preparation::of(&space, &index, seconds)))
}

impl Runner {
    /// `others` are ready already: where one has the index that is needed, it is shared.
    pub(crate) fn new(competitor: Competitor, problem: &Problem, others: &[Self]) -> Result<Self, Error> {
        let grid = &problem.grid;
        Ok(match competitor {
            Competitor::Ours(setup) => {
                let (planner, preparation) = prepared(setup, grid)?;
                Self::Ours(planner, preparation)
            }
            Competitor::Distance(setup) => {
                let shared = |other: &Self| match other {
                    Self::Ours(planner, preparation) if planner.index().setup() == setup => {
                        Some((Box::new(planner.index().planner()), *preparation))
                    }
                    _ => None,
                };
                let (planner, preparation) =
                    others.iter().find_map(shared).map_or_else(|| prepared(setup, grid), Ok)?;
                Self::Distance(planner, preparation)
            }
            Competitor::Typed(engine) => Self::Typed(Box::new(engine.planner(grid)?)),
            Competitor::Baseline(Baseline::Pathfinding) => Self::Bools(BoolMap::new(grid)),
            Competitor::Baseline(Baseline::GridPathfinding) => Self::Pathing(Box::new(pathing_grid(grid))),
        })
    }

    /// The preparation before the first query; `None` for a baseline.
    pub(crate) fn preparation(&self) -> Option<Preparation> {
        match self {
            Self::Ours(_, preparation) | Self::Distance(_, preparation) => Some(*preparation),
            Self::Typed(_) | Self::Bools(_) | Self::Pathing(_) => None,
        }
    }

    pub(crate) fn solve(&mut self, query: Ends) -> Result<CompetitorAnswer, QueryError> {
        Ok(match self {
            Self::Ours(planner, _) => CompetitorAnswer::Answer(planner.find(query)?),
            Self::Distance(planner, _) => CompetitorAnswer::Length(planner.distance(query)?),
            Self::Typed(planner) => CompetitorAnswer::Answer(planner.solve(query)?),
            Self::Bools(map) => CompetitorAnswer::Cells(map.solve(query)),
            Self::Pathing(pathing) => CompetitorAnswer::Points(solve_on(pathing, query)),
        })
    }
}

impl CompetitorAnswer {
    /// The path's length in cells; `None` where there is no path.
    pub(crate) fn cost(&self) -> Option<f64> {
        match self {
            Self::Answer(answer) => answer.path().map(mediant_search::Path::cost),
            Self::Length(length) => *length,
            Self::Cells(path) => path.as_ref().map(|(_, length)| length.0),
            Self::Points(path) => path.as_ref().map(|points| {
                let step =
                    |ends: &[Point]| f64::from(ends[0].x - ends[1].x).hypot(f64::from(ends[0].y - ends[1].y));
                points.windows(2).map(step).sum()
            }),
        }
    }
}
