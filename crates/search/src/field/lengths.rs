//! An any-angle field.

use std::{
    iter,
    ops::Deref,
    sync::{Arc, OnceLock},
};

use mediant_grid::{Change, Corners, FreeSpace, Identity, Point, Rectangle, Vertex, VertexId};
use mediant_moves::K;

use super::{
    query::{Asked, FieldError, FieldQuery},
    sight::Sight,
};
use crate::path::Path;

/// The length of a shortest any-angle path from every vertex to the nearest source, and the way there: what
/// [`AnyAngleFields`](super::AnyAngleFields) makes. It takes twelve bytes a vertex.
///
/// **Precision.** A length is a sum of rounded square roots in `f64`, one for each straight part of a path:
/// its relative error is at most 2⁻⁵² times one more than their number.
///
/// **Ties.** Of equally short paths that by the root that was settled first is kept; roots are settled in the
/// order of their distance, then of their vertex number. So the result is the same on every platform.
///
/// **Points.** Sources may be [points](FieldQuery::from_points) between vertices. And a point between
/// vertices has a distance, too: the least over the corners of obstacles that it sees, and the sources. It
/// is found when it is asked for, by a sweep over all that the point sees. What sweeps need of the map is
/// found with the first one, for all fields of one maker: a bit a vertex, and two for each column of eight
/// cells.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Corners, DiagonalGap, FreeSpace, Point};
/// use mediant_search::{AnyAngleFields, FieldQuery};
///
/// let map = AsciiMap::parse("
///     .#.
///     ...
/// ")?;
/// let space = FreeSpace::<Corners>::new(Arc::new(map.grid), DiagonalGap::Open);
/// // From the center of the first cell to that of the third, under the blocked one.
/// let (source, at) = (Point::from((0.5, 0.5)), Point::from((2.5, 0.5)));
/// let field = AnyAngleFields::new(&space).field(FieldQuery::from_points(&[source]))?;
/// assert_eq!(field.get(at), Some(1.0 + 2_f64.sqrt()));
/// assert_eq!(field.next((1, 1)), Some(source));
/// let path = field.path_from(at).ok_or("there is a way")?;
/// assert!(path.points().eq([at, (2, 1).into(), (1, 1).into(), source]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct AnyAngleField<S> {
    pub(super) space: S,
    known: Arc<Known>,
    asked: Arc<Asked>,
    pub(super) sight: Arc<OnceLock<Sight>>,
}

/// All that is known of a field.
#[derive(Debug)]
pub(super) struct Known {
    /// By vertex number; infinity stands for 'not in the field'.
    pub(super) lengths: Vec<f64>,
    /// By vertex number: the number of the vertex where the path next bends or ends, a source's own; beyond
    /// all vertices that of a source between them.
    pub(super) toward: Vec<u32>,
    /// The sources between vertices.
    pub(super) between: Box<[Point]>,
    /// The greatest length, with room for rounding.
    pub(super) reach: f64,
}

impl<S> AnyAngleField<S> {
    pub(super) fn new(space: S, known: Known, query: FieldQuery<'_>, sight: Arc<OnceLock<Sight>>) -> Self {
        Self { space, known: Arc::new(known), asked: Arc::new(query.into()), sight }
    }

    /// All that is known of the field.
    pub(super) fn known(&self) -> &Known {
        &self.known
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
        &self.known.lengths
    }

