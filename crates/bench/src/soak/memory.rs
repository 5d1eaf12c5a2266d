//! Resident memory over the time of a soak.
//!
//! Measured is what stays when all maps, indexes and planners of a round are dropped. An allocator keeps some
//! of that, and how much differs from round to round; but the median of a quarter of all rounds does not
//! grow, unless something leaks. The first quarter counts for nothing: code, thread stacks and what a process
//! keeps are made there.
//!
//! With glibc's defaults the median grew on sides of 96 cells. With `MALLOC_ARENA_MAX=1`,
//! `MALLOC_MMAP_THRESHOLD_=16384` and `MALLOC_TRIM_THRESHOLD_=65536` in the environment it stayed at 11 MB in
//! each quarter of 88 shorter rounds. That points to what the allocator keeps; a count of allocated bytes
//! over the same rounds has not been made.

use std::fs;

/// The factor by which the last quarter's median may be above the second's.
const FACTOR: f64 = 1.125;
/// The bytes by which it may be above besides.
const ROOM: f64 = (16 << 20) as f64;

/// The resident memory of this process, in bytes; `None` where the system does not tell.
pub(super) fn resident() -> Option<u64> {
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

/// Whether memory is flat: the median of the last quarter is at most an eighth and 16 MiB above the second's.
pub(super) fn is_flat(quarters: &[f64; 4]) -> bool {
    quarters[3] <= quarters[1] * FACTOR + ROOM
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_grows_is_not_flat() {
        let grows: Vec<u64> = (0..80).map(|n| (40 + n) << 20).collect();
        assert!(!is_flat(&quarters(&grows).expect("there are some")));
        let warms: Vec<u64> = (0..80).map(|n| (40 + u64::min(n, 20) + n % 7) << 20).collect();
        assert!(is_flat(&quarters(&warms).expect("there are some")));
        assert_eq!(quarters(&[1, 2, 3]), None);
    }
}
