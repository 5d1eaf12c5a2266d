//! One level of the abstract graph: clusters, their nodes, and the costs between these.

use std::{ops::Deref, sync::Arc};

use mediant_grid::{Grid, Interrupt, VersionEdit, Versioned, Vertex, room_for};

use super::{clustering::Clustering, fixed_cost::FixedCost};
use crate::{HierarchyError, check, window::Window};

/// No node.
pub(crate) const NONE: u32 = u32::MAX;

/// A cell at which a transition ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Node {
    x: u16,
    y: u16,
    pub(crate) cluster: u32,
    /// The nodes across the border. A cell in the corner of a cluster may have two.
    across: [u32; 2],
    /// The same cell's node on the level below.
    pub(crate) below: u32,
}

impl Node {
    const UNUSED: Self = Self { x: 0, y: 0, cluster: NONE, across: [NONE; 2], below: NONE };

    const fn new(at: Vertex, cluster: u32, below: u32) -> Self {
        Self { x: at.x as u16, y: at.y as u16, cluster, across: [NONE; 2], below }
    }

    #[inline]
    pub(crate) const fn at(&self) -> Vertex {
        Vertex::new(self.x as i32, self.y as i32)
    }

    pub(crate) fn across(&self) -> impl Iterator<Item = u32> {
        self.across.into_iter().filter(|&id| id != NONE)
    }
}

/// A cluster: the numbers of its nodes, and the costs from each to each within it, row by row. A repaired
/// index shares with the one before what did not change.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Cluster {
    /// The number of its first node.
    pub(crate) first: u32,
    pub(crate) count: u32,
    pub(crate) costs: Arc<[FixedCost]>,
}

impl Cluster {
    /// The costs from one of its nodes to each.
    #[inline]
    pub(crate) fn costs_from(&self, id: u32) -> &[FixedCost] {
        let (count, index) = (self.count as usize, (id - self.first) as usize);
        &self.costs[index * count..(index + 1) * count]
    }
}

/// Nodes with successive numbers. Versions of a level share the blocks in which nothing changed.
type NodeBlock = [Node; NODES];
/// Clusters with successive numbers.
type ClusterBlock = [Cluster; CLUSTERS];

/// A cluster has at most so many nodes: all cells along the sides of the largest.
const NODES: usize = 4 * Clustering::MAX_SIDE as usize;
const CLUSTERS: usize = 32;

/// The cut of a map by a level into clusters of `side` × `side` cells; those at the right and lower edge may
/// be smaller.
///
/// Each cluster has `stride` node numbers, as many as it can need, so that no change elsewhere renumbers its
/// nodes. They are in one block of nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Shape {
    pub(crate) side: u32,
    pub(crate) columns: u32,
    pub(crate) rows: u32,
    stride: u32,
}

/// A level. The next version is made in a [`LevelEdit`].
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Level {
    shape: Shape,
    nodes: Versioned<Arc<NodeBlock>>,
    clusters: Versioned<Arc<ClusterBlock>>,
}

/// The next version of a level while it is made.
pub(crate) struct LevelEdit {
    shape: Shape,
    nodes: VersionEdit<Arc<NodeBlock>>,
    clusters: VersionEdit<Arc<ClusterBlock>>,
}

/// A rectangle of cells, without column `right` and row `bottom`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Bounds {
    pub(crate) left: i32,
    pub(crate) top: i32,
    pub(crate) right: i32,
    pub(crate) bottom: i32,
}

impl Bounds {
    /// The whole map, whatever its size.
    pub(crate) const ALL: Self = Self { left: 0, top: 0, right: i32::MAX, bottom: i32::MAX };

    #[inline]
    pub(crate) const fn contains(&self, at: Vertex) -> bool {
        at.x >= self.left && at.x < self.right && at.y >= self.top && at.y < self.bottom
    }

    /// The sides along which a vertex within lies.
    fn sides(self, at: Vertex) -> u8 {
        let along = |is: bool, side: u8| if is { side } else { 0 };
        along(at.x == self.left, LEFT)
            | along(at.x == self.right - 1, RIGHT)
            | along(at.y == self.top, ABOVE)
            | along(at.y == self.bottom - 1, BELOW)
    }

