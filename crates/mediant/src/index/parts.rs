//! The parts of an index: what each engine searches, and what it prepares for that.

use std::{num::NonZeroU32, sync::Arc};

use mediant_grid::{Centers, Corners, FreeSpace, GridGraph, Interrupt, Interrupted};
use mediant_hierarchy::{ClusterGraph, Clustering, SegmentGraph};
use mediant_search::{DeadEnds, JumpTable, Pruning, parts::BlockFinder};
use mediant_subgoal::{HubLabels, SubgoalGraph, SubgoalPlacement};

use super::shape;
use crate::{
    configured::{ConfiguredEngine, SubgoalOptions},
    error::Error,
    option::{
        Levels, Memory, OptionValue,
        description::{LEVELS, SIDE},
    },
    setup::Setup,
    setup_error::SetupError,
};

/// The search space of an engine, with the parts prepared on it.
#[derive(Clone, Debug)]
pub(crate) enum Prepared {
    /// N(k) on the centers of cells.
    Centers(Arc<GridGraph<Centers>>, OnGridGraph<Centers>),
    /// N(k) on the corners of cells.
    Corners(Arc<GridGraph<Corners>>, OnGridGraph<Corners>),
    /// The free space between the centers of cells.
    FreeCenters(Arc<FreeSpace<Centers>>, InFreeSpace<Centers>),
    /// The free space between the corners of cells.
    FreeCorners(Arc<FreeSpace<Corners>>, InFreeSpace<Corners>),
}

/// The parts that an engine prepares on a grid graph.
#[derive(Clone, Debug)]
pub(crate) enum OnGridGraph<P: SubgoalPlacement> {
    /// Nothing: the engine searches the graph as it is.
    Nothing,
    /// The pruning rule of canonical search.
    Pruning(Arc<Pruning<P>>),
    /// A pruning rule, and the map in words for jumps by blocks.
    Blocks(Arc<Pruning<P>>, BlockFinder),
    /// A pruning rule, and the jump points in lists.
    Table(Arc<Pruning<P>>, Arc<JumpTable>),
    /// Clusters; only at centers.
    Clusters(Arc<ClusterGraph>),
    /// Segments; only at centers.
    Segments(Arc<SegmentGraph>),
}

/// The parts that an engine prepares in a free space.
#[derive(Clone, Debug)]
pub(crate) enum InFreeSpace<P: SubgoalPlacement> {
    /// Nothing: the engine searches the space as it is.
    Nothing,
    /// The dead ends, which the engine leaves out; only at corners.
    DeadEnds(Arc<DeadEnds>),
    /// A subgoal graph.
    Subgoals(Arc<SubgoalGraph<P>>),
    /// Hub labels.
    Labels(Arc<HubLabels<P>>),
}

impl Prepared {
    /// Hub labels at corners: those for another k can share some of them.
    pub(super) fn labels(&self) -> Option<&HubLabels<Corners>> {
        match self {
            Self::FreeCorners(_, InFreeSpace::Labels(labels)) => Some(labels),
            _ => None,
        }
    }

    /// The bytes of a saved index; `None` where there is nothing to save.
    pub(super) fn to_bytes(&self, interrupt: &Interrupt) -> Result<Option<Vec<u8>>, Interrupted> {
        match self {
            Self::Centers(_, parts) => parts.to_bytes(interrupt),
            Self::Corners(_, parts) => parts.to_bytes(interrupt),
            Self::FreeCenters(_, parts) => parts.to_bytes(interrupt),
            Self::FreeCorners(_, parts) => parts.to_bytes(interrupt),
        }
    }

    /// The memory that is used beyond the space, in bytes.
    pub(super) fn memory_bytes(&self) -> usize {
        match self {
            Self::Centers(_, parts) => parts.memory_bytes(),
            Self::Corners(_, parts) => parts.memory_bytes(),
            Self::FreeCenters(_, parts) => parts.memory_bytes(),
            Self::FreeCorners(_, parts) => parts.memory_bytes(),
        }
    }

    /// The levels, and the side of the lowest clusters or of the segments in cells, of an index that has
    /// them.
    pub(super) fn shape(&self) -> (Option<Levels>, Option<u32>) {
        match self {
            Self::Centers(_, OnGridGraph::Clusters(graph)) => {
                let Clustering { side, levels } = graph.clustering();
                (NonZeroU32::new(levels).map(Levels::Number), Some(side))
            }
            Self::Centers(_, OnGridGraph::Segments(graph)) => (None, Some(graph.side())),
            Self::FreeCenters(_, parts) => (parts.levels(), None),
            Self::FreeCorners(_, parts) => (parts.levels(), None),
            _ => (None, None),
        }
    }

    /// The dead ends of the map.
    pub(super) const fn dead_ends(&self) -> Option<&Arc<DeadEnds>> {
        match self {
            Self::FreeCorners(_, InFreeSpace::DeadEnds(dead_ends)) => Some(dead_ends),
            _ => None,
        }
    }

    /// Whether it is that of Anya for a single path.
    pub(super) const fn is_for_one_path(&self) -> bool {
        matches!(self, Self::FreeCorners(_, InFreeSpace::Nothing))
    }

    /// Whether it has hub labels.
    pub(crate) const fn has_labels(&self) -> bool {
        matches!(
            self,
            Self::FreeCenters(_, InFreeSpace::Labels(_)) | Self::FreeCorners(_, InFreeSpace::Labels(_))
        )
    }

