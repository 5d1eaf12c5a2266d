//! The side by side: check, then time, all competitors in turn.

use std::{hint::black_box, time::Instant};

use mediant_engines::EngineError;
use mediant_formats::scenario_tolerance;
use mediant_grid::{CornerRule, Rules};
use mediant_moves::{FiniteK, K};
use mediant_report::stats::median;
use mediant_search::QueryError;
use serde::Serialize;

use crate::{Baseline, Competitor, Problem, competitor::Runner};

/// What all competitors took on one map.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MapRecord {
    /// The map's name, without extension.
    pub map: String,
    /// The benchmark set that it belongs to.
    pub set: String,
    /// The number of queries.
    pub instances: usize,
    /// The times, in the order of the competitors.
    pub timings: Vec<Timing>,
}

/// What one competitor took.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Timing {
    /// Who.
    pub competitor: String,
    /// The mean time of a query in microseconds, paths included: the median over the passes.
    pub micros: f64,
    /// The mean of each pass.
    pub passes: Vec<f64>,
    /// The mean length of the paths, in cells.
    pub mean_cost: f64,
    /// What came before the first query; `None` of a baseline.
    pub preparation: Option<Preparation>,
}

/// What one of our engines makes of a map before its first query: the search graph and its index.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Preparation {
    /// The time, measured once.
    pub seconds: f64,
    /// The memory beyond the map.
    pub bytes: u64,
}

/// A competitor that could not be measured, or answered wrong.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MeasureError {
    /// A planner that cannot be made.
    #[error("{competitor} on map `{map}`: {source}")]
    Engine {
        /// Who.
        competitor: String,
        /// Where.
        map: String,
        /// Why.
        source: EngineError,
    },
    /// A query that was refused.
    #[error("{competitor} on map `{map}`, instance {index}: {source}")]
    Query {
        /// Who.
        competitor: String,
        /// Where.
        map: String,
        /// The instance.
        index: usize,
        /// Why.
        source: QueryError,
    },
    /// A path of another length than it must have, or none.
    #[error(
        "{competitor} on map `{map}`, instance {index}: expected a path of length {expected} ({by}), found {found}"
    )]
    Answer {
        /// Who.
        competitor: String,
        /// Where.
        map: String,
        /// The instance.
        index: usize,
        /// The length.
        expected: f64,
        /// Who says so.
        by: &'static str,
        /// What was found.
        found: String,
    },
}

/// Times the competitors on a problem: a first pass of each, untimed, warms it and checks its answers; then `passes` rounds
/// (at least one) in which each takes two passes after the other, the first untimed: it warms the caches.
///
/// Those that promise the shortest paths of the same problem must find paths as long as each other's, at k = 3 between centers under
/// `Never`, which [`Baseline::Pathfinding`] solves too, also as the scenario says. Any other must find a path, as it allows more
/// moves or as many ways through.
///
/// # Errors
/// [`MeasureError`] for the first competitor that does not.
pub fn measure(
    problem: &Problem,
    competitors: &[Competitor],
    passes: usize,
) -> Result<MapRecord, MeasureError> {
    let prepare = |&competitor: &Competitor| {
        Runner::new(competitor, problem).map_err(|source| MeasureError::Engine {
            competitor: competitor.to_string(),
            map: problem.name.clone(),
            source,
        })
    };
    let mut runners: Vec<Runner> = competitors.iter().map(prepare).collect::<Result<_, _>>()?;

    let mut optima: Vec<(Optimum, Vec<f64>)> = Vec::new();
    let mut timings = Vec::with_capacity(competitors.len());
    for (runner, &competitor) in runners.iter_mut().zip(competitors) {
        let promise = promise(competitor);
        let known = optima.iter().find(|(optimum, _)| promise == Some(*optimum));
        let costs = check(problem, competitor, runner, known.map_or(&[], |(_, costs)| costs))?;
        let mean_cost = costs.iter().sum::<f64>() / costs.len() as f64;
        let (passes, preparation) = (Vec::new(), runner.preparation());
        let competitor = competitor.to_string();
        timings.push(Timing { competitor, micros: 0.0, passes, mean_cost, preparation });
        optima.extend(promise.map(|optimum| (optimum, costs)));
    }
    for _ in 0..passes.max(1) {
        for (runner, timing) in runners.iter_mut().zip(&mut timings) {
            // Between two passes the others have filled the caches with their own; the programs of the table ran alone.
            pass(problem, runner);
            timing.passes.push(pass(problem, runner));
        }
    }
    for timing in &mut timings {
        timing.micros = median(&timing.passes).unwrap_or_default();
    }
    Ok(MapRecord { map: problem.name.clone(), set: problem.set.clone(), instances: problem.len(), timings })
}

/// A problem of which the shortest paths are promised: over which directions, under which rules.
type Optimum = (K, Rules);

/// The problem of the scenarios.
const SCENARIOS: Optimum = (K::Finite(FiniteK::N8), Rules::Center(CornerRule::Never));

/// The problem of which a competitor promises the shortest paths, if of any.
fn promise(competitor: Competitor) -> Option<Optimum> {
    match competitor {
        Competitor::Ours(setup) => setup.optimal_over().map(|k| (k, setup.rules)),
        Competitor::Baseline(Baseline::Pathfinding) => Some(SCENARIOS),
        Competitor::Baseline(Baseline::GridPathfinding) => None,
    }
}

/// The lengths of all paths, checked. `optima` are those that another competitor found for the same problem, if any.
fn check(
    problem: &Problem,
    competitor: Competitor,
    runner: &mut Runner,
    optima: &[f64],
) -> Result<Vec<f64>, MeasureError> {
    let mut costs = Vec::with_capacity(problem.len());
    for (i, case) in problem.cases.iter().enumerate() {
        let (map, index) = (problem.name.clone(), case.index);
        let answer = runner.solve(case.query).map_err(|source| MeasureError::Query {
            competitor: competitor.to_string(),
            map: map.clone(),
            index,
            source,
        })?;
        let cost = answer.cost();
        // Whatever the problem, the scenario says that there is a path.
        let is_length = promise(competitor) == Some(SCENARIOS);
        let tolerance = if is_length { scenario_tolerance(case.optimum) } else { f64::INFINITY };
        let scenario = (case.optimum, tolerance, "the scenario");
        // Two programs differ by the rounding of their sums alone.
        let other = optima.get(i).map(|&cost| (cost, 1e-8 * (1.0 + cost), "another competitor"));
        let is_wrong = |&(expected, tolerance, _): &(f64, f64, _)| match cost {
            Some(cost) => (cost - expected).abs() > tolerance,
            None => true,
        };
        if let Some((expected, _, by)) = [Some(scenario), other].into_iter().flatten().find(is_wrong) {
            let found = cost.map_or("none".to_owned(), |cost| cost.to_string());
            let competitor = competitor.to_string();
            return Err(MeasureError::Answer { competitor, map, index, expected, by, found });
        }
        costs.extend(cost);
    }
    Ok(costs)
}

/// The mean time of a query in microseconds.
fn pass(problem: &Problem, runner: &mut Runner) -> f64 {
    let begin = Instant::now();
    for case in &problem.cases {
        // The check has seen every answer, so none is an error here.
        let _ = black_box(runner.solve(black_box(case.query)));
    }
    begin.elapsed().as_secs_f64() * 1e6 / problem.len() as f64
}
