//! The segments of a path, and the moves, vertices and cells along them.

use mediant_grid::{
    PlacementKind, Point, Vector, Vertex,
    sight::{point_cells, segment_cells},
};
use mediant_moves::{K, level};

use super::Path;

/// The straight piece between two points. Points may be anywhere, so displacements are 64 bits wide.
#[derive(Clone, Copy, Debug)]
pub(super) struct Segment {
    pub(super) from: Point,
    pub(super) to: Point,
}

impl Segment {
    pub(super) fn new(from: impl Into<Point>, to: impl Into<Point>) -> Self {
        Self { from: from.into(), to: to.into() }
    }

    /// The displacement from start to end, in parts of a cell.
    pub(super) const fn by(&self) -> (i64, i64) {
        let ((from_x, from_y), (to_x, to_y)) = (self.from.parts(), self.to.parts());
        (to_x - from_x, to_y - from_y)
    }

    /// Its ends, if both are vertices.
    pub(super) fn ends(&self) -> Option<[Vertex; 2]> {
        Some([self.from.vertex()?, self.to.vertex()?])
    }

    pub(super) fn length(&self) -> f64 {
        self.from.distance(self.to)
    }

    /// The determinant of two displacements, and their scalar product.
    pub(super) fn det_and_dot(&self, next: &Self) -> (i128, i128) {
        let ((a, b), (c, d)) = (self.by(), next.by());
        let product = |a: i64, b: i64| i128::from(a) * i128::from(b);
        (product(a, d) - product(b, c), product(a, c) + product(b, d))
    }

    /// Whether both have a length and the same direction.
    pub(super) fn continues_in(&self, next: &Self) -> bool {
        let (det, dot) = self.det_and_dot(next);
        det == 0 && dot > 0
    }

    /// The number of moves in it, between vertices: the greatest common divisor of its displacement.
    fn times(&self) -> i64 {
        let (mut a, mut b) = (self.by().0.abs(), self.by().1.abs());
        while b != 0 {
            (a, b) = (b, a % b);
        }
        a / Point::PARTS
    }

    /// Its move, if it has a length, its ends are vertices, and the move fits.
    fn unit(&self) -> Option<Vector> {
        self.ends()?;
        let (times, (x, y)) = (self.times(), self.by());
        let (x, y) = (x / Point::PARTS, y / Point::PARTS);
        let along = |by: i64| i32::try_from(by.checked_div(times)?).ok();
        Some(Vector::new(along(x)?, along(y)?))
    }

    /// The cells that it touches: see [`Path::touched_cells`].
    fn touched_cells(&self, placement: PlacementKind) -> impl Iterator<Item = (i32, i32)> + use<> {
        // One of both is empty on a segment between vertices.
        let of_vertices = self.ends().into_iter().flat_map(move |[from, to]| {
            segment_cells(placement, from, to).chain(beside(placement, from, to))
        });
        let of_points = if self.ends().is_none() { point_cells(self.from, self.to) } else { Vec::new() };
        of_vertices.chain(of_points)
    }
}

/// The cells on both sides of a segment that runs along a grid line; none of others.
fn beside(placement: PlacementKind, from: Vertex, to: Vertex) -> impl Iterator<Item = (i32, i32)> + use<> {
    let (by_x, by_y) = (i64::from(to.x) - i64::from(from.x), i64::from(to.y) - i64::from(from.y));
    let is_along = placement == PlacementKind::Corner && (by_x == 0) != (by_y == 0);
    let steps = if is_along { by_x.abs() + by_y.abs() } else { 0 };
    let (x, y) = (by_x.signum(), by_y.signum());
    (0..steps).flat_map(move |step| {
        // The cell that the step's edge is the top or the left side of, and the one across.
        let [column, row] =
            [(from.x, x), (from.y, y)].map(|(from, by)| (i64::from(from) + by * step + by.min(0)) as i32);
        let across = if x == 0 { (column.saturating_sub(1), row) } else { (column, row.saturating_sub(1)) };
        [across, (column, row)]
    })
}

