//! The units of a map's integers: of its weights, and of the costs of moves and paths.

use mediant_moves::Vector;

use crate::error::CostsError;

/// The units of a map. Both are powers of two, so that weights that are integers, or halves, are exact, and
/// integers become numbers without a rounding.
///
/// - A **weight** is an integer of 32 bits. Where all costs are integers below 2³², its unit is 1. Otherwise
///   it is such that the greatest takes 32 bits; costs are then rounded once, to it.
/// - A **cost** of a move or a path is an integer of 64 bits. Its unit is 2⁻ʳ of the least power of two in
///   the least cost of a straight move, with the largest r ≤ 32 with which no path on the map overflows: its
///   cost is less than cells · diagonal · greatest weight. h_k is consistent from r = 14 on for every k ≤ 8
///   (a move beats each detour by 2⁻¹⁰·⁷ of itself, and is rounded by a unit at most).
///
/// A map keeps its units when it is edited, as long as its costs stay between the bounds that it was made
/// with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scale {
    /// The unit of weights is 2 to this.
    weight_exponent: i32,
    /// The unit of costs is 2 to this.
    exponent: i32,
    /// The bounds of the weights of free cells.
    pub(crate) least: u32,
    pub(crate) greatest: u32,
    /// The width and the height of a cell.
    pub(crate) cell_size: (f64, f64),
}

/// The most and the fewest binary digits below the least cost of a straight move.
const DIGITS: (i32, i32) = (32, 14);
/// The least and the greatest cost, time, friction or side of a cell. A product of two, on the largest map,
/// and its unit are then numbers of `f64` of full precision: further out a unit becomes 0, or a length
/// infinite.
const AMOUNTS: (f64, f64) = (1e-120, 1e120);
/// The greatest ratio of two costs that are not integers: each is then rounded by 2⁻¹⁷ of itself at most.
pub(crate) const GREATEST_RATIO: f64 = (1_u64 << 16) as f64;

impl Scale {
    /// The units for a map of so many vertices, whose costs are between two.
    pub(crate) fn new(
        vertices: u64,
        (least, greatest): (f64, f64),
        are_integers: bool,
        cell_size: (f64, f64),
    ) -> Result<Self, CostsError> {
        check_cell_size(cell_size)?;
        let is_integral = are_integers && greatest <= f64::from(u32::MAX);
        let range = CostsError::Range { least, greatest };
        if !is_integral && greatest / least > GREATEST_RATIO {
            return Err(range);
        }
        let weight_exponent = if is_integral { 0 } else { floor_log2(greatest) - 31 };
        let weight = |cost: f64| ((cost * exp2(-weight_exponent)).round() as u32).max(1);
        let (least, greatest) = (weight(least), weight(greatest));
        let costs = [least, greatest].map(|weight| f64::from(weight) * exp2(weight_exponent));
        let exponent = exponent(vertices, costs, cell_size).ok_or(range)?;
        Ok(Self { weight_exponent, exponent, least, greatest, cell_size })
    }

    /// The weight for a cost a unit of length; `None` if it lies outside the bounds, or is no multiple of the
    /// unit where the unit is 1.
    pub(crate) fn weight(&self, cost: f64) -> Option<u32> {
        let scaled = cost * exp2(-self.weight_exponent);
        let weight = scaled.round();
        let is_exact = self.weight_exponent != 0 || weight == scaled;
        let fits = weight >= f64::from(self.least) && weight <= f64::from(self.greatest);
        (is_exact && fits).then_some(weight as u32)
    }

    /// The cost a unit of length that a weight stands for.
    pub(crate) fn cost_of_weight(&self, weight: u32) -> f64 {
        f64::from(weight) * exp2(self.weight_exponent)
    }

    /// The unit of costs.
    pub(crate) fn unit(&self) -> f64 {
        exp2(self.exponent)
    }

    /// A length, in units of costs a unit of weight.
    pub(crate) fn units(&self, length: f64) -> f64 {
        length * exp2(self.weight_exponent - self.exponent)
    }

    /// The length of a displacement, in the unit of the cell size.
    pub(crate) fn length(&self, v: Vector) -> f64 {
        length(self.cell_size, v)
    }

