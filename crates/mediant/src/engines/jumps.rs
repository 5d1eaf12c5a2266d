//! Jump point search, vertex by vertex and by blocks; JPS+ adds [lists](super::jps_plus) to it.

#[cfg(feature = "publications")]
use std::num::NonZeroU32;
use std::sync::Arc;

use mediant_grid::{Change as GridChange, GridGraph, Interrupt, Interrupted, Placement};
use mediant_search::{
    Pruning,
    parts::{BlockFinder, JumpFinder, JumpParent, JumpPointSearch, NodeStore, StepwiseFinder},
};

use super::{Boxed, EngineIndex, Source, boxed, following, shared, with_options};
#[cfg(feature = "publications")]
use crate::option::{
    published::{JUMP_LIMIT, KEEP_INTERMEDIATE},
    slot::Field,
};
use crate::{
    change::Change,
    configured::ConfiguredEngine,
    engine::Engine,
    error::Error,
    heuristic::Admissible,
    memory_check,
    option::{
        HeuristicName, if_published,
        slot::{Options, Slot},
    },
    shared_rules::{self, Shared},
    space::PlacementOfSpace,
};

/// Options of JPS, scanning vertex by vertex or block by block.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct JumpOptions {
    /// The heuristic; h_k by default.
    pub heuristic: Option<HeuristicName>,
    /// The most steps that a jump may take; unlimited by default.
    #[cfg(feature = "publications")]
    pub jump_limit: Option<NonZeroU32>,
    /// Whether to keep intermediate jump points, at which a path only turns on its way to another jump point.
    #[cfg(feature = "publications")]
    pub keep_intermediate: bool,
}

impl Options for JumpOptions {
    fn slots(&mut self) -> Vec<Slot<'_>> {
        Vec::from([
            Slot::heuristic(&mut self.heuristic),
            #[cfg(feature = "publications")]
            Slot::new(&JUMP_LIMIT, Field::Number(&mut self.jump_limit)),
            #[cfg(feature = "publications")]
            Slot::new(&KEEP_INTERMEDIATE, Field::Flag(&mut self.keep_intermediate)),
        ])
    }
}

impl JumpOptions {
    /// The most steps of a jump, and whether intermediate jump points are kept.
    fn published(self) -> (Option<u32>, bool) {
        if_published!((self.jump_limit.map(NonZeroU32::get), self.keep_intermediate), else (None, false))
    }
}

/// A grid graph with its pruning rule, and what finds jump points.
pub(super) struct JumpIndex<P: Placement, J> {
    graph: Arc<GridGraph<P>>,
    pruning: Arc<Pruning<P>>,
    finder: J,
    heuristic: Admissible,
    own: JumpOptions,
}

/// The finder of jump points of one of the engines.
pub(super) trait EngineFinder<P: Placement>: JumpFinder<P> + Clone + Send + Sync {
    /// The engine.
    const ENGINE: Engine;

    /// The options, if they are the engine's.
    fn options(engine: ConfiguredEngine) -> Option<JumpOptions>;

    /// The memory that it uses, in bytes.
    fn memory_bytes(&self) -> usize;

    /// Whether it left out what does not pay for a single path.
    fn is_for_one_path(&self) -> bool {
        false
    }

    /// The finder on the grid graph after a change of the map; `None` if it must be made anew.
    fn repaired(
        &self,
        _on: (&GridGraph<P>, &Pruning<P>),
        _change: &GridChange,
        _interrupt: &Interrupt,
    ) -> Result<Option<Self>, Error> {
        Ok(None)
    }

    /// The bytes of a saved index; `None` for an engine whose index is not saved.
    fn to_bytes(&self, _interrupt: &Interrupt) -> Result<Option<Vec<u8>>, Interrupted> {
        Ok(None)
    }
}

impl<P: Shared> JumpIndex<P, StepwiseFinder> {
    pub(super) fn stepwise(
        graph: &Arc<GridGraph<P>>,
        own: JumpOptions,
        source: Source<'_>,
    ) -> Result<Self, Error> {
        Self::new(graph, shared_rules::pruning(graph, source.interrupt)?, StepwiseFinder, own)
    }
}

impl<P: Shared> JumpIndex<P, BlockFinder> {
    pub(super) fn by_blocks(
        graph: &Arc<GridGraph<P>>,
        own: JumpOptions,
        source: Source<'_>,
    ) -> Result<Self, Error> {
        let pruning = shared_rules::pruning(graph, source.interrupt)?;
        memory_check::check("the index", BlockFinder::bytes(graph) as u64)?;
        let blocks = if source.for_one_path {
            BlockFinder::for_few_searches(graph, &pruning, source.interrupt)?
        } else {
            BlockFinder::interruptible(graph, &pruning, source.interrupt)?
        };
        Self::new(graph, pruning, blocks, own)
    }
}

