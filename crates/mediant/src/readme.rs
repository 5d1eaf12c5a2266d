//! The examples of the crate's README, compiled and run as documentation tests.

#[doc = include_str!("../README.md")]
struct Readme;
