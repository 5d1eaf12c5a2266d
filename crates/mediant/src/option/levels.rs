//! The levels of a subgoal graph or of clusters, and what subgoals have instead.

use std::{fmt, num::NonZeroU32, str::FromStr};

use mediant_subgoal::Hierarchy;

/// The levels of a subgoal graph or of clusters. As text a number, `all`, `contracted`
/// or `labels`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Levels {
    /// At most this many; 1 is a graph without a hierarchy.
    Number(NonZeroU32),
    /// As many as possible.
    All,
    /// A contraction hierarchy instead of levels; only subgoal graphs have one.
    Contracted,
    /// Hub labels instead of levels: queries without a search; only subgoals have them.
    Labels,
}

/// The error for a text that is no [`Levels`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected a whole number from 1 to {}, all, contracted or labels", u32::MAX)]
pub struct UnknownLevels {
    /// The text found there.
    pub found: String,
}

impl Levels {
    /// In words: `a contraction hierarchy`, `hub labels`, `1 level`, `2 levels`, `all levels`.
    #[must_use]
    pub fn in_words(self) -> String {
        match self {
            Self::Contracted => "a contraction hierarchy".to_owned(),
            Self::Labels => "hub labels".to_owned(),
            Self::Number(NonZeroU32::MIN) => "1 level".to_owned(),
            Self::Number(_) | Self::All => format!("{self} levels"),
        }
    }
}

impl Levels {
    /// The hierarchy of a subgoal graph; `None` for hub labels, which are no graph.
    pub(crate) const fn hierarchy(self) -> Option<Hierarchy> {
        match self {
            Self::Number(number) => Some(Hierarchy::Levels(number)),
            Self::All => Some(Hierarchy::AllLevels),
            Self::Contracted => Some(Hierarchy::Contracted),
            Self::Labels => None,
        }
    }
}

impl From<Hierarchy> for Levels {
    fn from(hierarchy: Hierarchy) -> Self {
        match hierarchy {
            Hierarchy::Contracted => Self::Contracted,
            Hierarchy::Levels(number) => Self::Number(number),
            Hierarchy::AllLevels => Self::All,
        }
    }
}

impl fmt::Display for Levels {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => number.fmt(f),
            Self::All => f.pad("all"),
            Self::Contracted => f.pad("contracted"),
            Self::Labels => f.pad("labels"),
        }
    }
}

impl FromStr for Levels {
    type Err = UnknownLevels;

    fn from_str(text: &str) -> Result<Self, UnknownLevels> {
        match text {
            "all" => Ok(Self::All),
            "contracted" => Ok(Self::Contracted),
            "labels" => Ok(Self::Labels),
            _ => text.parse().map(Self::Number).map_err(|_| UnknownLevels { found: text.to_owned() }),
        }
    }
}
