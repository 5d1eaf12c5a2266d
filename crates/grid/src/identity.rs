//! Identities of maps and of everything prepared on them, which decide what may be joined.

use std::fmt;

use mediant_moves::{FiniteK, K};

use crate::{
    BitMatrix, Rectangle, Rules,
    interrupt::{Interrupt, Interrupted},
};

/// The identity of a map: its size, and a digest of its cells.
///
/// Maps with the same cells have the same identity, on every run and platform. Two others have the same one
/// with a probability of about 2⁻¹²⁸; the digest is not made to withstand forgery.
///
/// ```
/// use mediant_grid::{Grid, Rectangle};
/// let map = Grid::from_fn(5, 4, |x, y| x == y)?;
/// let at = Rectangle { x: 2, y: 0, width: 1, height: 1 };
/// let edited = map.with_rectangle(at, |_, _| true);
/// assert_ne!(edited.id(), map.id());
/// assert_eq!(edited.with_rectangle(at, |_, _| false).id(), map.id());
/// # Ok::<(), mediant_grid::GridError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct MapId {
    width: u32,
    height: u32,
    /// The sum of a digest of each word of the map, modulo 2¹²⁸: an edit changes only its own words' terms.
    /// Four words of 32 bits, lowest first, so that errors that name two identities stay small.
    digest: [u32; 4],
}

/// The size, and the digest's first eight digits.
impl fmt::Display for MapId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [.., high] = self.digest;
        write!(f, "map {high:08x} of {} columns and {} rows", self.width, self.height)
    }
}

impl MapId {
    pub(crate) fn new(rows: &BitMatrix, interrupt: &Interrupt) -> Result<Self, Interrupted> {
        const BAND: u32 = 64;
        let (width, height) = (rows.width(), rows.height());
        let mut id = Self { width, height, digest: [0; 4] };
        for y in (0..height).step_by(BAND as usize) {
            interrupt.check("digesting the map")?;
            id = id.plus(sum(rows, Rectangle { x: 0, y, width, height: BAND.min(height - y) }));
        }
        Ok(id)
    }

    /// The number of columns and of rows.
    #[must_use]
    pub const fn size(self) -> (u32, u32) {
        (self.width, self.height)
    }

    /// This after the word of row y from column x on, a multiple of 64, has changed.
    pub(crate) fn with_word(self, (x, y): (u32, u32), words: [u64; 2]) -> Self {
        self.with_term(position(x / 64, y), words)
    }

    /// The identity of a map of this size that is no grid of bits, before its words are in it.
    #[doc(hidden)]
    #[must_use]
    pub const fn of_size(width: u32, height: u32) -> Self {
        Self { width, height, digest: [0; 4] }
    }

    /// This after the word at a position has changed.
    #[doc(hidden)]
    #[must_use]
    pub fn with_term(self, position: u64, [before, after]: [u64; 2]) -> Self {
        self.plus(term(position, after).wrapping_sub(term(position, before)))
    }

    fn plus(self, terms: u128) -> Self {
        let digest = self.digest.iter().rev().fold(0, |digest, &word| digest << 32 | u128::from(word));
        let sum: u128 = digest.wrapping_add(terms);
        Self { digest: [0, 32, 64, 96].map(|shift| (sum >> shift) as u32), ..self }
    }
}

/// The sum of the terms of the words that a rectangle on the map touches.
fn sum(rows: &BitMatrix, at: Rectangle) -> u128 {
    let words = at.x / 64..(at.x + at.width).div_ceil(64);
    (at.y..at.y + at.height).fold(0, |sum: u128, y| {
        let row = rows.row(y as i32);
        words
            .clone()
            .fold(sum, |sum, word| sum.wrapping_add(term(position(word, y), row.word(64 * word as i32))))
    })
}

/// The position of a word by its number in its row.
const fn position(word: u32, y: u32) -> u64 {
    (y as u64) << 32 | word as u64
}

/// The digest of one word at its position.
const fn term(position: u64, word: u64) -> u128 {
    let key = mix(position ^ 0x243f_6a88_85a3_08d3);
    let low = mix(word ^ key);
    let high = mix(word.wrapping_add(key).rotate_left(32) ^ 0x1319_8a2e_0370_7344);
    (high as u128) << 64 | low as u128
}

