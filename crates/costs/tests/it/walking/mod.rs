//! Walking over elevation.

mod fields;
mod ground;
mod paths;
mod refused;
mod walk;
