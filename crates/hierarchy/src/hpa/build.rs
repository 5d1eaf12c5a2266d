//! Making the abstract graph, wholly or where the map changed (Botea 2004, Sections 3.1 and 3.2).

use std::sync::Arc;

use mediant_grid::{BitMatrix, Grid, Interrupt, Interrupted, Vertex};
use mediant_moves::{CostTable, FiniteK};

use super::{
    DURING,
    bits::{BitCells, BitSearch},
    cluster_search::ClusterSearch,
    fixed_cost::FixedCost,
    join::Part,
    level::{Bounds, Level, LevelEdit, NONE, Node, Shape},
};
use crate::window::{low_bits, rows_of};

/// An entrance at least this wide has a transition at either end, a narrower one has one in the middle
/// (Section 3.1).
const WIDE: u32 = 6;

/// The clusters whose nodes are made between two questions of an interrupt.
const CLUSTERS: usize = 64;

/// Levels are made of these.
pub(crate) struct Builder<'b> {
    pub(crate) grid: &'b Grid,
    pub(crate) k: FiniteK,
    /// The costs of paths on an empty grid.
    pub(crate) costs: &'b CostTable,
    pub(crate) interrupt: &'b Interrupt,
}

/// Clusters of a level, in ascending order, of which something is to be made anew.
pub(crate) struct Dirty {
    /// The clusters whose nodes may change.
    pub(crate) nodes: Vec<u32>,
    /// The clusters in which costs may change, even if the nodes stay.
    pub(crate) costs: Vec<u32>,
}

impl Dirty {
    /// All clusters of a level.
    pub(crate) fn all(level: &Shape) -> Self {
        let all: Vec<u32> = (0..level.count()).collect();
        Self { nodes: all.clone(), costs: all }
    }

    /// The clusters of the next level that depend on what changed in the one below: an upper cluster's nodes
    /// are those below from which a step leads out of it, its costs come from those of its parts.
    fn above(level: &Shape, below: &Shape, changed: &Self) -> Self {
        let nodes = level.parents(below, &below.with_neighbors(&changed.nodes));
        Self { nodes, costs: level.parents(below, &changed.costs) }
    }
}

impl Builder<'_> {
    /// Rebuilds what is dirty on the lowest level, and all that depends on it. A level of which nothing
    /// changes is the one that was handed in.
    pub(crate) fn rebuild(
        &self,
        levels: impl IntoIterator<Item = Arc<Level>>,
        mut dirty: Dirty,
    ) -> Result<Box<[Arc<Level>]>, Interrupted> {
        let mut rebuilt: Vec<Arc<Level>> = Vec::new();
        for level in levels {
            let below = rebuilt.last();
            if let Some(below) = below {
                dirty = Dirty::above(&level, below, &dirty);
            }
            if dirty.nodes.is_empty() && dirty.costs.is_empty() {
                rebuilt.push(level);
                continue;
            }
            let mut edit = level.edit();
            let nodes = self.rebuild_nodes(&mut edit, below, &dirty.nodes)?;
            let mut costs = union(&dirty.costs, &nodes);
            match below {
                None => self.find_lowest_costs(&mut edit, &mut costs)?,
                Some(below) => self.find_upper_costs(&mut edit, below, &mut costs)?,
            }
            dirty = Dirty { costs: union(&costs, &nodes), nodes };
            rebuilt.push(Arc::new(edit.finish()));
        }
        Ok(rebuilt.into())
    }

    /// Rebuilds the nodes of clusters. Returns the clusters whose nodes changed.
    pub(crate) fn rebuild_nodes(
        &self,
        level: &mut LevelEdit,
        below: Option<&Arc<Level>>,
        clusters: &[u32],
    ) -> Result<Vec<u32>, Interrupted> {
        let (mut cells, mut changed) = (Vec::new(), Vec::new());
        for (number, &id) in clusters.iter().enumerate() {
            self.interrupt.check_every(CLUSTERS, number, DURING)?;
            cells.clear();
            match below {
                None => lowest_cells(level, self.grid, id, &mut cells),
                Some(below) => upper_cells(level, below, self.grid, id, &mut cells),
            }
            if level.set_nodes(id, &cells) {
                changed.push(id);
            }
        }
        for (number, id) in level.with_neighbors(&changed).into_iter().enumerate() {
            self.interrupt.check_every(CLUSTERS, number, DURING)?;
            level.join_across(id);
        }
        Ok(changed)
    }

    /// Finds the costs between the nodes of clusters of the lowest level: Dijkstra's algorithm over the cells
    /// of each. Keeps of the clusters those in which a cost changed.
    fn find_lowest_costs(&self, level: &mut LevelEdit, clusters: &mut Vec<u32>) -> Result<(), Interrupted> {
        let mut search = LowestSearch::new(self);
        let mut costs = Vec::new();
        keep_changed(clusters, |id| {
            search.find(level.bounds(id, self.grid), level.nodes_of(id), &mut costs)?;
            Ok(level.set_costs(id, &costs))
        })
    }

    /// Finds the costs between the nodes of clusters of an upper level, from those within the clusters of the
    /// level below. Keeps of the clusters those in which a cost changed.
    fn find_upper_costs(
        &self,
        level: &mut LevelEdit,
        below: &Level,
        clusters: &mut Vec<u32>,
    ) -> Result<(), Interrupted> {
        let mut costs = Vec::new();
        keep_changed(clusters, |id| {
            self.interrupt.check(DURING)?;
            // All nodes of a part lead out of it, and so do those of the whole.
            let rows = below.within(level.bounds(id, self.grid)).map(|row| {
                let parts = row.map(|child| Part::cluster(below, child, below.bounds(child, self.grid)));
                parts.reduce(|left, right| left.joined(&right, below))
            });
            let whole = rows.flatten().reduce(|upper, lower| upper.joined(&lower, below));
            costs.clear();
            costs.extend(whole.iter().flat_map(Part::fixed_costs));
            Ok(level.set_costs(id, &costs))
        })
    }
}

