//! Checks that a motion is one, and that engines search it.

use mediant_grid::PlacementKind;
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

    /// Checks that the k is not too large, and that it is not any angle between centers.
    pub(crate) fn check_searched(self) -> Result<(), SetupError> {
        let is_searched = match self.k {
            K::Finite(k) => k.get() <= Self::MAX_K,
            K::Any => self.rules.placement() == PlacementKind::Corner,
        };
        if is_searched { Ok(()) } else { Err(SetupError::Motion { motion: self }) }
    }
}
