//! The tests of all formats, with every feature of the crate.

mod fuzz;
mod identity;
mod index;
mod map;
mod read;
mod scenario;
mod trace;
