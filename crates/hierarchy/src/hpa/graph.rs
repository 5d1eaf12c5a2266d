//! The abstract graph: made, and mended where the map changed.

use mediant_grid::{BitMatrix, Centers, Grid, GridGraph, Rectangle, Vertex};
use mediant_moves::{Cost, CostTable, FiniteK};
use mediant_search::SearchTree;

use super::{
    level::{Bounds, Length, Level, NONE, transitions},
    search::{End, search},
};
use crate::{
    HierarchyError, check,
    window::{self, Local, Window, rows_of},
};

/// How the map of a [`ClusterGraph`] is cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Clustering {
    /// The side of the clusters of the lowest level, in cells: 2 to 64.
    pub side: u32,
    /// The number of levels, at least 1. On each but the lowest, a cluster is 2 × 2 of those of the level below; none may be longer than
    /// [`MAX_SIDE`](Self::MAX_SIDE).
    pub levels: u32,
}

impl Clustering {
    /// The longest side of a cluster of any level, in cells.
    pub const MAX_SIDE: u32 = 256;
    /// How many clusters of a level a cluster of the next one has on a side.
    pub(crate) const FACTOR: u32 = 2;

    /// The sides of the clusters, level by level.
    pub(crate) fn sides(self) -> Result<Vec<u32>, HierarchyError> {
        if !(2..=window::MAX_SIDE).contains(&self.side) {
            return Err(HierarchyError::Side { found: self.side, min: 2, max: window::MAX_SIDE });
        }
        let sides = (0..self.levels).map_while(|level| {
            let side = Self::FACTOR.checked_pow(level)?.checked_mul(self.side)?;
            (side <= Self::MAX_SIDE).then_some(side)
        });
        let sides: Vec<u32> = sides.collect();
        if sides.is_empty() || sides.len() != self.levels as usize {
            return Err(HierarchyError::Levels { found: self.levels, side: self.side });
        }
        Ok(sides)
    }
}

/// Clusters of 10 × 10 cells as in the paper (Section 4), and two levels above them.
impl Default for Clustering {
    fn default() -> Self {
        Self { side: 10, levels: 3 }
    }
}

/// The index of HPA*: the map in clusters, the transitions between them, and what it costs to cross a cluster from one transition to another (Botea, Müller & Schaeffer
/// 2004, Sections 3.1 and 3.2).
///
/// Along the border of two clusters, each run of cells that are free on both sides is an *entrance*: with one *transition* in its middle if it is narrower than six cells, else one at
/// either end. Immutable but for [`repair`](Self::repair); planners share it. Two are equal when they answer every query alike.
///
/// Clusters of the upper levels have the transitions across their borders, and what it costs to cross them follows from the level below.
#[derive(Clone, Debug)]
pub struct ClusterGraph {
    pub(crate) k: FiniteK,
    pub(crate) clustering: Clustering,
    pub(crate) size: (u32, u32),
    pub(crate) costs: CostTable,
    pub(crate) levels: Box<[Level]>,
}

impl PartialEq for ClusterGraph {
    fn eq(&self, other: &Self) -> bool {
        (self.k, self.clustering, self.size) == (other.k, other.clustering, other.size)
            && self.levels == other.levels
    }
}

impl Eq for ClusterGraph {}

impl ClusterGraph {
    /// The index of a map. On fourteen benchmark maps of up to 1024 × 1024 cells it takes 2 to 97 ms, longest in noise.
    ///
    /// # Errors
    /// [`HierarchyError`] for k above 3, for corners that may be cut, or a clustering that is out of range.
    pub fn new(grid_graph: &GridGraph<Centers>, clustering: Clustering) -> Result<Self, HierarchyError> {
        let mut graph = Self::without_nodes(grid_graph, clustering)?;
        let all = (0..graph.clusters() as u32).collect();
        graph.update(grid_graph.grid(), all);
        Ok(graph)
    }

    /// The index of a map without anything.
    pub(crate) fn without_nodes(
        grid_graph: &GridGraph<Centers>,
        clustering: Clustering,
    ) -> Result<Self, HierarchyError> {
        check::moves(grid_graph)?;
        let (grid, sides) = (grid_graph.grid(), clustering.sides()?);
        Ok(Self {
            k: grid_graph.k(),
            clustering,
            size: (grid.width(), grid.height()),
            costs: CostTable::new(grid_graph.k())?,
            levels: sides.into_iter().map(|side| Level::new(grid, side, clustering.side)).collect(),
        })
    }

