//! Fields where cells have costs.

use std::{num::NonZeroUsize, sync::Arc};

use mediant_costs::{CostField, CostFieldError, CostFieldQuery, CostGraph};
use mediant_grid::Interrupt;
use mediant_search::{FieldQuery, QueryError};

use super::{Field, Inner, sources::vertices};
use crate::{change::Change, error::Error, memory_check};

/// A field of costs. With one source that is the nearest to all; of several it is written down which is.
pub(super) fn on_costs(
    (graph, threads): (&Arc<CostGraph>, NonZeroUsize),
    query: FieldQuery<'_>,
    interrupt: &Interrupt,
) -> Result<Field, Error> {
    let sources = vertices(&query)?;
    let has_several = sources.len() > 1;
    let query = CostFieldQuery::new(sources).within(query.limit);
    let query = if has_several { query.with_allocation() } else { query };
    memory_check::check("the field", CostField::bytes(graph, has_several) as u64)?;
    let field = CostField::on_threads(Arc::clone(graph), query, threads, interrupt).map_err(told)?;
    Ok(Field { inner: Inner::Costs(field) })
}

/// A field of costs after a change; anew where that takes less work.
pub(super) fn repaired(field: &CostField, change: &Change, interrupt: &Interrupt) -> Result<Field, Error> {
    let (after, query) = (change.after(), field.query());
    if let Some(surface) = after.surface() {
        let graph = &surface.graph;
        let cells = change.cells_between([field.graph().map(), graph.map()]);
        memory_check::check("the field", CostField::bytes(graph, query.allocation) as u64)?;
        if let Some(field) = field.repaired(graph, &cells, interrupt).map_err(told)? {
            return Ok(Field { inner: Inner::Costs(field) });
        }
    }
    after.field_of(FieldQuery::new(query.sources).within(query.limit), interrupt)
}

/// The error of a field of costs as one of the library.
pub(super) fn told(error: CostFieldError) -> Error {
    match error {
        CostFieldError::Query(error) => error.into(),
        CostFieldError::Mismatch(mismatch) => mismatch.into(),
        CostFieldError::Interrupted(interrupted) => interrupted.into(),
        _ => QueryError::CostLimit.into(),
    }
}
