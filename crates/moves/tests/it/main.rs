//! The tests of the crate, in one binary: each binary is linked separately.

#[cfg(feature = "alloc")]
mod api;
#[cfg(feature = "alloc")]
mod common;
#[cfg(feature = "alloc")]
mod cost;
#[cfg(feature = "alloc")]
mod hormazabal2017;
mod k;
#[cfg(feature = "alloc")]
mod kramm2018;
#[cfg(feature = "alloc")]
mod kramm2018_trees;
#[cfg(feature = "alloc")]
mod rivera2017;
