//! CHPA*, on segments of the map.

use std::{num::NonZeroU32, sync::Arc};

use mediant_grid::{Centers, GridGraph, Interrupt, Interrupted};
use mediant_hierarchy::{ChpaStar, FallbackPolicy, SegmentGraph};
use mediant_search::Heuristic;
#[cfg(feature = "publications")]
use mediant_search::SquaredEuclidean;

use super::{Boxed, EngineIndex, Source, boxed, check_side, following, shared, with_options};
use crate::{
    change::Change,
    configured::ConfiguredEngine,
    engine::Engine,
    error::Error,
    heuristic::Admissible,
    option::{
        HeuristicName, OptionValue, if_published,
        slot::{Field, Options, Slot},
        table::SIDE,
    },
    space::PlacementOfSpace as _,
};
#[cfg(feature = "publications")]
use crate::{
    option::{
        Variant,
        published::{DETOUR, SECOND, STEP},
    },
    setup_error::SetupError,
};

/// Options of CHPA*.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct ChpaOptions {
    /// The heuristic of the first phase; h_k by default.
    pub heuristic: Option<HeuristicName>,
    /// [`Variant::Complete`] (the default) or [`Variant::Paper`].
    #[cfg(feature = "publications")]
    pub variant: Option<Variant>,
    /// The side of the segments, in cells; 3, as in the paper, by default.
    pub side: Option<NonZeroU32>,
    /// The heuristic of the second phase; that of the first by default.
    #[cfg(feature = "publications")]
    pub second: Option<HeuristicName>,
    /// Every how many segments there is a checkpoint (Pstep of Teleiša & Čalnerytė 2023); 2 by default.
    #[cfg(feature = "publications")]
    pub step: Option<NonZeroU32>,
    /// The greatest cost of the path to a checkpoint, as a multiple of h_k, before it is skipped; that of
    /// [`FallbackPolicy::default`] by default. Only for [`Variant::Complete`].
    #[cfg(feature = "publications")]
    pub detour: Option<NonZeroU32>,
}

impl Options for ChpaOptions {
    fn slots(&mut self) -> Vec<Slot<'_>> {
        let side = self.side.or(NonZeroU32::new(SegmentGraph::PAPER_SIDE)).map(OptionValue::Number);
        #[cfg(feature = "publications")]
        let [second, step, detour] = {
            let detour = match self.fallback_policy() {
                FallbackPolicy::Complete { detour } => Some(OptionValue::Number(detour)),
                FallbackPolicy::Paper => None,
            };
            let [_, second] = self.heuristics().map(OptionValue::Heuristic);
            [Some(second), Some(OptionValue::Number(self.step())), detour]
        };
        Vec::from([
            Slot::heuristic(&mut self.heuristic),
            #[cfg(feature = "publications")]
            Slot::variant(&mut self.variant, Variant::Complete),
            Slot::new(&SIDE, Field::Number(&mut self.side)).with_value(side),
            #[cfg(feature = "publications")]
            Slot::new(&SECOND, Field::Heuristic(&mut self.second)).with_value(second),
            #[cfg(feature = "publications")]
            Slot::new(&STEP, Field::Number(&mut self.step)).with_value(step),
            #[cfg(feature = "publications")]
            Slot::new(&DETOUR, Field::Number(&mut self.detour)).with_value(detour),
        ])
    }

    #[cfg(feature = "publications")]
    fn check(&self, engine: Engine) -> Result<(), SetupError> {
        match (self.variant, self.detour) {
            (Some(Variant::Paper), Some(_)) => Err(SetupError::DetourAsPublished { engine }),
            _ => Ok(()),
        }
    }
}

impl ChpaOptions {
    /// The heuristics of the first and of the second phase.
    fn heuristics(self) -> [HeuristicName; 2] {
        let first = self.heuristic.unwrap_or_default();
        [first, if_published!(self.second.unwrap_or(first), else first)]
    }

    /// Every how many segments there is a checkpoint.
    fn step(self) -> NonZeroU32 {
        let default = NonZeroU32::MIN.saturating_add(1);
        if_published!(self.step.unwrap_or(default), else default)
    }

    /// The search's fallback where its plan fails.
    fn fallback_policy(self) -> FallbackPolicy {
        #[cfg(feature = "publications")]
        match (self.variant, self.detour) {
            (Some(Variant::Paper), _) => return FallbackPolicy::Paper,
            (_, Some(detour)) => return FallbackPolicy::Complete { detour },
            _ => {}
        }
        FallbackPolicy::default()
    }
}

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

    fn follow_by<H1: Heuristic + 'static, H2: Heuristic + 'static>(
        &self,
        search: &mut Boxed,
    ) -> Result<bool, Error> {
        following(search, |search: &mut ChpaStar<_, _, H1, H2>| {
            search.follow(Arc::clone(&self.graph), Arc::clone(&self.segments))
        })
    }
}

impl EngineIndex for SegmentIndex {
    /// For publications compiled for each phase with and without a heuristic that overestimates.
    fn search(&self) -> Result<Boxed, Error> {
        let [first, second] = self.own.heuristics().map(|name| Admissible::new(Engine::Chpa, Some(name)));
        #[cfg(feature = "publications")]
        match (&first, &second) {
            (Ok(first), Err(_)) => return self.search_by(*first, SquaredEuclidean),
            (Err(_), Ok(second)) => return self.search_by(SquaredEuclidean, *second),
            (Err(_), Err(_)) => return self.search_by(SquaredEuclidean, SquaredEuclidean),
            (Ok(_), Ok(_)) => {}
        }
        self.search_by(first?, second?)
    }

    fn follow(&self, search: &mut Boxed) -> Result<bool, Error> {
        #[cfg(feature = "publications")]
        {
            let is_admissible = |name| Admissible::new(Engine::Chpa, Some(name)).is_ok();
            match self.own.heuristics().map(is_admissible) {
                [true, false] => return self.follow_by::<Admissible, SquaredEuclidean>(search),
                [false, true] => return self.follow_by::<SquaredEuclidean, Admissible>(search),
                [false, false] => return self.follow_by::<SquaredEuclidean, SquaredEuclidean>(search),
                [true, true] => {}
            }
        }
        self.follow_by::<Admissible, Admissible>(search)
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
