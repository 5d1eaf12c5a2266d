//! Memory over the time of a soak.
//!
//! Measured is what stays when all maps, indexes and planners of a round are dropped.
//!
//! **The key decision: what is judged is the number of allocated bytes, not of resident ones.** The first is
//! exact, so that a leak of a kilobyte in each round of an hour is seen. Of what is freed an allocator keeps
//! as much as it wants: with glibc's defaults the resident memory grew from 20 to 69 MB in 12.5 minutes, and
//! stayed at 11 MB with one arena and low thresholds. It is told, but not judged.

use std::{alloc::System, fs};

use stats_alloc::{INSTRUMENTED_SYSTEM, StatsAlloc};

/// The allocator whose bytes are counted, for a program to name as its own.
pub static COUNTED: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// The bytes by which the last quarter's median may be above the second's. The tables of all motions, which
/// the first round of each makes, take a quarter of that.
const ROOM: f64 = (512 << 10) as f64;

/// Memory after a round, in bytes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Memory {
    /// Allocated bytes; 0 in a program whose allocator is not [`COUNTED`].
    pub(super) allocated: u64,
    /// Resident bytes; `None` where the system does not tell.
    pub(super) resident: Option<u64>,
}

impl Memory {
    pub(super) fn now() -> Self {
        let stats = COUNTED.stats();
        let allocated = stats.bytes_allocated.saturating_sub(stats.bytes_deallocated) as u64;
        Self { allocated, resident: resident() }
    }
}

fn resident() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    Some(line.split_whitespace().next()?.parse::<u64>().ok()? << 10)
}

/// The medians of the four quarters of samples, in bytes; `None` if there are fewer than four.
pub(super) fn quarters(samples: &[u64]) -> Option<[f64; 4]> {
    let mut medians = [0.0; 4];
    for (number, median) in medians.iter_mut().enumerate() {
        let part = &samples[samples.len() * number / 4..samples.len() * (number + 1) / 4];
        let part: Vec<f64> = part.iter().map(|&bytes| bytes as f64).collect();
        *median = mediant_report::stats::median(&part)?;
    }
    Some(medians)
}

/// Whether allocated memory is flat: the median of the last quarter is at most a little above the second's.
/// The first counts for nothing: what a process makes once is made there.
pub(super) fn is_flat(quarters: &[f64; 4]) -> bool {
    quarters[3] <= quarters[1] + ROOM
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_grows_is_not_flat() {
        let grows: Vec<u64> = (0..80).map(|n| (40 << 20) + (n << 14)).collect();
        assert!(!is_flat(&quarters(&grows).expect("there are some")));
        let warms: Vec<u64> = (0..80).map(|n| (40 << 20) + ((u64::min(n, 20) + n % 7) << 14)).collect();
        assert!(is_flat(&quarters(&warms).expect("there are some")));
        assert_eq!(quarters(&[1, 2, 3]), None);
    }
}
