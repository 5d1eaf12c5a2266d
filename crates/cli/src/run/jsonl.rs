//! `--format jsonl`: one JSON object a line. Scripts rely on its keys and their meaning.
//!
//! First a [`RunLine`] (`"type": "run"`), then a [`QueryLine`] (`"query"`) for each query in the order of the
//! scenario, on a map that changes with an [`EditLine`] (`"edit"`) for each edit between them, last a
//! [`Summary`] (`"summary"`). Lengths are in cells, times in nanoseconds.

use std::{
    collections::BTreeMap,
    io::{self, Write},
    time::{Duration, Instant},
};

use mediant::{
    CornerRule, DiagonalGap, Engine, K, Path, PlacementKind, Point, Rules, Smoothing, Vertex,
    call::Wishes,
    files::WorldFrame,
    options::{EngineName, EngineOption, Levels, OptionValue, ValueKind},
};
use serde::Serialize;
use serde_json::Value;

use super::{
    answer::{EditRecord, Found, QueryAnswer, QueryRecord, RunHead},
    report::Report,
    summary::Summary,
};
use crate::{args::QueryArgs, terminal::screen::Screen};

/// Writes each record as it comes, and flushes often: an interrupted run loses the current query and the
/// records of less than a second.
pub(crate) struct Jsonl<'s> {
    screen: &'s mut Screen,
    /// The time that lines may wait in the buffer.
    patience: Duration,
    flushed: Instant,
    /// Where vertices are in the world.
    world: Option<(WorldFrame, PlacementKind)>,
    /// Whether only the lengths of paths are asked for.
    only_lengths: bool,
    /// Whether cells have costs.
    has_costs: bool,
}

impl<'s> Jsonl<'s> {
    /// Lines that somebody watches on a terminal do not wait in the buffer.
    pub(crate) fn new(screen: &'s mut Screen, watched: bool) -> Self {
        let patience = if watched { Duration::ZERO } else { Duration::from_secs(1) };
        Self { screen, patience, flushed: Instant::now(), world: None, only_lengths: false, has_costs: false }
    }

    fn line(&mut self, record: &impl Serialize) -> io::Result<()> {
        serde_json::to_writer(&mut *self.screen, record)?;
        self.screen.write_all(b"\n")
    }

    /// Writes a line that comes when its query or its edit is done.
    fn event(&mut self, record: &impl Serialize) -> io::Result<()> {
        self.line(record)?;
        if self.flushed.elapsed() >= self.patience { self.flush() } else { Ok(()) }
    }

    fn flush(&mut self) -> io::Result<()> {
        self.screen.flush()?;
        self.flushed = Instant::now();
        Ok(())
    }
}

impl Report for Jsonl<'_> {
    fn begin(&mut self, run: &RunHead<'_>) -> io::Result<()> {
        self.world = run.map.frame.map(|frame| (frame, run.setup.rules().placement()));
        self.only_lengths = run.query.distance;
        self.has_costs = run.map.has_costs();
        self.line(&RunLine::from(run))?;
        self.flush()
    }

    fn edit(&mut self, record: &EditRecord<'_>) -> io::Result<()> {
        self.event(&EditLine::from(record))
    }

    fn query(&mut self, record: QueryRecord) -> io::Result<()> {
        let mut line = QueryLine::from(&record);
        if self.only_lengths {
            line.path = None;
        }
        if self.has_costs {
            line.length = record.path().map(mediant::Path::length);
        }
        line.world = self.world.zip(record.path()).map(|((frame, placement), path)| {
            path.points().map(|at| frame.point_of(placement, at)).collect()
        });
        self.event(&line)
    }

    fn end(&mut self, summary: &Summary) -> io::Result<()> {
        self.line(summary)
    }
}

