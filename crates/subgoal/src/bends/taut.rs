//! How a taut path bends at a convex corner.

use mediant_grid::{Grid, Vector, Vertex};

/// A convex corner of an obstacle, where taut paths bend around the blocked cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ConvexCorner {
    /// The direction of the blocked cell; both components are ±1.
    cell: Vector,
    /// Whether the cell diagonally opposite is blocked too.
    is_gap: bool,
}

impl ConvexCorner {
    /// The corner at a vertex that touches one blocked cell, or two that meet diagonally.
    pub(super) fn at(grid: &Grid, at: Vertex) -> Self {
        let blocked = |x: i32, y: i32| grid.is_blocked(at.x + (x - 1) / 2, at.y + (y - 1) / 2);
        let cells = [(1, 1), (1, -1), (-1, 1), (-1, -1)];
        let cell = cells.into_iter().find(|&(x, y)| blocked(x, y)).unwrap_or((1, 1));
        Self { cell: cell.into(), is_gap: blocked(-cell.0, -cell.1) }
    }

    /// How a taut path may leave that arrives by `v`.
    #[inline]
    pub(super) fn after(self, v: Vector) -> TautDepartures {
        TautDepartures { arrival: v, cell: self.cell, side: det(v, self.cell).signum(), is_gap: self.is_gap }
    }
}

/// The directions in which a taut path may leave a convex corner, at which it arrived with the blocked cell
/// on one side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TautDepartures {
    arrival: Vector,
    cell: Vector,
    side: i64,
    is_gap: bool,
}

impl TautDepartures {
    /// The displacement by which the path arrived.
    #[inline]
    pub(super) const fn arrival(self) -> Vector {
        self.arrival
    }

    /// Whether a taut path may leave by `w`: with the cell on the same side, and straight on or towards the
    /// cell.
    #[inline]
    pub(super) fn allows(self, w: Vector) -> bool {
        self.side * det(w, self.cell) > 0 && (self.is_gap || self.side * det(self.arrival, w) >= 0)
    }
}

#[inline]
fn det(v: Vector, w: Vector) -> i64 {
    i64::from(v.x) * i64::from(w.y) - i64::from(v.y) * i64::from(w.x)
}
