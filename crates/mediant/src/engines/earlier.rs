//! Subgoals of a map that has changed since: the labels or the graph of an earlier map where they still prove
//! the answer, and another engine where they do not.

use std::{any::Any, sync::Arc};

use mediant_grid::{Interrupt, Interrupted, Point, Vertex};
use mediant_search::{
    Ends, Guarantee, Observer, Path, Planner as Search, PointEnds, QueryError, SearchStatus,
};
use mediant_subgoal::{EarlierMap, EarlierSearch, SubgoalPlacement};

use super::{Boxed, EngineIndex, boxed, following};
use crate::{
    change::Change,
    engine::Engine,
    erased::Dynamic,
    error::Error,
    labeled::{HasLabels, Labeled},
    option::Levels,
    space::{PlacementOfSpace, Space},
};

/// Subgoals that were prepared on an earlier map.
#[derive(Clone)]
pub(super) struct EarlierIndex<P: SubgoalPlacement> {
    /// `None` after so many edits that it proves too little.
    pub(super) map: Option<Arc<EarlierMap<P>>>,
    /// Its labels, if they are those of the present map: if all cells are again as they were.
    labels: Option<Labeled<P>>,
    /// The preparation of the earlier map.
    pub(super) levels: Levels,
    /// On the present map.
    pub(super) other: Arc<dyn EngineIndex>,
}

impl<P: PlacementOfSpace> EarlierIndex<P> {
    pub(super) fn new(map: Option<EarlierMap<P>>, levels: Levels, other: Arc<dyn EngineIndex>) -> Self {
        let present = map.as_ref().filter(|map| map.is_present());
        let labels = present.and_then(|map| {
            let labels = Arc::clone(map.labels()?);
            Some(Labeled { space: Arc::clone(map.space()), labels })
        });
        Self { labels, map: map.map(Arc::new), levels, other }
    }

    /// The index for the map after another change; `anew` prepares the other engine where it is not repaired.
    pub(super) fn repaired(
        &self,
        change: &Change,
        anew: impl FnOnce(&Space) -> Result<Arc<dyn EngineIndex>, Error>,
        interrupt: &Interrupt,
    ) -> Result<Self, Error> {
        let now = &P::layers(change.after(), Engine::Subgoal)?.free;
        let map = self.map.as_ref().and_then(|map| map.after(now, change.of_grid()));
        let other = other_after(&self.other, change, anew, interrupt)?;
        Ok(Self::new(map, self.levels, other))
    }

    pub(super) fn search(&self) -> Result<Boxed, Error> {
        let other = self.other.search()?;
        match &self.map {
            Some(map) => Ok(boxed(EarlierSearch::new(Arc::clone(map), Other(other))?)),
            None => Ok(other),
        }
    }

    pub(super) fn follow(&self, search: &mut Boxed) -> Result<bool, Error> {
        let Some(map) = &self.map else { return self.other.follow(search) };
        let follow = |other: &mut Other| {
            if !self.other.follow(&mut other.0)? {
                other.0 = self.other.search()?;
            }
            Ok::<(), Error>(())
        };
        following(search, |search: &mut EarlierSearch<P, Other>| search.follow(Arc::clone(map), follow))
    }

    /// Whether the last query of a search was answered by the other engine.
    pub(super) fn is_by_other(&self, search: &Boxed) -> bool {
        let search: &dyn Any = &**search;
        search.downcast_ref().is_none_or(|search: &EarlierSearch<P, Other>| !search.is_from_earlier())
    }

    /// Whether the earlier map is the present one: then nothing is left to make anew.
    pub(super) fn is_present(&self) -> bool {
        self.map.as_ref().is_some_and(|map| map.is_present())
    }

    /// Its labels, if they are those of the present map.
    pub(super) fn labels(&self) -> Option<&dyn HasLabels> {
        self.labels.as_ref().map(|labels| labels as &dyn HasLabels)
    }

    /// The bytes of its labels or its graph, if they are those of the present map.
    pub(super) fn to_bytes(&self, interrupt: &Interrupt) -> Result<Option<Vec<u8>>, Interrupted> {
        let Some(map) = self.map.as_ref().filter(|map| map.is_present()) else { return Ok(None) };
        match (map.labels(), map.graph()) {
            (Some(labels), _) => labels.to_bytes_interruptible(interrupt).map(Some),
            (None, Some(graph)) => graph.to_bytes_interruptible(interrupt).map(Some),
            (None, None) => Ok(None),
        }
    }

    pub(super) fn scratch_bytes(&self) -> usize {
        self.map.as_ref().map_or(0, |map| map.scratch_bytes()) + self.other.scratch_bytes()
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.map.as_ref().map_or(0, |map| map.memory_bytes()) + self.other.memory_bytes()
    }
}

/// The index of another engine after a change, repaired or prepared anew.
pub(super) fn other_after(
    other: &Arc<dyn EngineIndex>,
    change: &Change,
    anew: impl FnOnce(&Space) -> Result<Arc<dyn EngineIndex>, Error>,
    interrupt: &Interrupt,
) -> Result<Arc<dyn EngineIndex>, Error> {
    other.repaired(change, interrupt)?.map_or_else(|| anew(change.after()), Ok)
}

/// The search of the other engine.
struct Other(Boxed);

impl Search for Other {
    fn begin(&mut self, query: Ends, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        Dynamic(&mut *self.0).begin(query, observer)
    }

    fn proceed(&mut self, observer: &mut impl Observer) -> Result<SearchStatus, QueryError> {
        Dynamic(&mut *self.0).proceed(observer)
    }

    fn begin_at(
        &mut self,
        ends: PointEnds,
        observer: &mut impl Observer,
    ) -> Option<Result<SearchStatus, QueryError>> {
        self.0.begin_at(ends, observer)
    }

    fn path_to(&mut self, at: Vertex) -> Option<Path> {
        self.0.path_to(at)
    }

    fn path_to_point(&mut self, at: Point) -> Option<Path> {
        self.0.path_to_point(at)
    }

    fn solve(&mut self, query: Ends) -> Result<mediant_search::Answer, QueryError> {
        self.0.solve(query)
    }

    fn distance(&mut self, query: Ends) -> Result<Option<f64>, QueryError> {
        self.0.distance(query)
    }

    fn guarantee(&self) -> Guarantee {
        self.0.guarantee()
    }

    fn identity(&self) -> mediant_grid::Identity {
        self.0.identity()
    }
}
