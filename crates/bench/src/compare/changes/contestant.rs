//! Engines and other crates that follow a map.

use grid_pathfinding::PathingGrid;
use mediant::{Change, Engine, Error, Index, Map, Planner, Setup, Space};
use mediant_grid::Vertex;
use mediant_search::Ends;

use crate::{
    Baseline,
    baseline::{BoolMap, pathing_grid, set_cell, solve_on},
};

/// An engine with all that it prepared, which follows the map.
pub(super) struct Follower {
    pub(super) space: Space,
    pub(super) index: Index,
    pub(super) planner: Planner,
}

impl Follower {
    pub(super) fn new(map: &Map, setup: Setup) -> Result<Self, Error> {
        let space = setup.space(map)?;
        let index = setup.prepare(&space)?;
        let planner = index.planner();
        Ok(Self { space, index, planner })
    }

    /// Goes on with the map after a change. The version before is given up when the change is dropped.
    pub(super) fn follow(&mut self, change: &Change) -> Result<(), Error> {
        self.index = self.index.repair(change)?;
        self.planner.follow(&self.index)?;
        self.space = change.after().clone();
        Ok(())
    }

    pub(super) fn set(&mut self, at: Vertex, blocked: bool) -> Result<(), Error> {
        let change = self.space.edit_cells([(at, blocked)])?;
        self.follow(&change)
    }

    /// Goes to an index of another map.
    pub(super) fn go_to(&mut self, index: &Index) -> Result<(), Error> {
        self.index = index.clone();
        self.space = index.space().clone();
        self.planner.follow(index)
    }
}

/// An engine or another crate, with the map as it has it.
pub(super) enum Contestant {
    Engine(Box<Follower>),
    Pathfinding(BoolMap),
    GridPathfinding(Box<PathingGrid>),
}

impl Contestant {
    pub(super) fn baseline(map: &Map, baseline: Baseline) -> Self {
        match baseline {
            Baseline::Pathfinding => Self::Pathfinding(BoolMap::new(map.grid())),
            Baseline::GridPathfinding => Self::GridPathfinding(Box::new(pathing_grid(map.grid()))),
        }
    }

    pub(super) fn set(&mut self, at: Vertex, blocked: bool) -> Result<(), Error> {
        match self {
            Self::Engine(engine) => engine.set(at, blocked)?,
            Self::Pathfinding(map) => map.set(at, blocked),
            Self::GridPathfinding(map) => set_cell(map, at, blocked),
        }
        Ok(())
    }

    /// The length of the path; `None` where there is none, or where it solves another problem.
    pub(super) fn solve(&mut self, ends: Ends) -> Result<Option<f64>, Error> {
        Ok(match self {
            Self::Engine(engine) => engine.planner.path(ends.start, ends.goal)?.map(|path| path.cost()),
            Self::Pathfinding(map) => map.solve(ends).map(|(_, length)| length.0),
            Self::GridPathfinding(map) => {
                std::hint::black_box(solve_on(map, ends));
                None
            }
        })
    }

    /// Whether labels of an earlier map have proven the last answer; `None` where it has none.
    pub(super) fn is_proven(&self) -> Option<bool> {
        match self {
            Self::Engine(engine) if !engine.index.is_finished() => {
                Some(engine.planner.searched_by() == Engine::Subgoal)
            }
            _ => None,
        }
    }
}
