//! Map files: how they are read, and where maps are in the world.

pub use mediant_formats::{
    Fraction, FractionError, MapFormat, MapOptions, MapSource, RosVersion, Tiles, Unknown, WorldError,
    WorldFrame,
};
#[cfg(feature = "rasters")]
pub use mediant_formats::{Georeference, Samples, Surface, SurfaceFormat, SurfaceOptions, read_surface};
