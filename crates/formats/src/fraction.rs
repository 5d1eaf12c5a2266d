//! Numbers from 0 to 1, exactly.

use std::{cmp::Ordering, fmt, str::FromStr};

/// A number from 0 to 1, as a quotient of integers. The thresholds of pictures are such numbers, so that a
/// shade is compared with them without rounding.
///
/// Decimals are read to nine places and rounded there, half up. So 0.65000000000000002, as some programs
/// write it, is 0.65.
///
/// ```
/// use mediant_formats::Fraction;
/// let third: Fraction = "0.196".parse()?;
/// assert_eq!(Some(third), Fraction::new(49, 250));
/// assert_eq!(Fraction::try_from(0.196)?, third);
/// assert!(third < Fraction::HALF && "1.5".parse::<Fraction>().is_err());
/// # Ok::<(), mediant_formats::FractionError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Fraction {
    /// At most the denominator, and without a common divisor.
    numerator: u32,
    denominator: u32,
}

/// A text or number that is no number from 0 to 1.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected a number of 0 to 1, found `{found}`; write for instance 0.5")]
pub struct FractionError {
    /// The text or number.
    pub found: String,
}

/// 10⁹ is the largest power of ten below 2³².
const PLACES: usize = 9;
const PARTS: u32 = 1_000_000_000;

impl Fraction {
    /// 0.
    pub const ZERO: Self = Self { numerator: 0, denominator: 1 };
    /// 1/2.
    pub const HALF: Self = Self { numerator: 1, denominator: 2 };
    /// 1.
    pub const ONE: Self = Self { numerator: 1, denominator: 1 };

    /// `numerator` / `denominator`; `None` if that is more than 1 or has the denominator 0.
    #[must_use]
    pub const fn new(numerator: u32, denominator: u32) -> Option<Self> {
        if denominator == 0 || numerator > denominator {
            return None;
        }
        let (mut divisor, mut rest) = (denominator, numerator);
        while rest > 0 {
            (divisor, rest) = (rest, divisor % rest);
        }
        Some(Self { numerator: numerator / divisor, denominator: denominator / divisor })
    }

    /// Numerator and denominator, without a common divisor.
    #[must_use]
    pub const fn parts(self) -> (u32, u32) {
        (self.numerator, self.denominator)
    }

    /// The smallest whole number that is at least `whole` times this.
    pub(crate) fn ceil_of(self, whole: u32) -> u32 {
        let product = u64::from(whole) * u64::from(self.numerator);
        // At most `whole`.
        product.div_ceil(u64::from(self.denominator)) as u32
    }

    /// How `part` / `whole` compares with this.
    pub(crate) fn compare(self, part: u64, whole: u64) -> Ordering {
        let [part, whole] =
            [(part, self.denominator), (whole, self.numerator)].map(|(n, by)| u128::from(n) * u128::from(by));
        part.cmp(&whole)
    }
}

impl Ord for Fraction {
    fn cmp(&self, other: &Self) -> Ordering {
        other.compare(u64::from(self.numerator), u64::from(self.denominator))
    }
}

impl PartialOrd for Fraction {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl FromStr for Fraction {
    type Err = FractionError;

    /// Reads a decimal such as `0.65`, `.65`, `1` or `6.5e-1`.
    fn from_str(text: &str) -> Result<Self, FractionError> {
        let error = || FractionError { found: text.chars().take(40).collect() };
        let number = crate::text::decimal(text).ok_or_else(error)?;
        if text.contains(['e', 'E']) {
            return Self::try_from(number).map_err(|_| error());
        }
        decimals(text).filter(|_| number.is_sign_positive()).ok_or_else(error)
    }
}

/// The value of digits with at most one point among them, if it is at most 1.
fn decimals(text: &str) -> Option<Fraction> {
    let text = text.strip_prefix('+').unwrap_or(text);
    let (whole, places) = text.split_once('.').unwrap_or((text, ""));
    let whole = match whole.trim_start_matches('0') {
        "" => 0,
        "1" => PARTS,
        _ => return None,
    };
    let digits = places.bytes().chain(std::iter::repeat(b'0')).take(PLACES);
    let parts = digits.fold(0, |parts, digit| parts * 10 + u32::from(digit - b'0'));
    let up = places.as_bytes().get(PLACES).is_some_and(|&digit| digit >= b'5');
    // Beyond 1 by what is rounded away, as 1.0000000001 is, is beyond 1.
    if whole > 0 && places.bytes().any(|digit| digit != b'0') {
        return None;
    }
    Fraction::new(whole + parts + u32::from(up), PARTS)
}

impl TryFrom<f64> for Fraction {
    type Error = FractionError;

    /// The decimal that the number is usually written as: 0.65 becomes 13/20.
    fn try_from(number: f64) -> Result<Self, FractionError> {
        let error = || FractionError { found: number.to_string() };
        if !(0.0..=1.0).contains(&number) {
            return Err(error());
        }
        // The shortest digits that stand for this number, never with an exponent. −0 becomes 0.
        decimals(&(number + 0.0).to_string()).ok_or_else(error)
    }
}

/// As a decimal of at most nine places.
impl fmt::Display for Fraction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (numerator, denominator) = (u64::from(self.numerator), u64::from(self.denominator));
        let parts = (2 * numerator * u64::from(PARTS) + denominator) / (2 * denominator);
        let (whole, parts) = (parts / u64::from(PARTS), parts % u64::from(PARTS));
        let text = format!("{whole}.{parts:09}");
        f.write_str(text.trim_end_matches('0').trim_end_matches('.'))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts() {
        let parts = |text: &str| text.parse::<Fraction>().map(Fraction::parts).ok();
        let cases = [
            ("0.65", Some((13, 20))),
            ("0.65000000000000002", Some((13, 20))),
            ("0.6499999999999999", Some((13, 20))),
            (".5", Some((1, 2))),
            ("1.", Some((1, 1))),
            ("+1.000", Some((1, 1))),
            ("00.25", Some((1, 4))),
            ("2.5e-1", Some((1, 4))),
            ("0", Some((0, 1))),
            ("1.0000000001", None),
            ("2", None),
            ("-0.1", None),
            ("nan", None),
            ("inf", None),
            ("", None),
            (".", None),
            ("0,5", None),
            ("0.5.5", None),
            ("1e999", None),
        ];
        for (text, expected) in cases {
            assert_eq!(parts(text), expected, "{text}");
        }
    }

    #[test]
    fn written_and_read_again() {
        for parts in (0..=1000).chain([333_333_333, 999_999_999, PARTS]) {
            let fraction = Fraction::new(parts, PARTS).unwrap();
            assert_eq!(fraction.to_string().parse(), Ok(fraction));
            assert_eq!(Fraction::try_from(f64::from(parts) / f64::from(PARTS)), Ok(fraction));
        }
        assert_eq!(Fraction::new(2, 3).unwrap().to_string(), "0.666666667");
        assert_eq!(Fraction::try_from(-0.0), Ok(Fraction::ZERO));
        assert!(Fraction::try_from(f64::NAN).is_err() && Fraction::new(1, 0).is_none());
    }

    #[test]
    fn order_and_products() {
        let half = Fraction::HALF;
        assert!(Fraction::new(1, 3) < Some(half) && half < Fraction::ONE);
        assert_eq!([0, 1, 2, 255].map(|whole| half.ceil_of(whole)), [0, 1, 1, 128]);
        assert_eq!(Fraction::ONE.ceil_of(u32::MAX), u32::MAX);
    }
}
