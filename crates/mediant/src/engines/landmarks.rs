//! A* guided by landmarks, on costs of cells, and on maps without.

use std::num::NonZeroU32;

#[cfg(feature = "costs")]
pub(super) use self::index::LandmarkIndex;
use crate::{
    engine::Engine,
    option::{
        OptionValue,
        slot::{Field, Options, Slot},
        table::LANDMARKS,
    },
    setup_error::SetupError,
};

/// Options of landmarks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct LandmarkOptions {
    /// The number of landmarks, from 1 to 16: 4, 8 or 16 are made, the first of these that is not less. 8 by
    /// default.
    pub landmarks: Option<NonZeroU32>,
}

impl LandmarkOptions {
    const DEFAULT: NonZeroU32 = NonZeroU32::new(8).unwrap();
    const MAX: u32 = 16;

    fn count(self) -> NonZeroU32 {
        self.landmarks.unwrap_or(Self::DEFAULT)
    }
}

impl Options for LandmarkOptions {
    fn slots(&mut self) -> Vec<Slot<'_>> {
        let value = OptionValue::Number(self.count());
        vec![Slot::new(&LANDMARKS, Field::Number(&mut self.landmarks)).with_value(Some(value))]
    }

    fn check(&self, _: Engine) -> Result<(), SetupError> {
        let (count, max) = (self.count().get(), Self::MAX);
        if count > max { Err(SetupError::Landmarks { count, max }) } else { Ok(()) }
    }
}

#[cfg(feature = "costs")]
mod index {
    use std::{num::NonZeroU32, sync::Arc};

    use mediant_costs::{CostAStar, CostGraph, CostSurface, Landmarks, LandmarksError};
    use mediant_grid::{Grid, Interrupt, Interrupted};

    use super::LandmarkOptions;
    use crate::{
        change::Change,
        configured::ConfiguredEngine,
        engine::Engine,
        engines::{Boxed, EngineIndex, Source, boxed, costs::CostSearch, following, shared, with_options},
        error::Error,
        memory_check,
        setup::Setup,
        space::Space,
    };

    const _: () = assert!(
        LandmarkOptions::DEFAULT.get() as usize == Landmarks::DEFAULT_COUNT
            && LandmarkOptions::MAX as usize == Landmarks::MAX_COUNT
    );

    /// The search graph of a space with its landmarks.
    pub(in crate::engines) struct LandmarkIndex {
        space: Space,
        /// That of the space's costs. Without costs it is one of its own, on which every cell costs 1.
        graph: Arc<CostGraph>,
        landmarks: Arc<Landmarks>,
    }

    /// A graph after a change, and the cells that have changed.
    type Edited = (Arc<CostGraph>, Vec<(u32, u32)>);

    impl LandmarkIndex {
        pub(in crate::engines) fn new(
            space: &Space,
            own: LandmarkOptions,
            source: Source<'_>,
        ) -> Result<Self, Error> {
            let graph = match space.surface() {
                Some(surface) => Arc::clone(&surface.graph),
                None => {
                    let (map, bytes) = (space.map(), size_of::<u32>() as u64);
                    let cells = u64::from(map.width()) * u64::from(map.height());
                    memory_check::check("the index", cells * bytes)?;
                    let surface = Arc::new(CostSurface::uniform(map.grid(), source.interrupt)?);
                    let k = Setup::new(Engine::Landmarks, space.motion()).finite_k()?;
                    Arc::new(CostGraph::new(surface, space.motion().rules, k)?)
                }
            };
            let landmarks = match source.bytes {
                Some(bytes) => Landmarks::from_bytes(&graph, bytes, source.interrupt)?,
                None => {
                    let count = own.count().get() as usize;
                    memory_check::check("the index", Landmarks::bytes(&graph, count) as u64)?;
                    Landmarks::new(&graph, count, source.interrupt)?
                }
            };
            let index = Self { space: space.clone(), graph, landmarks: Arc::new(landmarks) };
            index.check(own)?;
            Ok(index)
        }

