//! Competitors side by side: all are checked, then timed in turn.

use std::{hint::black_box, time::Instant};

use mediant::Error;
use mediant_formats::scenario_tolerance;
use mediant_grid::{CornerRule, Rules};
use mediant_moves::{FiniteK, K};
use mediant_report::stats::median;
use mediant_search::QueryError;
use serde::Serialize;

use crate::{Baseline, Competitor, Preparation, Problem, competitor::Runner};

/// The times of all competitors on one map.
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

/// The times of one competitor.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Timing {
    /// The competitor's name.
    pub competitor: String,
    /// The mean time of a query in microseconds, paths included: the median over the passes.
    pub micros: f64,
    /// The mean time of a query in each pass, in microseconds.
    pub passes: Vec<f64>,
    /// The mean length of the paths, in cells.
    pub mean_cost: f64,
    /// The preparation before the first query; `None` for a baseline.
    pub preparation: Option<Preparation>,
}

/// A competitor that could not be measured, or gave a wrong answer.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MeasureError {
    /// A planner that cannot be made.
    #[error("{competitor} on map `{map}`: {source}")]
    Engine {
        /// The competitor.
        competitor: String,
        /// The map.
        map: String,
        /// The reason.
        source: Box<Error>,
    },
    /// A query that was refused.
    #[error("{competitor} on map `{map}`, instance {index}: {source}")]
    Query {
        /// The competitor.
        competitor: String,
        /// The map.
        map: String,
        /// The index of the instance in the scenario.
        index: usize,
        /// The reason.
        source: QueryError,
    },
    /// A path of the wrong length, or none.
    #[error(
        "{competitor} on map `{map}`, instance {index}: expected a path of length {expected} ({by}), found \
         {found}"
    )]
    Answer {
        /// The competitor.
        competitor: String,
        /// The map.
        map: String,
        /// The index of the instance in the scenario.
        index: usize,
        /// The length that it must have.
        expected: f64,
        /// The source of that length: the scenario or a competitor.
        by: &'static str,
        /// The length that was found, or `none`.
        found: String,
    },
}

/// Times the competitors on a problem. In a first pass of each, untimed, its answers are checked. Then come
/// `passes` rounds (at least one) in which each competitor makes two passes, of which the first, untimed,
/// warms the caches.
///
/// Competitors that promise shortest paths of the same problem (directions and rules) must find paths of
/// equal length. At k = 3 between centers under `Never`, which [`Baseline::Pathfinding`] solves too, these
/// must also have the scenario's length. All others must find a path.
///
/// # Errors
/// [`MeasureError`] for the first competitor that does not.
pub fn measure(
    problem: &Problem,
    competitors: &[Competitor],
    passes: usize,
) -> Result<MapRecord, MeasureError> {
    let mut runners: Vec<Runner> = Vec::with_capacity(competitors.len());
    for &competitor in competitors {
        let runner = Runner::new(competitor, problem, &runners);
        runners.push(runner.map_err(|source| MeasureError::Engine {
            competitor: competitor.to_string(),
            map: problem.name.clone(),
            source: source.into(),
        })?);
    }
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
            // The others have filled the caches since the last pass; the programs of the reference timings
            // ran alone.
            pass(problem, runner);
            timing.passes.push(pass(problem, runner));
        }
    }
    for timing in &mut timings {
        timing.micros = median(&timing.passes).unwrap_or_default();
    }
    Ok(MapRecord { map: problem.name.clone(), set: problem.set.clone(), instances: problem.len(), timings })
}

/// A problem whose shortest paths are promised: the directions and the rules.
type Optimum = (K, Rules);

/// The problem of the scenarios.
const SCENARIOS: Optimum = (K::Finite(FiniteK::N8), Rules::Center(CornerRule::Never));

/// The problem whose shortest paths a competitor promises, if any.
fn promise(competitor: Competitor) -> Option<Optimum> {
    match competitor {
        Competitor::Typed(engine) => promise(Competitor::Ours(engine.setup())),
        Competitor::Ours(setup) | Competitor::Distance(setup) => {
            setup.optimal_over().map(|k| (k, setup.rules()))
        }
        Competitor::Baseline(Baseline::Pathfinding) => Some(SCENARIOS),
        Competitor::Baseline(Baseline::GridPathfinding) => None,
    }
}

/// Checks all paths and returns their lengths. `optima` are the lengths that another competitor found for the
/// same problem; empty if there is none.
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
        // Other problems have other lengths, but a path as well.
        let is_length = promise(competitor) == Some(SCENARIOS);
        let tolerance = if is_length { scenario_tolerance(case.optimum) } else { f64::INFINITY };
        let scenario = (case.optimum, tolerance, "the scenario");
        // Lengths of two programs differ only by the rounding of their sums.
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

/// Answers all queries once. Returns the mean time of a query in microseconds.
fn pass(problem: &Problem, runner: &mut Runner) -> f64 {
    let begin = Instant::now();
    for case in &problem.cases {
        // All answers were checked before, so that none is an error.
        let _ = black_box(runner.solve(black_box(case.query)));
    }
    begin.elapsed().as_secs_f64() * 1e6 / problem.len() as f64
}
