//! The tests of the crate, in one binary: each binary is linked separately.

mod agents;
mod clearance;
mod components;
mod edits;
mod interrupts;
mod legality;
mod long;
mod points;
mod polygon;
mod rectangle;
mod segments;
mod sweep;
mod widest;
