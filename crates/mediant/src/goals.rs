//! From one start to many goals: all distances, or the nearest goal.

use std::{fmt, sync::Arc};

use mediant_grid::{Identity, Interrupt, Point, Vertex};
use mediant_moves::Cost;
use mediant_search::{Answer, End, Limits, Path, PointEnds, Query, Stopped};

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
        interrupt.check("preparing goals")?;
        points.iter().try_for_each(|&at| self.space().check_end(End::Goal, at))?;
        let vertices: Option<Vec<Vertex>> = points.iter().map(|at| at.vertex()).collect();
        let by_hub = match self.labels().zip(vertices) {
            Some((labels, vertices)) => Some(labels.goals(&vertices, interrupt)?),
            None => None,
        };
        Ok(Goals(Arc::new(Inner { identity: self.identity(), points, by_hub })))
    }
}

/// The stage that an interrupted call names.
const FINDING: &str = "finding distances to goals";

impl Planner {
    /// The lengths of the paths from a start to each goal, in cells: infinite where there is no way. With hub
    /// labels they are found together, in far less time than a query for each takes.
    ///
    /// # Errors
    /// [`Error::Mismatch`] for goals of another map, rule or k; [`Error::Query`] for a start that is blocked
    /// or outside the map, and where the engine gives up.
    pub fn distances(&mut self, start: impl Into<Point>, goals: &Goals) -> Result<Vec<f64>, Error> {
        self.distances_of(start.into(), goals, &NEVER)
    }

    pub(crate) fn distances_of(
        &mut self,
        start: Point,
        goals: &Goals,
        interrupt: &Interrupt,
    ) -> Result<Vec<f64>, Error> {
        if let Some((start, by_hub, Asked { search: Some(search), costs })) = self.by_hub(start, goals)? {
            search.distances(start, by_hub, costs, interrupt)?;
            return Ok(costs.iter().map(|cost| cost.map_or(f64::INFINITY, Cost::to_f64)).collect());
        }
        let mut distance = |&goal: &Point| -> Result<f64, Error> {
            interrupt.check(FINDING)?;
            let ends = PointEnds::new(start, goal);
            if interrupt.is_never() {
                return Ok(self.distance(ends)?.unwrap_or(f64::INFINITY));
            }
            let path = self.path_within(ends.into(), interrupt)?;
            Ok(path.map_or(f64::INFINITY, |path| self.guarantee().length(&path)))
        };
        goals.points().iter().map(&mut distance).collect()
    }

    /// The path of a query that an interrupt can stop.
    fn path_within(&mut self, query: Query, interrupt: &Interrupt) -> Result<Option<Path>, Error> {
        match self.find(query.within(Limits::from(interrupt.clone())))? {
            Answer::Stopped(Stopped { by, .. }) => Err(Error::Stopped { by, during: FINDING }),
            answer => Ok(answer.into_path()),
        }
    }

    /// The number of the goal to which the path is the shortest, the first of several, and the length of that
    /// path in cells; `None` if there is no way to any. With hub labels this takes about as long as a query,
    /// also for a thousand goals; and at any angle a query more for each goal whose path is as long up to
    /// rounding.
    ///
    /// # Errors
    /// As for [`distances`](Self::distances).
    pub fn nearest(&mut self, start: impl Into<Point>, goals: &Goals) -> Result<Option<(usize, f64)>, Error> {
        self.nearest_of(start.into(), goals, &NEVER)
    }

    fn nearest_of(
        &mut self,
        start: Point,
        goals: &Goals,
        interrupt: &Interrupt,
    ) -> Result<Option<(usize, f64)>, Error> {
        if let Some((start, by_hub, Asked { search: Some(search), .. })) = self.by_hub(start, goals)? {
            let nearest = search.nearest(start, by_hub, interrupt)?;
            return Ok(nearest.map(|(goal, cost)| (goal, cost.to_f64())));
        }
        if goals.points().is_empty() {
            return Ok(None);
        }
        if self.index().setup().smoothing.is_some() {
            // The nearest by smoothed paths is not always that by the paths of the search.
            let lengths = self.distances_of(start, goals, interrupt)?.into_iter().enumerate();
            return Ok(lengths
                .min_by(|(_, a), (_, b)| a.total_cmp(b))
                .filter(|(_, least)| least.is_finite()));
        }
        let query = Query::between([start], goals.points().iter().copied());
        let found = self.path_within(query, interrupt)?;
        Ok(found.and_then(|path| {
            let end = path.goal()?;
            let length = self.guarantee().length(&path);
            Some((goals.points().iter().position(|&goal| goal == end)?, length))
        }))
    }

    /// This planner, for questions over many goals that stop at a deadline or by a flag.
    pub fn within(&mut self, limits: impl Into<Limits>) -> PlannerWithin<'_> {
        PlannerWithin { planner: self, limits: limits.into() }
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

/// A planner whose questions over many goals stop at a deadline or by a flag, as the work of
/// [`Within`](crate::Within) does: some thousand goals later at most. The limits of one query are its own
/// ([`Query::within`](crate::Query::within)). Those on cost and expansions do not count here.
///
/// ```
/// use mediant::{Engine, ErrorCode, K, Limits, Map, Motion};
///
/// let index = Map::new(40, 30)?.space(Motion::corners(K::ANY))?.prepare(Engine::Subgoal)?;
/// let everywhere = index.goals((0..=40).flat_map(|x| (0..=30).map(move |y| (x, y))))?;
/// let mut planner = index.planner();
/// let late = planner.within(Limits::new().deadline(|| true)).distances((0, 0), &everywhere).unwrap_err();
/// assert_eq!(late.code(), ErrorCode::Stopped);
/// # Ok::<(), mediant::Error>(())
/// ```
#[derive(Debug)]
pub struct PlannerWithin<'p> {
    planner: &'p mut Planner,
    limits: Limits,
}

impl PlannerWithin<'_> {
    /// [`Planner::distances`].
    ///
    /// # Errors
    /// As for [`Planner::distances`], and [`Error::Stopped`].
    pub fn distances(&mut self, start: impl Into<Point>, goals: &Goals) -> Result<Vec<f64>, Error> {
        self.planner.distances_of(start.into(), goals, self.limits.interrupt())
    }

    /// [`Planner::nearest`].
    ///
    /// # Errors
    /// As for [`Planner::nearest`], and [`Error::Stopped`].
    pub fn nearest(&mut self, start: impl Into<Point>, goals: &Goals) -> Result<Option<(usize, f64)>, Error> {
        self.planner.nearest_of(start.into(), goals, self.limits.interrupt())
    }
}
