//! Anya: the planner.

use std::{ops::Deref, sync::Arc};

use mediant_grid::{
    BitMatrix, Corners, FreeSpace, Identity, Mismatch, Point, Vertex, cost_table, sight::Place,
};
use mediant_moves::{FiniteK, K, KError};

use super::{
    cone::Successor,
    dead_ends::{DeadEnds, Opened},
    frontier::Frontier,
    goal::Goal,
    history::RootHistory,
    norm::{EuclideanNorm, LatticeNorm, Norm},
    search::AnyaSearch,
};
use crate::{
    guarantee::Guarantee,
    observer::{NodeEvent, Observer},
    path::Path,
    planner::{Planner, SearchStatus},
    query::{Ends, PointEnds, QueryError},
};

/// Anya on a map: shortest paths at any angle ([`new`](Self::new)), or over N(k) ([`over`](Self::over)).
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Corners, DiagonalGap, FreeSpace};
/// use mediant_moves::FiniteK;
/// use mediant_search::{Anya, Ends, Planner};
///
/// let map = AsciiMap::parse("
///     ....
///     .##.
///     ....
/// ")?;
/// let space = FreeSpace::<Corners>::new(Arc::new(map.grid), DiagonalGap::Open);
/// let answer = Anya::new(&space).solve(Ends::new((0, 1), (4, 3)))?;
/// let path = answer.path().ok_or("there is a way")?;
/// assert_eq!(path.waypoints(), [(0, 1), (1, 2), (4, 3)].map(Into::into));
/// assert_eq!(path.cost(), 2.0_f64.sqrt() + 10.0_f64.sqrt());
///
/// let answer = Anya::over(&space, FiniteK::N8)?.solve(Ends::new((0, 1), (4, 3)))?;
/// let path = answer.path().ok_or("there is a way")?;
/// assert_eq!(path.waypoints(), [(0, 1), (2, 3), (4, 3)].map(Into::into));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// `S` is how the planner holds the free space: by reference, or, where both belong in one struct, by `Arc`.
/// Its scratch memory grows with the searches, not with the map: 72 bytes for each node and 24 for each root
/// (48 over N(k)) of the largest, and 2 KB for each block of 16 × 16 vertices in which any had a root.
/// The events of its search name the roots of nodes, so the expansions of one root differ in f alone.
#[derive(Clone, Debug)]
pub struct Anya<S, N: Norm = EuclideanNorm> {
    space: S,
    /// The map without dead ends, if they are left out.
    opened: Option<Opened>,
    frontier: Frontier<N>,
    /// The successors of the node under expansion.
    next: Vec<Successor>,
    goal: Goal,
    /// The last root of the path to the goal, once that is found.
    last: Option<u32>,
    status: SearchStatus,
}

impl Anya<()> {
    /// The scratch memory that a planner on this map takes when it is made, in bytes.
    #[must_use]
    pub fn scratch_bytes(space: &FreeSpace<Corners>) -> usize {
        RootHistory::bytes(space.grid().width() + 1, space.grid().height() + 1)
    }
}

impl<S: Deref<Target = FreeSpace<Corners>>> Anya<S> {
    /// A planner of paths at any angle, on a map.
    #[must_use]
    pub fn new(space: S) -> Self {
        Self::with_norm(space, EuclideanNorm)
    }
}

impl<S: Deref<Target = FreeSpace<Corners>>> Anya<S, LatticeNorm> {
    /// A planner of paths over N(k), on a map.
    ///
    /// # Errors
    /// [`KError::TooLarge`] above [`CostTable::MAX_K`](mediant_moves::CostTable::MAX_K).
    pub fn over(space: S, k: FiniteK) -> Result<Self, KError> {
        Ok(Self::with_norm(space, LatticeNorm::new(k, cost_table(k)?.clone())))
    }
}

impl<S: Deref<Target = FreeSpace<Corners>>, N: Norm> Anya<S, N> {
    fn with_norm(space: S, norm: N) -> Self {
        let frontier = Frontier::new(norm, space.grid().width() + 1, space.grid().height() + 1);
        let (goal, status) = (Goal::NONE, SearchStatus::default());
        Self { space, opened: None, frontier, next: Vec::new(), goal, last: None, status }
    }

    /// The same planner, whose searches leave out the dead ends of the map, except those where they start or
    /// end, and what is not on the way between. Paths cost the same; of several shortest ones it may find
    /// another.
    ///
    /// # Errors
    /// [`Mismatch`] for the dead ends of another map or rule of motion.
    pub fn without(self, dead_ends: Arc<DeadEnds>) -> Result<Self, Mismatch> {
        dead_ends.identity().check("the dead ends", ("the free space", self.space.identity()))?;
        Ok(Self { opened: Some(Opened::new(dead_ends)), ..self })
    }

    /// [`without`](Self::without) the dead ends of its map, which are found now.
    #[must_use]
    pub fn without_dead_ends(self) -> Self {
        let opened = Some(Opened::new(Arc::new(DeadEnds::new(&self.space))));
        Self { opened, ..self }
    }

