//! The levels of a subgoal graph, as options and tables have them.

use std::{fmt, num::NonZeroU32, str::FromStr};

use mediant_subgoal::Hierarchy;

/// How many levels a subgoal graph is to have: a number, or `all`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Levels {
    /// At most so many; 1 is the graph of all subgoals.
    Number(NonZeroU32),
    /// As many as there are.
    All,
}

/// A text that is no [`Levels`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected a number from 1 to {}, or all, found `{found}`", u32::MAX)]
pub struct UnknownLevels {
    /// What was found.
    pub found: String,
}

impl Levels {
    /// Those of a hierarchy of levels; none of a contraction hierarchy.
    #[must_use]
    pub const fn of(hierarchy: Hierarchy) -> Option<Self> {
        match hierarchy {
            Hierarchy::Contracted => None,
            Hierarchy::Levels(number) => Some(Self::Number(number)),
            Hierarchy::AllLevels => Some(Self::All),
        }
    }
}

impl From<Levels> for Hierarchy {
    fn from(levels: Levels) -> Self {
        match levels {
            Levels::Number(number) => Self::Levels(number),
            Levels::All => Self::AllLevels,
        }
    }
}

impl fmt::Display for Levels {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => number.fmt(f),
            Self::All => f.pad("all"),
        }
    }
}

impl FromStr for Levels {
    type Err = UnknownLevels;

    fn from_str(text: &str) -> Result<Self, UnknownLevels> {
        match text {
            "all" => Ok(Self::All),
            _ => text.parse().map(Self::Number).map_err(|_| UnknownLevels { found: text.to_owned() }),
        }
    }
}

/// A hierarchy in words: `a contraction hierarchy`, `1 level`, `2 levels`, `all levels`.
#[must_use]
pub fn hierarchy_name(hierarchy: Hierarchy) -> String {
    match Levels::of(hierarchy) {
        None => "a contraction hierarchy".to_owned(),
        Some(Levels::Number(NonZeroU32::MIN)) => "1 level".to_owned(),
        Some(levels) => format!("{levels} levels"),
    }
}
