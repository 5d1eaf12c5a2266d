//! Kramm, Rivera, Hernández & Baier 2018: how much longer than at any angle paths over N(k) are, by proof and
//! on maps.

pub(crate) mod bounds;
mod center;
pub(crate) mod ratios;

/// The factor by which a ratio may exceed its bound, since sums are rounded.
const SLACK: f64 = 1.0 + 1e-9;
