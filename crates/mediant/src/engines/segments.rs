//! CHPA*, on segments of the map.

use std::{num::NonZeroU32, sync::Arc};

use mediant_grid::{Centers, GridGraph, Interrupt, Interrupted};
use mediant_hierarchy::{ChpaStar, SegmentGraph};
use mediant_search::{Heuristic, SquaredEuclidean};

use super::{Boxed, EngineIndex, Source, boxed, check_side, shared, with_options};
use crate::{
    change::Change,
    configured::{ChpaOptions, ConfiguredEngine},
    engine::Engine,
    error::Error,
    heuristic::Admissible,
    space::PlacementOfSpace as _,
};

/// A grid graph with its segments.
pub(super) struct SegmentIndex {
    own: ChpaOptions,
    graph: Arc<GridGraph<Centers>>,
    segments: Arc<SegmentGraph>,
}

impl SegmentIndex {
    pub(super) fn new(
        own: ChpaOptions,
        graph: &Arc<GridGraph<Centers>>,
        source: Source<'_>,
    ) -> Result<Self, Error> {
        let segments = match source.bytes {
            Some(bytes) => SegmentGraph::from_bytes(graph, bytes)?,
            None => {
                let side = own.side.map_or(SegmentGraph::PAPER_SIDE, NonZeroU32::get);
                SegmentGraph::interruptible(graph, side, source.interrupt)?
            }
        };
        Self::of(own, graph, Arc::new(segments))
    }

    /// Checks that the segments are those that the options name.
    fn of(
        own: ChpaOptions,
        graph: &Arc<GridGraph<Centers>>,
        segments: Arc<SegmentGraph>,
    ) -> Result<Self, Error> {
        check_side(own.side, segments.side())?;
        Ok(Self { own, graph: Arc::clone(graph), segments })
    }

    /// The search with the heuristics of both phases.
    fn search_by(
        &self,
        first: impl Heuristic + Send + 'static,
        second: impl Heuristic + Send + 'static,
    ) -> Result<Boxed, Error> {
        let search = ChpaStar::new(Arc::clone(&self.graph), Arc::clone(&self.segments), first, second)?;
        Ok(boxed(search.with_fallback_policy(self.own.fallback_policy()).with_step(self.own.step())))
    }
}

impl EngineIndex for SegmentIndex {
    /// Compiled for each phase with and without a heuristic that overestimates.
    fn search(&self) -> Result<Boxed, Error> {
        let [first, second] =
            self.own.heuristics().map(|name| Admissible::new(Engine::Chpa, Some(name)).ok());
        let squared = SquaredEuclidean;
        match (first, second) {
            (Some(first), Some(second)) => self.search_by(first, second),
            (Some(first), None) => self.search_by(first, squared),
            (None, Some(second)) => self.search_by(squared, second),
            (None, None) => self.search_by(squared, squared),
        }
    }

    fn scratch_bytes(&self) -> usize {
        ChpaStar::scratch_bytes(&self.graph, &self.segments)
    }

    fn with_options(&self, engine: ConfiguredEngine) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        let ConfiguredEngine::Chpa(own) = engine else { return Ok(None) };
        with_options(Self::of(own, &self.graph, Arc::clone(&self.segments)))
    }

    fn memory_bytes(&self) -> usize {
        self.segments.memory_bytes()
    }

    /// A byte a segment is copied as fast as memory.
    fn to_bytes(&self, _interrupt: &Interrupt) -> Result<Option<Vec<u8>>, Interrupted> {
        Ok(Some(self.segments.to_bytes()))
    }

    fn repaired(
        &self,
        change: &Change,
        interrupt: &Interrupt,
    ) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        let graph = Centers::layers(change.after(), Engine::Chpa)?.graph(self.graph.k())?;
        let segments = self.segments.repaired(change.of_grid(), interrupt)?;
        shared(Self::of(self.own, graph, Arc::new(segments))).map(Some)
    }

    fn as_prepared(&self) -> Option<ConfiguredEngine> {
        let side = self.side().and_then(NonZeroU32::new);
        Some(ConfiguredEngine::Chpa(ChpaOptions { side, ..self.own }))
    }

    fn side(&self) -> Option<u32> {
        Some(self.segments.side())
    }
}
