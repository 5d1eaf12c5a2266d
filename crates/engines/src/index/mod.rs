//! What an engine prepares of a map.

mod hierarchies;
mod subgoals;

use std::sync::Arc;

use mediant_grid::{Centers, Corners, FreeSpace, GridGraph};
use mediant_hierarchy::{ClusterGraph, Clustering, SegmentGraph};
use mediant_search::{JumpTable, Pruning, Smoothing, parts::BlockFinder};
use mediant_subgoal::{Progress, SubgoalGraph, SubgoalPlacement};

use crate::{
    Engine, EngineError, EngineOption, Levels, OptionValue, SearchSpace, Setup, SharedRules, Variant,
    engine::{LEVELS, SIDE},
    rules::Shared,
    setup::without_index,
    space::no_space,
};

/// What an engine prepares of a map before the first query, in its search space: nothing, a pruning rule, a jump table, a
/// subgoal graph, clusters or segments. Immutable; clones share it. [`planner`](Self::planner) makes planners on it.
///
/// ```
/// use std::sync::Arc;
/// use mediant_engines::{Index, SearchSpace, Setup, SharedRules};
/// use mediant_grid::Grid;
/// use mediant_search::Query;
///
/// let grid = Arc::new(Grid::from_fn(9, 9, |x, y| x == 4 && y != 8)?);
/// let setup: Setup = "subgoal:any:open".parse()?;
/// let space = SearchSpace::new(setup, &grid)?;
/// let index = Index::new(setup, &space, &SharedRules::new())?;
/// let outcome = index.planner()?.solve(Query::new((0, 0), (9, 0)))?;
/// assert!(outcome.path().is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Index {
    setup: Setup,
    pub(crate) prepared: Prepared,
}

/// What is prepared in each kind of space.
#[derive(Clone, Debug)]
pub(crate) enum Prepared {
    Centers(Arc<GridGraph<Centers>>, Parts<Centers>),
    Corners(Arc<GridGraph<Corners>>, Parts<Corners>),
    AnyAngle(Arc<FreeSpace<Corners>>, Parts<Corners>),
}

/// What is prepared under a placement.
#[derive(Clone, Debug)]
pub(crate) enum Parts<P: SubgoalPlacement> {
    Nothing,
    Pruning(Arc<Pruning<P>>),
    Blocks(Arc<Pruning<P>>, BlockFinder),
    Table(Arc<Pruning<P>>, Arc<JumpTable>),
    Subgoals(Arc<SubgoalGraph<P>>),
    /// Only at centers.
    Clusters(Arc<ClusterGraph>),
    /// Only at centers.
    Segments(Arc<SegmentGraph>),
}

/// Where an index comes from.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    /// The bytes of a saved one; a new one is made without them.
    bytes: Option<&'a [u8]>,
    rules: &'a SharedRules,
    progress: &'a (dyn Fn(Progress) + Sync),
}

impl Index {
    /// Prepares what a setup needs in a space.
    ///
    /// # Errors
    /// [`EngineError`] for a setup that does not exist, or a space for another k or other rules.
    pub fn new(setup: Setup, space: &SearchSpace, rules: &SharedRules) -> Result<Self, EngineError> {
        Self::with_progress(setup, space, rules, &|_| {})
    }

    /// [`new`](Self::new), reporting its progress from any thread. Engines that prepare quickly report nothing.
    ///
    /// # Errors
    /// Those of [`new`](Self::new).
    pub fn with_progress(
        setup: Setup,
        space: &SearchSpace,
        rules: &SharedRules,
        progress: &(dyn Fn(Progress) + Sync),
    ) -> Result<Self, EngineError> {
        Self::from_source(setup, space, Source { bytes: None, rules, progress })
    }

    /// Reads what [`to_bytes`](Self::to_bytes) gave.
    ///
    /// # Errors
    /// Those of [`new`](Self::new), and for bytes that are no index of this engine for this space.
    pub fn from_bytes(
        setup: Setup,
        space: &SearchSpace,
        rules: &SharedRules,
        bytes: &[u8],
    ) -> Result<Self, EngineError> {
        setup.check()?;
        setup.index_version()?;
        Self::from_source(setup, space, Source { bytes: Some(bytes), rules, progress: &|_| {} })
    }

    fn from_source(setup: Setup, space: &SearchSpace, source: Source<'_>) -> Result<Self, EngineError> {
        space.check(setup)?;
        let prepared = match space {
            SearchSpace::Centers(graph) => {
                let parts = match setup.engine {
                    Engine::Hpa(own) => Parts::Clusters(hierarchies::clusters(setup, own, graph, source)?),
                    Engine::Chpa(own) => Parts::Segments(hierarchies::segments(own, graph, source)?),
                    _ => on_graph(setup, graph, source)?,
                };
                Prepared::Centers(Arc::clone(graph), parts)
            }
            SearchSpace::Corners(graph) => {
                Prepared::Corners(Arc::clone(graph), on_graph(setup, graph, source)?)
            }
            SearchSpace::AnyAngle(space) => {
                let parts = match setup.engine {
                    Engine::Subgoal(_) => Parts::Subgoals(subgoals::graph(setup, space, source)?),
                    _ => Parts::Nothing,
                };
                Prepared::AnyAngle(Arc::clone(space), parts)
            }
        };
        Ok(Self { setup, prepared })
    }

