//! What a run tells: the objects of `--format jsonl`, one a line, that scripts rely on.
//!
//! First a [`RunRecord`] (`"type": "run"`), then a [`QueryRecord`] (`"query"`) for each query in the order of the scenario,
//! last a [`Summary`](crate::summary::Summary) (`"summary"`). Lengths are in cells, times in nanoseconds.

use serde::Serialize;

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
    pub(crate) k: u32,
    pub(crate) placement: String,
    pub(crate) corners: String,
    pub(crate) gap: String,
    pub(crate) heuristic: String,
    /// `exact` or `paper`; `null` for an engine that has no variants.
    pub(crate) variant: Option<String>,
    /// The most steps of a jump; `null` without a bound.
    pub(crate) jump_limit: Option<u32>,
    pub(crate) keep_intermediate: bool,
    pub(crate) smooth: bool,
    pub(crate) guarantee: String,
    pub(crate) repeat: u32,
    /// Making the search graph of the loaded map and the engine's index of it; with a saved index, loading that.
    pub(crate) preprocess_ns: u64,
    pub(crate) index_bytes: u64,
    pub(crate) version: &'static str,
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
    pub(crate) expanded: u64,
    pub(crate) generated: u64,
    pub(crate) percolations: u64,
    /// Cheaper paths found to known nodes.
    pub(crate) updated: u64,
    /// Vertices that jump point searches looked at on the runs that they scanned.
    pub(crate) scanned: u64,
    /// The query alone on a warm planner, the best of all repetitions; 0 for errors.
    pub(crate) nanos: u64,
    /// What is wrong with the query; only where the status is `error`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) error: Option<String>,
}
