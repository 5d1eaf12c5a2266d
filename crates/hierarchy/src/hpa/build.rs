//! Making the abstract graph, wholly or where the map changed (Botea 2004, Sections 3.1 and 3.2).

use std::sync::Arc;

use mediant_grid::{BitMatrix, Grid, Interrupt, Interrupted, Vertex, room_for};
use mediant_moves::{CostTable, FiniteK};

use super::{
    DURING,
    join::Joins,
    level::{Bounds, Level, LevelEdit, NONE, Shape},
    lowest::LowestSearch,
};
use crate::window::low_bits;

/// An entrance at least this wide has a transition at either end, a narrower one has one in the middle
/// (Section 3.1).
const WIDE: u32 = 6;

/// The clusters whose nodes are made between two questions of an interrupt.
const CLUSTERS: usize = 64;
/// The memory of a cluster's costs that is asked for before they are found; few clusters take more.
const BYTES: usize = 1 << 13;

/// Levels are made of these.
pub(crate) struct Builder<'b> {
    pub(crate) grid: &'b Grid,
    /// The map of the levels as they are.
    pub(crate) before: &'b Grid,
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
            dirty = self.rebuild_level(&mut edit, below, &dirty)?;
            rebuilt.push(Arc::new(edit.finish()));
        }
        Ok(rebuilt.into())
    }

    /// Rebuilds what is dirty on a level. Returns the clusters that changed.
    fn rebuild_level(
        &self,
        level: &mut LevelEdit,
        below: Option<&Arc<Level>>,
        dirty: &Dirty,
    ) -> Result<Dirty, Interrupted> {
        let (mut lowest, mut joins) = (LowestSearch::new(self), Joins::default());
        let mut cells = Vec::new();
        let mut changed = Dirty { nodes: Vec::new(), costs: Vec::new() };
        let ids = union(&dirty.nodes, &dirty.costs);
        for (number, &id) in ids.iter().enumerate() {
            self.interrupt.check(DURING)?;
            // A repair of a few clusters takes less time than to ask.
            if ids.len() > CLUSTERS && number.is_multiple_of(CLUSTERS) {
                room_for::<[u8; BYTES]>(CLUSTERS, DURING)?;
            }
            self.find_cells((level, id), below, &mut cells);
            let mut is_new = false;
            if dirty.costs.binary_search(&id).is_ok() || !level.has_nodes_at(id, &cells) {
                let bounds = level.bounds(id, self.grid);
                let costs = match below {
                    None => lowest.find(bounds, (level.nodes_of(id), level.costs_of(id)), &cells)?,
                    Some(below) => joins.find(below, self.grid, bounds),
                };
                is_new = level.set_costs(id, costs);
            }
            let moved = level.set_nodes(id, &cells);
            if moved {
                changed.nodes.push(id);
            }
            if moved || is_new {
                changed.costs.push(id);
            }
        }
        self.join_across(level, &changed.nodes)?;
        Ok(changed)
    }

    /// Makes the nodes of a level that has none, without their costs.
    pub(crate) fn make_nodes(
        &self,
        level: &mut LevelEdit,
        below: Option<&Arc<Level>>,
    ) -> Result<(), Interrupted> {
        let (all, mut cells) = (Dirty::all(level).nodes, Vec::new());
        for (number, &id) in all.iter().enumerate() {
            self.interrupt.check_every(CLUSTERS, number, DURING)?;
            self.find_cells((level, id), below, &mut cells);
            level.set_nodes(id, &cells);
        }
        self.join_across(level, &all)
    }

    /// Writes to `cells` those of a cluster that are nodes, each with its node on the level below.
    fn find_cells(
        &self,
        (level, id): (&Shape, u32),
        below: Option<&Arc<Level>>,
        cells: &mut Vec<(Vertex, u32)>,
    ) {
        cells.clear();
        match below {
            None => lowest_cells(level, self.grid, id, cells),
            Some(below) => upper_cells(level, below, self.grid, id, cells),
        }
    }

    /// Joins the nodes of clusters, which moved, with those of their neighbors.
    fn join_across(&self, level: &mut LevelEdit, moved: &[u32]) -> Result<(), Interrupted> {
        for (number, (id, sides)) in level.facing(moved).into_iter().enumerate() {
            self.interrupt.check_every(CLUSTERS, number, DURING)?;
            level.join_across(id, sides);
        }
        Ok(())
    }
}

/// The clusters of two lists in ascending order, as one.
fn union(one: &[u32], other: &[u32]) -> Vec<u32> {
    let mut both = [one, other].concat();
    both.sort_unstable();
    both.dedup();
    both
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
        let (first, within) = (below.first_node(child), below.bounds(child, grid));
        let outer = bounds.common_sides(within);
        for (node, number) in below.nodes_of(child).iter().zip(first..) {
            if below.sides(node, within) & outer != 0 {
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
