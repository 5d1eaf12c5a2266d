//! `mediant run --trace`: the events of a search in a file.

use std::{
    fs::File,
    io::{self, BufWriter},
    path,
};

use mediant::{Planner, Tracer};
use mediant_grid::{Grid, PlacementKind};
use mediant_search::{Outcome, Query, QueryError, Request};

use crate::failure::Failure;

/// The file of a trace.
pub(crate) struct TraceFile<'s> {
    path: &'s path::Path,
    out: BufWriter<File>,
}

impl<'s> TraceFile<'s> {
    pub(crate) fn create(path: &'s path::Path) -> Result<Self, Failure> {
        let file = File::create(path).map_err(Failure::writing(path))?;
        Ok(Self { path, out: BufWriter::new(file) })
    }

    /// Writes the search of a query whose answer is known. An invalid query makes a trace without events.
    pub(crate) fn write(
        self,
        (grid, placement): (&Grid, PlacementKind),
        planner: &mut Planner,
        (query, request): (Query, Request),
        answer: &Result<Outcome, QueryError>,
    ) -> Result<(), Failure> {
        let write = || -> io::Result<()> {
            let mut tracer = Tracer::new(self.out, grid, placement)?;
            if let Ok(outcome) = answer {
                tracer.begin(query, Some(outcome));
                // The same request gives the same answer.
                _ = planner.find_observed(request, &mut tracer);
                tracer.end(Some(outcome));
            }
            tracer.finish().map(drop)
        };
        write().map_err(Failure::writing(self.path))
    }
}