/// The clusters of two lists in ascending order, as one.
fn union(one: &[u32], other: &[u32]) -> Vec<u32> {
    let mut both = [one, other].concat();
    both.sort_unstable();
    both.dedup();
    both
}

/// Keeps those clusters for which `find` says that something changed.
fn keep_changed(
    clusters: &mut Vec<u32>,
    mut find: impl FnMut(u32) -> Result<bool, Interrupted>,
) -> Result<(), Interrupted> {
    let mut result = Ok(());
    clusters.retain(|&id| {
        result.is_ok()
            && find(id).unwrap_or_else(|error| {
                result = Err(error);
                false
            })
    });
    result
}

/// The searches within clusters of the lowest level, with their scratch memory.
struct LowestSearch<'b> {
    builder: &'b Builder<'b>,
    small: BitSearch,
    /// Made when first needed.
    large: Option<ClusterSearch>,
    cells: Vec<u32>,
    sets: Vec<u128>,
}

impl<'b> LowestSearch<'b> {
    fn new(builder: &'b Builder<'b>) -> Self {
        let small = BitSearch::new(builder.k);
        Self { builder, small, large: None, cells: Vec::new(), sets: Vec::new() }
    }

    /// Writes to `costs` those from each of the nodes of a cluster to each, row by row.
    fn find(
        &mut self,
        bounds: Bounds,
        nodes: &[Node],
        costs: &mut Vec<FixedCost>,
    ) -> Result<(), Interrupted> {
        let Self { builder, small, large, cells, sets } = self;
        let &Builder { grid, k, costs: empty, interrupt } = *builder;
        let (window, count) = (bounds.window(grid), nodes.len());
        cells.clear();
        cells.extend(nodes.iter().map(|node| window.cell(node.at())));
        // On an empty window there is nothing to search.
        let of_bits = BitCells::new(&window).filter(|_| !window.is_free());
        if of_bits.is_some() {
            sets.clear();
            sets.extend(cells.iter().map(|&cell| BitCells::cell(cell)));
        }
        costs.clear();
        costs.resize(count * count, FixedCost::NONE);
        for (from, &cell) in cells.iter().enumerate() {
            interrupt.check(DURING)?;
            costs[from * count + from] = FixedCost::ZERO;
            let later = &mut costs[from * count..][from + 1..count];
            if let Some(of_bits) = &of_bits {
                small.find(of_bits, sets[from], &sets[from + 1..], later);
                continue;
            }
            let search = large.get_or_insert_with(|| ClusterSearch::new(k));
            let targets = &cells[from + 1..];
            search.flood(empty, &window, cell, &rows_of(targets), &mut ());
            for (cost, &target) in later.iter_mut().zip(targets) {
                *cost = FixedCost::new(search.cost(target));
            }
        }
        // Costs hold in both directions.
        for from in 0..count {
            for to in 0..from {
                costs[from * count + to] = costs[to * count + from];
            }
        }
        Ok(())
    }
}

/// Writes to `cells` those cells of a cluster of the lowest level at which transitions end, row by row. They
/// have no node below.
fn lowest_cells(level: &Shape, grid: &Grid, id: u32, cells: &mut Vec<(Vertex, u32)>) {
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
fn upper_cells(level: &Shape, below: &Level, grid: &Grid, id: u32, cells: &mut Vec<(Vertex, u32)>) {
    let bounds = level.bounds(id, grid);
    for child in below.within(bounds).flatten() {
        let first = below.first_node(child);
        for (node, number) in below.nodes_of(child).iter().zip(first..) {
            if node.across().any(|other| !bounds.contains(below.node(other).at())) {
                cells.push((node.at(), number));
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
