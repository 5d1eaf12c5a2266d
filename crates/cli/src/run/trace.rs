//! `mediant run --trace`: the events of a search in a file.

use std::{io, path};

use mediant::{Answer, Planner, PointEnds, Query, Rules, errors::QueryError, grid::Grid, search::Tracer};
use mediant_formats::NewFile;

use crate::{failure::Failure, write::write_file};

/// The file of a trace.
pub(crate) struct TraceFile<'s>(pub(crate) &'s path::Path);

impl TraceFile<'_> {
    /// Writes the search of a query whose answer is known. An invalid query makes a trace without events.
    pub(crate) fn write(
        self,
        (grid, rules): (&Grid, Rules),
        planner: &mut Planner,
        (ends, query): (PointEnds, Query),
        answer: &Result<Answer, QueryError>,
    ) -> Result<(), Failure> {
        let write = |file: &mut NewFile| -> io::Result<()> {
            let space = planner.index().space().clone();
            let mut tracer = Tracer::new(file, grid, rules.placement())?.in_space(&space);
            if let Ok(answer) = answer {
                tracer.begin(ends, Some(answer));
                // The same query gives the same answer.
                _ = planner.find_observed(query, &mut tracer);
                tracer.end(Some(answer));
            }
            tracer.finish().map(drop)
        };
        write_file(self.0, write)
    }
}
