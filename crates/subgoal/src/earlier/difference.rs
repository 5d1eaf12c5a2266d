//! The cells in which two maps differ.

use mediant_grid::{Grid, Rectangle};

/// Cells row by row, each once: the row in the upper half of a number, the column in the lower.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Cells(Vec<u32>);

impl Cells {
    /// The cells in which two maps of the same size differ, if they differ in these and in the rectangles
    /// alone; `None` for more than `most`.
    pub(super) fn after(&self, [then, now]: [&Grid; 2], at: &[Rectangle], most: usize) -> Option<Self> {
        let differs = |&cell: &u32| {
            let (x, y) = place(cell);
            then.is_blocked(x, y) != now.is_blocked(x, y)
        };
        let mut cells: Vec<u32> = self.0.iter().copied().filter(differs).collect();
        for &Rectangle { x, y, width, height } in at {
            let within = (y..y + height).flat_map(|y| (x..x + width).map(move |x| y << 16 | x));
            cells.extend(within.filter(differs));
            // A cell can be in several rectangles.
            if cells.len() > most {
                cells.sort_unstable();
                cells.dedup();
                if cells.len() > most {
                    return None;
                }
            }
        }
        cells.sort_unstable();
        cells.dedup();
        Some(Self(cells))
    }

    /// The cells, by (column, row).
    pub(super) fn iter(&self) -> impl Iterator<Item = (i32, i32)> {
        self.0.iter().map(|&cell| place(cell))
    }

    pub(super) const fn len(&self) -> usize {
        self.0.len()
    }

    pub(super) const fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) const fn memory_bytes(&self) -> usize {
        size_of_val(self.0.as_slice())
    }
}

/// The column and the row. No side of a map has more than 2¹⁵ cells.
const fn place(cell: u32) -> (i32, i32) {
    ((cell & 0xFFFF) as i32, (cell >> 16) as i32)
}
