//! Straight segments and the rectangles that they meet, in exact fractions.

use std::cmp::Ordering;

/// A fraction with a positive denominator, not reduced.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fraction {
    numerator: i128,
    denominator: i128,
}

impl Fraction {
    const ZERO: Self = Self { numerator: 0, denominator: 1 };
    const ONE: Self = Self { numerator: 1, denominator: 1 };

    /// a / b for b ≠ 0.
    fn new(a: i64, b: i64) -> Self {
        let sign = i128::from(b.signum());
        Self { numerator: sign * i128::from(a), denominator: sign * i128::from(b) }
    }

    /// Half way between two fractions.
    fn middle(self, other: Self) -> Self {
        Self {
            numerator: self.numerator * other.denominator + other.numerator * self.denominator,
            denominator: 2 * self.denominator * other.denominator,
        }
    }
}

impl Ord for Fraction {
    fn cmp(&self, other: &Self) -> Ordering {
        (self.numerator * other.denominator).cmp(&(other.numerator * self.denominator))
    }
}

impl PartialOrd for Fraction {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Fraction {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Fraction {}

/// The points `from + t · by` for 0 ≤ t ≤ 1. Between vertices coordinates are in half cells, so that centers
/// and corners are integers; between points anywhere, in 1/1024 of a cell.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Segment {
    pub(crate) from: [i64; 2],
    pub(crate) by: [i64; 2],
}

/// A closed rectangle, perhaps as thin as an edge or a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rectangle {
    pub(crate) low: [i64; 2],
    pub(crate) high: [i64; 2],
}

/// The intersection of a segment with a closed rectangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Contact {
    /// Nothing.
    Nothing,
    /// One point, at this t.
    Point(Fraction),
    /// A piece of positive length, on the rectangle's rim.
    Rim,
    /// A piece of positive length, inside but for its ends.
    Inside,
}

impl Segment {
    /// Clips a segment of positive length (Liang–Barsky).
    pub(crate) fn contact(&self, rectangle: &Rectangle) -> Contact {
        let (mut enter, mut leave) = (Fraction::ZERO, Fraction::ONE);
        for axis in 0..2 {
            let (from, by) = (self.from[axis], self.by[axis]);
            let (low, high) = (rectangle.low[axis], rectangle.high[axis]);
            if by == 0 {
                if from < low || high < from {
                    return Contact::Nothing;
                }
                continue;
            }
            let (a, b) = (Fraction::new(low - from, by), Fraction::new(high - from, by));
            enter = enter.max(a.min(b));
            leave = leave.min(a.max(b));
        }
        match enter.cmp(&leave) {
            Ordering::Greater => Contact::Nothing,
            Ordering::Equal => Contact::Point(enter),
            // Apart from its ends, a chord of a convex figure lies on the rim altogether or not at all.
            Ordering::Less if self.is_inside(enter.middle(leave), rectangle) => Contact::Inside,
            Ordering::Less => Contact::Rim,
        }
    }

    /// Whether the point at t lies in the open interior.
    fn is_inside(&self, t: Fraction, rectangle: &Rectangle) -> bool {
        let point = self.scaled_point(t);
        (0..2).all(|axis| {
            let (low, high) = (i128::from(rectangle.low[axis]), i128::from(rectangle.high[axis]));
            low * t.denominator < point[axis] && point[axis] < high * t.denominator
        })
    }

    /// The point at t, times the denominator of t.
    fn scaled_point(&self, t: Fraction) -> [i128; 2] {
        [0, 1]
            .map(|axis| i128::from(self.from[axis]) * t.denominator + i128::from(self.by[axis]) * t.numerator)
    }

    /// The corner of cells, in whole cells, through which a segment in half cells passes at t; `None` if
    /// there is none at t, or if it is an end of the segment.
    pub(crate) fn corner_at(&self, t: Fraction) -> Option<[i128; 2]> {
        let point = self.scaled_point(t);
        let is_corner = point.iter().all(|coordinate| coordinate % (2 * t.denominator) == 0);
        let is_within = Fraction::ZERO < t && t < Fraction::ONE;
        (is_corner && is_within).then(|| point.map(|coordinate| coordinate / (2 * t.denominator)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CELL: Rectangle = Rectangle { low: [0, 0], high: [2, 2] };

    fn contact(from: [i64; 2], to: [i64; 2]) -> Contact {
        Segment { from, by: [to[0] - from[0], to[1] - from[1]] }.contact(&CELL)
    }

    #[test]
    fn contacts_of_all_kinds() {
        assert_eq!(contact([3, 0], [5, 7]), Contact::Nothing);
        assert_eq!(contact([4, 0], [0, 6]), Contact::Nothing, "crosses both slabs, at different times");
        assert_eq!(contact([3, 1], [1, 3]), Contact::Point(Fraction::new(1, 2)));
        assert_eq!(contact([-2, 1], [0, 1]), Contact::Point(Fraction::ONE), "ends on an edge");
        assert_eq!(contact([2, -2], [2, 6]), Contact::Rim);
        assert_eq!(contact([2, 0], [0, 2]), Contact::Inside, "from corner to corner");
        assert_eq!(contact([-1, 1], [5, 1]), Contact::Inside);
        assert_eq!(contact([2, 2], [6, 2]), Contact::Point(Fraction::ZERO));
    }

    #[test]
    fn only_inner_corner_points_are_passed() {
        let segment = Segment { from: [0, 0], by: [8, 4] };
        assert_eq!(segment.corner_at(Fraction::new(1, 2)), Some([2, 1]));
        assert_eq!(segment.corner_at(Fraction::new(1, 4)), None);
        assert_eq!(segment.corner_at(Fraction::ZERO), None);
        assert_eq!(segment.corner_at(Fraction::ONE), None);
    }
}
