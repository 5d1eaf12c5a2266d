//! Walking over elevation.

mod copies;
mod creases;
mod fields;
mod ground;
mod paths;
mod platforms;
mod refused;
mod walk;
