//! The moves of N(k), and the integral of the cost along each.
//!
//! **Shares.** A move from center to center passes the grid lines x = i + ½ and y = j + ½, at multiples of
//! 1 / (2 |dx| |dy|) of its length. So what lies in each cell is an integer number of these shares. From
//! corner to corner it passes the lines at multiples of 1 / (|dx| |dy|). The sum of share · weight over the
//! cells is an integer, and exact.
//!
//! **The rule at grid lines.** A move that runs along a grid line, between two cells, costs the lesser weight
//! of the two that are free: the infimum of the ways beside it. A cell that a move touches in a corner alone
//! has no share. At centers no move runs along a grid line.
//!
//! **One rounding.** The cost is the sum times the length of a share. That length is a factor in fixed point,
//! with as many digits as fit beside the greatest sum; the product is rounded to the nearest unit. Both
//! roundings together are less than one unit. The factor is rounded such that a move over cells of the least
//! weight costs the integer nearest to its exact cost. So where all costs are 1, a move costs, to the last
//! bit, what it costs the engines without costs ([`Cost::of_move`]; tested for every move up to k = 8).

use mediant_grid::PlacementKind;
use mediant_moves::{Cost, FiniteK, KError, Neighborhood, Vector};

use crate::scale::Scale;

/// A cell that a move crosses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Part {
    /// From the cell where the move begins, or whose top left corner that is.
    pub(crate) dx: i8,
    pub(crate) dy: i8,
    /// The part of the move's length in it.
    pub(crate) share: u16,
}

/// The length of a share of a move, in fixed point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Factor {
    factor: u64,
    shift: u32,
}

impl Factor {
    /// That of a move of so many shares and this length, in units of costs a unit of weight, for weights
    /// between these bounds.
    pub(crate) fn new(length: f64, shares: u32, (least, greatest): (u64, u64)) -> Self {
        let shift = (u64::from(shares) * greatest).leading_zeros();
        // Below 2⁶⁴, since no move costs 2⁶³ units.
        let exact = length / f64::from(shares) * 2.0_f64.powi(64 - shift as i32);
        let sum = u64::from(shares) * least;
        let least = (length * least as f64).round() as u64;
        // From one factor to the next, the cost of the least sum grows by less than a unit.
        let near =
            [exact.round(), exact.floor(), exact.ceil()].map(|factor| Self { factor: factor as u64, shift });
        near.into_iter().find(|factor| factor.cost(sum) == least).unwrap_or(near[0])
    }

    /// The cost of a sum of shares times weights, rounded to the nearest unit.
    #[inline]
    pub(crate) const fn cost(self, sum: u64) -> u64 {
        let product = ((sum << self.shift) as u128) * (self.factor as u128);
        ((product + (1 << 63)) >> 64) as u64
    }
}

/// A move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Move {
    pub(crate) vector: Vector,
    pub(crate) factor: Factor,
    /// The cost over cells of the least weight.
    pub(crate) least: u64,
    /// Its parts among those of all moves.
    first: u32,
    last: u32,
    /// Whether it runs along the line between its two parts.
    pub(crate) is_along: bool,
    /// The two cells that it touches in the corner through which it passes, at centers.
    pub(crate) touched: Option<[(i8, i8); 2]>,
}

/// The moves of N(k), in the order of [`Neighborhood`].
#[derive(Clone, Debug)]
pub(crate) struct Moves {
    moves: Box<[Move]>,
    parts: Box<[Part]>,
}

impl Moves {
    pub(crate) fn new(placement: PlacementKind, k: FiniteK, scale: &Scale) -> Result<Self, KError> {
        let mut all = Vec::new();
        let moves = Neighborhood::new(k)?.iter().map(|vector| {
            let first = all.len() as u32;
            let (parts, shares) = parts(placement, vector);
            let touched = touched(placement, vector);
            all.extend(parts);
            let bounds = (scale.least.into(), scale.greatest.into());
            let factor = Factor::new(scale.units(scale.length(vector)), shares, bounds);
            let least = factor.cost(u64::from(shares) * u64::from(scale.least));
            let is_along = placement == PlacementKind::Corner && (vector.x == 0 || vector.y == 0);
            Move { vector, factor, least, first, last: all.len() as u32, is_along, touched }
        });
        let moves = moves.collect();
        Ok(Self { moves, parts: all.into() })
    }

    #[inline]
    pub(crate) const fn all(&self) -> &[Move] {
        &self.moves
    }

    /// The cells that a move crosses, in their order on the way; of one along a line the two beside it.
    #[inline]
    pub(crate) fn parts(&self, of: &Move) -> &[Part] {
        &self.parts[of.first as usize..of.last as usize]
    }

    /// The least cost of a move with these sizes of coordinates.
    pub(crate) fn least(&self, v: Vector) -> Cost {
        let (x, y) = v.abs();
        let known = self.moves.iter().find(|known| known.vector.abs() == (x, y));
        Cost::from_bits(known.map_or(0, |known| known.least))
    }

    /// The number of shares that a move's length is divided into.
    pub(crate) fn shares(&self, of: &Move) -> u64 {
        let parts = self.parts(of).iter();
        if of.is_along { 1 } else { parts.map(|part| u64::from(part.share)).sum() }
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        size_of_val(&*self.moves) + size_of_val(&*self.parts)
    }
}

