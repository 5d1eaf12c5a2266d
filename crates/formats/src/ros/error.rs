//! Why a file does not describe a ROS map.

use crate::{Fraction, WorldError, raster::error::RasterError};

/// A text that does not describe a ROS map, or settings that cannot be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RosError {
    /// The text is not UTF-8.
    #[error("line {line}: expected text in UTF-8, found other bytes; is this the YAML file?")]
    NoText {
        /// The line, from 1.
        line: usize,
    },
    /// A line is none of those that the file can have.
    #[error(
        "line {line}: expected `key: value`, found {found}; write each key on a line of its own, with a \
         colon and a space, all indented alike"
    )]
    Line {
        /// The line, from 1.
        line: usize,
        /// The line, quoted.
        found: String,
    },
    /// A key is there twice.
    #[error("line {line}: the key `{key}` is in line {first} already; remove one of them")]
    Twice {
        /// The line, from 1.
        line: usize,
        /// The key.
        key: &'static str,
        /// The line of the first.
        first: usize,
    },
    /// A key is missing.
    #[error("line {line}: the file ends without the key `{key}`; add `{key}: {example}`")]
    MissingKey {
        /// The line after the last, from 1.
        line: usize,
        /// The key.
        key: &'static str,
        /// A value that it could have.
        example: &'static str,
    },
    /// The value of a key is none of those that it can have.
    #[error(
        "line {line}: expected for `{key}` {expected}, found {found}; write `{key}: {example}`, for example"
    )]
    Value {
        /// The line of the key, from 1.
        line: usize,
        /// The key.
        key: &'static str,
        /// The values that it can have.
        expected: &'static str,
        /// The value, quoted.
        found: String,
        /// A value that it could have.
        example: &'static str,
    },
    /// The threshold for free cells is not below that for occupied ones.
    #[error(
        "{place}: expected a `free_thresh` below `occupied_thresh`, found {free} and {occupied}; \
         0.196 and 0.65 are usual"
    )]
    Crossed {
        /// The line, or `settings`.
        place: String,
        /// The threshold for free cells.
        free: Fraction,
        /// The threshold for occupied cells.
        occupied: Fraction,
    },
    /// Resolution or origin do not place the map in the world.
    #[error("the place of the map: {0}")]
    World(#[from] WorldError),
    /// The picture of a grid cannot be made.
    #[error("the picture of the map: {0}")]
    Raster(#[from] RasterError),
}
