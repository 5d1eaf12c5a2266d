//! Search traces for the Posthoc visualizer, version 1.0.5 of its format.

use std::io::{self, Write};

use mediant_grid::{Grid, PlacementKind};
use serde::Serialize;
use serde_json::{Value, json};

/// What is said of a search before its events.
#[derive(Clone, Copy, Debug)]
pub struct TraceHeader<'g> {
    /// Where the vertices are: at centers they are drawn as their cells, at corners as small squares around them.
    pub placement: PlacementKind,
    /// The map, where the trace shall draw it. The visualizer can also show the `.map` file itself, as a layer of its own.
    pub map: Option<&'g Grid>,
}

/// What became of a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum TraceEventKind {
    /// The search begins here.
    Source,
    /// The search wants to come here.
    Destination,
    /// The vertex was reached for the first time.
    Generating,
    /// A cheaper path to the vertex was found.
    Updating,
    /// The vertex was taken from the open list; its successors follow.
    Expanding,
    /// All successors of the vertex were seen.
    Closing,
    /// The search ends here.
    End,
}

/// One vertex at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TraceEvent {
    /// The number of the vertex, the same in all its events. (The path that the visualizer highlights stops short of a vertex
    /// with the number 0; the lines to the parents do not.)
    pub id: u32,
    /// The number of the vertex from which it was reached.
    pub parent: Option<u32>,
    /// To the right, in cells.
    pub x: i32,
    /// Down, in cells.
    pub y: i32,
    /// The cost of the path that g and the heuristic promise, where the search knows it. Written as `null` if not finite.
    pub f: Option<f64>,
    /// The cost of the best known path to the vertex, where there is one. Written as `null` if not finite.
    pub g: Option<f64>,
}

/// Writes a search trace: JSON, one event a line, which readers of YAML read as well.
///
/// Every event is written at once and none is kept, so that a trace may be of any length. Wrap a file in a
/// [`BufWriter`](io::BufWriter), and call [`finish`](Self::finish): without it the document has no end.
///
/// ```
/// use mediant_formats::{TraceEvent, TraceEventKind, TraceHeader, TraceWriter};
/// use mediant_grid::PlacementKind;
/// let mut trace = TraceWriter::new(Vec::new(), &TraceHeader { placement: PlacementKind::Center, map: None })?;
/// let start = TraceEvent { id: 7, parent: None, x: 3, y: 1, f: Some(2.5), g: Some(0.0) };
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
    /// The map until it is written, with the first event.
    map: Option<&'g Grid>,
    events: u64,
}

/// The version of the format.
const VERSION: &str = "1.0.5";

/// An event as the format has it.
#[derive(Serialize)]
struct Line {
    #[serde(rename = "type")]
    kind: TraceEventKind,
    id: u32,
    #[serde(rename = "pId")]
    parent: Option<u32>,
    x: i32,
    y: i32,
    #[serde(skip_serializing_if = "Option::is_none")]
    f: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    g: Option<f64>,
}

impl<'g, W: Write> TraceWriter<'g, W> {
    /// Begins a trace.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn new(mut out: W, header: &TraceHeader<'g>) -> io::Result<Self> {
        write!(out, "{{\"version\":\"{VERSION}\",\n\"render\":{},\n\"events\":[", render(header))?;
        Ok(Self { out, map: header.map, events: 0 })
    }

    /// Writes what became of a vertex.
    ///
    /// # Errors
    /// Those of the writer. The trace is then broken off.
    pub fn event(&mut self, kind: TraceEventKind, event: &TraceEvent) -> io::Result<()> {
        let &TraceEvent { id, parent, x, y, f, g } = event;
        let line = Line { kind, id, parent, x, y, f, g };
        self.out.write_all(if self.events == 0 { b"\n" } else { b",\n" })?;
        self.events += 1;
        match self.map.take() {
            None => serde_json::to_writer(&mut self.out, &line)?,
            Some(map) => {
                // The map hangs on the first event, since a drawing of its own would be repeated at each.
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

    /// How many events were written.
    #[must_use]
    pub const fn events(&self) -> u64 {
        self.events
    }

    /// Ends the document, flushes, and gives the writer back.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn finish(mut self) -> io::Result<W> {
        self.out.write_all(b"\n]}\n")?;
        self.out.flush()?;
        Ok(self.out)
    }

    /// The blocked cells as one polygon, whose runs hang on lines without area: each is visited from the origin, and the way
    /// back is the way there.
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

/// How the visualizer is to draw an event: `$.event` is the event, `$.parent` its parent's latest event up to then, and
/// `$.color` the theme's colors of the event types. What is `persistent` stays, what is `transient` goes with the next event.
fn render(header: &TraceHeader<'_>) -> Value {
    // At centers the format's unit square at (x, y) is the cell itself.
    let (middle, side) = match header.placement {
        PlacementKind::Center => (0.5, 1.0),
        PlacementKind::Corner => (0.0, 0.5),
    };
    let at = |of: &str, axis: &str, offset: f64| format!("{{{{$.{of}.{axis} + {offset}}}}}");
    let corner = middle - side / 2.0;
    let point = |of: &str| json!({ "x": at(of, "x", middle), "y": at(of, "y", middle) });
    let from = |axis: &str| format!("{{{{($.parent || $.event).{axis} + {middle}}}}}");
    json!({
        "components": {
            "vertex": [{
                "$": "rect",
                "x": at("event", "x", corner),
                "y": at("event", "y", corner),
                "width": side,
                "height": side,
                "fill": "{{$.color[$.event.type]}}",
            }],
            // A later event may give a vertex that is not expanded yet another parent: its line does not stay.
            "line": [{
                "$": "path",
                "points": [{ "x": from("x"), "y": from("y") }, point("event")],
                "lineWidth": 0.1,
                "fill": "#263238",
                "alpha": "{{$.parent ? 1 : 0}}",
                "display":
                    "{{['expanding', 'closing', 'end'].includes($.event.type) ? 'persistent' : 'transient'}}",
            }],
            "map": [{
                "$": "polygon",
                "points": "{{$.event.map || []}}",
                "fill": "#546e7a",
                "alpha": "{{$.event.map ? 1 : 0}}",
            }],
        },
        "views": { "main": { "components": [{ "$": "map" }, { "$": "vertex" }, { "$": "line" }] } },
        "path": { "pivot": point("event"), "scale": 0.3 },
    })
}
