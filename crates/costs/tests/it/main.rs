//! The tests of the crate that see it from outside.

mod common;
mod edits;
mod fields;
mod paths;
mod refused;
