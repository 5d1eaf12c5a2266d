//! One of our engines as the other programs run: alone, on one map.

use std::{
    ffi::OsStr,
    fs,
    hint::black_box,
    path::Path,
    time::{Duration, Instant},
};

use mediant::{Map, Planner, Setup};
use mediant_formats::{MapFile, Scenario, Tiles};
use mediant_search::Path as Found;

use super::{super::CompareError, report::Report};
use crate::{Preparation, Problem, ProblemError, problem::Case};

/// The arguments after `--alone`: a setup, and those of every program.
///
/// # Errors
/// [`CompareError::Alone`] for arguments that are none; [`CompareError`] for files that cannot be read, and
/// for a setup that does not exist.
pub(in super::super) fn run(words: &[String]) -> Result<Report, CompareError> {
    let wrong = |reason: &str| CompareError::Alone {
        engine: words.first().cloned().unwrap_or_default(),
        map: words.get(1).cloned().unwrap_or_default(),
        reason: format!("{reason}; expected SETUP MAP SCENARIO PASSES SECONDS"),
    };
    let [setup, map, scenario, passes, seconds] = words else { return Err(wrong("five words are needed")) };
    let setup: Setup = setup.parse().map_err(|_| wrong("no setup"))?;
    let passes: usize = passes.parse().map_err(|_| wrong("no number of passes"))?;
    let seconds = Duration::try_from_secs_f64(seconds.parse().map_err(|_| wrong("no number of seconds"))?);
    let seconds = seconds.map_err(|_| wrong("no number of seconds"))?;
    report(setup, &problem(Path::new(map), Path::new(scenario))?, passes, seconds)
}

fn problem(map: &Path, scenario: &Path) -> Result<Problem, CompareError> {
    let name = map.file_stem().map(OsStr::to_string_lossy).unwrap_or_default().into_owned();
    let text = fs::read(map).map_err(CompareError::at_read(map))?;
    let queries = fs::read(scenario).map_err(CompareError::at_read(scenario))?;
    let map = MapFile::from_bytes(text, Tiles::default())
        .map_err(|source| ProblemError::Map { name: name.clone(), source })?;
    let queries = Scenario::from_bytes(queries)
        .map_err(|source| ProblemError::Scenario { name: name.clone(), source })?;
    Ok(Problem::new("", &name, map.to_grid(), &queries, 1)?)
}

fn report(setup: Setup, problem: &Problem, passes: usize, seconds: Duration) -> Result<Report, CompareError> {
    let begin = Instant::now();
    let space = setup.space(&Map::from(problem.grid().clone()))?;
    let index = setup.prepare(&space)?;
    let prepared = Preparation::of(&space, &index, begin.elapsed().as_secs_f64());
    let mut planner = index.planner();
    let mut times = vec![pass(&mut planner, problem)];
    let begin = Instant::now();
    while times.len() <= passes || begin.elapsed() < seconds {
        times.push(pass(&mut planner, problem));
    }
    Ok(Report {
        prepared: Some((prepared.seconds, Some(prepared.bytes as f64))),
        passes: times,
        costs: lengths(&mut planner, problem)?,
    })
}

/// Answers all queries once; microseconds.
fn pass(planner: &mut Planner, problem: &Problem) -> f64 {
    let begin = Instant::now();
    for case in &problem.cases {
        // The lengths are asked for afterwards, so that an error is found there.
        let _ = black_box(planner.find(black_box(case.query)));
    }
    begin.elapsed().as_secs_f64() * 1e6
}

/// The lengths of all paths; -1 for none.
pub(super) fn lengths(planner: &mut Planner, problem: &Problem) -> Result<Vec<f64>, CompareError> {
    let length = |case: &Case| {
        let answer = planner.find(case.query)?;
        Ok(answer.path().map_or(-1.0, Found::cost))
    };
    problem.cases.iter().map(length).collect()
}
