//! Checks that a motion is one, and that engines search it.

use mediant_grid::Rules;
use mediant_moves::{K, KError};

use crate::{error::Error, motion::Motion, setup_error::SetupError};

impl Motion {
    /// Checks that the k is one.
    pub(crate) fn check_k(self) -> Result<(), Error> {
        match self.refused() {
            // The text of this one says which k there are.
            Some(KError::TooLarge { .. }) => Err(SetupError::Motion { motion: self }.into()),
            Some(error) => Err(error.into()),
            None => Ok(()),
        }
    }

    /// Checks that there are engines that search it.
    pub(crate) fn check(self) -> Result<(), Error> {
        self.check_k()?;
        Ok(self.check_searched()?)
    }

    /// Checks that the k is not too large, and that the rules are for it: between centers a corner rule for
    /// finite k, and a gap rule for any angle.
    pub(crate) fn check_searched(self) -> Result<(), SetupError> {
        match (self.k, self.rules) {
            (K::Finite(k), _) if k.get() > Self::MAX_K => Err(SetupError::Motion { motion: self }),
            (K::Any, Rules::Center(_)) => Err(SetupError::AnyAngleWithCorners),
            (K::Finite(k), Rules::CenterGap(_)) => Err(SetupError::GapBetweenCenters { k }),
            _ => Ok(()),
        }
    }
}
