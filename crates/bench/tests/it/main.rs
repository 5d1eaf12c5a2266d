//! The files of benchmark sets, and the side by side on generated maps.

mod archive;
mod measure;
