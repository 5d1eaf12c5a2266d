//! From one start to many goals: all distances, or the nearest goal.

use std::{fmt, sync::Arc};

use mediant_grid::{Identity, Interrupt, Point, Vertex};
use mediant_moves::Cost;
use mediant_search::{End, PointEnds, Query};

use crate::{
    error::Error,
    index::Index,
    labeled::{Asked, HasLabels},
    never::NEVER,
    planner::Planner,
};

/// Goals that many starts ask for, prepared for the indexes of one map, rules and k: made by
/// [`Index::goals`], asked by [`Planner::distances`] and [`Planner::nearest`]. Clones share them, and all
/// threads may use them.
///
/// ```
/// use mediant::{Engine, K, Map, Motion};
///
/// let space = Map::from_fn(9, 9, |x, y| x == 4 && y != 8)?.space(Motion::corners(K::ANY))?;
/// let index = space.prepare(Engine::Subgoal)?;
/// let hotels = index.goals([(9, 0), (0, 9), (3, 4)])?;
/// let mut planner = index.planner();
/// assert_eq!(planner.nearest((0, 0), &hotels)?, Some((2, 5.0)));
/// assert_eq!(planner.distances((0, 0), &hotels)?[1..], [9.0, 5.0]);
/// # Ok::<(), mediant::Error>(())
/// ```
#[derive(Clone)]
pub struct Goals(Arc<Inner>);

struct Inner {
    identity: Identity,
    points: Vec<Point>,
    /// By hub, if the index has hub labels.
    by_hub: Option<mediant_subgoal::Goals>,
}

impl Goals {
    /// The goals, in the order in which they were given.
    #[must_use]
    pub fn points(&self) -> &[Point] {
        &self.0.points
    }

    /// The identity: the map, rules and k of their index.
    #[must_use]
    pub fn identity(&self) -> Identity {
        self.0.identity
    }
}

impl fmt::Debug for Goals {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Inner { identity, points, by_hub } = &*self.0;
        let mut fields = f.debug_struct("Goals");
        fields.field("identity", identity).field("goals", &points.len());
        fields.field("by_hub", &by_hub.is_some()).finish()
    }
}

impl Index {
    /// Prepares goals for its planners. With hub labels this takes about two queries for each goal, and each
    /// start then far less than a query for each goal; with other indexes, and if the start or a goal is no
    /// vertex of the labels, a start takes a query for each goal.
    ///
    /// # Errors
    /// [`Error::Query`] for the first goal that is blocked or outside the map.
    pub fn goals<G: Into<Point>>(&self, goals: impl IntoIterator<Item = G>) -> Result<Goals, Error> {
        self.goals_of(goals.into_iter().map(Into::into).collect(), &NEVER)
    }

    pub(crate) fn goals_of(&self, points: Vec<Point>, interrupt: &Interrupt) -> Result<Goals, Error> {
        points.iter().try_for_each(|&at| self.space().check_end(End::Goal, at))?;
        // A stopped loop leaves goals out; the error after it says so.
        let mut going = Ok(());
        let vertices: Option<Vec<Vertex>> = points.iter().map(|at| at.vertex()).collect();
        let all = vertices.iter().flatten().copied().take_while(|_| {
            going = interrupt.check("preparing goals");
            going.is_ok()
        });
        let by_hub = match self.labels().filter(|_| vertices.is_some()) {
            Some(labels) => Some(labels.goals(&mut { all })?),
            None => None,
        };
        going?;
        Ok(Goals(Arc::new(Inner { identity: self.identity(), points, by_hub })))
    }
}

impl Planner {
    /// The lengths of the paths from a start to each goal, in cells: infinite where there is no way. With hub
    /// labels they are found together, in far less time than a query for each takes.
    ///
    /// # Errors
    /// [`Error::Mismatch`] for goals of another map, rule or k; [`Error::Query`] for a start that is blocked
    /// or outside the map, and where the engine gives up.
    pub fn distances(&mut self, start: impl Into<Point>, goals: &Goals) -> Result<Vec<f64>, Error> {
        let start = start.into();
        if let Some((start, by_hub, Asked { search: Some(search), costs })) = self.by_hub(start, goals)? {
            search.distances(start, by_hub, costs)?;
            return Ok(costs.iter().map(|cost| cost.map_or(f64::INFINITY, Cost::to_f64)).collect());
        }
        let mut distance = |&goal: &Point| -> Result<f64, Error> {
            Ok(self.distance(PointEnds::new(start, goal))?.unwrap_or(f64::INFINITY))
        };
        goals.points().iter().map(&mut distance).collect()
    }

    /// The number of the goal to which the path is the shortest, the first of several, and the length of that
    /// path in cells; `None` if there is no way to any. With hub labels this takes one to two queries, also
    /// for a thousand goals; and at any angle a query more for each goal whose path is as long up to
    /// rounding.
    ///
    /// # Errors
    /// As for [`distances`](Self::distances).
    pub fn nearest(&mut self, start: impl Into<Point>, goals: &Goals) -> Result<Option<(usize, f64)>, Error> {
        let start = start.into();
        if let Some((start, by_hub, Asked { search: Some(search), .. })) = self.by_hub(start, goals)? {
            let nearest = search.nearest(start, by_hub)?;
            return Ok(nearest.map(|(goal, cost)| (goal, cost.to_f64())));
        }
        if goals.points().is_empty() {
            return Ok(None);
        }
        if self.index().setup().smoothing.is_some() {
            // The nearest by smoothed paths is not always that by the paths of the search.
            let lengths = self.distances(start, goals)?.into_iter().enumerate();
            return Ok(lengths
                .min_by(|(_, a), (_, b)| a.total_cmp(b))
                .filter(|(_, least)| least.is_finite()));
        }
        let found = self.find(Query::between([start], goals.points().iter().copied()))?.into_path();
        Ok(found.and_then(|path| {
            let end = path.goal()?;
            let length = self.guarantee().length(&path);
            Some((goals.points().iter().position(|&goal| goal == end)?, length))
        }))
    }

    /// The start and the goals by hub, and what asks for them; `None` where that is not what the planner's
    /// paths measure.
    fn by_hub<'g>(
        &mut self,
        start: Point,
        goals: &'g Goals,
    ) -> Result<Option<(Vertex, &'g mediant_subgoal::Goals, &mut Asked)>, Error> {
        let index = self.index();
        index.identity().check("the index", ("the goals", goals.identity()))?;
        index.space().check_end(End::Start, start)?;
        let by_hub = goals.0.by_hub.as_ref().filter(|_| index.setup().smoothing.is_none());
        let Some((by_hub, start)) = by_hub.zip(start.vertex()) else { return Ok(None) };
        if self.asked.search.is_none() {
            self.asked.search = self.index().labels().map(HasLabels::to_goals).transpose()?;
        }
        Ok(Some((start, by_hub, &mut self.asked)))
    }
}
