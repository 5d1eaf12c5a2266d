//! What an engine prepares of a map.

mod hierarchies;
mod parts;
mod source;
mod subgoals;

use std::{num::NonZeroU32, sync::Arc};

use mediant_grid::GridGraph;
use mediant_search::{JumpTable, Smoothing, parts::BlockFinder};
use mediant_subgoal::{Progress, SubgoalPlacement};

pub(crate) use self::parts::{Parts, Prepared};
use self::source::Source;
use crate::{
    configured::ConfiguredEngine,
    error::{EngineError, SetupError},
    option::{
        EngineOption, OptionValue, Variant,
        description::{LEVELS, SIDE},
    },
    setup::Setup,
    shared_rules::{Shared, SharedRules},
    space::{Space, no_space},
};

/// What an engine prepares in a search space before the first query: nothing, a pruning rule, a jump table, a
/// subgoal graph, clusters or segments. Immutable; clones share it. [`planner`](Self::planner) makes the
/// planners on it.
///
/// ```
/// use std::sync::Arc;
/// use mediant::{Index, Space, Setup, SharedRules};
/// use mediant_grid::Grid;
/// use mediant_search::Query;
///
/// let grid = Arc::new(Grid::from_fn(9, 9, |x, y| x == 4 && y != 8)?);
/// let setup: Setup = "subgoal:any:open".parse()?;
/// let space = Space::new(setup, &grid)?;
/// let index = Index::new(setup, &space, &SharedRules::new())?;
/// let outcome = index.planner()?.solve(Query::new((0, 0), (9, 0)))?;
/// assert!(outcome.path().is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Index {
    setup: Setup,
    /// The search space, and what is prepared in it.
    pub(crate) prepared: Prepared,
}

impl Index {
    /// Prepares what a setup's engine needs.
    ///
    /// # Errors
    /// [`EngineError`] for a setup whose parts do not fit together, a search space for another k or other
    /// rules, or clusters or segments of a size or number that does not exist.
    pub fn new(setup: Setup, space: &Space, rules: &SharedRules) -> Result<Self, EngineError> {
        Self::with_progress(setup, space, rules, &|_| {})
    }

    /// [`new`](Self::new), which calls `progress` from any thread. Only subgoal graphs report progress.
    ///
    /// # Errors
    /// Those of [`new`](Self::new).
    pub fn with_progress(
        setup: Setup,
        space: &Space,
        rules: &SharedRules,
        progress: &(dyn Fn(Progress) + Sync),
    ) -> Result<Self, EngineError> {
        Self::from_source(setup, space, Source { bytes: None, rules, progress })
    }

    /// Reads the bytes that [`to_bytes`](Self::to_bytes) wrote. Levels and side that the setup leaves out are
    /// those of the bytes.
    ///
    /// # Errors
    /// Those of [`new`](Self::new), and for bytes that are not an index of this engine for this search space,
    /// or have other levels or another side than the setup names. Not all damage is found: a file format
    /// should add a checksum.
    pub fn from_bytes(
        setup: Setup,
        space: &Space,
        rules: &SharedRules,
        bytes: &[u8],
    ) -> Result<Self, EngineError> {
        setup.check()?;
        setup.index_version()?;
        Self::from_source(setup, space, Source { bytes: Some(bytes), rules, progress: &|_| {} })
    }

