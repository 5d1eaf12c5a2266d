//! The pace of a map in integers.

use super::Pace;
use crate::scale::exp2;

/// The unit of slopes is 2 to minus this.
pub(super) const SLOPE_DIGITS: u32 = 40;
/// More than any slope on a map, so that sums with it fit.
const ENDLESS: i64 = 1 << 61;
/// The most buckets.
const BUCKETS: i64 = 1 << 13;

/// The time of a unit of length by the slope, in integers: linear pieces, which are found by buckets of
/// slopes.
///
/// Slopes are multiples of 2⁻⁴⁰, times of a unit of the map. What an interpolation gives is rounded down to a
/// time, which changes it by 2⁻⁴³ of the greatest at most.
#[derive(Clone, Debug)]
pub(super) struct PaceTable {
    segments: Box<[Segment]>,
    /// For each bucket the segment in which it begins. Before the first lies all that is less than `first`.
    buckets: Box<[u32]>,
    first: i64,
    shift: u32,
    /// The bounds of the times, which an interpolation keeps.
    pub(super) least: i64,
    pub(super) greatest: i64,
    /// No piece counts as steeper.
    steepest: u64,
}

/// From a slope to the next segment's.
#[derive(Clone, Copy, Debug)]
struct Segment {
    from: i64,
    time: i64,
    /// By 1 of slope.
    gradient: i64,
}

/// The part of a pace's knots that counts on slopes up to the steepest one, which ends there.
pub(super) fn clip(knots: &[(f64, f64)], steepest: f64) -> Vec<(f64, f64)> {
    let pace = Pace::Table(knots.to_vec());
    let end = |slope: f64| (slope, pace.time(slope));
    let within = knots.iter().copied().filter(|(slope, _)| slope.abs() < steepest);
    std::iter::once(end(-steepest)).chain(within).chain([end(steepest)]).collect()
}

/// A slope in its unit.
fn fixed(slope: f64) -> i64 {
    // The cast saturates.
    ((slope * exp2(SLOPE_DIGITS as i32)).round() as i64).clamp(-ENDLESS, ENDLESS)
}

impl PaceTable {
    /// The table of some knots, of which there is one at least, in times of the unit 2 to `exponent`. They
    /// end at the steepest slope.
    pub(super) fn new(knots: &[(f64, f64)], steepest: f64, exponent: i32) -> Self {
        let unit = exp2(-exponent);
        let time = |time: f64| (time * unit).round() as i64;
        let flat = |from: i64, (_, at): (f64, f64)| Segment { from, time: time(at), gradient: 0 };
        let (first, last) = (knots[0], knots[knots.len() - 1]);
        let mut segments = vec![flat(-ENDLESS, first)];
        segments.extend(knots.windows(2).filter(|ends| fixed(ends[0].0) < fixed(ends[1].0)).map(|ends| {
            let [(from, early), (to, late)] = [ends[0], ends[1]];
            let gradient = ((late - early) / (to - from) * unit).round() as i64;
            Segment { from: fixed(from), time: time(early), gradient }
        }));
        segments.push(flat(fixed(last.0), last));
        let (first, width) = (fixed(first.0), fixed(last.0) - fixed(first.0));
        let shift = (width / BUCKETS).max(1).ilog2() + 1;
        let begins = (0..=width >> shift).map(|bucket| first + (bucket << shift));
        let at = |slope: i64| segments.partition_point(|segment| segment.from <= slope) as u32 - 1;
        let buckets = std::iter::once(0).chain(begins.map(at)).collect();
        let times = || knots.iter().map(|&(_, at)| time(at));
        Self {
            segments: segments.into(),
            buckets,
            first,
            shift,
            least: times().min().unwrap_or(1),
            greatest: times().max().unwrap_or(1),
            steepest: fixed(steepest) as u64,
        }
    }

    /// The time of a unit of length on a slope.
    #[inline]
    pub(super) fn time(&self, slope: i64) -> i64 {
        let bucket = ((slope - self.first) >> self.shift).saturating_add(1).max(0) as usize;
        let mut at = self.buckets[bucket.min(self.buckets.len() - 1)] as usize;
        while self.segments.get(at + 1).is_some_and(|next| next.from <= slope) {
            at += 1;
        }
        let Segment { from, time, gradient } = self.segments[at];
        let more = (i128::from(slope - from) * i128::from(gradient)) >> SLOPE_DIGITS;
        (time + more as i64).clamp(self.least, self.greatest)
    }

    /// The steepest slope of a piece.
    #[inline]
    pub(super) const fn steepest(&self) -> u64 {
        self.steepest
    }

    /// Numbers by which two tables differ.
    pub(super) fn words(&self) -> impl Iterator<Item = i64> {
        self.segments.iter().flat_map(|segment| [segment.from, segment.time, segment.gradient])
    }

    pub(super) fn memory_bytes(&self) -> usize {
        size_of_val(&*self.segments) + size_of_val(&*self.buckets)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::walking::Langmuir;

    #[test]
    fn times_are_those_of_the_pace() {
        let table = Pace::Table(vec![(-0.5, 2.0), (-0.1, 0.5), (-0.1, 0.7), (0.0, 0.8), (7.0, 9.0)]);
        for pace in [Pace::Tobler, Pace::Langmuir(Langmuir::default()), table] {
            for steepest in [0.1, 1.0, 40.0] {
                let knots = clip(&pace.knots(steepest).expect("a pace"), steepest);
                let unit = exp2(-36);
                let of = PaceTable::new(&knots, steepest, -36);
                for step in -1000..=1000 {
                    let slope = f64::from(step) / 1000.0 * steepest;
                    let found = of.time(fixed(slope)) as f64 * unit;
                    let expected = pace.time(slope);
                    // Where it jumps, a slope is rounded to either side.
                    let other = pace.time(slope - 1e-12);
                    let near = |expected: f64| (found / expected - 1.0).abs() < 2e-6;
                    assert!(near(expected) || near(other), "{pace:?} at {slope}: {found}, not {expected}");
                    assert!((of.least..=of.greatest).contains(&of.time(fixed(slope))));
                }
            }
        }
    }
}
