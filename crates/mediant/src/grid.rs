//! The bit-packed map and its parts, for those who look below a [`Map`](crate::Map).

pub use mediant_grid::{Clearance, Fit, Grid, Identity, MapId, Obstruction, Outside};
pub use mediant_moves::Vector;
