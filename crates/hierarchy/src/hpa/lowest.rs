//! The costs between the nodes of clusters of the lowest level: all of them, or those that a change may
//! alter.
//!
//! A cell that changes alters the moves from and to it, and the diagonal moves past it. A shortest path that
//! takes one of them leads through the cell, or can be led through it by a detour of at most 2 − √2. So one
//! search from the cell tells which pairs of nodes may have a path that is lost or gained. In the map in
//! which the cell is free, the costs from it to both must add up to no more than the known cost and the
//! detour. Only between these nodes, and from nodes that are new, is searched again.

use mediant_grid::{Interrupted, Vertex};
use mediant_moves::FiniteK;

use super::{
    DURING,
    bits::{BitCells, BitSearch},
    build::Builder,
    cluster_search::ClusterSearch,
    fixed_cost::FixedCost,
    level::{Bounds, Node},
};
use crate::window::{MAX_SIDE, Window, insert};

/// Where so many nodes come to each changed cell, what it alters is found by searches from the cells.
const MOST_CHANGED: u32 = 3;

/// A set of nodes of a cluster: a bit for each. There are at most 128, every other cell along four sides.
type Nodes = u128;

/// The searches within clusters of the lowest level, with their scratch memory.
pub(crate) struct LowestSearch<'b> {
    builder: &'b Builder<'b>,
    small: BitSearch,
    /// Made when first needed.
    large: Option<ClusterSearch>,
    /// The cells of the nodes, in their window.
    cells: Vec<u32>,
    /// The nodes that there were before the change, with the numbers that they had.
    kept: Vec<(usize, usize)>,
    /// The costs from each node to each, row by row.
    costs: Vec<FixedCost>,
    /// Of each node, those to which the cost is to be found.
    unknown: Vec<Nodes>,
    /// The numbers of them.
    lacking: Vec<u32>,
    /// The costs that a search has found.
    found: Vec<FixedCost>,
}

/// A cluster in which is searched.
struct Searched {
    window: Window,
    is_free: bool,
    bits: Option<BitCells>,
}

impl Searched {
    fn new(window: Window) -> Self {
        Self { is_free: window.is_free(), bits: BitCells::new(&window), window }
    }
}

impl<'b> LowestSearch<'b> {
    pub(crate) fn new(builder: &'b Builder<'b>) -> Self {
        Self {
            builder,
            small: BitSearch::new(builder.k),
            large: None,
            cells: Vec::new(),
            kept: Vec::new(),
            costs: Vec::new(),
            unknown: Vec::new(),
            lacking: Vec::new(),
            found: Vec::new(),
        }
    }

    /// The costs from each of the nodes at `new` cells of a cluster to each, row by row. `old` are its nodes
    /// before the change, with their costs.
    pub(crate) fn find(
        &mut self,
        bounds: Bounds,
        (old, known): (&[Node], &[FixedCost]),
        new: &[(Vertex, u32)],
    ) -> Result<&[FixedCost], Interrupted> {
        let count = new.len();
        let after = Searched::new(bounds.window(self.builder.grid));
        self.cells.clear();
        self.cells.extend(new.iter().map(|&(at, _)| after.window.cell(at)));
        self.costs.clear();
        self.costs.resize(count * count, FixedCost::NONE);
        (0..count).for_each(|node| self.costs[node * count + node] = FixedCost::ZERO);
        let kept = self.keep((old, known), new);
        let all = (0..count).fold(0, |nodes, node| nodes | 1 << node);
        self.unknown.clear();
        self.unknown.extend((0..count).map(|node| {
            let unknown = if kept >> node & 1 == 0 { all } else { all & !kept };
            unknown & !(1 << node)
        }));
        if kept != 0 {
            self.suspect_changed(bounds, &after, (kept, all))?;
        }
        self.lacking.clear();
        self.lacking.extend(self.unknown.iter().map(|unknown| unknown.count_ones()));
        // From the nodes first that lack most: few searches find all.
        while let Some((from, _)) = (0..)
            .zip(&self.lacking)
            .filter(|&(_, &lacking)| lacking > 0)
            .min_by_key(|&(_, &lacking)| !lacking)
        {
            let to = self.unknown[from];
            self.search(&after, self.cells[from], to)?;
            self.lacking[from] = 0;
            for node in each(to) {
                self.unknown[node] &= !(1 << from);
                self.lacking[node] -= 1;
                // Costs hold in both directions.
                self.costs[from * count + node] = self.found[node];
                self.costs[node * count + from] = self.found[node];
            }
        }
        Ok(&self.costs)
    }

