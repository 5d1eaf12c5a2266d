//! Cells that count otherwise for one query.

use std::sync::Arc;

use mediant_grid::{PlacementKind, Vertex};
use mediant_search::{Answer, End, Guarantee, Limits, Query, QueryError};

use crate::{
    change::Change, choice::Choice, engine::Engine, error::Error, index::Index, map::Map, planner::Planner,
    setup_error::SetupError, space::Space,
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
    /// The engine that answered: the planner's where its index can be repaired, or if the map already has the
    /// cells as the query wants them, else one that prepares next to nothing.
    pub searched_by: Engine,
    /// The guarantee of its paths.
    pub guarantee: Guarantee,
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

    /// The change that the exceptions are; `None` if nothing changes.
    fn change(&self, space: &Space, query: &Query) -> Result<Option<Change>, Error> {
        let mut change = space.edit_cells(self.cells.iter().copied())?;
        if self.free_ends {
            let (map, placement) =
                (Map::from(Arc::clone(change.of_grid().after())), space.motion().rules.placement());
            let ends = query.starts().iter().chain(query.goals());
            let shut: Vec<_> = ends.filter_map(|end| shut_cell(&map, placement, end.vertex()?)).collect();
            // The map between the two edits is given up, so that the second one takes its place.
            drop(map);
            change = change.edit_cells(shut.into_iter().map(|cell| (cell, false)))?;
        }
        Ok(if change.of_grid().before().id() == change.of_grid().after().id() { None } else { Some(change) })
    }
}

/// The planner that answers queries with exceptions: kept from one to the next.
pub(crate) struct Excepted {
    /// The index that is repaired for each of them: the planner's own, or if that would be prepared anew, one
    /// of an engine that prepares next to nothing.
    base: Index,
    /// Between two queries it is on the base.
    planner: Planner,
}

impl Excepted {
    /// The index on which a query is answered after a change, and the one that it is repaired from: `known`
    /// if there is one.
    fn index(
        (own, known): (&Index, Option<&Index>),
        change: &Change,
        limits: &Limits,
    ) -> Result<[Index; 2], Error> {
        let base = known.unwrap_or(own).ready_for_changes(limits.interrupt())?;
        if let Some(repaired) = base.repaired_if_it_can_be(change, limits.interrupt())? {
            return Ok([repaired, base]);
        }
        let smoothing = own.setup().smoothing;
        let engine = Choice::for_one_path(own.space().motion());
        let base = own.space().within(limits).prepare_for_one_path(engine)?.with_smoothing(smoothing);
        Ok([base.repaired(change, limits.interrupt())?, base])
    }

    /// Continues on the index of a planner that follows to it; `None` if the two are of different engines.
    pub(crate) fn following(mut self, index: &Index) -> Option<Self> {
        let is_own = self.base.setup() == index.setup();
        (is_own && self.planner.follow(index).is_ok()).then(|| Self { base: index.clone(), ..self })
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
    /// The index is [repaired](Index::repair) for the query, by work that follows the cells. Where it would
    /// be prepared anew instead, an engine that prepares next to nothing answers
    /// ([`ExceptedAnswer::searched_by`]). What that takes is kept for the next query.
    ///
    /// # Errors
    /// As for [`find`](Self::find), [`Error::EditCell`] for a cell outside the map, and [`Error::Stopped`] if
    /// the query's limits stop what is prepared; [`Error::Setup`] where cells have costs.
    pub fn find_except(
        &mut self,
        query: impl Into<Query>,
        exceptions: &Exceptions,
    ) -> Result<ExceptedAnswer, Error> {
        self.index().space().check_is_without_costs(SetupError::EXCEPTIONS_ON_COSTS)?;
        let query = query.into();
        // Before its limits can stop what is prepared: no limit makes it a query.
        for (ends, end) in [(query.starts(), End::Start), (query.goals(), End::Goal)] {
            if ends.is_empty() {
                return Err(QueryError::NoEnd { end }.into());
            }
        }
        let Some(change) = exceptions.change(self.index().space(), &query)? else {
            let answer = self.find(query)?;
            return Ok(ExceptedAnswer {
                answer,
                searched_by: self.searched_by(),
                guarantee: self.guarantee(),
            });
        };
        let known = self.excepted.take();
        let indexes = (self.index(), known.as_ref().map(|known| &known.base));
        let [index, base] = Excepted::index(indexes, &change, &query.limits())?;
        let kept = known.and_then(|mut known| known.planner.follow(&index).is_ok().then_some(known.planner));
        let mut planner = match kept {
            Some(planner) => planner,
            None => index.try_planner()?,
        };
        let answer = planner.find(query);
        let (searched_by, guarantee) = (planner.searched_by(), planner.guarantee());
        // So that nothing holds the map of this query.
        planner.follow(&base)?;
        self.excepted = Some(Box::new(Excepted { base, planner }));
        Ok(ExceptedAnswer { answer: answer?, searched_by, guarantee })
    }

    /// The planner of [`find_except`](Self::find_except), for one who wants its events or its steps; `None`
    /// if the map already has the cells as the exceptions want them, so that this planner answers.
    ///
    /// # Errors
    /// [`Error::EditCell`] for a cell outside the map, and [`Error::Stopped`] if the query's limits stop
    /// what is prepared.
    pub fn except(&self, query: &Query, exceptions: &Exceptions) -> Result<Option<Self>, Error> {
        let Some(change) = exceptions.change(self.index().space(), query)? else { return Ok(None) };
        let [index, _] = Excepted::index((self.index(), None), &change, &query.limits())?;
        Ok(Some(index.try_planner()?))
    }
}
