//! The root history: for each vertex its best root.

use mediant_grid::Vertex;

/// For each vertex its best root, in blocks of 16 × 16 vertices. A block has memory from the first search on
/// that has a root in it, so the memory follows what searches touch, not the map.
#[derive(Clone, Debug)]
pub(super) struct RootHistory {
    /// For each block, row by row, the number of its entries in `entries`; 0 if it has none yet.
    blocks: Box<[u32]>,
    /// The number of blocks side by side.
    width: usize,
    /// The entries of the blocks, one block after the other. The first is of no block and stays empty.
    entries: Vec<[RootEntry; BLOCK]>,
    generation: u32,
}

/// The vertices of a block.
const BLOCK: usize = 256;

/// The number of a root, and the search in which it became one.
#[derive(Clone, Copy, Debug)]
struct RootEntry {
    generation: u32,
    root: u32,
}

impl RootHistory {
    const EMPTY: [RootEntry; BLOCK] = [RootEntry { generation: 0, root: 0 }; BLOCK];

    /// An empty history for a map of so many columns and rows of vertices.
    pub(super) fn new(columns: u32, rows: u32) -> Self {
        let [width, height] = [columns, rows].map(|vertices| vertices.div_ceil(16) as usize);
        let blocks = vec![0; width * height].into_boxed_slice();
        Self { blocks, width, entries: vec![Self::EMPTY], generation: 1 }
    }

    /// Forgets all roots, and becomes a history for a map of so many columns and rows of vertices. The memory
    /// is kept if it has room for as many blocks, and at most twice as much.
    pub(super) fn fit(&mut self, columns: u32, rows: u32) {
        let [width, height] = [columns, rows].map(|vertices| vertices.div_ceil(16) as usize);
        if (self.blocks.len() / 2..=self.blocks.len()).contains(&(width * height)) {
            // Entries are those of a block by its number, wherever it lies.
            self.width = width;
            self.clear();
        } else {
            *self = Self::new(columns, rows);
        }
    }

    /// The bytes that it takes when it is made.
    pub(super) const fn bytes(columns: u32, rows: u32) -> usize {
        let blocks = columns.div_ceil(16) as usize * rows.div_ceil(16) as usize;
        blocks.saturating_mul(size_of::<u32>())
    }

    /// Forgets all roots, in constant time (but for one call in 2³²).
    pub(super) fn clear(&mut self) {
        self.generation = self.generation.wrapping_add(1);
        if self.generation == 0 {
            self.entries.fill(Self::EMPTY);
            self.generation = 1;
        }
    }

    /// The block of a vertex of the map, and its place there.
    #[inline]
    const fn place(&self, at: Vertex) -> (usize, usize) {
        let (x, y) = (at.x as usize, at.y as usize);
        (y / 16 * self.width + x / 16, y % 16 * 16 + x % 16)
    }

    /// The best root at a vertex of the map.
    #[inline]
    pub(super) fn get(&self, at: Vertex) -> Option<u32> {
        let (block, place) = self.place(at);
        let RootEntry { generation, root } = self.entries[self.blocks[block] as usize][place];
        (generation == self.generation).then_some(root)
    }

    /// Makes a root the best one at its vertex, which is on the map.
    #[inline]
    pub(super) fn set(&mut self, at: Vertex, root: u32) {
        *self.entry(at) = RootEntry { generation: self.generation, root };
    }

    /// The best root at a vertex of the map, and where its number is kept. If there is none yet, the caller
    /// must put one there.
    #[inline]
    pub(super) fn slot(&mut self, at: Vertex) -> (Option<u32>, &mut u32) {
        let generation = self.generation;
        let entry = self.entry(at);
        let known = (entry.generation == generation).then_some(entry.root);
        entry.generation = generation;
        (known, &mut entry.root)
    }

    /// The entry of a vertex of the map, in a block that has memory.
    #[inline]
    fn entry(&mut self, at: Vertex) -> &mut RootEntry {
        let (block, place) = self.place(at);
        if self.blocks[block] == 0 {
            self.add_block(block);
        }
        &mut self.entries[self.blocks[block] as usize][place]
    }

    #[cold]
    fn add_block(&mut self, block: usize) {
        self.blocks[block] = self.entries.len() as u32;
        self.entries.push(Self::EMPTY);
    }
}
