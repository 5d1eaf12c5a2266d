//! The digest of a map.

use std::fmt;

use mediant_grid::{Grid, load};
use sha2::{Digest, Sha256};

use super::layout::DIGEST_BYTES;

/// Identifies a map: its size, and the SHA-256 of its size and cells.
///
/// Needs the feature `index`.
///
/// The digest is over width and height as `u32`, then each row as ⌈width / 64⌉ words `u64`, all little
/// endian; bit x mod 64 of word ⌊x / 64⌋ is 1 where cell x of the row is blocked, and bits beyond the row are
/// 0.
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
