//! Which vertices have forced successors, as far as searches have found out.

use std::{
    fmt,
    ops::Range,
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
};

use mediant_grid::{Change, Interrupt, Interrupted, Placement, Versioned, VertexId, room_for};

/// For each vertex and arriving move, whether there is a forced successor: two bits, of which the lower says
/// 'none', the higher 'some', and neither 'unknown'.
///
/// Any number of planners fill it as they ask. Each bit is a fact of the map, so their answers do not depend
/// on what is filled in. After a change of the map, both versions share the blocks that hold only facts of
/// vertices which the change does not reach.
pub(crate) struct ForcedCache {
    blocks: Versioned<Block>,
    k: u32,
}

/// Words of the cache that versions share.
#[derive(Clone)]
struct Block(Arc<[AtomicU64; Block::WORDS]>);

impl Block {
    /// A kilobyte: an edit copies few, and a large map has not too many.
    const WORDS: usize = 1 << Self::LOG;
    const LOG: u32 = 7;

    fn new() -> Self {
        Self(Arc::new([const { AtomicU64::new(0) }; Self::WORDS]))
    }

    /// A block with the same facts, for another version.
    fn copy(&self) -> Self {
        Self(Arc::new(std::array::from_fn(|at| AtomicU64::new(self.0[at].load(Ordering::Relaxed)))))
    }
}

/// Blocks are the same if they are one block.
impl PartialEq for Block {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl fmt::Debug for ForcedCache {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "ForcedCache({} bytes)", self.memory_bytes())
    }
}

impl ForcedCache {
    /// The most memory used, 256 MiB; larger maps do without a cache.
    const MAX_WORDS: usize = 1 << 25;

    /// An empty cache for so many vertices with 2^k moves.
    pub(crate) fn new(vertices: usize, k: u32, interrupt: &Interrupt) -> Result<Self, Interrupted> {
        const PIECE: usize = 1 << 9;
        let words = vertices.div_ceil(32).checked_mul(1 << k);
        let count = words.filter(|&words| words <= Self::MAX_WORDS).unwrap_or(0).div_ceil(Block::WORDS);
        room_for::<Block>(count, "filling memory")?;
        let mut blocks = Vec::with_capacity(count);
        while blocks.len() < count {
            interrupt.check("filling memory")?;
            blocks.resize_with(count.min(blocks.len() + PIECE), Block::new);
        }
        Ok(Self { blocks: blocks.into(), k })
    }

    /// That of the map after a change, which knows what this one knows of vertices farther than `reach` cells
    /// from what changed.
    pub(crate) fn after<P: Placement>(
        &self,
        change: &Change,
        reach: u32,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let (width, height) = P::vertices(change.after());
        let near = |first: u32, count: u32, side: u32| {
            first.saturating_sub(reach)..first.saturating_add(count).saturating_add(reach + 1).min(side)
        };
        let mut left = self.blocks.len() * Block::WORDS;
        let mut blocks = self.blocks.edit_if_room("filling memory")?;
        for at in change.cells() {
            let (columns, rows) = (near(at.x, at.width, width), near(at.y, at.height, height));
            interrupt.check("forgetting what a change makes uncertain")?;
            for y in rows {
                let vertex = |x: u32| y as usize * width as usize + x as usize;
                let words = self.words(vertex(columns.start)..vertex(columns.end));
                let Some(rest) = left.checked_sub(words.len()) else {
                    return Self::new(width as usize * height as usize, self.k, interrupt);
                };
                left = rest;
                for word in words {
                    let (at, within) = (word >> Block::LOG, word % Block::WORDS);
                    let Some(old) = self.blocks.get(at) else { break };
                    if blocks.words()[at] == *old {
                        blocks.set(at, old.copy());
                    }
                    blocks.words()[at].0[within].store(0, Ordering::Relaxed);
                }
            }
        }
        Ok(Self { blocks: blocks.finish(), k: self.k })
    }

    /// The words with facts of these vertices.
    const fn words(&self, vertices: Range<usize>) -> Range<usize> {
        vertices.start << self.k >> 5..((vertices.end << self.k) + 31) >> 5
    }

    #[inline]
    fn place(&self, id: VertexId, by: usize) -> (Option<&AtomicU64>, u32) {
        let pair = id.index() << self.k | by;
        let block = self.blocks.get(pair >> (5 + Block::LOG));
        (block.map(|block| &block.0[pair >> 5 & (Block::WORDS - 1)]), 2 * (pair & 31) as u32)
    }

    /// Whether there is a forced successor, if that is known.
    #[inline]
    pub(crate) fn get(&self, id: VertexId, by: usize) -> Option<bool> {
        let (word, shift) = self.place(id, by);
        match word?.load(Ordering::Relaxed) >> shift & 3 {
            0 => None,
            bits => Some(bits == 2),
        }
    }

    /// Records whether there is a forced successor.
    #[inline]
    pub(crate) fn record(&self, id: VertexId, by: usize, forced: bool) {
        if let (Some(word), shift) = self.place(id, by) {
            word.fetch_or(1 << (shift + u32::from(forced)), Ordering::Relaxed);
        }
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        self.blocks.len() * (size_of::<Block>() + size_of::<[AtomicU64; Block::WORDS]>())
    }
}