/// The finalizer of `SplitMix64` (Steele, Lea & Flood 2014): a bijection in which each bit depends on all.
const fn mix(word: u64) -> u64 {
    let word = word.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let word = (word ^ word >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let word = (word ^ word >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    word ^ word >> 31
}

/// The map, the placement with its rule of motion, and the k that something belongs to. Everything that is
/// prepared carries it, and every constructor that joins two things compares them, in constant time.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{Corners, DiagonalGap, FreeSpace, Grid, GridGraph};
/// use mediant_moves::FiniteK;
/// let grid = Arc::new(Grid::from_fn(5, 4, |x, y| x == y)?);
/// let space = FreeSpace::<Corners>::new(Arc::clone(&grid), DiagonalGap::Open);
/// let [four, five] = [FiniteK::N16, FiniteK::N32].map(|k| GridGraph::in_space(&space, k));
/// let (four, five) = (four?.identity(), five?.identity());
/// // A free space serves every k.
/// assert!(four.check("one", ("another", space.identity())).is_ok());
/// let wrong = four.check("the graph", ("the other graph", five)).unwrap_err();
/// assert!(wrong.to_string().contains("k = 4") && wrong.to_string().contains("k = 5"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Identity {
    /// The map; `None` for what serves every map.
    pub map: Option<MapId>,
    /// The placement and its rule of motion.
    pub rules: Rules,
    /// The neighborhood; `None` for what serves every k.
    pub k: Option<K>,
}

impl fmt::Display for Identity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.map {
            Some(map) => write!(f, "{map}")?,
            None => f.write_str("every map")?,
        }
        write!(f, ", {}, ", self.rules)?;
        match self.k {
            Some(k) => write!(f, "k = {k}"),
            None => f.write_str("every k"),
        }
    }
}

/// Two things that do not belong together: of another map, placement, rule of motion or k.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
#[error(
    "{prepared} is for {belongs_to}; {other} is for {other_belongs_to}: use {prepared} with what it was made for, or \
     make a new one"
)]
pub struct Mismatch {
    /// The name of the first, such as 'the planner'.
    pub prepared: &'static str,
    /// The identity of the first.
    pub belongs_to: Identity,
    /// The name of the other.
    pub other: &'static str,
    /// The identity of the other.
    pub other_belongs_to: Identity,
}

impl Identity {
    /// The length of [`to_bytes`](Self::to_bytes).
    pub const BYTES: usize = 32;

