//! Problems from the files of benchmark sets, the side by side on generated maps, `verify`, and `soak`.

mod changes;
mod costs;
mod measure;
mod pages;
mod peers;
mod problem;
mod prove;
mod soak;
mod verify;