    /// Makes anew what depends on the cells of a rectangle, in which alone `grid` may differ from the map that this is the index of. It is then equal to a new index of `grid`.
    ///
    /// These are the clusters that the rectangle touches, those beside them whose entrances changed, and all that these belong to on upper levels.
    ///
    /// # Errors
    /// [`HierarchyError::Size`] for a map of another size; nothing is changed then.
    pub fn repair(&mut self, grid: &Grid, changed: Rectangle) -> Result<(), HierarchyError> {
        check::size(self.size, grid)?;
        let level = &self.levels[0];
        let clusters = |first: u32, length: u32, cells: u32| {
            let cells = check::span(first, length, cells);
            if cells.is_empty() { 0..0 } else { cells.start / level.side..cells.end.div_ceil(level.side) }
        };
        let columns = clusters(changed.x, changed.width, self.size.0);
        let rows = clusters(changed.y, changed.height, self.size.1);
        let dirty = rows.flat_map(|y| columns.clone().map(move |x| y * level.columns + x)).collect();
        self.update(grid, dirty);
        Ok(())
    }

    /// How the map is cut.
    #[must_use]
    pub const fn clustering(&self) -> Clustering {
        self.clustering
    }

    /// The number of clusters of the lowest level.
    #[must_use]
    pub fn clusters(&self) -> usize {
        self.levels[0].clusters.len()
    }

    /// The number of cells at which transitions end.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.levels[0].clusters.iter().map(|cluster| cluster.count as usize).sum()
    }

    /// The memory that it takes, in bytes.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        self.levels
            .iter()
            .map(|level| {
                size_of_val(&*level.nodes)
                    + size_of_val(&*level.clusters)
                    + level.clusters.iter().map(|cluster| size_of_val(&*cluster.lengths)).sum::<usize>()
            })
            .sum()
    }

    /// Makes the nodes of all levels, without what it costs from one to the other.
    pub(crate) fn add_nodes(&mut self, grid: &Grid) {
        for number in 0..self.levels.len() {
            let all = (0..self.levels[number].clusters.len() as u32).collect();
            self.update_nodes(grid, number, all);
        }
    }

    /// Makes these clusters of the lowest level anew, and all that depends on them.
    fn update(&mut self, grid: &Grid, mut dirty: Vec<u32>) {
        for number in 0..self.levels.len() {
            dirty = self.update_nodes(grid, number, dirty);
            if number == 0 {
                self.update_lengths(grid, &dirty);
            } else {
                self.update_upper_lengths(grid, number, &dirty);
            }
            if let Some(upper) = self.levels.get(number + 1) {
                let level = &self.levels[number];
                let parents = dirty.iter().map(|&id| parent(level, upper, id));
                dirty = parents.collect();
                dirty.sort_unstable();
                dirty.dedup();
            }
        }
    }

    /// Makes the nodes of a level anew, where these clusters are others than before. Which clusters have other nodes or other ways between them.
    fn update_nodes(&mut self, grid: &Grid, number: usize, mut dirty: Vec<u32>) -> Vec<u32> {
        let (below, rest) = self.levels.split_at_mut(number);
        let level = &mut rest[0];
        let mut cells = Vec::new();
        // What changed in a cluster may have changed the entrances of those beside it.
        let mut beside: Vec<u32> = dirty.iter().flat_map(|&id| level.neighbors(id)).collect();
        beside.sort_unstable();
        beside.dedup();
        beside.retain(|id| dirty.binary_search(id).is_err());
        let mut nodes = |level: &mut Level, id: u32| {
            cells.clear();
            match below.last() {
                None => lowest_cells(level, grid, id, &mut cells),
                Some(below) => upper_cells(level, below, grid, id, &mut cells),
            }
            level.set_nodes(id, &cells)
        };
        for &id in &dirty {
            nodes(level, id);
        }
        beside.retain(|&id| nodes(level, id));
        dirty.append(&mut beside);
        dirty.sort_unstable();
        let mut linked: Vec<u32> = dirty.iter().flat_map(|&id| level.neighbors(id).chain([id])).collect();
        linked.sort_unstable();
        linked.dedup();
        for id in linked {
            level.link(id);
        }
        dirty
    }

    /// Finds what it costs from node to node, within clusters of the lowest level.
    fn update_lengths(&mut self, grid: &Grid, clusters: &[u32]) {
        let mut local = Local::new(self.k);
        let level = &mut self.levels[0];
        for &id in clusters {
            let bounds = level.bounds(id, grid);
            let window = window_of(grid, bounds);
            let cells: Vec<u32> = level.nodes_of(id).iter().map(|node| window.cell(node.at())).collect();
            let count = cells.len();
            let mut lengths = vec![Length::ZERO; count * count].into_boxed_slice();
            for (from, &cell) in cells.iter().enumerate() {
                let targets = &cells[from + 1..];
                local.spread(&self.costs, &window, cell, &rows_of(targets), &mut ());
                for (to, &target) in targets.iter().enumerate() {
                    let length = Length::of(local.cost(target));
                    lengths[from * count + from + 1 + to] = length;
                    lengths[(from + 1 + to) * count + from] = length;
                }
            }
            level.clusters[id as usize].lengths = lengths;
        }
    }

    /// Finds what it costs from node to node on the level below, within clusters of this one.
    fn update_upper_lengths(&mut self, grid: &Grid, number: usize, clusters: &[u32]) {
        let (below, rest) = self.levels.split_at_mut(number);
        let (Some(below), Some(level)) = (below.last(), rest.first_mut()) else { return };
        let mut labels = SearchTree::new(below.nodes.len() + 2);
        for &id in clusters {
            let bounds = level.bounds(id, grid);
            let nodes: Vec<u32> = level.nodes_of(id).iter().map(|node| node.below).collect();
            let lengths = nodes.iter().flat_map(|&from| {
                let end = End { cluster: below.node(from).cluster, row: below.row(from) };
                search(below, bounds, &mut labels, |_| Cost::ZERO, end, None, &mut ());
                let labels = &labels;
                nodes.iter().map(move |&to| Length::of(labels.cost(to))).collect::<Vec<_>>()
            });
            level.clusters[id as usize].lengths = lengths.collect();
        }
    }
}

