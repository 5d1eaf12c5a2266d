//! The tests of the crate that see it from outside.

mod common;
mod costmaps;
mod edits;
mod field_edits;
mod fields;
mod landmarks;
mod paths;
mod progress;
mod refused;
mod robots;
mod theta;
mod walking;
