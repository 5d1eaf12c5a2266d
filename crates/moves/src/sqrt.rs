//! Square roots with and without the standard library, with the same result to the bit.

/// √x for x ≥ 0, correctly rounded.
#[cfg(feature = "std")]
pub(crate) fn sqrt(x: f64) -> f64 {
    x.sqrt()
}

/// √x for x ≥ 0, correctly rounded.
#[cfg(not(feature = "std"))]
pub(crate) fn sqrt(x: f64) -> f64 {
    integer_sqrt(x)
}

/// √x in integers: `u128::isqrt` of the significand, which is shifted so that the root has 63 bits. If the
/// root is inexact, its last bit is set, so that the conversion back to `f64` rounds as the exact root would.
pub(crate) const fn integer_sqrt(x: f64) -> f64 {
    const FRACTION_BITS: i32 = 52;
    if !x.is_normal() || x.is_sign_negative() {
        return if x == 0.0 || x == f64::INFINITY { x } else { f64::NAN };
    }
    let bits = x.to_bits();
    let exponent = (bits >> FRACTION_BITS) as i32 - 1023 - FRACTION_BITS;
    let significand = ((bits & ((1 << FRACTION_BITS) - 1)) | (1 << FRACTION_BITS)) as u128;
    // x = significand · 2^exponent; an even exponent leaves a root that is an integer times a power of two.
    let shift = if exponent % 2 == 0 { 74 } else { 73 };
    let square = significand << shift;
    let root = square.isqrt();
    let sticky = (root * root != square) as u64;
    let rounded = ((root as u64) | sticky) as f64;
    let half = (exponent - shift) / 2;
    rounded * f64::from_bits(((1023 + half) as u64) << FRACTION_BITS)
}

#[cfg(all(test, feature = "std"))]
mod tests {
    use super::*;

    #[test]
    fn integer_root_equals_the_hardware_root() {
        let mut state = 1_u64;
        for i in 0..100_000_u64 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            for x in [i as f64, (state >> 11) as f64, 1.0 + 1.0 / (i + 1) as f64, (state >> 40) as f64 / 7.0]
            {
                assert_eq!(integer_sqrt(x).to_bits(), x.sqrt().to_bits(), "x = {x:e}");
            }
        }
        assert_eq!(integer_sqrt(0.0).to_bits(), 0.0_f64.to_bits());
        assert!(integer_sqrt(-1.0).is_nan());
    }
}