        /// Checks that there are as many landmarks as the options name.
        fn check(&self, own: LandmarkOptions) -> Result<(), Error> {
            let found = self.landmarks.count();
            match own.landmarks.map(|count| Landmarks::rounded(count.get() as usize)) {
                Some(expected) if expected != found => {
                    Err(Error::LandmarkCount { expected: expected as u32, found: found as u32 })
                }
                _ => Ok(()),
            }
        }

        /// The graph after a change, and the cells that have changed.
        fn after(&self, change: &Change) -> Result<Edited, Error> {
            if let Some(surface) = change.after().surface() {
                let changed = change.cells_between([self.graph.map(), surface.graph.map()]);
                return Ok((Arc::clone(&surface.graph), changed));
            }
            let [old, new]: [&Grid; 2] = [change.before(), change.after()].map(|space| &**space.map().grid());
            let blocked = |grid: &Grid, (x, y): (u32, u32)| grid.is_blocked(x as i32, y as i32);
            let cells = change.each_cell(new.width(), new.height());
            let changed: Vec<_> = cells.filter(|&at| blocked(old, at) != blocked(new, at)).collect();
            let edits = changed.iter().map(|&(x, y)| (x, y, (!blocked(new, (x, y))).then_some(1.0)));
            let surface = self.graph.map().edit(edits)?;
            Ok((Arc::new(self.graph.after(Arc::new(surface), &changed)?), changed))
        }
    }

    impl EngineIndex for LandmarkIndex {
        fn search(&self) -> Result<Boxed, Error> {
            let (graph, landmarks) = (Arc::clone(&self.graph), Arc::clone(&self.landmarks));
            Ok(boxed(CostSearch::new(CostAStar::with_landmarks(graph, landmarks)?, &self.space)))
        }

        fn follow(&self, search: &mut Boxed) -> Result<bool, Error> {
            following(search, |search: &mut CostSearch<CostAStar>| {
                search.search.follow_with(Arc::clone(&self.graph), Arc::clone(&self.landmarks))?;
                search.follow(&self.space);
                Ok::<_, Error>(())
            })
        }

        fn scratch_bytes(&self) -> usize {
            CostAStar::scratch_bytes(&self.graph)
        }

        fn with_options(&self, engine: ConfiguredEngine) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
            let ConfiguredEngine::Landmarks(own) = engine else { return Ok(None) };
            self.check(own)?;
            let Self { space, graph, landmarks } = self;
            let (graph, landmarks) = (Arc::clone(graph), Arc::clone(landmarks));
            with_options(Ok(Self { space: space.clone(), graph, landmarks }))
        }

        fn memory_bytes(&self) -> usize {
            let of_costs = || self.graph.map().memory_bytes() + self.graph.memory_bytes();
            let graph = if self.space.has_costs() { 0 } else { of_costs() };
            graph + self.landmarks.memory_bytes()
        }

        fn to_bytes(&self, interrupt: &Interrupt) -> Result<Option<Vec<u8>>, Interrupted> {
            match self.landmarks.to_bytes_interruptible(&self.graph, interrupt) {
                Ok(bytes) => Ok(Some(bytes)),
                Err(LandmarksError::Interrupted(interrupted)) => Err(interrupted),
                // They are those of this graph.
                Err(_) => Ok(None),
            }
        }

        fn repaired(
            &self,
            change: &Change,
            interrupt: &Interrupt,
        ) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
            let (graph, cells) = self.after(change)?;
            let repaired = self.landmarks.repaired_if_quicker(&self.graph, &graph, &cells, interrupt)?;
            let space = change.after().clone();
            let index = repaired.map(|landmarks| Self { space, graph, landmarks: Arc::new(landmarks) });
            index.map(|index| shared(Ok(index))).transpose()
        }

        fn as_prepared(&self) -> Option<ConfiguredEngine> {
            Some(ConfiguredEngine::Landmarks(LandmarkOptions { landmarks: self.landmarks() }))
        }

        fn landmarks(&self) -> Option<NonZeroU32> {
            NonZeroU32::new(self.landmarks.count() as u32)
        }
    }
}