/// The first line: what is run.
#[derive(Debug, Serialize)]
#[serde(tag = "type", rename = "run")]
struct RunLine<'r> {
    /// The map's file name.
    map: &'r str,
    width: u32,
    height: u32,
    /// Of the agent's map.
    free_cells: u64,
    /// The least and the greatest cost of a cell a unit of length; only with costs. Limits and `cost` are in
    /// costs then, and there is no `lower_bound` of a path that was found.
    #[serde(skip_serializing_if = "Option::is_none")]
    costs: Option<[f64; 2]>,
    /// Whether these are times of walking over elevation, seconds a meter; only with `--elevation`.
    #[serde(skip_serializing_if = "Option::is_none")]
    walking: Option<bool>,
    /// Whether each query is answered on the ground of its start; only with `--grounds`. `free_cells` are
    /// those of all grounds then.
    #[serde(skip_serializing_if = "Option::is_none")]
    grounds: Option<bool>,
    /// The radius of the agent in cells; only with `--radius`.
    #[serde(skip_serializing_if = "Option::is_none")]
    radius: Option<f64>,
    /// The side of a cell in meters; only with `--world`.
    #[serde(skip_serializing_if = "Option::is_none")]
    resolution: Option<f64>,
    /// With `--world`, how far the start and the goal of a single query are from the vertices that are
    /// nearest to them, at any angle from the points that are kept, in meters.
    #[serde(skip_serializing_if = "Option::is_none")]
    moved: Option<[f64; 2]>,
    /// The scenario's file name.
    scenario: Option<&'r str>,
    queries: usize,
    /// The number of edits; only on a map that changes.
    #[serde(skip_serializing_if = "Option::is_none")]
    edits: Option<usize>,
    /// Each wish that was named, by the name of its option, with `_` for `-`; `timeout_ms` for `--timeout`.
    #[serde(flatten)]
    wishes: WishFields,
    /// The setup as text: the same text, the same answers.
    setup: String,
    /// The engine that was named; with `auto` the one that searches.
    engine: &'static str,
    /// "auto" if the engine was left open; only then.
    #[serde(skip_serializing_if = "Option::is_none")]
    asked: Option<&'static str>,
    /// The engine that searches. It is `engine`, but for subgoals of a map on which they would be slow: there
    /// it is one that prepares little.
    searched_by: &'static str,
    /// A number or "any".
    k: Value,
    placement: String,
    corners: String,
    gap: String,
    /// All options by name, with `_` for `-`. The value of a flag is true or false; levels are a number,
    /// "all", "contracted" or "labels", those of the index; memory is a number of bytes. An option that the
    /// engine does not take, or that is left out and has no default, is false or `null`.
    #[serde(flatten)]
    options: BTreeMap<String, Value>,
    smooth: bool,
    /// "linear" or "taut"; `null` unless paths are smoothed.
    smoothing: Option<&'static str>,
    /// The engine of `--reference`, which finds each query's `any_angle`; `null` without it.
    any_angle: Option<&'static str>,
    guarantee: String,
    repeat: u32,
    /// The time to prepare the search space and the index of the map that was read; with `--index`, the time
    /// to load the index instead of preparing it.
    preprocess_ns: u64,
    /// The memory of the search space and the index, beyond the map.
    index_bytes: u64,
    version: &'static str,
}

/// The wishes of a run; only those that were named.
#[derive(Debug, Serialize)]
struct WishFields {
    /// In cells.
    #[serde(skip_serializing_if = "Option::is_none")]
    tolerance: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    distance: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    nearest: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    snap: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    free_ends: Option<bool>,
    /// The cells that count as blocked.
    #[serde(skip_serializing_if = "Option::is_none")]
    block: Option<Vec<[i32; 2]>>,
    /// The cells that count as free.
    #[serde(skip_serializing_if = "Option::is_none")]
    unblock: Option<Vec<[i32; 2]>>,
    /// In cells.
    #[serde(skip_serializing_if = "Option::is_none")]
    max_cost: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    max_expansions: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    timeout_ms: Option<f64>,
}

impl From<&QueryArgs> for WishFields {
    fn from(query: &QueryArgs) -> Self {
        let &Wishes { nearest, snap, tolerance, max_cost, max_expansions, timeout, .. } = &query.wishes;
        let [distance, nearest, snap, free_ends] =
            [query.distance, nearest, snap, query.free_ends].map(|wish| wish.then_some(true));
        let [block, unblock] = [0, 1]
            .map(|at| Some(&query.cells[at]).filter(|cells| !cells.is_empty()).map(|cells| pairs(cells)));
        Self {
            distance,
            tolerance,
            nearest,
            snap,
            free_ends,
            block,
            unblock,
            max_cost,
            max_expansions,
            timeout_ms: timeout,
        }
    }
}

