//! The search for the answer to a query.

use std::sync::Arc;

use mediant_grid::{Point, Vertex};
use mediant_moves::Cost;

use super::{
    EndSpace, PathCosts, Query,
    end_sets::{Bound, EndSets, Pair},
    limits::{Limit, Stopped},
    watch::{Pause, Progress, Watch},
};
use crate::{
    answer::Answer,
    guarantee::Guarantee,
    limit::UNIT,
    metric::Metric,
    observer::Observer,
    path::Path,
    planner::{Planner, SearchStatus},
    query::QueryError,
};

/// The search for the answer to a [`Query`], by any planner, at once or in steps.
///
/// Several starts and goals are pairs, which are searched one after another, in the order of the distance
/// that no path between them can be shorter than; until that is more than the cost of the best path found. A
/// pair's search ends where its paths become longer than that.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Centers, CornerRule, GridGraph};
/// use mediant_moves::FiniteK;
/// use mediant_search::{AStar, Answer, Hk, Planner, Query, Search, parts::Metric};
///
/// let map = AsciiMap::parse("
///     ...#.
///     ...#.
/// ")?;
/// let graph = GridGraph::<Centers>::new(Arc::new(map.grid), FiniteK::N8, CornerRule::Never)?;
/// let (mut planner, metric) = (AStar::new(&graph, Hk), Metric::new(FiniteK::N8.into())?);
/// let query = Query::new((0, 0), (4, 1)).nearest();
/// let mut search = Search::new(&graph, metric, planner.guarantee(), query)?;
/// let answer = loop {
///     if let Some(answer) = search.step(&mut planner, 1, &mut ())? {
///         break answer;
///     }
/// };
/// assert!(matches!(answer, Answer::Nearest(path) if path.waypoints().last() == Some(&(2, 1).into())));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Search {
    ends: EndSets,
    metric: Metric,
    guarantee: Guarantee,
    /// On a cost surface.
    costs: Option<Arc<dyn PathCosts>>,
    /// The pair that is searched, and whether the planner has begun with it.
    next: usize,
    has_begun: bool,
    /// The only start, while it is searched from all goals at once.
    backward: Backward,
    progress: Progress,
    found: Option<Found>,
    /// Whether the bends of the path that was found are kept, and these.
    keeps_bends: bool,
    bends: Option<Vec<Vertex>>,
    /// Of the pairs whose search met the limit on the cost: the path to the vertex nearest to its goal, with
    /// its distance.
    partial: Option<(Cost, Path)>,
    /// The least lower bound of those pairs.
    beyond_limit: Option<Cost>,
    /// The answer, or why the planner gave up.
    answer: Option<Result<Answer, QueryError>>,
}

/// The state of a search from all goals at once to the only start: for a goal with a tolerance it replaces
/// one search for each vertex near the goal. It does not tell which of several equally near goals comes
/// first, so it is not for the vertices nearest to a goal that cannot be reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Backward {
    No,
    /// Once so many pairs were searched forward, if the planner can.
    After(usize, Vertex),
    To(Vertex),
}

/// The best path that was found.
#[derive(Debug)]
struct Found {
    cost: Cost,
    rank: (u32, u32),
    path: Path,
}

impl Search {
    /// A search that has not begun. `metric` is that of the planner's k, `guarantee` the planner's, and
    /// `space` is its free space: it says which ends are connected. For a planner of any-angle paths over
    /// N(2) take [`FreeSpace::new`](mediant_grid::FreeSpace::new), since segments can connect more than N(2)
    /// does.
    ///
    /// # Errors
    /// [`QueryError`] for ends that are missing, blocked or outside the map, unless the query says what to
    /// do then, and for limits and tolerances that are no numbers, or less than 0.
    pub fn new(
        space: &impl EndSpace,
        metric: Metric,
        guarantee: Guarantee,
        query: Query,
    ) -> Result<Self, QueryError> {
        let bound = if let Guarantee::Optimal(_) = guarantee { metric } else { Metric::Euclidean };
        Self::with_bound(space, (metric, &|v| bound.estimate(v)), (guarantee, None), query)
    }

