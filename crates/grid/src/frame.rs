//! Straight segments of all directions, reduced to the first octant.

use mediant_moves::Vector;

use crate::Placement;

/// A cell by its offset (columns, rows) from cell (x, y), for a vertex (x, y).
#[doc(hidden)]
pub type CellOffset = (i32, i32);

/// How the first octant of [`Placement::sweep`] lies on the map: which axis is the long one, and the signs
/// along both.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    /// Whether the segment is longer down than across, so that the transposed map has its runs of bits.
    pub(crate) transposed: bool,
    /// The sign along the long axis.
    pub(crate) long: i32,
    /// The sign along the short axis.
    short: i32,
}

impl Frame {
    /// The frame of a displacement, and the displacement in it.
    pub(crate) const fn of(d: Vector) -> (Self, Vector) {
        let transposed = d.y.unsigned_abs() > d.x.unsigned_abs();
        let (u, v) = if transposed { (d.y, d.x) } else { (d.x, d.y) };
        let frame = Self { transposed, long: if u < 0 { -1 } else { 1 }, short: if v < 0 { -1 } else { 1 } };
        (frame, Vector::new(u.abs(), v.abs()))
    }

    /// The offset of cell (i, j) of the octant along the long and along the short axis.
    pub(crate) fn cell<P: Placement>(self, (i, j): (i32, i32)) -> CellOffset {
        (P::cell(self.long, i), P::cell(self.short, j))
    }

    /// The offset of cell (i, j) of the octant on the map.
    pub(crate) fn offset<P: Placement>(self, cell: (i32, i32)) -> CellOffset {
        let (along, across) = self.cell::<P>(cell);
        if self.transposed { (across, along) } else { (along, across) }
    }
}
