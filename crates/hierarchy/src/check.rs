//! Whether a map and an index fit together.

use std::ops::Range;

use mediant_grid::{Centers, CornerRule, Grid, GridGraph};
use mediant_moves::FiniteK;

use crate::HierarchyError;

/// Whether there is a hierarchy for these moves.
pub(crate) fn moves(grid_graph: &GridGraph<Centers>) -> Result<(), HierarchyError> {
    match grid_graph.k() {
        FiniteK::N4 => Ok(()),
        FiniteK::N8 if grid_graph.rule() == CornerRule::Never => Ok(()),
        k => Err(HierarchyError::Moves { k, rules: grid_graph.rules() }),
    }
}

/// Whether an index of a map of this size can be one of `grid`.
pub(crate) fn size(expected: (u32, u32), grid: &Grid) -> Result<(), HierarchyError> {
    let found = (grid.width(), grid.height());
    if found == expected { Ok(()) } else { Err(HierarchyError::Size { expected, found }) }
}

/// Whether an index for k and a map of this size can be used on a grid graph.
pub(crate) fn grid_graph(
    k: FiniteK,
    size: (u32, u32),
    grid_graph: &GridGraph<Centers>,
) -> Result<(), HierarchyError> {
    moves(grid_graph)?;
    self::size(size, grid_graph.grid())?;
    if grid_graph.k() == k {
        Ok(())
    } else {
        Err(HierarchyError::OtherK { expected: k, found: grid_graph.k() })
    }
}

/// What of a rectangle's side lies on the map.
pub(crate) fn span(first: u32, length: u32, cells: u32) -> Range<u32> {
    first..first.saturating_add(length).min(cells)
}
