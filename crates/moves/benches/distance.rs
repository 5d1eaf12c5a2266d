//! The ways to compute h_k, k = 3…10: which one to take, and whether the iterative algorithm beats the linear search as
//! Hormazábal 2017 ('Iterative h_{2^k} in Practice') found it to, with 65–75 % of its time at k = 5, 6, 7.
//!
//! | name | what |
//! |---|---|
//! | `iterative` | [`distance`] |
//! | `table` | [`CostTable::distance`]: the same in fixed-point costs |
//! | `linear` | [`LinearSearch::distance`]: the moves and their lengths in a table |
//! | `chain` | the linear search as the papers' Algorithm 1 prints it, one function for each k: one `if` a move, all moves and lengths constants of the program. The harder one to beat |
//! | `closed` | [`octile`], [`distance_16`], [`distance_32`] |
//! | `any-angle` | [`distance_any_angle`] |
//!
//! What decides is whether the processor foresees the branches of the searches, so there are two orders of displacements:
//! `scattered`, where it cannot (there are too many to be learned by heart; a thousand are not), and `walk`, where each is
//! near the one before, as an A* search asks for them.

use std::{hint::black_box, time::Duration};

use criterion::{BenchmarkGroup, BenchmarkId, Criterion, Throughput, measurement::WallTime};
use mediant_moves::{
    CostTable, K, LinearSearch, Vector, distance, distance_16, distance_32, distance_any_angle, octile,
};

const SEED: u64 = 1;
const DISPLACEMENTS: usize = 65_536;
const MAX_COORDINATE: i32 = 512;

/// SplitMix64.
struct Random(u64);

impl Random {
    fn below(&mut self, n: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (z ^ (z >> 31)) % n
    }

    fn displacement(&mut self) -> Vector {
        let mut coordinate =
            || self.below(2 * u64::from(MAX_COORDINATE.unsigned_abs()) + 1) as i32 - MAX_COORDINATE;
        Vector::new(coordinate(), coordinate())
    }
}

/// Uniform in the square of all displacements up to 512.
fn scattered() -> Vec<Vector> {
    let mut random = Random(SEED);
    (0..DISPLACEMENTS).map(|_| random.displacement()).collect()
}

/// 256 walks over the 8-neighborhood, each from a random displacement: at every step all eight neighbors are asked for.
fn walk() -> Vec<Vector> {
    let eight = [(0, 1), (1, 1), (1, 0), (1, -1), (0, -1), (-1, -1), (-1, 0), (-1, 1)].map(Vector::from);
    let mut random = Random(SEED);
    let mut ds = Vec::with_capacity(DISPLACEMENTS);
    for _ in 0..256 {
        let mut at = random.displacement();
        for _ in 0..DISPLACEMENTS / 256 / eight.len() {
            ds.extend(eight.map(|step| at + step));
            at = at + eight[random.below(8) as usize];
        }
    }
    ds
}

/// α‖u‖ + β‖v‖ for the first two neighbors u, v that contain (x, y).
macro_rules! chain {
    ($x:ident $y:ident ($ux:literal $uy:literal) ($vx:literal $vy:literal)) => {
        f64::from($y * $vx - $x * $vy) * f64::from($ux * $ux + $uy * $uy).sqrt()
            + f64::from($x * $uy - $y * $ux) * f64::from($vx * $vx + $vy * $vy).sqrt()
    };
    ($x:ident $y:ident $u:tt ($vx:literal $vy:literal) $($rest:tt)+) => {
        if $x * $vy < $y * $vx {
            chain!($x $y $u ($vx $vy))
        } else {
            chain!($x $y ($vx $vy) $($rest)+)
        }
    };
}

/// |x| and |y|, the smaller one first.
fn sorted(d: Vector) -> (i32, i32) {
    let (x, y) = (d.x.abs(), d.y.abs());
    (x.min(y), x.max(y))
}

fn chain_32(d: Vector) -> f64 {
    let (x, y) = sorted(d);
    chain!(x y (0 1) (1 3) (1 2) (2 3) (1 1))
}

fn chain_64(d: Vector) -> f64 {
    let (x, y) = sorted(d);
    chain!(x y (0 1) (1 4) (1 3) (2 5) (1 2) (3 5) (2 3) (3 4) (1 1))
}

fn chain_128(d: Vector) -> f64 {
    let (x, y) = sorted(d);
    chain!(x y (0 1) (1 5) (1 4) (2 7) (1 3) (3 8) (2 5) (3 7) (1 2)
           (4 7) (3 5) (5 8) (2 3) (5 7) (3 4) (4 5) (1 1))
}

/// The one place that calls `h`, so that the compiler inlines it; a sum would add the latency of its additions.
#[inline(never)]
fn fill(hs: &mut [f64], ds: &[Vector], h: &impl Fn(Vector) -> f64) {
    for (out, &d) in hs.iter_mut().zip(ds) {
        *out = h(d);
    }
}

/// Times all displacements in turn, after a look at whether `h` is what it says.
fn time(
    group: &mut BenchmarkGroup<'_, WallTime>,
    (name, k): (&str, u32),
    ds: &[Vector],
    h: impl Fn(Vector) -> f64,
) {
    let mut hs = vec![0.0; ds.len()];
    fill(&mut hs, ds, &h);
    for (&d, &got) in ds.iter().zip(&hs) {
        let expected = distance(d, K::new(k).expect("k is at least 2"));
        assert!((got - expected).abs() < 1e-6, "{name}: h_{k}({d:?}) = {got}, not {expected}; seed {SEED}");
    }
    group.bench_function(BenchmarkId::new(name, k), |b| {
        b.iter(|| fill(black_box(&mut hs), black_box(ds), &h));
    });
}

fn all(c: &mut Criterion, order: &str, ds: &[Vector]) {
    let mut group = c.benchmark_group(order);
    group.throughput(Throughput::Elements(ds.len() as u64));
    for n in 3..=10 {
        let k = black_box(K::new(n).expect("k is at least 2"));
        time(&mut group, ("iterative", n), ds, |d| distance(d, k));
        let table = CostTable::new(k).expect("k is below its limit");
        time(&mut group, ("table", n), ds, |d| table.distance(d).to_f64());
        let linear = LinearSearch::new(k).expect("k is below its limit");
        time(&mut group, ("linear", n), ds, |d| linear.distance(d));
    }
    time(&mut group, ("chain", 5), ds, chain_32);
    time(&mut group, ("chain", 6), ds, chain_64);
    time(&mut group, ("chain", 7), ds, chain_128);
    time(&mut group, ("closed", 3), ds, octile);
    time(&mut group, ("closed", 4), ds, distance_16);
    time(&mut group, ("closed", 5), ds, distance_32);
    let mut hs = vec![0.0; ds.len()];
    group.bench_function("any-angle", |b| {
        b.iter(|| fill(black_box(&mut hs), black_box(ds), &distance_any_angle));
    });
    group.finish();
}

fn main() {
    let mut c = Criterion::default()
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1))
        .configure_from_args();
    all(&mut c, "scattered", &scattered());
    all(&mut c, "walk", &walk());
    c.final_summary();
}
