//! Times of paths, with landmarks and without.

use std::time::Instant;

use mediant::{Engine, Planner, Space, Vertex};
use mediant_oracle::Rng;
use mediant_report::Row;
use mediant_search::Ends;

use super::{
    Part, SEED,
    surfaces::{Kind, space},
};
use crate::compare::CompareError;

const SIDE: u32 = 512;
const KS: [u32; 2] = [3, 4];
pub(super) const QUERIES: usize = 100;
const PASSES: usize = 3;

/// Random queries between which there is a path. The planners answer them in turn, all at once, pass by pass,
/// and find paths of the same costs.
pub(super) fn measure(surfaces: &[Kind]) -> Result<Vec<Row>, CompareError> {
    let mut rows = Vec::new();
    for surface in surfaces {
        let costs = surface.surface(SIDE)?;
        for k in KS {
            let space = space(&costs, k)?;
            let queries = queries(&space)?;
            let begin = Instant::now();
            let index = space.prepare(Engine::Landmarks)?;
            let prepared = begin.elapsed().as_secs_f64();
            let mut planners = [space.planner(Engine::AStar)?, index.try_planner()?];
            let mut works = [Work::default(), Work::default()];
            // The first pass warms.
            for pass in 0..=PASSES {
                for (planner, work) in planners.iter_mut().zip(&mut works) {
                    work.add(planner, &queries, pass > 0)?;
                }
            }
            let [alone, guided] = &works;
            if alone.cost.to_bits() != guided.cost.to_bits() {
                let (expected, found) = (alone.cost, guided.cost);
                let (engine, map) = (Engine::Landmarks.to_string(), surface.name().to_owned());
                return Err(CompareError::Lengths { engine, map, expected, found });
            }
            let row = Part::Paths.row(surface.name(), SIDE, k).with("prepared", prepared);
            let row = row.with("expanded", alone.expanded()).with("guided", guided.expanded());
            rows.push(row.with("query", alone.millis()).with("landmarks", guided.millis()));
        }
    }
    Ok(rows)
}

/// The work of a planner.
#[derive(Default)]
struct Work {
    seconds: f64,
    expanded: u64,
    /// The sum of all costs, in the order of the queries.
    cost: f64,
}

impl Work {
    fn add(&mut self, planner: &mut Planner, queries: &[Ends], timed: bool) -> Result<(), CompareError> {
        let begin = Instant::now();
        for &ends in queries {
            let (answer, counters) = planner.find_counted(ends)?;
            if timed {
                self.expanded += counters.expanded;
                self.cost += answer.cost().unwrap_or(f64::NAN);
            }
        }
        self.seconds += if timed { begin.elapsed().as_secs_f64() } else { 0.0 };
        Ok(())
    }

    fn expanded(&self) -> f64 {
        self.expanded as f64 / (PASSES * QUERIES) as f64
    }

    fn millis(&self) -> f64 {
        self.seconds * 1e3 / (PASSES * QUERIES) as f64
    }
}

fn queries(space: &Space) -> Result<Vec<Ends>, CompareError> {
    let mut rng = Rng::new(SEED);
    let mut queries = Vec::new();
    while queries.len() < QUERIES {
        let mut vertex = || Vertex::new(rng.below(SIDE) as i32, rng.below(SIDE) as i32);
        let (start, goal) = (vertex(), vertex());
        if start != goal && space.connected(start, goal) {
            queries.push(Ends::new(start, goal));
        }
    }
    Ok(queries)
}
