//! The tests of the crate, in one binary: each binary is linked separately.

mod costs;
mod maps;
mod paths;
mod points;
mod points_at_random;
mod rules;
mod visibility;
mod weighted;
mod weighted_elsewhere;
