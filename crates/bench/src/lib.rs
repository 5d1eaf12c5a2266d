//! Benchmarks of our engines beside other programs, on the same instances. Two other crates run in the same
//! process. They also ran beside the programs that we timed elsewhere, so that these can be compared as well.
//!
//! **The key decision: ratios, never times.** A machine is not equally fast from one day to the next. So
//! [`measure`] runs the competitors in turn, pass by pass, and a drift affects all of them alike. The times
//! of programs on another machine, in `benchdata/reference_timings.json`, are scaled by the times of the two
//! [`Baseline`]s there and here, before [`Comparison`] divides by them.
//!
//! Nothing is timed before it is checked: a path of the wrong length is an error, not a result.
//!
//! * [`Problem`]: a map of a benchmark set with the queries of its scenario.
//! * [`Competitor`]: one of our engines in a [`Setup`](mediant::Setup), asked for paths or for their lengths
//!   alone; the same as a typed planner ([`TypedEngine`]); or a baseline.
//! * [`measure`]: checks and times competitors side by side; [`MapRecord`]: the times.
//! * [`Study`]: runs setups on the queries of one map; [`Run`]: the answers of one of them, with all counts
//!   of its searches.
//! * [`ReferenceTimings`]: the times of other programs; [`Comparison`]: our ratio to each.
//! * [`compare`], [`verify`], [`prove`] and [`soak`]: the programs behind the chores of the same names. The
//!   last three measure little or nothing, but need the same: all engines, and the benchmark sets.
//!
//! Not here: the benchmark sets (`mediant-sets`), and tables and files of results (`mediant-report`,
//! `mediant-papers`). The criterion benches are in `benches/`.

mod baseline;
pub mod compare;
mod comparison;
mod competitor;
mod grounds;
mod measure;
mod preparation;
mod problem;
pub mod prove;
#[cfg(doctest)]
mod readme;
mod reference_timings;
pub mod soak;
mod study;
mod typed;
pub mod verify;

pub use baseline::Baseline;
pub use comparison::{Comparison, PreparationRatio, machine_ratio};
pub use competitor::Competitor;
pub use measure::{MapRecord, MeasureError, Timing, measure};
pub use preparation::{Kept, Preparation};
pub use problem::{Problem, ProblemError};
pub use reference_timings::{
    MapTimings, Preprocessing, Published, PublishedRow, ReferenceProgram, ReferenceTimings,
    ReferenceTimingsError,
};
pub use study::{PathFigures, Run, Study};
pub use typed::TypedEngine;
