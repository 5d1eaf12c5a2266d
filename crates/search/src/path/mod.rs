//! Paths: what they are made of (`steps.rs`), what can be measured on them (`measure.rs`), and whether they
//! still hold on a map (`check.rs`).

mod change;
mod check;
mod measure;
#[cfg(feature = "serde")]
mod serialized;
mod steps;

use std::{fmt, ops::Index, slice, vec};

use mediant_grid::{Point, Vertex};

use self::steps::Segment;
pub use self::{
    check::BrokenPath,
    measure::{SpacingError, Turn},
};
pub(crate) use self::{
    check::check,
    steps::{between, vertices},
};

/// A path: its waypoints, its length, and its cost.
///
/// Two consecutive waypoints are joined by one move of N(k), taken once or several times in a row, or in
/// any-angle paths by a straight legal segment. A path from a vertex to itself has that vertex as its only
/// waypoint. The paths of all engines and fields, and smoothed ones, turn at each waypoint between their
/// ends; one that is made of given waypoints has those.
///
/// A path knows no map: its waypoints may be anywhere, and [`check`](Self::check) asks whether it holds on a
/// map. Places on it are vertices, whole or not: between centers, (x, y) is the middle of cell (x, y), at
/// corners its upper left corner. Between centers add ½ to both to have (0, 0) at the corner of the map.
///
/// **Cost and length** are one number, unless the path is one on a cost surface, where each cell has a cost
/// of its own: then [`cost`](Self::cost) is that of the surface, and [`length`](Self::length) the length all
/// the same. Paths are equal if they have the same waypoints and cost.
///
/// Waypoints of maps are less than 2³¹ apart along each axis. Where they are not, [`moves`](Self::moves) and
/// [`touched_cells`](Self::touched_cells) pass over the segment; all else is right there too.
///
/// ```
/// use mediant_search::Path;
/// let path = Path::new(vec![(0, 0).into(), (3, 0).into(), (5, 2).into()]);
/// assert_eq!((path.len(), path[1]), (3, (3, 0).into()));
/// for waypoint in &path {
///     assert!(waypoint.x <= 5);
/// }
/// assert_eq!(path.vertices().count(), 6);
/// assert_eq!(path.point_at(1.5), Some((1.5, 0.0)));
/// assert_eq!(path.reversed().to_string(), "(5, 2) → (3, 0) → (0, 0)");
/// ```
#[derive(Clone, Debug)]
pub struct Path {
    waypoints: Vec<Vertex>,
    length: f64,
    /// The cost on a cost surface.
    own_cost: Option<f64>,
}

impl PartialEq for Path {
    fn eq(&self, other: &Self) -> bool {
        self.waypoints == other.waypoints && self.cost() == other.cost()
    }
}

impl Path {
    /// The path along these waypoints; its cost is its length, the sum of the lengths of the segments between
    /// them.
    #[must_use]
    pub fn new(waypoints: Vec<Vertex>) -> Self {
        // Not `sum`, which yields −0 for no segments.
        let length = waypoints.windows(2).fold(0.0, |length, ends| length + ends[0].distance(ends[1]));
        Self { waypoints, length, own_cost: None }
    }

    /// The path along these waypoints with a cost of its own: that on a cost surface, which the path does not
    /// know.
    ///
    /// ```
    /// use mediant_search::Path;
    /// let path = Path::with_cost(vec![(0, 0).into(), (3, 4).into()], 20.0);
    /// assert_eq!((path.cost(), path.length()), (20.0, 5.0));
    /// assert_eq!((path.reversed().cost(), path.rest((3, 4)).map(|rest| rest.cost())), (20.0, Some(0.0)));
    /// ```
    #[must_use]
    pub fn with_cost(waypoints: Vec<Vertex>, cost: f64) -> Self {
        Self { own_cost: Some(cost), ..Self::new(waypoints) }
    }

    /// The waypoints, start and goal included.
    #[must_use]
    pub fn waypoints(&self) -> &[Vertex] {
        &self.waypoints
    }

    /// The points of the path, start and goal included: in the form that also holds places between vertices.
    ///
    /// ```
    /// use mediant_search::Path;
    /// let path = Path::new(vec![(0, 0).into(), (3, 0).into(), (5, 2).into()]);
    /// assert_eq!(path.points().map(|point| point.to_string()).collect::<String>(), "(0, 0)(3, 0)(5, 2)");
    /// ```
    pub fn points(&self) -> impl ExactSizeIterator<Item = Point> + DoubleEndedIterator {
        self.waypoints.iter().copied().map(Point::from)
    }

