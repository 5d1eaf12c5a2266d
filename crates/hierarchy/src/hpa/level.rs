//! One level of the abstract graph: what the transitions between clusters are, and what lies between them within a cluster.

use mediant_grid::{Grid, Vertex};
use mediant_moves::Cost;

use crate::window::low_bits;

/// No node.
pub(crate) const NONE: u32 = u32::MAX;

/// Entrances as wide as this have a transition at either end, narrower ones one in the middle (Botea 2004, Section 3.1).
const WIDE: u32 = 6;

/// What a way within a cluster costs, in 2⁻¹⁶ cells, rounded up, so that no heuristic exceeds it. A path within a cluster of 256 × 256 cells is always shorter than 2¹⁶ cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Length(u32);

impl Length {
    /// That of a way that does not exist.
    pub(crate) const NONE: Self = Self(u32::MAX);
    pub(crate) const ZERO: Self = Self(0);
    const SHIFT: u32 = Cost::FRACTION_BITS - 16;

    pub(crate) fn of(cost: Option<Cost>) -> Self {
        let rounded = |cost: Cost| u32::try_from(cost.to_bits().div_ceil(1 << Self::SHIFT)).ok();
        cost.and_then(rounded).map_or(Self::NONE, Self)
    }

    #[inline]
    pub(crate) fn cost(self) -> Option<Cost> {
        (self != Self::NONE).then(|| Cost::from_bits(u64::from(self.0) << Self::SHIFT))
    }

    pub(crate) const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    pub(crate) const fn to_bits(self) -> u32 {
        self.0
    }
}

/// A cell at which a transition ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Node {
    x: u16,
    y: u16,
    pub(crate) cluster: u32,
    /// The nodes across the border; a cell in the corner of a cluster may have two.
    pub(crate) across: [u32; 2],
    /// The same cell's node on the level below.
    pub(crate) below: u32,
}

impl Node {
    pub(crate) const UNUSED: Self = Self { x: 0, y: 0, cluster: NONE, across: [NONE; 2], below: NONE };

    pub(crate) const fn new(at: Vertex, cluster: u32, below: u32) -> Self {
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

/// What is known of a cluster: how many nodes it has, and what it costs from each to each, row by row.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Cluster {
    pub(crate) count: u32,
    pub(crate) lengths: Box<[Length]>,
}

/// A level: the map cut into clusters of `side` × `side` cells, those at the right and lower edge smaller.
///
/// Node numbers do not move when another cluster changes: each cluster has `stride` of them, as many as it can need.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Level {
    pub(crate) side: u32,
    pub(crate) columns: u32,
    pub(crate) rows: u32,
    pub(crate) stride: u32,
    pub(crate) nodes: Box<[Node]>,
    pub(crate) clusters: Box<[Cluster]>,
}

/// A rectangle of cells: from the first column and row to those that are beyond it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Bounds {
    pub(crate) left: i32,
    pub(crate) top: i32,
    pub(crate) right: i32,
    pub(crate) bottom: i32,
}

impl Bounds {
    /// Everything.
    pub(crate) const ALL: Self = Self { left: 0, top: 0, right: i32::MAX, bottom: i32::MAX };

    #[inline]
    pub(crate) const fn contains(&self, at: Vertex) -> bool {
        at.x >= self.left && at.x < self.right && at.y >= self.top && at.y < self.bottom
    }
}

impl Level {
    /// A level without nodes. `unit` is the side of the clusters of the lowest level.
    pub(crate) fn new(grid: &Grid, side: u32, unit: u32) -> Self {
        let [columns, rows] = [grid.width(), grid.height()].map(|cells| cells.div_ceil(side));
        // On each of the four borders every other cell may be an entrance. On upper levels the corners of the clusters below may be nodes as well, which are joined with
        // those beside them.
        let on_border = if side == unit { unit.div_ceil(2) } else { unit.min(unit.div_ceil(2) + 2) };
        let stride = 4 * (side / unit) * on_border;
        let count = (columns * rows) as usize;
        Self {
            side,
            columns,
            rows,
            stride,
            nodes: vec![Node::UNUSED; count * stride as usize].into_boxed_slice(),
            clusters: vec![Cluster::default(); count].into_boxed_slice(),
        }
    }

    /// The cluster of a vertex.
    pub(crate) const fn cluster_at(&self, at: Vertex) -> u32 {
        at.y as u32 / self.side * self.columns + at.x as u32 / self.side
    }

    /// Whether there is a cluster around a vertex.
    const fn is_on(&self, at: Vertex) -> bool {
        at.x >= 0
            && at.y >= 0
            && at.x as u32 / self.side < self.columns
            && at.y as u32 / self.side < self.rows
    }

