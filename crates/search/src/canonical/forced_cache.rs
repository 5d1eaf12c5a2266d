//! Which vertices have forced successors, as far as searches have found out.

use std::sync::atomic::{AtomicU64, Ordering};

use mediant_grid::{Interrupt, Interrupted, VertexId};

/// For each vertex and arriving move, whether there is a forced successor: two bits, of which the lower says
/// 'none', the higher 'some', and neither 'unknown'.
///
/// Any number of planners fill it as they ask. Each bit is a fact of the map, so their answers do not depend
/// on what is filled in.
#[derive(Debug)]
pub(crate) struct ForcedCache {
    words: Box<[AtomicU64]>,
    k: u32,
}

impl ForcedCache {
    /// The most memory used, 256 MiB; larger maps do without a cache.
    const MAX_WORDS: usize = 1 << 25;

    /// An empty cache for so many vertices with 2^k moves.
    pub(crate) fn new(vertices: usize, k: u32, interrupt: &Interrupt) -> Result<Self, Interrupted> {
        const PIECE: usize = 1 << 16;
        let words = vertices.div_ceil(32).checked_mul(1 << k);
        let count = words.filter(|&words| words <= Self::MAX_WORDS).unwrap_or(0);
        let mut words = Vec::with_capacity(count);
        while words.len() < count {
            interrupt.check("filling memory")?;
            words.resize_with(count.min(words.len() + PIECE), || AtomicU64::new(0));
        }
        Ok(Self { words: words.into_boxed_slice(), k })
    }

    #[inline]
    fn place(&self, id: VertexId, by: usize) -> (Option<&AtomicU64>, u32) {
        let pair = id.index() << self.k | by;
        (self.words.get(pair >> 5), 2 * (pair & 31) as u32)
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
        size_of_val(&*self.words)
    }
}
