//! The terminal: colors, columns, text and progress.

pub(crate) mod progress;
pub(crate) mod screen;
pub(crate) mod text;
