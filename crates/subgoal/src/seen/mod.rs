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
//! **One for every k.** At corners it depends on the map alone: paths are taut for every k and at any angle.

mod build;
mod codec;

use mediant_grid::Vertex;

/// The vertices of a block along each side: a word has a bit for each vertex.
const SIDE: i32 = 8;

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
        let number = ((at.y / SIDE) as u32 * self.columns + (at.x / SIDE) as u32) as usize;
        let bit = (at.y % SIDE) * SIDE + at.x % SIDE;
        let Some(&[Block { first, mut slot }, Block { first: end, .. }]) =
            self.blocks.get(number..number + 2)
        else {
            return 0;
        };
        let mut count = 0;
        // Each slot is written, and kept if the bit is set: a branch could not be predicted.
        for entry in &self.entries[first as usize..end as usize] {
            slot += u32::from(entry.after);
            slots[count] = slot;
            count += (self.masks[usize::from(entry.mask)] >> bit & 1) as usize;
        }
        count
    }

    /// The memory used, in bytes.
    pub(crate) const fn memory_bytes(&self) -> usize {
        size_of_val(&*self.blocks) + size_of_val(&*self.entries) + size_of_val(&*self.masks)
    }
}
