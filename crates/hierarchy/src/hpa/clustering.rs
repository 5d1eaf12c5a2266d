//! How a map is cut into clusters.

use crate::{HierarchyError, window};

/// How the map of a [`ClusterGraph`](crate::ClusterGraph) is cut into clusters.
///
/// The default is clusters of 10 × 10 cells as in the paper (Section 4), and two levels above them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Clustering {
    /// The side of the clusters of the lowest level, in cells: 2 to 64.
    pub side: u32,
    /// The number of levels, at least 1. A cluster of an upper level consists of 2 × 2 clusters of the level
    /// below; its side may not exceed [`MAX_SIDE`](Self::MAX_SIDE).
    pub levels: u32,
}

impl Clustering {
    /// The longest side of a cluster of any level, in cells.
    pub const MAX_SIDE: u32 = 256;
    /// A cluster of an upper level consists of this many clusters of the level below along each side.
    const FACTOR: u32 = 2;

    /// The sides of the clusters, level by level from the lowest.
    pub(crate) fn sides(self) -> Result<Vec<u32>, HierarchyError> {
        if !(2..=window::MAX_SIDE).contains(&self.side) {
            return Err(HierarchyError::Side { found: self.side, min: 2, max: window::MAX_SIDE });
        }
        let sides = (0..self.levels).map_while(|level| {
            let side = Self::FACTOR.checked_pow(level)?.checked_mul(self.side)?;
            (side <= Self::MAX_SIDE).then_some(side)
        });
        let sides: Vec<u32> = sides.collect();
        if sides.is_empty() || sides.len() != self.levels as usize {
            return Err(HierarchyError::Levels { found: self.levels, side: self.side, max: Self::MAX_SIDE });
        }
        Ok(sides)
    }
}

impl Default for Clustering {
    fn default() -> Self {
        Self { side: 10, levels: 3 }
    }
}
