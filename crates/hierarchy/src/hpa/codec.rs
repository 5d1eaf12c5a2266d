//! A [`ClusterGraph`] as bytes.
//!
//! All numbers are `u32`, little endian: the side of the clusters of the lowest level, the number of levels, the width and height of the map; then for each cluster, level by
//! level and row by row, how many nodes it has, and what it costs from each to those after it. The nodes themselves follow from the map.

use mediant_grid::{Centers, GridGraph};

use super::{
    graph::{ClusterGraph, Clustering},
    level::{Cluster, Length},
};
use crate::{HierarchyError, bytes::Numbers, check};

impl ClusterGraph {
    /// The version of what [`to_bytes`](Self::to_bytes) writes.
    pub const VERSION: u32 = 1;

    /// The index without what follows from the map, for [`from_bytes`](Self::from_bytes).
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let Clustering { side, levels } = self.clustering;
        let mut numbers = vec![side, levels, self.size.0, self.size.1];
        for Cluster { count, lengths } in self.levels.iter().flat_map(|level| &level.clusters) {
            numbers.push(*count);
            for from in 0..*count as usize {
                let row = &lengths[from * *count as usize..][from + 1..*count as usize];
                numbers.extend(row.iter().map(|length| length.to_bits()));
            }
        }
        numbers.into_iter().flat_map(u32::to_le_bytes).collect()
    }

    /// The index that gave these bytes for the same grid graph. It answers exactly as that one.
    ///
    /// Whatever the bytes are, the paths found with what is read are legal. But whether they were made of this map and k, and are not damaged, only the file knows that holds
    /// them: see `IndexFile` of `mediant-formats`. With bytes that were not, a planner may find longer paths, or give up.
    ///
    /// # Errors
    /// [`HierarchyError`] for bytes that are no index on this grid graph, or a grid graph of moves that there is no index for.
    pub fn from_bytes(grid_graph: &GridGraph<Centers>, bytes: &[u8]) -> Result<Self, HierarchyError> {
        let mut numbers = Numbers::of(bytes)?;
        let clustering = Clustering { side: numbers.next()?, levels: numbers.next()? };
        let size = (numbers.next()?, numbers.next()?);
        check::size(size, grid_graph.grid())?;
        let mut graph = Self::without_nodes(grid_graph, clustering)?;
        graph.add_nodes(grid_graph.grid());
        for level in &mut graph.levels {
            for cluster in &mut level.clusters {
                let count = numbers.next()?;
                if count != cluster.count {
                    return Err(HierarchyError::Bytes("a cluster has another number of nodes"));
                }
                let count = count as usize;
                let mut lengths = vec![Length::ZERO; count * count].into_boxed_slice();
                for from in 0..count {
                    for to in from + 1..count {
                        let length = Length::from_bits(numbers.next()?);
                        lengths[from * count + to] = length;
                        lengths[to * count + from] = length;
                    }
                }
                cluster.lengths = lengths;
            }
        }
        numbers.end()?;
        Ok(graph)
    }
}
