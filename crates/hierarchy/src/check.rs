//! Whether a map and an index fit together.

use std::ops::Range;

use mediant_grid::{Centers, CornerRule, Grid, Lattice};
use mediant_moves::K;

use crate::HierarchyError;

/// Whether there is a hierarchy for these moves.
pub(crate) fn moves(lattice: &Lattice<Centers>) -> Result<(), HierarchyError> {
    match lattice.k() {
        K::FOUR_CONNECTED => Ok(()),
        K::EIGHT_CONNECTED if lattice.rule() == CornerRule::Never => Ok(()),
        k => Err(HierarchyError::Moves { k, rules: lattice.rules() }),
    }
}

/// Whether an index of a map of this size can be one of `grid`.
pub(crate) fn size(expected: (u32, u32), grid: &Grid) -> Result<(), HierarchyError> {
    let found = (grid.width(), grid.height());
    if found == expected { Ok(()) } else { Err(HierarchyError::Size { expected, found }) }
}

/// Whether an index for k and a map of this size can be used on a lattice.
pub(crate) fn lattice(k: K, size: (u32, u32), lattice: &Lattice<Centers>) -> Result<(), HierarchyError> {
    moves(lattice)?;
    self::size(size, lattice.grid())?;
    if lattice.k() == k { Ok(()) } else { Err(HierarchyError::OtherK { expected: k, found: lattice.k() }) }
}

/// What of a rectangle's side lies on the map.
pub(crate) fn span(first: u32, length: u32, cells: u32) -> Range<u32> {
    first..first.saturating_add(length).min(cells)
}