    /// Prepares a new index, or reads a saved one.
    fn from_source(setup: Setup, space: &Space, source: Source<'_>) -> Result<Self, EngineError> {
        space.check(setup)?;
        let prepared = match space {
            Space::Centers(graph) => {
                let parts = match setup.engine {
                    ConfiguredEngine::Hpa(own) => {
                        Parts::Clusters(hierarchies::clusters(setup, own, graph, source)?)
                    }
                    ConfiguredEngine::Chpa(own) => {
                        Parts::Segments(hierarchies::segments(own, graph, source)?)
                    }
                    _ => on_graph(setup, graph, source)?,
                };
                Prepared::Centers(Arc::clone(graph), parts)
            }
            Space::Corners(graph) => Prepared::Corners(Arc::clone(graph), on_graph(setup, graph, source)?),
            Space::AnyAngle(space) => {
                let parts = match setup.engine {
                    ConfiguredEngine::Subgoal(_) => Parts::Subgoals(subgoals::graph(setup, space, source)?),
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

    /// The same index for planners with this smoothing, or with none.
    #[must_use]
    pub fn with_smoothing(self, smoothing: Option<Smoothing>) -> Self {
        Self { setup: Setup { smoothing, ..self.setup }, ..self }
    }

    /// The bytes that [`from_bytes`](Self::from_bytes) reads.
    ///
    /// # Errors
    /// [`EngineError::Setup`] for an engine whose index is not saved.
    pub fn to_bytes(&self) -> Result<Vec<u8>, EngineError> {
        match &self.prepared {
            Prepared::Centers(_, parts) => parts.to_bytes(),
            Prepared::Corners(_, parts) | Prepared::AnyAngle(_, parts) => parts.to_bytes(),
        }
        .ok_or_else(|| SetupError::without_index(self.setup.engine.kind()).into())
    }

    /// The memory that it uses beyond the search space, in bytes.
    #[must_use]
    pub fn memory_bytes(&self) -> u64 {
        let bytes = match &self.prepared {
            Prepared::Centers(_, parts) => parts.memory_bytes(),
            Prepared::Corners(_, parts) | Prepared::AnyAngle(_, parts) => parts.memory_bytes(),
        };
        bytes as u64
    }

    /// The value of an option, as [`ConfiguredEngine::value`], but levels and side as they are in the index: where the
    /// setup leaves them out, a saved index decides them.
    #[must_use]
    pub fn value(&self, option: &EngineOption) -> Option<OptionValue> {
        let (levels, side) = match &self.prepared {
            Prepared::Centers(_, parts) => parts.shape(),
            Prepared::Corners(_, parts) | Prepared::AnyAngle(_, parts) => parts.shape(),
        };
        match option.name {
            name if name == LEVELS.name => levels.map(OptionValue::Levels),
            name if name == SIDE.name => side.and_then(NonZeroU32::new).map(OptionValue::Number),
            _ => self.setup.engine.value(option),
        }
    }
}

/// What an engine prepares of a grid graph, if it takes either placement.
fn on_graph<P: SubgoalPlacement + Shared>(
    setup: Setup,
    graph: &GridGraph<P>,
    source: Source<'_>,
) -> Result<Parts<P>, EngineError> {
    let pruning = || source.rules.pruning(graph);
    Ok(match setup.engine {
        ConfiguredEngine::AStar(_)
        | ConfiguredEngine::Dijkstra
        | ConfiguredEngine::Wavefront
        | ConfiguredEngine::Theta(_)
        | ConfiguredEngine::LazyTheta(_) => Parts::Nothing,
        ConfiguredEngine::Canonical(own) if own.variant == Some(Variant::Paper) => Parts::Nothing,
        ConfiguredEngine::Canonical(_) | ConfiguredEngine::Jps(_) => Parts::Pruning(pruning()?),
        ConfiguredEngine::JpsBlock(_) => {
            let pruning = pruning()?;
            let blocks = BlockFinder::new(graph, &pruning)?;
            Parts::Blocks(pruning, blocks)
        }
        ConfiguredEngine::JpsPlus(_) => {
            let table = match source.bytes {
                None => JumpTable::new(graph)?,
                Some(bytes) => JumpTable::from_bytes(graph, bytes.to_vec())?,
            };
            Parts::Table(pruning()?, Arc::new(table))
        }
        ConfiguredEngine::Subgoal(_) | ConfiguredEngine::SubgoalTheta(_) => {
            Parts::Subgoals(subgoals::graph(setup, graph, source)?)
        }
        ConfiguredEngine::Anya | ConfiguredEngine::Hpa(_) | ConfiguredEngine::Chpa(_) => {
            return Err(no_space(setup));
        }
    })
}