    /// The memory that its hub labels take, and that which they may take if the user names none.
    fn memory_of_labels(&self) -> Option<(Memory, Memory)> {
        let (grid, bytes) = match self {
            Self::FreeCenters(space, InFreeSpace::Labels(labels)) => (space.grid(), labels.memory_bytes()),
            Self::FreeCorners(space, InFreeSpace::Labels(labels)) => (space.grid(), labels.memory_bytes()),
            _ => return None,
        };
        Some((Memory::new(bytes as u64)?, Memory::for_labels_of(grid.width(), grid.height())))
    }

    /// Checks that it has the levels and the side that an engine's options name, and that its labels take no
    /// more memory than they may.
    pub(super) fn check_shape(&self, engine: ConfiguredEngine) -> Result<(), Error> {
        let (levels, side) = self.shape();
        if let ConfiguredEngine::Subgoal(SubgoalOptions { memory: Some(most), .. }) = engine
            && let Some((found, _)) = self.memory_of_labels().filter(|&(found, _)| found > most)
        {
            return Err(Error::Memory { most, found });
        }
        shape::check(engine, levels, side)
    }

    /// The engine with the levels and the side that are prepared, named or not. Of hub labels the memory is
    /// named instead, if they take more than by default: on another map there may be none.
    pub(super) fn with_shape(&self, mut engine: ConfiguredEngine) -> Result<ConfiguredEngine, SetupError> {
        let (levels, side) = self.shape();
        if let Some(levels) = levels.filter(|&levels| levels != Levels::Labels) {
            engine.set(&LEVELS, OptionValue::Levels(levels))?;
            if let ConfiguredEngine::Subgoal(own) = &mut engine {
                own.memory = None;
            }
        }
        if let (ConfiguredEngine::Subgoal(own), Some((bytes, default))) =
            (&mut engine, self.memory_of_labels())
            && own.levels.is_none()
            && bytes > default
        {
            own.memory = own.memory.or(Some(bytes));
        }
        if let Some(side) = side.and_then(NonZeroU32::new) {
            engine.set(&SIDE, OptionValue::Number(side))?;
        }
        Ok(engine)
    }

    /// Checks that what was prepared for one setup serves another one on the same space.
    pub(super) fn check(&self, setup: Setup, made_for: Setup) -> Result<(), Error> {
        let (engine, known) = (setup.engine.kind(), made_for.engine.kind());
        if engine != known {
            return Err(SetupError::OtherEngine { engine, known }.into());
        }
        self.check_shape(setup.engine)?;
        // Canonical A* as published has no pruning rule; the variants of CHPA* search the same segments.
        let is_canonical = matches!(self, Self::Centers(_, OnGridGraph::Pruning(_) | OnGridGraph::Nothing))
            || matches!(self, Self::Corners(_, OnGridGraph::Pruning(_) | OnGridGraph::Nothing));
        if is_canonical && setup.engine.variant() != made_for.engine.variant() {
            return Err(SetupError::OtherVariant { engine }.into());
        }
        Ok(())
    }
}

impl<P: SubgoalPlacement> InFreeSpace<P> {
    fn to_bytes(&self, interrupt: &Interrupt) -> Result<Option<Vec<u8>>, Interrupted> {
        Ok(match self {
            Self::Nothing | Self::DeadEnds(_) => None,
            Self::Subgoals(graph) => Some(graph.to_bytes_interruptible(interrupt)?),
            Self::Labels(labels) => Some(labels.to_bytes_interruptible(interrupt)?),
        })
    }

    fn memory_bytes(&self) -> usize {
        match self {
            Self::Nothing => 0,
            Self::DeadEnds(dead_ends) => dead_ends.memory_bytes(),
            Self::Subgoals(graph) => graph.memory_bytes(),
            Self::Labels(labels) => labels.memory_bytes(),
        }
    }

    fn levels(&self) -> Option<Levels> {
        match self {
            Self::Nothing | Self::DeadEnds(_) => None,
            Self::Subgoals(graph) => Some(graph.hierarchy().into()),
            Self::Labels(_) => Some(Levels::Labels),
        }
    }
}

impl<P: SubgoalPlacement> OnGridGraph<P> {
    fn to_bytes(&self, interrupt: &Interrupt) -> Result<Option<Vec<u8>>, Interrupted> {
        Ok(match self {
            Self::Nothing | Self::Pruning(_) | Self::Blocks(..) => None,
            Self::Table(_, table) => Some(table.to_bytes_interruptible(interrupt)?),
            Self::Clusters(graph) => Some(graph.to_bytes_interruptible(interrupt)?),
            // A byte a segment is copied as fast as memory.
            Self::Segments(graph) => Some(graph.to_bytes()),
        })
    }

    fn memory_bytes(&self) -> usize {
        match self {
            Self::Nothing => 0,
            Self::Pruning(pruning) => pruning.memory_bytes(),
            Self::Blocks(pruning, blocks) => pruning.memory_bytes() + blocks.memory_bytes(),
            Self::Table(pruning, table) => pruning.memory_bytes() + table.memory_bytes(),
            Self::Clusters(graph) => graph.memory_bytes(),
            Self::Segments(graph) => graph.memory_bytes(),
        }
    }
}
