//! The cells in which two maps differ.

use mediant_grid::{Grid, Rectangle};

/// Cells by (row, column), in order, each once.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Cells(Vec<(u16, u16)>);

impl Cells {
    /// The cells in which two maps of the same size differ, if they differ in these and in the rectangles
    /// alone; `None` for more than `most`.
    pub(super) fn after(&self, [then, now]: [&Grid; 2], at: &[Rectangle], most: usize) -> Option<Self> {
        let differs = |&(y, x): &(u16, u16)| {
            let (x, y) = (i32::from(x), i32::from(y));
            then.is_blocked(x, y) != now.is_blocked(x, y)
        };
        let mut cells: Vec<(u16, u16)> = self.0.iter().copied().filter(differs).collect();
        for &Rectangle { x, y, width, height } in at {
            let within = (y..y + height).flat_map(|y| (x..x + width).map(move |x| (y as u16, x as u16)));
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
        self.0.iter().map(|&(y, x)| (x.into(), y.into()))
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
