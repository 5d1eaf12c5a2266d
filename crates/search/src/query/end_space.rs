//! The ends that paths on a map may have.

use mediant_grid::{Corners, FreeSpace, GridGraph, Placement, Point, Vertex};

use super::{End, QueryError};

/// A map that says which ends paths on it may have, and which are connected. Every free space does: points
/// between vertices are for corner placement, where paths at any angle take them.
pub trait EndSpace {
    /// The number of columns and of rows of vertices.
    fn size(&self) -> (u32, u32);

    /// Whether a path may stand on a vertex.
    fn is_free(&self, at: Vertex) -> bool;

    /// Checks that a path may start or end at a point.
    ///
    /// # Errors
    /// [`QueryError::Outside`], [`QueryError::Blocked`], or [`QueryError::Between`] for a point that is no
    /// vertex where only vertices are ends.
    fn check(&self, end: End, at: Point) -> Result<(), QueryError>;

    /// Whether a path leads from one free point to another.
    fn connected(&self, from: Point, to: Point) -> bool;

    /// The point of the map's rectangle that is nearest to a point along each axis.
    fn clamped(&self, at: Point) -> Point {
        let (width, height) = self.size();
        let (x, y) = at.parts();
        let last = |vertices: u32| i64::from(vertices.saturating_sub(1)) * Point::PARTS;
        Point::from_parts(x.clamp(0, last(width)), y.clamp(0, last(height)))
    }

    /// The point in the coordinates in which planners search: between centers at any angle other ones than
    /// those of a query ([`CenterSpace`]).
    fn searched(&self, at: Point) -> Point {
        at
    }
}

/// The free space of corners for paths at any angle between the centers of cells: its vertices are these
/// centers, at whole coordinates, and [nearest](crate::Query::nearest) and all other wishes look at them.
///
/// The paths of a search bend at corners. So planners search between corners, and their paths are in those
/// coordinates: [`Path::at_centers`](crate::Path::at_centers) has them in these.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Corners, DiagonalGap, FreeSpace};
/// use mediant_search::{Anya, CenterSpace, Planner, Query, Search, parts::Metric};
///
/// let map = AsciiMap::parse("
///     .@.
///     ...
/// ")?;
/// let free = Arc::new(FreeSpace::<Corners>::new(Arc::new(map.grid), DiagonalGap::Closed));
/// let mut planner = Anya::new(Arc::clone(&free));
/// let query = Query::new((0, 0), (2, 0));
/// let mut search = Search::new(&CenterSpace(&free), Metric::Euclidean, planner.guarantee(), query)?;
/// let path = search.finish(&mut planner, &mut ())?.into_path().expect("there is a way");
/// assert_eq!(path.at_centers().to_string(), "(0, 0) → (0.5, 0.5) → (1.5, 0.5) → (2, 0)");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct CenterSpace<'s>(
    /// The free space of corners.
    pub &'s FreeSpace<Corners>,
);

impl EndSpace for CenterSpace<'_> {
    fn size(&self) -> (u32, u32) {
        (self.0.grid().width(), self.0.grid().height())
    }

    fn is_free(&self, at: Vertex) -> bool {
        self.0.grid().is_free(at.x, at.y)
    }

    fn check(&self, end: End, at: Point) -> Result<(), QueryError> {
        end.check_point(self.0, at.at_corners()).map_err(QueryError::at_centers)
    }

    fn connected(&self, from: Point, to: Point) -> bool {
        self.0.points_connected(from.at_corners(), to.at_corners())
    }

    fn clamped(&self, at: Point) -> Point {
        self.0.clamped(at.at_corners()).at_centers()
    }

    fn searched(&self, at: Point) -> Point {
        at.at_corners()
    }
}

impl<P: Placement> EndSpace for FreeSpace<P> {
    fn size(&self) -> (u32, u32) {
        P::vertices(self.grid())
    }

    fn is_free(&self, at: Vertex) -> bool {
        Self::is_free(self, at)
    }

    fn check(&self, end: End, at: Point) -> Result<(), QueryError> {
        match (at.vertex(), P::at_corners(self)) {
            (Some(at), _) => end.check(self, at),
            (None, Some(space)) => end.check_point(space, at),
            (None, None) => Err(QueryError::Between { end, at }),
        }
    }

    fn connected(&self, from: Point, to: Point) -> bool {
        match (from.vertex().zip(to.vertex()), P::at_corners(self)) {
            (Some((from, to)), _) => Self::connected(self, from, to),
            (None, Some(space)) => space.points_connected(from, to),
            (None, None) => false,
        }
    }
}

/// By its free space.
impl<P: Placement> EndSpace for GridGraph<P> {
    fn size(&self) -> (u32, u32) {
        EndSpace::size(&**self)
    }

    fn is_free(&self, at: Vertex) -> bool {
        EndSpace::is_free(&**self, at)
    }

    fn check(&self, end: End, at: Point) -> Result<(), QueryError> {
        EndSpace::check(&**self, end, at)
    }

    fn connected(&self, from: Point, to: Point) -> bool {
        EndSpace::connected(&**self, from, to)
    }
}
