//! Optimal paths by hub labels.

use std::ops::Deref;

use mediant_grid::{Identity, Interrupt, Mismatch, PlacementKind, Point, Vertex};
use mediant_moves::{Cost, FiniteK, K};
use mediant_search::{
    Ends, Guarantee, Observer, Path, Planner, PointEnds, QueryError, SearchStatus,
    parts::{HasFreeSpace, leg_is_free},
};

use super::{
    HubLabels,
    chain::Chains,
    join::{Join, Meeting},
    many::{FINDING, Goals, GoalsError, ToMany, unstopped},
};
use crate::{
    corners::PointSight,
    edge_path::{direct_path, extend, over_bends, over_elbows, sees_between},
    placement::{EdgeCriterion, SubgoalPlacement},
};

/// Optimal paths over N(k), or at any angle, by hub labels: no search is needed.
///
/// If an optimal path of the empty grid is free, it is the answer. Otherwise the labels tell over which
/// subgoals the shortest path leads. Scratch memory: 16 bytes a subgoal.
///
/// `S` and `I` are how the planner holds the free space and its labels: by reference or by `Arc`.
///
/// **Ties.** Of equally short paths it takes the first found: subgoals in the order of their numbers, but
/// those with the least bound first; hubs in the order of the labels. The same query gives the same path each
/// time and on every platform. An observer is told of nothing: there are no nodes, and no steps between which
/// to pause.
#[derive(Debug)]
pub struct HubLabelSearch<S, I> {
    space: S,
    labels: I,
    join: Join,
    waypoints: Vec<Vertex>,
    /// Scratch memory: start, subgoals and goal of the path; and those from the goal to the hub.
    chain: [Vec<Vertex>; 2],
    answer: Option<(Ends, AnswerForm)>,
    /// The last answer between points that are no vertices.
    between: Option<(PointEnds, AnswerForm)>,
    /// Sight of such ends.
    sight: Option<PointSight>,
    to_many: ToMany,
    /// Scratch memory: the goals that are as near as the nearest one, up to rounding.
    as_near: Vec<(u32, Cost)>,
}

/// The form of the last query's answer, from which its path follows.
#[derive(Clone, Copy, Debug)]
enum AnswerForm {
    /// The waypoints are a path that is plain to see.
    Direct,
    /// The path turns over these subgoals.
    Over(Meeting),
}

impl HubLabelSearch<(), ()> {
    /// The scratch memory that a planner on these labels takes when it is made, in bytes.
    #[must_use]
    pub fn scratch_bytes<P: SubgoalPlacement>(labels: &HubLabels<P>) -> usize {
        Join::bytes(labels)
    }
}