    /// The memory used, in bytes, without that of the free space.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        let Known { lengths, toward, between, .. } = &*self.known;
        let labels = lengths.capacity() * size_of::<f64>() + toward.capacity() * size_of::<u32>();
        labels + size_of_val(&**between) + self.sight.get().map_or(0, Sight::memory_bytes)
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
        self.query().check_points(&space)?;
        let is_far = !change.cells().iter().any(|&cells| self.comes_near(cells));
        let (known, asked) = (Arc::clone(&self.known), Arc::clone(&self.asked));
        // Points see by the new map.
        Ok(is_far.then(|| Self { space, known, asked, sight: Arc::default() }))
    }

    /// Whether a path in the field, before a change of some cells or after it, may touch these cells.
    ///
    /// Take such a path, up to where it first touches one, and on it the point that is 1.5 cells before. (If
    /// it is shorter, its source is near, and in the field or between vertices.) That point touches a free
    /// cell. The corners of this cell are at most √2 further than the point, so within the limit, and at most
    /// three from the changed cell. The path is legal on both maps; so those of the corners at which a path
    /// may end are in the field. There is one, unless all four are closed gaps: then the path began at one of
    /// them, or in the cell.
    fn comes_near(&self, cells: Rectangle) -> bool {
        const NEAR: u32 = 3;
        let span = |first: u32, count: u32, all: u32| {
            first.saturating_sub(NEAR) as i32..(first + count + 1 + NEAR).min(all) as i32
        };
        let (columns, mut rows) =
            (span(cells.x, cells.width, self.width()), span(cells.y, cells.height, self.height()));
        let is_near = |at: &Point| columns.contains(&at.floor().x) && rows.contains(&at.floor().y);
        self.known.between.iter().any(is_near)
            || rows.any(|y| columns.clone().any(|x| self.get(Vertex::new(x, y)).is_some()))
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

    /// The distance of a vertex or of a point between vertices in cells, 0 at a source; `None` when it is not
    /// in the field, or outside the map.
    #[must_use]
    #[inline]
    pub fn get(&self, at: impl Into<Point>) -> Option<f64> {
        let at = at.into();
        match at.vertex() {
            Some(at) => self.at_vertex(at),
            None => self.seek(at).map(|(length, _)| length),
        }
    }

    /// The distance of a vertex.
    #[inline]
    pub(super) fn at_vertex(&self, at: Vertex) -> Option<f64> {
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

    /// The point in sight to which a shortest path from a vertex, or a point between vertices, first leads:
    /// the source, or a corner of an obstacle; `None` at a source, and where [`get`](Self::get) is `None`.
    #[must_use]
    pub fn next(&self, at: impl Into<Point>) -> Option<Point> {
        self.first(at.into())?
    }

    /// [`next`](Self::next); `None` where [`get`](Self::get) is `None`.
    fn first(&self, at: Point) -> Option<Option<Point>> {
        let Some(vertex) = at.vertex() else { return self.seek(at).map(|(_, next)| next) };
        let length = self.at_vertex(vertex)?;
        let number = *self.known.toward.get(self.space.id(vertex)?.index())?;
        let next = match (number as usize).checked_sub(self.known.toward.len()) {
            None => Some(self.space.vertex(VertexId(number)).into()),
            Some(index) => self.known.between.get(index).copied(),
        };
        Some(next.filter(|_| length > 0.0))
    }

    /// The direction to [`next`](Self::next): a vector (x, y) of length 1.
    #[must_use]
    pub fn direction(&self, at: impl Into<Point>) -> Option<(f64, f64)> {
        let at = at.into();
        let next = self.next(at)?;
        let ((x, y), (to_x, to_y)) = (at.parts(), next.parts());
        let (dx, dy) = ((to_x - x) as f64, (to_y - y) as f64);
        let length = (dx * dx + dy * dy).sqrt();
        Some((dx / length, dy / length))
    }

    /// A shortest path from a vertex, or a point between vertices, to its nearest source, with waypoints
    /// where it bends; `None` where [`get`](Self::get) is `None`.
    #[must_use]
    pub fn path_from(&self, at: impl Into<Point>) -> Option<Path> {
        Some(Path::straightened(self.ahead(at.into())?))
    }

    /// The nearest source of a vertex, or a point between them: where [`path_from`](Self::path_from) ends.
    #[must_use]
    pub fn nearest_source(&self, at: impl Into<Point>) -> Option<Point> {
        self.ahead(at.into())?.last()
    }

    /// A point, and where its path leads next, and next, to the source.
    fn ahead(&self, at: Point) -> Option<impl Iterator<Item = Point>> {
        let first = self.first(at)?;
        Some(iter::once(at).chain(iter::successors(first, |&at| self.next(at))))
    }
}