    /// The sides that bounds within these have in common with them.
    pub(crate) fn common_sides(self, inner: Self) -> u8 {
        self.sides(Vertex::new(inner.left, inner.top)) & (LEFT | ABOVE)
            | self.sides(Vertex::new(inner.right - 1, inner.bottom - 1)) & (RIGHT | BELOW)
    }

    /// The window of these cells, which must be those of a cluster of the lowest level.
    pub(crate) fn window(self, grid: &Grid) -> Window {
        let Self { left, top, right, bottom } = self;
        Window::new(grid, left, top, (right - left) as u32, (bottom - top) as u32)
    }
}

/// The sides of a rectangle, as bits of a set.
pub(crate) const LEFT: u8 = 1;
pub(crate) const RIGHT: u8 = 2;
pub(crate) const ABOVE: u8 = 4;
pub(crate) const BELOW: u8 = 8;

const ALL_SIDES: u8 = LEFT | RIGHT | ABOVE | BELOW;

/// The blocks that are made between two questions of an interrupt.
const PIECE: usize = 1 << 10;

/// A block of the next version, to be changed. It is copied if another version has it.
fn block_mut<T: Clone + PartialEq>(edit: &mut VersionEdit<Arc<T>>, number: usize) -> &mut T {
    Arc::make_mut(edit.word_mut(number))
}

/// One of the clusters of these blocks.
#[inline]
fn cluster(blocks: &[Arc<ClusterBlock>], id: u32) -> &Cluster {
    &blocks[id as usize / CLUSTERS][id as usize % CLUSTERS]
}

/// One of the nodes of these blocks.
#[inline]
fn node(blocks: &[Arc<NodeBlock>], id: u32) -> &Node {
    &blocks[id as usize / NODES][id as usize % NODES]
}

/// The nodes of a cluster, in the order of their numbers.
#[inline]
fn nodes_of<'b>(blocks: &'b [Arc<NodeBlock>], cluster: &Cluster) -> &'b [Node] {
    let first = cluster.first as usize;
    &blocks[first / NODES][first % NODES..][..cluster.count as usize]
}

impl Shape {
    /// The number of clusters.
    pub(crate) const fn count(&self) -> u32 {
        self.columns * self.rows
    }

    /// The cluster of a vertex.
    pub(crate) const fn cluster_at(&self, at: Vertex) -> u32 {
        at.y as u32 / self.side * self.columns + at.x as u32 / self.side
    }

    /// The cells of a cluster that are on the map.
    pub(crate) fn bounds(&self, cluster: u32, grid: &Grid) -> Bounds {
        let full = self.full_bounds(cluster);
        let (width, height) = (grid.width() as i32, grid.height() as i32);
        Bounds { right: full.right.min(width), bottom: full.bottom.min(height), ..full }
    }

    /// The cells of a cluster, which at the right and lower edge may lie beyond the map.
    fn full_bounds(&self, cluster: u32) -> Bounds {
        let [left, top] = [cluster % self.columns, cluster / self.columns].map(|i| (i * self.side) as i32);
        Bounds { left, top, right: left + self.side as i32, bottom: top + self.side as i32 }
    }

    /// The neighbors of a cluster: left, right, above, below.
    fn neighbors(&self, cluster: u32) -> [Option<u32>; 4] {
        let (x, y) = (cluster % self.columns, cluster / self.columns);
        [
            (x > 0).then(|| cluster - 1),
            (x + 1 < self.columns).then(|| cluster + 1),
            (y > 0).then(|| cluster - self.columns),
            (y + 1 < self.rows).then(|| cluster + self.columns),
        ]
    }

    /// The clusters within these bounds, row by row.
    pub(crate) fn within(
        &self,
        bounds: Bounds,
    ) -> impl Iterator<Item = impl Iterator<Item = u32> + use<>> + use<> {
        let span = |first: i32, end: i32| first as u32 / self.side..(end as u32).div_ceil(self.side);
        let (columns, all) = (span(bounds.left, bounds.right), self.columns);
        span(bounds.top, bounds.bottom).map(move |y| columns.clone().map(move |x| y * all + x))
    }

