//! The 2^k neighborhoods as naively as the papers define them, and the plainest shortest-path search on the
//! empty grid.

use std::{
    cmp::Reverse,
    collections::{BTreeSet, BinaryHeap},
};

use mediant_moves::{FiniteK, Vector};

/// A pair of integers, of which sums and products of interest do not overflow.
pub(crate) type Pair = (i64, i64);

pub(crate) fn k(n: u32) -> FiniteK {
    FiniteK::new(n).expect("k is at least 2")
}

pub(crate) fn vector((x, y): Pair) -> Vector {
    Vector::new(i32::try_from(x).expect("fits"), i32::try_from(y).expect("fits"))
}

pub(crate) fn pair(v: Vector) -> Pair {
    (v.x.into(), v.y.into())
}

pub(crate) fn add(u: Pair, v: Pair) -> Pair {
    (u.0 + v.0, u.1 + v.1)
}

pub(crate) fn sub(u: Pair, v: Pair) -> Pair {
    (u.0 - v.0, u.1 - v.1)
}

pub(crate) fn times(n: i64, v: Pair) -> Pair {
    (n * v.0, n * v.1)
}

pub(crate) fn det(u: Pair, v: Pair) -> i64 {
    u.0 * v.1 - u.1 * v.0
}

pub(crate) fn dot(u: Pair, v: Pair) -> i64 {
    u.0 * v.0 + u.1 * v.1
}

pub(crate) fn norm(v: Pair) -> f64 {
    (dot(v, v) as f64).sqrt()
}

pub(crate) fn gcd(a: i64, b: i64) -> i64 {
    if b == 0 { a.abs() } else { gcd(b, a % b) }
}

/// Fib(0) = Fib(1) = 1.
pub(crate) fn fibonacci(i: u32) -> i64 {
    if i < 2 {
        return 1;
    }
    let (mut last, mut this) = (1, 1);
    for _ in 1..i {
        (last, this) = (this, last + this);
    }
    this
}

/// Q(k − 2) by the papers' definition: start with (0, 1), (1, 0); insert the sum between each two, k − 2
/// times.
pub(crate) fn naive_quadrant(k: u32) -> Vec<Pair> {
    let mut quadrant = vec![(0, 1), (1, 0)];
    for _ in 2..k {
        let mut next = Vec::with_capacity(2 * quadrant.len() - 1);
        for two in quadrant.windows(2) {
            next.push(two[0]);
            next.push(add(two[0], two[1]));
        }
        next.push((1, 0));
        quadrant = next;
    }
    quadrant
}

/// N(k) by Rivera 2017, Eq. 6: each move of the quadrant with all signs.
pub(crate) fn naive_neighborhood(k: u32) -> BTreeSet<Pair> {
    let signs = [(1, 1), (1, -1), (-1, 1), (-1, -1)];
    let quadrant = naive_quadrant(k);
    quadrant.iter().flat_map(|&(x, y)| signs.map(|(s, t)| (s * x, t * y))).collect()
}

/// The factors (α, β) of d = α·u + β·v by Cramer's rule, if they are integers.
pub(crate) fn solve(d: Pair, u: Pair, v: Pair) -> Option<(i64, i64)> {
    let (a, b, whole) = (det(d, v), det(u, d), det(u, v));
    (whole != 0 && a % whole == 0 && b % whole == 0).then(|| (a / whole, b / whole))
}

/// The index j with v_j ⪯ d ⪯ v_{j+1}, the first of them, for d in the first quadrant.
pub(crate) fn naive_sector(d: Pair, quadrant: &[Pair]) -> usize {
    let precedes = |(x, y): Pair, (x2, y2): Pair| x * y2 <= x2 * y;
    quadrant
        .windows(2)
        .position(|two| precedes(two[0], d) && precedes(d, two[1]))
        .expect("the quadrant is covered")
}

/// h_k(d) for d of any quadrant: Rivera 2017, 'The 2^k-Tile Heuristic', both steps word for word.
pub(crate) fn naive_distance(d: Pair, quadrant: &[Pair]) -> f64 {
    let d = (d.0.abs(), d.1.abs());
    let j = naive_sector(d, quadrant);
    let (u, v) = (quadrant[j], quadrant[j + 1]);
    let (alpha, beta) = solve(d, u, v).expect("Rivera 2017, Theorem 3");
    alpha as f64 * norm(u) + beta as f64 * norm(v)
}

