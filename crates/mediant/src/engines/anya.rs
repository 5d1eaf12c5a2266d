//! Anya, which leaves out dead ends if they were found.

use std::sync::Arc;

use mediant_grid::{Corners, FreeSpace, Interrupt};
use mediant_moves::K;
use mediant_search::{Anya, DeadEnds, EuclideanNorm, LatticeNorm, Norm};

use super::{Boxed, EngineIndex, Source, boxed, following, shared};
use crate::{
    change::Change,
    configured::ConfiguredEngine,
    engine::Engine,
    error::Error,
    memory_check,
    setup::Setup,
    space::{PlacementOfSpace as _, Space},
};

/// A free space, and its dead ends.
#[derive(Clone)]
pub(super) struct AnyaIndex {
    space: Arc<FreeSpace<Corners>>,
    k: K,
    /// `None` for a single path.
    dead_ends: Option<Arc<DeadEnds>>,
}

impl AnyaIndex {
    pub(super) fn new(space: &Arc<FreeSpace<Corners>>, k: K, source: Source<'_>) -> Result<Self, Error> {
        let dead_ends = if source.for_one_path {
            None
        } else {
            memory_check::check("the index", DeadEnds::bytes(space) as u64)?;
            Some(Arc::new(DeadEnds::interruptible(space, source.interrupt)?))
        };
        Ok(Self { space: Arc::clone(space), k, dead_ends })
    }

    fn follow_by<N: Norm + Send + 'static>(&self, search: &mut Boxed) -> Result<bool, Error> {
        following(search, |search: &mut Anya<_, N>| {
            search.follow(Arc::clone(&self.space), self.dead_ends.clone())
        })
    }
}

impl EngineIndex for AnyaIndex {
    fn search(&self) -> Result<Boxed, Error> {
        let space = Arc::clone(&self.space);
        Ok(match (self.k, self.dead_ends.clone()) {
            (K::Any, None) => boxed(Anya::new(space)),
            (K::Any, Some(dead_ends)) => boxed(Anya::new(space).without(dead_ends)?),
            (K::Finite(k), None) => boxed(Anya::over(space, k)?),
            (K::Finite(k), Some(dead_ends)) => boxed(Anya::over(space, k)?.without(dead_ends)?),
        })
    }

    fn follow(&self, search: &mut Boxed) -> Result<bool, Error> {
        match self.k {
            K::Any => self.follow_by::<EuclideanNorm>(search),
            K::Finite(_) => self.follow_by::<LatticeNorm>(search),
        }
    }

    fn scratch_bytes(&self) -> usize {
        let dead_ends = self.dead_ends.as_ref().map_or(0, |dead_ends| dead_ends.scratch_bytes());
        Anya::scratch_bytes(&self.space) + dead_ends
    }

    fn with_options(&self, engine: ConfiguredEngine) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        Ok(if engine == ConfiguredEngine::Anya { Some(Arc::new(self.clone())) } else { None })
    }

    fn memory_bytes(&self) -> usize {
        self.dead_ends.as_ref().map_or(0, |dead_ends| dead_ends.memory_bytes())
    }

    /// Dead ends are the same for every k.
    fn for_k(
        &self,
        setup: Setup,
        space: &Space,
        _source: Source<'_>,
    ) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        let Some(dead_ends) = &self.dead_ends else { return Ok(None) };
        let (space, dead_ends) =
            (Arc::clone(&Corners::layers(space, Engine::Anya)?.free), Some(Arc::clone(dead_ends)));
        shared(Ok(Self { space, k: setup.k(), dead_ends })).map(Some)
    }

    /// Paths cost what they cost with dead ends that are found anew. The light build finds them anew: to
    /// repair them takes as much code as the search.
    fn repaired(
        &self,
        change: &Change,
        interrupt: &Interrupt,
    ) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        let space = Arc::clone(&Corners::layers(change.after(), Engine::Anya)?.free);
        let dead_ends = match &self.dead_ends {
            None => None,
            Some(_) if !cfg!(feature = "all-engines") => return Ok(None),
            Some(known) => Some(Arc::new(known.repaired(&space, change.of_grid(), interrupt)?)),
        };
        shared(Ok(Self { space, k: self.k, dead_ends })).map(Some)
    }

    fn is_for_one_path(&self) -> bool {
        self.dead_ends.is_none()
    }
}
