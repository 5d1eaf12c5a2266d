//! The labels or the graph of an earlier map, and the answers that they still prove.
//!
//! Labels depend on the whole map: after an edit, nobody knows which of them are wrong. But the cells that
//! changed tell which *answers* still hold. A shortest path of the earlier map that no cell has closed since
//! is one of the present map, unless a way through cells that were opened since is shorter. So a query asks
//! the earlier map, and then two questions (`docs/architecture.md`, *Labels of an earlier map*):
//!
//! 1. *Does the path still hold?* Segments near cells that were closed since are looked at ([`Closed`]).
//! 2. *Is every way through opened cells at least as long?* Opened cells that touch are an [`OpenedRegion`].
//!    A path that passes it enters and leaves it at its *contacts*: vertices that were free before. Let d be
//!    the length of shortest paths on the earlier map. A way from s to t that first comes to an opened cell
//!    at contact p, and leaves the last one at contact q, costs at least d(s, p) + h(p, q) + d(q, t), as it
//!    is one of the earlier map up to p and from q on. Where the straight lines to the box around a region
//!    are long enough, labels are not read at all.
//!
//! If both hold, the answer is right. If not, another planner searches the present map.
//!
//! **Niches.** Contacts on one straight line along which the earlier map is free, a *flat*, are joined there
//! as directly as through the region. So pairs of these are left out, and so is a region with one flat alone:
//! most of the cells that open in a wall make no way shorter.
//!
//! **Between vertices.** At corners a path may enter a region between two contacts, ½ cell away from the
//! nearer one; [`bound`] takes off as much. Where a contact is a closed gap, labels do not tell how paths
//! come there; then only straight lines are asked.

mod bound;
mod closed;
mod difference;
mod planner;
mod region;

use std::sync::Arc;

use mediant_grid::{Change, FreeSpace, Identity};
use mediant_moves::K;
use mediant_search::parts::Metric;

pub use self::planner::EarlierSearch;
use self::{closed::Closed, difference::Cells, region::OpenedRegion};
use crate::{graph::SubgoalGraph, labels::HubLabels, placement::SubgoalPlacement};

/// The labels or the graph of an earlier map, with the cells that have changed since: they answer queries on
/// the present map where they prove that they are right ([`EarlierSearch`]). It is immutable, and any number
/// of planners can share it.
#[derive(Clone, Debug)]
pub struct EarlierMap<P: SubgoalPlacement> {
    then: Arc<FreeSpace<P>>,
    prepared: Prepared<P>,
    now: Arc<FreeSpace<P>>,
    /// The cells that differ, row by row.
    cells: Cells,
    closed: Closed,
    /// The regions through which a way may be shorter.
    opened: Vec<Arc<OpenedRegion>>,
}

/// The preparation of the earlier map.
#[derive(Clone, Debug)]
enum Prepared<P: SubgoalPlacement> {
    Labels(Arc<HubLabels<P>>),
    Graph(Arc<SubgoalGraph<P>>),
}

impl<P: SubgoalPlacement> EarlierMap<P> {
    /// The labels of the map before a change, for the map after it; `None` if they would prove too little: if
    /// the change is one of another map, or more than [`MOST_CELLS`](Self::MOST_CELLS) have changed.
    #[must_use]
    pub fn of_labels(
        then: &Arc<FreeSpace<P>>,
        labels: &Arc<HubLabels<P>>,
        now: &Arc<FreeSpace<P>>,
        change: &Change,
    ) -> Option<Self> {
        labels.check(&**then).ok()?;
        Self::of(then, Prepared::Labels(Arc::clone(labels)), now, change)
    }

    /// [`of_labels`](Self::of_labels) for a subgoal graph.
    #[must_use]
    pub fn of_graph(
        then: &Arc<FreeSpace<P>>,
        graph: &Arc<SubgoalGraph<P>>,
        now: &Arc<FreeSpace<P>>,
        change: &Change,
    ) -> Option<Self> {
        graph.check(&**then).ok()?;
        Self::of(then, Prepared::Graph(Arc::clone(graph)), now, change)
    }

    /// The most cells that may have changed since.
    pub const MOST_CELLS: usize = 1 << 14;

    fn of(
        then: &Arc<FreeSpace<P>>,
        prepared: Prepared<P>,
        now: &Arc<FreeSpace<P>>,
        change: &Change,
    ) -> Option<Self> {
        let same = Self {
            then: Arc::clone(then),
            prepared,
            now: Arc::clone(then),
            cells: Cells::default(),
            closed: Closed::default(),
            opened: Vec::new(),
        };
        same.after(now, change)
    }

    /// The same for the map after another change; `None` as for [`of_labels`](Self::of_labels). The work
    /// follows the cells that have changed since the labels were made.
    #[must_use]
    pub fn after(&self, now: &Arc<FreeSpace<P>>, change: &Change) -> Option<Self> {
        let Self { then, prepared, .. } = self;
        let follows = change.before().id() == self.now.grid().id() && change.after().id() == now.grid().id();
        if !follows || then.grid().id().size() != now.grid().id().size() || then.rules() != now.rules() {
            return None;
        }
        let cells = self.cells.after([then.grid(), now.grid()], change.cells(), Self::MOST_CELLS)?;
        let closed = Closed::new(now.grid(), &cells);
        let opened = region::opened([then, now], prepared, &cells, &self.opened);
        let now = Arc::clone(now);
        Some(Self { then: Arc::clone(then), prepared: prepared.clone(), now, cells, closed, opened })
    }

    /// The present map.
    #[must_use]
    pub const fn space(&self) -> &Arc<FreeSpace<P>> {
        &self.now
    }

    /// Whether the present map equals the earlier one.
    #[must_use]
    pub const fn is_present(&self) -> bool {
        self.cells.is_empty()
    }

    /// The number of cells that have changed since.
    #[must_use]
    pub const fn changed_cells(&self) -> usize {
        self.cells.len()
    }

    /// The labels of the earlier map, if it has labels, and no graph.
    #[must_use]
    pub const fn labels(&self) -> Option<&Arc<HubLabels<P>>> {
        match &self.prepared {
            Prepared::Labels(labels) => Some(labels),
            Prepared::Graph(_) => None,
        }
    }

    /// The graph of the earlier map, if it has a graph, and no labels.
    #[must_use]
    pub const fn graph(&self) -> Option<&Arc<SubgoalGraph<P>>> {
        match &self.prepared {
            Prepared::Graph(graph) => Some(graph),
            Prepared::Labels(_) => None,
        }
    }

    /// The neighborhood.
    #[must_use]
    pub fn k(&self) -> K {
        match &self.prepared {
            Prepared::Labels(labels) => labels.k(),
            Prepared::Graph(graph) => graph.k(),
        }
    }

    /// The identity of its answers: the present map and rules, and its k.
    #[must_use]
    pub fn identity(&self) -> Identity {
        Identity { k: Some(self.k()), ..self.now.identity() }
    }

    /// The memory used, in bytes: the labels or the graph, and what is known of the cells that changed.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        let prepared = match &self.prepared {
            Prepared::Labels(labels) => labels.memory_bytes(),
            Prepared::Graph(graph) => graph.memory_bytes(),
        };
        let opened: usize = self.opened.iter().map(|region| region.memory_bytes()).sum();
        prepared + opened + self.cells.memory_bytes() + self.closed.memory_bytes()
    }

    fn metric(&self) -> Metric {
        match &self.prepared {
            Prepared::Labels(labels) => labels.metric(),
            Prepared::Graph(graph) => graph.metric,
        }
    }
}
