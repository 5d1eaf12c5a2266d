//! Times of fields, by the side of the surface and by k.

use std::{num::NonZeroUsize, time::Instant};

use mediant::{Costs, Vertex};
use mediant_oracle::{Rng, Surface};
use mediant_report::{Row, stats::median};

use super::{
    Part, SEED,
    surfaces::{space, surface},
};
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
        let surface = surface(side, &Surface::Friction.costs(side, &mut Rng::new(SEED)))?;
        let great = GREAT_KS.into_iter().filter(|_| side == SIDE_OF_GREAT_KS);
        for k in KS.into_iter().chain(great) {
            rows.push(row(&surface, side, k)?);
        }
    }
    Ok(rows)
}

fn row(surface: &Costs, side: u32, k: u32) -> Result<Row, CompareError> {
    let space = space(surface, k)?;
    let source = Vertex::new(side as i32 / 2, side as i32 / 2);
    let nanoseconds = |threads: NonZeroUsize| -> Result<Option<f64>, CompareError> {
        let mut fields = space.fields()?.on_threads(threads);
        let mut times = Vec::new();
        for _ in 0..=PASSES {
            let begin = Instant::now();
            let field = fields.field([source])?;
            times.push(begin.elapsed().as_secs_f64() * 1e9 / f64::from(side).powi(2));
            drop(field);
        }
        Ok(median(&times[1..]))
    };
    let two = nanoseconds(NonZeroUsize::MIN.saturating_add(1))?;
    let one = nanoseconds(NonZeroUsize::MIN)?;
    Ok(Part::Fields.row(Surface::Friction.name(), side, k).with("cell", one).with("two", two))
}
