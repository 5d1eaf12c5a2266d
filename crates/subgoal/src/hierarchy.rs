//! The choice of a hierarchy.

use std::num::NonZeroU32;

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
