//! Queries on the present map, answered from an earlier one where that is proven to be right.

use std::sync::Arc;

use mediant_grid::{FreeSpace, Identity, Mismatch, Point, Vertex};
use mediant_moves::{Cost, K};
use mediant_search::{Ends, Guarantee, Observer, Path, Planner, PointEnds, QueryError, SearchStatus};

use super::{EarlierMap, Prepared, bound::WayBound};
use crate::{
    graph::SubgoalGraph,
    labels::{HubLabelSearch, HubLabels},
    placement::SubgoalPlacement,
    planner::SubgoalAStar,
};

/// Optimal paths on a map that has changed since its labels or its graph were made: from these where they
/// still prove the answer, and by another planner on the present map, `other`, where they do not.
///
/// **Ties.** Of equally short paths it takes that of the planner which answers. So the same query may give
/// another path than on labels of the present map, of the same cost. An observer is told of the other
/// planner's searches alone.
pub struct EarlierSearch<P: SubgoalPlacement, F> {
    map: Arc<EarlierMap<P>>,
    search: Search<P>,
    other: F,
    bound: WayBound,
    /// The answer that was proven last.
    answer: Option<(Ends, Path, Cost)>,
    is_proven: bool,
}

type OnLabels<P> = HubLabelSearch<Arc<FreeSpace<P>>, Arc<HubLabels<P>>>;
type OnGraph<P> = SubgoalAStar<Arc<FreeSpace<P>>, Arc<SubgoalGraph<P>>, P>;

/// A planner on the earlier map.
enum Search<P: SubgoalPlacement> {
    Labels(Box<OnLabels<P>>),
    Graph(Box<OnGraph<P>>),
}

impl<P: SubgoalPlacement> Search<P> {
    fn new(map: &EarlierMap<P>) -> Result<Self, Mismatch> {
        let then = Arc::clone(&map.then);
        Ok(match &map.prepared {
            Prepared::Labels(labels) => {
                Self::Labels(Box::new(HubLabelSearch::new(then, Arc::clone(labels))?))
            }
            Prepared::Graph(graph) => Self::Graph(Box::new(SubgoalAStar::new(then, Arc::clone(graph))?)),
        })
    }

    /// A shortest path and its cost on the earlier map.
    fn solve(&mut self, query: Ends) -> Option<(Path, Cost)> {
        match self {
            Self::Labels(search) => search.solve_with_cost(query),
            Self::Graph(search) => {
                let path = search.solve(query).ok()?.into_path()?;
                let cost = search.guarantee().cost_along(path.waypoints());
                Some((path, cost))
            }
        }
    }
}

impl<P: SubgoalPlacement> EarlierMap<P> {
    /// The scratch memory that a planner takes when it is made, in bytes, without that of the other planner.
    #[must_use]
    pub fn scratch_bytes(&self) -> usize {
        match &self.prepared {
            Prepared::Labels(labels) => HubLabelSearch::scratch_bytes(labels),
            Prepared::Graph(graph) => SubgoalAStar::scratch_bytes(graph),
        }
    }
}

impl<P: SubgoalPlacement, F: Planner> EarlierSearch<P, F> {
    /// A planner with scratch memory for the earlier map. `other` must answer on the present map, by optimal
    /// paths of the same k.
    ///
    /// # Errors
    /// [`Mismatch`] for a planner on another map, of other rules or another k.
    pub fn new(map: Arc<EarlierMap<P>>, other: F) -> Result<Self, Mismatch> {
        check(&map, &other)?;
        let search = Search::new(&map)?;
        Ok(Self { map, search, other, bound: WayBound::default(), answer: None, is_proven: false })
    }