/// The cells that a move crosses, in their order on the way, and the number of its shares.
pub(crate) fn parts(placement: PlacementKind, v: Vector) -> (Vec<Part>, u32) {
    let (dx, dy) = (v.x.abs(), v.y.abs());
    let part = |dx: i32, dy: i32, share: i32| Part { dx: dx as i8, dy: dy as i8, share: share as u16 };
    let is_center = placement == PlacementKind::Center;
    if dx == 0 || dy == 0 {
        return match is_center {
            true => (vec![part(0, 0, 1), part(v.x, v.y, 1)], 2),
            // The cells on both sides of the edge.
            false if dy == 0 => (vec![part(v.x.min(0), -1, 1), part(v.x.min(0), 0, 1)], 1),
            false => (vec![part(-1, v.y.min(0), 1), part(0, v.y.min(0), 1)], 1),
        };
    }
    // Lines are passed at (2i + 1) / (2 dx) from center to center, and at i / dx from corner to corner.
    let (scale, offset) = if is_center { (2, 1) } else { (1, 0) };
    let shares = scale * dx * dy;
    let pass = |lines: i32, across: i32| {
        if is_center { (2 * lines + offset) * across } else { (lines + 1) * across }
    };
    let mut parts = Vec::new();
    let (mut x, mut y, mut at) = (0, 0, 0);
    while at < shares {
        let (next_x, next_y) = (pass(x, dy), pass(y, dx));
        let next = next_x.min(next_y).min(shares);
        // From corner to corner the first cell is the one on the move's side.
        let cell = |n: i32, d: i32| if is_center || d > 0 { n * d.signum() } else { -n - 1 };
        parts.push(part(cell(x, v.x), cell(y, v.y), next - at));
        x += i32::from(next == next_x);
        y += i32::from(next == next_y);
        at = next;
    }
    (parts, shares as u32)
}

/// The two cells that a move between centers touches in a corner. It passes a corner of cells exactly where
/// both coordinates are odd, half way.
pub(crate) fn touched(placement: PlacementKind, v: Vector) -> Option<[(i8, i8); 2]> {
    if placement == PlacementKind::Corner || v.x % 2 == 0 || v.y % 2 == 0 {
        return None;
    }
    let half = |d: i32| ((d - d.signum()) / 2, (d + d.signum()) / 2);
    let ((x, beyond_x), (y, beyond_y)) = (half(v.x), half(v.y));
    let cell = |x: i32, y: i32| (x as i8, y as i8);
    Some([cell(beyond_x, y), cell(x, beyond_y)])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ones() -> Scale {
        Scale::new(1 << 20, (1.0, 1.0), true, (1.0, 1.0)).expect("costs of 1")
    }

    #[test]
    fn costs_of_1_are_the_lengths_of_moves_to_the_last_bit() {
        for k in 2..=8 {
            let k = FiniteK::new(k).expect("a small k");
            for placement in [PlacementKind::Center, PlacementKind::Corner] {
                let moves = Moves::new(placement, k, &ones()).expect("a small k");
                for of in moves.all() {
                    assert_eq!(of.least, Cost::of_move(of.vector).to_bits(), "{:?}", of.vector);
                    let parts = moves.parts(of).iter();
                    let shares: u32 = parts.map(|part| u32::from(part.share)).sum();
                    let (dx, dy) = of.vector.abs();
                    let expected = match placement {
                        PlacementKind::Center => (2 * dx * dy).max(2),
                        PlacementKind::Corner if dx * dy == 0 => 2,
                        PlacementKind::Corner => dx * dy,
                    };
                    assert_eq!(shares, expected, "{placement:?} {:?}", of.vector);
                }
            }
        }
    }

    /// Of sums from the least to the greatest, the cost is off by less than a unit, and by nothing on
    /// average.
    #[test]
    fn costs_are_rounded_by_less_than_a_unit() {
        let scale = Scale::new(1 << 16, (3.0, 5_000.0), true, (2.0, 0.75)).expect("small costs");
        for placement in [PlacementKind::Center, PlacementKind::Corner] {
            let moves =
                Moves::new(placement, FiniteK::new(8).expect("a small k"), &scale).expect("a small k");
            let mut mean = 0.0;
            for of in moves.all() {
                let shares = moves.shares(of);
                for part in 0..64 {
                    let sum = shares * 3 + shares * 4_997 * part / 63;
                    // Below 2⁵⁰ units, where doubles are exact enough.
                    let exact = scale.units(scale.length(of.vector)) / shares as f64 * sum as f64;
                    let off = of.factor.cost(sum) as f64 - exact;
                    assert!(exact < 2.0_f64.powi(50) && off.abs() < 1.0, "{:?}, {sum}: {off}", of.vector);
                    mean += off / (64.0 * moves.all().len() as f64);
                }
            }
            assert!(mean.abs() < 0.05, "{placement:?}: {mean}");
        }
    }

    #[test]
    fn shares_are_those_worked_by_hand() {
        let of = |placement, x, y| {
            let (parts, shares) = parts(placement, Vector::new(x, y));
            (parts.iter().map(|part| (part.dx, part.dy, part.share)).collect::<Vec<_>>(), shares)
        };
        use PlacementKind::{Center, Corner};
        assert_eq!(of(Center, 1, -1), (vec![(0, 0, 1), (1, -1, 1)], 2));
        assert_eq!(of(Center, 1, 2), (vec![(0, 0, 1), (0, 1, 1), (1, 1, 1), (1, 2, 1)], 4));
        assert_eq!(of(Center, -3, 1), (vec![(0, 0, 1), (-1, 0, 2), (-2, 1, 2), (-3, 1, 1)], 6));
        assert_eq!(of(Corner, 1, 1), (vec![(0, 0, 1)], 1));
        assert_eq!(of(Corner, -2, 1), (vec![(-1, 0, 1), (-2, 0, 1)], 2));
        assert_eq!(of(Corner, 0, -1), (vec![(-1, -1, 1), (0, -1, 1)], 1));
        assert_eq!(touched(Center, Vector::new(-3, 1)), Some([(-2, 0), (-1, 1)]));
        assert_eq!(touched(Center, Vector::new(2, 1)), None);
    }
}
