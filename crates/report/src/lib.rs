//! The results of experiments and how they are shown: records, tables, statistics, figures, claims.
//!
//! **The key decision: a [`Record`] is a table that describes itself.** Each column names its unit and
//! whether its numbers are counts, the same on every machine, or times. So one form serves every experiment,
//! in three ways: it is the file that a reader's script loads; a later run is compared with it, without the
//! times; and all pages and figures are drawn from it, as often as their form changes, without measuring
//! again.
//!
//! * [`Record`], [`Column`], [`Row`], [`Provenance`]: results, and the revision, machine and maps that they
//!   come from.
//! * [`Claim`], [`Verdict`]: a published number beside ours, and whether they agree.
//! * [`Table`]: tables as Markdown and as plain text.
//! * [`stats`]: means, medians, ratios of means with their standard errors.
//! * [`Chart`], [`GridDrawing`], [`NeighborhoodDrawing`], [`TreeDrawing`]: figures as SVG.
//!
//! Not here: engines, measurements (`mediant-bench`), and the choice of tables and figures, which is part of
//! each experiment.

mod claim;
mod figure;
mod here;
mod number;
mod record;
pub mod stats;
mod table;

pub use claim::{Claim, Verdict, verdicts};
pub use figure::{Axis, Chart, GridDrawing, Mark, NeighborhoodDrawing, Scale, Series, TreeDrawing};
pub use here::revision;
pub use number::{number, thousands};
pub use record::{Column, ColumnKind, Difference, Machine, Provenance, Record, RecordError, Row, Value};
pub use table::Table;
