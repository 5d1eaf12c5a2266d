//! The MovingAI benchmark sets: what each holds, where it lies in the project, and how it gets there.
//!
//! **The key decision: a set is trusted by what its maps say, not by how its files are written.** The
//! manifest (`benchdata/manifest.json`) has a digest of the cells of every map and the number of instances of
//! every set. So an archive that another site packed anew, or with other line ends, is still the same set,
//! and a map with one cell changed is not. A set is complete or absent: its archives are unpacked beside its
//! place, verified there, and only then renamed.
//!
//! * [`root`], [`cache`], [`files`]: where the project and its sets lie.
//! * [`Manifest`], [`Set`], [`Contents`]: what the sets hold, and how that is checked.
//! * [`Archive`]: one map or scenario of a set by its name, unpacked or still zipped.
//! * `Cache`, `Source` (feature `download`): fetches the archives, unpacks and verifies them.
//!
//! It runs no engine and prints no results; it shows progress bars on stderr, since only programs at a
//! terminal use it. The options of `cargo xtask download` are in `xtask`.

mod archive;
#[cfg(feature = "download")]
mod cache;
mod error;
#[cfg(feature = "download")]
mod fetch;
mod folder;
mod manifest;
mod places;
mod progress;
#[cfg(feature = "download")]
mod unpack;

pub use archive::{Archive, ArchiveError};
#[cfg(feature = "download")]
pub use cache::{Cache, Report};
pub use error::Error;
#[cfg(feature = "download")]
pub use fetch::Source;
pub use folder::files;
pub use manifest::{Contents, DIGEST, Manifest, Set, map_digest};
pub use places::{cache, root};
pub use progress::progress;
