//! Entries for the three tracks of the Grid-Based Path Planning Competition, as its harnesses load them.
//!
//! - *Dynamic* (module `dynamic`): functions of C. The map changes between queries.

#![allow(non_snake_case, reason = "the name of the library is the harness's")]

pub mod dynamic;
