//! Anya: the planner.

use std::ops::Deref;

use mediant_grid::{Corners, FreeSpace, Identity};
use mediant_moves::K;

use super::{
    cone::Successor,
    frontier::{Frontier, fixed},
    search::Search,
};
use crate::{
    observer::{NodeEvent, Observer},
    outcome::{Guarantee, Outcome},
    path::Path,
    planner::Planner,
    query::{Query, QueryError},
};

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
/// `S` is how the planner holds the free space: by reference, or, where both belong in one struct, by `Arc`.
/// Its scratch memory is 8 bytes a vertex, and 40 for each node and 24 for each root of the largest search.
/// The events of its search name the roots of nodes, so the expansions of one root differ in f alone.
#[derive(Clone, Debug)]
pub struct Anya<S> {
    space: S,
    frontier: Frontier,
    /// The successors of the node under expansion.
    next: Vec<Successor>,
}

impl<S: Deref<Target = FreeSpace<Corners>>> Anya<S> {
    /// A planner with scratch memory for a map.
    #[must_use]
    pub fn new(space: S) -> Self {
        let frontier = Frontier::new(space.vertex_count());
        Self { space, frontier, next: Vec::new() }
    }

    /// Searches an optimal path to the goal and returns the number of its last root.
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

impl<S: Deref<Target = FreeSpace<Corners>>> Planner for Anya<S> {
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

    fn identity(&self) -> Identity {
        Identity { k: Some(K::Any), ..self.space.identity() }
    }
}
