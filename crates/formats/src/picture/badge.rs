//! The badges of start and goal.

/// A letter on a badge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Letter {
    S,
    G,
}

impl Letter {
    /// Its line, for a letter from −1 to 1. There is no font in a PNG file.
    pub(super) const fn line(self) -> &'static [(f64, f64)] {
        match self {
            Self::S => &[
                (0.66, -0.62),
                (0.42, -0.9),
                (0.0, -1.0),
                (-0.42, -0.92),
                (-0.66, -0.64),
                (-0.6, -0.3),
                (-0.3, -0.1),
                (0.3, 0.1),
                (0.6, 0.3),
                (0.66, 0.64),
                (0.42, 0.92),
                (0.0, 1.0),
                (-0.42, 0.9),
                (-0.66, 0.62),
            ],
            Self::G => &[
                (0.7, -0.62),
                (0.42, -0.92),
                (0.0, -1.0),
                (-0.46, -0.88),
                (-0.74, -0.5),
                (-0.82, 0.0),
                (-0.74, 0.5),
                (-0.46, 0.88),
                (0.0, 1.0),
                (0.44, 0.9),
                (0.74, 0.6),
                (0.74, 0.08),
                (0.14, 0.08),
            ],
        }
    }

    /// Its line on a badge of this radius.
    pub(super) fn on(self, (x, y): (f64, f64), radius: f64) -> Vec<(f64, f64)> {
        let size = 0.48 * radius;
        self.line().iter().map(|&(dx, dy)| (x + size * dx, y + size * dy)).collect()
    }

    /// The end of a path that it marks.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::S => "start",
            Self::G => "goal",
        }
    }
}

/// The radius of a letter's line.
pub(super) fn stroke(radius: f64) -> f64 {
    0.085 * radius
}