    /// The cells of a cluster, as far as the map goes.
    pub(crate) fn bounds(&self, cluster: u32, grid: &Grid) -> Bounds {
        let [left, top] = [cluster % self.columns, cluster / self.columns].map(|i| i * self.side);
        let right = (left + self.side).min(grid.width()) as i32;
        let bottom = (top + self.side).min(grid.height()) as i32;
        Bounds { left: left as i32, top: top as i32, right, bottom }
    }

    /// The clusters beside one: left, right, above, below.
    pub(crate) fn neighbors(&self, cluster: u32) -> impl Iterator<Item = u32> + use<> {
        let (x, y) = (cluster % self.columns, cluster / self.columns);
        let beside = [(x > 0, cluster.wrapping_sub(1)), (x + 1 < self.columns, cluster + 1)];
        let above_and_below =
            [(y > 0, cluster.wrapping_sub(self.columns)), (y + 1 < self.rows, cluster + self.columns)];
        beside.into_iter().chain(above_and_below).filter_map(|(exists, id)| exists.then_some(id))
    }

    /// The number of the first node of a cluster.
    #[inline]
    pub(crate) const fn first(&self, cluster: u32) -> u32 {
        cluster * self.stride
    }

    /// The nodes of a cluster, in the order of their numbers.
    #[inline]
    pub(crate) fn nodes_of(&self, cluster: u32) -> &[Node] {
        let first = self.first(cluster) as usize;
        &self.nodes[first..first + self.clusters[cluster as usize].count as usize]
    }

    #[inline]
    pub(crate) fn node(&self, id: u32) -> &Node {
        &self.nodes[id as usize]
    }

    /// What it costs from a node to each of its cluster.
    #[inline]
    pub(crate) fn row(&self, id: u32) -> &[Length] {
        let Cluster { count, lengths } = &self.clusters[self.node(id).cluster as usize];
        let (count, local) = (*count as usize, (id - self.first(self.node(id).cluster)) as usize);
        &lengths[local * count..(local + 1) * count]
    }

    /// The number of a cell's node within its cluster.
    pub(crate) fn find(&self, at: Vertex) -> Option<u32> {
        let cluster = self.cluster_at(at);
        let local = self.nodes_of(cluster).iter().position(|node| node.at() == at)?;
        Some(self.first(cluster) + local as u32)
    }

    /// Replaces the nodes of a cluster. Whether they are others than before.
    pub(crate) fn set_nodes(&mut self, cluster: u32, cells: &[(Vertex, u32)]) -> bool {
        let is_new = |node: &Node, &(at, below): &(Vertex, u32)| node.at() != at || node.below != below;
        let old = self.nodes_of(cluster);
        if old.len() == cells.len() && !old.iter().zip(cells).any(|(node, cell)| is_new(node, cell)) {
            return false;
        }
        debug_assert!(cells.len() <= self.stride as usize, "cluster {cluster} has {} nodes", cells.len());
        let first = self.first(cluster) as usize;
        let slots = &mut self.nodes[first..first + self.stride as usize];
        slots.fill(Node::UNUSED);
        for (slot, &(at, below)) in slots.iter_mut().zip(cells) {
            *slot = Node::new(at, cluster, below);
        }
        self.clusters[cluster as usize].count = cells.len() as u32;
        true
    }

    /// Joins the nodes of a cluster with those beside them across its borders. These are the two ends of a transition, or in the corners of clusters ends of
    /// different ones, between which there is a step as well.
    pub(crate) fn link(&mut self, cluster: u32) {
        let first = self.first(cluster);
        for id in first..first + self.clusters[cluster as usize].count {
            let at = self.node(id).at();
            let mut across = [(-1, 0), (1, 0), (0, -1), (0, 1)]
                .into_iter()
                .map(|d| at + d.into())
                .filter(|&other| self.is_on(other) && self.cluster_at(other) != cluster)
                .filter_map(|other| self.find(other));
            self.nodes[id as usize].across = [across.next(), across.next()].map(|id| id.unwrap_or(NONE));
        }
    }
}

/// The transitions across the border between a row (or column) of cells and the next one, of which `length` cells from `first` on belong to the clusters: a bit
/// for each.
pub(crate) fn transitions(here: u64, there: u64, length: u32) -> u64 {
    let mut open = !(here | there) & low_bits(length);
    let mut found = 0;
    while open != 0 {
        let first = open.trailing_zeros();
        let width = (open >> first).trailing_ones();
        let last = first + width - 1;
        found |= if width < WIDE { 1 << ((first + last) / 2) } else { 1 << first | 1 << last };
        open &= !(low_bits(width) << first);
    }
    found
}
