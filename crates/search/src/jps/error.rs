//! Errors of jump tables and jump finders.

use mediant_grid::{Interrupted, Mismatch, Vector, Vertex};
use mediant_moves::KError;

/// A jump table that there is not, that belongs to another grid graph, or whose bytes are wrong.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum JumpError {
    /// No jump table for this k.
    #[error("a jump table needs k = 2 or 3: {0}")]
    K(#[from] KError),
    /// Something that was made for another grid graph.
    #[error(transparent)]
    Mismatch(#[from] Mismatch),
    /// Bytes that do not begin with what they belong to.
    #[error("these bytes are no jump table: they do not begin with what they belong to; build it anew")]
    Bytes,
    /// Too few or too many bytes.
    #[error(
        "a jump table of {found} bytes, where that of this graph has {expected}: it is cut off; build it anew"
    )]
    Length {
        /// The number of bytes needed after what they belong to.
        expected: usize,
        /// The number of bytes given.
        found: usize,
    },
    /// A list of jumps that does not fit the map.
    #[error(
        "the jump table has {found:#010x} in its list of jumps from {at}, where a path arrives by move \
         ({}, {}), and that of this graph has {expected:#010x}: the table is damaged; build it anew",
        by.x,
        by.y
    )]
    Entry {
        /// The vertex of the list.
        at: Vertex,
        /// The move by which a path arrives there.
        by: Vector,
        /// The word that follows from the map.
        expected: u32,
        /// The word given.
        found: u32,
    },
    /// It was stopped before it was done.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
}
