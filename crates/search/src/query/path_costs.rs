//! Costs of paths other than their length.

use std::fmt::Debug;

use mediant_grid::Vector;
use mediant_moves::Cost;

use crate::path::Path;

/// The costs of a planner's paths where they are not lengths: what a [`Search`](crate::Search) must know to
/// compare paths, and to keep limits. A [`Cost`] is a number of units here, and the planner's observers are
/// told such costs.
pub trait PathCosts: Debug + Send + Sync {
    /// No path by this displacement costs less.
    fn least(&self, v: Vector) -> Cost;

    /// No path of segments at any angle by this displacement costs less.
    fn least_at_any_angle(&self, v: Vector) -> Cost;

    /// The cost of a path of the planner.
    fn cost(&self, path: &Path) -> Cost;

    /// The unit of the costs: a power of two.
    fn unit(&self) -> f64;
}
