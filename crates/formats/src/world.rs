//! Where a map lies in the world.

use mediant_grid::{Grid, GridError, PlacementKind, Point, Vertex};

/// How the cells of a map lie in the world: between cells, with y down, and meters, with y up, as a ROS map
/// states it.
///
/// The origin is the pose of the *lower left corner* of the picture, which is the corner below cell
/// (0, height − 1): its x and y in meters, and the yaw by which the map is turned about it, in radians,
/// counterclockwise. Row 0 of the grid stays row 0 of the picture; only the coordinates of the world run up.
///
/// ```
/// use mediant_formats::WorldFrame;
/// use mediant_grid::{PlacementKind, Point, Vertex};
/// // 40 × 20 cells of 5 cm, whose lower left corner is at (−1, −0.5).
/// let frame = WorldFrame::new(0.05, [-1.0, -0.5, 0.0], 40, 20)?;
/// assert_eq!(frame.cell_at(-0.99, -0.49), Some(Vertex::new(0, 19)));
/// assert_eq!(frame.cell_at(1.01, 0.0), None);
/// assert_eq!(frame.vertex_at(PlacementKind::Corner, 0.01, 0.01), Some(Vertex::new(20, 10)));
/// assert_eq!(frame.point_of(PlacementKind::Corner, Vertex::new(0, 20)), (-1.0, -0.5));
/// # Ok::<(), mediant_formats::WorldError>(())
/// ```
///
/// Arithmetic is that of `f64`. Without a yaw it is the same on every platform; sine and cosine of another
/// yaw may differ in their last digit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorldFrame {
    resolution: f64,
    origin: [f64; 3],
    width: u32,
    height: u32,
}

/// Numbers that do not place a map in the world.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WorldError {
    /// The resolution is no positive number.
    #[error("expected a resolution of more than 0 meters a cell, found {found}; write for instance 0.05")]
    Resolution {
        /// The number.
        found: f64,
    },
    /// A number of the origin is infinite or none.
    #[error("expected an origin of three finite numbers, x, y and yaw, found {found:?}")]
    Origin {
        /// The numbers.
        found: [f64; 3],
    },
    /// No map has these sides.
    #[error(transparent)]
    Size(#[from] GridError),
}

impl WorldFrame {
    /// The frame of a map of `width` × `height` cells, `resolution` meters a cell, with its origin (x and y
    /// in meters, yaw in radians) at the lower left corner.
    ///
    /// # Errors
    /// [`WorldError`] for a resolution that is not positive, for numbers that are not finite, and for sides
    /// that no map has.
    pub fn new(resolution: f64, origin: [f64; 3], width: u32, height: u32) -> Result<Self, WorldError> {
        if !(resolution.is_finite() && resolution > 0.0) {
            return Err(WorldError::Resolution { found: resolution });
        }
        if !origin.iter().all(|number| number.is_finite()) {
            return Err(WorldError::Origin { found: origin });
        }
        Grid::check_size(u64::from(width), u64::from(height))?;
        Ok(Self { resolution, origin, width, height })
    }

    /// The side of a cell, in meters.
    #[must_use]
    pub const fn resolution(&self) -> f64 {
        self.resolution
    }

    /// A length in meters, in cells: for radii, limits and tolerances, which are in cells everywhere else.
    #[must_use]
    pub const fn cells(&self, meters: f64) -> f64 {
        meters / self.resolution
    }

    /// The pose of the lower left corner: x and y in meters, yaw in radians.
    #[must_use]
    pub const fn origin(&self) -> [f64; 3] {
        self.origin
    }

