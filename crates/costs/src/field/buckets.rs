//! The queue of a field: states in buckets by their cost.

/// A ring of buckets, each 2^`shift` units of cost wide (Dial 1969). No state is queued further ahead than
/// the ring is long.
///
/// All buckets share a pool of chunks, which go from those that were emptied to those that fill: so it takes
/// little more than what is queued at once. A list of its own for each bucket would keep the greatest length
/// that it ever had, and all of them together much more.
#[derive(Debug)]
pub(super) struct Buckets {
    ring: Vec<Bucket>,
    /// The states of all chunks, [`CHUNK`] each.
    pool: Vec<u32>,
    /// Of each chunk the one before it in its bucket, or in the list of those that are free.
    before: Vec<u32>,
    free: u32,
    shift: u32,
    current: u64,
    queued: usize,
}

/// The states of a bucket: full chunks, but for the last one.
#[derive(Clone, Copy, Debug)]
struct Bucket {
    last: u32,
    /// The states in the last chunk.
    len: u32,
}

/// The states of a chunk.
const CHUNK: usize = 64;
/// No chunk.
const NONE: u32 = u32::MAX;

impl Bucket {
    /// The next state needs a chunk.
    const EMPTY: Self = Self { last: NONE, len: CHUNK as u32 };
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
        let ring = vec![Bucket::EMPTY; ahead.next_power_of_two() as usize];
        Self { ring, pool: Vec::new(), before: Vec::new(), free: NONE, shift, current: 0, queued: 0 }
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
            if self.ring[slot].len as usize == CHUNK {
                let last = self.chunk(self.ring[slot].last);
                self.ring[slot] = Bucket { last, len: 0 };
            }
            let Bucket { last, len } = &mut self.ring[slot];
            self.pool[*last as usize * CHUNK + *len as usize] = state as u32;
            *len += 1;
            self.queued += 1;
        }
    }

    /// A chunk after another one of its bucket.
    #[cold]
    fn chunk(&mut self, before: u32) -> u32 {
        let chunk = self.free;
        if chunk == NONE {
            let chunks = self.before.len();
            if chunks == self.before.capacity() {
                // Memory by eighths, not by doubling.
                let more = (chunks / 8).max(16);
                self.before.reserve_exact(more);
                self.pool.reserve_exact(more * CHUNK);
            }
            self.before.push(before);
            self.pool.resize((chunks + 1) * CHUNK, 0);
            return chunks as u32;
        }
        self.free = std::mem::replace(&mut self.before[chunk as usize], before);
        chunk
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
            .then(|| (self.current..).find(|&bucket| self.ring[self.slot(bucket)].last != NONE))?
    }

    /// Goes on to a bucket, before which none is queued, and takes its states into an empty list; those that
    /// it holds by then.
    pub(super) fn take_from(&mut self, bucket: u64, states: &mut Vec<u32>) {
        self.current = bucket;
        let slot = self.slot(bucket);
        let Bucket { mut last, len } = std::mem::replace(&mut self.ring[slot], Bucket::EMPTY);
        let mut len = len as usize;
        while last != NONE {
            let first = last as usize * CHUNK;
            states.extend_from_slice(&self.pool[first..first + len]);
            let before = std::mem::replace(&mut self.before[last as usize], self.free);
            (self.free, last, len) = (last, before, CHUNK);
        }
        self.queued -= states.len();
    }

    /// The least cost in a bucket.
    pub(super) const fn start_of(&self, bucket: u64) -> u64 {
        bucket << self.shift
    }

    /// The memory used, in bytes.
    pub(super) fn memory_bytes(&self) -> usize {
        self.ring.capacity() * size_of::<Bucket>()
            + (self.pool.capacity() + self.before.capacity()) * size_of::<u32>()
    }
}
