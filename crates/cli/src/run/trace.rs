//! `mediant run --trace`: the events of a search in a file.

use std::{io, path};

use mediant::{
    Outcome, PlacementKind, Planner, Query, Request, errors::QueryError, grid::Grid, search::Tracer,
};
use mediant_formats::NewFile;

use crate::{failure::Failure, write::write_file};

/// The file of a trace.
pub(crate) struct TraceFile<'s>(pub(crate) &'s path::Path);

impl TraceFile<'_> {
    /// Writes the search of a query whose answer is known. An invalid query makes a trace without events.
    pub(crate) fn write(
        self,
        (grid, placement): (&Grid, PlacementKind),
        planner: &mut Planner,
        (query, request): (Query, Request),
        answer: &Result<Outcome, QueryError>,
    ) -> Result<(), Failure> {
        let write = |file: &mut NewFile| -> io::Result<()> {
            let mut tracer = Tracer::new(file, grid, placement)?;
            if let Ok(outcome) = answer {
                tracer.begin(query, Some(outcome));
                // The same request gives the same answer.
                _ = planner.find_observed(request, &mut tracer);
                tracer.end(Some(outcome));
            }
            tracer.finish().map(drop)
        };
        write_file(self.0, write)
    }
}
