//! What searches have found out about turns, kept for later ones.

use std::sync::atomic::{AtomicU64, Ordering};

use mediant_grid::VertexId;

/// For each vertex and incoming move, a bit: whether it is known that no turn follows. Filled as searches ask, by any number of planners at
/// once; since each bit is a fact of the map, what they answer does not depend on it.
#[derive(Debug)]
pub(crate) struct Settled {
    words: Box<[AtomicU64]>,
    k: u32,
}

impl Settled {
    /// Larger maps do without: 256 MiB.
    const MAX_WORDS: usize = 1 << 25;

    /// For so many vertices with 2^k moves.
    pub(crate) fn new(vertices: usize, k: u32) -> Self {
        let words = Some(vertices.div_ceil(64)).and_then(|words| words.checked_mul(1 << k));
        let words = words.filter(|&words| words <= Self::MAX_WORDS).unwrap_or(0);
        Self { words: (0..words).map(|_| AtomicU64::new(0)).collect(), k }
    }

    #[inline]
    fn place(&self, id: VertexId, by: usize) -> (Option<&AtomicU64>, u64) {
        let bit = id.index() << self.k | by;
        (self.words.get(bit >> 6), 1 << (bit & 63))
    }

    /// Whether no turn is known to follow.
    #[inline]
    pub(crate) fn has_none(&self, id: VertexId, by: usize) -> bool {
        let (word, bit) = self.place(id, by);
        word.is_some_and(|word| word.load(Ordering::Relaxed) & bit != 0)
    }

    /// Notes that none follows.
    #[inline]
    pub(crate) fn note_none(&self, id: VertexId, by: usize) {
        if let (Some(word), bit) = self.place(id, by) {
            word.fetch_or(bit, Ordering::Relaxed);
        }
    }

    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.words)
    }
}
