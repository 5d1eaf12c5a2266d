//! An any-angle field.

use std::{ops::Deref, sync::Arc};

use mediant_grid::{Change, Corners, FreeSpace, Identity, Rectangle, Vertex, VertexId};
use mediant_moves::K;

use super::query::{Asked, FieldError, FieldQuery};
use crate::{line_path::push_waypoint, path::Path};

/// The length of a shortest any-angle path from every vertex to the nearest source, and the way there: what
/// [`AnyAngleFields`](super::AnyAngleFields) makes. It takes twelve bytes a vertex.
///
/// **Precision.** A length is a sum of rounded square roots in `f64`, one for each straight part of a path:
/// its relative error is at most 2⁻⁵² times one more than their number.
///
/// **Ties.** Of equally short paths that by the root that was settled first is kept; roots are settled in the
/// order of their distance, then of their vertex number. So the result is the same on every platform.
#[derive(Clone, Debug)]
pub struct AnyAngleField<S> {
    space: S,
    labels: Arc<Labels>,
    asked: Arc<Asked>,
}

#[derive(Debug)]
struct Labels {
    /// By vertex number; infinity stands for 'not in the field'.
    lengths: Vec<f64>,
    /// By vertex number: the vertex where the path next bends or ends; a source's own.
    toward: Vec<u32>,
}

impl<S> AnyAngleField<S> {
    pub(super) fn new(space: S, lengths: Vec<f64>, toward: Vec<u32>, query: FieldQuery<'_>) -> Self {
        Self { space, labels: Arc::new(Labels { lengths, toward }), asked: Arc::new(query.into()) }
    }

    /// The query that it answers.
    #[must_use]
    pub fn query(&self) -> FieldQuery<'_> {
        self.asked.query()
    }

    /// The distances by vertex number, row by row, in cells; infinity where a vertex is not in the field:
    /// where it is blocked, cannot be reached, or is farther than the limit.
    #[must_use]
    pub fn lengths(&self) -> &[f64] {
        &self.labels.lengths
    }

    /// The memory used, in bytes, without that of the free space.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        let Labels { lengths, toward } = &*self.labels;
        lengths.capacity() * size_of::<f64>() + toward.capacity() * size_of::<u32>()
    }
}

impl<S: Deref<Target = FreeSpace<Corners>>> AnyAngleField<S> {
    /// The identity: its map and rules, and k = ∞.
    #[must_use]
    pub fn identity(&self) -> Identity {
        Identity { k: Some(K::Any), ..self.space.identity() }
    }

    /// The field of the same query after a change of its map, if no path in it comes near the changed cells:
    /// the same distances. `None` otherwise; then it has to be made anew. `space` is that of the map after
    /// the change.
    ///
    /// # Errors
    /// [`FieldError::Mismatch`] for a change of another map, or another space than the one after it;
    /// [`FieldError::Query`] for the first source that is now blocked.
    pub fn repaired(&self, space: S, change: &Change) -> Result<Option<Self>, FieldError> {
        let mine = self.identity();
        let [before, after] =
            [change.before(), change.after()].map(|map| Identity { map: Some(map.id()), ..mine });
        mine.check("the field", ("the map before the change", before))?;
        after.check("the field after the change", ("the free space", space.identity()))?;
        self.query().check(&space)?;
        let is_far = !change.cells().iter().any(|&cells| self.comes_near(cells));
        Ok(is_far.then(|| Self { space, labels: Arc::clone(&self.labels), asked: Arc::clone(&self.asked) }))
    }

    /// Whether a path in the field, before a change of some cells or after it, may touch these cells.
    ///
    /// Take such a path, up to where it first touches one, and on it the point that is 1.5 cells before. (If
    /// it is shorter, its source is near and in the field.) That point touches a free cell. The corners of
    /// this cell are at most √2 further than the point, so within the limit, and at most three from the
    /// changed cell. The path is legal on both maps; so those of the corners at which a path may end are in
    /// the field. There is one, unless all four are closed gaps: then the path began at one of them.
    fn comes_near(&self, cells: Rectangle) -> bool {
        const NEAR: u32 = 3;
        let span = |first: u32, count: u32, all: u32| {
            first.saturating_sub(NEAR) as i32..(first + count + 1 + NEAR).min(all) as i32
        };
        let (columns, mut rows) =
            (span(cells.x, cells.width, self.width()), span(cells.y, cells.height, self.height()));
        rows.any(|y| columns.clone().any(|x| self.get(Vertex::new(x, y)).is_some()))
    }

    /// The number of vertices in a row.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.space.grid().width() + 1
    }

    /// The number of rows of vertices.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.space.grid().height() + 1
    }

    /// The distance of a vertex in cells, 0 at a source; `None` when it is not in the field, or outside the
    /// map.
    #[must_use]
    pub fn get(&self, at: Vertex) -> Option<f64> {
        self.lengths().get(self.space.id(at)?.index()).copied().filter(|length| length.is_finite())
    }

    /// The vertices in the field, row by row, with their distances.
    pub fn iter(&self) -> impl Iterator<Item = (Vertex, f64)> {
        let rows = self.lengths().chunks_exact(self.width() as usize).zip(0..);
        rows.flat_map(|(row, y)| {
            let known = row.iter().zip(0..).filter(|(length, _)| length.is_finite());
            known.map(move |(&length, x)| (Vertex::new(x, y), length))
        })
    }

    /// The vertex in sight to which a shortest path from a vertex first leads: the source, or a corner of an
    /// obstacle; `None` at a source, and where [`get`](Self::get) is `None`.
    #[must_use]
    pub fn next(&self, at: Vertex) -> Option<Vertex> {
        self.get(at).filter(|&length| length > 0.0)?;
        let next = self.labels.toward.get(self.space.id(at)?.index())?;
        Some(self.space.vertex(VertexId(*next)))
    }

    /// The direction to [`next`](Self::next): a vector (x, y) of length 1.
    #[must_use]
    pub fn direction(&self, at: Vertex) -> Option<(f64, f64)> {
        let next = self.next(at)?;
        let (v, length) = (at.to(next), at.distance(next));
        Some((f64::from(v.x) / length, f64::from(v.y) / length))
    }

    /// A shortest path from a vertex to its nearest source, with waypoints where it bends; `None` where
    /// [`get`](Self::get) is `None`.
    #[must_use]
    pub fn path_from(&self, at: Vertex) -> Option<Path> {
        self.get(at)?;
        let mut waypoints = vec![at];
        let ahead = std::iter::successors(self.next(at), |&at| self.next(at));
        ahead.for_each(|next| push_waypoint(&mut waypoints, next));
        Some(Path::new(waypoints))
    }

    /// The nearest source of a vertex: where [`path_from`](Self::path_from) ends.
    #[must_use]
    pub fn nearest_source(&self, at: Vertex) -> Option<Vertex> {
        self.get(at)?;
        std::iter::successors(Some(at), |&at| self.next(at)).last()
    }
}
