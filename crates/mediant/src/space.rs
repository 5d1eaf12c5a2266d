//! Search spaces: what the planners of one k and one rule of motion share.

use std::sync::Arc;

use mediant_grid::{Centers, Corners, FreeSpace, Grid, GridGraph, Rules, Vertex};
use mediant_moves::K;

use crate::{error::EngineError, setup::Setup};

/// What the planners of one k and one rule of motion share: the grid graph of N(k), or at k = ∞ the free
/// space. Immutable; clones share it.
#[derive(Clone, Debug)]
pub enum Space {
    /// N(k) on the centers of cells.
    Centers(Arc<GridGraph<Centers>>),
    /// N(k) on the corners of cells.
    Corners(Arc<GridGraph<Corners>>),
    /// Every direction, on the corners of cells.
    AnyAngle(Arc<FreeSpace<Corners>>),
}

/// The error for a search space that an engine does not search. [`Setup::check`] refuses such setups, so
/// nobody sees it.
pub(crate) fn no_space(setup: Setup) -> EngineError {
    let capabilities = setup.capabilities();
    let k = capabilities.default_k();
    let expected = (k, capabilities.default_rules(k));
    EngineError::Space { expected, found: (setup.k, setup.rules) }
}

impl Space {
    /// The search space of a map for the k and the rules of a setup.
    ///
    /// # Errors
    /// [`EngineError::Setup`] for a setup whose parts do not fit together.
    pub fn new(setup: Setup, grid: &Arc<Grid>) -> Result<Self, EngineError> {
        setup.check()?;
        let grid = Arc::clone(grid);
        Ok(match (setup.k, setup.rules) {
            (K::Finite(k), Rules::Center(rule)) => Self::Centers(Arc::new(GridGraph::new(grid, k, rule)?)),
            (K::Finite(k), Rules::Corner(gap)) => Self::Corners(Arc::new(GridGraph::new(grid, k, gap)?)),
            (K::Any, Rules::Corner(gap)) => Self::AnyAngle(Arc::new(FreeSpace::new(grid, gap))),
            (K::Any, Rules::Center(_)) => return Err(no_space(setup)),
        })
    }

    /// The k of its moves.
    #[must_use]
    pub fn k(&self) -> K {
        match self {
            Self::Centers(graph) => graph.k().into(),
            Self::Corners(graph) => graph.k().into(),
            Self::AnyAngle(_) => K::Any,
        }
    }

    /// The placement and its rule of motion.
    #[must_use]
    pub fn rules(&self) -> Rules {
        match self {
            Self::Centers(graph) => graph.rules(),
            Self::Corners(graph) => graph.rules(),
            Self::AnyAngle(space) => space.rules(),
        }
    }

    /// The map.
    #[must_use]
    pub fn grid(&self) -> &Arc<Grid> {
        match self {
            Self::Centers(graph) => graph.grid(),
            Self::Corners(graph) => graph.grid(),
            Self::AnyAngle(space) => space.grid(),
        }
    }

    /// The memory that it uses beyond the map, in bytes.
    #[must_use]
    pub fn memory_bytes(&self) -> u64 {
        let bytes = match self {
            Self::Centers(graph) => graph.memory_bytes(),
            Self::Corners(graph) => graph.memory_bytes(),
            Self::AnyAngle(space) => space.memory_bytes(),
        };
        bytes as u64
    }

    /// Whether there is a path from one vertex to another.
    #[must_use]
    pub fn connected(&self, from: Vertex, to: Vertex) -> bool {
        match self {
            Self::Centers(graph) => graph.connected(from, to),
            Self::Corners(graph) => graph.connected(from, to),
            Self::AnyAngle(space) => space.connected(from, to),
        }
    }

    /// Checks that the setup's parts fit together, and that this is its search space.
    pub(crate) fn check(&self, setup: Setup) -> Result<(), EngineError> {
        setup.check()?;
        let (expected, found) = ((setup.k, setup.rules), (self.k(), self.rules()));
        if expected == found { Ok(()) } else { Err(EngineError::Space { expected, found }) }
    }
}
