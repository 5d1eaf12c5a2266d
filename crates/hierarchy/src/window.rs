//! Searches within a small rectangle of a map: those that preprocessing does by the ten thousand.

use std::{cmp::Reverse, collections::BinaryHeap};

use mediant_grid::{Grid, Vertex, VertexId};
use mediant_moves::{Cost, CostTable, FiniteK, Vector};
use mediant_search::{Entry, NodeEvent, Observer};

/// The longest side of a window: its rows are words.
pub(crate) const MAX_SIDE: u32 = 64;

/// A set of cells of a window, row by row.
pub(crate) type Rows = [u64; MAX_SIDE as usize];

/// The cells of a rectangle of a map; what lies outside it is blocked.
#[derive(Clone, Debug)]
pub(crate) struct Window {
    pub(crate) left: i32,
    pub(crate) top: i32,
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) free: Rows,
}

impl Window {
    /// The window of the cells (`left`, `top`) to (`left` + `width` − 1, `top` + `height` − 1), all on the map, with sides of at most 64.
    pub(crate) fn of(grid: &Grid, left: i32, top: i32, width: u32, height: u32) -> Self {
        let mut free = [0; MAX_SIDE as usize];
        let within = low_bits(width);
        let mut row = grid.rows().row(top);
        for free in &mut free[..height as usize] {
            *free = !row.word(left) & within;
            row = row.below(1);
        }
        Self { left, top, width, height, free }
    }

    /// Whether no cell is blocked.
    pub(crate) fn is_free(&self) -> bool {
        self.free[..self.height as usize].iter().all(|&row| row == low_bits(self.width))
    }

    /// The vertex of a cell, which is numbered 64·y + x.
    pub(crate) const fn vertex(&self, cell: u32) -> Vertex {
        Vertex::new(self.left + (cell % MAX_SIDE) as i32, self.top + (cell / MAX_SIDE) as i32)
    }

    /// The cell of a vertex within the window.
    pub(crate) const fn cell(&self, at: Vertex) -> u32 {
        (at.y - self.top) as u32 * MAX_SIDE + (at.x - self.left) as u32
    }

    /// The cells that a 4-connected path within the window joins with these, which must be free.
    pub(crate) fn flood(&self, from: &Rows) -> Rows {
        let mut reached = *from;
        let last = self.height as usize - 1;
        // Down and up again until nothing is new.
        loop {
            let before = reached;
            for y in (0..=last).chain((0..last).rev()) {
                let above = if y > 0 { reached[y - 1] } else { 0 };
                let below = if y < last { reached[y + 1] } else { 0 };
                reached[y] = spread((reached[y] | above | below) & self.free[y], self.free[y]);
            }
            if reached == before {
                return reached;
            }
        }
    }
}

/// The lowest `count` bits.
pub(crate) const fn low_bits(count: u32) -> u64 {
    if count >= 64 { !0 } else { (1 << count) - 1 }
}

/// All bits of the runs of `free` that hold a bit of `from`.
const fn spread(from: u64, free: u64) -> u64 {
    let (mut reached, mut before) = (from, 0);
    while reached != before {
        before = reached;
        reached |= (reached << 1 | reached >> 1) & free;
    }
    reached
}

/// The scratch memory of searches in windows.
#[derive(Clone, Debug)]
pub(crate) struct Local {
    straight: Cost,
    /// None of these where there are four neighbors.
    diagonal: Option<Cost>,
    cost: Box<[Cost]>,
    parent: Box<[u16]>,
    reached: Rows,
    closed: Rows,
    open: BinaryHeap<Reverse<Entry>>,
}

