//! What a search returns.

use mediant_grid::Vertex;
use mediant_moves::K;

/// A path by its waypoints, with its length.
///
/// Two consecutive waypoints are joined by one move of N(k), taken once or several times in a row, or in any-angle paths by
/// a straight legal segment. A path from a vertex to itself has that vertex alone.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    waypoints: Vec<Vertex>,
    cost: f64,
}

impl Path {
    /// The path along these waypoints; its cost is the sum of the lengths of the segments between them.
    #[must_use]
    pub fn new(waypoints: Vec<Vertex>) -> Self {
        // Not `sum`, which makes −0 of no segments.
        let cost = waypoints.windows(2).fold(0.0, |cost, ends| cost + ends[0].distance(ends[1]));
        Self { waypoints, cost }
    }

    /// The waypoints, start and goal included.
    #[must_use]
    pub fn waypoints(&self) -> &[Vertex] {
        &self.waypoints
    }

    /// The waypoints, given away.
    #[must_use]
    pub fn into_waypoints(self) -> Vec<Vertex> {
        self.waypoints
    }

    /// The Euclidean length in cells, recomputed from the waypoints rather than taken from the search's fixed-point sum.
    #[must_use]
    pub const fn cost(&self) -> f64 {
        self.cost
    }
}

/// The answer to a query.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// A path, as good as the engine's [`Guarantee`] says.
    Found(Path),
    /// There is no path.
    Unreachable,
}

impl Outcome {
    /// The path, if there is one.
    #[must_use]
    pub const fn path(&self) -> Option<&Path> {
        match self {
            Self::Found(path) => Some(path),
            Self::Unreachable => None,
        }
    }
}

/// What an engine promises of the paths that it returns. Every engine finds a path whenever there is one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Guarantee {
    /// No path over N(k) is shorter: in fixed-point costs exactly, in real lengths up to a factor of 1 + 2⁻³¹ (see
    /// [`Cost`](mediant_moves::Cost)).
    Optimal(K),
    /// No legal path at all is shorter.
    OptimalAnyAngle,
    /// None.
    Suboptimal,
}