    /// These clusters and their neighbors, in ascending order.
    pub(crate) fn with_neighbors(&self, clusters: &[u32]) -> Vec<u32> {
        if clusters.len() == self.count() as usize {
            return clusters.to_vec();
        }
        ascending(clusters.iter().flat_map(|&id| self.neighbors(id).into_iter().flatten().chain([id])))
    }

    /// Clusters whose nodes moved, with all sides, and their neighbors, with the sides on which these lie, in
    /// ascending order.
    pub(crate) fn facing(&self, moved: &[u32]) -> Vec<(u32, u8)> {
        let mut facing: Vec<_> = moved.iter().map(|&id| (id, ALL_SIDES)).collect();
        if moved.len() < self.count() as usize {
            facing.extend(moved.iter().flat_map(|&id| {
                self.neighbors(id)
                    .into_iter()
                    .zip([RIGHT, LEFT, BELOW, ABOVE])
                    .filter_map(|(id, side)| Some((id?, side)))
            }));
            facing.sort_unstable();
        }
        facing.dedup_by(|(id, side), (kept, sides)| {
            *sides |= if id == kept { *side } else { 0 };
            id == kept
        });
        facing
    }

    /// The clusters of this level that contain these of the level below, in ascending order.
    pub(crate) fn parents(&self, below: &Self, clusters: &[u32]) -> Vec<u32> {
        let factor = self.side / below.side;
        ascending(clusters.iter().map(|&id| {
            let (x, y) = (id % below.columns, id / below.columns);
            y / factor * self.columns + x / factor
        }))
    }

    /// The number of the first node of a cluster.
    const fn place(&self, cluster: u32) -> u32 {
        let in_block = NODES as u32 / self.stride;
        cluster / in_block * NODES as u32 + cluster % in_block * self.stride
    }
}

fn ascending(ids: impl Iterator<Item = u32>) -> Vec<u32> {
    let mut ids: Vec<u32> = ids.collect();
    ids.sort_unstable();
    ids.dedup();
    ids
}

impl Deref for Level {
    type Target = Shape;

    #[inline]
    fn deref(&self) -> &Shape {
        &self.shape
    }
}

impl Deref for LevelEdit {
    type Target = Shape;

    fn deref(&self) -> &Shape {
        &self.shape
    }
}

impl Level {
    /// A level without nodes. `lowest_side` is the side of the clusters of the lowest level.
    ///
    /// # Errors
    /// [`HierarchyError::TooLarge`] for more nodes than can be addressed, [`HierarchyError::Interrupted`].
    pub(crate) fn new(
        grid: &Grid,
        side: u32,
        lowest_side: u32,
        interrupt: &Interrupt,
    ) -> Result<Self, HierarchyError> {
        let [columns, rows] = [grid.width(), grid.height()].map(|cells| cells.div_ceil(side));
        // On each of the four borders every other cell may be an entrance. On upper levels the corner cells
        // of clusters of the lowest level may be nodes as well: they are joined with nodes beside them that
        // end another transition.
        let half = lowest_side.div_ceil(2);
        let on_border = if side == lowest_side { half } else { lowest_side.min(half + 2) };
        let stride = 4 * (side / lowest_side) * on_border;
        let shape = Shape { side, columns, rows, stride };
        let blocks = u64::from(shape.count()).div_ceil(NODES as u64 / u64::from(stride));
        check::address_space(blocks * NODES as u64)?;
        room_for::<[Node; NODES]>(blocks as usize, super::DURING)?;
        room_for::<[Cluster; CLUSTERS]>(shape.count().div_ceil(CLUSTERS as u32) as usize, super::DURING)?;
        // Blocks are copied when they are first written to.
        let block = Arc::new([Node::UNUSED; NODES]);
        let mut clusters = Vec::new();
        for block in 0..shape.count().div_ceil(CLUSTERS as u32) {
            interrupt.check_every(PIECE, block as usize, super::DURING)?;
            let first = |number| shape.place(block * CLUSTERS as u32 + number as u32);
            let cluster = |number| Cluster { first: first(number), ..Cluster::default() };
            clusters.push(Arc::new(std::array::from_fn(cluster)));
        }
        Ok(Self { nodes: vec![block; blocks as usize].into(), clusters: clusters.into(), shape })
    }

