//! Points and rectangles of a figure.

/// A point (x, y) in pixels from the upper left corner of the figure, y downward.
pub(super) type Point = (f64, f64);

/// A rectangle; `x` and `y` are its upper left corner.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rect {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

impl Rect {
    pub(super) const fn new(x: f64, y: f64, width: f64, height: f64) -> Self {
        Self { x, y, width, height }
    }

    pub(super) fn around((x, y): Point, radius: f64) -> Self {
        Self::new(x - radius, y - radius, 2.0 * radius, 2.0 * radius)
    }

    pub(super) fn right(self) -> f64 {
        self.x + self.width
    }

    pub(super) fn bottom(self) -> f64 {
        self.y + self.height
    }

    pub(super) fn center(self) -> Point {
        (self.x + self.width / 2.0, self.y + self.height / 2.0)
    }

    /// The point of the rectangle that is nearest to another.
    pub(super) fn nearest(self, (x, y): Point) -> Point {
        (x.clamp(self.x, self.right()), y.clamp(self.y, self.bottom()))
    }

    /// The part of a line that is inside the rectangle (Liang and Barsky 1984).
    pub(super) fn clip(self, [from, to]: [Point; 2]) -> Option<[Point; 2]> {
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let borders = [
            (-dx, from.0 - self.x),
            (dx, self.right() - from.0),
            (-dy, from.1 - self.y),
            (dy, self.bottom() - from.1),
        ];
        let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
        for (toward, room) in borders {
            if toward < 0.0 {
                enter = enter.max(room / toward);
            } else if toward > 0.0 {
                leave = leave.min(room / toward);
            } else if room < 0.0 {
                return None;
            }
        }
        // An end inside stays bit by bit what it is, so that the next piece of a line begins exactly there.
        let at = |t: f64| if t == 1.0 { to } else { (from.0 + t * dx, from.1 + t * dy) };
        (enter <= leave).then(|| [at(enter), at(leave)])
    }

    /// The area that two rectangles share.
    pub(super) fn overlap(self, other: Self) -> f64 {
        let across = self.right().min(other.right()) - self.x.max(other.x);
        let down = self.bottom().min(other.bottom()) - self.y.max(other.y);
        across.max(0.0) * down.max(0.0)
    }
}
