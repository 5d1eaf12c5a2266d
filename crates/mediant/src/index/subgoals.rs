//! Subgoal graphs, computed or read from bytes.

use std::sync::Arc;

use mediant_grid::FreeSpace;
use mediant_subgoal::{Hierarchy, SubgoalGraph, SubgoalPlacement};

use super::source::Source;
use crate::{
    configured::ConfiguredEngine,
    error::{EngineError, SetupError},
    option::Levels,
    setup::Setup,
};

/// The subgoal graph of a setup. A saved graph must have the levels that the setup names, if it names them;
/// Sub-Theta* needs levels in any case.
pub(super) fn graph<P: SubgoalPlacement>(
    setup: Setup,
    space: &FreeSpace<P>,
    source: Source<'_>,
) -> Result<Arc<SubgoalGraph<P>>, EngineError> {
    let (ConfiguredEngine::Subgoal(own) | ConfiguredEngine::SubgoalTheta(own)) = setup.engine else {
        return Err(SetupError::without_index(setup.engine.kind()).into());
    };
    let expected: Hierarchy = setup.engine.levels().unwrap_or(Levels::Contracted).into();
    let Some(bytes) = source.bytes else {
        let progress = |step| (source.progress)(step);
        return Ok(Arc::new(SubgoalGraph::with_progress(space, setup.k, expected, &progress)?));
    };
    let graph = SubgoalGraph::from_bytes(space, setup.k, bytes)?;
    let found = graph.hierarchy();
    let needs_levels =
        matches!(setup.engine, ConfiguredEngine::SubgoalTheta(_)) && found == Hierarchy::Contracted;
    if expected != found && (own.levels.is_some() || needs_levels) {
        let [expected, found] = [expected, found].map(Levels::from);
        return Err(EngineError::Levels { expected, found });
    }
    Ok(Arc::new(graph))
}