    /// Begins the next version: in place if nobody else holds this one.
    pub(crate) fn edit(self: Arc<Self>) -> LevelEdit {
        match Arc::try_unwrap(self) {
            Ok(Self { shape, nodes, clusters }) => {
                LevelEdit { shape, nodes: nodes.into_edit(), clusters: clusters.into_edit() }
            }
            Err(held) => {
                LevelEdit { shape: held.shape, nodes: held.nodes.edit(), clusters: held.clusters.edit() }
            }
        }
    }

    #[inline]
    pub(crate) fn cluster(&self, id: u32) -> &Cluster {
        cluster(&self.clusters, id)
    }

    /// All clusters, row by row.
    pub(crate) fn clusters(&self) -> impl Iterator<Item = &Cluster> {
        (0..self.count()).map(|id| self.cluster(id))
    }

    /// The nodes of a cluster, in the order of their numbers.
    #[inline]
    pub(crate) fn nodes_of(&self, cluster: u32) -> &[Node] {
        self.nodes_in(self.cluster(cluster))
    }

    /// The nodes of one of its clusters, in the order of their numbers.
    #[inline]
    pub(crate) fn nodes_in(&self, cluster: &Cluster) -> &[Node] {
        nodes_of(&self.nodes, cluster)
    }

    /// The number of the first node of a cluster.
    #[inline]
    pub(crate) fn first_node(&self, cluster: u32) -> u32 {
        self.cluster(cluster).first
    }

    #[inline]
    pub(crate) fn node(&self, id: u32) -> &Node {
        node(&self.nodes, id)
    }

    /// The sides of a node's cluster, whose bounds these are, across which a step leads from it.
    pub(crate) fn sides(&self, node: &Node, bounds: Bounds) -> u8 {
        let along = bounds.sides(node.at());
        // In corners, and along the border of the map, there are sides without a step.
        if along.is_power_of_two() {
            return along;
        }
        let leads = |there: Vertex| match () {
            () if there.x < bounds.left => LEFT,
            () if there.x >= bounds.right => RIGHT,
            () if there.y < bounds.top => ABOVE,
            () => BELOW,
        };
        node.across().fold(0, |sides, other| sides | leads(self.node(other).at()))
    }

    /// All numbers of nodes are below this one. It depends on the size of the map and the clustering alone.
    #[inline]
    pub(crate) fn node_numbers(&self) -> u32 {
        (self.nodes.len() * NODES) as u32
    }

    /// The costs from a node to each node of its cluster.
    #[inline]
    pub(crate) fn costs_from(&self, id: u32) -> &[FixedCost] {
        self.cluster(self.node(id).cluster).costs_from(id)
    }

    /// The memory that it uses, in bytes.
    pub(crate) fn memory_bytes(&self) -> usize {
        // Blocks without nodes are one and the same.
        let with_nodes = self.clusters().filter(|cluster| cluster.count > 0);
        let mut used: Vec<usize> = with_nodes.map(|cluster| cluster.first as usize / NODES).collect();
        used.dedup();
        used.len() * size_of::<NodeBlock>()
            + self.clusters.iter().map(|block| size_of_val(&**block)).sum::<usize>()
            + self.clusters().map(|cluster| size_of_val(&*cluster.costs)).sum::<usize>()
    }
}

impl LevelEdit {
    /// The next version.
    pub(crate) fn finish(self) -> Level {
        Level { shape: self.shape, nodes: self.nodes.finish(), clusters: self.clusters.finish() }
    }

    fn cluster(&self, id: u32) -> &Cluster {
        cluster(self.clusters.words(), id)
    }

    fn cluster_mut(&mut self, id: u32) -> &mut Cluster {
        &mut block_mut(&mut self.clusters, id as usize / CLUSTERS)[id as usize % CLUSTERS]
    }

