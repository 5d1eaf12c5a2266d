//! Records of results.

mod column;
mod compare;
mod document;
mod error;
mod json;
mod provenance;
mod row;

pub use column::{Column, ColumnKind};
pub use compare::Difference;
pub use document::Record;
pub use error::RecordError;
pub use provenance::{Machine, Provenance};
pub use row::{Row, Value};
