//! Making the abstract graph, wholly or where the map changed (Botea 2004, Sections 3.1 and 3.2).

use mediant_grid::{BitMatrix, Grid, Interrupt, Interrupted, Vertex};
use mediant_moves::Cost;
use mediant_search::parts::SearchTree;

use super::{
    DURING,
    cluster_search::ClusterSearch,
    fixed_cost::FixedCost,
    graph::ClusterGraph,
    level::{Bounds, Level, NONE},
    search::{Endpoint, search},
};
use crate::window::{low_bits, rows_of};

/// An entrance at least this wide has a transition at either end, a narrower one has one in the middle
/// (Section 3.1).
const WIDE: u32 = 6;

/// The clusters whose nodes are made between two questions of an interrupt.
const CLUSTERS: usize = 64;

impl ClusterGraph {
    /// Makes the nodes of all levels, without the costs between them.
    pub(crate) fn add_nodes(&mut self, grid: &Grid, interrupt: &Interrupt) -> Result<(), Interrupted> {
        for number in 0..self.levels.len() {
            let all = (0..self.levels[number].clusters.len() as u32).collect();
            self.rebuild_nodes(grid, number, all, interrupt)?;
        }
        Ok(())
    }

    /// Rebuilds these clusters of the lowest level, in ascending order, and all that depends on them.
    ///
    /// If it is interrupted, the graph is that of neither map.
    pub(crate) fn rebuild(
        &mut self,
        grid: &Grid,
        mut dirty: Vec<u32>,
        interrupt: &Interrupt,
    ) -> Result<(), Interrupted> {
        for number in 0..self.levels.len() {
            dirty = self.rebuild_nodes(grid, number, dirty, interrupt)?;
            if number == 0 {
                self.find_lowest_costs(grid, &dirty, interrupt)?;
            } else {
                self.find_upper_costs(grid, number, &dirty, interrupt)?;
            }
            if let Some(upper) = self.levels.get(number + 1) {
                let level = &self.levels[number];
                let parents = dirty.iter().map(|&id| parent(level, upper, id));
                dirty = parents.collect();
                dirty.sort_unstable();
                dirty.dedup();
            }
        }
        Ok(())
    }

    /// Rebuilds the nodes of a level in the dirty clusters, and in their neighbors, whose entrances may have
    /// changed with them. Returns the clusters whose costs must be found again: the dirty ones, and the
    /// neighbors whose nodes changed.
    fn rebuild_nodes(
        &mut self,
        grid: &Grid,
        number: usize,
        mut dirty: Vec<u32>,
        interrupt: &Interrupt,
    ) -> Result<Vec<u32>, Interrupted> {
        let (below, rest) = self.levels.split_at_mut(number);
        let level = &mut rest[0];
        let mut cells = Vec::new();
        let mut neighbors: Vec<u32> = dirty.iter().flat_map(|&id| level.neighbors(id)).collect();
        neighbors.sort_unstable();
        neighbors.dedup();
        neighbors.retain(|id| dirty.binary_search(id).is_err());
        let mut rebuild = |level: &mut Level, id: u32| {
            cells.clear();
            match below.last() {
                None => lowest_cells(level, grid, id, &mut cells),
                Some(below) => upper_cells(level, below, grid, id, &mut cells),
            }
            level.set_nodes(id, &cells)
        };
        for (number, &id) in dirty.iter().enumerate() {
            interrupt.check_every(CLUSTERS, number, DURING)?;
            rebuild(level, id);
        }
        neighbors.retain(|&id| rebuild(level, id));
        dirty.append(&mut neighbors);
        dirty.sort_unstable();
        let mut to_join: Vec<u32> = dirty.iter().flat_map(|&id| level.neighbors(id).chain([id])).collect();
        to_join.sort_unstable();
        to_join.dedup();
        for (number, id) in to_join.into_iter().enumerate() {
            interrupt.check_every(CLUSTERS, number, DURING)?;
            level.join_across(id);
        }
        Ok(dirty)
    }

