//! Theta* over a subgoal graph.

mod descent;
mod search;

use std::ops::Deref;

use mediant_grid::{Identity, Mismatch, Vertex};
use mediant_moves::Cost;
use mediant_search::{
    Ends, Guarantee, Observer, Path, Planner, QueryError, SearchStatus,
    parts::{HasFreeSpace, SearchTree, push_waypoint},
};

use self::{
    descent::Descent,
    search::{SubgoalThetaSearch, Unpacking, Waypoint, may_join},
};
use crate::{arc::NONE, graph::SubgoalGraph, placement::SubgoalPlacement};

/// Sub-Theta* (Uras & Koenig 2015, 'Speeding-up any-angle path-planning on grids'): Theta* over a subgoal
/// graph. On [`Levels`] of 2 it is the Sub2-Theta* with which Hormazábal et al. 2017 compare Sub2-A*(k).
///
/// Rule variant: the search goes up from the subgoals joined to the start, through the core, and down to the
/// subgoals joined to the goal. The parent of a successor is the parent of the expanded subgoal, if a
/// straight segment from there keeps the rules of motion, and otherwise the expanded subgoal. Closed subgoals
/// stay closed, as in Theta*. Segments cost their Euclidean length; the heuristic is the straight-line
/// distance.
///
/// A shortcut need not be a legal segment. If its end does not see the parent, the path follows the subgoals
/// that the shortcut passes. It bends at one of them if the next does not see the last bend.
///
/// `S` and `I` are how the planner holds the free space and its subgoal graph: by reference or by `Arc`.
///
/// **Guarantees.** A path is found whenever N(k) has one: which subgoals are reached does not depend on
/// parents, and an optimal path over the graph goes up from the start, through the core, and down. No path is
/// shorter than the any-angle optimum; how much longer one can be is not known. Measured excess:
/// `docs/measurements/subgoal.md`.
///
/// **Ties.** The open list has the order of all engines. Of equally cheap paths to a subgoal the first is
/// kept; the arcs of a subgoal are followed upward first, in the order of the graph, then downward.
///
/// [`Levels`]: crate::Hierarchy::Levels
/// [`Contracted`]: crate::Hierarchy::Contracted
///
/// ```
/// use std::{num::NonZeroU32, sync::Arc};
/// use mediant_grid::{AsciiMap, Corners, DiagonalGap, FreeSpace};
/// use mediant_moves::FiniteK;
/// use mediant_search::{Ends, Planner};
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
/// let answer = SubgoalTheta::new(&space, &graph)?.solve(Ends::new((0, 1), (6, 2)))?;
/// let expected = [(0, 1), (4, 1), (6, 2)].map(Into::into);
/// assert_eq!(answer.path().map(|path| path.waypoints()), Some(&expected[..]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct SubgoalTheta<S, I, P: SubgoalPlacement> {
    space: S,
    graph: I,
    scratch: P::Scratch,
    /// Its nodes are the subgoals and, after the last of them, the goal.
    tree: SearchTree,
    descent: Descent,
    query_edges: Vec<(u32, Cost)>,
    bends: Vec<Waypoint>,
    unpacking: Unpacking,
    query: Option<Ends>,
    status: SearchStatus,
    /// Where the path to the goal bends last, once it is found; [`NONE`] for a straight one.
    last: Option<u32>,
}

impl<P: SubgoalPlacement> SubgoalTheta<(), (), P> {
    /// The scratch memory that a planner on this graph takes when it is made, in bytes.
    #[must_use]
    pub fn scratch_bytes(graph: &SubgoalGraph<P>) -> usize {
        let count = graph.subgoals();
        SearchTree::<()>::bytes(count + 1).saturating_add(Descent::bytes(count))
    }
}

