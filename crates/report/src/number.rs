//! Numbers as text.

/// A number for a table: three significant digits, at most three of them after the point, or a whole number
/// with a comma between thousands.
///
/// ```
/// use mediant_report::number;
/// assert_eq!([0.12345, 42.123, 1234.5].map(number), ["0.123", "42.1", "1,234"]);
/// ```
#[must_use]
pub fn number(value: f64) -> String {
    match value.abs() {
        size if size < 0.9995 => format!("{value:.3}"),
        size if size < 9.995 => format!("{value:.2}"),
        size if size < 99.95 => format!("{value:.1}"),
        _ => thousands(value),
    }
}

/// A number rounded to a whole one, with a comma between thousands.
#[must_use]
pub fn thousands(value: f64) -> String {
    let text = grouped(&format!("{:.0}", value.abs()));
    if value <= -0.5 { format!("-{text}") } else { text }
}

/// Decimal digits with a comma between thousands.
pub(crate) fn grouped(digits: &str) -> String {
    let mut text = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let numbers = [0.0, 0.12345, 0.9999, 1.005, 9.999, 42.123, 999.6, 1_234_567.0, -2.36];
        let texts = numbers.map(number);
        assert_eq!(texts, ["0.000", "0.123", "1.00", "1.00", "10.0", "42.1", "1,000", "1,234,567", "-2.36"]);
        assert_eq!([0.4, -0.4, -1234.0].map(thousands), ["0", "0", "-1,234"]);
    }
}
