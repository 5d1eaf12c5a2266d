//! The costs between the nodes of clusters of the lowest level: all of them, or those that a change may
//! alter.
//!
//! A cell that changes alters the moves from and to it, and the diagonal moves past it. A shortest path that
//! takes one of them leads through the cell, or can be led through it by a detour of at most 2 − √2. So one
//! search from the cell tells which pairs of nodes may have a path that is lost or gained. In the map in
//! which the cell is free, the costs from it to both must add up to no more than the known cost and the
//! detour. Only between these nodes, and from nodes that are new, is searched again.

use mediant_grid::{Interrupted, Vertex};

use super::{
    DURING,
    bits::{BitCells, BitSearch},
    build::Builder,
    cluster_search::ClusterSearch,
    fixed_cost::FixedCost,
    level::{Bounds, Node},
};
use crate::window::{MAX_SIDE, Window, insert};

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
    /// Of each node, the number that it had before the change, if any.
    before: Vec<Option<usize>>,
    /// Of each node, those to which the cost is to be found.
    unknown: Vec<Nodes>,
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
            before: Vec::new(),
            unknown: Vec::new(),
            found: Vec::new(),
        }
    }

    /// Writes to `costs` those from each of the nodes at `new` cells of a cluster to each, row by row. `old`
    /// are its nodes before the change, with their costs.
    pub(crate) fn find(
        &mut self,
        bounds: Bounds,
        old: (&[Node], &[FixedCost]),
        new: &[(Vertex, u32)],
        costs: &mut Vec<FixedCost>,
    ) -> Result<(), Interrupted> {
        let count = new.len();
        let after = Searched::new(bounds.window(self.builder.grid));
        self.cells.clear();
        self.cells.extend(new.iter().map(|&(at, _)| after.window.cell(at)));
        costs.clear();
        costs.resize(count * count, FixedCost::NONE);
        (0..count).for_each(|node| costs[node * count + node] = FixedCost::ZERO);
        self.keep(bounds, &after, old, new, costs)?;
        // From the nodes first that lack most: few searches find all.
        loop {
            let most = (0..count).max_by_key(|&node| (self.unknown[node].count_ones(), count - node));
            let Some((from, to)) = most.map(|from| (from, self.unknown[from])).filter(|&(_, to)| to != 0)
            else {
                return Ok(());
            };
            self.search(&after, self.cells[from], to)?;
            self.unknown[from] = 0;
            for node in each(to) {
                self.unknown[node] &= !(1 << from);
                // Costs hold in both directions.
                costs[from * count + node] = self.found[node];
                costs[node * count + from] = self.found[node];
            }
        }
    }

    /// Writes to `costs` those that were known before the change, and to `unknown` those that it may alter.
    fn keep(
        &mut self,
        bounds: Bounds,
        after: &Searched,
        (old, known): (&[Node], &[FixedCost]),
        new: &[(Vertex, u32)],
        costs: &mut [FixedCost],
    ) -> Result<(), Interrupted> {
        let count = new.len();
        // In both lists the nodes come row by row.
        let mut rest = (0..old.len()).peekable();
        self.before.clear();
        self.before.extend(new.iter().map(|&(at, _)| {
            let row_by_row = |at: Vertex| (at.y, at.x);
            while rest.next_if(|&node| row_by_row(old[node].at()) < row_by_row(at)).is_some() {}
            rest.next_if(|&node| old[node].at() == at)
        }));
        let all = (0..count).fold(0, |nodes, node| nodes | 1 << node);
        let mut kept =
            (0..count).filter(|&node| self.before[node].is_some()).fold(0, |all, node| all | 1 << node);
        let before = Searched::new(bounds.window(self.builder.before));
        let free = [&before, after].map(|cluster| &cluster.window.free[..after.window.height as usize]);
        let rows = free[0].iter().zip(free[1]).map(|(before, after)| before ^ after);
        let changed: u32 = rows.clone().map(u64::count_ones).sum();
        if changed as usize * 3 > count {
            kept = 0;
        }
        self.unknown.clear();
        self.unknown.extend((0..count).map(|node| {
            let unknown = if kept >> node & 1 == 0 { all } else { all & !kept };
            unknown & !(1 << node)
        }));
        for from in each(kept) {
            for to in each(kept) {
                let [from_before, to_before] = [from, to].map(|node| self.before[node].unwrap_or_default());
                costs[from * count + to] = known[from_before * old.len() + to_before];
            }
        }
        if kept.count_ones() < 2 || changed == 0 {
            return Ok(());
        }
        for (y, row) in (0..).zip(rows) {
            for x in each(row.into()) {
                let is_blocked = free[0][y as usize] >> x & 1 == 1;
                self.search(if is_blocked { &before } else { after }, MAX_SIDE * y + x as u32, kept)?;
                self.suspect(kept, is_blocked, costs);
            }
        }
        Ok(())
    }

    /// Adds to `unknown` the pairs between which a shortest path may lead by a cell, from which
    /// the last search went.
    fn suspect(&mut self, kept: Nodes, is_blocked: bool, costs: &[FixedCost]) {
        let Self { unknown, found, .. } = self;
        // A detour of 2 − √2 and three roundings, in the units of costs. Four neighbors have neither.
        let detour =
            if self.builder.k == mediant_moves::FiniteK::N4 { u64::from(is_blocked) } else { 38_392 + 3 };
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
