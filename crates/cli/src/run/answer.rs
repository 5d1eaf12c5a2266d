//! What a run reports, before it becomes a table or JSON (`report`).

use std::time::Duration;

use mediant_engines::{EngineKind, EngineOption, OptionValue, Setup};
use mediant_grid::{Rules, Vertex};
use mediant_search::{Counters, Guarantee, Path};

use super::queries::Item;
use crate::map::Map;

/// What is run.
pub(crate) struct Run<'r> {
    pub(crate) map: &'r Map,
    /// The scenario's file name.
    pub(crate) scenario: Option<&'r str>,
    /// The number of queries.
    pub(crate) queries: usize,
    pub(crate) setup: Setup,
    /// Every option of the catalog, with its value where the engine has one.
    pub(crate) options: Vec<(&'static EngineOption, Option<OptionValue>)>,
    pub(crate) guarantee: Guarantee,
    /// The engine that finds the shortest any-angle paths to compare with.
    pub(crate) reference: Option<EngineKind>,
    /// How often each query is timed.
    pub(crate) repeat: u32,
    /// The time to make the search space and the index, or to load a saved one.
    pub(crate) preparation: Duration,
    /// The memory of both beyond the map.
    pub(crate) memory_bytes: u64,
}

/// A query with its answer.
#[derive(Clone, Debug)]
pub(crate) struct Answer {
    pub(crate) item: Item,
    /// `None` where there is no path; what is wrong with the query, in words, where there is no answer.
    pub(crate) found: Result<Option<Found>, String>,
    pub(crate) counters: Counters,
    /// The query alone on a warm planner, the best of all repetitions; 0 for errors.
    pub(crate) nanos: u64,
}

/// A path, and what is known of the shortest any-angle path under the same rules.
#[derive(Clone, Debug)]
pub(crate) struct Found {
    pub(crate) path: Path,
    /// The certificate: no any-angle path is shorter, by the engine's guarantee and by the straight line.
    pub(crate) lower_bound: f64,
    /// The length of the shortest any-angle path, if it was asked for.
    pub(crate) any_angle: Option<f64>,
}

impl Answer {
    /// The path, if one was found.
    pub(crate) fn path(&self) -> Option<&Found> {
        self.found.as_ref().ok()?.as_ref()
    }
}

impl Found {
    /// With the certificate that follows from the path and the guarantee of its engine.
    pub(crate) fn new(path: Path, guarantee: Guarantee, rules: Rules, any_angle: Option<f64>) -> Self {
        let (cost, waypoints) = (path.cost(), path.waypoints());
        let ends = waypoints.first().zip(waypoints.last());
        let straight = ends.map_or(0.0, |(start, goal): (&Vertex, &Vertex)| start.distance(*goal));
        // A sum of lengths may round below the straight line that they make up.
        let lower_bound = guarantee.lower_bound(rules, cost, straight).min(cost);
        Self { path, lower_bound, any_angle }
    }

    /// At most this many times as long as the shortest any-angle path is the path; at least 1.
    pub(crate) fn bound(&self) -> f64 {
        ratio(self.path.cost(), self.lower_bound)
    }

    /// This many times as long as the shortest any-angle path is the path.
    pub(crate) fn ratio(&self) -> Option<f64> {
        self.any_angle.map(|best| ratio(self.path.cost(), best))
    }
}

/// How many times as long; once where both are 0.
fn ratio(cost: f64, other: f64) -> f64 {
    if cost == other { 1.0 } else { cost / other }
}
