//! Theta* (Daniel, Nash, Koenig & Felner 2010, 'Theta*: Any-Angle Path Planning on Grids') and Lazy Theta* (Nash, Koenig & Tovey
//! 2010, 'Lazy Theta*: Any-Angle Path Planning and Path Length Analysis in 3D') over N(k), for every k, both placements and all rules of
//! motion. (The papers have k = 3, at corners, gaps open.)
//!
//! Rule variant: a vertex is expanded with all its legal moves. A successor hangs on the parent of the expanded node, by a straight segment,
//! if that keeps the rules of motion, and else on the node itself. Under closed gaps this asks for the turn at the parent too, and at
//! the goal.
//!
//! **Closed nodes stay closed**, as in the papers, though a cheaper way to one may turn up: paths at an angle are shorter than
//! h_k. To open them again pays little (k = 3, corners, gaps open; each 40th instance of the maps ArcticStation, arena2, random512-10-0,
//! 8room_000 and AR0011SR):
//!
//! | reopening | expansions | path lengths |
//! |---|--:|--:|
//! | Theta*, h_k | × 3.0 to 4.5 | −0.1 to −1.6 % |
//! | Theta*, Euclidean | × 1.0 to 1.5 | −0.03 to −0.15 % |
//! | Lazy Theta*, h_k | × 1.9 to 10 | −0.03 to −0.8 % |
//! | Lazy Theta*, Euclidean | × 1.1 to 1.5 | −0.03 to −0.35 % |
//!
//! **What holds of the paths.** There is one whenever N(k) has one, since what is reached does not depend on what hangs where. None is
//! shorter than the any-angle optimum. With a consistent heuristic, as all of this crate are, one of Theta* is no longer than the optimum over
//! N(k): on an optimal path over N(k) let m be the first vertex that is not closed when s is expanded; its predecessor was closed
//! with no more than its optimal cost, so m has no more either (triangle inequality), and f(s) ≤ f(m) says the same of s. Of Lazy Theta* this is
//! not true: s may be expanded while its best neighbor is open. (In a random suite 51 of 13,698 paths were longer, by a quarter at most.)
//!
//! **Ties.** The open list's order is that of all engines. Of equally cheap ways to a vertex the first is kept, successors and closed neighbors
//! come in the order of [`GridGraph::for_each_legal_move`].

mod search;
mod sight_cache;

use std::{fmt::Debug, marker::PhantomData, ops::Deref};

use mediant_grid::{GridGraph, Placement, Vertex, VertexId};

use self::{
    search::{Parents, Search},
    sight_cache::SightCache,
};
use crate::{Guarantee, Heuristic, NodeStore, Observer, OpenList, Outcome, Path, Planner, Query, QueryError};

/// Theta*: A* in which a node hangs on the parent of the node that generates it if that sees it.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Corners, DiagonalGap, GridGraph};
/// use mediant_moves::FiniteK;
/// use mediant_search::{Hk, Planner, Query, ThetaStar};
///
/// let map = AsciiMap::parse("
///     ......
///     ...#..
///     ...#..
///     ......
/// ")?;
/// let graph = GridGraph::<Corners>::new(Arc::new(map.grid), FiniteK::new(3)?, DiagonalGap::Open)?;
/// let outcome = ThetaStar::new(&graph, Hk).solve(Query::new((0, 1), (6, 2)))?;
/// let expected = [(0, 1), (4, 1), (6, 2)].map(Into::into);
/// assert_eq!(outcome.path().map(|path| path.waypoints()), Some(&expected[..]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub type ThetaStar<L, H> = Theta<L, H, Eager>;

/// Lazy Theta*: Theta* that takes sight for granted until the node is expanded. One that does not see what it hangs on then hangs on the
/// closed neighbor through which it is cheapest, at a higher cost, and is expanded all the same.
pub type LazyThetaStar<L, H> = Theta<L, H, Lazy>;

/// The search that [`ThetaStar`] and [`LazyThetaStar`] share; `S` says when lines of sight are checked.
///
/// `L` is how the planner holds its grid graph: by reference, or, where both belong in one struct, by `Arc`. Its scratch memory takes 24½
/// bytes a vertex. Segments cost what a move of their displacement would, [`Cost::of_move`](mediant_moves::Cost::of_move).
#[derive(Clone, Debug)]
pub struct Theta<L, H, S> {
    graph: L,
    heuristic: H,
    nodes: NodeStore<Parents>,
    open: OpenList,
    sight: SightCache,
    check: PhantomData<S>,
}

/// When a search checks that a node sees its parent.
pub trait SightCheck: sealed::Sealed + Copy + Debug {
    /// Whether that is when the node is generated; otherwise, when it is expanded.
    const EAGER: bool;
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Eager {}
    impl Sealed for super::Lazy {}
}

/// When the node is generated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Eager;

impl SightCheck for Eager {
    const EAGER: bool = true;
}

/// When the node is expanded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Lazy;

impl SightCheck for Lazy {
    const EAGER: bool = false;
}

impl<P: Placement, L: Deref<Target = GridGraph<P>>, H: Heuristic, S: SightCheck> Theta<L, H, S> {
    /// A planner with scratch memory for `graph`.
    #[must_use]
    pub fn new(graph: L, heuristic: H) -> Self {
        let nodes = NodeStore::new(graph.vertex_count());
        let sight = SightCache::new::<P>(&graph);
        Self { graph, heuristic, nodes, open: OpenList::default(), sight, check: PhantomData }
    }
}

impl<P, L, H, S> Planner for Theta<L, H, S>
where
    P: Placement,
    L: Deref<Target = GridGraph<P>>,
    H: Heuristic,
    S: SightCheck,
{
    fn solve_observed(&mut self, query: Query, observer: &mut impl Observer) -> Result<Outcome, QueryError> {
        let Some((start, goal)) = query.ends(&self.graph)? else { return Ok(Outcome::Unreachable) };
        let Self { graph, heuristic, nodes, open, sight, check } = self;
        let found = Search {
            graph: &**graph,
            heuristic: *heuristic,
            nodes,
            open,
            sight,
            observer,
            start,
            goal,
            goal_at: query.goal,
            check: *check,
        }
        .run();
        Ok(if found { Outcome::Found(self.path(start, goal)) } else { Outcome::Unreachable })
    }

    fn guarantee(&self) -> Guarantee {
        Guarantee::Suboptimal
    }
}

impl<P: Placement, L: Deref<Target = GridGraph<P>>, H, S> Theta<L, H, S> {
    /// The path that a search found, without waypoints on a straight line between their neighbors.
    fn path(&self, start: VertexId, goal: VertexId) -> Path {
        let up = |&id: &VertexId| self.nodes.get(id).filter(|_| id != start).map(|node| node.pointer.parent);
        let mut waypoints: Vec<Vertex> = Vec::with_capacity(std::iter::successors(Some(goal), up).count());
        for id in std::iter::successors(Some(goal), up) {
            let at = self.graph.vertex(id);
            if let [.., before, last] = waypoints[..] {
                let (v, w) = (before.to(last), last.to(at));
                if v.det(w) == 0 && v.dot(w) > 0 {
                    waypoints.pop();
                }
            }
            waypoints.push(at);
        }
        waypoints.reverse();
        Path::new(waypoints)
    }
}
