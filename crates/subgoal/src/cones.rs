//! The cones between adjacent moves of N(k), and coordinates in them.

use mediant_grid::Vector;

/// A displacement `a·v + b·w` in the cone between two adjacent moves v and w of N(k). The numbers a and b are
/// integers, since det(v, w) = 1; for a multiple of a move b is 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ConeCoordinates {
    /// The number of the cone and of v, counted clockwise from (0, 1).
    pub(crate) cone: u32,
    pub(crate) a: u32,
    pub(crate) b: u32,
}

impl ConeCoordinates {
    /// The coordinates of a displacement; `depth` is k − 2.
    pub(crate) fn of(v: Vector, depth: u32) -> Self {
        // Descends the tree of moves: each step replaces one of the bounding moves by their sum.
        let (mut x, mut y) = v.abs();
        let mut index = 0;
        for _ in 0..depth {
            let beyond = x > y;
            index = 2 * index + u32::from(beyond);
            (x, y) = if beyond { (x - y, y) } else { (x, y - x) };
        }
        let quadrant = 1 << depth;
        let (cone, a, b) = match (v.x >= 0, v.y >= 0) {
            (true, true) => (index, y, x),
            (true, false) => (2 * quadrant - 1 - index, x, y),
            (false, false) => (2 * quadrant + index, y, x),
            (false, true) => (4 * quadrant - 1 - index, x, y),
        };
        if a == 0 { Self { cone: (cone + 1) % (4 * quadrant), a: b, b: 0 } } else { Self { cone, a, b } }
    }

    /// The cone before this one. A multiple of a move lies in it too.
    pub(crate) const fn cone_before(self, depth: u32) -> u32 {
        let cones = 4 << depth;
        (self.cone + cones - 1) % cones
    }
}

/// Whether a cone of N(k) contains both displacements; `depth` is k − 2.
#[inline]
pub(crate) fn share_cone(v: Vector, w: Vector, depth: u32) -> bool {
    // The widest cones are those beside the axes, between (1, 0) and (k − 2, 1). Wider angles are answered at
    // once.
    let (det, dot) = (
        i64::from(v.x) * i64::from(w.y) - i64::from(v.y) * i64::from(w.x),
        i64::from(v.x) * i64::from(w.x) + i64::from(v.y) * i64::from(w.y),
    );
    if det.abs() * i64::from(depth) > dot {
        return false;
    }
    let [v, w] = [v, w].map(|v| ConeCoordinates::of(v, depth));
    v.cone == w.cone
        || v.b == 0 && v.cone_before(depth) == w.cone
        || w.b == 0 && w.cone_before(depth) == v.cone
        || v.b == 0 && w.b == 0 && v.cone_before(depth) == w.cone_before(depth)
}
