//! A [`SegmentGraph`] as bytes: its [`Identity`]; the side of the segments as a little-endian `u32`; then one
//! byte for each segment, row by row, with a bit for each of its edges.

use mediant_grid::{Centers, GridGraph, Identity};

use super::segments::SegmentGraph;
use crate::{HierarchyError, bytes::WordReader, check};

impl SegmentGraph {
    /// The version of the format of [`to_bytes`](Self::to_bytes).
    pub const VERSION: u32 = 2;
    /// The length of the side in bytes.
    const HEADER: usize = 4;

    /// The index as bytes. [`from_bytes`](Self::from_bytes) reads them.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let identity: [u8; Identity::BYTES] = self.identity.to_bytes();
        [&identity[..], &self.side.to_le_bytes(), &self.edges].concat()
    }

    /// The index of a grid graph from its bytes. It gives the same answers as the index that was written.
    ///
    /// Damage is not always found; a file that holds the bytes must tell (see `IndexFile` of
    /// `mediant-formats`). Whatever the bytes are, paths found with the index are legal, and a complete
    /// planner finds one whenever there is one.
    ///
    /// # Errors
    /// [`HierarchyError::Mismatch`] for the bytes of an index of another map, rule of motion or k, before
    /// anything else is looked at; another [`HierarchyError`] for bytes that are no index of this grid graph,
    /// or moves that there is no index for.
    pub fn from_bytes(grid_graph: &GridGraph<Centers>, bytes: &[u8]) -> Result<Self, HierarchyError> {
        let bytes = check::after_identity(bytes, grid_graph)?;
        let (header, edges) =
            bytes.split_at_checked(Self::HEADER).ok_or(HierarchyError::Bytes("they are too few"))?;
        let mut header = WordReader::new(header)?;
        let side = header.next()?;
        let mut graph = Self::without_edges(grid_graph, side)?;
        if edges.len() != graph.segments_of_map() {
            return Err(HierarchyError::Bytes("they are for another number of segments"));
        }
        let positions = (0..graph.rows).flat_map(|y| (0..graph.columns).map(move |x| (x, y)));
        if edges.iter().zip(positions).any(|(edges, (x, y))| edges & !graph.possible_edges(x, y) != 0) {
            return Err(HierarchyError::Bytes("an edge leads to no segment"));
        }
        graph.edges = edges.to_vec().into();
        Ok(graph)
    }
}