/// Asserts that two lengths are equal up to the rounding of a few `f64` operations.
#[track_caller]
pub(crate) fn assert_close(got: f64, expected: f64, what: impl std::fmt::Display) {
    let tolerance = 4.0 * f64::EPSILON * expected.abs().max(1.0);
    assert!((got - expected).abs() <= tolerance, "{what}: {got:e} is not {expected:e}");
}

/// All pairs with both coordinates in −n…n.
pub(crate) fn square(n: i64) -> impl Iterator<Item = Pair> {
    (-n..=n).flat_map(move |x| (-n..=n).map(move |y| (x, y)))
}

/// All pairs with both coordinates in 0…n.
pub(crate) fn first_quadrant(n: i64) -> impl Iterator<Item = Pair> {
    (0..=n).flat_map(move |x| (0..=n).map(move |y| (x, y)))
}

/// The costs of the cheapest paths from (0, 0) to the vertices of the unbounded empty grid.
pub(crate) struct EmptyGrid {
    reach: i64,
    costs: Vec<f64>,
}

impl EmptyGrid {
    /// By Dijkstra's algorithm, for all vertices of cost at most `reach` times `unit`. No move may cost less
    /// than `unit` times its larger coordinate: then no such path leaves the square −reach…reach.
    ///
    /// Costs are lengths or, exactly as long as sums stay below 2⁵³, integers.
    pub(crate) fn new(moves: &BTreeSet<Pair>, reach: i64, unit: f64, cost: impl Fn(Pair) -> f64) -> Self {
        let side = 2 * reach + 1;
        let index = |(x, y): Pair| ((y + reach) * side + x + reach) as usize;
        // Longer moves end outside wherever they begin.
        let fits = |m: &&Pair| m.0.abs() <= 2 * reach && m.1.abs() <= 2 * reach;
        let moves: Vec<(Pair, f64)> = moves.iter().filter(fits).map(|&m| (m, cost(m))).collect();
        let limit = reach as f64 * unit;
        let mut costs = vec![f64::INFINITY; (side * side) as usize];
        costs[index((0, 0))] = 0.0;
        // The bits of two non-negative floats compare as the floats do.
        let mut open = BinaryHeap::from([Reverse((0.0_f64.to_bits(), (0, 0)))]);
        while let Some(Reverse((bits, at))) = open.pop() {
            let so_far = f64::from_bits(bits);
            if so_far > costs[index(at)] {
                continue;
            }
            for &(step, cost) in &moves {
                let (next, total) = (add(at, step), so_far + cost);
                if next.0.abs() <= reach
                    && next.1.abs() <= reach
                    && total <= limit
                    && total < costs[index(next)]
                {
                    costs[index(next)] = total;
                    open.push(Reverse((total.to_bits(), next)));
                }
            }
        }
        Self { reach, costs }
    }

    /// The cost to a vertex, infinite beyond the limit.
    pub(crate) fn cost(&self, (x, y): Pair) -> f64 {
        let side = 2 * self.reach + 1;
        self.costs[((y + self.reach) * side + x + self.reach) as usize]
    }
}

/// SplitMix64 with a fixed seed, which `MEDIANT_SEED` replaces; every message of a test that draws from it
/// names the seed.
pub(crate) struct Random {
    pub(crate) seed: u64,
    state: u64,
}

impl Random {
    pub(crate) fn new() -> Self {
        let seed = std::env::var("MEDIANT_SEED").ok().and_then(|s| s.parse().ok()).unwrap_or(20_170_204);
        Self { seed, state: seed }
    }

    pub(crate) fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.state ^ (self.state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// A vector whose coordinates have up to `max_bits` bits, of all magnitudes, and any signs; at most 31
    /// bits.
    pub(crate) fn vector(&mut self, max_bits: u64) -> Vector {
        let mut coordinate = || {
            let bits = self.bits() % (max_bits + 1);
            let magnitude = (self.bits() & ((1 << bits) - 1)) as i32;
            if self.bits() & 1 == 0 { magnitude } else { -magnitude }
        };
        Vector::new(coordinate(), coordinate())
    }
}
