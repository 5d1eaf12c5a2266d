//! Random numbers that are the same everywhere, of a seed or of given bytes.

/// SplitMix64 (Steele, Lea, Flood, 'Fast Splittable Pseudorandom Number Generators', OOPSLA 2014). The state
/// is 64 bits, initially the seed; every seed is good.
///
/// ```
/// use mediant_oracle::Rng;
/// let (mut a, mut b) = (Rng::new(7), Rng::new(7));
/// assert_eq!(a.below(6), b.below(6));
/// ```
///
/// One [of bytes](Self::of_bytes) takes its numbers from these, so that a fuzzer that changes a byte changes
/// one choice of what is drawn.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rng {
    state: u64,
    /// Bytes that come first, the next one last.
    bytes: Vec<u8>,
}

impl Rng {
    /// The generator with this seed.
    #[must_use]
    pub const fn new(seed: u64) -> Self {
        Self { state: seed, bytes: Vec::new() }
    }

    /// The generator whose numbers are these bytes, and after them those of seed 0: so what draws until it
    /// has enough comes to an end.
    ///
    /// ```
    /// use mediant_oracle::Rng;
    /// let mut rng = Rng::of_bytes(&[9, 130]);
    /// assert_eq!((rng.below(6), rng.chance(50), rng.has_bytes()), (3, true, false));
    /// ```
    #[must_use]
    pub fn of_bytes(bytes: &[u8]) -> Self {
        Self { state: 0, bytes: bytes.iter().rev().copied().collect() }
    }

    /// Whether there are bytes left.
    #[must_use]
    pub const fn has_bytes(&self) -> bool {
        !self.bytes.is_empty()
    }

    /// The number of the next bytes, at most so many of them.
    fn taken(&mut self, count: usize) -> u64 {
        let mut number = 0;
        for _ in 0..count {
            number = number << 8 | u64::from(self.bytes.pop().unwrap_or_default());
        }
        number
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        if self.has_bytes() {
            return self.taken(8);
        }
        self.state = self.state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// A number from 0 to `n` − 1 (0 for n = 0), uniform up to 2⁻³²; of bytes, by the fewest of them.
    pub fn below(&mut self, n: u32) -> u32 {
        if self.has_bytes() {
            let count = [0x100, 0x1_0000].iter().filter(|&&end| n > end).count();
            return (self.taken([1, 2, 4][count]) % u64::from(n.max(1))) as u32;
        }
        (((self.bits() >> 32) * u64::from(n)) >> 32) as u32
    }

    /// True with a probability of `percent` / 100.
    pub fn chance(&mut self, percent: u32) -> bool {
        self.below(100) < percent
    }

    /// One of the items; `None` if there are none.
    pub fn pick<'a, T>(&mut self, items: &'a [T]) -> Option<&'a T> {
        items.get(self.below(u32::try_from(items.len()).unwrap_or(u32::MAX)) as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_outputs_of_seed_0() {
        // From the published reference implementation.
        let mut rng = Rng::new(0);
        let first = [rng.bits(), rng.bits(), rng.bits()];
        assert_eq!(first, [0xE220_A839_7B1D_CDAF, 0x6E78_9E6A_A1B9_65F4, 0x06C4_5D18_8009_454F]);
    }

    #[test]
    fn below_reaches_all_and_only_numbers_below() {
        let mut rng = Rng::new(1);
        let mut seen = [false; 7];
        (0..200).for_each(|_| seen[rng.below(7) as usize] = true);
        assert_eq!(seen, [true; 7]);
        assert_eq!(rng.below(0), 0);
        assert_eq!(rng.pick::<u8>(&[]), None);
    }

    #[test]
    fn numbers_of_bytes_come_before_those_of_seed_0() {
        let mut rng = Rng::of_bytes(&[7, 1, 2, 0, 1, 0, 0, 5]);
        assert_eq!((rng.below(256), rng.below(1000), rng.below(70_000)), (7, 258, 65_536));
        assert_eq!((rng.has_bytes(), rng.bits(), rng.has_bytes()), (true, 5 << 56, false));
        assert_eq!(rng, Rng::new(0));
        assert_eq!((rng.below(0), rng.bits()), (0, 0x6E78_9E6A_A1B9_65F4));
    }
}
