//! Errors of landmarks.

use mediant_grid::{Interrupted, Mismatch};

/// The reason why there are no landmarks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LandmarksError {
    /// No landmark, or too many.
    #[error("{count} landmarks: choose 1 to {}", super::lines::MOST)]
    Count {
        /// The number.
        count: usize,
    },
    /// Landmarks or a change of another graph.
    #[error(transparent)]
    Mismatch(#[from] Mismatch),
    /// Bytes that are no landmarks of the graph.
    #[error("these bytes are no landmarks of this graph: {0}; make them anew")]
    Bytes(&'static str),
    /// It was stopped before it was done.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
}
