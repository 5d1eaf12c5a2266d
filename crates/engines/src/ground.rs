//! What several planners share.

use std::sync::Arc;

use mediant_grid::{Centers, Corners, FreeSpace, Grid, GridGraph, Rules, Vertex};
use mediant_moves::K;

use crate::{EngineError, Setup};

/// What the planners for one k and one rule of motion share: the search graph of N(k), or for every direction the free space alone.
#[derive(Clone, Debug)]
pub enum Ground {
    /// N(k) between centers.
    Centers(Arc<GridGraph<Centers>>),
    /// N(k) between corners.
    Corners(Arc<GridGraph<Corners>>),
    /// Every direction between corners.
    AnyAngle(Arc<FreeSpace<Corners>>),
}

/// What a setup that [`Setup::check`] refuses is told where there is nothing to search for it.
pub(crate) fn no_ground(setup: Setup) -> EngineError {
    let about = setup.engine.about();
    let k = about.default_k();
    let expected = (k, about.default_rules(k));
    EngineError::Ground { expected, found: (setup.k, setup.rules) }
}

impl Ground {
    /// That of a setup's k and rules.
    ///
    /// # Errors
    /// [`EngineError`] for a setup that does not exist.
    pub fn new(setup: Setup, grid: &Arc<Grid>) -> Result<Self, EngineError> {
        setup.check()?;
        let grid = Arc::clone(grid);
        Ok(match (setup.k, setup.rules) {
            (K::Finite(k), Rules::Center(rule)) => Self::Centers(Arc::new(GridGraph::new(grid, k, rule)?)),
            (K::Finite(k), Rules::Corner(gap)) => Self::Corners(Arc::new(GridGraph::new(grid, k, gap)?)),
            (K::Any, Rules::Corner(gap)) => Self::AnyAngle(Arc::new(FreeSpace::new(grid, gap))),
            (K::Any, Rules::Center(_)) => return Err(no_ground(setup)),
        })
    }

    /// The directions.
    #[must_use]
    pub fn k(&self) -> K {
        match self {
            Self::Centers(grid_graph) => grid_graph.k().into(),
            Self::Corners(grid_graph) => grid_graph.k().into(),
            Self::AnyAngle(_) => K::Any,
        }
    }

    /// PlacementKind and rule of motion.
    #[must_use]
    pub fn rules(&self) -> Rules {
        match self {
            Self::Centers(grid_graph) => grid_graph.rules(),
            Self::Corners(grid_graph) => grid_graph.rules(),
            Self::AnyAngle(space) => space.rules(),
        }
    }

    /// The memory that it takes beyond the map, in bytes.
    #[must_use]
    pub fn memory_bytes(&self) -> u64 {
        let bytes = match self {
            Self::Centers(grid_graph) => grid_graph.memory_bytes(),
            Self::Corners(grid_graph) => grid_graph.memory_bytes(),
            Self::AnyAngle(space) => space.memory_bytes(),
        };
        bytes as u64
    }

    /// Whether a path leads from one vertex to another.
    #[must_use]
    pub fn connected(&self, from: Vertex, to: Vertex) -> bool {
        match self {
            Self::Centers(grid_graph) => grid_graph.connected(from, to),
            Self::Corners(grid_graph) => grid_graph.connected(from, to),
            Self::AnyAngle(space) => space.connected(from, to),
        }
    }
}
