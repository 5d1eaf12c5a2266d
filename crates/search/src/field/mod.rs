//! Fields.

mod any_angle;
mod buckets;
mod cone;
mod costs;
mod gaps;
mod lattice;
mod lengths;
mod open_ground;
mod query;

pub use any_angle::AnyAngleFields;
pub use costs::Field;
pub use lattice::Fields;
pub use lengths::AnyAngleField;
pub use query::{FieldError, FieldQuery};
