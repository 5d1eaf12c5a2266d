//! Anya (Harabor, Grastien, Öz & Aksakalli 2016, 'Optimal Any-Angle Pathfinding In Practice'): optimal any-angle paths between
//! corner vertices, found online, with nothing preprocessed.
//!
//! **Nodes.** A *root* is the start or a vertex at which paths turn. A *cone node* is what a root sees of another horizontal line: an interval
//! between two rays from it, or on them. A *flat node* is a vertex of the root's own line at which a path may turn. f is the
//! length of the path to the root and of the shortest way from there through the interval to the goal, or to the goal's mirror image
//! where that is on the near side (Section 4.3). It never falls from a node to its successors, and is exact where the interval
//! holds the goal: the first such node taken from the open list is optimal.
//!
//! **Successors.** A cone crosses the row of cells ahead of its line by the runs of free cells that it enters:
//! - what the root sees of the next line through a run is an *observable* successor;
//! - what an obstacle's corner hides of a run is a *non-observable* one, whose root is that corner. The corner is an end of the interval with
//!   the obstacle on the near side of the line, or an end of the run that the ray passes inwards;
//! - around a corner on the near side the path may also turn onto the line itself: a flat node at the next corner there.
//!
//! Every successor is *taut*: it bends only around a corner of an obstacle, and towards it. Each optimal path is such a chain. A root's
//! intervals are closed, so a path that grazes a corner and goes straight on is also one that 'turns' there by nothing: intervals of width 0
//! need not be kept.
//!
//! **Pruning.** A vertex that has been reached as cheaply by another root is no root again, and nodes of a root that was bettered are dropped
//! (*root history*). Successors with nothing behind them are not queued (*cul-de-sac*), and while a node has just one successor the search goes on with
//! that (*intermediate*). Most lines have one and hide nothing: those are passed by additions and one word of cells (module `beam`).
//!
//! **Gap rules.** Under [`DiagonalGap::Open`](mediant_grid::DiagonalGap::Open) a gap is a corner that hides all of the run beyond it. Under
//! [`DiagonalGap::Closed`](mediant_grid::DiagonalGap::Closed), Anya's own rule, nothing turns there, and flat nodes end there. A start or goal that is
//! a gap is left or entered through the quadrant of its own cell.
//!
//! **Exactness.** An interval end is the rational where a ray, kept as the vector between two vertices of the map, meets a line. What is asked
//! of it (floor, ceiling, is it a vertex?) is decided exactly; no two ends are ever compared within a tolerance. The proof, also that
//! nothing overflows on the largest map, is in module `interval`. Lengths are sums of square roots, in `f64`.
//!
//! Ties: the open list orders by f, then h, then the age of the node; see module `frontier`.
//!
//! On the eighteen maps of `benchdata/reference_timings.json` it takes 0.13 to 0.31 of the time of Anya16 (Java), 0.94 of Polyanya's in the geometric
//! mean (0.40 in noise, 1.8 in large empty rooms, which Polyanya crosses in one step), same instances, scaled by `cargo xtask compare`.
//!
//! Measured on the way, in instructions for each query on six maps of the benchmark sets (geometric mean): a row's cells loaded once for a line
//! took 0.90 of what it was before, open list entries of 16 bytes 0.97, cul-de-sac pruning 0.98 (noise 1.04, ArcticStation 0.90), places in
//! fixed point instead of quotient and rest 0.91, successors that keep their rays' steps 0.95. Tried and left out: a loop of its own for
//! lines on which nothing is in the way (1.05 to 1.15), and expanding the best successor without queueing it when it beats the open
//! list (1.00).

mod cone;
mod frontier;
mod search;

use std::ops::Deref;

use mediant_grid::{Corners, FreeSpace};

use crate::{Guarantee, NodeEvent, Observer, Outcome, Path, Planner, Query, QueryError};
use frontier::{Frontier, fixed};
use search::{Search, Successor};

/// Anya on a map: shortest paths at any angle.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Corners, DiagonalGap, FreeSpace};
/// use mediant_search::{Anya, Planner, Query};
///
/// let map = AsciiMap::parse("
///     ....
///     .##.
///     ....
/// ")?;
/// let space = FreeSpace::<Corners>::new(Arc::new(map.grid), DiagonalGap::Open);
/// let outcome = Anya::new(&space).solve(Query::new((0, 1), (4, 3)))?;
/// let path = outcome.path().ok_or("there is a way")?;
/// assert_eq!(path.waypoints(), [(0, 1), (1, 2), (4, 3)].map(Into::into));
/// assert_eq!(path.cost(), 2.0_f64.sqrt() + 10.0_f64.sqrt());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// `T` is how the planner holds its map: by reference, or, where both belong in one struct, by `Arc`. Its scratch memory takes 8 bytes a vertex, and
/// 40 for each node and 24 for each root of the largest search. An event of its search is that of the root of a node: expansions are told apart by f alone.
#[derive(Clone, Debug)]
pub struct Anya<T> {
    space: T,
    frontier: Frontier,
    /// The successors of the node under expansion.
    next: Vec<Successor>,
}

impl<T: Deref<Target = FreeSpace<Corners>>> Anya<T> {
    /// A planner with scratch memory for a map.
    #[must_use]
    pub fn new(space: T) -> Self {
        let frontier = Frontier::new(space.vertex_count());
        Self { space, frontier, next: Vec::new() }
    }

    /// The last root of an optimal path to the goal.
    fn search(&mut self, query: Query, observer: &mut impl Observer) -> Option<u32> {
        let Self { space, frontier, next } = self;
        let mut search = Search { space, frontier, goal: query.goal, observer, next };
        search.start(query.start);
        while let Some((f, node)) = search.frontier.pop() {
            if !search.frontier.is_current(search.space, node.root) {
                continue;
            }
            if search.reaches_goal(node) {
                return Some(node.root);
            }
            let root = search.frontier.root(node.root);
            let parent = search.frontier.parent(node.root);
            search.observer.expanded(NodeEvent { at: root.at, parent, g: fixed(root.g), f: fixed(f) });
            search.expand(node);
        }
        None
    }
}

impl<T: Deref<Target = FreeSpace<Corners>>> Planner for Anya<T> {
    fn solve_observed(&mut self, query: Query, observer: &mut impl Observer) -> Result<Outcome, QueryError> {
        if query.ends(&self.space)?.is_none() {
            return Ok(Outcome::Unreachable);
        }
        if query.start == query.goal {
            return Ok(Outcome::Found(Path::new(vec![query.start])));
        }
        match self.search(query, observer) {
            Some(root) => Ok(Outcome::Found(self.frontier.path(root, query.goal))),
            None => Ok(Outcome::Unreachable),
        }
    }

    fn guarantee(&self) -> Guarantee {
        Guarantee::OptimalAnyAngle
    }
}
