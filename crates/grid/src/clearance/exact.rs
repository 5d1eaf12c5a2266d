//! Radii and squared distances, compared exactly.

use crate::interrupt::Interrupted;

/// Why no map can be made for an agent.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SizeError {
    /// The radius of a disc is negative or not a number.
    #[error("a radius of {0} cells: it must be 0 or a positive finite number")]
    Radius(f64),
    /// A square of no cells.
    #[error("a square of 0 × 0 cells: it must have at least one")]
    Square,
    /// It was stopped while it was made.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
}

/// The smallest integer that is at least `scale` · radius²; [`u64::MAX`] if it has more than 64 bits.
///
/// # Errors
/// [`SizeError::Radius`].
pub(super) fn least_square(radius: f64, scale: u32) -> Result<u64, SizeError> {
    if !radius.is_finite() || radius < 0.0 {
        return Err(SizeError::Radius(radius));
    }
    // radius = mantissa · 2^exponent, so that the square is an integer and a power of two.
    let bits = radius.to_bits();
    let (fraction, biased) = (bits & ((1 << 52) - 1), (bits >> 52 & 0x7ff) as i32);
    let (mantissa, exponent) =
        if biased == 0 { (fraction, -1074) } else { (fraction | 1 << 52, biased - 1075) };
    // At most 53 + 53 + 3 bits.
    let square = u128::from(mantissa) * u128::from(mantissa) * u128::from(scale);
    if square == 0 {
        return Ok(0);
    }
    let shift = 2 * exponent;
    let least = if shift >= 0 {
        // The mantissa of a number this large has all its 53 bits.
        return Ok(u64::MAX);
    } else if shift <= -128 {
        1
    } else {
        let (whole, rest) = (square >> -shift, square & ((1 << -shift) - 1));
        whole + u128::from(rest > 0)
    };
    Ok(u64::try_from(least).unwrap_or(u64::MAX))
}

/// The largest number that is at most √(squared / scale).
pub(super) fn root(squared: u32, scale: u32) -> f64 {
    let root = (f64::from(squared) / f64::from(scale)).sqrt();
    match least_square(root, scale) {
        Ok(least) if least > u64::from(squared) => root.next_down(),
        _ => root,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_are_rounded_up_and_roots_down() {
        for (radius, scale, expected) in [
            (0.0, 4, 0),
            (-0.0, 4, 0),
            (f64::from_bits(1), 4, 1),
            (1e-40, 1, 1),
            (0.5, 4, 1),
            (0.5_f64.next_up(), 4, 2),
            (0.5_f64.next_down(), 4, 1),
            (1.5, 1, 3),
            (3.0, 1, 9),
            (3.0_f64.next_up(), 1, 10),
            (2.5, 4, 25),
            (65_536.0, 1, 1 << 32),
            (f64::from(u32::MAX), 1, u64::from(u32::MAX) * u64::from(u32::MAX)),
            (1e10, 4, u64::MAX),
            (1e300, 1, u64::MAX),
        ] {
            assert_eq!(least_square(radius, scale), Ok(expected), "{radius:e}, {scale}");
        }
        for radius in [-1.0, -1e-300, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(matches!(least_square(radius, 4), Err(SizeError::Radius(_))), "{radius}");
        }
    }

    #[test]
    fn a_root_is_the_largest_radius_that_its_square_admits() {
        for (squared, scale) in (0..5000).chain(u32::MAX - 2000..=u32::MAX).flat_map(|s| [(s, 1), (s, 4)]) {
            let root = root(squared, scale);
            let [here, next] = [root, root.next_up()].map(|r| least_square(r, scale).expect("a radius"));
            assert!(here <= u64::from(squared) && u64::from(squared) < next, "{squared}, {scale}: {root}");
        }
    }
}
