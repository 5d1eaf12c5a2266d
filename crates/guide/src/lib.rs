//! The guide, `docs/guide`: a book in Markdown, for people who do not know the words yet.
//!
//! **The key decision: nothing in the guide is taken on trust.** The Rust examples of its pages are tests of
//! this crate (`pages`), its figures are drawn by [`figures`] from what the engines find, and a test
//! compares the files with them. The book itself is built by mdBook, which knows nothing of the repository:
//! links to its files become addresses there ([`book`]).
//!
//! Not here: the words of calls and engines, which `cargo xtask describe` writes.

pub mod book;
mod error;
pub mod figures;
#[cfg(doctest)]
mod pages;

pub use error::GuideError;
