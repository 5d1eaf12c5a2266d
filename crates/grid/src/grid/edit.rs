//! The next version of a map while it is made.

use std::collections::BTreeMap;

use super::Grid;
use crate::{Rectangle, bits::MatrixEdit, identity::MapId};

/// The next version of a map: rows, columns and digest are changed where cells are.
pub(crate) struct GridEdit {
    id: MapId,
    rows: MatrixEdit,
    columns: MatrixEdit,
    changed: Tiles,
    /// Cells of one word that were not handed on yet: the column of its first cell and its row, which of its
    /// cells were named, and which of these are blocked.
    open: ((u32, u32), u64, u64),
}

/// The side of the tiles in which scattered cells become one rectangle. A word of the map has as many cells.
const TILE: u32 = 64;

impl Grid {
    /// Begins an edit of this map, which stays as it is.
    pub(crate) fn begin_edit(&self) -> GridEdit {
        GridEdit::new(self.id, self.rows.edit(), self.columns.edit())
    }

    /// Begins an edit of a map that nobody else needs: in place.
    pub(crate) fn into_edit(self) -> GridEdit {
        GridEdit::new(self.id, self.rows.into_edit(), self.columns.into_edit())
    }

    /// The rectangles, one a tile, in which this map differs from another one of the same size.
    pub(crate) fn differences(&self, other: &Self) -> Vec<Rectangle> {
        let mut changed = Tiles::default();
        if self.id != other.id {
            for y in 0..self.height() {
                for (word, bits) in self.differing_words(other, y) {
                    changed.add((word * TILE, y), bits);
                }
            }
        }
        changed.into_rectangles()
    }
}

impl GridEdit {
    fn new(id: MapId, rows: MatrixEdit, columns: MatrixEdit) -> Self {
        Self { id, rows, columns, changed: Tiles::default(), open: ((0, 0), 0, 0) }
    }

    /// Says of one cell of the map whether it is blocked.
    pub(crate) fn set(&mut self, x: u32, y: u32, blocked: bool) {
        let (first, bit) = ((x & !63, y), 1 << (x % 64));
        if self.open.0 != first {
            self.hand_on();
            self.open = (first, 0, 0);
        }
        let (_, mask, bits) = &mut self.open;
        *mask |= bit;
        *bits = *bits & !bit | if blocked { bit } else { 0 };
    }

    /// Gives the cells that `mask` names of the 64 of row y from column x on, a multiple of 64, these bits.
    /// All must lie on the map.
    fn set_word(&mut self, at: (u32, u32), mask: u64, bits: u64) {
        let words = self.rows.set_bits(at, mask, bits);
        let mut changed = words[0] ^ words[1];
        if changed == 0 {
            return;
        }
        self.id = self.id.with_word(at, words);
        self.changed.add(at, changed);
        while changed != 0 {
            self.columns.flip(at.1, at.0 + changed.trailing_zeros());
            changed &= changed - 1;
        }
    }

    fn hand_on(&mut self) {
        let (at, mask, bits) = self.open;
        if mask != 0 {
            self.set_word(at, mask, bits);
        }
    }

    /// The next version, and rectangles outside of which it is as the last one, one a tile.
    pub(crate) fn finish(mut self) -> (Grid, Vec<Rectangle>) {
        self.hand_on();
        let Self { id, rows, columns, changed, .. } = self;
        (Grid { id, rows: rows.finish(), columns: columns.finish() }, changed.into_rectangles())
    }
}

/// The smallest rectangle around the changed cells of each tile that has any, by the tile's row and column.
#[derive(Default)]
struct Tiles {
    closed: BTreeMap<(u32, u32), Rectangle>,
    /// The tile that changed last, which is often the one that changes next.
    open: Option<((u32, u32), Rectangle)>,
}

impl Tiles {
    /// Adds changed cells of a word of row y from column x on, a multiple of 64.
    fn add(&mut self, (x, y): (u32, u32), changed: u64) {
        let (first, last) = (changed.trailing_zeros(), 63 - changed.leading_zeros());
        let (tile, at) = ((y / TILE, x / TILE), Rectangle::new(x + first, y, last - first + 1, 1));
        match &mut self.open {
            Some((open, around)) if *open == tile => *around = around.around(at),
            open => {
                let left = open.replace((tile, at));
                self.close(left);
            }
        }
    }

    fn close(&mut self, left: Option<((u32, u32), Rectangle)>) {
        if let Some((tile, at)) = left {
            self.closed.entry(tile).and_modify(|known| *known = known.around(at)).or_insert(at);
        }
    }

    fn into_rectangles(mut self) -> Vec<Rectangle> {
        let left = self.open.take();
        self.close(left);
        self.closed.into_values().collect()
    }
}