    /// The number of waypoints. [`vertices`](Self::vertices) counts each step, [`length`](Self::length)
    /// measures.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.waypoints.len()
    }

    /// Whether there is no waypoint. The paths of engines have at least one.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.waypoints.is_empty()
    }

    /// The waypoints one after another, as a loop over `&path` has them.
    pub fn iter(&self) -> slice::Iter<'_, Vertex> {
        self.waypoints.iter()
    }

    /// The waypoints, without a copy.
    #[must_use]
    pub fn into_waypoints(self) -> Vec<Vertex> {
        self.waypoints
    }

    /// The cost: the [`length`](Self::length), but for a path on a cost surface its cost there.
    #[must_use]
    pub const fn cost(&self) -> f64 {
        match self.own_cost {
            Some(cost) => cost,
            None => self.length,
        }
    }

    /// The Euclidean length in cells, recomputed from the waypoints rather than taken from the search's
    /// fixed-point sum.
    #[must_use]
    pub const fn length(&self) -> f64 {
        self.length
    }

    /// The path from its goal to its start. Its length is summed up from there, so that it can differ from
    /// this path's in the last bits. A cost of its own is the same.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let waypoints = self.waypoints.iter().rev().copied().collect();
        Self { own_cost: self.own_cost, ..Self::new(waypoints) }
    }

    /// This path and then another one, which begins where this one ends. If it goes straight on there, that
    /// waypoint is left out; all others are kept. A path without waypoints adds nothing to another one. The
    /// costs of paths on a cost surface are added.
    ///
    /// Two paths that hold on a map can meet at a closed gap that the whole may not pass:
    /// [`check`](Self::check) tells.
    ///
    /// ```
    /// use mediant_search::Path;
    /// let path = |waypoints: &[(i32, i32)]| Path::new(waypoints.iter().map(|&at| at.into()).collect());
    /// let whole = path(&[(0, 0), (2, 1)]).joined(&path(&[(2, 1), (6, 3), (6, 9)]))?;
    /// assert_eq!(whole, path(&[(0, 0), (6, 3), (6, 9)]));
    /// # Ok::<(), mediant_search::JoinError>(())
    /// ```
    ///
    /// # Errors
    /// [`JoinError`] if the other path begins elsewhere.
    pub fn joined(&self, other: &Self) -> Result<Self, JoinError> {
        let (Some(&end), Some(&start)) = (self.waypoints.last(), other.waypoints.first()) else {
            return Ok(if self.waypoints.is_empty() { other.clone() } else { self.clone() });
        };
        if end != start {
            return Err(JoinError { end, start });
        }
        let mut waypoints = self.waypoints.clone();
        let before = waypoints.len().checked_sub(2).and_then(|index| waypoints.get(index));
        let ends = before.zip(other.waypoints.get(1));
        if ends.is_some_and(|(&before, &after)| {
            Segment::new(before, end).continues_in(&Segment::new(start, after))
        }) {
            waypoints.pop();
        }
        waypoints.extend_from_slice(other.waypoints.get(1..).unwrap_or_default());
        let has_own = self.own_cost.is_some() || other.own_cost.is_some();
        Ok(Self { own_cost: has_own.then(|| self.cost() + other.cost()), ..Self::new(waypoints) })
    }
}

impl Path {
    /// The rest of the path from a vertex on it, where the path passes it first; `None` for a vertex that is
    /// not on the path. Its cost is its length: on a cost surface, which the path does not know, measure it
    /// anew.
    ///
    /// ```
    /// use mediant_search::Path;
    /// let path = Path::new(vec![(0, 0).into(), (3, 0).into(), (5, 2).into()]);
    /// assert_eq!(path.rest((2, 0)).map(|rest| rest.to_string()).as_deref(), Some("(2, 0) → (3, 0) → (5, 2)"));
    /// assert_eq!(path.rest((5, 2)).map(|rest| rest.len()), Some(1));
    /// assert_eq!(path.rest((2, 1)), None);
    /// ```
    #[must_use]
    pub fn rest(&self, from: impl Into<Vertex>) -> Option<Self> {
        let from = from.into();
        let is_on = |ends: &[Vertex]| {
            let [one, other] = [Segment::new(ends[0], from), Segment::new(from, ends[1])];
            from == ends[0] || from == ends[1] || one.continues_in(&other)
        };
        if self.waypoints.as_slice() == [from] {
            return Some(Self::new(vec![from]));
        }
        let index = self.waypoints.windows(2).position(is_on)?;
        let after = self.waypoints[index + 1..].iter().copied().skip_while(|&at| at == from);
        Some(Self::new(std::iter::once(from).chain(after).collect()))
    }
}

/// A waypoint by its number, from 0. As with a slice, there must be one: `path.waypoints().get(at)` asks.
impl Index<usize> for Path {
    type Output = Vertex;

    fn index(&self, at: usize) -> &Vertex {
        &self.waypoints[at]
    }
}

impl<'a> IntoIterator for &'a Path {
    type Item = &'a Vertex;
    type IntoIter = slice::Iter<'a, Vertex>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl IntoIterator for Path {
    type Item = Vertex;
    type IntoIter = vec::IntoIter<Vertex>;

    fn into_iter(self) -> Self::IntoIter {
        self.waypoints.into_iter()
    }
}

/// Two paths that cannot be joined: see [`Path::joined`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the path ends at {end}, and the other one begins at {start}: they must meet to be joined")]
pub struct JoinError {
    /// Where the first path ends.
    pub end: Vertex,
    /// Where the second one begins.
    pub start: Vertex,
}

/// The waypoints, joined by arrows.
impl fmt::Display for Path {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (at, waypoint) in self.waypoints.iter().enumerate() {
            write!(f, "{}{waypoint}", if at == 0 { "" } else { " → " })?;
        }
        Ok(())
    }
}

/// The size of a path, in words.
pub(crate) struct Measured<'a>(pub(crate) &'a Path);

impl fmt::Display for Measured<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (count, length) = (self.0.len(), self.0.length());
        write!(f, "{count} waypoint{}, {length:.2} cells", if count == 1 { "" } else { "s" })?;
        self.0.own_cost.map_or(Ok(()), |cost| write!(f, ", cost {cost:.2}"))
    }
}