    /// The same for a planner of paths on a cost surface. What is near stays a matter of lengths: the nearest
    /// vertex, the tolerance, the ends that are moved. `metric` measures them.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub fn on_costs(
        space: &impl EndSpace,
        metric: Metric,
        (guarantee, costs): (Guarantee, Arc<dyn PathCosts>),
        query: Query,
    ) -> Result<Self, QueryError> {
        let bound = Arc::clone(&costs);
        let least = |v| if guarantee.is_optimal() { bound.least(v) } else { bound.least_at_any_angle(v) };
        Self::with_bound(space, (metric, &least), (guarantee, Some(costs)), query)
    }

    fn with_bound(
        space: &impl EndSpace,
        (metric, bound): (Metric, &Bound<'_>),
        (guarantee, costs): (Guarantee, Option<Arc<dyn PathCosts>>),
        query: Query,
    ) -> Result<Self, QueryError> {
        let wishes = query.into_wishes();
        let ends = EndSets::new(space, metric, bound, &wishes)?;
        // A search that may be stopped leads forward to one of the goals first, since only then the best so
        // far begins at the start.
        let backward = match ends.only_start() {
            Some(start) if wishes.tolerance > 0.0 && !ends.are_nearest => {
                Backward::After(usize::from(!wishes.limits.are_none()), start)
            }
            _ => Backward::No,
        };
        let progress = Progress {
            greatest: wishes.limits.greatest_cost(costs.as_ref().map_or(UNIT, |costs| costs.unit())),
            limits: wishes.limits,
            expansions: 0,
            next_look: 0,
            pairs: 0,
            step_end: 0,
            is_step: false,
            known: Cost::MAX,
            least: Cost::ZERO,
            pause: None,
            goal: Point::from_parts(0, 0),
            nearest: (Cost::MAX, Point::from_parts(0, 0)),
        };
        Ok(Self {
            answer: ends.pairs.is_empty().then_some(Ok(Answer::Unreachable)),
            ends,
            metric,
            guarantee,
            costs,
            next: 0,
            has_begun: false,
            backward,
            progress,
            found: None,
            keeps_bends: false,
            bends: None,
            partial: None,
            beyond_limit: None,
        })
    }

    /// Asks the planner for the [bends](Planner::bends_to) of each path that it finds, too.
    #[must_use]
    pub fn keeping_bends(self) -> Self {
        Self { keeps_bends: true, ..self }
    }

    /// The [bends](Planner::bends_to) of the [best path](Self::best), if it leads to a goal, the planner
    /// knows them, and they are [kept](Self::keeping_bends).
    #[must_use]
    pub fn bends(&self) -> Option<&[Vertex]> {
        self.bends.as_deref()
    }

    /// Makes at most `expansions` expansions; fewer if the observer pauses the search. Returns the answer
    /// once it is there; `None` before. All steps must be made on the same planner, which answers nothing
    /// else in between.
    ///
    /// # Errors
    /// [`QueryError::GaveUp`] by a planner that may fail.
    pub fn step(
        &mut self,
        planner: &mut impl Planner,
        expansions: u64,
        observer: &mut impl Observer,
    ) -> Result<Option<Answer>, QueryError> {
        self.progress.step_end = self.progress.expansions.saturating_add(expansions);
        self.progress.is_step = true;
        self.run(planner, observer)
    }

    /// Continues until the answer is there. The observer is not asked to pause.
    ///
    /// # Errors
    /// As for [`step`](Self::step).
    pub fn finish(
        &mut self,
        planner: &mut impl Planner,
        observer: &mut impl Observer,
    ) -> Result<Answer, QueryError> {
        (self.progress.step_end, self.progress.is_step) = (u64::MAX, false);
        loop {
            if let Some(answer) = self.run(planner, observer)? {
                return Ok(answer);
            }
        }
    }

    /// Searches until the answer is there, or the step is over.
    fn run(
        &mut self,
        planner: &mut impl Planner,
        observer: &mut impl Observer,
    ) -> Result<Option<Answer>, QueryError> {
        while self.answer.is_none() {
            let Some(&pair) = self.pair() else {
                self.conclude();
                break;
            };
            let status = match self.search(pair, planner, observer) {
                Ok(status) => status,
                Err(error) => {
                    self.answer = Some(Err(error));
                    break;
                }
            };
            match (status, self.progress.pause.take()) {
                (SearchStatus::Searching, None | Some(Pause::Step)) => return Ok(None),
                (SearchStatus::Searching, Some(Pause::Limit(Limit::Cost))) => {
                    self.leave_beyond_limit(self.current_bound(pair), planner);
                }
                (SearchStatus::Searching, Some(Pause::Limit(limit))) => self.stop(limit, planner),
                (SearchStatus::Searching, Some(Pause::Beaten)) | (SearchStatus::Unreachable, _) => {
                    self.leave();
                }
                (SearchStatus::Found, _) => self.found(pair, planner),
            }
        }
        self.answer.clone().transpose()
    }

    /// The pair to be searched, if the best path may lead between its ends.
    fn pair(&self) -> Option<&Pair> {
        self.ends.pairs.get(self.next).filter(|pair| !self.progress.is_beaten(pair.least))
    }

    /// Begins or continues the search of a pair.
    fn search(
        &mut self,
        pair: Pair,
        planner: &mut impl Planner,
        observer: &mut impl Observer,
    ) -> Result<SearchStatus, QueryError> {
        if !self.has_begun {
            let Pair { ends, least, .. } = pair;
            self.progress.goal = ends.goal;
            self.progress.nearest = (self.metric.between(ends.start, ends.goal), ends.start);
            self.progress.least = least;
            self.progress.begin_pair();
            self.progress.pause = self.progress.reason();
            // The number of expansions does not forbid a path that takes none.
            let waits = |pause| !matches!(pause, Pause::Step | Pause::Limit(Limit::Expansions));
            if self.progress.pause.is_some_and(waits) {
                return Ok(SearchStatus::Searching);
            }
        }
        let mut watch = Watch { progress: &mut self.progress, metric: self.metric, observer };
        if let Backward::After(pairs, start) = self.backward
            && self.next == pairs
            && !self.has_begun
        {
            let goals = self.ends.pairs.iter().filter_map(|pair| pair.ends.goal.vertex());
            let goals: Vec<Vertex> = goals.collect();
            let status = planner.begin_from(&goals, start, &mut watch);
            self.backward = status.map_or(Backward::No, |_| Backward::To(start));
            self.has_begun = status.is_some();
        }
        if !self.has_begun {
            let status = match pair.ends.vertices() {
                Some(ends) => planner.begin(ends, &mut watch)?,
                None => planner.begin_at(pair.ends, &mut watch).ok_or_else(|| pair.ends.between())??,
            };
            self.has_begun = true;
            if status != SearchStatus::Searching {
                return Ok(status);
            }
        }
        planner.proceed(&mut watch)
    }

    /// Whether it leads from all goals to the start.
    const fn is_backward(&self) -> bool {
        matches!(self.backward, Backward::To(_))
    }

    /// Goes on to the next pair.
    const fn leave(&mut self) {
        self.next = if self.is_backward() { self.ends.pairs.len() } else { self.next + 1 };
        self.has_begun = false;
    }

    fn found(&mut self, pair: Pair, planner: &mut impl Planner) {
        let path = match self.backward {
            Backward::To(start) => planner.path_to(start).map(|path| path.reversed()),
            Backward::No | Backward::After(..) => planner.path_to_point(pair.ends.goal),
        };
        if let Some(path) = path {
            let cost = match &self.costs {
                Some(costs) => costs.cost(&path),
                None => self.guarantee.cost(&path),
            };
            if cost > self.progress.greatest {
                // No search asks for a pause before it takes the goal: the path itself may be the first to
                // cost more than the limit.
                let least = if self.guarantee.is_optimal() { cost } else { pair.least };
                return self.leave_beyond_limit(least, planner);
            }
            let is_better = |known: &Found| (cost, pair.rank) < (known.cost, known.rank);
            if self.found.as_ref().is_none_or(is_better) {
                self.progress.known = cost;
                let knows = self.keeps_bends && !self.is_backward();
                let goal = pair.ends.vertices().filter(|_| knows).map(|ends| ends.goal);
                self.bends = goal.and_then(|goal| planner.bends_to(goal));
                self.found = Some(Found { cost, rank: pair.rank, path });
            }
        }
        self.leave();
    }

    /// Leaves a pair whose paths cost more than the limit, and at least `least`.
    fn leave_beyond_limit(&mut self, least: Cost, planner: &mut impl Planner) {
        self.beyond_limit = Some(self.beyond_limit.map_or(least, |known| known.min(least)));
        let distance = self.progress.nearest.0;
        if !self.is_backward() && self.partial.as_ref().is_none_or(|&(known, _)| distance < known) {
            self.partial = Some((distance, self.path_to_nearest(planner)));
        }
        self.leave();
    }

    /// The path to the vertex nearest to the goal.
    fn path_to_nearest(&self, planner: &mut impl Planner) -> Path {
        let start = self.ends.pairs.get(self.next).map_or(self.ends.start, |pair| pair.ends.start);
        let nearest = self.progress.nearest.1.vertex();
        nearest.and_then(|at| self.path_to(planner, at)).unwrap_or_else(|| Path::through([start]))
    }

    fn stop(&mut self, by: Limit, planner: &mut impl Planner) {
        let (lower_bound, best) = (self.lower_bound(), self.best(planner));
        self.answer = Some(Ok(Answer::Stopped(Stopped { by, best, lower_bound })));
    }

    /// Makes the answer after the last pair.
    fn conclude(&mut self) {
        let lower_bound = self.lower_bound();
        self.answer = Some(Ok(match (self.found.take(), self.partial.take()) {
            (Some(Found { path, .. }), _) if self.ends.are_nearest => Answer::Nearest(path),
            (Some(Found { path, .. }), _) => Answer::Found(path),
            (None, Some((_, best))) => Answer::Stopped(Stopped { by: Limit::Cost, best, lower_bound }),
            (None, None) => Answer::Unreachable,
        }));
    }

    /// The best so far; see [`Stopped::best`].
    #[must_use]
    pub fn best(&self, planner: &mut impl Planner) -> Path {
        match &self.answer {
            Some(Ok(Answer::Found(path) | Answer::Nearest(path))) => return path.clone(),
            Some(Ok(Answer::Stopped(stopped))) => return stopped.best.clone(),
            Some(Ok(Answer::Unreachable) | Err(_)) | None => {}
        }
        match (&self.found, &self.partial) {
            (Some(found), _) => found.path.clone(),
            (None, Some((distance, path))) if *distance <= self.progress.nearest.0 || self.is_backward() => {
                path.clone()
            }
            (None, _) => self.path_to_nearest(planner),
        }
    }

    /// The best path that the search of the present pair has found to a vertex: see
    /// [`Planner::path_to`]. `None` before the first step, and while one search leads from all goals to the
    /// start.
    #[must_use]
    pub fn path_to(&self, planner: &mut impl Planner, at: Vertex) -> Option<Path> {
        if self.has_begun && !self.is_backward() { planner.path_to(at) } else { None }
    }

    /// A lower bound on the cost of the answer, in cells or in the unit of the cost surface; see
    /// [`Stopped::lower_bound`].
    #[must_use]
    pub fn lower_bound(&self) -> f64 {
        /// Costs are rounded sums.
        const ROUNDED: f64 = 1.0 - 1.0 / (1_u64 << 31) as f64;
        let pairs = &self.ends.pairs;
        let least = if self.guarantee.is_optimal() {
            let current = self.pair().map(|&pair| self.current_bound(pair));
            let later = pairs.get(self.next + 1).map(|pair| pair.least);
            // Once there is an answer, it has taken the path that was found, but not its cost.
            let found = Some(self.progress.known).filter(|&known| known != Cost::MAX);
            [current, later, found, self.beyond_limit].into_iter().flatten().min()
        } else {
            pairs.first().map(|pair| pair.least)
        };
        let unit = self.costs.as_ref().map_or(UNIT, |costs| costs.unit());
        least.map_or(0.0, |least| least.to_bits() as f64 * unit * ROUNDED)
    }

    /// A lower bound on the paths of the pair that is searched.
    fn current_bound(&self, pair: Pair) -> Cost {
        let is_known = self.guarantee.is_optimal() && self.has_begun;
        if is_known { self.progress.least.max(pair.least) } else { pair.least }
    }

    /// The number of expansions so far.
    #[must_use]
    pub const fn expansions(&self) -> u64 {
        self.progress.expansions
    }
}
