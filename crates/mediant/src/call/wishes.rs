//! Wishes beyond the ends of a path.

use mediant_grid::Point;
use mediant_search::{Limits as SearchLimits, Query};

use crate::limits::Limits;

/// Wishes beyond the ends of a path: nearest vertex, tolerance, moved ends, limits. By default there are
/// none.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Wishes {
    /// Where there is no way, the path to the reachable vertex nearest to the goal.
    pub nearest: bool,
    /// Blocked ends are moved to the nearest free vertex.
    pub snap: bool,
    /// The path may end within this many cells of the goal.
    pub tolerance: Option<f64>,
    /// The greatest length of a path, in cells, or its cost where cells have costs.
    pub max_cost: Option<f64>,
    /// The greatest number of expansions.
    pub max_expansions: Option<u64>,
    /// The most time, in the language's unit: seconds in Python, milliseconds in the program and in
    /// JavaScript. Its clock is the caller's.
    pub timeout: Option<f64>,
}

impl Wishes {
    /// Whether no more is asked than a path from one vertex to another.
    #[must_use]
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// Whether a limit may stop the search.
    #[must_use]
    pub const fn has_limits(&self) -> bool {
        self.max_cost.is_some() || self.max_expansions.is_some() || self.timeout.is_some()
    }

    /// The limits on cost and expansions.
    #[must_use]
    pub fn limits(&self) -> Limits {
        let limits = self.max_cost.map_or(Limits::new(), |cells| Limits::new().cost(cells));
        self.max_expansions.map_or(limits.clone(), |count| limits.expansions(count))
    }

    /// The query for the shortest path from any start to any goal within limits, which are those of
    /// [`limits`](Self::limits) with a deadline or a flag of the caller's.
    #[must_use]
    pub fn query<P: Into<Point> + Copy>(
        &self,
        starts: &[P],
        goals: &[P],
        limits: impl Into<SearchLimits>,
    ) -> Query {
        let limits = limits.into();
        let mut query = match (starts, goals) {
            (&[start], &[goal]) => Query::new(start, goal),
            _ => Query::between(starts.iter().copied(), goals.iter().copied()),
        };
        if !limits.are_none() {
            query = query.within(limits);
        }
        if let Some(cells) = self.tolerance {
            query = query.tolerance(cells);
        }
        if self.nearest {
            query = query.nearest();
        }
        if self.snap { query.snap() } else { query }
    }
}
