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
    level::{Bounds, Level, LevelEdit, NONE, Shape},
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

/// A cluster of which something is made anew.
#[derive(Clone, Copy)]
pub(crate) struct Rebuilt {
    id: u32,
    /// Whether its nodes are others.
    has_other_nodes: bool,
}

impl Builder<'_> {
    /// Rebuilds these clusters of the lowest level, in ascending order, and all that depends on them. A level
    /// of which nothing changes is the one that was handed in.
    pub(crate) fn rebuild(
        &self,
        levels: impl IntoIterator<Item = Arc<Level>>,
        mut dirty: Vec<u32>,
    ) -> Result<Box<[Arc<Level>]>, Interrupted> {
        let mut rebuilt: Vec<Arc<Level>> = Vec::new();
        for level in levels {
            let below = rebuilt.last();
            if let Some(below) = below {
                dirty = level.parents(below, &dirty);
            }
            if !dirty.is_empty() {
                let mut edit = level.edit();
                let clusters = self.rebuild_nodes(&mut edit, below, &dirty)?;
                dirty = match below {
                    None => self.find_lowest_costs(&mut edit, &clusters)?,
                    Some(below) => self.find_upper_costs(&mut edit, below, &clusters)?,
                };
                rebuilt.push(Arc::new(edit.finish()));
            } else {
                rebuilt.push(level);
            }
        }
        Ok(rebuilt.into())
    }

    /// Rebuilds the nodes of a level in the dirty clusters, and in their neighbors, whose entrances may have
    /// changed with them. Returns the clusters whose costs must be found again: the dirty ones, and the
    /// neighbors whose nodes changed.
    pub(crate) fn rebuild_nodes(
        &self,
        level: &mut LevelEdit,
        below: Option<&Arc<Level>>,
        dirty: &[u32],
    ) -> Result<Vec<Rebuilt>, Interrupted> {
        let mut cells = Vec::new();
        let (mut rebuilt, mut changed) = (Vec::new(), Vec::new());
        let with_neighbors = level.with_neighbors(dirty);
        let mut dirty = dirty.iter().peekable();
        for (number, id) in with_neighbors.into_iter().enumerate() {
            self.interrupt.check_every(CLUSTERS, number, DURING)?;
            let is_dirty = dirty.next_if_eq(&&id).is_some();
            cells.clear();
            match below {
                None => lowest_cells(level, self.grid, id, &mut cells),
                Some(below) => upper_cells(level, below, self.grid, id, &mut cells),
            }
            let has_other_nodes = level.set_nodes(id, &cells);
            if has_other_nodes {
                changed.push(id);
            }
            if is_dirty || has_other_nodes {
                rebuilt.push(Rebuilt { id, has_other_nodes });
            }
        }
        for (number, id) in level.with_neighbors(&changed).into_iter().enumerate() {
            self.interrupt.check_every(CLUSTERS, number, DURING)?;
            level.join_across(id);
        }
        Ok(rebuilt)
    }

    /// Finds the costs between the nodes of clusters of the lowest level: Dijkstra's algorithm over the cells
    /// of each. Returns the clusters of which nodes or costs changed.
    fn find_lowest_costs(
        &self,
        level: &mut LevelEdit,
        clusters: &[Rebuilt],
    ) -> Result<Vec<u32>, Interrupted> {
        let (mut bit_search, mut cluster_search) = (BitSearch::new(self.k), None);
        let (mut costs, mut changed) = (Vec::new(), Vec::new());
        for &Rebuilt { id, has_other_nodes } in clusters {
            let window = level.bounds(id, self.grid).window(self.grid);
            let cells: Vec<u32> = level.nodes_of(id).iter().map(|node| window.cell(node.at())).collect();
            let small = BitCells::new(&window).filter(|_| !window.is_free());
            let sets: Vec<_> =
                cells.iter().filter(|_| small.is_some()).map(|&cell| BitCells::cell(cell)).collect();
            let count = cells.len();
            costs.clear();
            costs.resize(count * count, FixedCost::NONE);
            for (from, &cell) in cells.iter().enumerate() {
                self.interrupt.check(DURING)?;
                costs[from * count + from] = FixedCost::ZERO;
                let later = &mut costs[from * count..][from + 1..count];
                if let Some(small) = &small {
                    bit_search.find(small, sets[from], &sets[from + 1..], later);
                } else {
                    let search = cluster_search.get_or_insert_with(|| ClusterSearch::new(self.k));
                    let targets = &cells[from + 1..];
                    search.flood(self.costs, &window, cell, &rows_of(targets), &mut ());
                    let found = targets.iter().map(|&target| FixedCost::new(search.cost(target)));
                    later.iter_mut().zip(found).for_each(|(cost, found)| *cost = found);
                }
            }
            // Costs hold in both directions.
            for from in 0..count {
                for to in 0..from {
                    costs[from * count + to] = costs[to * count + from];
                }
            }
            if level.set_costs(id, &costs) || has_other_nodes {
                changed.push(id);
            }
        }
        Ok(changed)
    }

    /// Finds the costs between the nodes of clusters of an upper level, from those within the clusters of the
    /// level below. Returns the clusters of which nodes or costs changed.
    fn find_upper_costs(
        &self,
        level: &mut LevelEdit,
        below: &Level,
        clusters: &[Rebuilt],
    ) -> Result<Vec<u32>, Interrupted> {
        let (mut costs, mut changed) = (Vec::new(), Vec::new());
        for &Rebuilt { id, has_other_nodes } in clusters {
            self.interrupt.check(DURING)?;
            // All nodes of a part lead out of it, and so do those of the whole.
            let rows = below.within(level.bounds(id, self.grid)).map(|row| {
                let clusters = row.map(|child| Part::cluster(below, child, below.bounds(child, self.grid)));
                clusters.reduce(|left, right| left.joined(&right, below))
            });
            let joined = rows.flatten().reduce(|upper, lower| upper.joined(&lower, below));
            costs.clear();
            costs.extend(joined.iter().flat_map(Part::fixed_costs));
            if level.set_costs(id, &costs) || has_other_nodes {
                changed.push(id);
            }
        }
        Ok(changed)
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
