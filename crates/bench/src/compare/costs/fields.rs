//! Times of fields, by the side of the surface and by k.

use std::{num::NonZeroUsize, sync::Arc, time::Instant};

use mediant_costs::{CostField, CostFieldQuery, CostSurface};
use mediant_grid::{Interrupt, Vertex};
use mediant_oracle::{Rng, Surface};
use mediant_report::{Row, stats::median};

use super::{Part, SEED, surfaces::graph};
use crate::compare::CompareError;

const SIDES: [u32; 5] = [1_024, 1_500, 2_048, 4_096, 8_192];
const KS: [u32; 4] = [2, 3, 4, 5];
/// The k that are measured on one side alone.
const GREAT_KS: [u32; 3] = [6, 7, 8];
const SIDE_OF_GREAT_KS: u32 = 1_500;
/// The timed fields, of which the median counts. Another comes before them.
pub(super) const PASSES: usize = 3;

/// Random friction, one source in the middle.
pub(super) fn measure() -> Result<Vec<Row>, CompareError> {
    let mut rows = Vec::new();
    for side in SIDES {
        let costs = Surface::Friction.costs(side, &mut Rng::new(SEED));
        let cost = |x: u32, y: u32| Some(f64::from(costs[y as usize * side as usize + x as usize]));
        let surface = Arc::new(CostSurface::from_fn(side, side, cost).map_err(CompareError::of_costs)?);
        drop(costs);
        let great = GREAT_KS.into_iter().filter(|_| side == SIDE_OF_GREAT_KS);
        for k in KS.into_iter().chain(great) {
            rows.push(row(&surface, side, k)?);
        }
    }
    Ok(rows)
}

fn row(surface: &Arc<CostSurface>, side: u32, k: u32) -> Result<Row, CompareError> {
    let graph = graph(surface, k)?;
    let source = [Vertex::new(side as i32 / 2, side as i32 / 2)];
    let cells = f64::from(side) * f64::from(side);
    let mut bytes = 0;
    let mut nanoseconds = |threads: NonZeroUsize| -> Result<Option<f64>, CompareError> {
        let mut times = Vec::new();
        for _ in 0..=PASSES {
            let begin = Instant::now();
            let query = CostFieldQuery::new(&source);
            let field = CostField::on_threads(Arc::clone(&graph), query, threads, &Interrupt::NEVER);
            let field = field.map_err(CompareError::of_costs)?;
            times.push(begin.elapsed().as_secs_f64() * 1e9 / cells);
            bytes = CostField::bytes(&graph, false) + field.queue_bytes();
        }
        Ok(median(&times[1..]))
    };
    let two = nanoseconds(NonZeroUsize::MIN.saturating_add(1))?;
    let one = nanoseconds(NonZeroUsize::MIN)?;
    let row = Part::Fields.row(Surface::Friction.name(), side, k).with("cell", one).with("two", two);
    Ok(row.with("bytes", bytes as f64 / cells))
}
