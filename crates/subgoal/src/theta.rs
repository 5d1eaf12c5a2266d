//! Theta* over a subgoal graph.

mod descent;
mod search;

use std::ops::Deref;

use mediant_grid::Vertex;
use mediant_moves::Cost;
use mediant_search::{
    Guarantee, HasFreeSpace, Observer, Outcome, Path, Planner, Query, QueryError, SearchTree,
};

use self::{
    descent::Descent,
    search::{Bend, Middles, Search, may_join},
};
use crate::{SubgoalGraph, SubgoalPlacement, planner::push};

/// Sub-Theta* (Uras & Koenig 2015, 'Speeding-up any-angle path-planning on grids'): Theta* over a subgoal graph. On [`Levels`] of 2 it is the
/// Sub2-Theta* with which Hormazábal et al. 2017 compare Sub2-A*(k).
///
/// Rule variant: the search goes from the links of the start up, through the core, and down by what lies above the links of the goal. A
/// successor hangs on what the expanded subgoal hangs on, if a straight segment to it keeps the rules of motion, and else on that subgoal.
/// Closed subgoals stay closed, as in Theta*. Segments cost their Euclidean length; the heuristic is the straight distance.
///
/// A shortcut need not be a legal segment. Where its end does not see what it would hang on, the way goes over the subgoals in the middle, one
/// after another, and bends at those after which the next one does not see the last bend.
///
/// **What holds of the paths.** There is one whenever N(k) has one, since what is reached does not depend on what hangs where, and an optimal
/// path over the graph goes up from the start, through the core, and down. None is shorter than the any-angle optimum; how much longer
/// one may be is not known. On ArcticStation, arena2, brc202d, AR0011SR and 8room_000 (each 20th instance, gaps open) they were longer on the mean
/// by 0.02 to 0.36 % at k = 3 and by 0.003 to 0.02 % at k = 5 on two levels, and by 0.012 % at most on [`Contracted`] graphs, which hold the
/// edges of taut paths.
///
/// **Ties.** The open list's order is that of all engines. Of equally cheap ways to a subgoal the first is kept; the arcs of a subgoal come
/// upward first, in the order of the graph, then downward.
///
/// [`Levels`]: crate::Hierarchy::Levels
/// [`Contracted`]: crate::Hierarchy::Contracted
///
/// ```
/// use std::{num::NonZeroU32, sync::Arc};
/// use mediant_grid::{AsciiMap, Corners, DiagonalGap, FreeSpace};
/// use mediant_moves::FiniteK;
/// use mediant_search::{Planner, Query};
/// use mediant_subgoal::{Hierarchy, SubgoalGraph, SubgoalTheta};
///
/// let map = AsciiMap::parse("
///     ......
///     ...#..
///     ...#..
///     ......
/// ")?;
/// let space = FreeSpace::<Corners>::new(Arc::new(map.grid), DiagonalGap::Open);
/// let levels = Hierarchy::Levels(NonZeroU32::MIN.saturating_add(1));
/// let graph = SubgoalGraph::new(&space, FiniteK::N8, levels)?;
/// let outcome = SubgoalTheta::new(&space, &graph).solve(Query::new((0, 1), (6, 2)))?;
/// let expected = [(0, 1), (4, 1), (6, 2)].map(Into::into);
/// assert_eq!(outcome.path().map(|path| path.waypoints()), Some(&expected[..]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct SubgoalTheta<T, G, P: SubgoalPlacement> {
    space: T,
    graph: G,
    scratch: P::Scratch,
    /// Of the subgoals and, after the last of them, of the goal.
    labels: SearchTree,
    descent: Descent,
    links: Vec<(u32, Cost)>,
    bends: Vec<Bend>,
    middles: Middles,
}

impl<T, G, P> SubgoalTheta<T, G, P>
where
    P: SubgoalPlacement,
    T: Deref<Target: HasFreeSpace<Placement = P>>,
    G: Deref<Target = SubgoalGraph<P>>,
{
    /// A planner with scratch memory for `graph`, which must be that of `space`.
    #[must_use]
    pub fn new(space: T, graph: G) -> Self {
        let count = graph.subgoals();
        Self {
            space,
            graph,
            scratch: P::Scratch::default(),
            labels: SearchTree::new(count + 1),
            descent: Descent::new(count),
            links: Vec::new(),
            bends: Vec::new(),
            middles: Middles::default(),
        }
    }
}

impl<T, G, P> Planner for SubgoalTheta<T, G, P>
where
    P: SubgoalPlacement,
    T: Deref<Target: HasFreeSpace<Placement = P>>,
    G: Deref<Target = SubgoalGraph<P>>,
{
    fn solve_observed(&mut self, query: Query, observer: &mut impl Observer) -> Result<Outcome, QueryError> {
        let Self { space, graph, scratch, labels, descent, links, bends, middles } = self;
        let (space, graph) = (space.free_space(), &**graph);
        if query.ends(space)?.is_none() {
            return Ok(Outcome::Unreachable);
        }
        let Query { start, goal } = query;
        if start == goal {
            return Ok(Outcome::Found(Path::new(vec![start])));
        }
        if may_join(space, start, goal) {
            return Ok(Outcome::Found(Path::new(vec![start, goal])));
        }
        graph.links_of(space, scratch, goal, links);
        descent.start_search(graph, links);
        graph.links_of(space, scratch, start, links);
        let mut search = Search { space, graph, labels, descent, bends, middles, observer, goal };
        let last = search.run(start, links);
        Ok(last.map_or(Outcome::Unreachable, |last| Outcome::Found(path(bends, last, goal))))
    }

    fn guarantee(&self) -> Guarantee {
        Guarantee::Suboptimal
    }
}

/// The path to the goal that bends last at `last`, without waypoints on a straight line between their neighbors.
fn path(bends: &[Bend], last: u32, goal: Vertex) -> Path {
    let back = || Bend::back(bends, last).map(|bend| bend.at);
    let mut waypoints = Vec::with_capacity(back().count() + 1);
    waypoints.push(goal);
    back().for_each(|at| push(&mut waypoints, at));
    waypoints.reverse();
    Path::new(waypoints)
}
