//! The commands of the program, a file each.

pub(crate) mod build;
pub(crate) mod demo;
pub(crate) mod distances;
pub(crate) mod engines;
pub(crate) mod moves;
pub(crate) mod run;
