//! Where a shortest path may bend.

use mediant_grid::{FreeSpace, Grid, Placement, PlacementKind, Vector, Vertex};
use mediant_moves::{FiniteK, K};

use crate::{
    direct::are_in_one_cone,
    placement::Edges,
    turns::{Turn, Turns},
};

/// Where the shortest paths over a subgoal may bend.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Bend {
    /// Those that count are taut.
    Taut(Corner),
    /// They are over N(k), at corners; `rounds` is k − 2.
    GridGraph(Corner, u32),
    /// They are over N(3), at centers.
    Eight(Turns),
}

impl Bend {
    /// That of all shortest paths, where something is known of them.
    pub(crate) fn of_shortest<P: Placement>(space: &FreeSpace<P>, k: K, at: Vertex) -> Option<Self> {
        let grid = space.grid();
        match (P::KIND, k) {
            (PlacementKind::Corner, K::Any) => Some(Self::Taut(Corner::at(grid, at))),
            (PlacementKind::Corner, K::Finite(k)) => Some(Self::GridGraph(Corner::at(grid, at), k.depth())),
            (PlacementKind::Center, K::Finite(FiniteK::N8)) => Some(Self::Eight(Turns::at(grid, at))),
            (PlacementKind::Center, _) => None,
        }
    }

    /// That of the lightest paths (see [`Norm::weight`](crate::norm::Norm::weight)), which are taut if `edges` are.
    pub(crate) fn of_lightest<P: Placement>(
        space: &FreeSpace<P>,
        k: K,
        edges: Edges,
        at: Vertex,
    ) -> Option<Self> {
        match edges {
            Edges::Taut => Some(Self::Taut(Corner::at(space.grid(), at))),
            Edges::Direct => Self::of_shortest(space, k, at),
        }
    }

    /// Where a path that comes by the edge `v` may go on.
    #[inline]
    pub(crate) fn after(self, v: Vector) -> Onward {
        match self {
            Self::Taut(corner) => Onward::Taut(corner.after(v)),
            Self::GridGraph(corner, rounds) => Onward::GridGraph(corner.after(v), rounds),
            Self::Eight(turns) => Onward::Eight(turns.after(v)),
        }
    }
}

/// Where a path may go on that came to a subgoal in a known direction.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Onward {
    Taut(Around),
    GridGraph(Around, u32),
    Eight(Turn),
}

impl Onward {
    /// Whether it may do so by the edge `w`.
    #[inline]
    pub(crate) fn allows(self, w: Vector) -> bool {
        match self {
            Self::Taut(around) => around.allows(w),
            // Where no obstacle is on the inner side of the bend, the path can be cut short there, and that is shorter by h_k unless both directions are
            // in one cone, in which h_k is linear.
            Self::GridGraph(around, rounds) => around.allows(w) || are_in_one_cone(around.came, w, rounds),
            Self::Eight(turn) => turn.allows(w),
        }
    }
}

/// A convex corner, at which taut paths bend around the blocked cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Corner {
    /// Where the blocked cell is; both signs are ±1.
    cell: Vector,
    /// Whether the cell opposite is blocked too.
    is_double: bool,
}

impl Corner {
    /// The corner at a vertex at which one cell is blocked, or two that meet diagonally.
    pub(crate) fn at(grid: &Grid, at: Vertex) -> Self {
        let blocked = |x: i32, y: i32| grid.is_blocked(at.x + (x - 1) / 2, at.y + (y - 1) / 2);
        let cells = [(1, 1), (1, -1), (-1, 1), (-1, -1)];
        let cell = cells.into_iter().find(|&(x, y)| blocked(x, y)).unwrap_or((1, 1));
        Self { cell: cell.into(), is_double: blocked(-cell.0, -cell.1) }
    }

    /// Where a taut path that comes by `v` may go on.
    #[inline]
    fn after(self, v: Vector) -> Around {
        Around { came: v, cell: self.cell, side: det(v, self.cell).signum(), is_double: self.is_double }
    }
}

/// A way to a convex corner, which has the blocked cell on one side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Around {
    came: Vector,
    cell: Vector,
    side: i64,
    is_double: bool,
}

impl Around {
    /// Whether a taut path may go on by `w`: with the cell on the same side, and straight on or towards it.
    #[inline]
    fn allows(self, w: Vector) -> bool {
        self.side * det(w, self.cell) > 0 && (self.is_double || self.side * det(self.came, w) >= 0)
    }
}

#[inline]
fn det(v: Vector, w: Vector) -> i64 {
    i64::from(v.x) * i64::from(w.y) - i64::from(v.y) * i64::from(w.x)
}
