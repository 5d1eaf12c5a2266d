//! Numbers for people: times, counts, lengths and percentages.

/// A time with three digits and a unit: `812 ns`, `1.23 µs`, `45.6 ms`.
pub(crate) fn time(nanos: f64) -> String {
    let units = [(1e3, 1.0, "ns"), (1e6, 1e3, "µs"), (1e9, 1e6, "ms"), (f64::INFINITY, 1e9, "s")];
    // The limits are a little low, so that 999.9 ns is shown as 1.00 µs, not as 1000 ns.
    let (_, unit, name) = units.into_iter().find(|(below, ..)| nanos < below * 0.9995).unwrap_or(units[3]);
    let value = nanos / unit;
    let digits = if name == "ns" || value >= 99.95 {
        0
    } else if value >= 9.995 {
        1
    } else {
        2
    };
    format!("{value:.digits$} {name}")
}

/// A whole number with commas between the thousands.
pub(crate) fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let groups: Vec<&str> = digits
        .as_bytes()
        .rchunks(3)
        .rev()
        .map(|group| std::str::from_utf8(group).unwrap_or_default())
        .collect();
    groups.join(",")
}

/// `1 query`, `2 queries`.
pub(crate) fn count(n: u64, one: &str, many: &str) -> String {
    format!("{} {}", grouped(n), if n == 1 { one } else { many })
}

/// A length, rounded to billionths of a cell, since a sum of rounded costs is not more exact.
pub(crate) fn rounded(length: f64) -> f64 {
    (length * 1e9).round() / 1e9
}

/// Seconds in hours and minutes: `1 h 02 min`; less than an hour in minutes and seconds, `2 min 05 s`.
pub(crate) fn hours(seconds: f64) -> String {
    let seconds = seconds.round() as u64;
    match seconds / 3_600 {
        0 => format!("{} min {:02} s", seconds / 60, seconds % 60),
        hours => format!("{} h {:02} min", grouped(hours), seconds % 3_600 / 60),
    }
}

/// The excess of a ratio over 1, in percent with a sign: `+8.24 %`.
pub(crate) fn percent_over(ratio: f64, digits: usize) -> String {
    let percent = (ratio - 1.0) * 100.0;
    // A negative number that is rounded to zero must not have a minus.
    let percent = if percent.abs() < 0.5 * 0.1_f64.powi(digits as i32) { 0.0 } else { percent };
    format!("{percent:+.digits$} %")
}

/// The excess of a ratio of two lengths over 1, in percent, with more digits if it is little: `8.24 %`,
/// `0.0120 %`.
pub(crate) fn excess(ratio: f64) -> String {
    let percent = (ratio - 1.0) * 100.0;
    let digits = if percent < 0.095 { 4 } else { 2 };
    format!("{percent:.digits$} %")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_three_digits_and_a_unit() {
        let shown = [0.0, 7.0, 999.0, 999.9, 1_234.0, 99_960.0, 999_600.0, 45_600_000.0, 9.99e9, 1.5e12];
        let shown: Vec<String> = shown.into_iter().map(time).collect();
        let expected = [
            "0 ns", "7 ns", "999 ns", "1.00 µs", "1.23 µs", "100 µs", "1.00 ms", "45.6 ms", "9.99 s",
            "1500 s",
        ];
        assert_eq!(shown, expected);
    }

    #[test]
    fn thousands_are_grouped() {
        assert_eq!([0, 999, 1_000, 12_345_678].map(grouped), ["0", "999", "1,000", "12,345,678"]);
    }

    #[test]
    fn long_times_are_in_hours() {
        assert_eq!(
            [60.0, 125.4, 3_599.4, 3_720.0].map(hours),
            ["1 min 00 s", "2 min 05 s", "59 min 59 s", "1 h 02 min"]
        );
    }

    #[test]
    fn percentages_have_a_sign_and_no_negative_zero() {
        assert_eq!(percent_over(1.0824, 2), "+8.24 %");
        assert_eq!(percent_over(1.0 - 1e-12, 2), "+0.00 %");
        assert_eq!(percent_over(0.5, 1), "-50.0 %");
    }

    #[test]
    fn what_is_longer_by_little_has_more_digits() {
        assert_eq!([1.0824, 1.001, 1.00012, 12.5].map(excess), ["8.24 %", "0.10 %", "0.0120 %", "1150.00 %"]);
    }
}
