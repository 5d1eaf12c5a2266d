//! The layout of an index file, and its constants.
//!
//! All numbers are little endian.
//!
//! | bytes | content |
//! |---|---|
//! | 8 | `\x89MEDIDX\n` |
//! | 4 | the version of this format |
//! | 16 | the engine's name, ASCII, filled up with zeros |
//! | 4 | the version of the engine's payload |
//! | 32 | the map, the rules of motion and k, see [`Identity::to_bytes`](mediant_grid::Identity::to_bytes) |
//! | 8 | length of the payload |
//! | … | the payload |
//! | 32 | SHA-256 of all that precedes |

/// The first byte occurs in no text file, and the last one is lost where line ends are converted.
pub(super) const MAGIC: [u8; 8] = *b"\x89MEDIDX\n";
pub(super) const FORMAT_VERSION: u32 = 2;
pub(super) const NAME_BYTES: usize = 16;
/// The names that [`is_engine_name`] accepts, for error messages.
pub(super) const NAME_FORM: &str = "an engine's name of 1 to 16 printable ASCII characters without blanks";
/// The length of everything before the payload.
pub(super) const HEADER_BYTES: usize = 72;
/// The length of a SHA-256.
pub(super) const DIGEST_BYTES: usize = 32;

pub(super) fn is_engine_name(name: &[u8]) -> bool {
    (1..=NAME_BYTES).contains(&name.len()) && name.iter().all(u8::is_ascii_graphic)
}
