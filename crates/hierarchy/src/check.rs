//! Checks of what is handed in: moves, sizes, and whether a grid graph and an index belong together.

use mediant_grid::{Centers, CornerRule, Grid, GridGraph};
use mediant_moves::FiniteK;

use crate::HierarchyError;

/// Checks that there are hierarchies for the moves of a grid graph.
pub(crate) fn moves(grid_graph: &GridGraph<Centers>) -> Result<(), HierarchyError> {
    match grid_graph.k() {
        FiniteK::N4 => Ok(()),
        FiniteK::N8 if grid_graph.rule() == CornerRule::Never => Ok(()),
        k => Err(HierarchyError::Moves { k, rules: grid_graph.rules() }),
    }
}

/// Checks that a map has the size of an index's map.
pub(crate) fn size(expected: (u32, u32), grid: &Grid) -> Result<(), HierarchyError> {
    let found = (grid.width(), grid.height());
    if found == expected { Ok(()) } else { Err(HierarchyError::Size { expected, found }) }
}

/// Checks that an index for k, of a map of this size, can be used on a grid graph.
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

/// Checks that so many nodes or segments can be addressed. On 64 bits every map's can, on 32 bits not those
/// of small clusters on the largest maps.
pub(crate) fn address_space(count: u64) -> Result<(), HierarchyError> {
    fits(count, isize::MAX as u64)
}

/// Index and planner take at most so many bytes for each node or segment, in one allocation.
const BYTES_EACH: u64 = 32;

fn fits(count: u64, bytes: u64) -> Result<(), HierarchyError> {
    if count <= bytes / BYTES_EACH { Ok(()) } else { Err(HierarchyError::TooLarge { count }) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn on_32_bits_small_clusters_of_large_maps_do_not_fit() {
        let max = i32::MAX as u64;
        assert_eq!(fits(8192 * 4096, max), Ok(()));
        let all = u64::from(Grid::MAX_SIDE).pow(2);
        assert_eq!(fits(all, max), Err(HierarchyError::TooLarge { count: all }));
        assert_eq!(fits(all, i64::MAX as u64), Ok(()));
    }
}
