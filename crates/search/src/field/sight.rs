//! Distances of points between vertices in an any-angle field.
//!
//! A shortest path from such a point is straight to its source, or bends first at a convex corner that the
//! point sees. The corners are vertices, whose distances the field holds. A path from the point is no shorter
//! than that from its first corner: so where the field has a limit and the point is within it, the corner is
//! so too.

use std::ops::Deref;

use mediant_grid::{
    BitMatrix, Corners, FreeSpace, Point,
    sight::{Quadrants, RowSummary, VisibilitySweep},
    uninterrupted,
};

use super::{any_angle::bends, lengths::AnyAngleField};

/// The sight of a map's points.
#[derive(Debug)]
pub(super) struct Sight {
    /// The convex corners of obstacles at which paths may bend.
    corners: BitMatrix,
    summary: RowSummary,
}

impl Sight {
    fn new(space: &FreeSpace<Corners>) -> Self {
        let corners = uninterrupted(|never| bends(space, never));
        Self { corners, summary: RowSummary::new(space.grid()) }
    }

    pub(super) fn memory_bytes(&self) -> usize {
        size_of_val(self.corners.words()) + self.summary.memory_bytes()
    }
}

impl<S: Deref<Target = FreeSpace<Corners>>> AnyAngleField<S> {
    /// The distance of a point between vertices, and where its path leads first: nowhere from a source.
    #[cold]
    pub(super) fn seek(&self, at: Point) -> Option<(f64, Option<Point>)> {
        if self.known().between.contains(&at) {
            return Some((0.0, None));
        }
        let space: &FreeSpace<Corners> = &self.space;
        let place = space.place(at)?;
        let Sight { corners, summary } = self.sight.get_or_init(|| Sight::new(space));
        let (mut least, mut next) = (f64::INFINITY, None);
        VisibilitySweep::default().seen(space, summary, corners, place, Quadrants::ALL, |corner| {
            let length = self.at_vertex(corner).map(|length| length + at.distance(corner.into()));
            if let Some(length) = length.filter(|&length| length < least) {
                (least, next) = (length, Some(corner.into()));
            }
        });
        // From the last one on: of equally near sources the first one remains.
        for source in self.query().all_sources().rev() {
            let length = at.distance(source);
            if length <= least && space.point_sees(at, source) && space.may_turn_at(Some(at), source, None) {
                (least, next) = (length, Some(source));
            }
        }
        next.filter(|_| least <= self.known().reach).map(|next| (least, Some(next)))
    }
}
