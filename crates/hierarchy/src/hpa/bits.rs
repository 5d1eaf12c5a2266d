//! The costs between the nodes of a small cluster: Dijkstra's algorithm on sets of cells.
//!
//! All cells of one cost are expanded at once, as the bits of one number. A move adds one of two costs, and
//! cells are expanded in the order of their costs; so the sets that the moves of one cost reach wait in a
//! queue, in that order, and no heap is needed.

use mediant_moves::{Cost, FiniteK, Vector};

use super::fixed_cost::FixedCost;
use crate::window::{MAX_SIDE, Window};

/// A set of cells: bit [`PITCH`]·y + x is that of cell (x, y).
type Cells = u128;

/// The most columns and rows of a small cluster.
const SIDE: u32 = 10;
/// The bits from a row to the next. The one behind each row belongs to no cell.
const PITCH: u32 = SIDE + 1;

/// Sets of cells that are reached by moves of one cost, with the costs of their paths.
#[derive(Default)]
struct Queue {
    sets: Vec<(Cost, Cells)>,
    next: usize,
}

impl Queue {
    /// The cost of the first set.
    #[inline]
    fn first(&self) -> Cost {
        self.sets.get(self.next).map_or(Cost::MAX, |&(cost, _)| cost)
    }

    /// Takes the first set.
    #[inline]
    fn take(&mut self) -> Cells {
        let cells = self.sets.get(self.next).map_or(0, |&(_, cells)| cells);
        self.next += 1;
        cells
    }

    fn clear(&mut self) {
        self.sets.clear();
        self.next = 0;
    }
}

/// The search, with its scratch memory.
pub(crate) struct BitSearch {
    axial: Cost,
    /// `None` for four neighbors.
    diagonal: Option<Cost>,
    queues: [Queue; 2],
    /// The costs from the first cell of the last search to its targets, by the bits of these.
    costs: [FixedCost; Cells::BITS as usize],
}

/// The cells of a small cluster and the moves between them.
pub(crate) struct BitCells {
    free: Cells,
    /// The cells from which a diagonal move leads down and right, and down and left.
    down: [Cells; 2],
}

impl BitCells {
    /// The cells of a window; `None` if it is too large.
    pub(crate) fn new(window: &Window) -> Option<Self> {
        if window.width.max(window.height) > SIDE {
            return None;
        }
        let rows = window.free[..window.height as usize].iter().rev();
        let free = rows.fold(0, |free, &row| free << PITCH | Cells::from(row));
        // Corners are not cut: a diagonal move needs all four cells.
        let upper = free & free >> PITCH;
        Some(Self { free, down: [upper & upper >> 1, upper & upper << 1] })
    }

    const fn bit(cell: u32) -> u32 {
        cell / MAX_SIDE * PITCH + cell % MAX_SIDE
    }

    /// The set of the cell of a window with this number.
    pub(crate) const fn cell(cell: u32) -> Cells {
        1 << Self::bit(cell)
    }

    fn axial(&self, from: Cells) -> Cells {
        (from << 1 | from >> 1 | from << PITCH | from >> PITCH) & self.free
    }

    fn diagonal(&self, from: Cells) -> Cells {
        let [right, left] = self.down;
        (from & right) << (PITCH + 1)
            | (from & left) << (PITCH - 1)
            | from >> (PITCH + 1) & right
            | from >> (PITCH - 1) & left
    }
}

impl BitSearch {
    /// For 4- or 8-connected paths that never cut corners.
    pub(crate) fn new(k: FiniteK) -> Self {
        Self {
            axial: Cost::of_move(Vector::new(1, 0)),
            diagonal: (k != FiniteK::N4).then(|| Cost::of_move(Vector::new(1, 1))),
            queues: Default::default(),
            costs: [FixedCost::NONE; Cells::BITS as usize],
        }
    }

    /// The cost from the first cell of the last search to a target of it, with this number in the window.
    pub(crate) fn cost(&self, cell: u32) -> FixedCost {
        self.costs[BitCells::bit(cell) as usize]
    }

    /// Finds the costs from one cell to others, to be read by [`cost`](Self::cost).
    pub(crate) fn find(&mut self, cells: &BitCells, from: Cells, targets: Cells) {
        let Self { axial, diagonal, queues: [by_axial, by_diagonal], costs } = self;
        by_axial.clear();
        by_diagonal.clear();
        by_axial.sets.push((Cost::ZERO, from));
        let (mut open, mut left) = (cells.free, targets);
        loop {
            let firsts = [by_axial.first(), by_diagonal.first()];
            let cost = firsts[0].min(firsts[1]);
            if cost == Cost::MAX {
                break;
            }
            let mut reached = 0;
            if firsts[0] == cost {
                reached |= by_axial.take();
            }
            if firsts[1] == cost {
                reached |= by_diagonal.take();
            }
            reached &= open;
            if reached == 0 {
                continue;
            }
            open &= !reached;
            let mut hits = reached & left;
            if hits != 0 {
                let cost = FixedCost::new(Some(cost));
                while hits != 0 {
                    costs[hits.trailing_zeros() as usize] = cost;
                    hits &= hits - 1;
                }
                left &= !reached;
                if left == 0 {
                    return;
                }
            }
            let next = cells.axial(reached) & open;
            if next != 0 {
                by_axial.sets.push((cost + *axial, next));
            }
            if let Some(diagonal) = *diagonal {
                let next = cells.diagonal(reached) & open;
                if next != 0 {
                    by_diagonal.sets.push((cost + diagonal, next));
                }
            }
        }
        while left != 0 {
            costs[left.trailing_zeros() as usize] = FixedCost::NONE;
            left &= left - 1;
        }
    }
}