    /// Takes over what was known before the change. Returns the nodes that there were.
    fn keep(&mut self, (old, known): (&[Node], &[FixedCost]), new: &[(Vertex, u32)]) -> Nodes {
        // In both lists the nodes come row by row.
        let row_by_row = |at: Vertex| (at.y, at.x);
        let mut rest = (0..old.len()).peekable();
        self.kept.clear();
        self.kept.extend((0..).zip(new).filter_map(|(node, &(at, _))| {
            while rest.next_if(|&before| row_by_row(old[before].at()) < row_by_row(at)).is_some() {}
            Some((node, rest.next_if(|&before| old[before].at() == at)?))
        }));
        for &(from, from_before) in &self.kept {
            let row = &mut self.costs[from * new.len()..][..new.len()];
            let known = &known[from_before * old.len()..][..old.len()];
            self.kept.iter().for_each(|&(to, to_before)| row[to] = known[to_before]);
        }
        self.kept.iter().fold(0, |nodes, &(node, _)| nodes | 1 << node)
    }

    /// Adds to `unknown` the pairs of kept nodes between which the change may alter the cost.
    fn suspect_changed(
        &mut self,
        bounds: Bounds,
        after: &Searched,
        (kept, all): (Nodes, Nodes),
    ) -> Result<(), Interrupted> {
        let before = Searched::new(bounds.window(self.builder.before));
        let changed = |y: usize| before.window.free[y] ^ after.window.free[y];
        let rows = 0..after.window.height as usize;
        let count: u32 = rows.clone().map(|y| changed(y).count_ones()).sum();
        if count * MOST_CHANGED > self.cells.len() as u32 {
            for node in each(kept) {
                self.unknown[node] = all & !(1 << node);
            }
            return Ok(());
        }
        for y in rows {
            for x in each(changed(y).into()) {
                let is_blocked = before.window.free[y] >> x & 1 == 1;
                let cell = MAX_SIDE * y as u32 + x as u32;
                self.search(if is_blocked { &before } else { after }, cell, kept)?;
                self.suspect(kept, is_blocked);
            }
        }
        Ok(())
    }

    /// Adds to `unknown` the pairs of kept nodes between which a shortest path may lead past the cell that
    /// the last search began at.
    fn suspect(&mut self, kept: Nodes, is_blocked: bool) {
        let Self { builder, unknown, found, costs, .. } = self;
        // In units of costs: 2 − √2, and what three costs are rounded by. Four neighbors have neither, and
        // there a cell that opens only matters where the path through it is shorter.
        let detour = if builder.k == FiniteK::N4 { u64::from(is_blocked) } else { 38_392 + 3 };
        let count = unknown.len();
        let reached =
            each(kept).filter(|&node| found[node] != FixedCost::NONE).fold(0, |all, node| all | 1 << node);
        for from in each(reached) {
            let row = &costs[from * count..][..count];
            let there = u64::from(found[from].to_bits());
            for to in each(reached & !1 << from) {
                if there + u64::from(found[to].to_bits()) < u64::from(row[to].to_bits()) + detour {
                    unknown[from] |= 1 << to;
                    unknown[to] |= 1 << from;
                }
            }
        }
    }

    /// Finds the costs from a cell to nodes.
    fn search(&mut self, at: &Searched, from: u32, nodes: Nodes) -> Result<(), Interrupted> {
        let Self { builder, small, large, cells, found, .. } = self;
        builder.interrupt.check(DURING)?;
        found.resize(cells.len(), FixedCost::NONE);
        if at.is_free {
            let from = at.window.vertex(from);
            for node in each(nodes) {
                found[node] =
                    FixedCost::new(Some(builder.costs.distance(from.to(at.window.vertex(cells[node])))));
            }
        } else if let Some(bits) = &at.bits {
            let targets = each(nodes).fold(0, |all, node| all | BitCells::cell(cells[node]));
            small.find(bits, BitCells::cell(from), targets);
            each(nodes).for_each(|node| found[node] = small.cost(cells[node]));
        } else {
            let search = large.get_or_insert_with(|| ClusterSearch::new(builder.k));
            let mut targets = [0; MAX_SIDE as usize];
            each(nodes).for_each(|node| insert(&mut targets, cells[node]));
            search.flood(builder.costs, &at.window, from, &targets, &mut ());
            each(nodes).for_each(|node| found[node] = FixedCost::new(search.cost(cells[node])));
        }
        Ok(())
    }
}

/// The numbers of the nodes of a set.
fn each(mut nodes: Nodes) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let first = (nodes != 0).then(|| nodes.trailing_zeros() as usize)?;
        nodes &= nodes - 1;
        Some(first)
    })
}
