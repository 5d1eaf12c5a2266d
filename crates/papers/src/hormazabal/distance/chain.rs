//! h_k as the papers print it.

use mediant_moves::Vector;

/// Hormazábal 2017, Algorithm 2, with its two misprints corrected: `k ← k − 1` belongs to each round, and the
/// factor of l is x.
#[inline(always)]
pub(super) fn algorithm_2(d: Vector, k: u32) -> f64 {
    let (mut x, mut y) = (d.x.abs(), d.y.abs());
    let (mut l, mut r) = ((1, 0), (0, 1));
    for _ in 2..k {
        let sum = (l.0 + r.0, l.1 + r.1);
        if x > y {
            r = sum;
            x -= y;
        } else {
            l = sum;
            y -= x;
        }
    }
    let norm = |(x, y): (i32, i32)| f64::from(x * x + y * y).sqrt();
    f64::from(x) * norm(l) + f64::from(y) * norm(r)
}

/// α‖u‖ + β‖v‖ for the first two neighbors u, v that contain (x, y): Algorithm 1.
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

pub(super) fn chain_32(d: Vector) -> f64 {
    let (x, y) = sorted(d);
    chain!(x y (0 1) (1 3) (1 2) (2 3) (1 1))
}

pub(super) fn chain_64(d: Vector) -> f64 {
    let (x, y) = sorted(d);
    chain!(x y (0 1) (1 4) (1 3) (2 5) (1 2) (3 5) (2 3) (3 4) (1 1))
}

pub(super) fn chain_128(d: Vector) -> f64 {
    let (x, y) = sorted(d);
    chain!(x y (0 1) (1 5) (1 4) (2 7) (1 3) (3 8) (2 5) (3 7) (1 2)
           (4 7) (3 5) (5 8) (2 3) (5 7) (3 4) (4 5) (1 1))
}