impl Local {
    /// For 4- or 8-connected paths that never cut corners.
    pub(crate) fn new(k: FiniteK) -> Self {
        let cells = (MAX_SIDE * MAX_SIDE) as usize;
        Self {
            straight: Cost::of_move(Vector::new(1, 0)),
            diagonal: (k != FiniteK::N4).then(|| Cost::of_move(Vector::new(1, 1))),
            cost: vec![Cost::ZERO; cells].into_boxed_slice(),
            parent: vec![0; cells].into_boxed_slice(),
            reached: [0; MAX_SIDE as usize],
            closed: [0; MAX_SIDE as usize],
            open: BinaryHeap::new(),
        }
    }

    /// The cost from the cell of the last search to one that it found.
    pub(crate) fn cost(&self, cell: u32) -> Option<Cost> {
        is_in(&self.closed, cell).then(|| self.cost[cell as usize])
    }

    /// The cell before one on the path that the last [`path`](Self::path) found.
    pub(crate) fn parent(&self, cell: u32) -> u32 {
        u32::from(self.parent[cell as usize])
    }

    /// Finds what it costs from a cell to `targets`.
    pub(crate) fn spread(
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

    /// Finds a shortest path from a cell to another. Whether there is one.
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
        is_in(&self.closed, to)
    }

    /// Finds shortest paths from a cell until all targets are reached, or nothing is left; `estimate` is a consistent lower bound on what is left to them.
    fn search(
        &mut self,
        window: &Window,
        from: u32,
        targets: &Rows,
        estimate: impl Fn(u32) -> Cost,
        observer: &mut impl Observer,
    ) {
        let rows = window.height as usize;
        let mut left: u32 = targets[..rows].iter().map(|row| row.count_ones()).sum();
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
            if is_in(&self.closed, cell) {
                continue;
            }
            insert(&mut self.closed, cell);
            left -= u32::from(is_in(targets, cell));
            if left == 0 {
                return;
            }
            let before = (cell != from).then(|| window.vertex(self.parent(cell)));
            let (at, g) = (window.vertex(cell), self.cost[cell as usize]);
            observer.expanded(NodeEvent { at, parent: before, g, f: entry.f() });
            self.expand(window, cell, &estimate, observer);
        }
    }

    /// Reaches the neighbors of a cell.
    fn expand(
        &mut self,
        window: &Window,
        cell: u32,
        estimate: &impl Fn(u32) -> Cost,
        observer: &mut impl Observer,
    ) {
        let (x, y) = (cell % MAX_SIDE, (cell / MAX_SIDE) as usize);
        // Of the cells to the left, here, and to the right, in three rows.
        let around = |row: u64| if x == 0 { row << 1 & 7 } else { row >> (x - 1) & 7 };
        let above = if y > 0 { around(window.free[y - 1]) } else { 0 };
        let beside = around(window.free[y]);
        let below = if y + 1 < window.height as usize { around(window.free[y + 1]) } else { 0 };
        let cost = self.cost[cell as usize];
        let (straight, diagonal) = (self.straight, self.diagonal);
        let mut relax = |to: u32, g: Cost| {
            let is_first = !is_in(&self.reached, to);
            if !is_first && self.cost[to as usize] <= g {
                return;
            }
            let h = estimate(to);
            self.reach(cell, to, g, h);
            let event = NodeEvent { at: window.vertex(to), parent: Some(window.vertex(cell)), g, f: g + h };
            if is_first { observer.generated(event) } else { observer.updated(event) }
        };
        let g = cost + straight;
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

/// The set of these cells.
pub(crate) fn rows_of(cells: &[u32]) -> Rows {
    let mut rows = [0; MAX_SIDE as usize];
    cells.iter().for_each(|&cell| insert(&mut rows, cell));
    rows
}

#[inline]
const fn is_in(rows: &Rows, cell: u32) -> bool {
    rows[(cell / MAX_SIDE) as usize] >> (cell % MAX_SIDE) & 1 == 1
}

#[inline]
pub(crate) const fn insert(rows: &mut Rows, cell: u32) {
    rows[(cell / MAX_SIDE) as usize] |= 1 << (cell % MAX_SIDE);
}
