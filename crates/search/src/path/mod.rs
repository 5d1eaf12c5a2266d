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
/// **Paths between points.** An any-angle path may start and end between vertices. Then
/// [`points`](Self::points) has all that it leads through; [`waypoints`](Self::waypoints), which are
/// vertices, are those of a path all of whose points are vertices, and such a path has none.
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
    /// Empty if some point is no vertex.
    waypoints: Vec<Vertex>,
    /// All points, if some point is no vertex.
    points: Option<Box<[Point]>>,
    length: f64,
    /// The cost on a cost surface.
    own_cost: Option<f64>,
}

impl PartialEq for Path {
    fn eq(&self, other: &Self) -> bool {
        self.points().eq(other.points()) && self.cost() == other.cost()
    }
}

impl Path {
    /// The path along these waypoints; its cost is its length, the sum of the lengths of the segments between
    /// them.
    #[must_use]
    pub fn new(waypoints: Vec<Vertex>) -> Self {
        // Not `sum`, which yields −0 for no segments.
        let length = waypoints.windows(2).fold(0.0, |length, ends| length + ends[0].distance(ends[1]));
        Self { waypoints, points: None, length, own_cost: None }
    }

    /// The path along these points, which need not be vertices.
    ///
    /// ```
    /// use mediant_search::Path;
    /// let path = Path::through([(0.5, 0.5), (0.5, 2.0)]);
    /// assert_eq!((path.length(), path.len(), path.waypoints().len()), (1.5, 2, 0));
    /// assert_eq!(Path::through([(0.0, 0.0), (3.0, 4.0)]), Path::new(vec![(0, 0).into(), (3, 4).into()]));
    /// ```
    #[must_use]
    pub fn through(points: impl IntoIterator<Item = impl Into<Point>>) -> Self {
        let points: Box<[Point]> = points.into_iter().map(Into::into).collect();
        if let Some(waypoints) = points.iter().map(|at| at.vertex()).collect() {
            return Self::new(waypoints);
        }
        let length = points.windows(2).fold(0.0, |length, ends| length + ends[0].distance(ends[1]));
        Self { waypoints: Vec::new(), points: Some(points), length, own_cost: None }
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

    /// [`through`](Self::through) these points, but for those at which the path stands still or goes straight
    /// on.
    #[doc(hidden)]
    #[must_use]
    pub fn straightened(points: impl IntoIterator<Item = impl Into<Point>>) -> Self {
        let mut kept: Vec<Point> = Vec::new();
        for at in points.into_iter().map(Into::into) {
            match kept[..] {
                [.., last] if last == at => continue,
                [.., before, last] if Segment::new(before, last).continues_in(&Segment::new(last, at)) => {
                    kept.pop();
                }
                _ => {}
            }
            kept.push(at);
        }
        Self::through(kept)
    }

    /// The waypoints, start and goal included; none of a path with points that are no vertices, which
    /// [`points`](Self::points) has.
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
    pub fn points(&self) -> impl ExactSizeIterator<Item = Point> + DoubleEndedIterator + Clone {
        let (vertices, between) = (&self.waypoints, self.points.as_deref().unwrap_or_default());
        // One of both is empty.
        (0..vertices.len().max(between.len())).map(|index| match vertices.get(index) {
            Some(&at) => at.into(),
            None => between[index],
        })
    }

    /// Where it begins; `None` without points.
    #[must_use]
    pub fn start(&self) -> Option<Point> {
        self.points().next()
    }

    /// Where it ends; `None` without points.
    #[must_use]
    pub fn goal(&self) -> Option<Point> {
        self.points().next_back()
    }

    /// The number of points. [`vertices`](Self::vertices) counts each step, [`length`](Self::length)
    /// measures.
    #[must_use]
    pub fn len(&self) -> usize {
        self.points().len()
    }

    /// Whether there is no point. The paths of engines have at least one.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
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
        Self { own_cost: self.own_cost, ..Self::through(self.points().rev()) }
    }

    /// A path of a search between corners in the coordinates of centers: see
    /// [`CenterSpace`](crate::CenterSpace).
    #[must_use]
    pub fn at_centers(&self) -> Self {
        Self { own_cost: self.own_cost, ..Self::through(self.points().map(Point::at_centers)) }
    }

    /// The other way round.
    #[must_use]
    pub fn at_corners(&self) -> Self {
        Self { own_cost: self.own_cost, ..Self::through(self.points().map(Point::at_corners)) }
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
        let (Some(end), Some(start)) = (self.goal(), other.start()) else {
            return Ok(if self.is_empty() { other.clone() } else { self.clone() });
        };
        if end != start {
            return Err(JoinError { end, start });
        }
        let mut points: Vec<Point> = self.points().collect();
        let ends = self.points().rev().nth(1).zip(other.points().nth(1));
        if ends.is_some_and(|(before, after)| {
            Segment::new(before, end).continues_in(&Segment::new(start, after))
        }) {
            points.pop();
        }
        points.extend(other.points().skip(1));
        let has_own = self.own_cost.is_some() || other.own_cost.is_some();
        Ok(Self { own_cost: has_own.then(|| self.cost() + other.cost()), ..Self::through(points) })
    }
}

impl Path {
    /// The rest of the path from a point on it, where the path passes it first; `None` for a point that is
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
    pub fn rest(&self, from: impl Into<Point>) -> Option<Self> {
        let from = from.into();
        let points: Vec<Point> = self.points().collect();
        let is_on = |ends: &[Point]| {
            let [one, other] = [Segment::new(ends[0], from), Segment::new(from, ends[1])];
            from == ends[0] || from == ends[1] || one.continues_in(&other)
        };
        if points == [from] {
            return Some(Self::through([from]));
        }
        let index = points.windows(2).position(is_on)?;
        let after = points[index + 1..].iter().copied().skip_while(|&at| at == from);
        Some(Self::through(std::iter::once(from).chain(after)))
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
    pub end: Point,
    /// Where the second one begins.
    pub start: Point,
}

/// The waypoints, joined by arrows.
impl fmt::Display for Path {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (at, waypoint) in self.points().enumerate() {
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
