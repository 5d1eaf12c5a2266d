//! The answer to a query.

use std::fmt;

use mediant_grid::{Rules, names};

use crate::{
    guarantee::Guarantee,
    path::{Measured, Path},
    query::{Limit, Stopped},
};

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

/// The answer to a query. Other kinds of answers may come.
///
/// As text it says which answer it is, and what the path measures, in cells.
///
/// ```
/// use mediant_search::{Answer, Path};
///
/// let path = Path::new(vec![(0, 0).into(), (3, 0).into(), (5, 2).into()]);
/// let answer = Answer::Found(path);
/// assert_eq!(answer.to_string(), "found: 3 waypoints, 5.83 cells");
/// match &answer {
///     Answer::Found(path) => assert_eq!(path.len(), 3),
///     Answer::Nearest(path) => println!("not there, but near: {path}"),
///     Answer::Unreachable => println!("there is no way"),
///     Answer::Stopped(stopped) => println!("so far {}", stopped.best),
///     _ => {}
/// }
/// assert_eq!(answer.into_path().map(|path| path.len()), Some(3));
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Answer {
    /// A path, as good as the engine's [`Guarantee`] says.
    Found(Path),
    /// There is no path.
    Unreachable,
    /// There is no path; this one leads to the reachable vertex that is nearest to the goal, if that was
    /// [asked for](crate::Query::nearest).
    Nearest(Path),
    /// A limit stopped the search.
    Stopped(Stopped),
}

impl Answer {
    /// The path that was asked for: to the goal, or to the nearest vertex. That of a stopped search is
    /// [`Stopped::best`].
    #[must_use]
    pub const fn path(&self) -> Option<&Path> {
        match self {
            Self::Found(path) | Self::Nearest(path) => Some(path),
            Self::Unreachable | Self::Stopped(_) => None,
        }
    }

    /// The cost of the path, if there is one: its length in cells, on a cost surface its cost there.
    #[must_use]
    pub fn cost(&self) -> Option<f64> {
        self.path().map(Path::cost)
    }

    /// The path, if there is one, without a copy.
    #[must_use]
    pub fn into_path(self) -> Option<Path> {
        match self {
            Self::Found(path) | Self::Nearest(path) => Some(path),
            Self::Unreachable | Self::Stopped(_) => None,
        }
    }

    /// The answer of a search between corners in the coordinates of [`CenterSpace`](crate::CenterSpace).
    #[must_use]
    pub fn at_centers(self) -> Self {
        match self {
            Self::Found(path) => Self::Found(path.at_centers()),
            Self::Nearest(path) => Self::Nearest(path.at_centers()),
            Self::Stopped(stopped) => Self::Stopped(Stopped { best: stopped.best.at_centers(), ..stopped }),
            Self::Unreachable => Self::Unreachable,
        }
    }

    /// Its kind.
    #[must_use]
    pub const fn status(&self) -> Status {
        match self {
            Self::Found(_) => Status::Found,
            Self::Unreachable => Status::Unreachable,
            Self::Nearest(_) => Status::Nearest,
            Self::Stopped(_) => Status::Stopped,
        }
    }

    /// The limit that stopped the search.
    #[must_use]
    pub const fn stopped_by(&self) -> Option<Limit> {
        if let Self::Stopped(stopped) = self { Some(stopped.by) } else { None }
    }

    /// Of a stopped answer the best so far: a path to a goal, or to the vertex nearest to one.
    #[must_use]
    pub const fn best(&self) -> Option<&Path> {
        if let Self::Stopped(stopped) = self { Some(&stopped.best) } else { None }
    }

    /// The length of the path in cells, on a cost surface its cost: the same number as that of tables and
    /// fields. Infinite if there is none, not a number if the search was stopped. `guarantee` is that of the
    /// engine.
    #[must_use]
    pub fn distance(&self, guarantee: Guarantee) -> f64 {
        match self {
            Self::Unreachable => f64::INFINITY,
            answer => answer.path().map_or(f64::NAN, |path| guarantee.length(path)),
        }
    }

    /// No path of the engine's kind to the goal that was asked for is shorter, in cells: no path over N(k),
    /// or by an engine of any-angle paths no path at all. Of a found path its own length where the engine
    /// guarantees that it is shortest, else 0; of a stopped answer what the search has ruled out; infinite
    /// where there is no path, also of a nearest answer.
    /// [`any_angle_lower_bound`](Self::any_angle_lower_bound) is another bound: for all angles, between the
    /// ends of the path that was found.
    #[must_use]
    pub fn lower_bound(&self, guarantee: Guarantee) -> f64 {
        match self {
            Self::Stopped(stopped) => stopped.lower_bound,
            Self::Found(path) if guarantee.is_optimal() => guarantee.length(path),
            Self::Found(_) => 0.0,
            Self::Unreachable | Self::Nearest(_) => f64::INFINITY,
        }
    }

