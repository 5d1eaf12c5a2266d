//! The hubs of a vertex.

use mediant_grid::{FreeSpace, Vertex};

use super::{HubLabels, join::Join};
use crate::placement::SubgoalPlacement;

/// Reads the hubs of vertices, one after another.
#[derive(Debug)]
pub(crate) struct LabelReader {
    join: Join,
    hubs: Vec<(u32, u64)>,
}

impl LabelReader {
    pub(crate) fn new<P: SubgoalPlacement>(labels: &HubLabels<P>) -> Self {
        Self { join: Join::new(labels), hubs: Vec::new() }
    }

    /// The hubs of a free vertex, each with the least cost of a path there that bends at a subgoal.
    pub(crate) fn hubs<P: SubgoalPlacement>(
        &mut self,
        labels: &HubLabels<P>,
        space: &FreeSpace<P>,
        at: Vertex,
    ) -> &[(u32, u64)] {
        self.join.hubs_of(labels, space, at, &mut self.hubs);
        &self.hubs
    }

    /// The hubs that were read last.
    pub(crate) fn last(&self) -> &[(u32, u64)] {
        &self.hubs
    }
}
