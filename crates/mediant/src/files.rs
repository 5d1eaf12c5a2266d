//! Map files: how pictures are read, and where maps are in the world.

pub use mediant_formats::{
    Fraction, FractionError, ImageOptions, MapFormat, MapSource, Unknown, WorldError, WorldFrame,
};
