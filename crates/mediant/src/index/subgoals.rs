//! Subgoal graphs, computed or read from bytes.

use std::sync::Arc;

use mediant_grid::FreeSpace;
use mediant_subgoal::{SubgoalGraph, SubgoalPlacement};

use super::source::Source;
use crate::{error::Error, option::Levels, setup::Setup};

/// The subgoal graph of a setup.
pub(super) fn graph<P: SubgoalPlacement>(
    setup: Setup,
    space: &FreeSpace<P>,
    source: Source<'_>,
) -> Result<Arc<SubgoalGraph<P>>, Error> {
    if let Some(bytes) = source.bytes {
        return Ok(Arc::new(SubgoalGraph::from_bytes(space, setup.k, bytes)?));
    }
    let hierarchy = setup.engine.levels().unwrap_or(Levels::Contracted).into();
    let progress = |step| (source.progress)(step);
    Ok(Arc::new(SubgoalGraph::with_progress(space, setup.k, hierarchy, &progress)?))
}