impl<S, I, P> HubLabelSearch<S, I>
where
    P: SubgoalPlacement,
    S: Deref<Target: HasFreeSpace<Placement = P>>,
    I: Deref<Target = HubLabels<P>>,
{
    /// A planner with scratch memory for `labels`, which must be those of `space`.
    ///
    /// # Errors
    /// [`Mismatch`] for the labels of another map or other rules than those of `space`, or, if that is a grid
    /// graph, of another k.
    pub fn new(space: S, labels: I) -> Result<Self, Mismatch> {
        labels.check(&*space)?;
        let join = Join::new(&*labels);
        let (waypoints, chain, to_many) = (Vec::new(), [Vec::new(), Vec::new()], ToMany::default());
        let as_near = Vec::new();
        let (answer, between, sight) = (None, None, None);
        Ok(Self { space, labels, join, waypoints, chain, answer, between, sight, to_many, as_near })
    }

    /// Continues in another space, with its labels. The last answer is forgotten, the scratch memory is kept.
    ///
    /// # Errors
    /// As for [`new`](Self::new). Nothing is changed then.
    pub fn follow(&mut self, space: S, labels: I) -> Result<(), Mismatch> {
        labels.check(&*space)?;
        self.join.fit(&*labels);
        (self.answer, self.between, self.sight) = (None, None, None);
        (self.space, self.labels) = (space, labels);
        Ok(())
    }

    /// The cost of a shortest path, without the path; `None` if there is none.
    ///
    /// # Errors
    /// [`QueryError`] when an end of the query is blocked or outside the map.
    pub fn cost(&mut self, query: Ends) -> Result<Option<Cost>, QueryError> {
        let (space, labels) = (self.space.free_space(), &*self.labels);
        if query.ids(space)?.is_none() {
            return Ok(None);
        }
        let Ends { start, goal, .. } = query;
        if start == goal {
            return Ok(Some(Cost::ZERO));
        }
        if direct_path(space, labels.k, start, goal, &mut self.waypoints) {
            return Ok(Some(labels.metric.distance(start.to(goal))));
        }
        Ok(self.meeting(query)?.map(|meeting| meeting.cost))
    }

    /// A shortest path and its cost; `None` if there is none.
    pub(crate) fn solve_with_cost(&mut self, query: Ends) -> Option<(Path, Cost)> {
        self.begin(query, &mut ()).ok()?;
        let cost = match self.answer?.1 {
            AnswerForm::Direct => self.labels.metric.distance(query.start.to(query.goal)),
            AnswerForm::Over(meeting) => meeting.cost,
        };
        Some((self.path_to(query.goal)?, cost))
    }

    /// Writes the cost of a shortest path from a start to each goal, `None` where there is no path. This
    /// takes far less than a query for each.
    ///
    /// # Errors
    /// [`QueryError`] for a start that is blocked or outside the map.
    pub fn distances(
        &mut self,
        start: Vertex,
        goals: &Goals,
        distances: &mut Vec<Option<Cost>>,
    ) -> Result<(), QueryError> {
        unstopped(|never| self.distances_interruptible(start, goals, distances, never))
    }

    /// [`distances`](Self::distances), which an interrupt can stop; it asks at first, and for some thousand
    /// labels of goals.
    ///
    /// # Errors
    /// As for [`distances`](Self::distances), and [`GoalsError::Interrupted`].
    pub fn distances_interruptible(
        &mut self,
        start: Vertex,
        goals: &Goals,
        distances: &mut Vec<Option<Cost>>,
        interrupt: &Interrupt,
    ) -> Result<(), GoalsError> {
        let index = (&*self.labels, self.space.free_space());
        self.to_many.distances(index, &mut self.join, (start, goals), distances, interrupt)
    }

    /// The number of the nearest goal, the first of several, and its distance; `None` if there is no way to
    /// any. At any angle, where costs are rounded, goals that are as near up to rounding are compared by the
    /// exact lengths of their paths.
    ///
    /// # Errors
    /// [`QueryError`] for a start that is blocked or outside the map.
    pub fn nearest(&mut self, start: Vertex, goals: &Goals) -> Result<Option<(usize, Cost)>, QueryError> {
        unstopped(|never| self.nearest_interruptible(start, goals, never))
    }

    /// [`nearest`](Self::nearest), which an interrupt can stop; it asks at first, and for each goal that is
    /// as near as the nearest.
    ///
    /// # Errors
    /// As for [`nearest`](Self::nearest), and [`GoalsError::Interrupted`].
    pub fn nearest_interruptible(
        &mut self,
        start: Vertex,
        goals: &Goals,
        interrupt: &Interrupt,
    ) -> Result<Option<(usize, Cost)>, GoalsError> {
        let index = (&*self.labels, self.space.free_space());
        let nearest = self.to_many.nearest(index, &mut self.join, (start, goals), interrupt)?;
        let Some((_, cost)) = nearest.filter(|_| self.labels.k == K::Any) else { return Ok(nearest) };
        let mut as_near = std::mem::take(&mut self.as_near);
        self.to_many.as_near(index, start, goals, cost, &mut as_near);
        let first = match as_near[..] {
            [(goal, cost)] => Ok(Some((goal, cost))),
            _ => self.first_of(start, goals, &as_near, interrupt),
        };
        self.as_near = as_near;
        Ok(first?.map(|(goal, cost)| (goal as usize, cost)))
    }

    /// The cost by which paths are compared, of the path that is not made.
    fn exact_cost(&mut self, query: Ends) -> Result<Cost, QueryError> {
        self.begin(query, &mut ())?;
        match self.answer.take() {
            None => return Ok(Cost::MAX),
            Some((_, AnswerForm::Direct)) => {}
            Some((query, AnswerForm::Over(meeting))) => {
                if !self.write(query, meeting, self.labels.k) {
                    return Err(QueryError::GaveUp { why: DAMAGED });
                }
            }
        }
        Ok(self.guarantee().cost_along(&self.waypoints))
    }

    /// The first of those goals to which the path is the shortest.
    fn first_of(
        &mut self,
        start: Vertex,
        goals: &Goals,
        as_near: &[(u32, Cost)],
        interrupt: &Interrupt,
    ) -> Result<Option<(u32, Cost)>, GoalsError> {
        let mut best: Option<(Cost, (u32, Cost))> = None;
        for &(goal, cost) in as_near {
            interrupt.check(FINDING)?;
            let at = |goal: u32| goals.vertices()[goal as usize];
            if best.is_some_and(|(_, (first, _))| at(first) == at(goal)) {
                continue;
            }
            let exact = self.exact_cost(Ends::new(start, at(goal)))?;
            if best.is_none_or(|(least, _)| exact < least) {
                best = Some((exact, (goal, cost)));
            }
        }
        Ok(best.map(|(_, first)| first))
    }

    /// Where the shortest path between connected ends turns; `None` if there is no path.
    fn meeting(&mut self, Ends { start, goal, .. }: Ends) -> Result<Option<Meeting>, QueryError> {
        let (space, labels) = (self.space.free_space(), &*self.labels);
        let meeting = self.join.meeting(labels, space, [start, goal]);
        // Cells that touch diagonally are connected, but N(2) may hold no path between them.
        let may_be_none = P::KIND == PlacementKind::Center && labels.k == K::Finite(FiniteK::N4);
        match meeting {
            None if !may_be_none => Err(QueryError::GaveUp { why: DAMAGED }),
            meeting => Ok(meeting),
        }
    }

    /// Writes the path over a meeting point to `waypoints`, by moves of N(k) or by straight segments between
    /// its bends; `false` if the labels are damaged.
    fn write(&mut self, Ends { start, goal, .. }: Ends, meeting: Meeting, k: K) -> bool {
        let Self { space, labels, waypoints, chain, .. } = self;
        let (space, labels) = (space.free_space(), &**labels);
        let is_whole = labels.follow([start, goal], meeting, chain);
        let [way, _] = chain;
        match k {
            K::Finite(k) if labels.criterion == EdgeCriterion::Direct => {
                over_elbows(waypoints, k == FiniteK::N8, way);
            }
            K::Any => over_bends(waypoints, way),
            K::Finite(_) => {
                waypoints.clear();
                way.iter().for_each(|&at| extend(waypoints, space, (k, labels.criterion), at));
            }
        }
        is_whole
    }
}

