//! The hierarchies against their definitions, slow references and new indexes, on seeded random maps.

mod chains;
mod clusters;
mod common;
mod complete;
mod follow;
mod identity;
mod index;
mod interrupts;
mod repair;
mod segments;
mod shared;
mod snapshots;
