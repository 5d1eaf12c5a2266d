//! A [`ClusterGraph`] as bytes.
//!
//! First its [`Identity`](mediant_grid::Identity), 32 bytes. All else is numbers, `u32`, little endian: the
//! side of the clusters of the lowest level, and the number of levels. Then for each cluster, level by level
//! and row by row: the number n of its nodes, and the n(n − 1)/2 costs from each node to those after it, in
//! units of 2⁻¹⁶ cells. The nodes themselves are not stored: they follow from the map.

use std::sync::Arc;

use mediant_grid::{Centers, GridGraph, Interrupt, Interrupted, room_in, uninterrupted};

use super::{
    DURING,
    clustering::Clustering,
    fixed_cost::FixedCost,
    graph::ClusterGraph,
    level::{Cluster, Level},
};
use crate::{HierarchyError, bytes::WordReader, check};

impl ClusterGraph {
    /// The version of the format of [`to_bytes`](Self::to_bytes).
    pub const VERSION: u32 = 2;

    /// The index as bytes, without what follows from the map. [`from_bytes`](Self::from_bytes) reads them.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        uninterrupted(|never| self.to_bytes_interruptible(never))
    }

    /// [`to_bytes`](Self::to_bytes), which an interrupt can stop.
    ///
    /// # Errors
    /// [`Interrupted`], with nothing kept.
    pub fn to_bytes_interruptible(&self, interrupt: &Interrupt) -> Result<Vec<u8>, Interrupted> {
        let mut bytes = self.identity.to_bytes().to_vec();
        let write = |bytes: &mut Vec<u8>, word: u32| bytes.extend(word.to_le_bytes());
        let Clustering { side, levels } = self.clustering;
        [side, levels].into_iter().for_each(|word| write(&mut bytes, word));
        let clusters = self.levels.iter().flat_map(|level| level.clusters());
        for (number, Cluster { count, costs, .. }) in clusters.enumerate() {
            interrupt.check_every(64, number, Interrupted::WRITING)?;
            let words = 1 + *count as usize * (*count as usize).saturating_sub(1) / 2;
            room_in(&mut bytes, words * size_of::<u32>(), Interrupted::WRITING)?;
            write(&mut bytes, *count);
            for from in 0..*count as usize {
                let later = &costs[from * *count as usize..][from + 1..*count as usize];
                later.iter().for_each(|cost| write(&mut bytes, cost.to_bits()));
            }
        }
        Ok(bytes)
    }

    /// The index of a grid graph from its bytes. It gives the same answers as the index that was written.
    ///
    /// Damage is not always found; a file that holds the bytes must tell (see `IndexFile` of
    /// `mediant-formats`). Whatever the bytes are, paths found with the index are legal, but with damaged
    /// bytes they may be longer, or a planner may give up.
    ///
    /// # Errors
    /// [`HierarchyError::Mismatch`] for the bytes of an index of another map, rule of motion or k, before
    /// anything else is looked at; another [`HierarchyError`] for bytes that are no index of this grid graph,
    /// or moves that there is no index for.
    pub fn from_bytes(grid_graph: &GridGraph<Centers>, bytes: &[u8]) -> Result<Self, HierarchyError> {
        Self::from_bytes_interruptible(grid_graph, bytes, &Interrupt::NEVER)
    }

    /// [`from_bytes`](Self::from_bytes), which an interrupt can stop.
    ///
    /// # Errors
    /// As for [`from_bytes`](Self::from_bytes), and [`HierarchyError::Interrupted`].
    pub fn from_bytes_interruptible(
        grid_graph: &GridGraph<Centers>,
        bytes: &[u8],
        interrupt: &Interrupt,
    ) -> Result<Self, HierarchyError> {
        let mut words = WordReader::new(check::after_identity(bytes, grid_graph)?)?;
        let clustering = Clustering { side: words.next()?, levels: words.next()? };
        let size = (grid_graph.grid().width(), grid_graph.grid().height());
        // Each cluster has at least its number of nodes: no header allocates more than the bytes behind it
        // warrant.
        let clusters = |side: u32| size.0.div_ceil(side) as usize * size.1.div_ceil(side) as usize;
        words.check_left(clustering.sides()?.into_iter().map(clusters).sum())?;
        let mut graph = Self::without_nodes(grid_graph, clustering, interrupt)?;
        let mut costs = Vec::new();
        let mut levels: Vec<Arc<Level>> = Vec::with_capacity(graph.levels.len());
        for level in std::mem::take(&mut graph.levels) {
            let mut edit = level.edit();
            graph.builder([grid_graph.grid(); 2], interrupt).make_nodes(&mut edit, levels.last())?;
            for cluster in 0..edit.count() {
                interrupt.check_every(64, cluster as usize, DURING)?;
                let count = words.next()? as usize;
                if count != edit.nodes_of(cluster).len() {
                    return Err(HierarchyError::Bytes("a cluster has another number of nodes"));
                }
                costs.clear();
                costs.resize(count * count, FixedCost::ZERO);
                for from in 0..count {
                    for to in from + 1..count {
                        let cost = FixedCost::from_bits(words.next()?);
                        costs[from * count + to] = cost;
                        costs[to * count + from] = cost;
                    }
                }
                edit.set_costs(cluster, &costs);
            }
            levels.push(Arc::new(edit.finish()));
        }
        graph.levels = levels.into();
        words.end()?;
        Ok(graph)
    }
}
