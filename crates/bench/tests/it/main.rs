//! Problems from the files of benchmark sets, the side by side on generated maps, and `verify`.

mod changes;
mod costs;
mod measure;
mod pages;
mod problem;
mod prove;
mod verify;
