//! Clusters and segments, computed or read from bytes.

use std::{num::NonZeroU32, sync::Arc};

use mediant_grid::{Centers, GridGraph};
use mediant_hierarchy::{ClusterGraph, Clustering, SegmentGraph};

use super::source::Source;
use crate::{
    configured::{ChpaOptions, ConfiguredEngine},
    error::Error,
    option::Levels,
};

/// The clusters of a setup's engine.
pub(super) fn clusters(
    engine: ConfiguredEngine,
    graph: &GridGraph<Centers>,
    source: Source<'_>,
) -> Result<Arc<ClusterGraph>, Error> {
    if let Some(bytes) = source.bytes {
        return Ok(Arc::new(ClusterGraph::from_bytes_interruptible(graph, bytes, source.interrupt)?));
    }
    let default = Clustering::default();
    let levels = match engine.levels() {
        Some(Levels::Number(number)) => number.get(),
        _ => default.levels,
    };
    let side = engine.side().map_or(default.side, NonZeroU32::get);
    Ok(Arc::new(ClusterGraph::interruptible(graph, Clustering { side, levels }, source.interrupt)?))
}

/// The segments of CHPA* with these options.
pub(super) fn segments(
    own: ChpaOptions,
    graph: &GridGraph<Centers>,
    source: Source<'_>,
) -> Result<Arc<SegmentGraph>, Error> {
    let Some(bytes) = source.bytes else {
        let side = own.side.map_or(SegmentGraph::PAPER_SIDE, NonZeroU32::get);
        return Ok(Arc::new(SegmentGraph::interruptible(graph, side, source.interrupt)?));
    };
    Ok(Arc::new(SegmentGraph::from_bytes(graph, bytes)?))
}