impl Path {
    /// The segments that have a length.
    pub(super) fn segments(&self) -> impl Iterator<Item = Segment> + Clone + '_ {
        let segments = self.points().zip(self.points().skip(1)).map(|(from, to)| Segment::new(from, to));
        segments.filter(|segment| segment.from != segment.to)
    }

    /// The moves of the path, one after another: each segment is one vector of gcd 1, once or several times.
    /// On a path over N(k) these are the moves of N(k).
    ///
    /// ```
    /// use mediant_search::Path;
    /// let path = Path::new(vec![(0, 0).into(), (4, 2).into(), (4, 3).into()]);
    /// assert!(path.moves().eq([(2, 1), (2, 1), (0, 1)].map(Into::into)));
    /// ```
    pub fn moves(&self) -> impl Iterator<Item = Vector> {
        let moves = self.segments().filter_map(|segment| Some((segment.unit()?, segment.times())));
        moves.flat_map(|(unit, times)| (0..times).map(move |_| unit))
    }

    /// The walk: every vertex on the path, in order, which are the waypoints and all vertices that its
    /// segments pass exactly through. On a path over N(k) there is one after each move: where an agent stands
    /// that makes one move at a time. Standing still counts once. A path with points that are no vertices has
    /// none.
    pub fn vertices(&self) -> impl Iterator<Item = Vertex> {
        vertices(&self.waypoints)
    }

    /// Every cell that the path touches, as (x, y), in the order in which it does, and each time that it
    /// comes back. These are not the places where an agent stands one after another: those are the
    /// [`vertices`](Self::vertices).
    ///
    /// Between centers it touches every cell that its segments do, and where it passes exactly through a
    /// corner of cells all four there. At corners it touches the cells whose open interior it meets, and
    /// along a grid line those on both sides, of each step first the one above or to the left. Cells outside
    /// of any map are among them. No cell comes twice in a row. Of one segment: [`segment_cells`].
    ///
    /// ```
    /// use mediant_search::Path;
    /// use mediant_grid::PlacementKind;
    /// let path = Path::new(vec![(0, 0).into(), (2, 0).into(), (3, 1).into()]);
    /// let cells = |placement| path.touched_cells(placement).collect::<Vec<_>>();
    /// assert_eq!(cells(PlacementKind::Center), [(0, 0), (1, 0), (2, 0), (3, 0), (2, 1), (3, 1)]);
    /// assert_eq!(cells(PlacementKind::Corner), [(0, -1), (0, 0), (1, -1), (1, 0), (2, 0)]);
    /// ```
    pub fn touched_cells(&self, placement: PlacementKind) -> impl Iterator<Item = (i32, i32)> {
        let alone = self.start().filter(|_| self.segments().next().is_none());
        let alone = alone.map(|at| Segment::new(at, at));
        let segments = alone.into_iter().chain(self.segments());
        let mut last = None;
        segments
            .flat_map(move |segment| segment.touched_cells(placement))
            .filter(move |&cell| last.replace(cell) != Some(cell))
    }

    /// Whether each segment of the path is a move of N(k), taken once or several times in a row: whether it
    /// is a path over N(k). Smoothed paths and those at any angle are not, as a rule, at a finite k. Whether
    /// the path holds on a map is another question: [`check`](Self::check).
    ///
    /// ```
    /// use mediant_search::Path;
    /// use mediant_moves::K;
    /// let path = Path::new(vec![(0, 0).into(), (4, 2).into(), (4, 3).into()]);
    /// assert!(path.is_over(K::N16) && !path.is_over(K::N8));
    /// ```
    #[must_use]
    pub fn is_over(&self, k: K) -> bool {
        let K::Finite(k) = k else { return true };
        let is_of_k = |unit: Vector| level(unit).is_some_and(|level| level <= k.get());
        self.segments().all(|segment| segment.unit().is_some_and(is_of_k))
    }
}

/// All vertices on a path through these waypoints, without repetition in a row.
pub(crate) fn vertices(waypoints: &[Vertex]) -> impl Iterator<Item = Vertex> {
    let ends = waypoints.windows(2).filter(|ends| ends[0] != ends[1]);
    let rest = ends.flat_map(|ends| between(ends[0], ends[1]).chain([ends[1]]));
    waypoints.first().copied().into_iter().chain(rest)
}

/// The vertices strictly between two others on the straight segment that joins them.
pub(crate) fn between(from: Vertex, to: Vertex) -> impl DoubleEndedIterator<Item = Vertex> {
    let segment = Segment::new(from, to);
    let (times, (x, y)) = (segment.times().max(1), segment.by());
    let (x, y) = (x / Point::PARTS, y / Point::PARTS);
    // Between two numbers of 32 bits.
    let along = move |from: i32, by: i64, part: i64| (i64::from(from) + by / times * part) as i32;
    (1..times).map(move |part| Vertex::new(along(from.x, x, part), along(from.y, y, part)))
}
