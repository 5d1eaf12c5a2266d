//! Times of paths, with landmarks and without.

use std::{sync::Arc, time::Instant};

use mediant_costs::{CostAStar, CostGraph, Landmarks};
use mediant_grid::{Interrupt, Vertex};
use mediant_oracle::Rng;
use mediant_report::Row;
use mediant_search::{Counters, Ends, Planner};

use super::{Part, SEED, surfaces::Kind};
use crate::compare::CompareError;

const SIDE: u32 = 512;
const KS: [u32; 2] = [3, 4];
pub(super) const QUERIES: usize = 100;
const PASSES: usize = 3;

/// Random queries between which there is a path. The planners answer them in turn, all at once, pass by pass,
/// and find paths of the same costs.
pub(super) fn measure(surfaces: &[Kind]) -> Result<Vec<Row>, CompareError> {
    let mut rows = Vec::new();
    for (surface, k) in surfaces.iter().flat_map(|surface| KS.map(|k| (surface, k))) {
        let graph = surface.graph(SIDE, k)?;
        let begin = Instant::now();
        let landmarks = Landmarks::new(&graph, Landmarks::DEFAULT_COUNT, &Interrupt::NEVER);
        let landmarks = Arc::new(landmarks.map_err(CompareError::of_costs)?);
        let prepared = begin.elapsed().as_secs_f64();
        let guided =
            CostAStar::with_landmarks(Arc::clone(&graph), landmarks).map_err(CompareError::of_costs)?;
        let mut planners = [CostAStar::new(Arc::clone(&graph)), guided];
        let queries = queries(&graph, &mut planners[0])?;
        let mut counters = [Counters::default(), Counters::default()];
        let mut times = [0.0; 2];
        for pass in 0..=PASSES {
            let mut costs = [Vec::new(), Vec::new()];
            for (at, planner) in planners.iter_mut().enumerate() {
                let begin = Instant::now();
                for &ends in &queries {
                    let answer = planner.solve_observed(ends, &mut counters[at])?;
                    costs[at].push(answer.path().and_then(|path| graph.path_cost(path)));
                }
                // The first pass warms.
                times[at] += if pass == 0 { 0.0 } else { begin.elapsed().as_secs_f64() };
            }
            if costs[0] != costs[1] {
                let total =
                    |costs: &[Option<_>]| costs.iter().flatten().map(|&cost| graph.to_f64(cost)).sum();
                return Err(CompareError::Lengths {
                    engine: "A* with landmarks".to_owned(),
                    map: surface.name().to_owned(),
                    expected: total(&costs[0]),
                    found: total(&costs[1]),
                });
            }
        }
        let all = (PASSES * queries.len()) as f64;
        let expanded = counters.map(|counters| counters.expanded as f64 / (all + queries.len() as f64));
        let [query, with] = times.map(|time| time * 1e3 / all);
        let row = Part::Paths.row(surface.name(), SIDE, k).with("prepared", prepared);
        let row = row.with("expanded", expanded[0]).with("guided", expanded[1]);
        rows.push(row.with("query", query).with("landmarks", with));
    }
    Ok(rows)
}

fn queries(graph: &CostGraph, planner: &mut CostAStar) -> Result<Vec<Ends>, CompareError> {
    let mut rng = Rng::new(SEED);
    let mut queries = Vec::new();
    while queries.len() < QUERIES {
        let mut vertex = || Vertex::new(rng.below(SIDE) as i32, rng.below(SIDE) as i32);
        let ends = Ends::new(vertex(), vertex());
        let is_free = graph.is_free(ends.start) && graph.is_free(ends.goal);
        if is_free && planner.solve(ends)?.path().is_some() {
            queries.push(ends);
        }
    }
    Ok(queries)
}
