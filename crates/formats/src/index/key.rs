//! What an index was built for.

use std::fmt;

use mediant_grid::{Grid, Rules, load};
use sha2::{Digest, Sha256};

use crate::text::quote;

use super::{DIGEST_BYTES, IndexError, header};

/// What tells a map from others: its size, and the SHA-256 of its size and cells.
///
/// The digest is over width and height as `u32`, then each row as ⌈width / 64⌉ words `u64`, all little endian; bit
/// x mod 64 of word ⌊x / 64⌋ is 1 where cell x of the row is blocked, and bits beyond the row are 0.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct MapDigest {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) digest: [u8; DIGEST_BYTES],
}

impl MapDigest {
    /// The digest of a map.
    #[must_use]
    pub fn of(grid: &Grid) -> Self {
        let (rows, width, height) = (grid.rows(), grid.width(), grid.height());
        let mut digest = Sha256::new();
        digest.update(width.to_le_bytes());
        digest.update(height.to_le_bytes());
        for y in 0..height as i32 {
            for x in (0..width).step_by(64) {
                let within = !0_u64 >> (64 - (width - x).min(64));
                digest.update((load(rows.words(), rows.index(x as i32, y)) & within).to_le_bytes());
            }
        }
        Self { width, height, digest: digest.finalize().into() }
    }

    /// The number of columns of the map.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// The number of rows of the map.
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.height
    }

    /// The SHA-256.
    #[must_use]
    pub const fn as_bytes(&self) -> &[u8; 32] {
        &self.digest
    }
}

/// The size and the first digits of the digest.
impl fmt::Display for MapDigest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} × {} cells, digest ", self.width, self.height)?;
        self.digest[..6].iter().try_for_each(|byte| write!(f, "{byte:02x}"))?;
        f.write_str("…")
    }
}

impl fmt::Debug for MapDigest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "MapDigest({self})")
    }
}

/// What an index was built for: all that must be the same where it is used.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct IndexKey {
    pub(super) engine: String,
    pub(super) version: u32,
    pub(super) rules: Rules,
    pub(super) k: Option<u32>,
    pub(super) map: MapDigest,
}

impl IndexKey {
    /// The key of an index of `engine` (1 to 16 printable ASCII characters without blanks), whose payload has this `version`,
    /// for `grid` under `rules` and N(k), `None` being any-angle.
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
        if !header::is_engine_name(engine.as_bytes()) {
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