impl<'r> From<&RunHead<'r>> for RunLine<'r> {
    fn from(run: &RunHead<'r>) -> Self {
        let setup = run.setup;
        // The key of the other placement's rule has that rule's default.
        let (corners, gap) = match setup.rules() {
            Rules::Center(corners) => (corners, DiagonalGap::default()),
            Rules::Corner(gap) | Rules::CenterGap(gap) => (CornerRule::default(), gap),
        };
        let grid = &run.map.grid;
        Self {
            map: &run.map.name,
            width: grid.width(),
            height: grid.height(),
            free_cells: grid.free_cells(),
            grounds: run.grounds.then_some(true),
            costs: run.map.cost_bounds().map(Into::into),
            walking: run.map.walking.as_ref().map(|_| true),
            radius: Some(run.map.radius).filter(|&radius| radius > 0.0),
            resolution: run.map.frame.map(|frame| frame.resolution()),
            moved: run.query.moved,
            scenario: run.scenario,
            queries: run.queries,
            edits: run.edits,
            wishes: run.query.into(),
            setup: setup.to_string(),
            engine: run.choice.map_or(setup.engine.kind(), |_| run.searched_by).name(),
            asked: run.choice.map(|_| EngineName::Auto.name()),
            searched_by: run.searched_by.name(),
            k: match setup.k() {
                K::Finite(k) => k.get().into(),
                K::Any => K::Any.to_string().into(),
            },
            placement: setup.rules().placement().to_string(),
            corners: corners.to_string(),
            gap: gap.to_string(),
            options: run.options.iter().map(|&(option, value)| json_of(option, value)).collect(),
            smooth: setup.smoothing.is_some(),
            smoothing: setup.smoothing.map(Smoothing::name),
            any_angle: run.reference.map(Engine::name),
            guarantee: run.guarantee.to_string(),
            repeat: run.repeat,
            preprocess_ns: run.preparation.as_nanos() as u64,
            index_bytes: run.memory_bytes,
            version: env!("CARGO_PKG_VERSION"),
        }
    }
}

/// The key and the value of an option.
fn json_of(option: &EngineOption, value: Option<OptionValue>) -> (String, Value) {
    let value = match value {
        _ if option.kind == ValueKind::Flag => Value::Bool(value.is_some()),
        None => Value::Null,
        Some(OptionValue::Number(number) | OptionValue::Levels(Levels::Number(number))) => {
            number.get().into()
        }
        Some(OptionValue::Memory(memory)) => memory.bytes().into(),
        Some(value) => value.to_string().into(),
    };
    (option.name.replace('-', "_"), value)
}

/// The line of an edit.
#[derive(Debug, Serialize)]
#[serde(tag = "type", rename = "edit")]
struct EditLine {
    /// The column and the row of the first cell.
    x: u32,
    y: u32,
    /// `#` is blocked, `.` free; not on costs.
    #[serde(skip_serializing_if = "Option::is_none")]
    rows: Option<Vec<String>>,
    /// The costs of the cells, `null` for blocked ones; only on costs.
    #[serde(skip_serializing_if = "Option::is_none")]
    costs: Option<Vec<Vec<Option<f64>>>>,
    /// The number of cells that it altered.
    cells: u64,
    /// The time of the change that it ends: of the map, the search space, the index and the planner.
    nanos: u64,
    /// That the next edit belongs to the same change, whose time is told with the last.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    more: bool,
    /// That it makes the map that the run begins with out of one without obstacles: for who replays the run.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    initial: bool,
}

impl From<&EditRecord<'_>> for EditLine {
    fn from(record: &EditRecord<'_>) -> Self {
        let &EditRecord { edit, cells, nanos } = record;
        let text = |row: &[bool]| row.iter().map(|&blocked| if blocked { '#' } else { '.' }).collect();
        let row = |row: &[(Vertex, Option<f64>)]| row.iter().map(|(_, cost)| *cost).collect();
        let costs = edit.costs.as_ref();
        let width = edit.cells.rectangle().width.max(1) as usize;
        Self {
            x: edit.cells.x,
            y: edit.cells.y,
            rows: costs.is_none().then(|| edit.cells.patch.rows().map(text).collect()),
            costs: costs.map(|costs| costs.chunks(width).map(row).collect()),
            cells,
            nanos,
            more: edit.more,
            initial: edit.initial,
        }
    }
}

