//! Latencies in memory that does not grow with their number.

use std::time::Duration;

use super::kind::Kind;

/// Buckets for each factor of two; so a percentile is too large by a sixteenth at most.
const PARTS: u64 = 16;
/// Buckets in all: up to 2⁶⁴ ns.
const BUCKETS: usize = 61 * PARTS as usize;

/// Counts of latencies by size.
#[derive(Clone, Debug)]
pub(super) struct Latencies {
    counts: Vec<u64>,
    count: u64,
    longest: u64,
}

impl Default for Latencies {
    fn default() -> Self {
        Self { counts: vec![0; BUCKETS], count: 0, longest: 0 }
    }
}

/// The bucket of a number of nanoseconds. Below 16 each number has its own.
const fn bucket(nanoseconds: u64) -> usize {
    if nanoseconds < PARTS {
        return nanoseconds as usize;
    }
    let power = nanoseconds.ilog2() as u64;
    let part = (nanoseconds >> (power - 4)) - PARTS;
    ((power - 3) * PARTS + part) as usize
}

/// The largest number of nanoseconds in a bucket.
const fn end(bucket: usize) -> u64 {
    let (power, part) = (bucket as u64 / PARTS, bucket as u64 % PARTS);
    if power == 0 {
        return part;
    }
    // In this order nothing overflows in the last bucket.
    ((PARTS + part) << (power - 1)) + ((1 << (power - 1)) - 1)
}

impl Latencies {
    /// Counts one.
    pub(super) fn add(&mut self, latency: Duration) {
        let nanoseconds = u64::try_from(latency.as_nanos()).unwrap_or(u64::MAX);
        self.counts[bucket(nanoseconds)] += 1;
        self.count += 1;
        self.longest = self.longest.max(nanoseconds);
    }

    /// Adds those of another thread.
    pub(super) fn merge(&mut self, other: &Self) {
        self.counts.iter_mut().zip(&other.counts).for_each(|(own, other)| *own += other);
        self.count += other.count;
        self.longest = self.longest.max(other.longest);
    }

    /// Their number.
    pub(super) const fn count(&self) -> u64 {
        self.count
    }

    /// The longest, in milliseconds.
    pub(super) fn longest(&self) -> f64 {
        self.longest as f64 / 1e6
    }

    /// The latency that `per_mille` of all do not exceed, in milliseconds; `None` without any.
    pub(super) fn percentile(&self, per_mille: u64) -> Option<f64> {
        let rank = (u128::from(self.count) * u128::from(per_mille)).div_ceil(1000).max(1);
        let mut seen = 0;
        let found = self.counts.iter().position(|&count| {
            seen += u128::from(count);
            seen >= rank
        })?;
        Some(end(found).min(self.longest) as f64 / 1e6)
    }
}

/// The latencies of each kind.
#[derive(Clone, Debug)]
pub(super) struct Log([Latencies; Kind::ALL.len()]);

impl Default for Log {
    fn default() -> Self {
        Self(std::array::from_fn(|_| Latencies::default()))
    }
}

impl Log {
    /// Counts one.
    pub(super) fn add(&mut self, kind: Kind, latency: Duration) {
        self.0[kind as usize].add(latency);
    }

    /// Adds those of another thread.
    pub(super) fn merge(&mut self, other: &Self) {
        self.0.iter_mut().zip(&other.0).for_each(|(own, other)| own.merge(other));
    }

    /// The latencies of a kind.
    pub(super) const fn of(&self, kind: Kind) -> &Latencies {
        &self.0[kind as usize]
    }

    /// The number of all operations.
    pub(super) fn count(&self) -> u64 {
        self.0.iter().map(Latencies::count).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn buckets_hold_what_they_say() {
        for nanoseconds in [0, 1, 15, 16, 17, 31, 32, 33, 1000, 1 << 40, u64::MAX - 1, u64::MAX] {
            let own = bucket(nanoseconds);
            assert!(
                end(own) >= nanoseconds && end(own) - nanoseconds <= nanoseconds / PARTS,
                "{nanoseconds}"
            );
            assert!(own == 0 || end(own - 1) < nanoseconds, "{nanoseconds}");
        }
        assert_eq!(bucket(u64::MAX), BUCKETS - 1);
    }

    #[test]
    fn kinds_are_numbered_in_order() {
        assert!(Kind::ALL.iter().enumerate().all(|(number, &kind)| kind as usize == number));
    }

    #[test]
    fn percentiles_are_ranks() {
        let mut all = Latencies::default();
        assert_eq!(all.percentile(500), None);
        (1..=1000).for_each(|n| all.add(Duration::from_micros(n)));
        for (per_mille, exact) in [(500, 0.5), (990, 0.99), (999, 0.999), (1000, 1.0)] {
            let found = all.percentile(per_mille).expect("there are some");
            assert!(found >= exact && found <= exact * (1.0 + 1.0 / 16.0), "{per_mille}: {found}");
        }
        assert!((all.longest() - 1.0).abs() < 1e-12);
    }
}
