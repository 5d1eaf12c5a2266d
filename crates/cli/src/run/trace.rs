//! `mediant run --trace`: an observer that writes the events of a search to a file.

use std::{
    fs::File,
    io::{self, BufWriter, Write},
    path,
};

use mediant::Planner;
use mediant_formats::{TraceEvent, TraceEventKind, TraceHeader, TraceWriter};
use mediant_grid::{Grid, PlacementKind, Vertex};
use mediant_search::{NodeEvent, Observer, Outcome, Path, Query, QueryError, Request};

use crate::failure::Failure;

/// The file of a trace.
pub(crate) struct TraceFile<'s> {
    pub(crate) path: &'s path::Path,
    pub(crate) out: BufWriter<File>,
}

impl<'s> TraceFile<'s> {
    pub(crate) fn create(path: &'s path::Path) -> Result<Self, Failure> {
        let file = File::create(path).map_err(Failure::writing(path))?;
        Ok(Self { path, out: BufWriter::new(file) })
    }
}

/// Writes the events of one search.
pub(crate) struct Tracer<'g, W: Write> {
    trace: TraceWriter<'g, W>,
    /// The number of vertices in a row, and of rows.
    size: (u32, u32),
    /// The vertex that is being expanded.
    open: Option<TraceEvent>,
    /// The first error of the writer, after which nothing is written.
    written: io::Result<()>,
}

impl<'g, W: Write> Tracer<'g, W> {
    /// Begins a trace of a search on this map.
    pub(crate) fn new(out: W, grid: &'g Grid, placement: PlacementKind) -> io::Result<Self> {
        let more = u32::from(placement == PlacementKind::Corner);
        let size = (grid.width() + more, grid.height() + more);
        let trace = TraceWriter::new(out, &TraceHeader { placement, map: Some(grid) })?;
        Ok(Self { trace, size, open: None, written: Ok(()) })
    }

    /// Writes the search of a query whose answer is known. An invalid query makes a trace without events.
    pub(crate) fn run(
        mut self,
        planner: &mut Planner,
        query: Query,
        request: Request,
        answer: &Result<Outcome, QueryError>,
    ) -> io::Result<()> {
        if let Ok(outcome) = answer {
            self.begin(query, outcome);
            // The same request gives the same answer.
            _ = planner.find_observed(request, &mut self);
            self.end(outcome);
        }
        self.written?;
        self.trace.finish().map(|_| ())
    }

    /// Writes the start and the goal: those of the path, if found. A goal outside the map has no event.
    fn begin(&mut self, query: Query, outcome: &Outcome) {
        let start = path_of(outcome).and_then(|path| path.waypoints().first());
        let goal = outcome.path().and_then(|path| path.waypoints().last());
        let ends = [
            (TraceEventKind::Source, *start.unwrap_or(&query.start), Some(0.0)),
            (TraceEventKind::Destination, *goal.unwrap_or(&query.goal), None),
        ];
        for (kind, at, g) in ends {
            if (0..self.size.0 as i32).contains(&at.x) && (0..self.size.1 as i32).contains(&at.y) {
                self.write(kind, &TraceEvent { g, ..self.at(at) });
            }
        }
    }

    /// Ends the trace with the waypoints of the path, after a stopped search those of the best so far. So the
    /// visualizer shows the path as it is, even if it turns at a vertex that is not a node of the search.
    fn end(&mut self, outcome: &Outcome) {
        self.close();
        let mut last: Option<(TraceEvent, Vertex)> = None;
        for &at in path_of(outcome).map_or(&[][..], Path::waypoints) {
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
        let id = at.y as u32 * self.size.0 + at.x as u32 + 1;
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

/// The path of an answer; of a stopped search the best so far.
const fn path_of(outcome: &Outcome) -> Option<&Path> {
    match outcome {
        Outcome::Stopped(stopped) => Some(&stopped.best),
        _ => outcome.path(),
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