/// The line of a query and its answer.
#[derive(Debug, Serialize)]
#[serde(tag = "type", rename = "query")]
struct QueryLine<'a> {
    /// The number of the scenario's instance, from 0.
    index: usize,
    /// The first waypoint, if found; else the first start that was asked for.
    start: Point,
    /// The last waypoint, if found; else the first goal that was asked for.
    goal: Point,
    /// All starts that were asked for; only in a run with wishes.
    #[serde(skip_serializing_if = "Option::is_none")]
    starts: Option<&'a [Point]>,
    /// All goals that were asked for; only in a run with wishes.
    #[serde(skip_serializing_if = "Option::is_none")]
    goals: Option<&'a [Point]>,
    /// "found", "nearest" (there is no path; this one leads to the nearest vertex that can be reached),
    /// "unreachable", "stopped" or "error".
    status: &'static str,
    /// The engine that answered; only where cells count otherwise for the query, and on an index of subgoals
    /// that followed an edit.
    #[serde(skip_serializing_if = "Option::is_none")]
    searched_by: Option<&'static str>,
    /// The limit that stopped the search; only if the status is "stopped".
    #[serde(skip_serializing_if = "Option::is_none")]
    stopped_by: Option<String>,
    /// Of the path; `null` without one.
    cost: Option<f64>,
    /// The length of the path, in cells; only in a run with costs.
    #[serde(skip_serializing_if = "Option::is_none")]
    length: Option<f64>,
    /// The waypoints, of a stopped search those of the best path so far; empty without a path; not with
    /// `--distance`.
    #[serde(skip_serializing_if = "Option::is_none")]
    path: Option<Vec<Point>>,
    /// The waypoints in the world, in meters; only with `--world`.
    #[serde(skip_serializing_if = "Option::is_none")]
    world: Option<Vec<(f64, f64)>>,
    /// The sum of the path's turning angles, in degrees (Hammoud 2023); `null` without a path, and with
    /// `--distance`.
    smoothness: Option<f64>,
    /// The length that the scenario gives: optimal for k = 3 at centers under `never`; -1 if it says that
    /// there is no path. `null` without a scenario.
    reference: Option<f64>,
    /// If found, the certificate: no path at any angle between its ends is shorter. If
    /// stopped, no path of the engine's kind between the ends that were asked for is shorter: none over N(k),
    /// or by an engine of any-angle paths none at all. Else `null`.
    lower_bound: Option<f64>,
    /// `cost / lower_bound`, at least 1; `null` unless found.
    bound: Option<f64>,
    /// The length of the shortest any-angle path between the ends of the path under the same rules; `null`
    /// without `--reference`, or unless found.
    any_angle: Option<f64>,
    /// `cost / any_angle`; `null` if either is.
    ratio: Option<f64>,
    /// Nodes taken from the open list.
    expanded: u64,
    /// Nodes that entered the open list.
    generated: u64,
    /// Swaps in the open list's heap.
    percolations: u64,
    /// Cheaper paths found to known nodes.
    updated: u64,
    /// Vertices that jumps looked at.
    scanned: u64,
    /// The number of times that CHPA* left its plan.
    fallbacks: u64,
    /// The time of the query alone on a warm planner, the best of all repetitions; 0 for errors.
    nanos: u64,
    /// The error of the query; only if the status is "error".
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<&'a str>,
    /// The library's code of the error.
    #[serde(skip_serializing_if = "Option::is_none")]
    code: Option<&'static str>,
}

impl<'a> From<&'a QueryRecord> for QueryLine<'a> {
    fn from(record: &'a QueryRecord) -> Self {
        let QueryRecord { item, query, searched_by, answer, counters, nanos } = record;
        let (found, path) = (record.found(), record.path());
        let (start, goal) = record.ends();
        let has_wishes = query.as_points().is_none();
        let stopped = match answer {
            Ok(QueryAnswer::Stopped(stopped)) => Some(stopped),
            _ => None,
        };
        Self {
            index: item.index,
            start,
            goal,
            starts: has_wishes.then(|| query.starts()),
            goals: has_wishes.then(|| query.goals()),
            searched_by: searched_by.map(Engine::name),
            status: record.status(),
            stopped_by: stopped.map(|stopped| stopped.by.to_string()),
            cost: record.cost(),
            length: None,
            path: Some(path.into_iter().flat_map(Path::points).collect()),
            world: None,
            smoothness: path.map(Path::smoothness),
            reference: item.reference,
            lower_bound: found
                .and_then(|found| found.lower_bound)
                .or(stopped.map(|stopped| stopped.lower_bound)),
            bound: found.and_then(Found::bound),
            any_angle: found.and_then(|found| found.any_angle),
            ratio: found.and_then(Found::ratio),
            expanded: counters.expanded,
            generated: counters.generated,
            percolations: counters.percolations,
            updated: counters.updated,
            scanned: counters.scanned,
            fallbacks: counters.fallbacks,
            nanos: *nanos,
            error: answer.as_ref().err().map(|error| &*error.text),
            code: answer.as_ref().err().map(|error| error.code.name()),
        }
    }
}

/// Vertices as `[x, y]`.
fn pairs(vertices: &[Vertex]) -> Vec<[i32; 2]> {
    vertices.iter().map(|at| [at.x, at.y]).collect()
}
