//! `mediant check`: the files with paths, and what is wrong with a path.

pub(crate) mod fault;
pub(crate) mod file;
