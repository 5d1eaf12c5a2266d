//! Our engines beside other programs: on the same instances, in the same process, and, by way of two crates that run
//! there too, on the same scale as programs that do not.
//!
//! **The key decision: ratios, never times.** A machine is not the same from one day to the next. So [`measure`] takes
//! the competitors in turn, pass by pass, and drift meets all of them alike; and the figures of `benchdata/reference_timings.json`,
//! which other programs took on another machine, are scaled by what the two [`Baseline`]s take there and here before
//! [`Comparison`] divides by them.
//!
//! Nothing is timed that was not checked: a path that is not as long as the scenario says is an error, not a result.
//!
//! * [`Problem`]: a map of a benchmark set with the queries of its scenario, loaded.
//! * [`Competitor`]: one of our engines in a [`Setup`](mediant_engines::Setup), or a baseline.
//! * [`measure`]: the side by side. [`MapRecord`]: what it found.
//! * [`Study`]: setups on the queries of one map, with all that their searches count. [`Run`]: what one of them made of these.
//! * [`ReferenceTimings`], [`Comparison`]: the other programs, and our ratio to each.
//! * [`compare`] and [`verify`]: the programs behind `cargo xtask compare` and `cargo xtask verify`. `verify` measures no time,
//!   but needs the same: all engines, and the benchmark sets.
//!
//! What is not here: tables and files of results (`mediant-report`, `mediant-papers`), and the criterion benches, which are in `benches/`.

mod baseline;
pub mod compare;
mod comparison;
mod competitor;
mod measure;
mod problem;
#[cfg(doctest)]
mod readme;
mod reference_timings;
mod study;
pub mod verify;

pub use baseline::Baseline;
pub use comparison::{Comparison, PreparationRatio};
pub use competitor::Competitor;
pub use measure::{MapRecord, MeasureError, Preparation, Timing, measure};
pub use problem::{Problem, ProblemError};
pub use reference_timings::{
    Comparand, MapTimings, Preprocessing, Published, PublishedRow, ReferenceTimings, ReferenceTimingsError,
};
pub use study::{Answer, Run, Study};
