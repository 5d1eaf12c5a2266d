//! Searches in steps.

use mediant_grid::Point;
use mediant_moves::K;
use mediant_search::{Answer, CenterSpace, EndSpace, Guarantee, Observer, Path, Query, QueryError, Search};

use super::{Planner, Rough};
use crate::{
    erased::Dynamic,
    setup::Setup,
    space::{Placed, Space},
};

/// # A search in steps
///
/// [`begin`](Self::begin), [`step`](Self::step) until there is an answer, or [`finish`](Self::finish) at any
/// time. Between steps the state of the search can be read. A search in steps finds the same path by the
/// same expansions as one at once.
///
/// ```
/// use mediant::{Engine, K, Map, Motion, Query};
///
/// let space = Map::from_fn(9, 9, |x, y| x == 4 && y != 8)?.space(Motion::centers(K::N8))?;
/// let mut planner = space.planner(Engine::AStar)?;
/// planner.begin(Query::new((0, 0), (8, 0)))?;
/// let answer = loop {
///     match planner.step(10)? {
///         Some(answer) => break answer,
///         None => assert!(planner.lower_bound() > 7.99 && planner.path_to((0, 0)).is_some()),
///     }
/// };
/// assert_eq!(answer, planner.find(Query::new((0, 0), (8, 0)))?);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
impl Planner {
    /// Begins the search for an answer, and forgets the last one. Nothing is expanded yet.
    ///
    /// # Errors
    /// [`QueryError`] for ends that are missing, blocked or outside the map, unless the query says what to
    /// do then, and for limits and tolerances that are no numbers, or less than 0.
    pub fn begin(&mut self, query: impl Into<Query>) -> Result<(), QueryError> {
        self.begun = None;
        self.check_smoothing()?;
        let guarantee = self.search.guarantee();
        let space = self.index.space();
        // Smoothing connects nothing that the search does not.
        let unsmoothed = Setup { smoothing: None, ..self.index.search_setup() };
        // On costs the moves of N(k) connect all that segments do.
        let is_any_angle = unsmoothed.paths() == K::Any && !space.has_costs();
        let query = query.into();
        let begun = match space.placed() {
            Placed::Centers(layers) => {
                let free = if is_any_angle { layers.at_any_angle() } else { &layers.free };
                search_in(space, &**free, guarantee, query)
            }
            Placed::Corners(layers) if space.is_between_centers() => {
                search_in(space, &CenterSpace(&layers.free), guarantee, query)
            }
            Placed::Corners(layers) => search_in(space, &*layers.free, guarantee, query),
        }?;
        self.begun = Some(if self.smooth.is_some() { begun.keeping_bends() } else { begun });
        Ok(())
    }

    /// Continues the search by at most `expansions` expansions. Returns the answer once it is there.
    ///
    /// # Errors
    /// [`QueryError::NotBegun`] without a search, [`QueryError::GaveUp`] where the engine gives up.
    pub fn step(&mut self, expansions: u64) -> Result<Option<Answer>, QueryError> {
        self.step_observed(expansions, &mut ())
    }

    /// Continues the search by at most `expansions` expansions, and reports its events. The observer may
    /// [pause](Observer::pauses) it before.
    ///
    /// # Errors
    /// As for [`step`](Self::step).
    pub fn step_observed(
        &mut self,
        expansions: u64,
        mut observer: &mut dyn Observer,
    ) -> Result<Option<Answer>, QueryError> {
        let Self { begun, search, .. } = self;
        let begun = begun.as_mut().ok_or(QueryError::NotBegun)?;
        let answer = begun.step(&mut Dynamic(&mut **search), expansions, &mut observer)?;
        answer.map(|answer| self.at_centers(self.smoothed(Ok(answer)))).transpose()
    }

    /// Continues the search until there is an answer.
    ///
    /// # Errors
    /// As for [`step`](Self::step).
    pub fn finish(&mut self) -> Result<Answer, QueryError> {
        self.finish_observed(&mut ())
    }

    /// Continues the search until there is an answer, and reports its events. The observer cannot pause it.
    pub(crate) fn finish_observed(&mut self, mut observer: &mut dyn Observer) -> Result<Answer, QueryError> {
        let Self { begun, search, .. } = self;
        let begun = begun.as_mut().ok_or(QueryError::NotBegun)?;
        let answer = begun.finish(&mut Dynamic(&mut **search), &mut observer);
        self.at_centers(self.smoothed(answer))
    }

    /// The best path so far of the search that was begun: to a goal, if one was found, else to the vertex
    /// nearest to a goal among those that it expanded. `None` without a search.
    #[must_use]
    pub fn best(&mut self) -> Option<Path> {
        let Self { begun, search, smooth, .. } = self;
        let begun = begun.as_ref()?;
        let best = begun.best(&mut Dynamic(&mut **search));
        let best = match smooth {
            Some(smooth) => smooth(begun.bends().map_or(Rough::Found(&best), Rough::Bends)),
            None => best,
        };
        Some(if self.index.space().is_between_centers() { best.at_centers() } else { best })
    }

    /// The path by which the search that was begun has reached a vertex, as the search found it: for most
    /// engines, one that it expanded. `None` for others, and without a search. Between centers at any angle
    /// it expands corners: (0.5, 0.5) is the lower right one of cell (0, 0).
    #[must_use]
    pub fn path_to(&mut self, at: impl Into<Point>) -> Option<Path> {
        let Self { begun, search, index, .. } = self;
        let space = index.space();
        let at = space.in_search(at.into()).vertex()?;
        let path = begun.as_ref()?.path_to(&mut Dynamic(&mut **search), at)?;
        Some(if space.is_between_centers() { path.at_centers() } else { path })
    }

    /// A lower bound on the cost of its answer, in cells, or in costs where cells have some. 0 without a
    /// search.
    #[must_use]
    pub fn lower_bound(&self) -> f64 {
        self.begun.as_ref().map_or(0.0, |begun| self.smoothed_bound(begun.lower_bound()))
    }

    /// The number of its expansions so far. 0 without a search.
    #[must_use]
    pub fn expansions(&self) -> u64 {
        self.begun.as_ref().map_or(0, Search::expansions)
    }
}

/// The search for a query by a planner with this guarantee.
fn search_in(
    space: &Space,
    free: &impl EndSpace,
    guarantee: Guarantee,
    query: Query,
) -> Result<Search, QueryError> {
    match space.path_costs() {
        Some(costs) => Search::on_costs(free, space.metric(), (guarantee, costs), query),
        None => Search::new(free, space.metric(), guarantee, query),
    }
}
