//! Pictures of maps, paths and moves in characters.

pub(crate) mod braille;
pub(crate) mod file;
mod ground;
pub(crate) mod picture;
pub(crate) mod star;
pub(crate) mod theme;
