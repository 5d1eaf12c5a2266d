//! Fields at any angle between the centers of cells.
//!
//! On a map on which each cell is four, of half the size, centers and corners are corners alike. So the field
//! is one between corners there, and tells every second of its rows and columns.

use std::sync::Arc;

use mediant_grid::{Corners, FreeSpace, Grid, Identity, Interrupt, Point, Vertex};
use mediant_search::{AnyAngleField, AnyAngleFields, End, FieldError, FieldQuery, Path};

use crate::{error::Error, space::Space};

/// Makes fields between centers in a space.
pub(super) struct CenterFields {
    space: Space,
    halves: AnyAngleFields<Arc<FreeSpace<Corners>>>,
}

/// A field between centers.
pub(super) struct CenterField {
    identity: Identity,
    width: u32,
    height: u32,
    /// In the order in which they were given.
    sources: Vec<Point>,
    /// In cells.
    limit: f64,
    halves: AnyAngleField<Arc<FreeSpace<Corners>>>,
}

impl CenterFields {
    /// For the free space of corners of a space.
    ///
    /// # Errors
    /// [`Error::Map`] for a map that is too large to have twice as many columns and rows;
    /// [`Error::Stopped`].
    pub(super) fn new(
        space: &Space,
        free: &FreeSpace<Corners>,
        interrupt: &Interrupt,
    ) -> Result<Self, Error> {
        let grid = free.grid();
        let is_blocked = |x: u32, y: u32| grid.is_blocked((x / 2) as i32, (y / 2) as i32);
        let doubled = Arc::new(Grid::from_fn(2 * grid.width(), 2 * grid.height(), is_blocked)?);
        let doubled = FreeSpace::interruptible(doubled, free.rule(), mediant_moves::K::Any, interrupt)?;
        let halves = AnyAngleFields::interruptible(Arc::new(doubled), interrupt)?;
        Ok(Self { space: space.clone(), halves })
    }

    pub(super) fn identity(&self) -> Identity {
        self.space.identity()
    }

    pub(super) fn field(
        &mut self,
        query: FieldQuery<'_>,
        interrupt: &Interrupt,
    ) -> Result<CenterField, FieldError> {
        let sources: Vec<Point> = query.all_sources().collect();
        sources.iter().try_for_each(|&at| self.space.check_end(End::Start, at))?;
        let doubled: Vec<Point> = sources.iter().copied().map(in_halves).collect();
        let vertices: Option<Vec<Vertex>> = doubled.iter().map(|at| at.vertex()).collect();
        let of_halves = match &vertices {
            Some(vertices) => FieldQuery::new(vertices),
            None => FieldQuery::from_points(&doubled),
        };
        let halves = self.halves.field_interruptible(of_halves.within(2.0 * query.limit), interrupt)?;
        let (map, identity) = (self.space.map(), self.identity());
        let (width, height) = (map.width(), map.height());
        Ok(CenterField { identity, width, height, sources, limit: query.limit, halves })
    }
}

impl CenterField {
    pub(super) const fn identity(&self) -> Identity {
        self.identity
    }

    pub(super) const fn width(&self) -> u32 {
        self.width
    }

    pub(super) const fn height(&self) -> u32 {
        self.height
    }

    pub(super) fn sources(&self) -> &[Point] {
        &self.sources
    }

    pub(super) const fn limit(&self) -> f64 {
        self.limit
    }

    pub(super) fn get(&self, at: Point) -> Option<f64> {
        self.halves.get(in_halves(at)).map(|length| length / 2.0)
    }

    pub(super) fn next(&self, at: Point) -> Option<Point> {
        self.halves.next(in_halves(at)).map(in_cells)
    }

    pub(super) fn nearest_source(&self, at: Point) -> Option<Point> {
        self.halves.nearest_source(in_halves(at)).map(in_cells)
    }

    pub(super) fn path_from(&self, at: Point) -> Option<Path> {
        Some(Path::through(self.halves.path_from(in_halves(at))?.points().map(in_cells)))
    }

    /// The lengths of all centers, row by row, infinite where there is none.
    pub(super) fn lengths(&self) -> impl Iterator<Item = f64> {
        let rows = self.halves.lengths().chunks(2 * self.width as usize + 1).skip(1).step_by(2);
        rows.flat_map(|row| row.iter().skip(1).step_by(2).map(|length| length / 2.0))
    }

    /// The centers that have a length.
    pub(super) fn iter(&self) -> impl Iterator<Item = (Vertex, f64)> {
        let (width, height) = (self.width as i32, self.height as i32);
        let centers = (0..height).flat_map(move |y| (0..width).map(move |x| Vertex::new(x, y)));
        centers.zip(self.lengths()).filter(|(_, length)| length.is_finite())
    }
}

/// A point between centers, on the map of halves.
fn in_halves(at: Point) -> Point {
    let (x, y) = at.at_corners().parts();
    Point::from_parts(x.saturating_mul(2), y.saturating_mul(2))
}

/// The other way round. The points of a path are whole there, or sources, so that no half part is lost.
fn in_cells(at: Point) -> Point {
    let (x, y) = at.parts();
    Point::from_parts(x / 2, y / 2).at_centers()
}