/// The cluster of the next level that a cluster belongs to.
fn parent(level: &Level, upper: &Level, id: u32) -> u32 {
    let times = upper.side / level.side;
    id / level.columns / times * upper.columns + id % level.columns / times
}

/// The cells of a cluster of the lowest level.
pub(crate) fn window_of(grid: &Grid, bounds: Bounds) -> Window {
    let Bounds { left, top, right, bottom } = bounds;
    Window::of(grid, left, top, (right - left) as u32, (bottom - top) as u32)
}

/// The cells of the transitions on the borders of a cluster of the lowest level, row by row.
fn lowest_cells(level: &Level, grid: &Grid, id: u32, cells: &mut Vec<(Vertex, u32)>) {
    let Bounds { left, top, right, bottom } = level.bounds(id, grid);
    let (width, height) = ((right - left) as u32, (bottom - top) as u32);
    // Outside the map all is blocked, so that there are no transitions.
    let across = |rows: &BitMatrix, here: i32, there: i32, first: i32, length: u32| {
        transitions(rows.row(here).word(first), rows.row(there).word(first), length)
    };
    let [above, below] = [(top, top - 1), (bottom - 1, bottom)]
        .map(|(here, there)| across(grid.rows(), here, there, left, width));
    let [before, after] = [(left, left - 1), (right - 1, right)]
        .map(|(here, there)| across(grid.columns(), here, there, top, height));
    for y in top..bottom {
        let bit = |set: u64| set >> (y - top) & 1;
        let mut row = bit(before) | bit(after) << (width - 1);
        row |= if y == top { above } else { 0 };
        row |= if y == bottom - 1 { below } else { 0 };
        while row != 0 {
            cells.push((Vertex::new(left + row.trailing_zeros() as i32, y), NONE));
            row &= row - 1;
        }
    }
}

/// The nodes of the level below from which a transition leads out of a cluster.
fn upper_cells(level: &Level, below: &Level, grid: &Grid, id: u32, cells: &mut Vec<(Vertex, u32)>) {
    let bounds = level.bounds(id, grid);
    let columns = bounds.left as u32 / below.side..(bounds.right as u32).div_ceil(below.side);
    for y in bounds.top as u32 / below.side..(bounds.bottom as u32).div_ceil(below.side) {
        for child in columns.clone().map(|x| y * below.columns + x) {
            let first = below.first(child);
            for (node, number) in below.nodes_of(child).iter().zip(first..) {
                if node.across().any(|other| !bounds.contains(below.node(other).at())) {
                    cells.push((node.at(), number));
                }
            }
        }
    }
}
