//! JPS+: jump point search by a table of jump points, which can be saved.

use std::sync::Arc;

#[cfg(feature = "all-engines")]
use mediant_grid::Change;
use mediant_grid::{GridGraph, Interrupt, Interrupted, Placement};
use mediant_search::JumpTable;
#[cfg(feature = "all-engines")]
use mediant_search::Pruning;

use super::{
    Source,
    jumps::{EngineFinder, JumpIndex, JumpOptions},
};
#[cfg(feature = "publications")]
use crate::option::{published::KEEP_INTERMEDIATE, slot::Field};
use crate::{
    configured::ConfiguredEngine,
    engine::Engine,
    error::Error,
    memory_check,
    option::{
        HeuristicName,
        slot::{Options, Slot},
    },
    shared_rules::{self, Shared},
};

/// Options of JPS+.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct JpsPlusOptions {
    /// The heuristic; h_k by default.
    pub heuristic: Option<HeuristicName>,
    /// Whether to keep intermediate jump points, at which a path only turns on its way to another jump point.
    #[cfg(feature = "publications")]
    pub keep_intermediate: bool,
}

impl Options for JpsPlusOptions {
    fn slots(&mut self) -> Vec<Slot<'_>> {
        Vec::from([
            Slot::heuristic(&mut self.heuristic),
            #[cfg(feature = "publications")]
            Slot::new(&KEEP_INTERMEDIATE, Field::Flag(&mut self.keep_intermediate)),
        ])
    }
}

impl<P: Shared> JumpIndex<P, Arc<JumpTable>> {
    pub(super) fn by_table(
        graph: &Arc<GridGraph<P>>,
        own: JpsPlusOptions,
        source: Source<'_>,
    ) -> Result<Self, Error> {
        memory_check::check("the index", JumpTable::bytes(graph) as u64)?;
        let table = match source.bytes {
            None => JumpTable::interruptible(graph, source.interrupt)?,
            Some(bytes) => JumpTable::from_bytes_interruptible(graph, bytes, source.interrupt)?,
        };
        let pruning = shared_rules::pruning(graph, source.interrupt)?;
        Self::new(graph, pruning, Arc::new(table), own.into())
    }
}

impl<P: Placement> EngineFinder<P> for Arc<JumpTable> {
    const ENGINE: Engine = Engine::JpsPlus;

    fn options(engine: ConfiguredEngine) -> Option<JumpOptions> {
        if let ConfiguredEngine::JpsPlus(own) = engine { Some(own.into()) } else { None }
    }

    fn memory_bytes(&self) -> usize {
        JumpTable::memory_bytes(self)
    }

    /// The light build leaves this out, as it does for the blocks of words.
    #[cfg(feature = "all-engines")]
    fn repaired(
        &self,
        (graph, pruning): (&GridGraph<P>, &Pruning<P>),
        change: &Change,
        interrupt: &Interrupt,
    ) -> Result<Option<Self>, Error> {
        Ok(Some(Self::new(JumpTable::repaired(self, graph, pruning, change, interrupt)?)))
    }

    fn to_bytes(&self, interrupt: &Interrupt) -> Result<Option<Vec<u8>>, Interrupted> {
        self.to_bytes_interruptible(interrupt).map(Some)
    }
}

/// The table has jumps of every length.
impl From<JpsPlusOptions> for JumpOptions {
    fn from(own: JpsPlusOptions) -> Self {
        Self {
            heuristic: own.heuristic,
            #[cfg(feature = "publications")]
            jump_limit: None,
            #[cfg(feature = "publications")]
            keep_intermediate: own.keep_intermediate,
        }
    }
}
