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
//! * [`Archive`]: where the maps and scenarios of the benchmark sets are; [`Problem`]: one of them, loaded.
//! * [`Competitor`]: one of our engines in a [`Setup`](mediant_engines::Setup), or a baseline.
//! * [`measure`]: the side by side. [`MapRecord`]: what it found.
//! * [`Study`]: setups on the queries of one map, with all that their searches count. [`Run`]: what one of them made of these.
//! * [`ReferenceTimings`], [`Comparison`]: the other programs, and our ratio to each.
//!
//! What is not here: tables and files of results (`mediant-report`, `xtask`), and the criterion benches, which are in `benches/`.

mod archive;
mod baseline;
mod comparison;
mod competitor;
mod measure;
mod problem;
#[cfg(doctest)]
mod readme;
mod reference_timings;
mod study;

pub use archive::{Archive, ArchiveError};
pub use baseline::Baseline;
pub use comparison::{Comparison, PreparationRatio};
pub use competitor::Competitor;
pub use measure::{MapRecord, MeasureError, Preparation, Timing, measure};
pub use problem::{Problem, ProblemError};
pub use reference_timings::{
    Comparand, MapTimings, Preprocessing, Published, PublishedRow, ReferenceTimings, ReferenceTimingsError,
};
pub use study::{Answer, Run, Study};
