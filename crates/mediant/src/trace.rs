//! The events of a search, for the Posthoc visualizer.

use std::io::{self, Write};

use mediant_formats::{TraceEvent, TraceEventKind, TraceHeader, TraceWriter};
use mediant_grid::{Grid, PlacementKind, Point};
use mediant_moves::Cost;
use mediant_search::{Answer, NodeEvent, Observer, Path, PointEnds};

use crate::space::Space;

/// Writes the events of one search for the Posthoc visualizer, as an observer of that search or of one that
/// was kept. First the search is made, since the trace [begins](Self::begin) with the ends of its path.
///
/// Needs the feature `trace`.
///
/// ```
/// use mediant::{K, Map, Motion, Ends, search::Tracer};
///
/// let space = Map::from_rows(["...", ".#."])?.space(Motion::centers(K::N8))?;
/// let mut planner = space.planner(space.engine())?;
/// let ends = Ends::new((0, 0), (2, 1));
/// let answer = planner.find(ends)?;
/// let mut tracer = Tracer::new(Vec::new(), space.map().grid(), space.motion().rules.placement())?;
/// tracer.begin(ends, Some(&answer));
/// // The same query gives the same answer.
/// planner.find_observed(ends, &mut tracer)?;
/// tracer.end(Some(&answer));
/// let json = String::from_utf8(tracer.finish()?)?;
/// assert!(json.contains(r#"{"type":"source","id":1"#));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Tracer<'g, W: Write> {
    trace: TraceWriter<'g, W>,
    /// The number of vertices in a row, and of rows.
    size: (u32, u32),
    /// The space, if its cells have costs.
    space: Option<Space>,
    /// Whether paths lead between centers and bend at corners.
    is_between_centers: bool,
    /// The points between vertices, which have the numbers after those of all vertices.
    points: Vec<Point>,
    /// The vertex that is being expanded.
    open: Option<TraceEvent>,
    /// The first error of the writer, after which nothing is written.
    written: io::Result<()>,
}

impl<'g, W: Write> Tracer<'g, W> {
    /// Begins a trace of a search on this map.
    ///
    /// # Errors
    /// Errors of the writer.
    pub fn new(out: W, grid: &'g Grid, placement: PlacementKind) -> io::Result<Self> {
        let more = u32::from(placement == PlacementKind::Corner);
        let size = (grid.width() + more, grid.height() + more);
        let trace = TraceWriter::new(out, &TraceHeader { placement, map: Some(grid) })?;
        let (space, is_between_centers) = (None, false);
        Ok(Self { trace, size, space, is_between_centers, points: Vec::new(), open: None, written: Ok(()) })
    }

    /// The same for a search in this space. Its cells may have costs: these are written as numbers of its
    /// own, and not as lengths. Or paths may lead between centers at any angle, and bend at corners.
    #[must_use]
    pub fn in_space(mut self, space: &Space) -> Self {
        self.is_between_centers = space.is_between_centers();
        if self.is_between_centers {
            let map = space.map();
            self.size = (map.width() + 1, map.height() + 1);
        }
        Self { space: Some(space.clone()).filter(Space::has_costs), ..self }
    }

    /// Writes the start and the goal: those of the path, if found. An end outside the map has no event.
    /// Without an answer the search has not ended.
    pub fn begin(&mut self, ends: impl Into<PointEnds>, answer: Option<&Answer>) {
        let ends = ends.into();
        let start = answer.and_then(path_of).and_then(Path::start);
        let goal = answer.and_then(Answer::path).and_then(Path::goal);
        let events = [
            (TraceEventKind::Source, start.unwrap_or(ends.start), Some(0.0)),
            (TraceEventKind::Destination, goal.unwrap_or(ends.goal), None),
        ];
        for (kind, at, g) in events {
            let at = self.searched(at);
            let (low, high) = (at.floor(), at.ceil());
            if low.x.min(low.y) >= 0 && high.x < self.size.0 as i32 && high.y < self.size.1 as i32 {
                let event = TraceEvent { g, ..self.at(at) };
                self.write(kind, &event);
            }
        }
    }

    /// A point in the coordinates of the search.
    fn searched(&self, at: Point) -> Point {
        if self.is_between_centers { at.at_corners() } else { at }
    }

    /// Ends the trace with the waypoints of the path, after a stopped search those of the best so far. So the
    /// visualizer shows the path as it is, even if it turns at a vertex that is not a node of the search.
    pub fn end(&mut self, answer: Option<&Answer>) {
        self.close();
        let mut last: Option<(TraceEvent, Point)> = None;
        for at in answer.and_then(path_of).into_iter().flat_map(Path::points) {
            let (parent, g) = last.map_or((None, 0.0), |(event, from)| {
                (Some(event.id), event.g.unwrap_or(0.0) + self.between(from, at))
            });
            let event = TraceEvent { parent, g: Some(g), ..self.at(self.searched(at)) };
            self.write(TraceEventKind::End, &event);
            last = Some((event, at));
        }
    }

    /// Ends the document, and gives the writer back.
    ///
    /// # Errors
    /// The first of the writer.
    pub fn finish(self) -> io::Result<W> {
        self.written?;
        self.trace.finish()
    }

    /// An event at a point of the search, without anything else. Ids begin with 1, since the visualizer's
    /// path stops before the id 0.
    fn at(&mut self, at: Point) -> TraceEvent {
        let id = match at.vertex() {
            Some(at) => at.y as u32 * self.size.0 + at.x as u32,
            None => {
                let known = self.points.iter().position(|&point| point == at);
                let place = known.unwrap_or(self.points.len());
                if known.is_none() {
                    self.points.push(at);
                }
                self.size.0 * self.size.1 + place as u32
            }
        };
        let at = if self.is_between_centers { at.at_centers() } else { at };
        TraceEvent { id: id + 1, parent: None, x: at.x(), y: at.y(), f: None, g: None }
    }

    /// An event of a node of the search.
    fn node(&mut self, node: NodeEvent) -> TraceEvent {
        let parent = node.parent.map(|parent| self.at(parent.into()).id);
        let (f, g) = (Some(self.number(node.f)), Some(self.number(node.g)));
        TraceEvent { parent, f, g, ..self.at(node.at.into()) }
    }

    fn number(&self, cost: Cost) -> f64 {
        self.space.as_ref().map_or_else(|| cost.to_f64(), |space| space.to_f64(cost))
    }

    /// The cost of a segment of a path.
    fn between(&self, from: Point, to: Point) -> f64 {
        let cost = self.space.as_ref().and_then(|space| space.cost(&Path::through([from, to])));
        cost.unwrap_or_else(|| from.distance(to))
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
const fn path_of(answer: &Answer) -> Option<&Path> {
    match answer {
        Answer::Stopped(stopped) => Some(&stopped.best),
        _ => answer.path(),
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
