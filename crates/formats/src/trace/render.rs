//! How the visualizer draws a trace.

use mediant_grid::PlacementKind;
use serde_json::{Value, json};

/// The components that the visualizer draws with each event. In their expressions, `$.event` is the event,
/// `$.parent` the latest event of its parent, and `$.color` the theme's colors of the event types. A
/// `persistent` component stays, a `transient` one disappears with the next event.
pub(super) fn render(placement: PlacementKind) -> Value {
    // The middle and the side of a vertex's square. At centers, the unit square at (x, y) is the cell itself.
    let (middle, side) = match placement {
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
            // A vertex that is not yet expanded may get another parent later, so its line does not stay.
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
