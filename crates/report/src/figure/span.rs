//! Which range an axis shows, and where its ticks are.

use super::{
    axis::{Axis, Scale},
    number::{decimal, exponent, plain, scientific},
    text::{TEXT, text_width},
};

/// Larger values are drawn as this one, and smaller ones as 0 or, on a logarithmic scale, as the smallest: no
/// measurement gets there, and spans stay finite.
const HUGE: f64 = 1e200;
const TINY: f64 = 1e-200;
/// A span that is smaller than this fraction of its ends is taken for a single value.
const SAME: f64 = 1e-9;

/// The range of an axis: its ends as values on a linear scale, as decimal logarithms on a logarithmic one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    scale: Scale,
    low: f64,
    high: f64,
}

impl Span {
    /// The span of an axis that is to show these values, apart from those that are not finite. With
    /// `from_zero`, a linear axis begins at 0 if that is not far below the values.
    pub(super) fn new(axis: &Axis, values: impl Iterator<Item = f64>, from_zero: bool) -> Self {
        let scale = axis.scale;
        let spans = |&(low, high): &(f64, f64)| {
            low.is_finite() && high.is_finite() && high - low > SAME * low.abs().max(high.abs())
        };
        let set = axis.range.filter(|(low, high)| low.is_finite() && high.is_finite());
        let set = set.map(|(low, high)| (transformed(scale, low), transformed(scale, high)));
        if let Some((low, high)) = set.filter(spans) {
            return Self { scale, low, high };
        }
        let all = values.chain(axis.named.iter().map(|(value, _)| *value)).filter(|value| value.is_finite());
        let all: Vec<f64> = all.map(|value| transformed(scale, value)).collect();
        let shown = || all.iter().copied().filter(|value| value.is_finite());
        let (low, high) = (shown().fold(f64::INFINITY, f64::min), shown().fold(f64::NEG_INFINITY, f64::max));
        let (low, high) = match scale {
            Scale::Linear => linear_range(low, high, from_zero && axis.has_round_ticks()),
            Scale::Log => log_range(low, high, shown().count() < all.len()),
        };
        Self { scale, low, high }
    }

    /// Where a value lies on the axis: 0 is the low end, 1 the high end. −∞ for values of 0 or less on a
    /// logarithmic scale.
    pub(super) fn fraction(&self, value: f64) -> f64 {
        let value = transformed(self.scale, value);
        if value == f64::NEG_INFINITY {
            return value;
        }
        ((value - self.low) / (self.high - self.low)).clamp(-1e12, 1e12)
    }

    /// The value at an end, as text.
    pub(super) fn end(&self, high: bool) -> String {
        let end = if high { self.high } else { self.low };
        plain(if self.scale == Scale::Log { 10_f64.powf(end) } else { end })
    }

    /// The ticks with their places, from low to high, for an axis of that many pixels. Each name takes `size`
    /// pixels along the axis, or the width of its text if `None`.
    pub(super) fn ticks(&self, axis: &Axis, pixels: f64, size: Option<f64>) -> Vec<(f64, String)> {
        let mut ticks = if axis.has_round_ticks() {
            self.round_ticks(pixels, size)
        } else {
            axis.named.iter().map(|(value, name)| (*value, name.clone())).collect()
        };
        for (value, _) in &mut ticks {
            *value = self.fraction(*value);
        }
        ticks.retain(|(fraction, _)| (-SAME..=1.0 + SAME).contains(fraction));
        ticks.sort_by(|a, b| a.0.total_cmp(&b.0));
        ticks
    }

    fn round_ticks(&self, pixels: f64, size: Option<f64>) -> Vec<(f64, String)> {
        let room = size.map_or(75.0, |size| 3.0 * size);
        let count = (pixels / room).max(2.0);
        if self.scale == Scale::Linear {
            return linear_ticks(self.low, self.high, count);
        }
        let between = log_ticks(self.low, self.high, &[1, 2, 5], 1);
        let labels = |ticks: &[(f64, String)]| -> f64 {
            ticks.iter().map(|(_, name)| size.unwrap_or_else(|| text_width(name, TEXT)) + 12.0).sum()
        };
        if between.len() < 3 {
            return linear_ticks(10_f64.powf(self.low), 10_f64.powf(self.high), count);
        }
        // 1, 2 and 5 are 0.3, 0.4 and 0.3 of a decade apart: the narrowest gap decides.
        let gap = pixels * 0.3 / (self.high - self.low);
        if labels(&between) / between.len() as f64 <= gap {
            return between;
        }
        let every = ((self.high - self.low) / count).ceil().max(1.0) as i32;
        log_ticks(self.low, self.high, &[1], every)
    }
}

fn transformed(scale: Scale, value: f64) -> f64 {
    match scale {
        Scale::Linear if value.abs() < TINY => 0.0,
        Scale::Linear => value.clamp(-HUGE, HUGE),
        Scale::Log if value > 0.0 => value.clamp(TINY, HUGE).log10(),
        Scale::Log => f64::NEG_INFINITY,
    }
}

/// The range from `low` to `high` with a border. With `from_zero` it begins at 0 if that is not far below:
/// heights are compared from there.
fn linear_range(low: f64, high: f64, from_zero: bool) -> (f64, f64) {
    if low > high {
        return (0.0, 1.0);
    }
    let size = low.abs().max(high.abs());
    if high - low <= SAME * size {
        let around = if size == 0.0 { 1.0 } else { 0.1 * size };
        return (low - around, high + around);
    }
    let border = 0.04 * (high - low);
    if from_zero && low >= 0.0 && low <= 0.3 * high {
        return (0.0, high + border);
    }
    (low - border, high + border)
}

