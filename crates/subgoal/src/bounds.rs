//! Boxes around vertices.

use mediant_grid::{Rectangle, Vertex};

/// The smallest box around some vertices. No side of a map has more than 2¹⁵ cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Bounds {
    low: [u16; 2],
    high: [u16; 2],
}

impl Bounds {
    /// The box around no vertex.
    pub(crate) const EMPTY: Self = Self { low: [u16::MAX; 2], high: [0; 2] };

    /// Takes in a vertex.
    #[inline]
    pub(crate) fn add(&mut self, at: Vertex) {
        let at = [at.x.max(0) as u16, at.y.max(0) as u16];
        self.join(Self { low: at, high: at });
    }

    /// The box around two vertices.
    pub(crate) fn around(ends: [Vertex; 2]) -> Self {
        let mut bounds = Self::EMPTY;
        ends.into_iter().for_each(|at| bounds.add(at));
        bounds
    }

    /// Takes in another box.
    #[inline]
    pub(crate) fn join(&mut self, other: Self) {
        for axis in 0..2 {
            self.low[axis] = self.low[axis].min(other.low[axis]);
            self.high[axis] = self.high[axis].max(other.high[axis]);
        }
    }

    /// The first and the last tile along both axes, if tiles have a side of 2 to the power of `shift`; `None`
    /// for an empty box.
    pub(crate) fn tiles(&self, shift: u32) -> Option<([usize; 2], [usize; 2])> {
        let tile = |at: [u16; 2]| at.map(|at| usize::from(at >> shift));
        (self.low[0] <= self.high[0]).then(|| (tile(self.low), tile(self.high)))
    }

    /// Whether a vertex lies in the box.
    #[inline]
    pub(crate) fn contains(&self, at: Vertex) -> bool {
        let within =
            |axis: usize, at: i32| (i32::from(self.low[axis])..=i32::from(self.high[axis])).contains(&at);
        within(0, at.x) && within(1, at.y)
    }

    /// Whether a cell of a rectangle touches a vertex of the box.
    #[inline]
    pub(crate) fn touches(&self, cells: &Rectangle) -> bool {
        let touches = |axis: usize, first: u32, count: u32| {
            first <= u32::from(self.high[axis]) && u32::from(self.low[axis]) <= first + count
        };
        touches(0, cells.x, cells.width) && touches(1, cells.y, cells.height)
    }
}