impl<S, I, P> SubgoalTheta<S, I, P>
where
    P: SubgoalPlacement,
    S: Deref<Target: HasFreeSpace<Placement = P>>,
    I: Deref<Target = SubgoalGraph<P>>,
{
    /// A planner with scratch memory for `graph`, which must be that of `space`.
    ///
    /// # Errors
    /// [`Mismatch`] for the graph of another map or other rules than those of `space`, or, if that is a grid
    /// graph, of another k.
    pub fn new(space: S, graph: I) -> Result<Self, Mismatch> {
        graph.check(&*space)?;
        let count = graph.subgoals();
        Ok(Self {
            space,
            graph,
            scratch: P::Scratch::default(),
            tree: SearchTree::new(count + 1),
            descent: Descent::new(count),
            query_edges: Vec::new(),
            bends: Vec::new(),
            unpacking: Unpacking::default(),
            query: None,
            status: SearchStatus::default(),
            last: None,
        })
    }

    /// Continues in another space, on its subgoal graph. The search that was begun last is forgotten. The
    /// scratch memory is kept if it has room for the subgoals.
    ///
    /// # Errors
    /// As for [`new`](Self::new). Nothing is changed then.
    pub fn follow(&mut self, space: S, graph: I) -> Result<(), Mismatch> {
        graph.check(&*space)?;
        let count = graph.subgoals();
        self.tree.fit(count + 1);
        self.descent.fit(count);
        (self.query, self.last, self.status) = (None, None, SearchStatus::default());
        (self.space, self.graph) = (space, graph);
        Ok(())
    }
}

impl<S, I, P> Planner for SubgoalTheta<S, I, P>
where
    P: SubgoalPlacement,
    S: Deref<Target: HasFreeSpace<Placement = P>>,
    I: Deref<Target = SubgoalGraph<P>>,
{
    fn begin(&mut self, query: Ends, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        (self.query, self.last, self.status) = (None, None, SearchStatus::Unreachable);
        let Self { space, graph, scratch, tree, descent, query_edges, bends, unpacking, .. } = self;
        let (space, graph) = (space.free_space(), &**graph);
        if query.ids(space)?.is_none() {
            return Ok(self.status);
        }
        let Ends { start, goal, .. } = query;
        self.query = Some(query);
        if start == goal || may_join(space, start, goal) {
            (self.last, self.status) = (Some(NONE), SearchStatus::Found);
            return Ok(self.status);
        }
        graph.query_edges(space, scratch, goal, query_edges);
        descent.start_search(graph, query_edges);
        graph.query_edges(space, scratch, start, query_edges);
        SubgoalThetaSearch { space, graph, tree, descent, bends, unpacking, observer, goal }
            .begin(start, query_edges);
        self.status = SearchStatus::Searching;
        Ok(self.status)
    }

    fn proceed(&mut self, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        if let (Some(Ends { goal, .. }), SearchStatus::Searching) = (self.query, self.status) {
            let Self { space, graph, tree, descent, bends, unpacking, last, .. } = self;
            let (space, graph) = (space.free_space(), &**graph);
            let mut search =
                SubgoalThetaSearch { space, graph, tree, descent, bends, unpacking, observer, goal };
            self.status = search.run(last);
        }
        Ok(self.status)
    }

    fn path_to(&mut self, at: Vertex) -> Option<Path> {
        let Ends { start, goal, .. } = self.query?;
        if at == start {
            return Some(Path::new(vec![start]));
        }
        match self.last.filter(|_| at == goal) {
            Some(NONE) => Some(Path::new(vec![start, goal])),
            Some(last) => Some(path(&self.bends, last, goal)),
            None => {
                let id = self
                    .graph
                    .subgoals
                    .id(at)
                    .filter(|&id| self.last != Some(NONE) && self.tree.is_closed(id))?;
                let (last, ()) = self.tree.parent(id)?;
                Some(path(&self.bends, last, at))
            }
        }
    }

    fn guarantee(&self) -> Guarantee {
        Guarantee::Suboptimal
    }

    fn identity(&self) -> Identity {
        self.graph.identity()
    }
}

/// The path to the goal whose last bend is `last`, without waypoints at which it goes straight on.
fn path(bends: &[Waypoint], last: u32, goal: Vertex) -> Path {
    let back = || Waypoint::back(bends, last).map(|waypoint| waypoint.at);
    let mut waypoints = Vec::with_capacity(back().count() + 1);
    waypoints.push(goal);
    back().for_each(|at| push_waypoint(&mut waypoints, at));
    waypoints.reverse();
    Path::new(waypoints)
}
