//! Clusters and segments, computed or read from bytes.

use std::{num::NonZeroU32, sync::Arc};

use mediant_grid::{Centers, GridGraph};
use mediant_hierarchy::{ClusterGraph, Clustering, SegmentGraph};

use super::source::Source;
use crate::{
    configured::{ChpaOptions, ConfiguredEngine, HpaOptions},
    error::EngineError,
    option::Levels,
    setup::Setup,
};

/// The clusters of a setup. Saved clusters must have the side and the levels that the setup names, if it
/// names them.
pub(super) fn clusters(
    setup: Setup,
    own: HpaOptions,
    graph: &GridGraph<Centers>,
    source: Source<'_>,
) -> Result<Arc<ClusterGraph>, EngineError> {
    let levels_of = |own: HpaOptions| match ConfiguredEngine::Hpa(own).levels() {
        Some(Levels::Number(number)) => number.get(),
        _ => Clustering::default().levels,
    };
    let Some(bytes) = source.bytes else {
        let side = setup.engine.side().map_or(Clustering::default().side, NonZeroU32::get);
        return Ok(Arc::new(ClusterGraph::new(graph, Clustering { side, levels: levels_of(own) })?));
    };
    let clusters = ClusterGraph::from_bytes(graph, bytes)?;
    let Clustering { side, levels } = clusters.clustering();
    check_side(own.side, side)?;
    // How many `all` levels are depends on the side.
    let expected = levels_of(HpaOptions { side: NonZeroU32::new(side), ..own });
    if own.levels.is_some() && expected != levels {
        let [expected, found] = [expected, levels]
            .map(|levels| Levels::Number(NonZeroU32::new(levels).unwrap_or(NonZeroU32::MIN)));
        return Err(EngineError::Levels { expected, found });
    }
    Ok(Arc::new(clusters))
}

/// The segments of a setup. Saved segments must have the side that the setup names, if it names one.
pub(super) fn segments(
    own: ChpaOptions,
    graph: &GridGraph<Centers>,
    source: Source<'_>,
) -> Result<Arc<SegmentGraph>, EngineError> {
    let Some(bytes) = source.bytes else {
        let side = own.side.map_or(SegmentGraph::PAPER_SIDE, NonZeroU32::get);
        return Ok(Arc::new(SegmentGraph::new(graph, side)?));
    };
    let segments = SegmentGraph::from_bytes(graph, bytes)?;
    check_side(own.side, segments.side())?;
    Ok(Arc::new(segments))
}

/// Checks the side of a saved index against the one that a setup names.
fn check_side(named: Option<NonZeroU32>, found: u32) -> Result<(), EngineError> {
    match named {
        Some(side) if side.get() != found => Err(EngineError::Side { expected: side.get(), found }),
        _ => Ok(()),
    }
}
