//! Which lists may differ from those of the earlier map, and so which decisions may.

use mediant_grid::{Grid, Vertex};

use super::{Bounds, NONE};
use crate::subgoals::Subgoals;

/// The side of a tile is 2 to the power of this, in vertices.
const SHIFT: u32 = 3;

/// The lists that were touched, and the decisions that are made again.
pub(super) struct Touches<'m> {
    subgoals: &'m Subgoals,
    /// The lists that each decision read.
    read: Vec<Bounds>,
    is_touched: Vec<bool>,
    touched: Vec<Vertex>,
    /// The tiles that have a vertex whose list was touched, one bit each, and the words of a row of them.
    tiles: (Vec<u64>, usize),
    is_open: Vec<bool>,
    open: usize,
}

impl<'m> Touches<'m> {
    pub(super) fn new(subgoals: &'m Subgoals, read: Vec<Bounds>, grid: &Grid) -> Self {
        let [columns, rows] = [grid.width(), grid.height()].map(|side| (side >> SHIFT) as usize + 1);
        let words = columns.div_ceil(64);
        let count = subgoals.len();
        Self {
            subgoals,
            read,
            is_touched: vec![false; count],
            touched: Vec::new(),
            tiles: (vec![0; words * rows], words),
            is_open: vec![false; count],
            open: 0,
        }
    }

    /// Touches the list of a subgoal, if it is one of the new map.
    pub(super) fn touch(&mut self, id: u32) {
        if id != NONE && !std::mem::replace(&mut self.is_touched[id as usize], true) {
            let at = self.subgoals.vertex(id);
            self.touched.push(at);
            let (tiles, words) = &mut self.tiles;
            let (column, row) = (at.x as usize >> SHIFT, at.y as usize >> SHIFT);
            tiles[row * *words + column / 64] |= 1 << (column % 64);
        }
    }

    /// Whether a subgoal must be decided about again: since something that its decisions read was touched.
    pub(super) fn is_open(&mut self, id: u32) -> bool {
        if !self.is_open[id as usize] && (self.is_touched[id as usize] || self.has_read_touched(id)) {
            self.is_open[id as usize] = true;
            self.open += 1;
        }
        self.is_open[id as usize]
    }

    fn has_read_touched(&self, id: u32) -> bool {
        let (read, (tiles, words)) = (self.read[id as usize], &self.tiles);
        let Some(([left, top], [right, bottom])) = read.tiles(SHIFT) else { return false };
        let has_tile = (top..=bottom).any(|row| {
            (left / 64..=right / 64).any(|word| {
                let low = if word == left / 64 { !0 << (left % 64) } else { !0 };
                let high = if word == right / 64 { !0 >> (63 - right % 64) } else { !0_u64 };
                tiles.get(row * words + word).is_some_and(|bits| bits & low & high != 0)
            })
        });
        has_tile && self.touched.iter().any(|&at| read.contains(at))
    }

    /// The number of subgoals that are decided about again.
    pub(super) const fn open(&self) -> usize {
        self.open
    }

    /// The lists that the decisions about a subgoal read.
    pub(super) fn read_mut(&mut self, id: u32) -> &mut Bounds {
        &mut self.read[id as usize]
    }

    /// All that decisions read, and which lists were touched.
    pub(super) fn into_parts(self) -> (Vec<Bounds>, Vec<bool>) {
        (self.read, self.is_touched)
    }
}
