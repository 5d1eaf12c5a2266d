//! Search traces for the Posthoc visualizer, version 1.0.5 of its format.

mod render;

use std::io::{self, Write};

use mediant_grid::{Grid, PlacementKind};
use serde::{Serialize, Serializer};

use render::render;

/// The header of a trace: placement and map.
///
/// Needs the feature `trace`.
#[derive(Clone, Copy, Debug)]
pub struct TraceHeader<'g> {
    /// Where the vertices are. A vertex at a center is drawn as its cell, one at a corner as a small square
    /// around it.
    pub placement: PlacementKind,
    /// The map, if the trace is to draw it. Without it, the visualizer can show the `.map` file as a layer of
    /// its own.
    pub map: Option<&'g Grid>,
}

/// An event of a vertex in a search.
///
/// Needs the feature `trace`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum TraceEventKind {
    /// The search begins here.
    Source,
    /// The search is to end here.
    Destination,
    /// The vertex was reached for the first time.
    Generating,
    /// A cheaper path to the vertex was found.
    Updating,
    /// The vertex was taken from the open list; the events of its successors follow.
    Expanding,
    /// All successors of the vertex were generated.
    Closing,
    /// The search ends here.
    End,
}

/// A vertex at one moment of the search.
///
/// Needs the feature `trace`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TraceEvent {
    /// The number of the vertex, the same in all its events. Better not 0: the path that the visualizer
    /// highlights would end before this vertex.
    pub id: u32,
    /// The number of the vertex from which it was reached.
    pub parent: Option<u32>,
    /// The column, in cells.
    pub x: f64,
    /// The row, in cells, downward.
    pub y: f64,
    /// The estimated cost of a path through the vertex, if the search has one. Written as `null` if not
    /// finite.
    pub f: Option<f64>,
    /// The cost of the best known path to the vertex, if there is one. Written as `null` if not finite.
    pub g: Option<f64>,
}

/// Writes a search trace as JSON, one event a line. Readers of YAML can read it too.
///
/// Every event is written at once and none is kept, so that a trace can have any length. Wrap a file in a
/// [`BufWriter`](io::BufWriter), and call [`finish`](Self::finish): without it the document has no end.
///
/// Needs the feature `trace`.
///
/// ```
/// use mediant_formats::{TraceEvent, TraceEventKind, TraceHeader, TraceWriter};
/// use mediant_grid::PlacementKind;
/// let mut trace = TraceWriter::new(Vec::new(), &TraceHeader { placement: PlacementKind::Center, map: None
/// })?; let start = TraceEvent { id: 7, parent: None, x: 3.0, y: 1.0, f: Some(2.5), g: Some(0.0) };
/// trace.event(TraceEventKind::Source, &start)?;
/// trace.event(TraceEventKind::Expanding, &start)?;
/// let text = String::from_utf8(trace.finish()?)?;
/// assert!(text.ends_with(r#"{"type":"expanding","id":7,"pId":null,"x":3,"y":1,"f":2.5,"g":0.0}
/// ]}
/// "#));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct TraceWriter<'g, W: Write> {
    out: W,
    /// The map, until it is written with the first event.
    map: Option<&'g Grid>,
    events: u64,
}

/// The version of the format.
const VERSION: &str = "1.0.5";

/// An event in the words of the format.
#[derive(Serialize)]
struct Line {
    #[serde(rename = "type")]
    kind: TraceEventKind,
    id: u32,
    #[serde(rename = "pId")]
    parent: Option<u32>,
    #[serde(serialize_with = "shortest")]
    x: f64,
    #[serde(serialize_with = "shortest")]
    y: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    f: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    g: Option<f64>,
}

/// Writes a whole number as an integer.
#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde calls it so")]
fn shortest<S: Serializer>(&number: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    match number.fract() == 0.0 && number.abs() <= f64::from(i32::MAX) {
        true => serializer.serialize_i32(number as i32),
        false => serializer.serialize_f64(number),
    }
}

impl<'g, W: Write> TraceWriter<'g, W> {
    /// Begins a trace.
    ///
    /// # Errors
    /// Errors of the writer.
    pub fn new(mut out: W, header: &TraceHeader<'g>) -> io::Result<Self> {
        write!(out, "{{\"version\":\"{VERSION}\",\n\"render\":{},\n\"events\":[", render(header.placement))?;
        Ok(Self { out, map: header.map, events: 0 })
    }

    /// Writes an event.
    ///
    /// # Errors
    /// Errors of the writer. The trace is then incomplete.
    pub fn event(&mut self, kind: TraceEventKind, event: &TraceEvent) -> io::Result<()> {
        let &TraceEvent { id, parent, x, y, f, g } = event;
        let line = Line { kind, id, parent, x, y, f, g };
        self.out.write_all(if self.events == 0 { b"\n" } else { b",\n" })?;
        self.events += 1;
        match self.map.take() {
            None => serde_json::to_writer(&mut self.out, &line)?,
            Some(map) => {
                // The first event carries the map. Were it part of the component that draws it, every event
                // would draw it anew.
                let mut text = serde_json::to_vec(&line)?;
                text.pop();
                self.out.write_all(&text)?;
                self.out.write_all(b",\"map\":[")?;
                self.outline(map)?;
                self.out.write_all(b"]}")?;
            }
        }
        Ok(())
    }

    /// The number of events that were written.
    #[must_use]
    pub const fn events(&self) -> u64 {
        self.events
    }

    /// Ends the document, flushes, and gives the writer back.
    ///
    /// # Errors
    /// Errors of the writer.
    pub fn finish(mut self) -> io::Result<W> {
        self.out.write_all(b"\n]}\n")?;
        self.out.flush()?;
        Ok(self.out)
    }

    /// Writes the blocked cells as one polygon. It goes from the origin to each run of blocked cells, around
    /// it, and back on the same line, which thus has no area.
    fn outline(&mut self, map: &Grid) -> io::Result<()> {
        self.out.write_all(br#"{"x":0,"y":0}"#)?;
        for y in 0..map.height() as i32 {
            for (left, right) in blocked_runs(map, y) {
                let corners = [(left, y), (right, y), (right, y + 1), (left, y + 1), (left, y), (0, 0)];
                for (x, y) in corners {
                    write!(self.out, r#",{{"x":{x},"y":{y}}}"#)?;
                }
            }
        }
        Ok(())
    }
}

/// The runs of blocked cells in a row: the first column of each, and the first beyond it.
fn blocked_runs(map: &Grid, y: i32) -> impl Iterator<Item = (i32, i32)> {
    let width = map.width() as i32;
    let mut next = 0;
    std::iter::from_fn(move || {
        let left = (next..width).find(|&x| map.is_blocked(x, y))?;
        next = (left..width).find(|&x| map.is_free(x, y)).unwrap_or(width);
        Some((left, next))
    })
}
