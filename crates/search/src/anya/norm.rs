//! How long segments are: all that the search knows of the metric.

use std::{fmt::Debug, ops::Add};

use mediant_grid::{Corners, FreeSpace, Vector, Vertex, sight::Place};
use mediant_moves::{Cost, CostTable, FiniteK, K};

use crate::line_path::follow_line;

/// The norm by which [`Anya`](super::Anya) measures: [`EuclideanNorm`], or h_k ([`LatticeNorm`]). It is
/// sealed.
pub trait Norm: Clone + Debug + sealed::Sealed {
    /// The length of a path, by which two paths to the same vertex are compared.
    #[doc(hidden)]
    type Length: Copy + Debug + PartialOrd + Add<Output = Self::Length>;

    /// A lower bound on the length of a path.
    #[doc(hidden)]
    type Bound: Copy + Add<Output = Self::Bound>;

    #[doc(hidden)]
    const ZERO: Self::Length;

    /// The neighborhood of its paths.
    #[doc(hidden)]
    fn k(&self) -> K;

    /// The length of a segment, whose displacement is in parts of a cell.
    #[doc(hidden)]
    fn length(&self, v: Vector) -> Self::Length;

    /// The least length of a path with this displacement, in parts of a cell.
    #[doc(hidden)]
    fn bound(&self, v: Vector) -> Self::Bound;

    /// The least length of a path from a root through an interval to the goal, or to the goal's mirror image
    /// where that lies on the root's side of the line (Harabor et al. 2016, Section 4.3). No interval that is
    /// reached through this one has less.
    #[doc(hidden)]
    fn bound_through(&self, interval: Interval, goal: Place) -> Self::Bound;

    /// f = g + h, and what is compared where that is equal, as integers in the same order.
    #[doc(hidden)]
    fn priority(g: Self::Length, h: Self::Bound) -> (u64, u32);

    /// The f of a [`priority`](Self::priority), in fixed point, rounded down.
    #[doc(hidden)]
    fn cost_of_priority(f: u64) -> Cost;

    /// The length of a path in fixed point, rounded down.
    #[doc(hidden)]
    fn cost(g: Self::Length) -> Cost;

    /// Writes the waypoints of the path with these bends.
    #[doc(hidden)]
    fn waypoints(
        &self,
        space: &FreeSpace<Corners>,
        bends: impl Iterator<Item = Vertex>,
        waypoints: &mut Vec<Vertex>,
    );
}

mod sealed {
    pub trait Sealed {}
}

/// An interval of a line, seen from a root on another line.
#[derive(Clone, Copy, Debug)]
#[doc(hidden)]
pub struct Interval {
    pub(super) root: Place,
    pub(super) line: i32,
    /// Its left end, rounded.
    pub(super) left: f64,
    /// Its right end, rounded.
    pub(super) right: f64,
}

/// The coordinates of a place in cells, exactly.
#[inline]
fn cells(Place { x, y }: Place) -> [f64; 2] {
    [x, y].map(|parts| f64::from(parts) * PART)
}

/// A part of a cell, in cells.
const PART: f64 = 1.0 / Place::parts(1) as f64;

/// A displacement between two vertices, in cells.
#[inline]
const fn whole(v: Vector) -> Vector {
    Vector::new(v.x >> Place::PLACES, v.y >> Place::PLACES)
}

impl Interval {
    /// Where a shortest path to the goal crosses the interval, in columns, and whether it goes straight on
    /// there. In every norm no place on the line is better than on the straight way from the root to the goal
    /// (or its mirror image); and since norms are convex, places nearer to that are no worse than others.
    #[inline]
    fn crossing(&self, goal: Place) -> (f64, bool) {
        let ([x, y], [goal_x, goal_y]) = (cells(self.root), cells(goal));
        let line = f64::from(self.line);
        let (away, beyond) = ((line - y).abs(), (goal_y - line).abs());
        let straight = x + (goal_x - x) * away / (away + beyond);
        let through = straight.max(self.left).min(self.right);
        (through, through == straight)
    }
}

/// The Euclidean length: paths at any angle.
#[derive(Clone, Copy, Debug, Default)]
pub struct EuclideanNorm;

impl sealed::Sealed for EuclideanNorm {}

const ONE: f64 = (1_u64 << Cost::FRACTION_BITS) as f64;

impl Norm for EuclideanNorm {
    type Length = f64;
    type Bound = f64;
    const ZERO: f64 = 0.0;

    fn k(&self) -> K {
        K::Any
    }

    #[inline]
    fn length(&self, v: Vector) -> f64 {
        v.norm() * PART
    }

