//! The tests of the search crate that see it from outside. One binary, so that it is linked once; what needs
//! an allocator of its own is in `../scratch.rs`.

mod any_angle_fields;
mod anya;
mod canonical;
mod common;
mod dead_ends;
mod events;
mod exact;
mod exhaustive;
mod field_changes;
mod fields;
mod follow;
mod heuristics;
mod identity;
mod interrupts;
mod jumps;
mod kramm2018;
mod open_list;
mod path;
mod path_change;
mod points;
mod queries;
mod replanning;
mod smoothing;
mod snapshots;
mod theta;
mod wavefront;
