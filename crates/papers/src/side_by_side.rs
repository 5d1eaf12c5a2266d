//! Our engines side by side on the instances on which other programs were timed.

use std::path::Path;

use mediant_bench::{Baseline, Competitor, Problem, ReferenceTimings, Timing, measure};
use mediant_report::{Column, Row};
use mediant_sets::Archive;
use serde::{Deserialize, Serialize};

use super::{
    context::{Context, How},
    experiment::Findings,
    maps::Map,
};
use crate::Error;

/// The sets of the maps of `benchdata/reference_timings.json`.
pub(super) const SETS: &[&str] = &["dao", "bg512", "wc3maps512", "sc1", "random", "room", "street"];
/// The maps of a quick run: small ones.
const QUICK: [&str; 4] = ["arena2", "hrt201n", "AR0011SR", "Berlin_0_256"];

/// A timing in the form in which an interrupted run keeps it.
#[derive(Serialize, Deserialize)]
struct OnMap {
    competitor: String,
    queries: u64,
    micros: f64,
    cost: f64,
    seconds: Option<f64>,
    bytes: Option<f64>,
    index: Option<f64>,
    kept: Option<String>,
}

impl OnMap {
    fn new(queries: usize, timing: &Timing) -> Self {
        let made = timing.preparation;
        Self {
            competitor: timing.competitor.clone(),
            queries: queries as u64,
            micros: timing.micros,
            cost: timing.mean_cost,
            seconds: made.map(|made| made.seconds),
            bytes: made.map(|made| made.bytes as f64),
            index: made.map(|made| made.index_bytes as f64),
            kept: made.and_then(|made| made.kept).map(|kept| kept.name().to_owned()),
        }
    }

    fn row(&self, map: &Map, timed: bool) -> Row {
        let row = Row::new().key("map", &map.name).key("set", &map.set).key("competitor", &self.competitor);
        let row = self.kept.iter().fold(row, |row, kept| row.key("kept", kept));
        let row = row.with("queries", self.queries as f64).with("cost", self.cost).with("bytes", self.bytes);
        let row = row.with("index", self.index).with("micros", timed.then_some(self.micros));
        row.with("preparation", self.seconds)
    }
}

/// The reference timings that the program has built in.
pub(super) fn references() -> Result<ReferenceTimings, Error> {
    ReferenceTimings::bundled().map_err(|wrong| Error::Reproduce(wrong.to_string()))
}

/// Measures the competitors, and the baselines beside them, on the maps of the reference timings.
pub(super) fn findings(context: &Context<'_>, mut competitors: Vec<Competitor>) -> Result<Findings, Error> {
    let references = references()?;
    let timed = context.passes() > 0;
    if timed {
        competitors.extend(Baseline::ALL.map(Competitor::Baseline));
    }
    let every = references.instances.every;
    let maps = maps(context, &references)?;
    let passes = context.passes() as usize;
    let measured = context.each("maps", How::Timed, &maps, |map| on_map(map, every, &competitors, passes))?;
    let rows = maps.iter().zip(&measured).flat_map(|(map, all)| all.iter().map(|one| one.row(map, timed)));
    let columns = vec![
        Column::key("map", "the map"),
        Column::key("set", "its set"),
        Column::key("competitor", "our engine, or a crate that was measured on both machines"),
        Column::key("kept", "what engine subgoal keeps: labels, contraction, or nothing where that is best"),
        Column::count("queries", "", "queries"),
        Column::count("cost", "cells", "mean length of a path"),
        Column::count("bytes", "bytes", "what is prepared of the map, beyond the map"),
        Column::count("index", "bytes", "the part of it that the index takes"),
        Column::time("micros", "µs", "mean time of a query"),
        Column::time("preparation", "s", "time to prepare the map, on all cores"),
    ];
    let instances = measured.iter().filter_map(|all| all.first()).map(|one| one.queries).sum();
    let drawn = format!("of each scenario the instances whose index {every} divides");
    Ok(Findings { columns, rows: rows.collect(), maps: maps.len(), instances, drawn, seeded: false })
}

fn maps(context: &Context<'_>, references: &ReferenceTimings) -> Result<Vec<Map>, Error> {
    if context.is_bundled() {
        return context.maps("bundled", usize::MAX);
    }
    let sets = context.sets();
    let mut maps = Vec::new();
    for row in &references.maps {
        let wanted = context.quick_or(QUICK.contains(&row.map.as_str()), true);
        if wanted && sets.contains(&row.set.as_str()) {
            maps.extend(context.named(&row.set, &[&row.map])?);
        }
    }
    Ok(maps)
}

fn on_map(map: &Map, every: usize, competitors: &[Competitor], passes: usize) -> Result<Vec<OnMap>, Error> {
    let archive = Archive::new(map.path.parent().and_then(Path::parent).map(Into::into));
    let folder = map.path.parent().and_then(Path::file_name).unwrap_or_default().to_string_lossy();
    let wrong = |wrong: &dyn std::error::Error| Error::Reproduce(wrong.to_string());
    let problem = Problem::load(&archive, &folder, &map.name, every).map_err(|error| wrong(&error))?;
    let problem = problem.ok_or_else(|| Error::Reproduce(format!("{}: no scenario", map.name)))?;
    let record = measure(&problem, competitors, passes).map_err(|error| wrong(&error))?;
    Ok(record.timings.iter().map(|timing| OnMap::new(record.instances, timing)).collect())
}
