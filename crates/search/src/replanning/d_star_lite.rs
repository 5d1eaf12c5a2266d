//! D* Lite.

use std::ops::Deref;

use mediant_grid::{Change, GridGraph, Identity, Placement, Rectangle, Vertex};
use mediant_moves::Cost;

use super::{
    costs::{Lengths, MoveCosts},
    search::Replanner,
};
use crate::{
    answer::Answer,
    guarantee::Guarantee,
    observer::Observer,
    path::Path,
    query::{Ends, QueryError},
};

/// Changes are near the robot, where few distances come by them, and a new search from the goal takes longer
/// than A* from the robot: so it begins anew late (`docs/measurements/replanning.md`).
const NODES_A_CELL: usize = 16;

/// D* Lite over N(k) (Koenig & Likhachev 2002): the paths of a robot to its goal, while it moves and the map
/// changes. It searches only what a change alters, as far as the robot needs it.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{Centers, Change, CornerRule, FreeSpace, Grid, GridGraph, Vertex};
/// use mediant_moves::FiniteK;
/// use mediant_search::{DStarLite, Ends};
///
/// let unknown = Arc::new(Grid::from_fn(9, 9, |_, _| false)?);
/// let space = FreeSpace::<Centers>::new(Arc::clone(&unknown), CornerRule::Never);
/// let graph = Arc::new(GridGraph::in_space(&space, FiniteK::N16)?);
/// let mut robot = DStarLite::new(graph, Ends::new((0, 4), (8, 4)));
/// assert_eq!(robot.path()?.cost(), Some(8.0));
///
/// // It goes four steps, and comes to a wall.
/// robot.move_to(Vertex::new(4, 4));
/// let change = Change::new(unknown).edit_cells((2..=4).map(|y| (5, y, true)));
/// robot.change(Arc::new(GridGraph::in_space(&space.after(&change), FiniteK::N16)?), &change);
/// let path = robot.path()?.into_path().map(|path| path.to_string());
/// assert_eq!(path.as_deref(), Some("(4, 4) → (4, 5) → (6, 5) → (8, 4)"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// A path begins at the vertex where the robot is, as if it had not moved before: at a closed gap, in the
/// quadrant of the vertex's own cell.
///
/// `G` is how it holds its grid graph: by `Arc` where the map changes; `C` says what moves cost. Its scratch
/// memory is 24 bytes for each vertex that searches touch, by pages of the system.
#[derive(Clone, Debug)]
pub struct DStarLite<G, C = Lengths> {
    search: Replanner<G, C>,
    ends: Ends,
    cost: Option<Cost>,
}

impl<P: Placement, G: Deref<Target = GridGraph<P>>> DStarLite<G> {
    /// A planner for a robot at the start. Nothing is searched yet.
    #[must_use]
    pub fn new(graph: G, ends: impl Into<Ends>) -> Self {
        Self::with_costs(graph, Lengths, ends)
    }
}

impl<P: Placement, G: Deref<Target = GridGraph<P>>, C: MoveCosts<P>> DStarLite<G, C> {
    /// The same with costs of one's own.
    #[must_use]
    pub fn with_costs(graph: G, costs: C, ends: impl Into<Ends>) -> Self {
        Self { search: Replanner::new(graph, costs, NODES_A_CELL), ends: ends.into(), cost: None }
    }

    /// Moves the robot to another vertex, on its path or not.
    pub fn move_to(&mut self, at: impl Into<Vertex>) {
        (self.ends.start, self.cost) = (at.into(), None);
    }

    /// A shortest path from where the robot is, on the map as it is now.
    ///
    /// # Errors
    /// [`QueryError`] when the robot's vertex (the start) or the goal is blocked or outside the map. After a
    /// change it may be free.
    pub fn path(&mut self) -> Result<Answer, QueryError> {
        self.path_observed(&mut ())
    }

    /// The same, watched by an observer, which cannot pause the search. A vertex may be expanded twice: once
    /// as its distance ends to hold, once with the new one.
    ///
    /// # Errors
    /// As for [`path`](Self::path).
    pub fn path_observed(&mut self, observer: &mut impl Observer) -> Result<Answer, QueryError> {
        self.cost = None;
        let Some((start, goal)) = self.ends.ids(&self.search.graph)? else { return Ok(Answer::Unreachable) };
        self.cost = self.search.search(goal, start, observer);
        Ok(self.cost.map_or(Answer::Unreachable, |_| Answer::Found(Path::new(self.search.trace()))))
    }

    /// The exact cost of the path that was found last; `None` where there was none, or the robot or the map
    /// has changed since.
    #[must_use]
    pub const fn cost(&self) -> Option<Cost> {
        self.cost
    }

    /// Continues on the map after a change, on its grid graph. If that is not the one after this change of
    /// the map of this planner, with the same rules and k, all is searched anew; so it is after large
    /// changes.
    pub fn change(&mut self, graph: G, change: &Change)
    where
        C: Clone,
    {
        self.cost = None;
        self.search.change(graph, change);
    }

    /// Continues with another grid graph and other costs. Outside of `cells` map and costs must be the same
    /// as before: a move costs the same if it sweeps none of them.
    pub fn change_costs(&mut self, graph: G, costs: C, cells: &[Rectangle]) {
        self.cost = None;
        self.search.change_costs(graph, costs, cells);
    }

    /// The grid graph.
    #[must_use]
    pub fn graph(&self) -> &GridGraph<P> {
        &self.search.graph
    }

    /// Where the robot is, and its goal.
    #[must_use]
    pub const fn ends(&self) -> Ends {
        self.ends
    }

    /// The guarantee of the paths: they are optimal.
    #[must_use]
    pub fn guarantee(&self) -> Guarantee {
        Guarantee::Optimal(self.search.graph.k())
    }

    /// The identity of the answers: the map, the rules of motion and k.
    #[must_use]
    pub fn identity(&self) -> Identity {
        self.search.graph.identity()
    }

    /// The memory used beyond the grid graph, in bytes, where searches have touched all of it.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        self.search.memory_bytes()
    }
}
