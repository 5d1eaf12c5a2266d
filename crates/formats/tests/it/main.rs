//! The tests of all formats, with every feature of the crate.

mod damage;
mod dynamic;
mod fixtures;
mod fuzz;
mod identity;
mod index;
mod map;
mod picture;
#[path = "../png_chunks.rs"]
mod png_chunks;
mod raster;
mod read;
mod ros;
mod save;
mod scenario;
mod source;
mod surface;
mod trace;
mod world;
