//! The tests of the crate that see it from outside.
