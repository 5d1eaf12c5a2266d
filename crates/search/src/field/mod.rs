//! Fields.

mod buckets;
mod costs;
mod gaps;
mod lattice;
mod open_ground;
mod query;

pub use costs::Field;
pub use lattice::Fields;
pub use query::{FieldError, FieldQuery};
