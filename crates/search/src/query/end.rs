//! The word for one end of a path.

use std::fmt;

/// One of the two ends of a query.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum End {
    /// Its start.
    Start,
    /// Its goal.
    Goal,
}

impl fmt::Display for End {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Start => "start",
            Self::Goal => "goal",
        })
    }
}
