//! The answer to a query, as every language tells it.

use mediant_grid::{Rules, names};
use mediant_search::{Guarantee, Limit, Outcome, Path, Stopped};

/// The kind of an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Status {
    /// There is a path.
    Found,
    /// There is none.
    Unreachable,
    /// There is none; the path leads to the reachable vertex that is nearest to the goal.
    Nearest,
    /// A limit stopped the search.
    Stopped,
}

names!(Status: Found => "found", Unreachable => "unreachable", Nearest => "nearest", Stopped => "stopped");

/// An outcome, with what the guarantee of its engine makes of it.
///
/// ```
/// use mediant::{Answer, Engine, K, Map, Motion, Query, Status};
///
/// let space = Map::from_rows(["..#.", "..#."])?.space(Motion::centers(K::N8))?;
/// let mut planner = space.planner(Engine::AStar)?;
/// let outcome = planner.find(Query::new((0, 0), (3, 0)).nearest())?;
/// let answer = Answer::new(&outcome, planner.guarantee());
/// assert_eq!((answer.status(), answer.distance(), answer.lower_bound()), (Status::Nearest, 1.0, f64::INFINITY));
/// # Ok::<(), mediant::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Answer<'a> {
    outcome: &'a Outcome,
    guarantee: Guarantee,
}

impl<'a> Answer<'a> {
    /// The answer of an engine with this guarantee.
    #[must_use]
    pub const fn new(outcome: &'a Outcome, guarantee: Guarantee) -> Self {
        Self { outcome, guarantee }
    }

    /// Its kind.
    #[must_use]
    pub const fn status(&self) -> Status {
        match self.outcome {
            Outcome::Found(_) => Status::Found,
            Outcome::Nearest(_) => Status::Nearest,
            Outcome::Stopped(_) => Status::Stopped,
            _ => Status::Unreachable,
        }
    }

    /// The path: of a found or nearest answer.
    #[must_use]
    pub const fn path(&self) -> Option<&'a Path> {
        self.outcome.path()
    }

    /// The length of the path in cells, the same number as that of tables and fields: infinite if there is
    /// none, not a number if the search was stopped.
    #[must_use]
    pub fn distance(&self) -> f64 {
        match self.outcome {
            Outcome::Unreachable => f64::INFINITY,
            outcome => outcome.path().map_or(f64::NAN, |path| self.guarantee.length(path)),
        }
    }

    /// No path of the engine's kind to the goal that was asked for is shorter, in cells: no path over N(k),
    /// or by an engine of any-angle paths no path at all. Of a found path its own length where the engine
    /// guarantees that it is shortest, else 0; of a stopped answer what the search has ruled out; infinite
    /// where there is no path, also of a nearest answer.
    /// [`any_angle_lower_bound`](Self::any_angle_lower_bound) is another bound: for all angles, between the
    /// ends of the path that was found.
    #[must_use]
    pub fn lower_bound(&self) -> f64 {
        let is_optimal = matches!(self.guarantee, Guarantee::Optimal(_) | Guarantee::OptimalAnyAngle);
        match self.outcome {
            Outcome::Stopped(stopped) => stopped.lower_bound,
            Outcome::Found(path) if is_optimal => self.guarantee.length(path),
            Outcome::Found(_) => 0.0,
            _ => f64::INFINITY,
        }
    }

    /// The certificate of the path: no path at any angle between the same two vertices under the same rules
    /// is shorter than this, in cells. It is the length of the path divided by the
    /// [bound](Guarantee::bound) of the engine's guarantee, or the straight line if that is longer. `None`
    /// without a path. The length divided by it says how far the path can be from the best at most.
    ///
    /// ```
    /// use mediant::{Answer, Engine, Map, Motion, Query};
    ///
    /// let space = Map::new(9, 9)?.space(Motion::corners(3))?;
    /// let mut planner = space.planner(Engine::AStar)?;
    /// let outcome = planner.find(Query::new((0, 0), (4, 2)))?;
    /// let answer = Answer::new(&outcome, planner.guarantee());
    /// let least = answer.any_angle_lower_bound(space.motion().rules);
    /// // The straight line is free, and 8 % shorter than the shortest path over eight directions.
    /// assert_eq!((answer.distance().round(), least), (5.0, Some(20.0_f64.sqrt())));
    /// # Ok::<(), mediant::Error>(())
    /// ```
    #[must_use]
    pub fn any_angle_lower_bound(&self, rules: Rules) -> Option<f64> {
        let path = self.path()?;
        let (start, goal) = (path.waypoints().first()?, path.waypoints().last()?);
        // The rounded sum of a straight path's parts may be less than the straight line.
        Some(self.guarantee.lower_bound(rules, path.cost(), start.distance(*goal)).min(path.cost()))
    }

    /// The limit that stopped the search.
    #[must_use]
    pub const fn stopped_by(&self) -> Option<Limit> {
        match self.outcome {
            Outcome::Stopped(Stopped { by, .. }) => Some(*by),
            _ => None,
        }
    }

    /// Of a stopped answer the best so far: a path to a goal, or to the vertex nearest to one.
    #[must_use]
    pub const fn best(&self) -> Option<&'a Path> {
        match self.outcome {
            Outcome::Stopped(Stopped { best, .. }) => Some(best),
            _ => None,
        }
    }
}
