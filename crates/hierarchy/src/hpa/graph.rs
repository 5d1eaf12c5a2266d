//! The index of HPA*.

use std::sync::Arc;

use mediant_grid::{Centers, Change, Grid, GridGraph, Identity, Interrupt, Interrupted, uninterrupted};
use mediant_moves::{CostTable, FiniteK};

use super::{
    DURING,
    build::{Builder, Dirty},
    clustering::Clustering,
    level::Level,
};
use crate::{
    HierarchyError, check,
    touched::{Squares, touched},
};

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
    /// The costs of paths on an empty grid.
    pub(crate) costs: CostTable,
    /// A repaired index shares with the one before the levels in which nothing changed.
    pub(crate) levels: Box<[Arc<Level>]>,
}

impl PartialEq for ClusterGraph {
    fn eq(&self, other: &Self) -> bool {
        (self.identity, self.clustering) == (other.identity, other.clustering) && self.levels == other.levels
    }
}

impl Eq for ClusterGraph {}

impl ClusterGraph {
    /// Makes the index of a map. On thirteen benchmark maps of up to 1491 × 656 cells that takes 1 to 25 ms,
    /// longest in noise and on the largest maps.
    ///
    /// # Errors
    /// [`HierarchyError`] for k above 3, for k = 3 where corners may be cut, or a clustering that is out of
    /// range.
    pub fn new(grid_graph: &GridGraph<Centers>, clustering: Clustering) -> Result<Self, HierarchyError> {
        Self::interruptible(grid_graph, clustering, &Interrupt::NEVER)
    }

    /// [`new`](Self::new), which an interrupt can stop; it asks for each search within a cluster of the
    /// lowest level, and for each cluster of the others.
    ///
    /// # Errors
    /// As for [`new`](Self::new), and [`HierarchyError::Interrupted`].
    pub fn interruptible(
        grid_graph: &GridGraph<Centers>,
        clustering: Clustering,
        interrupt: &Interrupt,
    ) -> Result<Self, HierarchyError> {
        let mut graph = Self::without_nodes(grid_graph, clustering, interrupt)?;
        let levels = std::mem::take(&mut graph.levels);
        let all = Dirty::all(&levels[0]);
        graph.levels = graph.builder([grid_graph.grid(); 2], interrupt).rebuild(levels, all)?;
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
        let level = |side| Level::new(grid, side, clustering.side, interrupt).map(Arc::new);
        Ok(Self {
            identity: grid_graph.identity(),
            k: grid_graph.k(),
            clustering,
            costs: grid_graph.costs().clone(),
            levels: sides.into_iter().map(level).collect::<Result<_, _>>()?,
        })
    }

    /// Levels of the index are made with this, from those of the first map to those of the second.
    pub(crate) const fn builder<'b>(
        &'b self,
        [before, grid]: [&'b Grid; 2],
        interrupt: &'b Interrupt,
    ) -> Builder<'b> {
        Builder { grid, before, k: self.k, costs: &self.costs, interrupt }
    }

    /// Repairs the index after a change. The index is then equal to a new one of the map after it, its
    /// identity included.
    ///
    /// Rebuilt are the clusters with cells that the change alters, their neighbors whose entrances changed,
    /// and the clusters of upper levels above those in which a node or a cost is another one then. The work
    /// follows these clusters, whatever the size of the map. Within a cluster of the lowest level, costs are
    /// found again only between nodes whose shortest paths may lead past a cell that changed; the costs of an
    /// upper cluster are joined anew.
    ///
    /// # Errors
    /// [`HierarchyError::Mismatch`] if the map before the change is not that of the index. Nothing is changed
    /// then.
    pub fn repair(&mut self, change: &Change) -> Result<(), HierarchyError> {
        check::change(self.identity, change)?;
        // Levels that nobody else holds are changed in place.
        let levels = std::mem::take(&mut self.levels);
        self.levels = uninterrupted(|never| self.repaired_levels(levels, change, never));
        self.identity.map = Some(change.after().id());
        Ok(())
    }

    /// The index [repaired](Self::repair), as another one; this one stays as it is. What did not change
    /// is not copied if a version before this one was given up: its memory is used again. An interrupt can
    /// stop it.
    ///
    /// # Errors
    /// As for [`repair`](Self::repair), and [`HierarchyError::Interrupted`].
    pub fn repaired(&self, change: &Change, interrupt: &Interrupt) -> Result<Self, HierarchyError> {
        check::change(self.identity, change)?;
        let levels = self.repaired_levels(self.levels.clone(), change, interrupt)?;
        let identity = Identity { map: Some(change.after().id()), ..self.identity };
        Ok(Self { identity, costs: self.costs.clone(), levels, ..*self })
    }

    fn repaired_levels(
        &self,
        levels: Box<[Arc<Level>]>,
        change: &Change,
        interrupt: &Interrupt,
    ) -> Result<Box<[Arc<Level>]>, Interrupted> {
        // The transitions of a cluster depend on the cells along its borders, on either side.
        let side = self.clustering.side;
        let [costs, nodes] = [0, 1].map(|reach| Squares { side, beside: reach, above: reach, below: reach });
        let touched = |squares| touched(change, squares, (interrupt, DURING));
        let dirty = Dirty { nodes: touched(nodes)?, costs: touched(costs)? };
        self.builder([change.before(), change.after()], interrupt).rebuild(levels, dirty)
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
        self.levels[0].count() as usize
    }

    /// The number of nodes of the lowest level: the cells at which transitions end.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.levels[0].clusters().map(|cluster| cluster.count as usize).sum()
    }

    /// The most numbers of nodes of a level. It is the same in all versions of a map.
    pub(super) fn most_nodes(&self) -> usize {
        self.levels.iter().map(|level| level.node_numbers() as usize).max().unwrap_or(0)
    }

    /// The memory that the index uses, in bytes.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        self.levels.iter().map(|level| level.memory_bytes()).sum()
    }
}
