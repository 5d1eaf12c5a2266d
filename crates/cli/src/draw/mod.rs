//! Pictures of maps, paths and moves in characters.

pub(crate) mod braille;
mod ground;
mod land;
pub(crate) mod picture;
pub(crate) mod query;
pub(crate) mod star;
pub(crate) mod theme;