impl<P: SubgoalPlacement> HubLabels<P> {
    /// Writes start, goal and the subgoals of the path over a meeting point between them to the first list;
    /// the other is scratch memory. Returns `false` if the labels are damaged.
    fn follow(&self, ends: [Vertex; 2], meeting: Meeting, [way, back]: &mut [Vec<Vertex>; 2]) -> bool {
        let chains = Chains::<P>::new(&self.packed, &self.geometry.subgoals, self.k);
        let Some(steps) = chains.first_steps(meeting, |end, at| ends[end].to(at)) else { return false };
        way.clear();
        way.extend([ends[0], steps[0].at()]);
        back.clear();
        back.extend([ends[1], steps[1].at()]);
        let is_whole = chains.visit_both(steps, |at| way.push(at), |at| back.push(at)).is_some();
        // The last is the hub, at which the path is already.
        way.extend(back.iter().rev().skip(1));
        is_whole
    }
}

/// Why a planner gives up.
const DAMAGED: &str = "the hub labels are damaged: prepare them again";

impl<S, I, P> Planner for HubLabelSearch<S, I>
where
    P: SubgoalPlacement,
    S: Deref<Target: HasFreeSpace<Placement = P>>,
    I: Deref<Target = HubLabels<P>>,
{
    fn begin(&mut self, query: Ends, _: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        (self.answer, self.between) = (None, None);
        let (space, labels) = (self.space.free_space(), &*self.labels);
        if query.ids(space)?.is_none() {
            return Ok(SearchStatus::Unreachable);
        }
        let Ends { start, goal, .. } = query;
        let is_direct = if start == goal {
            self.waypoints.clear();
            self.waypoints.push(start);
            true
        } else {
            direct_path(space, labels.k, start, goal, &mut self.waypoints)
        };
        let answer =
            if is_direct { Some(AnswerForm::Direct) } else { self.meeting(query)?.map(AnswerForm::Over) };
        self.answer = answer.map(|answer| (query, answer));
        Ok(if self.answer.is_some() { SearchStatus::Found } else { SearchStatus::Unreachable })
    }

    fn begin_at(
        &mut self,
        ends: PointEnds,
        _: &mut impl Observer,
    ) -> Option<Result<SearchStatus, QueryError>> {
        let Self { space, labels, join, sight, .. } = self;
        let space = P::at_corners(space.free_space()).filter(|_| labels.k == K::Any)?;
        (self.answer, self.between) = (None, None);
        let places = match ends.places(space) {
            Ok(places) => places,
            Err(error) => return Some(Err(error)),
        };
        if !space.points_connected(ends.start, ends.goal) {
            return Some(Ok(SearchStatus::Unreachable));
        }
        let answer = if sees_between(space, ends, places) {
            Some(AnswerForm::Direct)
        } else {
            labels.meeting_between(space, (sight, join), places).map(AnswerForm::Over)
        };
        self.between = answer.map(|answer| (ends, answer));
        Some(self.between.as_ref().map(|_| SearchStatus::Found).ok_or(QueryError::GaveUp { why: DAMAGED }))
    }

    fn proceed(&mut self, _: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        let is_found = self.answer.is_some() || self.between.is_some();
        Ok(if is_found { SearchStatus::Found } else { SearchStatus::Unreachable })
    }

    fn path_to_point(&mut self, at: Point) -> Option<Path> {
        let Some((ends, answer)) = self.between else { return self.path_to(at.vertex()?) };
        if at != ends.goal {
            return (at == ends.start).then(|| Path::through([at]));
        }
        match answer {
            AnswerForm::Direct => Some(Path::straightened([ends.start, ends.goal])),
            AnswerForm::Over(meeting) => {
                let places = ends.places(P::at_corners(self.space.free_space())?).ok()?;
                self.labels.path_between(places, meeting, &mut self.chain)
            }
        }
    }

    fn path_to(&mut self, at: Vertex) -> Option<Path> {
        let (query, answer) = self.answer?;
        if at == query.start {
            return Some(Path::new(vec![at]));
        }
        if at != query.goal {
            return None;
        }
        if let AnswerForm::Over(meeting) = answer
            && !self.write(query, meeting, self.labels.k)
        {
            return None;
        }
        Some(Path::new(self.waypoints.clone()))
    }

    /// The path turns at subgoals, between which the labels follow lines of sight. Where it is one of the
    /// empty grid, start and goal need not see each other. Then the labels know a path of the same cost over
    /// subgoals: of the paths of this cost, the shortest at any angle turns there alone.
    fn bends_to(&mut self, at: Vertex) -> Option<Vec<Vertex>> {
        let (query, answer) = self.answer.filter(|_| self.labels.criterion == EdgeCriterion::Taut)?;
        let Ends { start, goal, .. } = query;
        if at == start {
            return Some(vec![at]);
        }
        if at != goal {
            return None;
        }
        if let AnswerForm::Over(meeting) = answer {
            return self.write(query, meeting, K::Any).then(|| self.waypoints.clone());
        }
        if leg_is_free(self.space.free_space(), None, start, goal, None) {
            return Some(vec![start, goal]);
        }
        let meeting = self.meeting(query).ok()??;
        // The path over N(k) stays what it is.
        let direct = std::mem::take(&mut self.waypoints);
        let is_whole = self.write(query, meeting, K::Any);
        let bends = std::mem::replace(&mut self.waypoints, direct);
        is_whole.then_some(bends)
    }

    fn distance(&mut self, query: Ends) -> Result<Option<f64>, QueryError> {
        Ok(self.cost(query)?.map(Cost::to_f64))
    }

    fn guarantee(&self) -> Guarantee {
        match self.labels.k {
            K::Finite(k) => Guarantee::Optimal(k),
            K::Any => Guarantee::OptimalAnyAngle,
        }
    }

    fn identity(&self) -> Identity {
        self.labels.identity()
    }
}
