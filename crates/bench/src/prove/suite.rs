//! Suites: families and laws by their names.

use std::fmt;

use mediant::{Error, Motion};

use super::{Pace, families, families::Family, laws::Law, tally::Tally, terrain::Terrain};

/// A family of problems, or a law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Suite {
    Family(Family),
    Law(Law),
}

impl Suite {
    /// All of them, in the order in which they are proven.
    pub(super) fn all() -> Vec<Self> {
        Family::all().into_iter().map(Self::Family).chain(Law::ALL.map(Self::Law)).collect()
    }

    pub(super) const fn is_law(self) -> bool {
        matches!(self, Self::Law(_))
    }

    /// Every so-manieth instance belongs to it.
    pub(super) const fn every(self) -> usize {
        match self {
            Self::Family(_) => 1,
            Self::Law(law) => law.every(),
        }
    }

    /// Whether it takes seconds, not minutes, on one map of a set: it is in the sample then.
    pub(super) fn is_quick_on(self, set: &str) -> bool {
        let (is_small, is_noise) = (["dao", "street"].contains(&set), set == "random");
        match self {
            Self::Family(family) if family.is_of_many_moves() => is_small,
            Self::Family(family) => !is_noise || !family.has_subgoals(),
            Self::Law(Law::OrderAtCenters) => is_small,
            Self::Law(Law::Repaired | Law::Threads) => !is_noise,
            Self::Law(_) => true,
        }
    }

    /// Proves it on a terrain. `only` is the number of the one motion of a family that is asked in a sample.
    pub(super) fn prove(
        self,
        (of, terrain): (&str, &Terrain),
        only: Option<usize>,
        pace: Pace,
        tally: &mut Tally,
    ) -> Result<(), Error> {
        match self {
            Self::Family(family) => {
                let mut motions: Vec<Motion> = family.motions();
                if let Some(only) = only {
                    motions = vec![motions[only % motions.len()]];
                }
                families::prove(&motions, (of, terrain), pace, tally)
            }
            Self::Law(law) => law.prove(of, terrain, tally),
        }
    }
}

impl fmt::Display for Suite {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Family(family) => family.fmt(f),
            Self::Law(law) => law.fmt(f),
        }
    }
}
