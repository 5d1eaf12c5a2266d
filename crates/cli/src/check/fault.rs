//! Faults of paths.

use std::fmt;

use mediant::{K, Path, Point, Space, errors::BrokenPath};

/// Costs that differ less, as a share of one of them, are the same.
const NEAR: f64 = 1e-9;

/// A fault of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Fault {
    /// It does not hold on the map.
    Broken(BrokenPath),
    /// A segment is not made of moves of N(k).
    Move { index: usize, from: Point, to: Point, k: K },
    /// It costs another amount than its file says.
    Cost { said: f64, found: f64 },
}

impl Fault {
    /// The first fault of a path: it does not hold in a space, or it is not over N(k).
    pub(crate) fn of(path: &Path, space: &Space, over: K) -> Option<Self> {
        if let Err(broken) = space.check(path) {
            return Some(Self::Broken(broken));
        }
        if path.is_over(over) {
            return None;
        }
        let mut segments = path.points().zip(path.points().skip(1)).zip(0..);
        let wrong = segments.find(|&((from, to), _)| !Path::through([from, to]).is_over(over));
        wrong.map(|((from, to), index)| Self::Move { index, from, to, k: over })
    }

    /// The fault of a cost in a file.
    pub(crate) fn of_cost(said: Option<f64>, found: Option<f64>) -> Option<Self> {
        let (said, found) = said.zip(found)?;
        let is_same = (said - found).abs() <= NEAR * found.max(said);
        (!is_same).then_some(Self::Cost { said, found })
    }

    /// The segment, from 0, with its ends.
    pub(crate) fn segment(&self) -> Option<(usize, Point, Point)> {
        match *self {
            Self::Broken(BrokenPath::Segment { index, from, to, .. }) => Some((index, from, to)),
            Self::Move { index, from, to, .. } => Some((index, from, to)),
            Self::Broken(_) | Self::Cost { .. } => None,
        }
    }

    /// The blocked cell.
    pub(crate) const fn cell(&self) -> Option<(i32, i32)> {
        match self {
            Self::Broken(BrokenPath::Segment { by, .. }) => by.cell(),
            _ => None,
        }
    }

    /// The number of waypoints to which the path can be followed.
    /// `None` for a path that can be followed to its goal.
    pub(crate) const fn holds_up_to(&self) -> Option<usize> {
        match self {
            Self::Broken(broken) => Some(broken.holds_up_to()),
            Self::Move { index, .. } => Some(*index + 1),
            Self::Cost { .. } => None,
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Broken(broken) => broken.fmt(f),
            Self::Move { index, from, to, k } => {
                write!(f, "segment {index} of the path, from {from} to {to}, is not made of moves of N({k})")
            }
            Self::Cost { said, found } => write!(f, "the path costs {found} on this map, not {said}"),
        }
    }
}
