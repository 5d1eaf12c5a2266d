//! The tests of records and figures.

mod figures;
mod record;
mod svg;
