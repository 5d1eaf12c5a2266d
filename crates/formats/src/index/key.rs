//! What an index was built for.

use mediant_grid::{Grid, Rules};

use super::{digest::MapDigest, error::IndexError, layout::is_engine_name};
use crate::text::quote;

/// What an index was built for: engine, version, rules of motion, k and map. All must be the same where it is
/// used.
///
/// Needs the feature `index`.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct IndexKey {
    pub(super) engine: String,
    pub(super) version: u32,
    pub(super) rules: Rules,
    pub(super) k: Option<u32>,
    pub(super) map: MapDigest,
}

impl IndexKey {
    /// The key of an index that `engine` built for `grid` under `rules` and N(k), `None` for any-angle.
    ///
    /// `engine` is a name of 1 to 16 printable ASCII characters without blanks, `version` the version of its
    /// payload.
    ///
    /// # Errors
    /// [`IndexError::EngineName`] for a name that cannot be saved.
    pub fn new(
        engine: &str,
        version: u32,
        rules: Rules,
        k: Option<u32>,
        grid: &Grid,
    ) -> Result<Self, IndexError> {
        if !is_engine_name(engine.as_bytes()) {
            return Err(IndexError::EngineName { found: quote(engine.as_bytes()) });
        }
        Ok(Self { engine: engine.to_owned(), version, rules, k, map: MapDigest::of(grid) })
    }

    /// The engine's name.
    #[must_use]
    pub fn engine(&self) -> &str {
        &self.engine
    }

    /// The version of the engine's payload.
    #[must_use]
    pub const fn version(&self) -> u32 {
        self.version
    }

    /// The rules of motion.
    #[must_use]
    pub const fn rules(&self) -> Rules {
        self.rules
    }

    /// The k of the neighborhood; `None` for any-angle.
    #[must_use]
    pub const fn k(&self) -> Option<u32> {
        self.k
    }

    /// The map.
    #[must_use]
    pub const fn map(&self) -> MapDigest {
        self.map
    }
}
