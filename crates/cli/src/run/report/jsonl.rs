//! `--format jsonl`: a JSON object a line, which scripts rely on.
//!
//! First a [`RunLine`] (`"type": "run"`), then a [`QueryLine`] (`"query"`) for each query in the order of the scenario, last a
//! [`Summary`] (`"summary"`). Lengths are in cells, times in nanoseconds.

use std::{
    collections::BTreeMap,
    io::{self, Write},
    time::{Duration, Instant},
};

use mediant_engines::{EngineKind, EngineOption, Levels, OptionValue, ValueKind};
use mediant_grid::{CornerRule, DiagonalGap, Rules, Vertex};
use mediant_moves::K;
use mediant_search::{Path, Smoothing};
use serde::Serialize;
use serde_json::Value;

use super::{Report, guarantee_name};
use crate::{
    run::{
        answer::{Answer, Found, Run},
        summary::Summary,
    },
    terminal::screen::Screen,
};

/// Writes each record as it comes, and seldom keeps it back: an interrupted run loses the query at hand and less than a
/// second's work.
pub(crate) struct Jsonl<'s> {
    screen: &'s mut Screen,
    /// How long a line may wait for others.
    patience: Duration,
    flushed: Instant,
}

impl<'s> Jsonl<'s> {
    /// `watched` is whether somebody looks on, for whom no line waits.
    pub(crate) fn new(screen: &'s mut Screen, watched: bool) -> Self {
        let patience = if watched { Duration::ZERO } else { Duration::from_secs(1) };
        Self { screen, patience, flushed: Instant::now() }
    }

    fn line(&mut self, record: &impl Serialize) -> io::Result<()> {
        serde_json::to_writer(&mut *self.screen, record)?;
        self.screen.write_all(b"\n")
    }

    fn flush(&mut self) -> io::Result<()> {
        self.screen.flush()?;
        self.flushed = Instant::now();
        Ok(())
    }
}

impl Report for Jsonl<'_> {
    fn begin(&mut self, run: &Run<'_>) -> io::Result<()> {
        self.line(&RunLine::from(run))?;
        self.flush()
    }

    fn query(&mut self, answer: Answer) -> io::Result<()> {
        self.line(&QueryLine::from(&answer))?;
        if self.flushed.elapsed() >= self.patience { self.flush() } else { Ok(()) }
    }

    fn end(&mut self, summary: &Summary) -> io::Result<()> {
        self.line(summary)
    }
}

/// What is run.
#[derive(Debug, Serialize)]
#[serde(tag = "type", rename = "run")]
struct RunLine<'r> {
    /// The map's file name.
    map: &'r str,
    width: u32,
    height: u32,
    free_cells: u64,
    /// The scenario's file name.
    scenario: Option<&'r str>,
    queries: usize,
    engine: &'static str,
    /// A number or `any`.
    k: Value,
    placement: String,
    corners: String,
    gap: String,
    /// The engine's options by name, with `_` for `-`: a flag is true or false, a number of levels is a number, `all` or
    /// `contracted`; `null` of an option that the engine does not have.
    #[serde(flatten)]
    options: BTreeMap<String, Value>,
    smooth: bool,
    /// `linear` or `taut`; `null` unless paths are smoothed.
    smoothing: Option<&'static str>,
    /// The engine that finds each query's `any_angle`; `null` without one.
    any_angle: Option<&'static str>,
    guarantee: String,
    repeat: u32,
    /// The time to make the search space of the loaded map and the engine's index; with a saved index, to load that.
    preprocess_ns: u64,
    index_bytes: u64,
    version: &'static str,
}

impl<'r> From<&Run<'r>> for RunLine<'r> {
    fn from(run: &Run<'r>) -> Self {
        let setup = run.setup;
        // The rule of the other placement is reported by its default.
        let (corners, gap) = match setup.rules {
            Rules::Center(corners) => (corners, DiagonalGap::default()),
            Rules::Corner(gap) => (CornerRule::default(), gap),
        };
        let grid = &run.map.grid;
        Self {
            map: &run.map.name,
            width: grid.width(),
            height: grid.height(),
            free_cells: grid.free_cells(),
            scenario: run.scenario,
            queries: run.queries,
            engine: setup.engine.kind().name(),
            k: match setup.k {
                K::Finite(k) => k.get().into(),
                K::Any => K::Any.to_string().into(),
            },
            placement: setup.rules.placement().to_string(),
            corners: corners.to_string(),
            gap: gap.to_string(),
            options: run.options.iter().map(|&(option, value)| json_of(option, value)).collect(),
            smooth: setup.smoothing.is_some(),
            smoothing: setup.smoothing.map(smoothing_name),
            any_angle: run.reference.map(EngineKind::name),
            guarantee: guarantee_name(run.guarantee),
            repeat: run.repeat,
            preprocess_ns: run.preparation.as_nanos() as u64,
            index_bytes: run.memory_bytes,
            version: env!("CARGO_PKG_VERSION"),
        }
    }
}

