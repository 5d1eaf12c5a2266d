//! Sub-Theta*, on a subgoal graph with levels.

use std::{num::NonZeroU32, sync::Arc};

use mediant_grid::{Corners, FreeSpace, Interrupt, Interrupted};
use mediant_moves::K;
use mediant_subgoal::{SubgoalGraph, SubgoalTheta};

use super::{Boxed, EngineIndex, Source, boxed, check_counted, check_levels, following, with_options};
use crate::{
    configured::ConfiguredEngine,
    engine::Engine,
    error::Error,
    option::{
        Levels, OptionValue,
        slot::{Field, Options, Slot},
        table::LEVELS,
    },
    setup_error::SetupError,
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
}

impl SubgoalThetaIndex {
    pub(super) fn new(
        own: SubgoalThetaOptions,
        k: K,
        space: &Arc<FreeSpace<Corners>>,
        source: Source<'_>,
    ) -> Result<Self, Error> {
        let graph = match source.bytes {
            Some(bytes) => SubgoalGraph::from_bytes_interruptible(space, k, bytes, source.interrupt)?,
            None => {
                let hierarchy = own.levels().hierarchy().unwrap_or_default();
                SubgoalGraph::with_progress(space, k, hierarchy, &source.progress, source.interrupt)?
            }
        };
        Self::of(own, space, Arc::new(graph))
    }

    /// Checks that the graph has the levels that the options name; it needs levels in any case.
    fn of(
        own: SubgoalThetaOptions,
        space: &Arc<FreeSpace<Corners>>,
        graph: Arc<SubgoalGraph<Corners>>,
    ) -> Result<Self, Error> {
        let found = Levels::from(graph.hierarchy());
        if own.levels.is_some() || found == Levels::Contracted {
            check_levels(Some(own.levels()), Some(found))?;
        }
        Ok(Self { space: Arc::clone(space), graph })
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
        with_options(Self::of(own, &self.space, Arc::clone(&self.graph)))
    }

    fn memory_bytes(&self) -> usize {
        self.graph.memory_bytes()
    }

    fn to_bytes(&self, interrupt: &Interrupt) -> Result<Option<Vec<u8>>, Interrupted> {
        self.graph.to_bytes_interruptible(interrupt).map(Some)
    }

    fn as_prepared(&self) -> Option<ConfiguredEngine> {
        Some(ConfiguredEngine::SubgoalTheta(SubgoalThetaOptions { levels: self.levels() }))
    }

    fn levels(&self) -> Option<Levels> {
        Some(self.graph.hierarchy().into())
    }
}
