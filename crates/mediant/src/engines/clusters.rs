//! HPA*, on clusters of the map.

use std::{num::NonZeroU32, sync::Arc};

use mediant_grid::{Centers, GridGraph, Interrupt, Interrupted};
use mediant_hierarchy::{ClusterGraph, Clustering, HpaStar};

use super::{
    Boxed, EngineIndex, Source, boxed, check_counted, check_levels, check_side, following, shared,
    with_options,
};
#[cfg(feature = "publications")]
use crate::option::published::UNSTRAIGHTENED;
use crate::{
    change::Change,
    configured::ConfiguredEngine,
    engine::Engine,
    error::Error,
    option::{
        Levels, OptionValue, if_published,
        slot::{Field, Options, Slot},
        table::{LEVELS, SIDE},
    },
    setup_error::SetupError,
    space::PlacementOfSpace as _,
};

/// Options of HPA*.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct HpaOptions {
    /// The number of levels of clusters; that of [`Clustering::default`] by default.
    pub levels: Option<Levels>,
    /// The side of the lowest clusters, in cells; that of [`Clustering::default`] by default.
    pub side: Option<NonZeroU32>,
    /// Whether to leave out the straightening of paths.
    #[cfg(feature = "publications")]
    pub unstraightened: bool,
}

impl Options for HpaOptions {
    fn slots(&mut self) -> Vec<Slot<'_>> {
        let Clustering { side, levels } = self.clustering();
        let levels = NonZeroU32::new(levels).map(Levels::Number);
        let (levels, side) =
            (levels.map(OptionValue::Levels), NonZeroU32::new(side).map(OptionValue::Number));
        Vec::from([
            Slot::new(&LEVELS, Field::Levels(&mut self.levels)).with_value(levels),
            Slot::new(&SIDE, Field::Number(&mut self.side)).with_value(side),
            #[cfg(feature = "publications")]
            Slot::new(&UNSTRAIGHTENED, Field::Flag(&mut self.unstraightened)),
        ])
    }

    fn check(&self, engine: Engine) -> Result<(), SetupError> {
        check_counted(engine, self.levels)
    }
}

impl HpaOptions {
    /// The clusters that they name.
    fn clustering(self) -> Clustering {
        let default = Clustering::default();
        let side = self.side.map_or(default.side, NonZeroU32::get);
        let levels = match self.levels {
            Some(Levels::Number(number)) => number.get(),
            // Each level's clusters are twice as long as those of the one below.
            Some(Levels::All) => (Clustering::MAX_SIDE / side).checked_ilog2().unwrap_or(0) + 1,
            _ => default.levels,
        };
        Clustering { side, levels }
    }
}

/// A grid graph with its clusters.
pub(super) struct ClusterIndex {
    own: HpaOptions,
    graph: Arc<GridGraph<Centers>>,
    clusters: Arc<ClusterGraph>,
}

impl ClusterIndex {
    pub(super) fn new(
        own: HpaOptions,
        graph: &Arc<GridGraph<Centers>>,
        source: Source<'_>,
    ) -> Result<Self, Error> {
        let clusters = match source.bytes {
            Some(bytes) => ClusterGraph::from_bytes_interruptible(graph, bytes, source.interrupt)?,
            None => ClusterGraph::interruptible(graph, own.clustering(), source.interrupt)?,
        };
        Self::of(own, graph, Arc::new(clusters))
    }

    /// Checks that the clusters are those that the options name.
    fn of(
        own: HpaOptions,
        graph: &Arc<GridGraph<Centers>>,
        clusters: Arc<ClusterGraph>,
    ) -> Result<Self, Error> {
        let found = clusters.clustering();
        check_side(own.side, found.side)?;
        // The side decides how many `all` levels are.
        let named = HpaOptions { side: NonZeroU32::new(found.side), ..own }.clustering();
        let [named, found] = [named, found].map(|made| NonZeroU32::new(made.levels).map(Levels::Number));
        check_levels(named.filter(|_| own.levels.is_some()), found)?;
        Ok(Self { own, graph: Arc::clone(graph), clusters })
    }
}

impl EngineIndex for ClusterIndex {
    fn search(&self) -> Result<Boxed, Error> {
        let search = HpaStar::new(Arc::clone(&self.graph), Arc::clone(&self.clusters))?;
        Ok(boxed(search.with_straightening(if_published!(!self.own.unstraightened, else true))))
    }

    fn follow(&self, search: &mut Boxed) -> Result<bool, Error> {
        let (graph, clusters) = (Arc::clone(&self.graph), Arc::clone(&self.clusters));
        following(search, |search: &mut HpaStar<_, _>| search.follow(graph, clusters))
    }

    fn scratch_bytes(&self) -> usize {
        HpaStar::scratch_bytes(&self.clusters)
    }

    fn with_options(&self, engine: ConfiguredEngine) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        let ConfiguredEngine::Hpa(own) = engine else { return Ok(None) };
        with_options(Self::of(own, &self.graph, Arc::clone(&self.clusters)))
    }

    fn memory_bytes(&self) -> usize {
        self.clusters.memory_bytes()
    }

    fn to_bytes(&self, interrupt: &Interrupt) -> Result<Option<Vec<u8>>, Interrupted> {
        self.clusters.to_bytes_interruptible(interrupt).map(Some)
    }

    fn repaired(
        &self,
        change: &Change,
        interrupt: &Interrupt,
    ) -> Result<Option<Arc<dyn EngineIndex>>, Error> {
        let graph = Centers::layers(change.after(), Engine::Hpa)?.graph(self.graph.k())?;
        let clusters = self.clusters.repaired(change.of_grid(), interrupt)?;
        shared(Self::of(self.own, graph, Arc::new(clusters))).map(Some)
    }

    fn as_prepared(&self) -> Option<ConfiguredEngine> {
        let mut own = self.own;
        (own.levels, own.side) = (self.levels(), self.side().and_then(NonZeroU32::new));
        Some(ConfiguredEngine::Hpa(own))
    }

    fn levels(&self) -> Option<Levels> {
        NonZeroU32::new(self.clusters.clustering().levels).map(Levels::Number)
    }

    fn side(&self) -> Option<u32> {
        Some(self.clusters.clustering().side)
    }
}
