//! Small rectangles of a map, as rows of bits.

use mediant_grid::{Grid, Vertex};

/// The longest side of a window: each of its rows is one word.
pub(crate) const MAX_SIDE: u32 = 64;

/// A set of cells of a window: a word for each row, a bit for each cell.
pub(crate) type Rows = [u64; MAX_SIDE as usize];

/// The cells of a rectangle of a map. Everything outside the window counts as blocked.
#[derive(Clone, Debug)]
pub(crate) struct Window {
    pub(crate) left: i32,
    pub(crate) top: i32,
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) free: Rows,
}

impl Window {
    /// The window whose first cell is (`left`, `top`). All its cells must be on the map, and its sides at
    /// most 64 cells long.
    pub(crate) fn new(grid: &Grid, left: i32, top: i32, width: u32, height: u32) -> Self {
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

    /// The vertex of cell (x, y) of the window, whose number is 64·y + x.
    pub(crate) const fn vertex(&self, cell: u32) -> Vertex {
        Vertex::new(self.left + (cell % MAX_SIDE) as i32, self.top + (cell / MAX_SIDE) as i32)
    }

    /// The number of the cell of a vertex, which must be within the window.
    pub(crate) const fn cell(&self, at: Vertex) -> u32 {
        (at.y - self.top) as u32 * MAX_SIDE + (at.x - self.left) as u32
    }

    /// The cells that 4-connected paths within the window reach from these cells, which must be free.
    pub(crate) fn flood(&self, from: &Rows) -> Rows {
        let mut reached = *from;
        let last = self.height as usize - 1;
        // Sweeps down and up again, until a sweep reaches no new cell.
        loop {
            let before = reached;
            for y in (0..=last).chain((0..last).rev()) {
                let above = if y > 0 { reached[y - 1] } else { 0 };
                let below = if y < last { reached[y + 1] } else { 0 };
                reached[y] = flood_row((reached[y] | above | below) & self.free[y], self.free[y]);
            }
            if reached == before {
                return reached;
            }
        }
    }
}

/// All bits of the runs of `free` that contain a bit of `from`.
const fn flood_row(from: u64, free: u64) -> u64 {
    let (mut reached, mut before) = (from, 0);
    while reached != before {
        before = reached;
        reached |= (reached << 1 | reached >> 1) & free;
    }
    reached
}

/// The lowest `count` bits.
pub(crate) const fn low_bits(count: u32) -> u64 {
    if count >= 64 { !0 } else { (1 << count) - 1 }
}

#[inline]
pub(crate) const fn contains(rows: &Rows, cell: u32) -> bool {
    rows[(cell / MAX_SIDE) as usize] >> (cell % MAX_SIDE) & 1 == 1
}

#[inline]
pub(crate) const fn insert(rows: &mut Rows, cell: u32) {
    rows[(cell / MAX_SIDE) as usize] |= 1 << (cell % MAX_SIDE);
}
