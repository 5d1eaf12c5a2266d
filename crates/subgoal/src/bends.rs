//! At which subgoals a shortest path may bend, and how: what lets a search skip arcs, and a contraction skip
//! shortcuts.

mod octile;
mod taut;

use std::ops::Range;

use mediant_grid::{FreeSpace, Grid, Placement, PlacementKind, Vector, Vertex};
use mediant_moves::{FiniteK, K};

use self::taut::TautDepartures;
pub(crate) use self::{
    octile::{OctileBends, OctileDepartures},
    taut::{ConvexCorner, SideDepartures},
};
use crate::cones::share_cone;

/// How the shortest paths over a subgoal may bend there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BendRule {
    /// Taut paths, at corners.
    Taut(ConvexCorner),
    /// Shortest paths over N(k), at corners; the number is k − 2.
    GridGraph(ConvexCorner, u32),
    /// Shortest paths over N(3), at centers.
    Octile(OctileBends),
}

impl BendRule {
    /// The rule that no shortest path over N(k) breaks, or at any angle; `None` if none is known.
    pub(crate) fn of_shortest<P: Placement>(space: &FreeSpace<P>, k: K, at: Vertex) -> Option<Self> {
        let grid = space.grid();
        match (P::KIND, k) {
            (PlacementKind::Corner, K::Any) => Some(Self::taut(grid, at)),
            (PlacementKind::Corner, K::Finite(k)) => {
                Some(Self::GridGraph(ConvexCorner::at(grid, at), k.depth()))
            }
            (PlacementKind::Center, K::Finite(FiniteK::N8)) => Some(Self::Octile(OctileBends::at(grid, at))),
            (PlacementKind::Center, _) => None,
        }
    }

    /// The rule that every taut path keeps, at corners.
    pub(crate) fn taut(grid: &Grid, at: Vertex) -> Self {
        Self::Taut(ConvexCorner::at(grid, at))
    }

    /// How a path may leave that arrives along the edge `v`.
    #[inline]
    pub(crate) fn after(self, v: Vector) -> Departures {
        match self {
            Self::Taut(corner) => Departures::Taut(corner.after(v)),
            Self::GridGraph(corner, depth) => Departures::GridGraph(corner.after(v), depth),
            Self::Octile(bends) => Departures::Octile(bends.after(v)),
        }
    }
}

/// The directions in which a path may leave a subgoal at which it arrived in a known direction.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Departures {
    Taut(TautDepartures),
    GridGraph(TautDepartures, u32),
    Octile(OctileDepartures),
}

impl Departures {
    /// Whether the path may leave along the edge `w`.
    #[inline]
    pub(crate) fn allows(self, w: Vector) -> bool {
        match self {
            Self::Taut(departures) => departures.allows(w),
            // Where no obstacle lies on the inner side of the bend, a path can cut the bend. The shortcut
            // costs less over N(k) unless both directions are in one cone, in which h_k is linear.
            Self::GridGraph(departures, depth) => {
                departures.allows(w) || share_cone(departures.arrival(), w, depth)
            }
            Self::Octile(departures) => departures.allows(w),
        }
    }

    /// Appends those of the numbers along whose edges, among all these, the path may leave.
    pub(crate) fn keep(self, edges: &[Vector], numbers: Range<u32>, kept: &mut Vec<u32>) {
        match self {
            // A loop of its own: most edges of a large graph are looked at here.
            Self::Taut(departures) => {
                kept.extend(numbers.filter(|&number| departures.allows(edges[number as usize])));
            }
            _ => kept.extend(numbers.filter(|&number| self.allows(edges[number as usize]))),
        }
    }
}
