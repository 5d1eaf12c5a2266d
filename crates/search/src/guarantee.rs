//! The guarantee of an engine for the length of its paths.

use std::fmt;

use mediant_grid::{CornerRule, Rules, Vertex};
use mediant_moves::{BOUND_WITHOUT_CORNER_CUTTING, Cost, FiniteK, bound_at_centers, bound_at_corners};

use crate::{
    path::Path,
    segment::{length_cost, move_cost},
};

/// An engine's guarantee of the length of its paths. Every engine finds a path whenever there is one; one
/// that may fail says so by [`QueryError::GaveUp`](crate::QueryError::GaveUp).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Guarantee {
    /// The path is over N(k), and no path over N(k) is shorter: in fixed-point costs exactly, in real lengths
    /// up to a factor of 1 + 2⁻³¹ (see [`Cost`](mediant_moves::Cost)).
    Optimal(FiniteK),
    /// The path is over N(k) on a cost surface, and no path over N(k) costs less there. Of lengths, and of
    /// paths at any angle, it says nothing.
    Cheapest(FiniteK),
    /// No path over N(k) is shorter, in the same sense; the path itself has segments at any angle.
    AtMost(FiniteK),
    /// No path over N(k) costs less on the cost surface; the path itself has segments at any angle.
    AtMostCheapest(FiniteK),
    /// No legal path at all is shorter.
    OptimalAnyAngle,
    /// Nothing.
    Suboptimal,
}

/// As `optimal(3)`, `cheapest(3)`, `at most optimal(3)`, `at most cheapest(3)`, `optimal(any)` or
/// `suboptimal`.
impl fmt::Display for Guarantee {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Optimal(k) => f.pad(&format!("optimal({k})")),
            Self::Cheapest(k) => f.pad(&format!("cheapest({k})")),
            Self::AtMost(k) => f.pad(&format!("at most optimal({k})")),
            Self::AtMostCheapest(k) => f.pad(&format!("at most cheapest({k})")),
            Self::OptimalAnyAngle => f.pad("optimal(any)"),
            Self::Suboptimal => f.pad("suboptimal"),
        }
    }
}

impl Guarantee {
    /// The suboptimality bound: the greatest cost of a path, as a multiple of the any-angle optimum between
    /// the same two vertices under the same rules. For N(k) by Kramm 2018, Theorems 2 and 3, see
    /// [`bound_at_corners`] and [`bound_at_centers`]. `None` where no bound is proven.
    ///
    /// **At centers** N(k) is measured against any-angle paths that bend at centers, as its own paths do.
    /// Paths that bend at corners of obstacles can be shorter than Theorem 3 says: on the map `.@.` above
    /// `...` every path over N(k) from (0, 0) to (2, 0) costs 4 under `never`, and that one 1 + √2. No bound
    /// of this kind holds against it ([`lower_bound`](Self::lower_bound)).
    ///
    /// ```
    /// use mediant_grid::{CornerRule, DiagonalGap, Rules};
    /// use mediant_moves::FiniteK;
    /// use mediant_search::Guarantee;
    /// let promised = Guarantee::Optimal(FiniteK::new(3)?);
    /// let bound = promised.bound(Rules::Corner(DiagonalGap::Open));
    /// assert!(bound.is_some_and(|bound| (bound - 1.0824).abs() < 1e-4));
    /// assert_eq!(promised.bound(Rules::Center(CornerRule::Always)), None);
    /// # Ok::<(), mediant_moves::KError>(())
    /// ```
    #[must_use]
    pub fn bound(self, rules: Rules) -> Option<f64> {
        match (self, rules) {
            (Self::OptimalAnyAngle, _) => Some(1.0),
            (Self::Suboptimal | Self::Cheapest(_) | Self::AtMostCheapest(_), _)
            | (_, Rules::Center(CornerRule::Always)) => None,
            // Over N(k) no path leads from center to center by corners.
            (_, Rules::CenterGap(_)) => None,
            (Self::Optimal(k) | Self::AtMost(k), Rules::Corner(_)) => Some(bound_at_corners(k)),
            (Self::Optimal(k) | Self::AtMost(k), Rules::Center(CornerRule::One)) => Some(bound_at_centers(k)),
            (_, Rules::Center(CornerRule::Never)) => Some(BOUND_WITHOUT_CORNER_CUTTING),
        }
    }

    /// The length of a path with this guarantee, by which it is compared with others (not on a cost surface,
    /// where [`PathCosts`](crate::PathCosts) has the cost): of an optimal path over
    /// N(k) the cost of its moves, as the search has it; of others a cost that depends on nothing but the
    /// length. So paths that are equally long compare as equal.
    #[must_use]
    pub fn cost(self, path: &Path) -> Cost {
        match path.waypoints() {
            // Through points that are no vertices: at any angle.
            [] => Cost::from_bits((path.length() * (1_u64 << Cost::FRACTION_BITS) as f64 + 0.5) as u64),
            waypoints => self.cost_along(waypoints),
        }
    }

    /// The [`cost`](Self::cost) of the path with these waypoints.
    #[must_use]
    pub fn cost_along(self, waypoints: &[Vertex]) -> Cost {
        let of_segment = if let Self::Optimal(_) = self { move_cost } else { length_cost };
        waypoints.windows(2).fold(Cost::ZERO, |cost, ends| cost + of_segment(ends[0].to(ends[1])))
    }

    /// The length of a path with this guarantee, in cells, as it is told where no path is: of an optimal path
    /// over N(k) its [`cost`](Self::cost), which is the same for all optimal paths between two vertices, and
    /// for every engine, table and field; of others [`Path::cost`]. The two differ by a factor of 1 + 2⁻³³ at
    /// most. On a cost surface it is the cost there.
    #[must_use]
    pub fn length(self, path: &Path) -> f64 {
        if let Self::Optimal(_) = self { self.cost(path).to_f64() } else { path.cost() }
    }

    /// Whether no path of the engine's kind is better than its paths.
    #[must_use]
    pub const fn is_optimal(self) -> bool {
        matches!(self, Self::Optimal(_) | Self::Cheapest(_) | Self::OptimalAnyAngle)
    }

    /// Whether it speaks of costs on a cost surface, rather than of lengths.
    #[must_use]
    pub const fn is_of_costs(self) -> bool {
        matches!(self, Self::Cheapest(_) | Self::AtMostCheapest(_))
    }

    /// The guarantee of the same paths once they are smoothed.
    #[must_use]
    pub const fn smoothed(self) -> Self {
        match self {
            Self::Optimal(k) => Self::AtMost(k),
            Self::Cheapest(k) => Self::AtMostCheapest(k),
            Self::AtMost(_) | Self::AtMostCheapest(_) | Self::OptimalAnyAngle | Self::Suboptimal => self,
        }
    }

    /// A lower bound of the cost of every path at any angle between two vertices that bends at corners of
    /// obstacles, when a path with this guarantee costs `cost` and the straight line between them measures
    /// `straight`. It is `cost` where that is the optimum itself; at corners the larger of `straight` and
    /// `cost` divided by the [bound](Self::bound); at centers `straight`, since no bound holds against such
    /// paths there. In cells, up to the rounding that the guarantee allows. 0 on a cost surface, for which
    /// none is known.
    #[must_use]
    pub fn lower_bound(self, rules: Rules, cost: f64, straight: f64) -> f64 {
        if self.is_of_costs() {
            return 0.0;
        }
        let bound = self.bound(rules).filter(|_| rules.gap().is_some() || self == Self::OptimalAnyAngle);
        bound.map_or(straight, |bound| straight.max(cost / bound))
    }
}
