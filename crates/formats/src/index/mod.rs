//! Saved indexes: what an engine preprocessed, together with what it was built for.

pub(crate) mod error;
mod file;
mod header;
mod key;
mod layout;

pub use error::IndexError;
pub use file::IndexFile;
pub use key::IndexKey;