    /// The nodes of a cluster, in the order of their numbers.
    pub(crate) fn nodes_of(&self, cluster: u32) -> &[Node] {
        nodes_of(self.nodes.words(), self.cluster(cluster))
    }

    fn node_mut(&mut self, id: u32) -> &mut Node {
        &mut block_mut(&mut self.nodes, id as usize / NODES)[id as usize % NODES]
    }

    /// The costs between the nodes of a cluster, row by row.
    pub(crate) fn costs_of(&self, cluster: u32) -> &[FixedCost] {
        &self.cluster(cluster).costs
    }

    /// Replaces the nodes of a cluster by nodes at these cells, each with its node on the level below.
    /// Returns whether there are nodes elsewhere than before.
    pub(crate) fn set_nodes(&mut self, cluster: u32, cells: &[(Vertex, u32)]) -> bool {
        debug_assert!(cells.len() <= self.stride as usize, "cluster {cluster} has {} nodes", cells.len());
        let (old, moved) = (self.nodes_of(cluster), !self.has_nodes_at(cluster, cells));
        if !moved && old.iter().map(|node| node.below).eq(cells.iter().map(|&(_, below)| below)) {
            return false;
        }
        let &Cluster { first, count, .. } = self.cluster(cluster);
        let (first, end) = (first as usize, cells.len().max(count as usize));
        let nodes = &mut block_mut(&mut self.nodes, first / NODES)[first % NODES..][..end];
        if moved {
            let new = cells.iter().map(|&(at, below)| Node::new(at, cluster, below));
            let new = new.chain(std::iter::repeat(Node::UNUSED));
            nodes.iter_mut().zip(new).for_each(|(node, new)| *node = new);
            self.cluster_mut(cluster).count = cells.len() as u32;
        } else {
            nodes.iter_mut().zip(cells).for_each(|(node, &(_, below))| node.below = below);
        }
        moved
    }

    /// Whether the nodes of a cluster are at these cells.
    pub(crate) fn has_nodes_at(&self, cluster: u32, cells: &[(Vertex, u32)]) -> bool {
        self.nodes_of(cluster).iter().map(Node::at).eq(cells.iter().map(|&(at, _)| at))
    }

    /// Joins the nodes along sides of a cluster with the nodes beside them across its borders: the two ends
    /// of a transition, and in the corners of clusters also ends of different transitions, between which a
    /// step is legal as well.
    pub(crate) fn join_across(&mut self, cluster: u32, sides: u8) {
        let &Cluster { first, count, .. } = self.cluster(cluster);
        let (bounds, neighbors) = (self.full_bounds(cluster), self.neighbors(cluster));
        let steps = [(LEFT, (-1, 0)), (RIGHT, (1, 0)), (ABOVE, (0, -1)), (BELOW, (0, 1))];
        // Along a border the nodes on either side come in the same order.
        let mut passed = [0; 4];
        for id in first..first + count {
            let node = node(self.nodes.words(), id);
            let (at, along) = (node.at(), bounds.sides(node.at()));
            if along & sides == 0 {
                continue;
            }
            let mut across = (0..4).filter(|&side| along & steps[side].0 != 0).filter_map(|side| {
                let (other, there) = (neighbors[side]?, at + steps[side].1.into());
                let nodes = self.nodes_of(other).iter().skip(passed[side]);
                passed[side] += nodes.map(Node::at).position(|at| at == there)?;
                Some(self.cluster(other).first + passed[side] as u32)
            });
            let across = [across.next(), across.next()].map(|id| id.unwrap_or(NONE));
            if across != node.across {
                self.node_mut(id).across = across;
            }
        }
    }

    /// Replaces the costs between the nodes of a cluster. Returns whether that changed them.
    pub(crate) fn set_costs(&mut self, cluster: u32, costs: &[FixedCost]) -> bool {
        let is_new = *self.cluster(cluster).costs != *costs;
        if is_new {
            self.cluster_mut(cluster).costs = costs.into();
        }
        is_new
    }
}