    #[inline]
    fn bound(&self, v: Vector) -> f64 {
        v.norm() * PART
    }

    #[inline]
    fn bound_through(&self, interval: Interval, goal: Place) -> f64 {
        let ([x, y], [goal_x, goal_y]) = (cells(interval.root), cells(goal));
        let line = f64::from(interval.line);
        let (away, beyond) = ((line - y).abs(), (goal_y - line).abs());
        let length = |dx: f64, dy: f64| (dx * dx + dy * dy).sqrt();
        match interval.crossing(goal) {
            (_, true) => length(goal_x - x, away + beyond),
            (through, false) => length(through - x, away) + length(goal_x - through, beyond),
        }
    }

    /// By f, then by h: nearer to the goal first. Non-negative floats are ordered like their bits.
    #[inline]
    fn priority(g: f64, h: f64) -> (u64, u32) {
        ((g + h).to_bits(), (h as f32).to_bits())
    }

    #[inline]
    fn cost_of_priority(f: u64) -> Cost {
        Self::cost(f64::from_bits(f))
    }

    #[inline]
    fn cost(g: f64) -> Cost {
        Cost::from_bits((g * ONE) as u64)
    }

    fn waypoints(
        &self,
        _: &FreeSpace<Corners>,
        bends: impl Iterator<Item = Vertex>,
        waypoints: &mut Vec<Vertex>,
    ) {
        waypoints.extend(bends);
    }
}

/// h_k: paths over N(k).
#[derive(Clone, Debug)]
pub struct LatticeNorm {
    k: FiniteK,
    costs: CostTable,
}

impl LatticeNorm {
    pub(super) const fn new(k: FiniteK, costs: CostTable) -> Self {
        Self { k, costs }
    }
}

/// The length of a path over N(k): its cost, and then the Euclidean length of the line along which it goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[doc(hidden)]
pub struct LatticeLength {
    cost: Cost,
    /// In units of 2⁻⁶⁰ cells.
    line: u128,
}

impl Add for LatticeLength {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self { cost: self.cost + other.cost, line: self.line + other.line }
    }
}

/// The least length of a path over N(k), and the least length of the line along which it goes.
#[derive(Clone, Copy, Debug)]
#[doc(hidden)]
pub struct LatticeBound {
    cost: Cost,
    line: f64,
}

impl Add for LatticeBound {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self { cost: self.cost + other.cost, line: self.line + other.line }
    }
}

/// The Euclidean length of a segment of a map in units of 2⁻⁶⁰ cells, at most two units off, and the same on
/// every platform.
#[inline]
fn line(v: Vector) -> u128 {
    let square = v.norm_squared();
    // The root to 36 binary places, then a step of Newton's method for the rest: √n = m + (n − m²) / 2m. IEEE
    // 754 rounds all of it alike everywhere.
    let root = ((square as f64).sqrt() * (1_u64 << 36) as f64) as u64;
    // n − m² is below 2⁵⁴ in magnitude, and n, which is shifted by 72 places, ends in 64 zeros.
    let rest = root.wrapping_mul(root).wrapping_neg() as i64;
    let rest = if root == 0 { 0.0 } else { rest as f64 / (2.0 * root as f64) * f64::from(1 << 24) };
    (u128::from(root) << 24).wrapping_add_signed(i128::from(rest as i64))
}

impl sealed::Sealed for LatticeNorm {}

impl Norm for LatticeNorm {
    type Length = LatticeLength;
    type Bound = LatticeBound;
    const ZERO: LatticeLength = LatticeLength { cost: Cost::ZERO, line: 0 };

    fn k(&self) -> K {
        K::Finite(self.k)
    }

    #[inline]
    fn length(&self, v: Vector) -> LatticeLength {
        let v = whole(v);
        LatticeLength { cost: self.costs.distance(v), line: line(v) }
    }

    #[inline]
    fn bound(&self, v: Vector) -> LatticeBound {
        LatticeBound { cost: self.costs.distance(whole(v)), line: v.norm() * PART }
    }

    #[inline]
    fn bound_through(&self, interval: Interval, goal: Place) -> LatticeBound {
        let (root, to, line) = (interval.root.floor(), goal.floor(), interval.line);
        let (away, beyond) = ((line - root.y).abs(), (to.y - line).abs());
        let least = self.costs.distance(Vector::new(to.x - root.x, away + beyond));
        let (through, is_straight) = interval.crossing(goal);
        let line = EuclideanNorm.bound_through(interval, goal);
        if is_straight {
            return LatticeBound { cost: least, line };
        }
        // The crossing is off by less than 2⁻³⁵ cells, and the two distances by less than 2⁻³⁴ each: together
        // by less than the 2⁻³² that is taken off, so the bound stays below the truth. `least` keeps ties.
        let length = self.costs.distance_f64(through - f64::from(root.x), f64::from(away))
            + self.costs.distance_f64(f64::from(to.x) - through, f64::from(beyond));
        LatticeBound { cost: least.max(Cost::from_bits((length * ONE - 1.0) as u64)), line }
    }