    /// Numbers by which two scales differ.
    pub(crate) const fn words(&self) -> [u64; 4] {
        let exponents = (self.weight_exponent as u32 as u64) << 32 | self.exponent as u32 as u64;
        let bounds = (self.least as u64) << 32 | self.greatest as u64;
        [exponents, bounds, self.cell_size.0.to_bits(), self.cell_size.1.to_bits()]
    }
}

/// Whether a number can be a cost, a time, or the side of a cell.
pub(crate) fn is_amount(number: f64) -> bool {
    number >= AMOUNTS.0 && number <= AMOUNTS.1
}

/// Checks the width and the height of a cell.
pub(crate) fn check_cell_size((x, y): (f64, f64)) -> Result<(), CostsError> {
    let fits = is_amount(x) && is_amount(y) && x.max(y) / x.min(y) <= GREATEST_RATIO;
    if fits { Ok(()) } else { Err(CostsError::CellSize { x, y }) }
}

/// The exponent of the unit of costs on a map of so many vertices, with these bounds of the costs a unit of
/// length; `None` if there are too few digits for exact sums.
pub(crate) fn exponent(vertices: u64, [least, greatest]: [f64; 2], (x, y): (f64, f64)) -> Option<i32> {
    let straight = least * x.min(y);
    // Vertices beyond those of the map: a search labels what lies one move ahead.
    let longest = (vertices as f64 + 64.0) * (x * x + y * y).sqrt() * greatest;
    // Of 63 digits, those that the longest path leaves.
    let digits = (62 - floor_log2(longest) + floor_log2(straight)).min(DIGITS.0);
    (digits >= DIGITS.1).then(|| floor_log2(straight) - digits)
}

/// The length of a displacement, in the unit of the cell size.
pub(crate) fn length((width, height): (f64, f64), v: Vector) -> f64 {
    // Square cells first: their roots are those of integers.
    if width == height {
        return v.norm() * width;
    }
    let (x, y) = (f64::from(v.x) * width, f64::from(v.y) * height);
    // Products and a root, which IEEE 754 rounds alike everywhere; `hypot` is each platform's own.
    (x * x + y * y).sqrt()
}

/// The exponent of the greatest power of two in a positive number.
pub(crate) fn floor_log2(number: f64) -> i32 {
    // Below the normal numbers it is that of the least of these, which only makes units smaller.
    ((number.to_bits() >> 52) as i32 & 0x7FF) - 1023
}

/// A power of two, exactly.
pub(crate) fn exp2(exponent: i32) -> f64 {
    2.0_f64.powi(exponent)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scale(vertices: u64, bounds: (f64, f64), are_integers: bool) -> Result<Scale, CostsError> {
        Scale::new(vertices, bounds, are_integers, (1.0, 1.0))
    }

    #[test]
    fn units_follow_the_map() {
        let ones = scale(1 << 30, (1.0, 1.0), true).expect("costs of 1");
        assert_eq!((ones.unit(), ones.least, ones.greatest), (exp2(-32), 1, 1));
        // All of u16, on as many cells as there can be.
        let wide = scale((1 << 32) - (1 << 24), (1.0, 65_535.0), true).expect("every range of u16");
        assert_eq!(wide.unit(), exp2(-14));
        assert!(scale(1 << 32, (1.0, 1e6), true).is_err());
        let tenths = scale(100, (0.1, 0.7), false).expect("tenths");
        assert_eq!(tenths.weight(0.7), Some(tenths.greatest));
        assert!((tenths.cost_of_weight(tenths.least) - 0.1).abs() < 1e-10);
        assert!(tenths.greatest >> 31 == 1 && tenths.weight(0.8).is_none());
        assert!(scale(100, (1e-9, 1.0), false).is_err());
        // Integers beyond 2³² are rounded.
        let large = scale(100, (1e12, 3e12), true).expect("large integers");
        assert!((large.cost_of_weight(large.greatest) / 3e12 - 1.0).abs() < 1e-9);
        assert!(matches!(
            Scale::new(1, (1.0, 1.0), true, (0.0, 1.0)),
            Err(CostsError::CellSize { x: 0.0, .. })
        ));
    }
}