    /// The certificate of the path: no path at any angle between the same two ends is shorter than this, in
    /// cells, though it bends at corners of obstacles. It is the length of the path divided by the
    /// [bound](Guarantee::bound) of the engine's guarantee, or the straight line if that is longer; at
    /// centers the any-angle optimum itself or the straight line ([`Guarantee::lower_bound`]). `None`
    /// without a path, and on a cost surface. The length divided by it says how far the path can be from the
    /// best at most.
    ///
    /// ```
    /// use mediant_grid::{DiagonalGap, Rules};
    /// use mediant_moves::FiniteK;
    /// use mediant_search::{Answer, Guarantee, Path};
    ///
    /// let eight_directions = Guarantee::Optimal(FiniteK::new(3)?);
    /// let answer = Answer::Found(Path::new(vec![(0, 0).into(), (2, 0).into(), (4, 2).into()]));
    /// let least = answer.any_angle_lower_bound(eight_directions, Rules::Corner(DiagonalGap::Open));
    /// // The straight line is free, and 8 % shorter than the shortest path over eight directions.
    /// assert_eq!((answer.distance(eight_directions).round(), least), (5.0, Some(20.0_f64.sqrt())));
    /// # Ok::<(), mediant_moves::KError>(())
    /// ```
    #[must_use]
    pub fn any_angle_lower_bound(&self, guarantee: Guarantee, rules: Rules) -> Option<f64> {
        let path = self.path().filter(|_| !guarantee.is_of_costs())?;
        let (start, goal) = (path.start()?, path.goal()?);
        // The rounded sum of a straight path's parts may be less than the straight line.
        Some(guarantee.lower_bound(rules, path.cost(), start.distance(goal)).min(path.cost()))
    }
}

/// As `found: 3 waypoints, 11.07 cells`; on a cost surface as `found: 3 waypoints, 11.07 cells, cost 30.50`.
impl fmt::Display for Answer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Found(path) => write!(f, "found: {}", Measured(path)),
            Self::Unreachable => f.write_str("unreachable"),
            Self::Nearest(path) => write!(f, "unreachable, the nearest is: {}", Measured(path)),
            Self::Stopped(stopped) => stopped.fmt(f),
        }
    }
}

#[cfg(test)]
mod tests {
    use mediant_moves::FiniteK;

    use super::{Answer, Status};
    use crate::{
        guarantee::Guarantee,
        path::Path,
        query::{Limit, Stopped},
    };

    /// The status, and with a guarantee the distance and the lower bound.
    fn told(answer: &Answer, guarantee: Guarantee) -> (Status, f64, f64) {
        (answer.status(), answer.distance(guarantee), answer.lower_bound(guarantee))
    }

    #[test]
    fn bounds_follow_from_the_kind_and_the_guarantee() {
        let exact = Guarantee::Optimal(FiniteK::N8);
        let path = || Path::new(vec![(0, 0).into(), (3, 0).into()]);
        let found = Answer::Found(path());
        assert_eq!(told(&found, exact), (Status::Found, 3.0, 3.0));
        assert_eq!(told(&found, Guarantee::OptimalAnyAngle), (Status::Found, 3.0, 3.0));
        for loose in [Guarantee::Suboptimal, Guarantee::AtMost(FiniteK::N8)] {
            assert_eq!(told(&found, loose), (Status::Found, 3.0, 0.0));
        }
        let nearest = Answer::Nearest(path());
        assert_eq!(told(&nearest, exact), (Status::Nearest, 3.0, f64::INFINITY));
        let none = Answer::Unreachable;
        assert_eq!(told(&none, exact), (Status::Unreachable, f64::INFINITY, f64::INFINITY));
        let stopped = Answer::Stopped(Stopped::before_search(Limit::Expansions, (1, 1)));
        assert!(stopped.distance(exact).is_nan() && stopped.path().is_none());
        assert_eq!((stopped.lower_bound(exact), stopped.status()), (0.0, Status::Stopped));
        assert_eq!(stopped.stopped_by(), Some(Limit::Expansions));
        assert_eq!(stopped.best().map(Path::len), Some(1));
        assert_eq!((found.stopped_by(), found.best().is_none()), (None, true));
    }
}
