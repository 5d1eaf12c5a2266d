//! Saved indexes: what an engine preprocessed, together with what it was built for.

mod digest;
pub(crate) mod error;
mod file;
mod header;
mod key;
mod layout;
mod save;

pub use digest::MapDigest;
pub use error::IndexError;
pub use file::IndexFile;
pub use key::IndexKey;
pub use save::WriteError;
