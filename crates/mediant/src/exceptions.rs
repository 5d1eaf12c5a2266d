//! Cells that count otherwise for one query.

use mediant_grid::{PlacementKind, Vertex};
use mediant_search::{Answer, Query};

use crate::{
    choice::Choice, engine::Engine, error::Error, map::Map, planner::Planner, setup::Setup, space::Space,
};

/// Cells that count as blocked or as free for one query, whatever the map says: other agents in the way, and
/// the cell of an agent that marks its own.
///
/// ```
/// use mediant::{Engine, Exceptions, K, Map, Motion, Query};
///
/// // Both ends are cells of agents, which the map has as blocked.
/// let space = Map::from_rows([".....", "@..@.", "....."])?.space(Motion::centers(K::N8))?;
/// let mut planner = space.planner(Engine::Subgoal)?;
/// let answer = planner.find_except(Query::new((3, 1), (0, 1)), &Exceptions::new().free_ends())?;
/// assert_eq!(answer.answer.cost(), Some(3.0));
/// let around = Exceptions::new().free_ends().blocked([(1, 1)]);
/// assert!(planner.find_except(Query::new((3, 1), (0, 1)), &around)?.answer.cost() > Some(3.0));
/// # Ok::<(), mediant::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Exceptions {
    /// In the order in which they were given; the last word on a cell counts.
    cells: Vec<(Vertex, bool)>,
    free_ends: bool,
}

/// The answer to a query with exceptions.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ExceptedAnswer {
    /// The answer, which is that of the map with these cells changed.
    pub answer: Answer,
    /// The engine that searched: the planner's if it prepares little, or if the map already has the cells as
    /// the query wants them, else one that prepares next to nothing.
    pub searched_by: Engine,
}

impl Exceptions {
    /// None.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// These cells count as blocked, too.
    #[must_use]
    pub fn blocked<C: Into<Vertex>>(mut self, cells: impl IntoIterator<Item = C>) -> Self {
        self.cells.extend(cells.into_iter().map(|cell| (cell.into(), true)));
        self
    }

    /// These cells count as free, too.
    #[must_use]
    pub fn free<C: Into<Vertex>>(mut self, cells: impl IntoIterator<Item = C>) -> Self {
        self.cells.extend(cells.into_iter().map(|cell| (cell.into(), false)));
        self
    }

    /// The starts and goals of the query count as free, whatever else is said of their cells. Between corners
    /// it is the cell (x, y) of a vertex (x, y) without a free cell that counts as free, on the right and
    /// lower edge of the map the cell before it.
    #[must_use]
    pub const fn free_ends(mut self) -> Self {
        self.free_ends = true;
        self
    }

    /// The space with the exceptions made; `None` if nothing changes.
    fn space(&self, space: &Space, query: &Query) -> Result<Option<Space>, Error> {
        let (map, motion) = (space.map(), space.motion());
        let mut changed = map.edit_cells(self.cells.iter().copied())?;
        if self.free_ends {
            let ends = query.starts().iter().chain(query.goals());
            let shut: Vec<_> =
                ends.filter_map(|&end| shut_cell(&changed, motion.rules.placement(), end)).collect();
            changed = changed.edit_cells(shut.into_iter().map(|cell| (cell, false)))?;
        }
        Ok(if changed == *map { None } else { Some(changed.within(query.limits()).space(motion)?) })
    }
}

/// The cell that must become free so that a path may stand on a vertex of the map; `None` if it may already.
/// A vertex outside the map stays what it is: an error, or moved to the map.
fn shut_cell(map: &Map, placement: PlacementKind, at: Vertex) -> Option<Vertex> {
    let inside = |at: i32, side: u32, more: u32| u32::try_from(at).is_ok_and(|at| at < side + more);
    let (more, cells) = match placement {
        PlacementKind::Center => (0, &[(0, 0)][..]),
        PlacementKind::Corner => (1, &[(0, 0), (-1, 0), (0, -1), (-1, -1)][..]),
    };
    let is_vertex = inside(at.x, map.width(), more) && inside(at.y, map.height(), more);
    let is_shut = is_vertex && cells.iter().all(|(dx, dy)| map.is_blocked((at.x + dx, at.y + dy)));
    let last = |side: u32| side as i32 - 1;
    is_shut.then(|| Vertex::new(at.x.min(last(map.width())), at.y.min(last(map.height()))))
}

impl Planner {
    /// Answers a query or a query on the map with some cells changed: what [`find`](Self::find) answers
    /// after an edit of these cells, on a planner that was made anew. The planner stays as it is.
    ///
    /// Nothing that was prepared is used where a cell differs: connected components are found again, and an
    /// engine that prepares much, or is repaired, is replaced by one that prepares next to nothing
    /// ([`ExceptedAnswer::searched_by`]).
    ///
    /// # Errors
    /// As for [`find`](Self::find), [`Error::EditCell`] for a cell outside the map, and [`Error::Stopped`] if
    /// the query's limits stop what is prepared.
    pub fn find_except(
        &mut self,
        query: impl Into<Query>,
        exceptions: &Exceptions,
    ) -> Result<ExceptedAnswer, Error> {
        let query = query.into();
        let mut other = self.except(&query, exceptions)?;
        let planner = other.as_mut().unwrap_or(self);
        let searched_by = planner.index().searched_by();
        Ok(ExceptedAnswer { answer: planner.find(query)?, searched_by })
    }

    /// The planner of [`find_except`](Self::find_except), for one who wants its events or its steps; `None`
    /// if the map already has the cells as the exceptions want them, so that this planner answers.
    ///
    /// # Errors
    /// [`Error::EditCell`] for a cell outside the map, and [`Error::Stopped`] if the query's limits stop
    /// what is prepared.
    pub fn except(&self, query: &Query, exceptions: &Exceptions) -> Result<Option<Self>, Error> {
        let Some(space) = exceptions.space(self.index().space(), query)? else { return Ok(None) };
        let Setup { engine, smoothing, .. } = self.index().setup();
        let is_online = engine.kind().capabilities().index.is_none();
        let engine = if is_online { engine } else { Choice::for_one_path(space.motion()).engine.into() };
        let index = space.within(query.limits()).prepare_for_one_path(engine)?.with_smoothing(smoothing);
        Ok(Some(index.try_planner()?))
    }
}
