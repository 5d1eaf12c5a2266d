//! Hub labels from outside.

mod bytes;
mod exact;
mod far;
mod many;
mod shared;
mod vertices;