    /// Continues on a map that changed again; `follow` takes the other planner there, and says whether it
    /// could. The last answer is forgotten, the scratch memory is kept.
    ///
    /// # Errors
    /// As for [`new`](Self::new), and those of `follow`. Then nothing is changed but the other planner.
    pub fn follow<E: From<Mismatch>>(
        &mut self,
        map: Arc<EarlierMap<P>>,
        follow: impl FnOnce(&mut F) -> Result<(), E>,
    ) -> Result<(), E> {
        follow(&mut self.other)?;
        check(&map, &self.other)?;
        match (&mut self.search, &map.prepared) {
            (Search::Labels(search), Prepared::Labels(labels)) => {
                search.follow(Arc::clone(&map.then), Arc::clone(labels))?;
            }
            (Search::Graph(search), Prepared::Graph(graph)) => {
                search.follow(Arc::clone(&map.then), Arc::clone(graph))?;
            }
            _ => self.search = Search::new(&map)?,
        }
        if self.map.then.grid().id() != map.then.grid().id() {
            self.bound.fit();
        }
        (self.map, self.answer, self.is_proven) = (map, None, false);
        Ok(())
    }

    /// Whether the last query was answered from the earlier map.
    #[must_use]
    pub const fn is_from_earlier(&self) -> bool {
        self.is_proven
    }

    /// The path and the cost, if the earlier map proves them.
    fn proven(&mut self, query: Ends) -> Option<(Path, Cost)> {
        let Self { map, search, bound, .. } = self;
        let EarlierMap { then, now, closed, .. } = &**map;
        let Ends { start, goal, .. } = query;
        let is_unsure = |at: Vertex| !then.is_free(at) || then.is_closed_gap(at) || now.is_closed_gap(at);
        if is_unsure(start) || is_unsure(goal) || !then.connected(start, goal) {
            return None;
        }
        let (path, cost) = search.solve(query)?;
        if !closed.lets_pass(now, &path) {
            return None;
        }
        let is_straight = cost <= map.metric().estimate(start.to(goal));
        (is_straight || bound.is_proven(map, [start, goal], cost)).then_some((path, cost))
    }
}

/// Checks that a planner answers on the present map.
fn check<P: SubgoalPlacement>(map: &EarlierMap<P>, other: &impl Planner) -> Result<(), Mismatch> {
    map.identity().check("the labels of an earlier map", ("the other planner", other.identity()))
}

impl<P: SubgoalPlacement, F: Planner> Planner for EarlierSearch<P, F> {
    fn begin(&mut self, query: Ends, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        (self.answer, self.is_proven) = (None, false);
        if query.ids(&*self.map.now)?.is_none() {
            return Ok(SearchStatus::Unreachable);
        }
        self.answer = self.proven(query).map(|(path, cost)| (query, path, cost));
        self.is_proven = self.answer.is_some();
        if self.is_proven { Ok(SearchStatus::Found) } else { self.other.begin(query, observer) }
    }

    /// By the other planner: of points that are no vertices nothing is proven here.
    fn begin_at(
        &mut self,
        ends: PointEnds,
        observer: &mut impl Observer,
    ) -> Option<Result<SearchStatus, QueryError>> {
        (self.answer, self.is_proven) = (None, false);
        self.other.begin_at(ends, observer)
    }

    fn path_to_point(&mut self, at: Point) -> Option<Path> {
        match self.answer {
            None => self.other.path_to_point(at),
            Some(_) => self.path_to(at.vertex()?),
        }
    }

    fn proceed(&mut self, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        if self.is_proven { Ok(SearchStatus::Found) } else { self.other.proceed(observer) }
    }

    fn path_to(&mut self, at: Vertex) -> Option<Path> {
        match &self.answer {
            Some((query, _, _)) if at == query.start => Some(Path::new(vec![at])),
            Some((query, path, _)) => (at == query.goal).then(|| path.clone()),
            None => self.other.path_to(at),
        }
    }

    fn distance(&mut self, query: Ends) -> Result<Option<f64>, QueryError> {
        match self.begin(query, &mut ())? {
            SearchStatus::Unreachable => Ok(None),
            _ => match &self.answer {
                Some((_, _, cost)) => Ok(Some(cost.to_f64())),
                None => self.other.distance(query),
            },
        }
    }

    fn guarantee(&self) -> Guarantee {
        match self.map.k() {
            K::Finite(k) => Guarantee::Optimal(k),
            K::Any => Guarantee::OptimalAnyAngle,
        }
    }

    fn identity(&self) -> Identity {
        self.map.identity()
    }
}
