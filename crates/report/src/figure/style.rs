//! Colors, markers and dashes of series.

use super::{canvas::Canvas, geometry::Point};

const COLORS: usize = 8;
const DASHES: usize = 5;

/// The style of a series: color, marker and dash. There are 8, 9 and 5 of them. These numbers have no common
/// factor, so there are 360 different styles, and any two of the first eight differ both in color and in
/// marker.
#[derive(Clone, Copy, Debug)]
pub(super) struct Style(pub(super) usize);

impl Style {
    fn color(self) -> String {
        format!("s{}", self.0 % COLORS)
    }

    /// The classes of its line.
    pub(super) fn line(self) -> String {
        with_dash(self.solid_line(), self.0 % DASHES)
    }

    /// The classes of its line without a dash.
    pub(super) fn solid_line(self) -> String {
        format!("curve {}", self.color())
    }

    /// The classes of its markers.
    pub(super) fn mark(self, hollow: bool) -> String {
        format!("{} {}", if hollow { "hollow" } else { "mark" }, self.color())
    }

    pub(super) fn marker(self) -> Marker {
        MARKERS[self.0 % MARKERS.len()]
    }
}

/// The classes of the reference line of this number. References are never solid.
pub(super) fn reference(index: usize) -> String {
    with_dash("curve thin r".to_owned(), 1 + index % (DASHES - 1))
}

fn with_dash(class: String, dash: usize) -> String {
    if dash == 0 { class } else { format!("{class} d{dash}") }
}

/// The shape at a point.
#[derive(Clone, Copy, Debug)]
pub(super) enum Marker {
    Circle,
    Square,
    Up,
    Diamond,
    Down,
    Cross,
    Star,
    Plus,
    Hourglass,
}

const MARKERS: [Marker; 9] = [
    Marker::Circle,
    Marker::Square,
    Marker::Up,
    Marker::Diamond,
    Marker::Down,
    Marker::Cross,
    Marker::Star,
    Marker::Plus,
    Marker::Hourglass,
];

impl Marker {
    /// Draws the marker with about the area of a circle of this radius, and within 1.5 radii.
    pub(super) fn draw(self, canvas: &mut Canvas, class: &str, at: Point, radius: f64) {
        let Some(outline) = self.outline() else {
            canvas.circle(class, at, radius);
            return;
        };
        let points: Vec<Point> =
            outline.into_iter().map(|(x, y)| (at.0 + radius * x, at.1 + radius * y)).collect();
        canvas.path(class, &points, true, None);
    }

    /// The corners for radius 1; `None` for a circle.
    fn outline(self) -> Option<Vec<Point>> {
        const ARM: (f64, f64) = (1.25, 0.4);
        let plus = || {
            let (l, w) = ARM;
            let arm = [(w, -w), (l, -w), (l, w)];
            (0..4).flat_map(move |quarter| arm.map(|at| turned(at, f64::from(quarter) * 90.0)))
        };
        let star =
            |i: u32| turned((0.0, if i.is_multiple_of(2) { -1.45 } else { -0.65 }), f64::from(i) * 36.0);
        Some(match self {
            Self::Circle => return None,
            Self::Square => vec![(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
            Self::Up => vec![(0.0, -1.25), (1.2, 0.9), (-1.2, 0.9)],
            Self::Diamond => vec![(0.0, -1.35), (1.2, 0.0), (0.0, 1.35), (-1.2, 0.0)],
            Self::Down => vec![(0.0, 1.25), (-1.2, -0.9), (1.2, -0.9)],
            Self::Cross => plus().map(|at| turned(at, 45.0)).collect(),
            Self::Star => (0..10).map(star).collect(),
            Self::Plus => plus().collect(),
            Self::Hourglass => vec![(-1.05, -1.15), (1.05, -1.15), (-1.05, 1.15), (1.05, 1.15)],
        })
    }
}

/// The point turned clockwise about (0, 0), as seen on the page.
fn turned((x, y): Point, degrees: f64) -> Point {
    let (sin, cos) = degrees.to_radians().sin_cos();
    (x * cos - y * sin, x * sin + y * cos)
}
