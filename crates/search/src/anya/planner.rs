//! Anya: the planner.

use std::ops::Deref;

use mediant_grid::{Corners, FreeSpace, Identity, Vertex};
use mediant_moves::K;

use super::{
    cone::Successor,
    frontier::{Frontier, fixed},
    search::Search,
};
use crate::{
    observer::{NodeEvent, Observer},
    outcome::Guarantee,
    path::Path,
    planner::{Planner, Status},
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
    goal: Vertex,
    /// The last root of the path to the goal, once that is found.
    last: Option<u32>,
    status: Status,
}

impl<S: Deref<Target = FreeSpace<Corners>>> Anya<S> {
    /// A planner with scratch memory for a map.
    #[must_use]
    pub fn new(space: S) -> Self {
        let frontier = Frontier::new(space.vertex_count());
        let (goal, status) = (Vertex::new(0, 0), Status::default());
        Self { space, frontier, next: Vec::new(), goal, last: None, status }
    }

    /// Expands nodes until the best one holds the goal, none is open, or the observer pauses.
    fn run(&mut self, observer: &mut impl Observer) -> Status {
        let Self { space, frontier, next, goal, last, .. } = self;
        let mut search = Search { space, frontier, goal: *goal, observer, next };
        loop {
            let Some((f, node)) = search.frontier.best() else { return Status::Unreachable };
            let is_current = search.frontier.is_current(search.space, node.root);
            let is_last = is_current && search.reaches_goal(node);
            if is_current && !is_last && search.observer.pauses(fixed(f)) {
                return Status::Searching;
            }
            search.frontier.pop();
            if !is_current {
                continue;
            }
            if is_last {
                *last = Some(node.root);
                return Status::Found;
            }
            let root = search.frontier.root(node.root);
            let parent = search.frontier.parent(node.root);
            search.observer.expanded(NodeEvent { at: root.at, parent, g: fixed(root.g), f: fixed(f) });
            search.observer.reached(root.at, fixed(root.g));
            search.expand(node);
        }
    }
}

impl<S: Deref<Target = FreeSpace<Corners>>> Planner for Anya<S> {
    fn begin(&mut self, query: Query, observer: &mut impl Observer) -> Result<Status, QueryError> {
        self.status = Status::Unreachable;
        let ends = query.ends(&self.space)?;
        (self.goal, self.last) = (query.goal, None);
        let Self { space, frontier, next, goal, .. } = self;
        if ends.is_some() && query.start == query.goal {
            frontier.start(space, query.start);
            self.status = Status::Found;
        } else if ends.is_some() {
            Search { space, frontier, goal: *goal, observer, next }.start(query.start);
            self.status = Status::Searching;
        }
        Ok(self.status)
    }

    fn proceed(&mut self, observer: &mut impl Observer) -> Result<Status, QueryError> {
        if self.status == Status::Searching {
            self.status = self.run(observer);
        }
        Ok(self.status)
    }

    fn path_to(&mut self, at: Vertex) -> Option<Path> {
        match self.last.filter(|_| at == self.goal) {
            Some(root) => Some(self.frontier.path(root, at)),
            None if self.status == Status::Unreachable => None,
            None => self.frontier.path_to_root(&self.space, at),
        }
    }

    fn guarantee(&self) -> Guarantee {
        Guarantee::OptimalAnyAngle
    }

    fn identity(&self) -> Identity {
        Identity { k: Some(K::Any), ..self.space.identity() }
    }
}
