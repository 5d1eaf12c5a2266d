//! Direct h_k-reachability among what is seen.

use mediant_grid::Vector;

/// Chooses from the subgoals that a vertex sees those that are directly h_k-reachable from it.
///
/// The 2^k moves of N(k), in angular order, bound 2^k cones. A displacement in the cone of v and w is a·v + b·w, with integers a, b ≥ 0, since
/// det(v, w) = 1, and the vertices on optimal paths to it on an empty grid are the a'·v + b'·w with a' ≤ a and b' ≤ b. So what is
/// reached directly is what no other subgoal of its cone is below of in both coordinates: of the list, sorted by a and then b, what has
/// a smaller b than all before it.
///
/// It is enough to know the subgoals that are seen: if another one, hidden by an obstacle, is in the parallelogram, then some corner of
/// that obstacle is too, and seen.
#[derive(Clone, Debug, Default)]
pub(crate) struct DirectFilter {
    entries: Vec<(u64, u32)>,
}

const PRIMARY: u64 = 1;

impl DirectFilter {
    pub(crate) fn clear(&mut self) {
        self.entries.clear();
    }

    /// Adds a subgoal that is seen; `rounds` is k − 2.
    pub(crate) fn push(&mut self, to: Vector, rounds: u32, id: u32) {
        let (cone, a, b) = coordinates(to, rounds);
        self.entries.push((key(cone, a, b) | PRIMARY, id));
        if b == 0 {
            // On a move: it also bounds the cone before.
            let cones = 4 << rounds;
            self.entries.push((key((cone + cones - 1) % cones, 0, a), id));
        }
    }

    /// Tells those that are directly reachable.
    pub(crate) fn direct(&mut self, mut tell: impl FnMut(u32)) {
        self.entries.sort_unstable();
        let (mut cone, mut least) = (u64::MAX, u64::MAX);
        for &(key, id) in &self.entries {
            if key >> 34 != cone {
                (cone, least) = (key >> 34, u64::MAX);
            }
            let b = key >> 1 & 0xffff;
            if b < least {
                least = b;
                if key & PRIMARY != 0 {
                    tell(id);
                }
            }
        }
    }
}

/// Cone, a and b in one number, ordered in this order. The lowest bit is free.
const fn key(cone: u32, a: u32, b: u32) -> u64 {
    (cone as u64) << 34 | (a as u64) << 17 | (b as u64) << 1
}

/// The cone of a displacement, counted clockwise from (0, 1), and its coordinates there: a of the move with the cone's number, b of the
/// next. On a move b is 0.
fn coordinates(to: Vector, rounds: u32) -> (u32, u32, u32) {
    let (mut x, mut y) = to.abs();
    let mut index = 0;
    for _ in 0..rounds {
        let beyond = x > y;
        index = 2 * index + u32::from(beyond);
        (x, y) = if beyond { (x - y, y) } else { (x, y - x) };
    }
    let quadrant = 1 << rounds;
    let (cone, a, b) = match (to.x >= 0, to.y >= 0) {
        (true, true) => (index, y, x),
        (true, false) => (2 * quadrant - 1 - index, x, y),
        (false, false) => (2 * quadrant + index, y, x),
        (false, true) => (4 * quadrant - 1 - index, x, y),
    };
    if a == 0 { ((cone + 1) % (4 * quadrant), b, 0) } else { (cone, a, b) }
}

/// Whether one of the cones of N(k) holds two displacements; `rounds` is k − 2.
#[inline]
pub(crate) fn are_in_one_cone(v: Vector, w: Vector, rounds: u32) -> bool {
    // The widest cones are those beside the axes, between (1, 0) and (k − 2, 1); a quick answer for most.
    let (det, dot) = (
        i64::from(v.x) * i64::from(w.y) - i64::from(v.y) * i64::from(w.x),
        i64::from(v.x) * i64::from(w.x) + i64::from(v.y) * i64::from(w.y),
    );
    if det.abs() * i64::from(rounds) > dot {
        return false;
    }
    let ((c, _, b), (d, _, e)) = (coordinates(v, rounds), coordinates(w, rounds));
    let before = |cone| (cone + (4 << rounds) - 1) % (4 << rounds);
    c == d
        || b == 0 && before(c) == d
        || e == 0 && before(d) == c
        || b == 0 && e == 0 && before(c) == before(d)
}