    /// The number of columns.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// The number of rows.
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.height
    }

    /// The cell that contains a point of the world, in meters; `None` outside the map. A cell has its left
    /// and lower edges; its others belong to its neighbors.
    #[must_use]
    pub fn cell_at(&self, x: f64, y: f64) -> Option<Vertex> {
        self.vertex_at(PlacementKind::Center, x, y)
    }

    /// The center of a cell, in meters. The cell may be outside the map.
    #[must_use]
    pub fn center_of(&self, cell: Vertex) -> (f64, f64) {
        self.point_of(PlacementKind::Center, cell)
    }

    /// The vertex that is nearest to a point of the world, in meters; `None` if it is more than half a cell
    /// away along an axis of the map, or on that limit above or on the right. On such a limit between two
    /// vertices it is the right or the upper one.
    #[must_use]
    pub fn vertex_at(&self, placement: PlacementKind, x: f64, y: f64) -> Option<Vertex> {
        let (right, up) = self.on_map(x, y);
        let (width, height) = (f64::from(self.width), f64::from(self.height));
        let (column, row, columns, rows) = match placement {
            PlacementKind::Center => (right.floor(), height - 1.0 - up.floor(), width, height),
            PlacementKind::Corner => {
                ((right + 0.5).floor(), height - (up + 0.5).floor(), width + 1.0, height + 1.0)
            }
        };
        // False for numbers that are none.
        let on_map = (0.0..columns).contains(&column) && (0.0..rows).contains(&row);
        on_map.then_some(Vertex { x: column as i32, y: row as i32 })
    }

    /// The point of the map at a point of the world, in meters: rounded to a multiple of 1/1024 of a cell, as
    /// ends of paths at any angle are. `None` outside of the map's rectangle, by more than that rounding.
    ///
    /// ```
    /// use mediant_formats::WorldFrame;
    /// use mediant_grid::{PlacementKind, Point};
    ///
    /// let frame = WorldFrame::new(0.5, [-1.0, -2.0, 0.0], 8, 6)?;
    /// let at = frame.place_at(PlacementKind::Corner, -0.7, 0.25).expect("it is on the map");
    /// assert_eq!(at, Point::from((0.6, 1.5)));
    /// let (x, y) = frame.point_of(PlacementKind::Corner, at);
    /// assert!((x + 0.7).hypot(y - 0.25) < 0.5 / 1024.0);
    /// # Ok::<(), mediant_formats::WorldError>(())
    /// ```
    #[must_use]
    pub fn place_at(&self, placement: PlacementKind, x: f64, y: f64) -> Option<Point> {
        let (right, up) = self.on_map(x, y);
        let at = Point::nearest(right, f64::from(self.height) - up)?;
        let on_side = |parts: i64, cells: u32| (0..=i64::from(cells) * Point::PARTS).contains(&parts);
        let (column, row) = at.parts();
        let is_on_map = on_side(column, self.width) && on_side(row, self.height);
        is_on_map.then(|| match placement {
            PlacementKind::Center => at.at_centers(),
            PlacementKind::Corner => at,
        })
    }

    /// A point of the world in cells of the map: to the right of its lower left corner, and above it.
    fn on_map(&self, x: f64, y: f64) -> (f64, f64) {
        let (sin, cos) = self.turn();
        let (x, y) = (x - self.origin[0], y - self.origin[1]);
        ((x * cos + y * sin) / self.resolution, (y * cos - x * sin) / self.resolution)
    }

    /// Where a vertex, or a point of the map, is in the world, in meters. It may be outside the map.
    #[must_use]
    pub fn point_of(&self, placement: PlacementKind, at: impl Into<Point>) -> (f64, f64) {
        let at = at.into();
        let middle = match placement {
            PlacementKind::Center => 0.5,
            PlacementKind::Corner => 0.0,
        };
        let right = (at.x() + middle) * self.resolution;
        let up = (f64::from(self.height) - at.y() - middle) * self.resolution;
        let (sin, cos) = self.turn();
        (self.origin[0] + right * cos - up * sin, self.origin[1] + right * sin + up * cos)
    }

    /// Sine and cosine of the yaw.
    fn turn(&self) -> (f64, f64) {
        self.origin[2].sin_cos()
    }
}
