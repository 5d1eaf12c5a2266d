//! Robots' costmaps: a byte a cell, in the words and numbers of nav2.

mod inflation;
mod traversal;

use std::fmt;

use mediant_grid::Grid;

pub use inflation::Inflation;
pub use traversal::Traversal;

use crate::{error::CostsError, layout::Layout};

/// A robot's costmap: a byte a cell, as `nav2_costmap_2d` has it.
///
/// | byte | cell |
/// |---|---|
/// | 0 | free |
/// | 1 … 252 | free, the nearer to an obstacle the more |
/// | 253 | so near that a robot whose center is here touches an obstacle: *inscribed* |
/// | 254 | an obstacle: *lethal* |
/// | 255 | unknown |
///
/// Row 0 is the top one, as in pictures. The messages of ROS (`OccupancyGrid`, `Costmap`) begin with the
/// bottom row: [`flipped`](Self::flipped) turns the one into the other.
///
/// [`inflated`](Self::inflated) puts costs around obstacles, and [`to_costs`](Self::to_costs) makes the
/// surface on which paths are sought.
///
/// ```
/// use mediant_costs::{Costmap, Inflation};
/// use mediant_grid::{Grid, Interrupt};
///
/// // A wall at the left; the robot's inscribed radius is that of one cell.
/// let grid = Grid::from_fn(6, 1, |x, _| x == 0)?;
/// let radii = Inflation {
///     resolution: 0.05,
///     inscribed_radius: 0.05,
///     inflation_radius: 0.2,
///     cost_scaling_factor: 10.0,
///     ..Inflation::default()
/// };
/// let costmap = Costmap::from_grid(&grid).inflated(&radii, &Interrupt::NEVER)?;
/// // 252 · exp(−10 · 0.05) = 152.8
/// assert_eq!(costmap.bytes(), [254, 253, 152, 92, 56, 0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, PartialEq, Eq)]
pub struct Costmap {
    width: u32,
    height: u32,
    /// Row by row.
    bytes: Box<[u8]>,
}

impl Costmap {
    /// The byte of a free cell that is far from obstacles.
    pub const FREE: u8 = 0;
    /// The greatest byte of a free cell.
    pub const DEAREST: u8 = 252;
    /// The byte of a cell on which a robot's center cannot be.
    pub const INSCRIBED: u8 = 253;
    /// The byte of an obstacle.
    pub const LETHAL: u8 = 254;
    /// The byte of an unknown cell.
    pub const UNKNOWN: u8 = 255;

    /// The costmap with these bytes, row by row from the top.
    ///
    /// # Errors
    /// [`CostsError::Size`], [`CostsError::Count`].
    pub fn from_bytes(width: u32, height: u32, bytes: impl Into<Box<[u8]>>) -> Result<Self, CostsError> {
        let (bytes, expected) = (bytes.into(), cells(width, height)?);
        if bytes.len() as u64 != expected {
            return Err(CostsError::Count { found: bytes.len(), expected });
        }
        Ok(Self { width, height, bytes })
    }

    /// The costmap with these occupancies, 0 (free) to 100 (occupied) or unknown, row by row from the top: as
    /// the static layer of nav2 makes it where its `trinary_costmap` is off. 100 and more are lethal, 99 is
    /// inscribed, and below that the cost is 2.54 times the occupancy, rounded down.
    ///
    /// They are those of a map that the `map_server` reads in `scale` or `raw` mode, or the data of a message
    /// `OccupancyGrid`, in which −1 is unknown:
    ///
    /// ```
    /// use mediant_costs::Costmap;
    /// use mediant_formats::{Raster, RosMap, RosMode, RosSettings, RosVersion};
    ///
    /// let picture = Raster::parse(b"P2 4 1 255  255 128 0 99")?;
    /// let mut settings = RosSettings::new("depot.pgm", 0.05, [0.0; 3]);
    /// settings.mode = RosMode::Scale;
    /// let map = RosMap::new(settings, picture)?;
    /// let costmap = Costmap::from_occupancies(4, 1, map.occupancies(RosVersion::Ros2))?;
    /// assert_eq!(costmap.bytes(), [0, 170, 254, 233]);
    ///
    /// let message: [i8; 4] = [0, -1, 99, 100];
    /// let costmap = Costmap::from_occupancies(2, 2, message.map(|cell| u8::try_from(cell).ok()))?.flipped();
    /// assert_eq!(costmap.bytes(), [253, 254, 0, 255]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As for [`from_bytes`](Self::from_bytes).
    pub fn from_occupancies(
        width: u32,
        height: u32,
        occupancies: impl IntoIterator<Item = Option<u8>>,
    ) -> Result<Self, CostsError> {
        // More than there are cells are an error, however many.
        let most = cells(width, height)?.saturating_add(1) as usize;
        let bytes: Vec<u8> = occupancies.into_iter().take(most).map(of_occupancy).collect();
        Self::from_bytes(width, height, bytes)
    }

    /// The costmap of a map: lethal where it is blocked, else free.
    #[must_use]
    pub fn from_grid(grid: &Grid) -> Self {
        let (width, height) = (grid.width(), grid.height());
        let mut bytes = Vec::with_capacity(width as usize * height as usize);
        for y in 0..height as i32 {
            let row = grid.rows().row(y);
            let byte = |x| if row.is_blocked(x) { Self::LETHAL } else { Self::FREE };
            bytes.extend((0..width as i32).map(byte));
        }
        Self { width, height, bytes: bytes.into() }
    }

    /// This costmap with its rows in the opposite order.
    #[must_use]
    pub fn flipped(&self) -> Self {
        let rows = self.bytes.chunks_exact(self.width as usize).rev();
        let mut bytes = Vec::with_capacity(self.bytes.len());
        rows.for_each(|row| bytes.extend_from_slice(row));
        Self { bytes: bytes.into(), ..*self }
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

    /// The byte of a cell; `None` outside.
    #[must_use]
    pub fn get(&self, x: u32, y: u32) -> Option<u8> {
        let on_map = x < self.width && y < self.height;
        on_map.then(|| self.bytes[self.index(x, y)])
    }

    /// The bytes, row by row from the top.
    #[must_use]
    pub const fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// The bytes, row by row from the top.
    #[must_use]
    pub fn into_bytes(self) -> Box<[u8]> {
        self.bytes
    }

    const fn index(&self, x: u32, y: u32) -> usize {
        y as usize * self.width as usize + x as usize
    }
}

/// The number of cells of a costmap, whose sides are those of a cost surface.
fn cells(width: u32, height: u32) -> Result<u64, CostsError> {
    let (width, height) = (u64::from(width), u64::from(height));
    Layout::new(width, height).map(|_| width * height).ok_or(CostsError::Size { width, height })
}

fn of_occupancy(occupancy: Option<u8>) -> u8 {
    match occupancy {
        None => Costmap::UNKNOWN,
        Some(99) => Costmap::INSCRIBED,
        Some(occupancy) if occupancy < 99 => (u32::from(occupancy) * u32::from(Costmap::LETHAL) / 100) as u8,
        Some(_) => Costmap::LETHAL,
    }
}

impl fmt::Debug for Costmap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Costmap")
            .field("width", &self.width)
            .field("height", &self.height)
            .finish_non_exhaustive()
    }
}
