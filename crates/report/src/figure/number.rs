//! Numbers as text on axes.

use crate::number::grouped;

/// A number with this many decimals, and a comma between thousands: −1,234.50.
pub(super) fn decimal(value: f64, decimals: usize) -> String {
    let text = format!("{:.decimals$}", value.abs());
    let (whole, rest) = text.split_at(text.find('.').unwrap_or(text.len()));
    let is_zero = text.chars().all(|c| matches!(c, '0' | '.'));
    let sign = if value < 0.0 && !is_zero { "−" } else { "" };
    format!("{sign}{}{rest}", grouped(whole))
}

/// A number in scientific notation, with at most this many decimals: 2.5×10⁹, or 10⁹ if the first factor is
/// 1.
pub(super) fn scientific(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let exponent: String = exponent.chars().map(superscript).collect();
    let mantissa = trimmed(mantissa).replace('-', "−");
    match &*mantissa {
        "0" => mantissa,
        "1" => format!("10{exponent}"),
        "−1" => format!("−10{exponent}"),
        _ => format!("{mantissa}×10{exponent}"),
    }
}

/// A number rounded to three digits or to a whole number, in scientific notation if it is very small or
/// large.
pub(super) fn plain(value: f64) -> String {
    let exponent = exponent(value);
    if !(-4..7).contains(&exponent) {
        return scientific(value, 2);
    }
    trimmed(&decimal(value, usize::try_from(2 - exponent).unwrap_or(0))).to_owned()
}

/// The decimal exponent: 3 for 1,234. That of 0 is 0.
pub(super) fn exponent(value: f64) -> i32 {
    if value == 0.0 || !value.is_finite() { 0 } else { (value.abs().log10() + 1e-9).floor() as i32 }
}

fn trimmed(text: &str) -> &str {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text }
}

fn superscript(c: char) -> char {
    match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        _ => c.to_digit(10).and_then(|digit| char::from_u32(u32::from('⁰') + digit)).unwrap_or(c),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_readable() {
        assert_eq!(decimal(0.0005, 4), "0.0005");
        assert_eq!(decimal(1_234_567.0, 0), "1,234,567");
        assert_eq!(decimal(-1234.5, 2), "−1,234.50");
        assert_eq!(decimal(-0.001, 1), "0.0");
        assert_eq!(decimal(999.0, 0), "999");
        assert_eq!(scientific(2.5e9, 2), "2.5×10⁹");
        assert_eq!(scientific(-1e-12, 1), "−10⁻¹²");
        assert_eq!(scientific(0.0, 1), "0");
        assert_eq!(plain(0.000_123_4), "0.000123");
        assert_eq!(plain(1234.4), "1,234");
        assert_eq!(plain(100.0), "100");
        assert_eq!(plain(2.0), "2");
        assert_eq!(plain(3e8), "3×10⁸");
    }
}