    /// Checks that something of this identity, called `prepared`, may be used with `other`: that their maps,
    /// rules and k agree as far as both have them.
    ///
    /// # Errors
    /// [`Mismatch`] if they do not.
    pub fn check(
        self,
        prepared: &'static str,
        (other, other_belongs_to): (&'static str, Self),
    ) -> Result<(), Mismatch> {
        fn agree<T: PartialEq>(one: Option<T>, other: Option<T>) -> bool {
            one.zip(other).is_none_or(|(one, other)| one == other)
        }
        let theirs = other_belongs_to;
        if self.rules == theirs.rules && agree(self.map, theirs.map) && agree(self.k, theirs.k) {
            return Ok(());
        }
        Err(Mismatch { prepared, belongs_to: self, other, other_belongs_to })
    }

    /// [`check`](Self::check) for bytes, of which none serve every map or every k: that the two are equal.
    ///
    /// # Errors
    /// [`Mismatch`] if they are not.
    pub fn check_equal(
        self,
        prepared: &'static str,
        (other, other_belongs_to): (&'static str, Self),
    ) -> Result<(), Mismatch> {
        if self == other_belongs_to {
            return Ok(());
        }
        Err(Mismatch { prepared, belongs_to: self, other, other_belongs_to })
    }

    /// The identity with which bytes begin, and the bytes after it; `None` if they begin with none.
    #[must_use]
    pub fn split_from(bytes: &[u8]) -> Option<(Self, &[u8])> {
        let (identity, rest) = bytes.split_first_chunk()?;
        Some((Self::from_bytes(*identity)?, rest))
    }

    /// The identity as bytes: width, height, four words of digest, rules and k, each a little-endian `u32`. A
    /// width of 0 stands for every map, a k of 0 for every k, and of 2³² − 1 for k = ∞.
    #[must_use]
    pub fn to_bytes(self) -> [u8; Self::BYTES] {
        let MapId { width, height, digest: [a, b, c, d] } =
            self.map.unwrap_or(MapId { width: 0, height: 0, digest: [0; 4] });
        let k = match self.k {
            None => 0,
            Some(K::Finite(k)) => k.get(),
            Some(K::Any) => u32::MAX,
        };
        let words = [width, height, a, b, c, d, self.rules.number() as u32, k];
        let mut bytes = [0; Self::BYTES];
        let bytes_of_words = words.into_iter().flat_map(u32::to_le_bytes);
        bytes.iter_mut().zip(bytes_of_words).for_each(|(to, byte)| *to = byte);
        bytes
    }

    /// The identity from its bytes; `None` if they stand for none. Each identity has one form: bytes that are
    /// read are those that [`to_bytes`](Self::to_bytes) writes.
    #[must_use]
    pub fn from_bytes(bytes: [u8; Self::BYTES]) -> Option<Self> {
        let (words, _) = bytes.as_chunks::<4>();
        let [width, height, a, b, c, d, rules, k] = std::array::from_fn(|at| u32::from_le_bytes(words[at]));
        let map = MapId { width, height, digest: [a, b, c, d] };
        let k = match k {
            0 => None,
            u32::MAX => Some(K::Any),
            k => Some(K::Finite(FiniteK::new(k).ok()?)),
        };
        let rules = Rules::of_number(rules as usize)?;
        let identity = Self { map: (width > 0 && height > 0).then_some(map), rules, k };
        (identity.to_bytes() == bytes).then_some(identity)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interrupt::uninterrupted;

    fn matrix(width: u32, height: u32, blocked: impl FnMut(u32, u32) -> bool) -> BitMatrix {
        uninterrupted(|never| BitMatrix::from_bits(width, height, never, blocked))
    }

    fn id(rows: &BitMatrix) -> MapId {
        uninterrupted(|never| MapId::new(rows, never))
    }

    #[test]
    fn bytes_are_read_back_and_others_refused() {
        let rows = matrix(70, 3, |x, y| x * y % 7 == 1);
        let ks = [None, Some(K::N4), Some(K::Any)];
        for (rules, k) in
            Rules::ALL.into_iter().chain(Rules::BETWEEN_CENTERS).flat_map(|rules| ks.map(|k| (rules, k)))
        {
            for map in [None, Some(id(&rows))] {
                let identity = Identity { map, rules, k };
                assert_eq!(Identity::from_bytes(identity.to_bytes()), Some(identity));
            }
        }
        let bytes = Identity { map: None, rules: Rules::ALL[0], k: None }.to_bytes();
        // A width, a height or a digest alone are those of no map.
        for (at, wrong) in [(24, 7), (28, 1), (0, 5), (4, 5), (8, 1), (23, 255)] {
            let mut bytes = bytes;
            bytes[at] = wrong;
            assert_eq!(Identity::from_bytes(bytes), None, "byte {at}");
        }
    }

    /// Every map of 3 × 3 cells, and the moves of one blocked cell on a larger one, differ from one another.
    #[test]
    fn different_maps_have_different_identities() {
        let small = (0..1_u32 << 9).map(|cells| matrix(3, 3, |x, y| cells >> (3 * y + x) & 1 == 1));
        let large = (0..130 * 5).map(|cell| matrix(130, 5, |x, y| y * 130 + x == cell));
        let turned = [(1, 64), (64, 1), (2, 32), (128, 1)].map(|(w, h)| matrix(w, h, |_, _| false));
        let ids: Vec<MapId> = small.chain(large).chain(turned).map(|rows| id(&rows)).collect();
        let digests: std::collections::HashSet<_> = ids.iter().collect();
        assert_eq!(digests.len(), ids.len());
    }

    /// Pinned, since saved indexes hold it.
    #[test]
    fn the_digest_is_the_same_everywhere() {
        let id = id(&matrix(70, 3, |x, y| x * y % 7 == 1));
        let MapId { width, height, digest } = id;
        assert_eq!((width, height), (70, 3));
        assert_eq!(digest, [0x8789_e346, 0x3425_d87d, 0x2674_a16a, 0x9a53_7a66]);
    }
}