    /// Goes on with another map under the same rule, and without its dead ends if some are given, but with
    /// the scratch memory that this planner has. If its dead ends were [repaired](DeadEnds::repaired) to
    /// these, it follows them by work that follows the repair. The last search is forgotten.
    ///
    /// # Errors
    /// [`Mismatch`] for a free space of another rule, and for dead ends of another map or rule of motion.
    pub fn follow(&mut self, space: S, dead_ends: Option<Arc<DeadEnds>>) -> Result<(), Mismatch> {
        let (mine, identity) = (Identity { map: None, ..self.space.identity() }, space.identity());
        mine.check("the planner", ("the free space", identity))?;
        if let Some(dead_ends) = &dead_ends {
            dead_ends.identity().check("the dead ends", ("the free space", identity))?;
        }
        self.opened = match (self.opened.take(), dead_ends) {
            (Some(mut opened), Some(dead_ends)) => {
                opened.follow(dead_ends);
                Some(opened)
            }
            (_, dead_ends) => dead_ends.map(Opened::new),
        };
        self.frontier.fit(space.grid().width() + 1, space.grid().height() + 1);
        (self.space, self.last, self.status) = (space, None, SearchStatus::default());
        Ok(())
    }

    /// The rows of the map, as far as it is searched.
    fn rows<'a>(space: &'a FreeSpace<Corners>, opened: Option<&'a Opened>) -> &'a BitMatrix {
        opened.map_or_else(|| space.grid().rows(), Opened::rows)
    }

    /// Expands nodes until the best one holds the goal, none is open, or the observer pauses.
    fn run(&mut self, observer: &mut impl Observer) -> SearchStatus {
        let Self { space, opened, frontier, next, goal, last, .. } = self;
        let rows = Self::rows(space, opened.as_ref());
        let mut search = AnyaSearch { space, rows, frontier, goal: *goal, observer, next };
        loop {
            let Some((f, node)) = search.frontier.best() else { return SearchStatus::Unreachable };
            let is_current = search.frontier.root(node.root).is_current;
            let is_last = is_current && search.reaches_goal(node);
            if is_current && !is_last && search.observer.pauses(N::cost_of_priority(f)) {
                return SearchStatus::Searching;
            }
            search.frontier.pop();
            if !is_current {
                continue;
            }
            if is_last {
                *last = Some(node.root);
                return SearchStatus::Found;
            }
            let root = search.frontier.root(node.root);
            let parent = search.frontier.parent(node.root);
            let (g, f) = (N::cost(root.g), N::cost_of_priority(f));
            search.observer.expanded(NodeEvent { at: root.at.floor(), parent, g, f });
            if let Some(at) = root.at.vertex() {
                search.observer.reached(at, g);
            }
            search.expand(node);
        }
    }
}

impl<S: Deref<Target = FreeSpace<Corners>>, N: Norm> Anya<S, N> {
    /// Begins a search between two free places of the map; `connected` says whether there is a way.
    fn begin_between(
        &mut self,
        [start, goal]: [Place; 2],
        connected: bool,
        observer: &mut impl Observer,
    ) -> SearchStatus {
        let Self { space, opened, frontier, next, .. } = self;
        (self.goal, self.last, self.status) = (Goal::NONE, None, SearchStatus::Unreachable);
        if connected && start == goal {
            frontier.start(start);
            self.goal = Goal::reached(goal);
            (self.last, self.status) = (Some(0), SearchStatus::Found);
        } else if connected {
            if let Some(opened) = opened {
                opened.open(space.grid(), [start, goal]);
            }
            let rows = Self::rows(space, opened.as_ref());
            self.goal = Goal::new(space, rows, goal);
            AnyaSearch { space, rows, frontier, goal: self.goal, observer, next }.start(start);
            self.status = SearchStatus::Searching;
        }
        self.status
    }
}

impl<S: Deref<Target = FreeSpace<Corners>>, N: Norm> Planner for Anya<S, N> {
    fn begin(&mut self, query: Ends, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        self.status = SearchStatus::Unreachable;
        let connected = query.ids(&self.space)?.is_some();
        Ok(self.begin_between([query.start, query.goal].map(Place::of), connected, observer))
    }

    fn begin_at(
        &mut self,
        ends: PointEnds,
        observer: &mut impl Observer,
    ) -> Option<Result<SearchStatus, QueryError>> {
        if self.frontier.norm().k() != K::Any {
            return None;
        }
        self.status = SearchStatus::Unreachable;
        Some(ends.places(&self.space).map(|places| {
            let connected = self.space.points_connected(ends.start, ends.goal);
            self.begin_between(places, connected, observer)
        }))
    }

    fn proceed(&mut self, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        if self.status == SearchStatus::Searching {
            self.status = self.run(observer);
        }
        Ok(self.status)
    }

    fn path_to(&mut self, at: Vertex) -> Option<Path> {
        self.path_to_point(at.into())
    }

    fn path_to_point(&mut self, at: Point) -> Option<Path> {
        let place = self.space.place(at)?;
        match self.last.filter(|_| place == self.goal.at) {
            Some(_) if self.frontier.root(0).at == place => {
                Some(place.vertex().map_or_else(|| Path::through([at]), |at| Path::new(vec![at])))
            }
            Some(root) => Some(self.frontier.path(&self.space, root, place)),
            None if self.status == SearchStatus::Unreachable => None,
            None => self.frontier.path_to_root(&self.space, at.vertex()?),
        }
    }

    fn guarantee(&self) -> Guarantee {
        self.frontier.norm().k().finite().map_or(Guarantee::OptimalAnyAngle, Guarantee::Optimal)
    }

    fn identity(&self) -> Identity {
        Identity { k: Some(self.frontier.norm().k()), ..self.space.identity() }
    }
}
