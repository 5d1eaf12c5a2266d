//! Which subgoals each vertex is joined to: what makes the ends of a query a look-up.
//!
//! The vertices are cut into blocks of 8 × 8. A block has an entry for each side of a subgoal to which one of
//! its vertices is joined: a *slot*, which is the number of the subgoal and the side, and a *mask* of 64
//! bits, which says for which vertices. To look a vertex up is to test one bit of each entry of its block.
//!
//! **Small.** An entry takes four bytes. The slots of a block ascend, and 16 bits hold how far; where they do
//! not suffice, an entry without vertices stands between. The masks are numbers of a dictionary. It holds the
//! most frequent ones, and all that lie within one row: a mask that is not in it becomes an entry for each
//! of its rows. Bits of vertices that are not free do not matter, so a mask of all free vertices counts as
//! full. On the maps of `docs/measurements/subgoal.md` 23 to 67 % of the masks are full, and no map has more
//! than 57,070 others.
//!
//! **Points between vertices.** A point in the middle of a cell sees what the cell's vertices see, and a few
//! subgoals more, of which there is a list ([`cells`]). A subgoal that all four vertices see, it sees: the
//! lines of sight from the cell fill a cone around it, and a blocked cell, as large as this one, does not fit
//! in where the cone is narrower. So it would stand in the way of a vertex. A line of sight tells the rest.
//!
//! **One for every k.** At corners it depends on the map alone: paths are taut for every k and at any angle.

mod build;
mod cells;
mod codec;
mod links;

use mediant_grid::Vertex;

pub(crate) use self::cells::CellIndex;

/// The number of the mask of no vertex.
const EMPTY: u16 = 1;

/// The vertices of a block along each side: a word has a bit for each vertex.
pub(crate) const SIDE: i32 = 8;

/// For each vertex, the subgoals to which the edges of a query join it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct SeenIndex {
    /// The blocks of a row.
    pub(crate) columns: u32,
    /// Row by row, and one more that ends the last.
    pub(crate) blocks: Box<[Block]>,
    pub(crate) entries: Box<[SeenEntry]>,
    /// The dictionary. The first one is full, the second empty.
    pub(crate) masks: Box<[u64]>,
    /// The most entries of a block.
    pub(crate) most: usize,
    /// The slots that are seen from cells, but not from their vertices; `None` at centers, and if there are
    /// many.
    pub(crate) cells: Option<CellIndex>,
}

/// A block of vertices.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Block {
    /// The number of its first entry.
    pub(crate) first: u32,
    /// The slot of its first entry, less how far that has come.
    pub(crate) slot: u32,
}

/// Which vertices of a block are joined to one side of a subgoal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SeenEntry {
    /// How much larger its slot is than that of the entry before.
    pub(crate) after: u16,
    /// The number of its mask.
    pub(crate) mask: u16,
}

impl SeenIndex {
    /// Writes the slots to which a vertex is joined to the beginning of `slots`, which has room for
    /// [`most`](Self::most) and one more. Returns their number.
    #[inline]
    pub(crate) fn slots(&self, at: Vertex, slots: &mut [u32]) -> usize {
        let some = 1 << ((at.y % SIDE) * SIDE + at.x % SIDE);
        self.find([at.x / SIDE, at.y / SIDE], some, slots)
    }

    /// The same for some of the vertices of a block, as a mask: the slots to which any of them is joined.
    #[inline]
    fn find(&self, block: [i32; 2], some: u64, slots: &mut [u32]) -> usize {
        let (mut slot, entries) = self.block(block);
        let mut count = 0;
        // Each slot is written, and kept if a bit is set: a branch could not be predicted.
        for entry in entries {
            slot += u32::from(entry.after);
            slots[count] = slot;
            count += usize::from(self.masks[usize::from(entry.mask)] & some != 0);
        }
        count
    }

    /// The entries of a block, and the slot of the first one, less how far that has come.
    #[inline]
    fn block(&self, [x, y]: [i32; 2]) -> (u32, &[SeenEntry]) {
        let number = (y as u32 * self.columns + x as u32) as usize;
        match self.blocks.get(number..number + 2) {
            Some(&[Block { first, slot }, Block { first: end, .. }]) => {
                (slot, &self.entries[first as usize..end as usize])
            }
            _ => (0, &[]),
        }
    }

    /// The room for what the vertices of a box see.
    pub(crate) const fn room_around(&self) -> usize {
        4 * (self.most + 1)
    }

    /// Writes the slots to which the vertices of a box of at most three each way are joined to the beginning
    /// of `slots`, most of them once, and returns their number. `slots` and the others, which are scratch
    /// memory, have [room](Self::room_around).
    pub(crate) fn slots_around(
        &self,
        corners: [Vertex; 2],
        slots: &mut [u32],
        [others, merged]: [&mut [u32]; 2],
    ) -> usize {
        let mut count = 0;
        for (block, some) in blocks_of(corners) {
            if count == 0 {
                count = self.find(block, some, slots);
                continue;
            }
            let more = self.find(block, some, others);
            count = merge(&slots[..count], &others[..more], merged);
            slots[..count].copy_from_slice(&merged[..count]);
        }
        count
    }

    /// Whether all vertices of such a box are known to be joined to a slot.
    pub(crate) fn joins_all(&self, corners: [Vertex; 2], slot: u32) -> bool {
        blocks_of(corners).all(|(block, some)| {
            let (mut at, entries) = self.block(block);
            let entry = entries.iter().find(|entry| {
                at += u32::from(entry.after);
                at >= slot && entry.mask != EMPTY
            });
            entry.is_some_and(|entry| at == slot && self.masks[usize::from(entry.mask)] & some == some)
        })
    }

    /// The number of blocks.
    pub(crate) const fn len(&self) -> usize {
        self.blocks.len() - 1
    }

    /// The memory used, in bytes.
    pub(crate) fn memory_bytes(&self) -> usize {
        let cells = self.cells.as_ref().map_or(0, CellIndex::memory_bytes);
        size_of_val(&*self.blocks) + size_of_val(&*self.entries) + size_of_val(&*self.masks) + cells
    }
}

/// The blocks of the vertices of a box, of at most eight each way, each with these as a mask.
fn blocks_of([low, high]: [Vertex; 2]) -> impl Iterator<Item = ([i32; 2], u64)> {
    // The bits of those from `low` to `high` along one axis, in one block.
    let bits = |block: i32, low: i32, high: i32| {
        let (first, last) = ((low - block * SIDE).max(0), (high - block * SIDE).min(SIDE - 1));
        (2_u64 << last) - (1 << first)
    };
    (low.y / SIDE..=high.y / SIDE).flat_map(move |y| {
        // The bits 0, 8, 16 … of those rows.
        let rows = bits(y, low.y, high.y);
        let rows = (0..SIDE).fold(0, |spread, row| spread | (rows >> row & 1) << (SIDE * row));
        (low.x / SIDE..=high.x / SIDE).map(move |x| ([x, y], rows * bits(x, low.x, high.x)))
    })
}

/// Merges two ascending lists; what is in both comes once. Returns how many there are.
fn merge(mut a: &[u32], mut b: &[u32], merged: &mut [u32]) -> usize {
    let mut count = 0;
    // Both steps without a branch: which list is ahead could not be predicted.
    while let (&[first, ..], &[second, ..]) = (a, b) {
        merged[count] = first.min(second);
        count += 1;
        a = &a[usize::from(first <= second)..];
        b = &b[usize::from(second <= first)..];
    }
    for rest in [a, b] {
        merged[count..count + rest.len()].copy_from_slice(rest);
        count += rest.len();
    }
    count
}