/// An option's key and value.
fn json_of(option: &EngineOption, value: Option<OptionValue>) -> (String, Value) {
    let value = match value {
        _ if option.kind == ValueKind::Flag => Value::Bool(value.is_some()),
        None => Value::Null,
        Some(OptionValue::Number(number) | OptionValue::Levels(Levels::Number(number))) => {
            number.get().into()
        }
        Some(value) => value.to_string().into(),
    };
    (option.name.replace('-', "_"), value)
}

/// The name of a smoothing.
pub(super) const fn smoothing_name(smoothing: Smoothing) -> &'static str {
    match smoothing {
        Smoothing::Linear => "linear",
        Smoothing::Taut => "taut",
    }
}

/// How a query ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
enum Status {
    Found,
    Unreachable,
    Error,
}

/// A query and its answer.
#[derive(Debug, Serialize)]
#[serde(tag = "type", rename = "query")]
struct QueryLine<'a> {
    /// The instance of the scenario, from 0.
    index: usize,
    start: [i32; 2],
    goal: [i32; 2],
    status: Status,
    /// `null` unless found.
    cost: Option<f64>,
    /// The waypoints; empty unless found.
    path: Vec<[i32; 2]>,
    /// The path smoothness of Hammoud 2023: the sum of all turns, in degrees; `null` unless found.
    smoothness: Option<f64>,
    /// The scenario's length: optimal for k = 3 at centers, corners never cut.
    reference: Option<f64>,
    /// The certificate: no any-angle path under the same rules is shorter; `null` unless found.
    lower_bound: Option<f64>,
    /// `cost / lower_bound`, at least 1; `null` unless found.
    bound: Option<f64>,
    /// The length of the shortest any-angle path under the same rules; `null` unless asked for and there is one.
    any_angle: Option<f64>,
    /// `cost / any_angle`; `null` where either is.
    ratio: Option<f64>,
    expanded: u64,
    generated: u64,
    percolations: u64,
    /// Cheaper paths found to known nodes.
    updated: u64,
    /// Vertices that jump point searches looked at while they scanned.
    scanned: u64,
    /// How often a search in two phases left its plan.
    fallbacks: u64,
    /// The query alone on a warm planner, the best of all repetitions; 0 for errors.
    nanos: u64,
    /// What is wrong with the query; only where the status is `error`.
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<&'a str>,
}

impl<'a> From<&'a Answer> for QueryLine<'a> {
    fn from(answer: &'a Answer) -> Self {
        let Answer { item, found, counters, nanos } = answer;
        let (query, path) = (item.query, answer.path());
        let [start, goal] = [query.start, query.goal].map(pair);
        let waypoints = path.map_or(&[][..], |found| found.path.waypoints());
        Self {
            index: item.index,
            start,
            goal,
            status: match found {
                Ok(Some(_)) => Status::Found,
                Ok(None) => Status::Unreachable,
                Err(_) => Status::Error,
            },
            cost: path.map(|found| found.path.cost()),
            path: waypoints.iter().copied().map(pair).collect(),
            smoothness: path.map(|found| Path::smoothness(&found.path)),
            reference: item.reference,
            lower_bound: path.map(|found| found.lower_bound),
            bound: path.map(Found::bound),
            any_angle: path.and_then(|found| found.any_angle),
            ratio: path.and_then(Found::ratio),
            expanded: counters.expanded,
            generated: counters.generated,
            percolations: counters.percolations,
            updated: counters.updated,
            scanned: counters.scanned,
            fallbacks: counters.fallbacks,
            nanos: *nanos,
            error: found.as_ref().err().map(String::as_str),
        }
    }
}

const fn pair(at: Vertex) -> [i32; 2] {
    [at.x, at.y]
}
