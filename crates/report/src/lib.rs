//! What a run of an experiment found, and how it is shown: records, tables, statistics, figures, claims.
//!
//! **The key decision: a [`Record`] is a table of numbers that says what it is.** Each column names its unit and whether it is a count, the same on every
//! machine, or a time. So one form serves every experiment: it is the file that a reader's script loads, the text that a
//! later run is compared with (without its times), and all that pages and figures are drawn from, again and again, without measuring anew.
//!
//! * [`Record`], [`Column`], [`Row`], [`Provenance`]: what was found, on which revision, machine and maps.
//! * [`Claim`], [`Verdict`]: a published number beside ours, and what becomes of it.
//! * [`Table`]: as Markdown, and as plain text.
//! * [`stats`]: means, medians, ratios of means with their standard errors.
//! * [`Chart`], [`GridDrawing`], [`TreeDrawing`]: SVG figures.
//!
//! What is not here: engines and measurements (`mediant-bench`), and which tables and figures there are (`mediant-papers`).

mod claim;
mod figure;
mod here;
mod record;
pub mod stats;
mod table;

pub use claim::{Claim, Verdict, verdicts};
pub use figure::{Axis, Chart, GridDrawing, Mark, Scale, Series, TreeDrawing};
pub use here::revision;
pub use record::{Column, Difference, Kind, Machine, Provenance, Record, RecordError, Row, Value};
pub use table::{Align, Table, number, thousands};
