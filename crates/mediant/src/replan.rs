//! Paths of agents while the map changes: replan only when that is needed.

use mediant_grid::Mismatch;
use mediant_search::{Answer, Path, PointEnds, QueryError};

use crate::{change::Change, error::Error, planner::Planner};

/// The fate of a path after a change of the map: see [`Planner::replan`].
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub enum Replanned {
    /// It holds, and nothing shorter was found, or can be there: go on.
    Kept,
    /// It does not hold any more, or this path is shorter.
    Replaced(Path),
    /// It does not hold any more, and there is no other way.
    Unreachable,
}

/// By which part of its length a path must be shorter to be taken. Paths of the same length can differ in the
/// last bits, and an agent should not change its mind for these.
const GAIN: f64 = 1.0 / (1_u64 << 30) as f64;

impl Planner {
    /// Keeps or replaces a path of this planner after a change of the map. An agent that has gone a part of
    /// its way hands over the [rest](Path::rest). The planner answers on an index of the space after the
    /// change.
    ///
    /// The rule:
    /// 1. If the path does not hold any more, a new one is searched.
    /// 2. If it holds, and is no longer than [any way through freed cells](Change::least_by_freed), it is
    ///    kept without a search. Was it a shortest path before, it is one now.
    /// 3. Otherwise a new one is searched, and taken only if it is shorter, by more than 2⁻³⁰ of the length.
    ///
    /// Where cells have costs, the second rule is left out, and what counts is the cost in the space after
    /// the change.
    ///
    /// ```
    /// use mediant::{Engine, Map, Motion, Replanned};
    ///
    /// let space = Map::from_fn(9, 9, |x, y| x == 4 && y > 0)?.space(Motion::default())?;
    /// let path = space.path((3, 8), (5, 8))?.expect("there is a way");
    ///
    /// // A wall grows elsewhere, and then a door opens near by.
    /// let grown = space.edit_cells([((0, 0), true)])?;
    /// let mut planner = grown.after().planner(Engine::AStar)?;
    /// assert_eq!(planner.replan(&path, &grown)?, Replanned::Kept);
    /// let opened = grown.after().edit_cells([((4, 7), false)])?;
    /// let mut planner = opened.after().planner(Engine::AStar)?;
    /// assert!(matches!(planner.replan(&path, &opened)?, Replanned::Replaced(new) if new.cost() == 4.0));
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Mismatch`] for a change that leads to another space than the planner's; [`Error::Query`]
    /// where a new path is searched from an end that is blocked or outside the map.
    pub fn replan(&mut self, path: &Path, change: &Change) -> Result<Replanned, Error> {
        let (belongs_to, after) = (self.index().identity(), change.after().identity());
        if belongs_to != after {
            let (prepared, other) = ("the planner", "the space after the change");
            return Err(Mismatch { prepared, belongs_to, other, other_belongs_to: after }.into());
        }
        let holds = change.check(path).is_ok();
        let (Some(start), Some(goal)) = (path.start(), path.goal()) else {
            return Ok(Replanned::Unreachable);
        };
        if holds && path.cost() <= change.least_by_freed(path) {
            return Ok(Replanned::Kept);
        }
        // Where cells have costs, the change may be one of the path's own.
        let cost = match self.index().space().has_costs() {
            true => self.index().space().cost(path).unwrap_or(f64::INFINITY),
            false => path.cost(),
        };
        let new = self.path(start, goal)?;
        Ok(match new {
            Some(new) if !holds || new.cost() < cost * (1.0 - GAIN) => Replanned::Replaced(new),
            None if !holds => Replanned::Unreachable,
            _ => Replanned::Kept,
        })
    }

    /// A path that holds, from one that may not: where it breaks, a new path leads from the last waypoint up
    /// to which it can be followed to its goal. That takes less than a search from the start, but may be
    /// longer than the shortest path. If the path holds, it is the answer.
    ///
    /// There is a path exactly if there is one from start to goal.
    ///
    /// ```
    /// use mediant::{Engine, Map, Motion};
    ///
    /// let space = Map::new(20, 9)?.space(Motion::default())?;
    /// let path = space.path((0, 4), (19, 4))?.expect("there is a way");
    /// let walled = space.edit_cells([((15, 4), true)])?.after().clone();
    /// let mended = walled.planner(Engine::AStar)?.mend(&path)?;
    /// assert!(mended.path().is_some_and(|mended| walled.check(mended).is_ok()));
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// As for [`find`](Self::find) from the start to the goal. A path without waypoints is unreachable.
    pub fn mend(&mut self, path: &Path) -> Result<Answer, QueryError> {
        let held = self.index().space().check(path);
        let (Some(start), Some(goal)) = (path.start(), path.goal()) else {
            return Ok(Answer::Unreachable);
        };
        let Err(broken) = held else {
            let path = self.index().space().measured(path.clone());
            // Where cells have costs, a path at any angle has none.
            return if path.cost().is_finite() {
                Ok(Answer::Found(path))
            } else {
                self.find(PointEnds::new(start, goal))
            };
        };
        let kept = Path::through(path.points().take(broken.holds_up_to()));
        let kept = self.index().space().measured(kept);
        if let Some(from) = kept.goal().filter(|&from| from != start) {
            let rest = self.find(PointEnds::new(from, goal))?;
            let whole = rest.path().and_then(|rest| kept.joined(rest).ok());
            // At a closed gap the two may not meet.
            if let Some(whole) = whole.filter(|whole| self.index().space().check(whole).is_ok()) {
                return Ok(Answer::Found(whole));
            }
        }
        self.find(PointEnds::new(start, goal))
    }
}