    /// Finds the costs between the nodes of clusters of the lowest level: Dijkstra's algorithm over the cells
    /// of each.
    fn find_lowest_costs(
        &mut self,
        grid: &Grid,
        clusters: &[u32],
        interrupt: &Interrupt,
    ) -> Result<(), Interrupted> {
        let mut cluster_search = ClusterSearch::new(self.k);
        let level = &mut self.levels[0];
        for &id in clusters {
            let window = level.bounds(id, grid).window(grid);
            let cells: Vec<u32> = level.nodes_of(id).iter().map(|node| window.cell(node.at())).collect();
            let count = cells.len();
            let mut costs = vec![FixedCost::ZERO; count * count];
            for (from, &cell) in cells.iter().enumerate() {
                interrupt.check(DURING)?;
                let targets = &cells[from + 1..];
                cluster_search.flood(&self.costs, &window, cell, &rows_of(targets), &mut ());
                for (to, &target) in targets.iter().enumerate() {
                    let cost = FixedCost::new(cluster_search.cost(target));
                    costs[from * count + from + 1 + to] = cost;
                    costs[(from + 1 + to) * count + from] = cost;
                }
            }
            level.clusters[id as usize].costs = costs.into();
        }
        Ok(())
    }

    /// Finds the costs between the nodes of clusters of an upper level: Dijkstra's algorithm over the nodes
    /// of the level below.
    fn find_upper_costs(
        &mut self,
        grid: &Grid,
        number: usize,
        clusters: &[u32],
        interrupt: &Interrupt,
    ) -> Result<(), Interrupted> {
        let (below, rest) = self.levels.split_at_mut(number);
        let (Some(below), Some(level)) = (below.last(), rest.first_mut()) else { return Ok(()) };
        let mut tree = SearchTree::new(below.nodes.len() + 2);
        for &id in clusters {
            let bounds = level.bounds(id, grid);
            let nodes: Vec<u32> = level.nodes_of(id).iter().map(|node| node.below).collect();
            let mut costs = Vec::with_capacity(nodes.len() * nodes.len());
            for &from in &nodes {
                interrupt.check(DURING)?;
                let start = Endpoint { cluster: below.node(from).cluster, costs: below.costs_from(from) };
                search(below, bounds, &mut tree, |_| Cost::ZERO, start, None, &mut ());
                costs.extend(nodes.iter().map(|&to| FixedCost::new(tree.cost(to))));
            }
            level.clusters[id as usize].costs = costs.into();
        }
        Ok(())
    }
}

/// The cluster of the next level that contains a cluster.
fn parent(level: &Level, upper: &Level, id: u32) -> u32 {
    let factor = upper.side / level.side;
    id / level.columns / factor * upper.columns + id % level.columns / factor
}

/// Writes to `cells` those cells of a cluster of the lowest level at which transitions end, row by row. They
/// have no node below.
fn lowest_cells(level: &Level, grid: &Grid, id: u32, cells: &mut Vec<(Vertex, u32)>) {
    let Bounds { left, top, right, bottom } = level.bounds(id, grid);
    let (width, height) = ((right - left) as u32, (bottom - top) as u32);
    // Outside the map all is blocked, so that no transition leads there.
    let across = |rows: &BitMatrix, here: i32, there: i32, first: i32, length: u32| {
        transitions(rows.row(here).word(first), rows.row(there).word(first), length)
    };
    let [to_above, to_below] = [(top, top - 1), (bottom - 1, bottom)]
        .map(|(here, there)| across(grid.rows(), here, there, left, width));
    let [to_left, to_right] = [(left, left - 1), (right - 1, right)]
        .map(|(here, there)| across(grid.columns(), here, there, top, height));
    for y in top..bottom {
        let bit = |set: u64| set >> (y - top) & 1;
        let mut row = bit(to_left) | bit(to_right) << (width - 1);
        row |= if y == top { to_above } else { 0 };
        row |= if y == bottom - 1 { to_below } else { 0 };
        while row != 0 {
            cells.push((Vertex::new(left + row.trailing_zeros() as i32, y), NONE));
            row &= row - 1;
        }
    }
}

/// Writes to `cells` those nodes of the level below from which a transition leads out of a cluster.
fn upper_cells(level: &Level, below: &Level, grid: &Grid, id: u32, cells: &mut Vec<(Vertex, u32)>) {
    let bounds = level.bounds(id, grid);
    let columns = bounds.left as u32 / below.side..(bounds.right as u32).div_ceil(below.side);
    for y in bounds.top as u32 / below.side..(bounds.bottom as u32).div_ceil(below.side) {
        for child in columns.clone().map(|x| y * below.columns + x) {
            let first = below.first_node(child);
            for (node, number) in below.nodes_of(child).iter().zip(first..) {
                if node.across().any(|other| !bounds.contains(below.node(other).at())) {
                    cells.push((node.at(), number));
                }
            }
        }
    }
}

/// The transitions across the border between two adjacent rows (or columns) of cells. `here` and `there` have
/// a bit for each cell, set where it is blocked; the lowest `length` bits belong to the two clusters.
fn transitions(here: u64, there: u64, length: u32) -> u64 {
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
