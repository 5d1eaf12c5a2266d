//! The ends that paths on a map may have.

use mediant_grid::{FreeSpace, GridGraph, Placement, Point, Vertex};

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
