//! The queue of a field: states in buckets by their cost.

/// A ring of buckets, each 2^`shift` units of cost wide (Dial 1969). No state is queued further ahead than
/// the ring is long.
#[derive(Debug)]
pub(super) struct Buckets {
    ring: Vec<Vec<u32>>,
    shift: u32,
    current: u64,
    queued: usize,
}

/// The most buckets. With more, looking for the next one that holds something takes longer than scanning some
/// states twice.
const MOST: u64 = 1 << 12;

impl Buckets {
    /// Empty buckets for moves between these two costs. They are as wide as the least move at most, so that
    /// what a bucket holds when it is opened is final, and each state is scanned once; unless the moves
    /// differ so much that the ring would be too long.
    pub(super) fn new(least: u64, greatest: u64) -> Self {
        let narrow = least.max(1).ilog2();
        let most = (greatest / MOST).max(1).ilog2() + 1;
        let shift = if greatest >> narrow < MOST { narrow } else { most };
        // The move begins anywhere in its bucket.
        let ahead = (greatest >> shift) + 2;
        Self { ring: vec![Vec::new(); ahead.next_power_of_two() as usize], shift, current: 0, queued: 0 }
    }

    #[inline]
    fn slot(&self, bucket: u64) -> usize {
        bucket as usize & (self.ring.len() - 1)
    }

    /// The bucket of a cost.
    #[inline]
    pub(super) const fn of(&self, cost: u64) -> u64 {
        cost >> self.shift
    }

    #[inline]
    pub(super) const fn current(&self) -> u64 {
        self.current
    }

    /// Queues a state whose cost became `cost` from `before`, if it does not wait in the same bucket already.
    /// A state of the current bucket may be done already, and is queued anew.
    #[inline]
    pub(super) fn push(&mut self, state: usize, cost: u64, before: u64) {
        let bucket = self.of(cost);
        if bucket != self.of(before) || bucket == self.current {
            let slot = self.slot(bucket);
            self.ring[slot].push(state as u32);
            self.queued += 1;
        }
    }

    /// Takes the states of the next bucket that holds any into an empty list. Returns whether one does.
    pub(super) fn take(&mut self, states: &mut Vec<u32>) -> bool {
        match self.first() {
            Some(bucket) => {
                self.take_from(bucket, states);
                true
            }
            None => false,
        }
    }

    /// The next bucket that holds states.
    pub(super) fn first(&self) -> Option<u64> {
        (self.queued > 0)
            .then(|| (self.current..).find(|&bucket| !self.ring[self.slot(bucket)].is_empty()))?
    }

    /// Goes on to a bucket, before which none is queued, and takes its states into an empty list; those that
    /// it holds by then.
    pub(super) fn take_from(&mut self, bucket: u64, states: &mut Vec<u32>) {
        self.current = bucket;
        let slot = self.slot(bucket);
        std::mem::swap(&mut self.ring[slot], states);
        self.queued -= states.len();
    }

    /// The least cost in a bucket.
    pub(super) const fn start_of(&self, bucket: u64) -> u64 {
        bucket << self.shift
    }

    /// The memory used, in bytes.
    pub(super) fn memory_bytes(&self) -> usize {
        self.ring.iter().map(|bucket| size_of::<Vec<u32>>() + bucket.capacity() * size_of::<u32>()).sum()
    }
}
