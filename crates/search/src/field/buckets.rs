//! The queue of a field: vertices in buckets by their distance.

use mediant_grid::Vertex;
use mediant_moves::Cost;

/// A ring of buckets. Bucket n holds vertices whose distance, when they were queued, was from n to n + 1
/// widths. No vertex is queued further ahead than the ring is long (Dial 1969).
#[derive(Clone, Debug, Default)]
pub(super) struct Buckets {
    ring: Vec<Vec<u32>>,
    /// The binary logarithm of the width, in units of the cost.
    shift: u32,
    current: u64,
    queued: usize,
}

impl Buckets {
    /// Empty buckets, each 2^`width` cells wide, for moves of at most this length.
    pub(super) fn new(width: u32, longest: Cost) -> Self {
        let shift = Cost::FRACTION_BITS + width;
        // The move begins anywhere in its bucket.
        let ahead = (longest.to_bits() >> shift) as usize + 2;
        Self { ring: vec![Vec::new(); ahead.next_power_of_two()], shift, current: 0, queued: 0 }
    }

    /// Forgets what is queued, and begins at distance 0.
    pub(super) fn clear(&mut self) {
        self.ring.iter_mut().for_each(Vec::clear);
        (self.current, self.queued) = (0, 0);
    }

    /// Goes on at a distance. Nothing is queued.
    pub(super) const fn begin(&mut self, cost: Cost) {
        self.current = cost.to_bits() >> self.shift;
    }

    const fn slot(&self, bucket: u64) -> usize {
        bucket as usize & (self.ring.len() - 1)
    }

    /// Queues a vertex at its distance, which is not below that of the current bucket.
    #[inline]
    pub(super) fn push(&mut self, cost: Cost, at: Vertex) {
        let slot = self.slot(cost.to_bits() >> self.shift);
        if let Some(bucket) = self.ring.get_mut(slot) {
            // Coordinates are at most 2¹⁵.
            bucket.push(at.x as u32 | (at.y as u32) << 16);
            self.queued += 1;
        }
    }

    /// Takes a vertex from the current bucket: the one that was queued last.
    #[inline]
    pub(super) fn pop(&mut self) -> Option<Vertex> {
        let slot = self.slot(self.current);
        let at = self.ring.get_mut(slot)?.pop()?;
        self.queued -= 1;
        Some(Vertex::new((at & 0xFFFF) as i32, (at >> 16) as i32))
    }

    /// The least distance in the current bucket.
    pub(super) const fn start(&self) -> Cost {
        Cost::from_bits(self.current << self.shift)
    }

    /// The least distance beyond the current bucket.
    pub(super) const fn end(&self) -> Cost {
        Cost::from_bits((self.current + 1) << self.shift)
    }

    /// Goes on to the next bucket. Returns whether anything is queued.
    pub(super) const fn advance(&mut self) -> bool {
        self.current += 1;
        self.queued > 0
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.ring.iter().map(|bucket| size_of::<Vec<u32>>() + bucket.capacity() * size_of::<u32>()).sum()
    }
}
