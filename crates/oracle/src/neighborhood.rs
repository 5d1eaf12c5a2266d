//! The moves of N(k) from their definition.

use std::collections::BTreeSet;

use mediant_moves::{FiniteK, Vector};

/// The moves (x, y) of N(k) with |x| ≤ `width` and |y| ≤ `height`, in the order of [`Vector`]. k = `None`
/// stands for k = ∞: every vector with gcd 1.
///
/// The sum of every two adjacent moves is inserted between them, in k − 2 rounds, and the quadrant is
/// reflected (Rivera 2017). Sums only grow, so the insertion ends where a sum leaves the rectangle.
#[must_use]
pub fn neighborhood(k: Option<FiniteK>, width: u32, height: u32) -> Vec<Vector> {
    let limit = Vector::new(saturated(width), saturated(height));
    let (right, down) = (Vector::new(1, 0), Vector::new(0, 1));
    let mut quadrant: Vec<Vector> = [right, down].into_iter().filter(|&u| fits(u, limit)).collect();
    insert_mediants(right, down, k.map_or(u32::MAX, |k| k.get() - 2), limit, &mut quadrant);
    let signs = [(1, 1), (1, -1), (-1, 1), (-1, -1)];
    let reflected = quadrant.iter().flat_map(|u| signs.map(|(sx, sy)| Vector::new(sx * u.x, sy * u.y)));
    reflected.collect::<BTreeSet<_>>().into_iter().collect()
}

/// Half the range of an `i32`, so that a sum of two vectors that fit cannot overflow.
fn saturated(side: u32) -> i32 {
    side.min(i32::MAX as u32 / 2) as i32
}

fn fits(u: Vector, limit: Vector) -> bool {
    u.x <= limit.x && u.y <= limit.y
}

fn insert_mediants(u: Vector, v: Vector, times: u32, limit: Vector, moves: &mut Vec<Vector>) {
    let mediant = u + v;
    if times == 0 || !fits(mediant, limit) {
        return;
    }
    moves.push(mediant);
    insert_mediants(u, mediant, times - 1, limit, moves);
    insert_mediants(mediant, v, times - 1, limit, moves);
}
