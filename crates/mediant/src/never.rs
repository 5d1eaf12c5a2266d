//! The interrupt of work without limits.

use mediant_grid::Interrupt;

/// Stops nothing.
pub(crate) static NEVER: Interrupt = Interrupt::NEVER;