/// The range from `low` to `high` with a border, of logarithms. With `clamped` there are also values without
/// a logarithm: they are drawn at the low end, which is then a round number below all others.
fn log_range(low: f64, high: f64, clamped: bool) -> (f64, f64) {
    if low > high {
        return (-1.0, 1.0);
    }
    let border = if high - low <= SAME { 0.3 } else { 0.04 * (high - low) };
    if !clamped {
        return (low - border, high + border);
    }
    let below = low - border.max(0.15 * (high - low));
    let decade = below.floor();
    let round = [5.0_f64, 2.0, 1.0].map(|digit| decade + digit.log10());
    (round.into_iter().find(|&at| at <= below).unwrap_or(decade), high + border)
}

/// About `count` ticks at the multiples of a step, which is 1, 2 or 5 times a power of ten.
fn linear_ticks(low: f64, high: f64, count: f64) -> Vec<(f64, String)> {
    let rough = (high - low) / count;
    let power = 10_f64.powi(exponent(rough));
    let step =
        power * [1.0, 2.0, 5.0, 10.0].into_iter().find(|digit| digit * power >= 0.85 * rough).unwrap_or(10.0);
    let size = low.abs().max(high.abs());
    let (first, last) = ((low / step - 1e-6).ceil(), (high / step + 1e-6).floor());
    let number = |value: f64| {
        if size >= 1e9 || step < 1e-6 {
            scientific(value, usize::try_from(exponent(value) - exponent(step)).unwrap_or(0))
        } else {
            decimal(value, usize::try_from(-exponent(step)).unwrap_or(0))
        }
    };
    (0..=(last - first) as i64).map(|i| (first + i as f64) * step).map(|v| (v, number(v))).collect()
}

/// Ticks at these digits times every `every`-th power of ten.
fn log_ticks(low: f64, high: f64, digits: &[u32], every: i32) -> Vec<(f64, String)> {
    let decades = (low - SAME).floor() as i32..=(high + SAME).floor() as i32;
    let decades = decades.filter(|decade| decade % every == 0);
    let ticks = decades.flat_map(|decade| digits.iter().map(move |&digit| (digit, decade)));
    let shown = |&(digit, decade): &(u32, i32)| {
        let at = f64::from(decade) + f64::from(digit).log10();
        (low - SAME..=high + SAME).contains(&at)
    };
    let ticks: Vec<(u32, i32)> = ticks.filter(shown).collect();
    let as_decimals = ticks.iter().all(|&(_, decade)| (-4..7).contains(&decade));
    let number = |(digit, decade): (u32, i32)| {
        let value = f64::from(digit) * 10_f64.powi(decade);
        let text = if as_decimals {
            decimal(value, usize::try_from(-decade).unwrap_or(0))
        } else {
            scientific(value, 0)
        };
        (value, text)
    };
    ticks.into_iter().map(number).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(axis: &Axis, values: &[f64], expected: &[&str]) {
        let ticks = Span::new(axis, values.iter().copied(), true).ticks(axis, 400.0, Some(14.0));
        assert_eq!(ticks.iter().map(|(_, name)| &**name).collect::<Vec<_>>(), expected);
    }

    #[test]
    fn ticks_are_round() {
        let (linear, log) = (Axis::new(""), Axis::new("").log());
        check(&linear, &[0.0, 10.0], &["0", "1", "2", "3", "4", "5", "6", "7", "8", "9", "10"]);
        check(
            &linear.clone().range(-1.0, 1.0),
            &[],
            &["−1.0", "−0.8", "−0.6", "−0.4", "−0.2", "0.0", "0.2", "0.4", "0.6", "0.8", "1.0"],
        );
        check(
            &linear,
            &[7e9, 8e9, 9e9],
            &[
                "7×10⁹",
                "7.2×10⁹",
                "7.4×10⁹",
                "7.6×10⁹",
                "7.8×10⁹",
                "8×10⁹",
                "8.2×10⁹",
                "8.4×10⁹",
                "8.6×10⁹",
                "8.8×10⁹",
                "9×10⁹",
            ],
        );
        check(&log, &[0.0005, 0.01], &["0.0005", "0.001", "0.002", "0.005", "0.01"]);
        check(&log, &[10.0, 1e7], &["10¹", "10²", "10³", "10⁴", "10⁵", "10⁶", "10⁷"]);
        check(&log, &[1.0, 1.15], &["1.00", "1.02", "1.04", "1.06", "1.08", "1.10", "1.12", "1.14"]);
        check(
            &linear.clone().ticks([(3.0, "k = 3".to_owned()), (f64::NAN, String::new())]),
            &[2.0],
            &["k = 3"],
        );
    }

    #[test]
    fn what_a_log_axis_lacks_is_below_a_round_number() {
        let axis = Axis::new("").log();
        let span = Span::new(&axis, [0.0, 0.03, 7.0, f64::NAN].into_iter(), true);
        assert_eq!(span.end(false), "0.01");
        assert_eq!(span.fraction(0.0), f64::NEG_INFINITY);
        assert!(span.fraction(0.03) > 0.1);
    }

    #[test]
    fn a_range_that_cannot_be_is_ignored() {
        for (low, high) in [(1.0, 1.0), (f64::NAN, 1.0), (0.0, 1.0), (-5.0, 0.0), (1.0, f64::INFINITY)] {
            let span = Span::new(&Axis::new("").log().range(low, high), [1.0, 100.0].into_iter(), true);
            assert!(span.low < 0.0 && span.high > 2.0, "{low} to {high}: {span:?}");
        }
        let span = Span::new(&Axis::new("").range(9.0, 4.0), [1.0].into_iter(), true);
        assert_eq!((span.low, span.high), (4.0, 9.0));
    }
}
