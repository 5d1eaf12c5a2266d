//! The tests of the crate, in one binary: each binary is linked separately.

mod cover;
mod legality;
mod rectangle;
mod sweep;
