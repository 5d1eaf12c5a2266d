//! Checks of what is handed in: moves, sizes, and whether a grid graph and an index belong together.

use mediant_grid::{Centers, Change, CornerRule, GridGraph, Identity, Mismatch};
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

/// Checks that an index is that of a grid graph.
pub(crate) fn belongs(index: Identity, grid_graph: &GridGraph<Centers>) -> Result<(), Mismatch> {
    index.check(INDEX, ("the grid graph", grid_graph.identity()))
}

/// Checks that an index, after a repair, can be that of a grid graph: that both have the same moves.
pub(crate) fn same_moves(index: Identity, grid_graph: &GridGraph<Centers>) -> Result<(), Mismatch> {
    let of_any_map = belongs(Identity { map: None, ..index }, grid_graph);
    of_any_map.map_err(|other| Mismatch { belongs_to: index, ..other })
}

/// Checks that an index is that of the map before a change.
pub(crate) fn change(index: Identity, change: &Change) -> Result<(), Mismatch> {
    let before = Identity { map: Some(change.before().id()), ..index };
    index.check(INDEX, ("the map before the change", before))
}

/// Checks that a grid graph is that of the map after a change.
pub(crate) fn after(grid_graph: &GridGraph<Centers>, change: &Change) -> Result<(), Mismatch> {
    let found = grid_graph.identity();
    let after = Identity { map: Some(change.after().id()), ..found };
    found.check("the grid graph", ("the map after the change", after))
}

/// The bytes behind the identity with which those of an index begin, if that is the grid graph's.
pub(crate) fn after_identity<'b>(
    bytes: &'b [u8],
    grid_graph: &GridGraph<Centers>,
) -> Result<&'b [u8], HierarchyError> {
    let (found, rest) = Identity::split_from(bytes)
        .ok_or(HierarchyError::Bytes("they do not begin with what they belong to"))?;
    found.check_equal(INDEX, ("the grid graph", grid_graph.identity()))?;
    Ok(rest)
}

/// The name of an index in errors.
const INDEX: &str = "the index";

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
    use mediant_grid::Grid;

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
