//! Keys of saved indexes.

use mediant_grid::Identity;

use super::{error::IndexError, layout::is_engine_name};
use crate::text::quote;

/// The key of an index: its engine, the version of its payload, and the map, rules of motion and k that it
/// belongs to. All must be the same where it is used.
///
/// Needs the feature `index`.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct IndexKey {
    pub(super) engine: String,
    pub(super) version: u32,
    pub(super) identity: Identity,
}

impl IndexKey {
    /// The key of an index that `engine` built for this identity.
    ///
    /// `engine` is a name of 1 to 16 printable ASCII characters without blanks, `version` the version of its
    /// payload.
    ///
    /// # Errors
    /// [`IndexError::EngineName`] for a name that cannot be saved.
    pub fn new(engine: &str, version: u32, identity: Identity) -> Result<Self, IndexError> {
        if !is_engine_name(engine.as_bytes()) {
            return Err(IndexError::EngineName { found: quote(engine.as_bytes()) });
        }
        Ok(Self { engine: engine.to_owned(), version, identity })
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

    /// The map, the rules of motion and k.
    #[must_use]
    pub const fn identity(&self) -> Identity {
        self.identity
    }
}
