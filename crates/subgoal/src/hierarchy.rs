//! The choice of a hierarchy.

use std::num::NonZeroU32;

use crate::codec::LEAST_CODE;

/// Which subgoals a search can skip.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Hierarchy {
    /// A contraction hierarchy (Uras & Koenig 2018). All subgoals are ordered but those of a dense core, and
    /// shortcuts are added, so that a search only has to go up from the start and up from the goal.
    #[default]
    Contracted,
    /// This many levels (Uras, Koenig & Hernández 2013). One level is the graph of all subgoals; each further
    /// level keeps only the subgoals without which distances between the others would grow.
    Levels(NonZeroU32),
    /// As many levels as differ.
    AllLevels,
}

impl Hierarchy {
    /// The same, or all levels for so many that the bytes of a graph have no code for them.
    pub(crate) fn with_a_code(self) -> Self {
        match self {
            Self::Levels(levels) if levels.get() >= LEAST_CODE => Self::AllLevels,
            other => other,
        }
    }

    /// The most levels; `None` for a contraction hierarchy.
    pub(crate) const fn levels(self) -> Option<u32> {
        match self {
            Self::Contracted => None,
            Self::Levels(levels) => Some(levels.get()),
            Self::AllLevels => Some(u32::MAX),
        }
    }
}
