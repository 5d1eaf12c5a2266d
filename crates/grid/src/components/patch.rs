//! A small change within a tile that joins and parts nothing.
//!
//! Most edits are such. Whether one is, is seen in the box of cells around it: if the cells at the edge of
//! the box, which did not change, are joined within the box as before, then all cells beyond the change are
//! joined as before, and keep their regions.

use super::{
    Connectivity,
    tile::{SIDE, Tile},
};

/// The changed cells of a tile lie in these rows and columns of it, both ends included.
#[derive(Clone, Copy)]
pub(super) struct Changed {
    pub(super) rows: [u32; 2],
    pub(super) columns: [u32; 2],
}

/// The cells of a box of at most 8 × 8, a byte a row.
struct Box8 {
    free: u64,
    connectivity: Connectivity,
}

const FIRST_COLUMN: u64 = 0x0101_0101_0101_0101;
const LAST_COLUMN: u64 = FIRST_COLUMN << 7;

impl Box8 {
    /// The cells that are joined with some cells within the box.
    fn joined(&self, from: u64) -> u64 {
        let mut joined = from & self.free;
        loop {
            let beside = (joined & !LAST_COLUMN) << 1 | (joined & !FIRST_COLUMN) >> 1;
            let row = match self.connectivity {
                Connectivity::Four => joined,
                Connectivity::Eight => joined | beside,
            };
            let more = (joined | beside | row << 8 | row >> 8) & self.free;
            if more == joined {
                return joined;
            }
            joined = more;
        }
    }
}

impl Tile {
    /// The tile after a change that joins and parts nothing: only labels in the changed rows differ. `None`
    /// for any other change, a large one, one at the border, and one that makes or ends a region. `old` and
    /// `new` are the free cells of a row.
    pub(super) fn patched(
        &self,
        Changed { rows: [top, bottom], columns: [left, right] }: Changed,
        (old, new): (impl Fn(u32) -> u64, impl Fn(u32) -> u64),
        connectivity: Connectivity,
    ) -> Option<Self> {
        let is_inside = top > 0 && bottom + 1 < self.height() && left > 0 && right + 1 < SIDE as u32;
        if !is_inside || bottom - top > 5 || right - left > 5 {
            return None;
        }
        let pack = |row: &dyn Fn(u32) -> u64| {
            let width = right - left + 3;
            let bits = |y: u32| row(top - 1 + y) >> (left - 1) & !(!0 << width);
            (0..bottom - top + 3).fold(0, |all, y| all | bits(y) << (8 * y))
        };
        let [before, after] = [pack(&old), pack(&new)].map(|free| Box8 { free, connectivity });
        // The changed cells; all others of the box are its edge.
        let inside = (top..=bottom).fold(0, |all, y| {
            let row = !(!0_u64 << (right - left + 1)) << 1;
            all | row << (8 * (y - top + 1))
        });
        let mut rest = before.free & !inside;
        let (mut known, mut found) = (0, 0);
        while rest != 0 {
            let from = rest & rest.wrapping_neg();
            let [one, other] = [&before, &after].map(|cells| cells.joined(from));
            if (one ^ other) & !inside != 0 {
                return None;
            }
            (known, found, rest) = (known | one, found | other, rest & !one);
        }
        if known != before.free || found != after.free {
            // A region within the change.
            return None;
        }
        let label = |y: u32, bit: u32| self.of(y as usize, bit, old(y));
        let changed = !(!0_u64 << (right - left + 1)) << left;
        let mut labels = Vec::with_capacity(self.labels().len() + 4);
        let mut lengths = [0; 6];
        for y in top..=bottom {
            let mut free = new(y);
            while free != 0 {
                let bit = free.trailing_zeros();
                let length = (free >> bit).trailing_ones();
                let run = (!0 >> (64 - length)) << bit;
                let beyond = run & !changed;
                labels.push(if beyond != 0 {
                    label(y, beyond.trailing_zeros())
                } else {
                    let cell = 1_u64 << (8 * (y - top + 1) + bit + 1 - left);
                    let edge = (after.joined(cell) & !inside).trailing_zeros();
                    label(top - 1 + edge / 8, left - 1 + edge % 8)
                });
                lengths[(y - top) as usize] += 1;
                free &= !run;
            }
        }
        Some(self.with_labels(top as usize, &lengths[..=(bottom - top) as usize], &labels))
    }
}