    /// By f, then by the line: so a vertex is reached by its shortest line first.
    #[inline]
    fn priority(g: LatticeLength, h: LatticeBound) -> (u64, u32) {
        // Longer lines than 2¹⁶ cells are a tie.
        let line = g.line as f64 / (1_u64 << 60) as f64 + h.line;
        ((g.cost + h.cost).to_bits(), (line * f64::from(1 << 16)) as u32)
    }

    #[inline]
    fn cost_of_priority(f: u64) -> Cost {
        Cost::from_bits(f)
    }

    #[inline]
    fn cost(g: LatticeLength) -> Cost {
        g.cost
    }

    fn waypoints(
        &self,
        space: &FreeSpace<Corners>,
        bends: impl Iterator<Item = Vertex>,
        waypoints: &mut Vec<Vertex>,
    ) {
        bends.for_each(|at| follow_line(waypoints, space, self.k, at));
    }
}

#[cfg(test)]
mod tests {
    use mediant_oracle::Rng;

    use super::*;

    /// Against the integer root of more digits.
    #[test]
    fn the_euclidean_length_has_sixty_binary_places() {
        let mut rng = Rng::new(0);
        let far = |rng: &mut Rng| rng.below(32_769) as i32;
        let random = (0..50_000).map(|_| Vector::new(far(&mut rng), far(&mut rng))).collect::<Vec<_>>();
        let near = (0..200).flat_map(|x| (0..200).map(move |y| Vector::new(x, -y)));
        for v in near.chain(random).chain([Vector::new(32_768, 32_768), Vector::new(0, -32_768)]) {
            // √n to 46 places and the next digits by the rest, in integers.
            let root = (u128::from(v.norm_squared()) << 92).isqrt();
            let rest = (u128::from(v.norm_squared()) << 92) - root * root;
            let expected = if root == 0 { 0 } else { (root << 14) + (rest << 13) / root };
            assert!(line(v).abs_diff(expected) <= 2, "{v:?}: {}, not {expected}", line(v));
        }
    }

    /// Against the least over a dense sample of the interval, whose ends are eighths of columns: never above
    /// it, and at most two units below.
    #[test]
    fn bounds_are_true_and_tight() {
        let mut rng = Rng::new(7);
        let mut straight = 0;
        for (k, i) in (2..=12).flat_map(|k| (0..300).map(move |i| (k, i))) {
            let k = FiniteK::new(k).expect("k is at least 2");
            let norm = LatticeNorm::new(k, CostTable::new(k).expect("a small k"));
            let side = [20, 200, 4_000][i % 3];
            let mut below = |n: u32| rng.below(n) as i32;
            let root = Vertex::new(below(side), below(side));
            let goal = Vertex::new(below(side), below(side));
            let line = if root.y == 0 { 1 } else { below(root.y as u32) };
            let first = below(8 * side);
            let last = first + below(400);
            let (away, beyond) = ((line - root.y).abs(), (goal.y - line).abs());
            let eighth = |v: Vector| norm.costs.distance(v).to_bits();
            let through = |column: i32| {
                eighth(Vector::new(column - 8 * root.x, 8 * away))
                    + eighth(Vector::new(8 * goal.x - column, 8 * beyond))
            };
            let least = (first..=last).map(through).min().expect("the interval has a first column");
            let [left, right] = [first, last].map(|column| f64::from(column) / 8.0);
            let (goal_x, goal) = (goal.x, Place::of(goal));
            let interval = Interval { root: Place::of(root), line, left, right };
            let bound = 8 * norm.bound_through(interval, goal).cost.to_bits();
            let case = (k, interval, goal);
            assert!(bound <= least, "{bound} is above {least}: {case:?}");
            if interval.crossing(goal).1 {
                straight += 1;
                let straight = Vector::new(goal_x - root.x, away + beyond);
                assert_eq!(bound, 8 * norm.costs.distance(straight).to_bits(), "{case:?}");
            } else {
                assert!(least - bound <= 8 * 2, "{bound} is far below {least}: {case:?}");
            }
        }
        assert!(straight > 100, "{straight}");
    }
}
