//! The terminal: colors, columns, tables, messages and progress.

pub(crate) mod message;
pub(crate) mod numbers;
mod palette;
pub(crate) mod progress;
pub(crate) mod screen;
pub(crate) mod table;
pub(crate) mod text;
