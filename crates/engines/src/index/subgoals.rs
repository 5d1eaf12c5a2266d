//! Subgoal graphs, made or read.

use std::sync::Arc;

use mediant_grid::FreeSpace;
use mediant_subgoal::{Hierarchy, SubgoalGraph, SubgoalPlacement};

use super::Source;
use crate::{Engine, EngineError, Levels, Setup, setup::without_index};

/// The subgoal graph of a setup: a new one, or a saved one, which must have the levels that the setup names; a setup that
/// names none takes those that there are.
pub(super) fn graph<P: SubgoalPlacement>(
    setup: Setup,
    space: &FreeSpace<P>,
    source: Source<'_>,
) -> Result<Arc<SubgoalGraph<P>>, EngineError> {
    let (Engine::Subgoal(own) | Engine::SubgoalTheta(own)) = setup.engine else {
        return Err(without_index(setup.engine.kind()).into());
    };
    let expected: Hierarchy = setup.engine.levels().unwrap_or(Levels::Contracted).into();
    let Some(bytes) = source.bytes else {
        let progress = |step| (source.progress)(step);
        return Ok(Arc::new(SubgoalGraph::with_progress(space, setup.k, expected, &progress)?));
    };
    let graph = SubgoalGraph::from_bytes(space, setup.k, bytes)?;
    let found = graph.hierarchy();
    let needs_levels = matches!(setup.engine, Engine::SubgoalTheta(_)) && found == Hierarchy::Contracted;
    if expected != found && (own.levels.is_some() || needs_levels) {
        let [expected, found] = [expected, found].map(Levels::from);
        return Err(EngineError::Levels { expected, found });
    }
    Ok(Arc::new(graph))
}
