//! From where moves sweep a cell.

use mediant_grid::{Footprint, GridGraph, Placement, Vector};

/// The vertices of which a move of N(k) may sweep a cell, by their offsets from it: all footprints, turned
/// round. Row by row, each once.
pub(super) fn reach<P: Placement>(graph: &GridGraph<P>) -> Box<[Vector]> {
    let mut offsets = Vec::new();
    for step in graph.steps() {
        let Footprint { free, either } = Footprint::new::<P>(graph.rule(), step.vector());
        offsets.extend(free.into_iter().chain(either.into_iter().flatten()).map(|(x, y)| (-y, -x)));
        // All moves of k = 12 sweep half a million cells.
        if offsets.len() > 1 << 16 {
            offsets.sort_unstable();
            offsets.dedup();
        }
    }
    offsets.sort_unstable();
    offsets.dedup();
    offsets.into_iter().map(|(y, x)| Vector::new(x, y)).collect()
}
