//! How the visualizer draws a trace.

use mediant_grid::PlacementKind;

/// The components that the visualizer draws with each event, in JSON. In their expressions, `$.event` is the
/// event, `$.parent` the latest event of its parent, and `$.color` the theme's colors of the event types. A
/// `persistent` component stays, a `transient` one disappears with the next event. MIDDLE, CORNER and SIDE
/// stand for numbers of the placement. It is a text, since values of `serde_json` that are made of it by code
/// weigh more than all else that writes traces.
const COMPONENTS: &str = concat!(
    r##"{"components":{"##,
    r##""vertex":[{"$":"rect","x":"{{$.event.x + CORNER}}","y":"{{$.event.y + CORNER}}","##,
    r##""width":SIDE,"height":SIDE,"fill":"{{$.color[$.event.type]}}"}],"##,
    // A vertex that is not yet expanded may get another parent later, so its line does not stay.
    r##""line":[{"$":"path","points":["##,
    r##"{"x":"{{($.parent || $.event).x + MIDDLE}}","y":"{{($.parent || $.event).y + MIDDLE}}"},"##,
    r##"{"x":"{{$.event.x + MIDDLE}}","y":"{{$.event.y + MIDDLE}}"}],"##,
    r##""lineWidth":0.1,"fill":"#263238","alpha":"{{$.parent ? 1 : 0}}","display":"##,
    r##""{{['expanding', 'closing', 'end'].includes($.event.type) ? 'persistent' : 'transient'}}"}],"##,
    r##""map":[{"$":"polygon","points":"{{$.event.map || []}}","##,
    r##""fill":"#546e7a","alpha":"{{$.event.map ? 1 : 0}}"}]},"##,
    r##""views":{"main":{"components":[{"$":"map"},{"$":"vertex"},{"$":"line"}]}},"##,
    r##""path":{"pivot":{"x":"{{$.event.x + MIDDLE}}","y":"{{$.event.y + MIDDLE}}"},"scale":0.3}}"##,
);

/// The components for a placement, in JSON.
pub(super) fn render(placement: PlacementKind) -> String {
    // The middle and the side of a vertex's square, and its first corner. At centers, the unit square at
    // (x, y) is the cell itself.
    let (middle, side, corner) = match placement {
        PlacementKind::Center => ("0.5", "1.0", "0"),
        PlacementKind::Corner => ("0", "0.5", "-0.25"),
    };
    COMPONENTS.replace("MIDDLE", middle).replace("SIDE", side).replace("CORNER", corner)
}