    /// The setup that it was made for.
    #[must_use]
    pub const fn setup(&self) -> Setup {
        self.setup
    }

    /// The same index for planners that smooth their paths in another way, or not at all.
    #[must_use]
    pub fn with_smoothing(self, smoothing: Option<Smoothing>) -> Self {
        Self { setup: Setup { smoothing, ..self.setup }, ..self }
    }

    /// Its bytes, for [`from_bytes`](Self::from_bytes).
    ///
    /// # Errors
    /// [`EngineError::Setup`] for an engine whose index is not saved.
    pub fn to_bytes(&self) -> Result<Vec<u8>, EngineError> {
        let none = || without_index(self.setup.engine.kind()).into();
        match &self.prepared {
            Prepared::Centers(_, parts) => parts.to_bytes(),
            Prepared::Corners(_, parts) | Prepared::AnyAngle(_, parts) => parts.to_bytes(),
        }
        .ok_or_else(none)
    }

    /// The memory that it takes beyond the search space, in bytes.
    #[must_use]
    pub fn memory_bytes(&self) -> u64 {
        let bytes = match &self.prepared {
            Prepared::Centers(_, parts) => parts.memory_bytes(),
            Prepared::Corners(_, parts) | Prepared::AnyAngle(_, parts) => parts.memory_bytes(),
        };
        bytes as u64
    }

    /// The value of an option ([`Engine::value`]), for levels and sides as they are in the index, which a saved one decides.
    #[must_use]
    pub fn value(&self, option: &EngineOption) -> Option<OptionValue> {
        let (levels, side) = match &self.prepared {
            Prepared::Centers(_, parts) => parts.shape(),
            Prepared::Corners(_, parts) | Prepared::AnyAngle(_, parts) => parts.shape(),
        };
        match option.name {
            name if name == LEVELS.name => levels.map(OptionValue::Levels),
            name if name == SIDE.name => side.and_then(std::num::NonZeroU32::new).map(OptionValue::Number),
            _ => self.setup.engine.value(option),
        }
    }
}

impl<P: SubgoalPlacement> Parts<P> {
    fn to_bytes(&self) -> Option<Vec<u8>> {
        match self {
            Self::Nothing | Self::Pruning(_) | Self::Blocks(..) => None,
            Self::Table(_, table) => Some(table.as_bytes().to_vec()),
            Self::Subgoals(graph) => Some(graph.to_bytes()),
            Self::Clusters(graph) => Some(graph.to_bytes()),
            Self::Segments(graph) => Some(graph.to_bytes()),
        }
    }

    fn memory_bytes(&self) -> usize {
        match self {
            Self::Nothing => 0,
            Self::Pruning(pruning) => pruning.memory_bytes(),
            Self::Blocks(pruning, blocks) => pruning.memory_bytes() + blocks.memory_bytes(),
            Self::Table(pruning, table) => pruning.memory_bytes() + table.memory_bytes(),
            Self::Subgoals(graph) => graph.memory_bytes(),
            Self::Clusters(graph) => graph.memory_bytes(),
            Self::Segments(graph) => graph.memory_bytes(),
        }
    }

    /// Its levels, and the side of its lowest clusters or of its segments in cells.
    fn shape(&self) -> (Option<Levels>, Option<u32>) {
        match self {
            Self::Nothing | Self::Pruning(_) | Self::Blocks(..) | Self::Table(..) => (None, None),
            Self::Subgoals(graph) => (Some(graph.hierarchy().into()), None),
            Self::Clusters(graph) => {
                let Clustering { side, levels } = graph.clustering();
                (std::num::NonZeroU32::new(levels).map(Levels::Number), Some(side))
            }
            Self::Segments(graph) => (None, Some(graph.side())),
        }
    }
}

/// What is prepared of a grid graph, under either placement.
fn on_graph<P: SubgoalPlacement + Shared>(
    setup: Setup,
    graph: &GridGraph<P>,
    source: Source<'_>,
) -> Result<Parts<P>, EngineError> {
    let pruning = || source.rules.pruning(graph);
    Ok(match setup.engine {
        Engine::AStar(_) | Engine::Dijkstra | Engine::Wavefront | Engine::Theta(_) | Engine::LazyTheta(_) => {
            Parts::Nothing
        }
        Engine::Canonical(own) if own.variant == Some(Variant::Paper) => Parts::Nothing,
        Engine::Canonical(_) | Engine::Jps(_) => Parts::Pruning(pruning()),
        Engine::JpsBlock(_) => {
            let pruning = pruning();
            let blocks = BlockFinder::new(graph, &pruning)?;
            Parts::Blocks(pruning, blocks)
        }
        Engine::JpsPlus(_) => {
            let table = match source.bytes {
                None => JumpTable::new(graph)?,
                Some(bytes) => JumpTable::from_bytes(graph, bytes.to_vec())?,
            };
            Parts::Table(pruning(), Arc::new(table))
        }
        Engine::Subgoal(_) | Engine::SubgoalTheta(_) => {
            Parts::Subgoals(subgoals::graph(setup, graph, source)?)
        }
        Engine::Anya | Engine::Hpa(_) | Engine::Chpa(_) => return Err(no_space(setup)),
    })
}
