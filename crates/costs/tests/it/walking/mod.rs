//! Walking over elevation.

mod creases;
mod fields;
mod ground;
mod paths;
mod refused;
mod walk;
