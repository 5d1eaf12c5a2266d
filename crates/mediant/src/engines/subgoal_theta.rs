//! Sub-Theta*, on a subgoal graph with levels.

use std::{num::NonZeroU32, sync::Arc};

use mediant_grid::{Corners, FreeSpace, Interrupt, Interrupted};
use mediant_moves::K;
use mediant_subgoal::{LevelRecord, SubgoalGraph, SubgoalTheta};

use super::{
    Boxed, EngineIndex, Source, boxed, check_counted, check_levels, following, shared, with_options,
};
use crate::{
    change::Change,
    configured::ConfiguredEngine,
    engine::Engine,
    error::Error,
    option::{
        Levels, OptionValue,
        slot::{Field, Options, Slot},
        table::LEVELS,
    },
    setup_error::SetupError,
    space::PlacementOfSpace as _,
};

/// Options of Sub-Theta*.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct SubgoalThetaOptions {
    /// The levels of the graph; 2 by default.
    pub levels: Option<Levels>,
}

impl Options for SubgoalThetaOptions {
    fn slots(&mut self) -> Vec<Slot<'_>> {
        let levels = OptionValue::Levels(self.levels());
        vec![Slot::new(&LEVELS, Field::Levels(&mut self.levels)).with_value(Some(levels))]
    }

    fn check(&self, engine: Engine) -> Result<(), SetupError> {
        check_counted(engine, self.levels)
    }
}

impl SubgoalThetaOptions {
    /// The levels of the graph.
    fn levels(self) -> Levels {
        self.levels.unwrap_or(Levels::Number(NonZeroU32::MIN.saturating_add(1)))
    }
}

/// A free space with its subgoal graph.
pub(super) struct SubgoalThetaIndex {
    space: Arc<FreeSpace<Corners>>,
    graph: Arc<SubgoalGraph<Corners>>,
    /// By which the graph follows edits. It takes time and memory: `None` before the first one.
    record: Option<Arc<LevelRecord>>,
}

impl SubgoalThetaIndex {
    pub(super) fn new(
        own: SubgoalThetaOptions,
        k: K,
        space: &Arc<FreeSpace<Corners>>,
        source: Source<'_>,
    ) -> Result<Self, Error> {
        let (graph, record) = match source.bytes {
            Some(bytes) => (SubgoalGraph::from_bytes_interruptible(space, k, bytes, source.interrupt)?, None),
            None => {
                let hierarchy = own.levels().hierarchy().unwrap_or_default();
                let (progress, interrupt) = (&source.progress, source.interrupt);
                if source.for_changes {
                    SubgoalGraph::with_record(space, k, hierarchy, progress, interrupt)?
                } else {
                    (SubgoalGraph::with_progress(space, k, hierarchy, progress, interrupt)?, None)
                }
            }
        };
        Self::of(own, space, (Arc::new(graph), record.map(Arc::new)))
    }

    /// Checks that the graph has the levels that the options name; it needs levels in any case.
    fn of(
        own: SubgoalThetaOptions,
        space: &Arc<FreeSpace<Corners>>,
        (graph, record): (Arc<SubgoalGraph<Corners>>, Option<Arc<LevelRecord>>),
    ) -> Result<Self, Error> {
        let found = Levels::from(graph.hierarchy());
        if own.levels.is_some() || found == Levels::Contracted {
            check_levels(Some(own.levels()), Some(found))?;
        }
        Ok(Self { space: Arc::clone(space), graph, record })
    }
}

impl EngineIndex for SubgoalThetaIndex {
    fn search(&self) -> Result<Boxed, Error> {
        Ok(boxed(SubgoalTheta::new(Arc::clone(&self.space), Arc::clone(&self.graph))?))
    }

    fn follow(&self, search: &mut Boxed) -> Result<bool, Error> {
        let (space, graph) = (Arc::clone(&self.space), Arc::clone(&self.graph));
        following(search, |search: &mut SubgoalTheta<_, _, Corners>| search.follow(space, graph))
    }

    fn scratch_bytes(&self) -> usize {
        SubgoalTheta::scratch_bytes(&self.graph)
    }

    fn with_options(&self, engine: ConfiguredEngine) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        let ConfiguredEngine::SubgoalTheta(own) = engine else { return Ok(None) };
        with_options(Self::of(own, &self.space, (Arc::clone(&self.graph), self.record.clone())))
    }

    fn memory_bytes(&self) -> usize {
        self.graph.memory_bytes() + self.record.as_ref().map_or(0, |record| record.memory_bytes())
    }

    fn to_bytes(&self, interrupt: &Interrupt) -> Result<Option<Vec<u8>>, Interrupted> {
        self.graph.to_bytes_interruptible(interrupt).map(Some)
    }

    /// The same bytes as those of a new index.
    fn repaired(
        &self,
        change: &Change,
        interrupt: &Interrupt,
    ) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        let Some(record) = &self.record else { return Ok(None) };
        let space = Arc::clone(&Corners::layers(change.after(), Engine::SubgoalTheta)?.free);
        let Some((graph, record)) = record.repaired(&self.graph, &space, change.of_grid(), interrupt)? else {
            return Ok(None);
        };
        shared(Ok(Self { space, graph: Arc::new(graph), record: Some(Arc::new(record)) })).map(Some)
    }

    fn as_prepared(&self) -> Option<ConfiguredEngine> {
        Some(ConfiguredEngine::SubgoalTheta(SubgoalThetaOptions { levels: self.levels() }))
    }

    fn levels(&self) -> Option<Levels> {
        Some(self.graph.hierarchy().into())
    }
}
