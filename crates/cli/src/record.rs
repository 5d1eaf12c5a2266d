//! What a run tells: the objects of `--format jsonl`, one a line, that scripts rely on.
//!
//! First a [`RunRecord`] (`"type": "run"`), then a [`QueryRecord`] (`"query"`) for each query in the order of the scenario,
//! last a [`Summary`](crate::summary::Summary) (`"summary"`). Lengths are in cells, times in nanoseconds.

use mediant_engines::{Hierarchy, Levels};
use mediant_moves::K;
use serde::{Serialize, Serializer};

/// What is run.
#[derive(Clone, Debug, Serialize)]
#[serde(tag = "type", rename = "run")]
pub(crate) struct RunRecord {
    /// The map's file name.
    pub(crate) map: String,
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) free_cells: u64,
    /// The scenario's file name.
    pub(crate) scenario: Option<String>,
    pub(crate) queries: usize,
    pub(crate) engine: String,
    /// A number or `any`.
    #[serde(serialize_with = "number_or_any")]
    pub(crate) k: K,
    pub(crate) placement: String,
    pub(crate) corners: String,
    pub(crate) gap: String,
    /// `null` for an engine with one of its own.
    pub(crate) heuristic: Option<String>,
    /// The heuristic of the second phase; `null` for an engine without.
    pub(crate) second: Option<String>,
    /// `exact`, `complete` or `paper`; `null` for an engine that has no variants.
    pub(crate) variant: Option<String>,
    /// The most steps of a jump; `null` without a bound.
    pub(crate) jump_limit: Option<u32>,
    pub(crate) keep_intermediate: bool,
    /// Of the subgoal graph or the clusters that are searched: a number, `all`, or `contracted` for a contraction hierarchy; `null` for an
    /// engine without.
    #[serde(serialize_with = "levels")]
    pub(crate) levels: Option<Hierarchy>,
    /// Of the lowest clusters or the segments, in cells; `null` for an engine without.
    pub(crate) side: Option<u32>,
    /// Whether paths through clusters are left as they are refined.
    pub(crate) refined: bool,
    /// Every how many segments there is a checkpoint; `null` for an engine without.
    pub(crate) step: Option<u32>,
    /// How many times as long as on an empty grid the way to a checkpoint may be; `null` for an engine that never leaves its plan.
    pub(crate) detour: Option<u32>,
    pub(crate) smooth: bool,
    /// `linear` or `taut`; `null` unless paths are smoothed.
    pub(crate) smoothing: Option<&'static str>,
    /// The engine that finds each query's `any_angle`; `null` without one.
    pub(crate) any_angle: Option<&'static str>,
    pub(crate) guarantee: String,
    pub(crate) repeat: u32,
    /// Making the search graph of the loaded map and the engine's index of it; with a saved index, loading that.
    pub(crate) preprocess_ns: u64,
    pub(crate) index_bytes: u64,
    pub(crate) version: &'static str,
}

fn number_or_any<S: Serializer>(k: &K, serializer: S) -> Result<S::Ok, S::Error> {
    match k {
        K::Finite(k) => serializer.serialize_u32(k.get()),
        K::Any => serializer.collect_str(k),
    }
}

fn levels<S: Serializer>(levels: &Option<Hierarchy>, serializer: S) -> Result<S::Ok, S::Error> {
    match levels.map(Levels::of) {
        None => serializer.serialize_none(),
        Some(None) => serializer.serialize_str("contracted"),
        Some(Some(Levels::Number(number))) => serializer.serialize_u32(number.get()),
        Some(Some(Levels::All)) => serializer.serialize_str("all"),
    }
}

/// How a query ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Status {
    Found,
    Unreachable,
    Error,
}

/// A query and its answer.
#[derive(Clone, Debug, Serialize)]
#[serde(tag = "type", rename = "query")]
pub(crate) struct QueryRecord {
    /// The instance of the scenario, from 0.
    pub(crate) index: usize,
    pub(crate) start: [i32; 2],
    pub(crate) goal: [i32; 2],
    pub(crate) status: Status,
    /// `null` unless found.
    pub(crate) cost: Option<f64>,
    /// The waypoints; empty unless found.
    pub(crate) path: Vec<[i32; 2]>,
    /// The path smoothness of Hammoud 2023: the sum of all turns, in degrees; `null` unless found.
    pub(crate) smoothness: Option<f64>,
    /// The scenario's length: optimal for k = 3 at centers, corners never cut.
    pub(crate) reference: Option<f64>,
    /// The certificate: no any-angle path under the same rules is shorter, by what the engine guarantees of its path and by the straight
    /// line; `null` unless found.
    pub(crate) lower_bound: Option<f64>,
    /// `cost / lower_bound`, at least 1: so many times as long as the shortest any-angle path is the path at most; `null` unless found.
    pub(crate) bound: Option<f64>,
    /// The length of the shortest any-angle path under the same rules; `null` unless asked for and there is one.
    pub(crate) any_angle: Option<f64>,
    /// `cost / any_angle`; `null` where either is.
    pub(crate) ratio: Option<f64>,
    pub(crate) expanded: u64,
    pub(crate) generated: u64,
    pub(crate) percolations: u64,
    /// Cheaper paths found to known nodes.
    pub(crate) updated: u64,
    /// Vertices that jump point searches looked at on the runs that they scanned.
    pub(crate) scanned: u64,
    /// How often a search in two phases left its plan.
    pub(crate) fallbacks: u64,
    /// The query alone on a warm planner, the best of all repetitions; 0 for errors.
    pub(crate) nanos: u64,
    /// What is wrong with the query; only where the status is `error`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) error: Option<String>,
}
