//! What there is to report of a run: what is run, and the answer of each query.

use std::time::Duration;

use mediant::{Engine, EngineOption, OptionValue, Setup};
use mediant_grid::{Rules, Vertex};
use mediant_search::{Counters, Guarantee, Path};

use super::queries::Item;
use crate::map::Map;

/// What is run: the map, the setup, and what its preparation took.
pub(crate) struct Run<'r> {
    pub(crate) map: &'r Map,
    /// The scenario's file name.
    pub(crate) scenario: Option<&'r str>,
    /// The number of queries.
    pub(crate) queries: usize,
    pub(crate) setup: Setup,
    /// All options of the catalog, each with its value if the engine has one.
    pub(crate) options: Vec<(&'static EngineOption, Option<OptionValue>)>,
    pub(crate) guarantee: Guarantee,
    /// The engine of `--reference`, which finds the shortest any-angle paths to compare with.
    pub(crate) reference: Option<Engine>,
    /// How often each query is timed.
    pub(crate) repeat: u32,
    /// The time to prepare the search space, and to prepare or load the index.
    pub(crate) preparation: Duration,
    /// The memory of the search space and the index, beyond the map.
    pub(crate) memory_bytes: u64,
}

/// A query with its answer.
#[derive(Clone, Debug)]
pub(crate) struct Answer {
    pub(crate) item: Item,
    /// The path, or `None` if there is none; or in words why the query cannot be answered.
    pub(crate) found: Result<Option<Found>, String>,
    pub(crate) counters: Counters,
    /// The time of the query alone on a warm planner, the best of all repetitions; 0 for errors.
    pub(crate) nanos: u64,
}

/// A path, and what is known of the shortest any-angle path under the same rules.
#[derive(Clone, Debug)]
pub(crate) struct Found {
    pub(crate) path: Path,
    /// The certificate: no any-angle path is shorter than this, by the engine's guarantee and by the straight
    /// line.
    pub(crate) lower_bound: f64,
    /// The length of the shortest any-angle path, with `--reference`.
    pub(crate) any_angle: Option<f64>,
}

impl Answer {
    /// The path, if one was found.
    pub(crate) fn path(&self) -> Option<&Found> {
        self.found.as_ref().ok()?.as_ref()
    }
}

impl Found {
    /// Adds the certificate, which follows from the path and the guarantee of its engine.
    pub(crate) fn new(path: Path, guarantee: Guarantee, rules: Rules, any_angle: Option<f64>) -> Self {
        let (cost, waypoints) = (path.cost(), path.waypoints());
        let ends = waypoints.first().zip(waypoints.last());
        let straight = ends.map_or(0.0, |(start, goal): (&Vertex, &Vertex)| start.distance(*goal));
        // The rounded sum of a straight path's parts may be less than the straight line.
        let lower_bound = guarantee.lower_bound(rules, cost, straight).min(cost);
        Self { path, lower_bound, any_angle }
    }

    /// The path is at most this many times as long as the shortest any-angle path; at least 1.
    pub(crate) fn bound(&self) -> f64 {
        ratio(self.path.cost(), self.lower_bound)
    }

    /// The path is this many times as long as the shortest any-angle path.
    pub(crate) fn ratio(&self) -> Option<f64> {
        self.any_angle.map(|best| ratio(self.path.cost(), best))
    }
}

/// The ratio of two lengths; 1 if both are 0.
fn ratio(cost: f64, other: f64) -> f64 {
    if cost == other { 1.0 } else { cost / other }
}
