//! What searches have found out about turns, kept for later ones.

use std::sync::atomic::{AtomicU64, Ordering};

use mediant_grid::VertexId;

/// For each vertex and incoming move, whether a turn follows, as far as that is known: two bits. Filled as searches ask, by any number of
/// planners at once; since each bit is a fact of the map, what they answer does not depend on it.
#[derive(Debug)]
pub(crate) struct ForcedCache {
    words: Box<[AtomicU64]>,
    k: u32,
}

impl ForcedCache {
    /// Larger maps do without: 256 MiB.
    const MAX_WORDS: usize = 1 << 25;

    /// For so many vertices with 2^k moves.
    pub(crate) fn new(vertices: usize, k: u32) -> Self {
        let words = vertices.div_ceil(32).checked_mul(1 << k);
        let words = words.filter(|&words| words <= Self::MAX_WORDS).unwrap_or(0);
        Self { words: (0..words).map(|_| AtomicU64::new(0)).collect(), k }
    }

    #[inline]
    fn place(&self, id: VertexId, by: usize) -> (Option<&AtomicU64>, u32) {
        let pair = id.index() << self.k | by;
        (self.words.get(pair >> 5), 2 * (pair & 31) as u32)
    }

    /// Whether a turn follows, if that is known.
    #[inline]
    pub(crate) fn get(&self, id: VertexId, by: usize) -> Option<bool> {
        let (word, shift) = self.place(id, by);
        match word?.load(Ordering::Relaxed) >> shift & 3 {
            0 => None,
            bits => Some(bits == 2),
        }
    }

    /// Notes whether a turn follows.
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
