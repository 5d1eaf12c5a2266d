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
    pub(crate) fn at(grid: &Grid, at: Vertex) -> Self {
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

impl ConvexCorner {
    /// How paths bend here that come from the left (side 0) or from the right (1), in two bits: the sign of
    /// the turn, and whether any turn is taut.
    pub(crate) fn bits(self, side: u32) -> u32 {
        // They leave through the quadrant beside that of the cell, on the other side.
        let x = if side == 0 { 1 } else { -1 };
        let quadrant = Vector::new(x, -x * self.cell.x * self.cell.y);
        u32::from(det(quadrant, self.cell) > 0) | u32::from(self.is_gap) << 1
    }

    /// The side from which taut paths come that leave by `w`, and how far `w` is from the wall of the cell: 0
    /// along it, infinity across.
    pub(crate) fn side_and_slope(self, w: Vector) -> (u32, f64) {
        let towards = det(w, self.cell).signum() as i32 * self.cell.x * self.cell.y;
        let (x, y) = (f64::from(w.x.abs()), f64::from(w.y.abs()));
        // Through the quadrant that has the cell's x, the wall is horizontal.
        let slope = if towards > 0 { y / x } else { x / y };
        (u32::from(towards * self.cell.x < 0), slope)
    }
}

/// The directions in which a path may leave a subgoal to which it came from one side.
#[derive(Clone, Copy, Debug)]
pub struct SideDepartures {
    arrival: Vector,
    /// 1 or −1.
    sign: i32,
    is_gap: bool,
}

impl SideDepartures {
    #[inline]
    pub(crate) const fn new(bits: u32, arrival: Vector) -> Self {
        Self { arrival, sign: 2 * (bits & 1) as i32 - 1, is_gap: bits & 2 != 0 }
    }

    /// The arrivals from which a path may leave by `w`, on a side with these bits, as one of their bounds:
    /// its components take 16 bits each, and 0 is for all arrivals. An axis edge along a whole side of the
    /// largest map does not fit; it is made shorter, in the same direction.
    pub(crate) fn half_plane(bits: u32, w: Vector) -> u32 {
        let Self { sign, is_gap, .. } = Self::new(bits, w);
        let most = i32::from(i16::MAX);
        let part = |x: i32| if is_gap { 0 } else { sign * x.clamp(-most, most) };
        u32::from(part(w.x) as u16) << 16 | u32::from(part(w.y) as u16)
    }

    /// No arrivals: no half plane is that.
    pub(crate) const NO_ARRIVALS: u32 = 0x8000_8000;

    /// Whether an arrival is in a [half plane](Self::half_plane).
    #[inline]
    pub(crate) const fn is_in(arrival: Vector, half_plane: u32) -> bool {
        let w = Vector::new((half_plane as i32) >> 16, half_plane as i16 as i32);
        (half_plane != Self::NO_ARRIVALS) & (det(arrival, w) >= 0)
    }

    /// Whether the path may leave by `w`, on that side.
    #[inline]
    pub(crate) const fn allows(self, w: Vector) -> bool {
        self.is_gap | (self.sign as i64 * det(self.arrival, w) >= 0)
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
const fn det(v: Vector, w: Vector) -> i64 {
    v.x as i64 * w.y as i64 - v.y as i64 * w.x as i64
}
