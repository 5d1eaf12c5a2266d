//! The index of HPA*.

use std::{collections::BTreeSet, ops::Range};

use mediant_grid::{Centers, Change, GridGraph, Identity, Interrupt};
use mediant_moves::{CostTable, FiniteK};

use super::{clustering::Clustering, level::Level};
use crate::{HierarchyError, check, window::on_map};

/// The index of HPA*: the map in clusters, the transitions between them, and the costs of crossing each
/// cluster from one transition to another (Botea, Müller & Schaeffer 2004, Sections 3.1 and 3.2).
///
/// Along the border of two clusters, each run of cells that are free on both sides is an *entrance*: with one
/// *transition* in its middle if it is narrower than six cells, else with one at either end. The two cells of
/// a transition are nodes.
///
/// A cluster of an upper level has the transitions across its own borders; the costs of crossing it are
/// computed on the level below.
///
/// An index is changed only by [`repair`](Self::repair); any number of planners share it. Two that are equal
/// give the same answers.
#[derive(Clone, Debug)]
pub struct ClusterGraph {
    pub(crate) identity: Identity,
    pub(crate) k: FiniteK,
    pub(crate) clustering: Clustering,
    pub(crate) size: (u32, u32),
    /// The costs of paths on an empty grid.
    pub(crate) costs: CostTable,
    pub(crate) levels: Box<[Level]>,
}

impl PartialEq for ClusterGraph {
    fn eq(&self, other: &Self) -> bool {
        (self.identity, self.clustering) == (other.identity, other.clustering) && self.levels == other.levels
    }
}

impl Eq for ClusterGraph {}

impl ClusterGraph {
    /// Makes the index of a map. On fourteen benchmark maps of up to 1024 × 1024 cells that takes 2 to 97 ms,
    /// longest in noise.
    ///
    /// # Errors
    /// [`HierarchyError`] for k above 3, for k = 3 where corners may be cut, or a clustering that is out of
    /// range.
    pub fn new(grid_graph: &GridGraph<Centers>, clustering: Clustering) -> Result<Self, HierarchyError> {
        Self::interruptible(grid_graph, clustering, &Interrupt::NEVER)
    }

    /// [`new`](Self::new), which an interrupt can stop; it asks for each search within a cluster.
    ///
    /// # Errors
    /// As for [`new`](Self::new), and [`HierarchyError::Interrupted`].
    pub fn interruptible(
        grid_graph: &GridGraph<Centers>,
        clustering: Clustering,
        interrupt: &Interrupt,
    ) -> Result<Self, HierarchyError> {
        let mut graph = Self::without_nodes(grid_graph, clustering, interrupt)?;
        let all = (0..graph.clusters() as u32).collect();
        graph.rebuild(grid_graph.grid(), all, interrupt)?;
        Ok(graph)
    }

    /// An index whose clusters have no nodes yet.
    pub(crate) fn without_nodes(
        grid_graph: &GridGraph<Centers>,
        clustering: Clustering,
        interrupt: &Interrupt,
    ) -> Result<Self, HierarchyError> {
        check::moves(grid_graph)?;
        let (grid, sides) = (grid_graph.grid(), clustering.sides()?);
        let level = |side| Level::new(grid, side, clustering.side, interrupt);
        Ok(Self {
            identity: grid_graph.identity(),
            k: grid_graph.k(),
            clustering,
            size: (grid.width(), grid.height()),
            costs: grid_graph.costs().clone(),
            levels: sides.into_iter().map(level).collect::<Result<_, _>>()?,
        })
    }

    /// Repairs the index after a change. The index is then equal to a new one of the map after it, its
    /// identity included.
    ///
    /// Rebuilt are the clusters that the change touches, their neighbors whose entrances changed, and the
    /// clusters of upper levels that contain them.
    ///
    /// # Errors
    /// [`HierarchyError::Mismatch`] if the map before the change is not that of the index. Nothing is changed
    /// then.
    pub fn repair(&mut self, change: &Change) -> Result<(), HierarchyError> {
        self.repair_in_place(change, &Interrupt::NEVER)
    }

    /// A copy of the index, [repaired](Self::repair). An interrupt can stop it; this index stays as it is.
    ///
    /// # Errors
    /// As for [`repair`](Self::repair), and [`HierarchyError::Interrupted`].
    pub fn repaired(&self, change: &Change, interrupt: &Interrupt) -> Result<Self, HierarchyError> {
        check::change(self.identity, change)?;
        let levels = self.levels.iter().map(|level| level.copied(interrupt));
        let mut copy = Self { levels: levels.collect::<Result<_, _>>()?, costs: self.costs.clone(), ..*self };
        copy.repair_in_place(change, interrupt)?;
        Ok(copy)
    }

    /// Once it is interrupted, the index is that of neither map.
    fn repair_in_place(&mut self, change: &Change, interrupt: &Interrupt) -> Result<(), HierarchyError> {
        check::change(self.identity, change)?;
        let level = &self.levels[0];
        let clusters = |cells: Range<u32>| cells.start / level.side..cells.end.div_ceil(level.side);
        let touched = change.cells().iter().filter_map(|&at| on_map(at, self.size));
        let dirty: BTreeSet<u32> = touched
            .flat_map(|[columns, rows]| {
                let columns = clusters(columns);
                clusters(rows).flat_map(move |y| columns.clone().map(move |x| y * level.columns + x))
            })
            .collect();
        if !dirty.is_empty() {
            self.rebuild(change.after(), dirty.into_iter().collect(), interrupt)?;
        }
        self.identity.map = Some(change.after().id());
        Ok(())
    }

    /// The identity of its grid graph: map, rules of motion and k.
    #[must_use]
    pub const fn identity(&self) -> Identity {
        self.identity
    }

    /// How the map is cut into clusters.
    #[must_use]
    pub const fn clustering(&self) -> Clustering {
        self.clustering
    }

    /// The number of clusters of the lowest level.
    #[must_use]
    pub fn clusters(&self) -> usize {
        self.levels[0].clusters.len()
    }

    /// The number of nodes of the lowest level: the cells at which transitions end.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.levels[0].clusters.iter().map(|cluster| cluster.count as usize).sum()
    }

    /// The most numbers of nodes of a level.
    pub(super) fn most_nodes(&self) -> usize {
        self.levels.iter().map(|level| level.nodes.len()).max().unwrap_or(0)
    }

    /// The memory that the index uses, in bytes.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        self.levels
            .iter()
            .map(|level| {
                size_of_val(&*level.nodes)
                    + size_of_val(&*level.clusters)
                    + level.clusters.iter().map(|cluster| size_of_val(&*cluster.costs)).sum::<usize>()
            })
            .sum()
    }
}
