//! The parts of an index: what each engine prepares in each kind of search space.

use std::{num::NonZeroU32, sync::Arc};

use mediant_grid::{Centers, Corners, FreeSpace, GridGraph};
use mediant_hierarchy::{ClusterGraph, Clustering, SegmentGraph};
use mediant_search::{JumpTable, Pruning, parts::BlockFinder};
use mediant_subgoal::{SubgoalGraph, SubgoalPlacement};

use crate::option::Levels;

/// A search space with what is prepared in it.
#[derive(Clone, Debug)]
pub(crate) enum Prepared {
    /// N(k) on the centers of cells.
    Centers(Arc<GridGraph<Centers>>, Parts<Centers>),
    /// N(k) on the corners of cells.
    Corners(Arc<GridGraph<Corners>>, Parts<Corners>),
    /// Every direction, on the corners of cells.
    AnyAngle(Arc<FreeSpace<Corners>>, Parts<Corners>),
}

/// What an engine prepares.
#[derive(Clone, Debug)]
pub(crate) enum Parts<P: SubgoalPlacement> {
    /// Nothing: the engine searches the space as it is.
    Nothing,
    /// The pruning rule of canonical search.
    Pruning(Arc<Pruning<P>>),
    /// A pruning rule, and the map in words for jumps by blocks.
    Blocks(Arc<Pruning<P>>, BlockFinder),
    /// A pruning rule, and the length of every jump.
    Table(Arc<Pruning<P>>, Arc<JumpTable>),
    /// A subgoal graph.
    Subgoals(Arc<SubgoalGraph<P>>),
    /// Clusters; only at centers.
    Clusters(Arc<ClusterGraph>),
    /// Segments; only at centers.
    Segments(Arc<SegmentGraph>),
}

impl<P: SubgoalPlacement> Parts<P> {
    /// The bytes of a saved index; `None` where there is nothing to save.
    pub(super) fn to_bytes(&self) -> Option<Vec<u8>> {
        match self {
            Self::Nothing | Self::Pruning(_) | Self::Blocks(..) => None,
            Self::Table(_, table) => Some(table.as_bytes().to_vec()),
            Self::Subgoals(graph) => Some(graph.to_bytes()),
            Self::Clusters(graph) => Some(graph.to_bytes()),
            Self::Segments(graph) => Some(graph.to_bytes()),
        }
    }

    /// The memory that they use, in bytes.
    pub(super) fn memory_bytes(&self) -> usize {
        match self {
            Self::Nothing => 0,
            Self::Pruning(pruning) => pruning.memory_bytes(),
            Self::Blocks(pruning, blocks) => pruning.memory_bytes() + blocks.memory_bytes(),
            Self::Table(pruning, table) => pruning.memory_bytes() + table.memory_bytes(),
            Self::Subgoals(graph) => graph.memory_bytes(),
            Self::Clusters(graph) => graph.memory_bytes(),
            Self::Segments(graph) => graph.memory_bytes(),
        }
    }

    /// The levels, and the side of the lowest clusters or of the segments in cells, of parts that have them.
    pub(super) fn shape(&self) -> (Option<Levels>, Option<u32>) {
        match self {
            Self::Nothing | Self::Pruning(_) | Self::Blocks(..) | Self::Table(..) => (None, None),
            Self::Subgoals(graph) => (Some(graph.hierarchy().into()), None),
            Self::Clusters(graph) => {
                let Clustering { side, levels } = graph.clustering();
                (NonZeroU32::new(levels).map(Levels::Number), Some(side))
            }
            Self::Segments(graph) => (None, Some(graph.side())),
        }
    }
}
