//! What several planners share.

use std::sync::Arc;

use mediant_grid::{Centers, Corners, Grid, Lattice, Rules, Terrain, Vertex};
use mediant_moves::Knob;

use crate::{EngineError, Setup};

/// What the planners for one k and one rule of motion share: the search graph of N(k), or for every direction the terrain alone.
#[derive(Clone, Debug)]
pub enum Ground {
    /// N(k) between centers.
    Centers(Arc<Lattice<Centers>>),
    /// N(k) between corners.
    Corners(Arc<Lattice<Corners>>),
    /// Every direction between corners.
    AnyAngle(Arc<Terrain<Corners>>),
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
            (Knob::K(k), Rules::Center(rule)) => Self::Centers(Arc::new(Lattice::new(grid, k, rule)?)),
            (Knob::K(k), Rules::Corner(gap)) => Self::Corners(Arc::new(Lattice::new(grid, k, gap)?)),
            (Knob::Any, Rules::Corner(gap)) => Self::AnyAngle(Arc::new(Terrain::new(grid, gap))),
            (Knob::Any, Rules::Center(_)) => return Err(no_ground(setup)),
        })
    }

    /// The directions.
    #[must_use]
    pub fn k(&self) -> Knob {
        match self {
            Self::Centers(lattice) => lattice.k().into(),
            Self::Corners(lattice) => lattice.k().into(),
            Self::AnyAngle(_) => Knob::Any,
        }
    }

    /// Placement and rule of motion.
    #[must_use]
    pub fn rules(&self) -> Rules {
        match self {
            Self::Centers(lattice) => lattice.rules(),
            Self::Corners(lattice) => lattice.rules(),
            Self::AnyAngle(terrain) => terrain.rules(),
        }
    }

    /// The memory that it takes beyond the map, in bytes.
    #[must_use]
    pub fn index_bytes(&self) -> u64 {
        let bytes = match self {
            Self::Centers(lattice) => lattice.index_bytes(),
            Self::Corners(lattice) => lattice.index_bytes(),
            Self::AnyAngle(terrain) => terrain.index_bytes(),
        };
        bytes as u64
    }

    /// Whether a path leads from one vertex to another.
    #[must_use]
    pub fn connected(&self, from: Vertex, to: Vertex) -> bool {
        match self {
            Self::Centers(lattice) => lattice.connected(from, to),
            Self::Corners(lattice) => lattice.connected(from, to),
            Self::AnyAngle(terrain) => terrain.connected(from, to),
        }
    }
}
