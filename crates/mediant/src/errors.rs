//! The errors inside an [`Error`](crate::Error), each with its fields; and what the library does not do, for
//! errors of programs that stand on it.

#[cfg(feature = "costs")]
pub use mediant_costs::CostsError;
#[cfg(feature = "walking")]
pub use mediant_costs::WalkingError;
#[cfg(feature = "rasters")]
pub use mediant_formats::SurfaceError;
pub use mediant_formats::{
    IndexError, MapError, RasterError, ReadError, RosError, TileError, TilesError, WriteError,
};
pub use mediant_grid::{GridError, Mismatch, SizeError, names::UnknownName};
pub use mediant_hierarchy::HierarchyError;
pub use mediant_moves::KError;
pub use mediant_search::{BrokenPath, JoinError, JumpError, QueryError, SpacingError};
pub use mediant_subgoal::SubgoalError;

pub use crate::{
    absent::{NO_COSTS, absent},
    setup_error::SetupError,
    setup_error::TextError,
};
