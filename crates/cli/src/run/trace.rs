//! `mediant run --trace`: an observer that writes the events of a search to a file.

use std::{
    fs::File,
    io::{self, BufWriter, Write},
    path,
};

use mediant::Planner;
use mediant_formats::{TraceEvent, TraceEventKind, TraceHeader, TraceWriter};
use mediant_grid::{Grid, PlacementKind, Vertex};
use mediant_search::{NodeEvent, Observer, Outcome, Path, Query, QueryError};

/// The file of a trace.
pub(crate) struct TraceFile<'s> {
    pub(crate) path: &'s path::Path,
    pub(crate) out: BufWriter<File>,
}

/// Writes the events of one search.
pub(crate) struct Tracer<'g, W: Write> {
    trace: TraceWriter<'g, W>,
    /// The number of vertices in a row.
    width: u32,
    /// The vertex that is being expanded.
    open: Option<TraceEvent>,
    /// The first error of the writer, after which nothing is written.
    written: io::Result<()>,
}

impl<'g, W: Write> Tracer<'g, W> {
    /// Begins a trace of a search on this map.
    pub(crate) fn new(out: W, grid: &'g Grid, placement: PlacementKind) -> io::Result<Self> {
        let width = grid.width() + u32::from(placement == PlacementKind::Corner);
        let trace = TraceWriter::new(out, &TraceHeader { placement, map: Some(grid) })?;
        Ok(Self { trace, width, open: None, written: Ok(()) })
    }

    /// Writes the search of a query whose answer is known. An invalid query makes a trace without events.
    pub(crate) fn run(
        mut self,
        planner: &mut Planner,
        query: Query,
        answer: &Result<Outcome, QueryError>,
    ) -> io::Result<()> {
        if let Ok(outcome) = answer {
            self.begin(query);
            // The same query gives the same answer.
            _ = planner.find_observed(query, &mut self);
            self.end(outcome);
        }
        self.written?;
        self.trace.finish().map(|_| ())
    }

    /// Writes the start and the goal.
    fn begin(&mut self, query: Query) {
        let (source, destination) = (self.at(query.start), self.at(query.goal));
        self.write(TraceEventKind::Source, &TraceEvent { g: Some(0.0), ..source });
        self.write(TraceEventKind::Destination, &destination);
    }

    /// Ends the trace with the waypoints of the path. So the visualizer shows the path as it is, even if it
    /// turns at a vertex that is not a node of the search.
    fn end(&mut self, outcome: &Outcome) {
        self.close();
        let mut last: Option<(TraceEvent, Vertex)> = None;
        for &at in outcome.path().map_or(&[][..], Path::waypoints) {
            let (parent, g) = last.map_or((None, 0.0), |(event, from)| {
                (Some(event.id), event.g.unwrap_or(0.0) + from.distance(at))
            });
            let event = TraceEvent { parent, g: Some(g), ..self.at(at) };
            self.write(TraceEventKind::End, &event);
            last = Some((event, at));
        }
    }

    /// An event at a vertex, without anything else. Ids begin with 1, since the visualizer's path stops
    /// before the id 0.
    fn at(&self, at: Vertex) -> TraceEvent {
        let id = at.y as u32 * self.width + at.x as u32 + 1;
        TraceEvent { id, parent: None, x: at.x, y: at.y, f: None, g: None }
    }

    /// An event of a node of the search.
    fn node(&self, node: NodeEvent) -> TraceEvent {
        let parent = node.parent.map(|parent| self.at(parent).id);
        TraceEvent { parent, f: Some(node.f.to_f64()), g: Some(node.g.to_f64()), ..self.at(node.at) }
    }

    /// Writes an event, unless an error came before.
    fn write(&mut self, kind: TraceEventKind, event: &TraceEvent) {
        if self.written.is_ok() {
            self.written = self.trace.event(kind, event);
        }
    }

    /// Ends the expansion of the vertex that is being expanded, if there is one.
    fn close(&mut self) {
        if let Some(event) = self.open.take() {
            self.write(TraceEventKind::Closing, &event);
        }
    }
}

impl<W: Write> Observer for Tracer<'_, W> {
    fn expanded(&mut self, node: NodeEvent) {
        self.close();
        let event = self.node(node);
        self.write(TraceEventKind::Expanding, &event);
        self.open = Some(event);
    }

    fn generated(&mut self, node: NodeEvent) {
        let event = self.node(node);
        self.write(TraceEventKind::Generating, &event);
    }

    fn updated(&mut self, node: NodeEvent) {
        let event = self.node(node);
        self.write(TraceEventKind::Updating, &event);
    }
}
