//! A [`SegmentGraph`] as bytes: the side of the segments, the width and height of the map, each as `u32`, little endian; then the edges of each segment, row by row, one byte
//! each.

use mediant_grid::{Centers, GridGraph};

use super::segments::SegmentGraph;
use crate::{HierarchyError, bytes::Numbers, check};

impl SegmentGraph {
    /// The version of what [`to_bytes`](Self::to_bytes) writes.
    pub const VERSION: u32 = 1;
    /// Side, width and height.
    const HEADER: usize = 12;

    /// The index, for [`from_bytes`](Self::from_bytes).
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let header = [self.side, self.size.0, self.size.1].map(u32::to_le_bytes);
        header.as_flattened().iter().chain(&self.edges).copied().collect()
    }

    /// The index that gave these bytes for the same grid graph. It answers exactly as that one.
    ///
    /// Whatever the bytes are, the paths found with what is read are legal, and a complete planner finds one whenever there is one. But whether they were made of this map, and are
    /// not damaged, only the file knows that holds them: see `IndexFile` of `mediant-formats`.
    ///
    /// # Errors
    /// [`HierarchyError`] for bytes that are no index on this grid graph, or a grid graph of moves that there is no index for.
    pub fn from_bytes(grid_graph: &GridGraph<Centers>, bytes: &[u8]) -> Result<Self, HierarchyError> {
        let (header, edges) =
            bytes.split_at_checked(Self::HEADER).ok_or(HierarchyError::Bytes("they are too few"))?;
        let mut header = Numbers::of(header)?;
        let side = header.next()?;
        check::size((header.next()?, header.next()?), grid_graph.grid())?;
        let mut graph = Self::without_edges(grid_graph, side)?;
        if edges.len() != graph.edges.len() {
            return Err(HierarchyError::Bytes("they are for another number of segments"));
        }
        let places = (0..graph.rows).flat_map(|y| (0..graph.columns).map(move |x| (x, y)));
        if edges.iter().zip(places).any(|(edges, (x, y))| edges & !graph.possible_edges(x, y) != 0) {
            return Err(HierarchyError::Bytes("an edge leads to no segment"));
        }
        graph.edges.copy_from_slice(edges);
        Ok(graph)
    }
}