impl<P: Placement, J: EngineFinder<P>> JumpIndex<P, J> {
    pub(super) fn new(
        graph: &Arc<GridGraph<P>>,
        pruning: Arc<Pruning<P>>,
        finder: J,
        own: JumpOptions,
    ) -> Result<Self, Error> {
        let heuristic = Admissible::new(J::ENGINE, own.heuristic)?;
        Ok(Self { graph: Arc::clone(graph), pruning, finder, heuristic, own })
    }
}

impl<P: PlacementOfSpace, J: EngineFinder<P> + 'static> EngineIndex for JumpIndex<P, J> {
    fn search(&self) -> Result<Boxed, Error> {
        let (graph, pruning) = (Arc::clone(&self.graph), Arc::clone(&self.pruning));
        let search = JumpPointSearch::with_finder(graph, pruning, self.finder.clone(), self.heuristic)?;
        let (limit, keep_intermediate) = self.own.published();
        Ok(boxed(search.with_jump_limit(limit).with_intermediate(keep_intermediate)))
    }

    fn follow(&self, search: &mut Boxed) -> Result<bool, Error> {
        let (graph, pruning) = (Arc::clone(&self.graph), Arc::clone(&self.pruning));
        following(search, |search: &mut JumpPointSearch<_, Admissible, P, J>| {
            search.follow(graph, pruning, self.finder.clone())
        })
    }

    fn scratch_bytes(&self) -> usize {
        NodeStore::<JumpParent>::bytes(self.graph.vertex_count())
    }

    fn with_options(&self, engine: ConfiguredEngine) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        let Some(own) = J::options(engine) else { return Ok(None) };
        with_options(Self::new(&self.graph, Arc::clone(&self.pruning), self.finder.clone(), own))
    }

    fn memory_bytes(&self) -> usize {
        self.pruning.memory_bytes() + self.finder.memory_bytes()
    }

    fn is_for_one_path(&self) -> bool {
        self.finder.is_for_one_path()
    }

    fn to_bytes(&self, interrupt: &Interrupt) -> Result<Option<Vec<u8>>, Interrupted> {
        self.finder.to_bytes(interrupt)
    }

    fn repaired(
        &self,
        change: &Change,
        interrupt: &Interrupt,
    ) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        let graph = P::layers(change.after(), J::ENGINE)?.graph(self.graph.k())?;
        let Some(pruning) = shared_rules::repaired(&self.pruning, graph, change, interrupt)? else {
            return Ok(None);
        };
        let finder = self.finder.repaired((graph, &pruning), change.of_grid(), interrupt)?;
        finder.map(|finder| shared(Self::new(graph, pruning, finder, self.own))).transpose()
    }
}

impl<P: Placement> EngineFinder<P> for StepwiseFinder {
    const ENGINE: Engine = Engine::Jps;

    fn options(engine: ConfiguredEngine) -> Option<JumpOptions> {
        if let ConfiguredEngine::Jps(own) = engine { Some(own) } else { None }
    }

    fn memory_bytes(&self) -> usize {
        0
    }

    fn repaired(
        &self,
        _on: (&GridGraph<P>, &Pruning<P>),
        _change: &GridChange,
        _interrupt: &Interrupt,
    ) -> Result<Option<Self>, Error> {
        Ok(Some(Self))
    }
}

impl<P: Placement> EngineFinder<P> for BlockFinder {
    const ENGINE: Engine = Engine::JpsBlock;

    fn options(engine: ConfiguredEngine) -> Option<JumpOptions> {
        if let ConfiguredEngine::JpsBlock(own) = engine { Some(own) } else { None }
    }

    fn memory_bytes(&self) -> usize {
        self.memory_bytes()
    }

    fn is_for_one_path(&self) -> bool {
        self.is_for_few_searches()
    }

    /// The light build leaves this out: its code is as large as that of a search.
    #[cfg(feature = "all-engines")]
    fn repaired(
        &self,
        (graph, pruning): (&GridGraph<P>, &Pruning<P>),
        change: &GridChange,
        interrupt: &Interrupt,
    ) -> Result<Option<Self>, Error> {
        Ok(Some(self.repaired(graph, pruning, change, interrupt)?))
    }
}
