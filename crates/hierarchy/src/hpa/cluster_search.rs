//! Searches over the cells of one cluster: the costs between its nodes, and the paths of a refinement.
//!
//! An index takes tens of thousands of them, so that everything here fits a window of 64 × 64 cells, whose
//! sets are words.

use std::{cmp::Reverse, collections::BinaryHeap};

use mediant_grid::VertexId;
use mediant_moves::{Cost, CostTable, FiniteK, Vector};
use mediant_search::{NodeEvent, Observer, parts::Entry};

use crate::window::{MAX_SIDE, Rows, Window, contains, insert};

/// Dijkstra's algorithm and A* within a window, with their scratch memory.
#[derive(Clone, Debug)]
pub(crate) struct ClusterSearch {
    axial: Cost,
    /// `None` for four neighbors.
    diagonal: Option<Cost>,
    cost: Box<[Cost]>,
    parent: Box<[u16]>,
    reached: Rows,
    closed: Rows,
    open: BinaryHeap<Reverse<Entry>>,
}

impl ClusterSearch {
    /// For 4- or 8-connected paths that never cut corners.
    pub(crate) fn new(k: FiniteK) -> Self {
        let cells = (MAX_SIDE * MAX_SIDE) as usize;
        Self {
            axial: Cost::of_move(Vector::new(1, 0)),
            diagonal: (k != FiniteK::N4).then(|| Cost::of_move(Vector::new(1, 1))),
            cost: vec![Cost::ZERO; cells].into_boxed_slice(),
            parent: vec![0; cells].into_boxed_slice(),
            reached: [0; MAX_SIDE as usize],
            closed: [0; MAX_SIDE as usize],
            open: BinaryHeap::new(),
        }
    }

    /// The cost from the first cell of the last search to a target; `None` if there is no path.
    pub(crate) fn cost(&self, cell: u32) -> Option<Cost> {
        contains(&self.closed, cell).then(|| self.cost[cell as usize])
    }

    /// The cell before another one on the path that the last [`path`](Self::path) found.
    pub(crate) fn parent(&self, cell: u32) -> u32 {
        u32::from(self.parent[cell as usize])
    }

    /// Finds the costs from a cell to all `targets`, to be read by [`cost`](Self::cost).
    pub(crate) fn flood(
        &mut self,
        costs: &CostTable,
        window: &Window,
        from: u32,
        targets: &Rows,
        observer: &mut impl Observer,
    ) {
        if !window.is_free() {
            return self.search(window, from, targets, |_| Cost::ZERO, observer);
        }
        let at = window.vertex(from);
        self.closed = *targets;
        for (mut row, first) in targets.iter().copied().zip((0..).step_by(MAX_SIDE as usize)) {
            while row != 0 {
                let cell = first + row.trailing_zeros();
                self.cost[cell as usize] = costs.distance(at.to(window.vertex(cell)));
                row &= row - 1;
            }
        }
    }

    /// Finds a shortest path from one cell to another, to be read by [`parent`](Self::parent). Returns
    /// whether there is one.
    pub(crate) fn path(
        &mut self,
        costs: &CostTable,
        window: &Window,
        from: u32,
        to: u32,
        observer: &mut impl Observer,
    ) -> bool {
        let mut target = [0; MAX_SIDE as usize];
        insert(&mut target, to);
        let goal = window.vertex(to);
        self.search(window, from, &target, |cell| costs.distance(window.vertex(cell).to(goal)), observer);
        contains(&self.closed, to)
    }

    /// Finds shortest paths from a cell until all targets are closed, or the open list is empty. `estimate`
    /// is a consistent lower bound on the cost from a cell to the targets.
    fn search(
        &mut self,
        window: &Window,
        from: u32,
        targets: &Rows,
        estimate: impl Fn(u32) -> Cost,
        observer: &mut impl Observer,
    ) {
        let rows = window.height as usize;
        let mut targets_left: u32 = targets[..rows].iter().map(|row| row.count_ones()).sum();
        self.reached[..rows].fill(0);
        self.closed[..rows].fill(0);
        self.open.clear();
        self.reach(from, from, Cost::ZERO, estimate(from));
        observer.generated(NodeEvent {
            at: window.vertex(from),
            parent: None,
            g: Cost::ZERO,
            f: estimate(from),
        });
        while let Some(Reverse(entry)) = self.open.pop() {
            let cell = entry.id().0;
            if contains(&self.closed, cell) {
                continue;
            }
            insert(&mut self.closed, cell);
            targets_left -= u32::from(contains(targets, cell));
            if targets_left == 0 {
                return;
            }
            let parent = (cell != from).then(|| window.vertex(self.parent(cell)));
            let (at, g) = (window.vertex(cell), self.cost[cell as usize]);
            observer.expanded(NodeEvent { at, parent, g, f: entry.f() });
            self.expand(window, cell, &estimate, observer);
        }
    }

    /// Generates the neighbors of a cell.
    fn expand(
        &mut self,
        window: &Window,
        cell: u32,
        estimate: &impl Fn(u32) -> Cost,
        observer: &mut impl Observer,
    ) {
        let (x, y) = (cell % MAX_SIDE, (cell / MAX_SIDE) as usize);
        // Whether the cells to the left, here and to the right are free (bits 0 to 2), in three rows.
        let around = |row: u64| if x == 0 { row << 1 & 7 } else { row >> (x - 1) & 7 };
        let above = if y > 0 { around(window.free[y - 1]) } else { 0 };
        let beside = around(window.free[y]);
        let below = if y + 1 < window.height as usize { around(window.free[y + 1]) } else { 0 };
        let cost = self.cost[cell as usize];
        let (axial, diagonal) = (self.axial, self.diagonal);
        let mut relax = |to: u32, g: Cost| {
            let is_first = !contains(&self.reached, to);
            if !is_first && self.cost[to as usize] <= g {
                return;
            }
            let h = estimate(to);
            self.reach(cell, to, g, h);
            let event = NodeEvent { at: window.vertex(to), parent: Some(window.vertex(cell)), g, f: g + h };
            if is_first { observer.generated(event) } else { observer.updated(event) }
        };
        let g = cost + axial;
        for (free, next) in [
            (above & 2 != 0, cell.wrapping_sub(MAX_SIDE)),
            (beside & 1 != 0, cell.wrapping_sub(1)),
            (beside & 4 != 0, cell + 1),
            (below & 2 != 0, cell + MAX_SIDE),
        ] {
            if free {
                relax(next, g);
            }
        }
        let Some(diagonal) = diagonal else { return };
        let g = cost + diagonal;
        for (free, next) in [
            (above & 3 == 3 && beside & 1 != 0, cell.wrapping_sub(MAX_SIDE + 1)),
            (above & 6 == 6 && beside & 4 != 0, cell.wrapping_sub(MAX_SIDE - 1)),
            (below & 3 == 3 && beside & 1 != 0, cell + MAX_SIDE - 1),
            (below & 6 == 6 && beside & 4 != 0, cell + MAX_SIDE + 1),
        ] {
            if free {
                relax(next, g);
            }
        }
    }

    #[inline]
    fn reach(&mut self, from: u32, to: u32, cost: Cost, h: Cost) {
        insert(&mut self.reached, to);
        self.cost[to as usize] = cost;
        self.parent[to as usize] = from as u16;
        self.open.push(Reverse(Entry::new(cost + h, h, VertexId(to))));
    }
}
