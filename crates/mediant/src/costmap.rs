//! Robots' costmaps: costs around obstacles, and maps of ROS whose shades are costs.

use std::{fmt, path::Path as FilePath, sync::Arc};

use mediant_costs::{CostSurface, Costmap as Bytes, Inflation, Traversal};
use mediant_formats::{MapFormat, MapOptions, RosMap, Unknown, WorldFrame, read_map};
use mediant_grid::{Grid, Interrupt, Vertex};
use mediant_search::Limits;

use crate::{costs::Costs, error::Error, map::Map, never::NEVER, within::Within};

/// A robot's costmap: a byte a cell, as `nav2_costmap_2d` has it. It comes from a map with
/// [inflation](Map::inflated), from the file of a [ROS map](Self::open), or from bytes; and it becomes
/// [`Costs`], on which paths are sought.
///
/// | byte | cell |
/// |---|---|
/// | 0 | free |
/// | 1 … 252 | free, the nearer to an obstacle the more |
/// | 253 | so near that a robot whose center is here touches an obstacle: *inscribed* |
/// | 254 | an obstacle: *lethal* |
/// | 255 | unknown |
///
/// ```
/// use mediant::{Inflation, Map, Motion};
///
/// // A wall with a narrow door on the straight way, and a wide gate below.
/// let map = Map::from_fn(40, 30, |x, y| x == 20 && !(4..7).contains(&y) && y < 16)?;
/// // In meters: cells of 5 cm, a robot of radius 5 cm.
/// let inflation = Inflation {
///     resolution: 0.05,
///     inscribed_radius: 0.05,
///     inflation_radius: 0.4,
///     cost_scaling_factor: 3.0,
///     ..Inflation::default()
/// };
/// let space = map.inflated(&inflation)?.costs(3.0)?.space(Motion::centers(4))?;
/// let path = space.path((5, 5), (35, 5))?.expect("there is a way");
/// assert!(path.vertices().any(|at| at.y > 16), "it takes the gate");
/// # Ok::<(), mediant::Error>(())
/// ```
#[derive(Clone, PartialEq, Eq)]
pub struct Costmap(Bytes);

impl Map {
    /// The costmap of this map, with costs around its blocked cells by nav2's rules and numbers. The outside
    /// of the map is no obstacle.
    ///
    /// Lengths have the unit in which [`Inflation::resolution`] is the side of a cell: meters for a ROS map,
    /// whose side is [`WorldFrame::resolution`]; with 1 they are cells. The work follows the cells, whatever
    /// the radius.
    ///
    /// # Errors
    /// [`Error::Costs`] for a resolution that is no positive number, a radius or factor that is negative or
    /// not finite, and an inflation radius that is less than the inscribed one.
    pub fn inflated(&self, inflation: &Inflation) -> Result<Costmap, Error> {
        Costmap::from(self).inflated(inflation)
    }
}

impl Costmap {
    /// The byte of a free cell that is far from obstacles.
    pub const FREE: u8 = Bytes::FREE;
    /// The greatest byte of a free cell.
    pub const DEAREST: u8 = Bytes::DEAREST;
    /// The byte of a cell on which a robot's center cannot be.
    pub const INSCRIBED: u8 = Bytes::INSCRIBED;
    /// The byte of an obstacle.
    pub const LETHAL: u8 = Bytes::LETHAL;
    /// The byte of an unknown cell.
    pub const UNKNOWN: u8 = Bytes::UNKNOWN;
    /// The weight of [`costs`](Self::costs) with which they add up as in nav2's NavFn.
    pub const NAVFN: f64 = Bytes::NAVFN;

    /// The costmap with these bytes, row by row from the top. The messages of ROS begin with the bottom row:
    /// [`flipped`](Self::flipped) turns the one into the other.
    ///
    /// # Errors
    /// [`Error::Costs`] for sides that no map has, or another number of bytes than cells.
    pub fn from_bytes(width: u32, height: u32, bytes: impl Into<Box<[u8]>>) -> Result<Self, Error> {
        Ok(Self(Bytes::from_bytes(width, height, bytes)?))
    }

    /// The costmap with these occupancies, 0 (free) to 100 (occupied) or unknown, row by row from the top, as
    /// nav2's static layer makes it: 100 is lethal, 99 inscribed, and below that the cost is 2.54 times the
    /// occupancy. In the data of a message `OccupancyGrid` −1 is unknown, and rows begin
    /// [at the bottom](Self::flipped).
    ///
    /// ```
    /// use mediant::Costmap;
    ///
    /// let message: [i8; 4] = [0, -1, 50, 100];
    /// let cells = message.map(|cell| u8::try_from(cell).ok());
    /// let costmap = Costmap::from_occupancies(2, 2, cells)?.flipped();
    /// assert_eq!(costmap.bytes(), [127, 254, 0, 255]);
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// As for [`from_bytes`](Self::from_bytes).
    pub fn from_occupancies(
        width: u32,
        height: u32,
        occupancies: impl IntoIterator<Item = Option<u8>>,
    ) -> Result<Self, Error> {
        Ok(Self(Bytes::from_occupancies(width, height, occupancies)?))
    }

    /// Reads the costmap of a map file, whatever [`Map::open`] reads. A ROS map has the occupancies of its
    /// shades: in mode `scale` and `raw` all from 0 to 100, in mode `trinary` free, lethal and unknown. Cells
    /// of other maps are free or lethal.
    ///
    /// # Errors
    /// As for [`Map::open`].
    pub fn open(path: impl AsRef<FilePath>) -> Result<Self, Error> {
        Ok(Self::open_with(path, &MapOptions::default())?.0)
    }

    /// Reads a costmap as [`open`](Self::open) does, with options, and with its place in the world if it is a
    /// ROS map. Of the options `unknown` takes unknown cells of a ROS map for free ones, and `ros` says how
    /// its shades are read; the others are those of [`Map::open_with`], for other files.
    ///
    /// ```no_run
    /// use mediant::{Costmap, Inflation, Motion, files::MapOptions};
    ///
    /// let (costmap, world) = Costmap::open_with("depot.yaml", &MapOptions::default())?;
    /// let resolution = world.map_or(0.05, |world| world.resolution());
    /// let inflation = Inflation { resolution, inscribed_radius: 0.2, ..Inflation::default() };
    /// let space = costmap.inflated(&inflation)?.costs(2.0)?.space(Motion::default())?;
    /// # let _ = space;
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// As for [`Map::open`].
    pub fn open_with(
        path: impl AsRef<FilePath>,
        options: &MapOptions,
    ) -> Result<(Self, Option<WorldFrame>), Error> {
        let path = path.as_ref();
        let source = read_map(path, options)?;
        if source.format != MapFormat::Ros {
            return Ok((Self(Bytes::from_grid(&source.grid)), source.frame));
        }
        let map = RosMap::read(path)?;
        let unknown = (options.unknown == Unknown::Free).then_some(0);
        let occupancies = map.occupancies(options.ros).map(|cell| cell.or(unknown));
        let (width, height) = (map.raster().width(), map.raster().height());
        Ok((Self::from_occupancies(width, height, occupancies)?, Some(map.frame())))
    }

    /// This costmap with costs around its lethal cells: see [`Map::inflated`]. A cell that has a higher cost
    /// already keeps it.
    ///
    /// # Errors
    /// As for [`Map::inflated`].
    pub fn inflated(&self, inflation: &Inflation) -> Result<Self, Error> {
        self.inflated_unless(inflation, &NEVER)
    }

    fn inflated_unless(&self, inflation: &Inflation, interrupt: &Interrupt) -> Result<Self, Error> {
        Ok(Self(self.0.inflated(inflation, interrupt)?))
    }

    /// The costs on which a cell costs 1 + `weight` · byte / 252 a cell of length: 1 where it is free, and
    /// 1 + `weight` next to inscribed cells. Lethal, inscribed and unknown cells are blocked. So a path costs
    /// its length + `weight` · the integral of the bytes along it: with a weight of 0 it is a shortest one,
    /// and the greater the weight, the farther it goes round. 1 to 5 are usual; nav2's Smac 2D calls it
    /// `cost_travel_multiplier`, and [`NAVFN`](Self::NAVFN) is that of NavFn.
    ///
    /// # Errors
    /// [`Error::Costs`] for a weight that is negative, not finite, or so great that costs are too far apart,
    /// as in [`Map::costs`]; [`Error::Grid`] for sides that are longer than those of maps.
    pub fn costs(&self, weight: f64) -> Result<Costs, Error> {
        self.costs_with(weight, &Traversal::default())
    }

    /// [`costs`](Self::costs) where unknown or inscribed cells can be crossed, or with costs in meters.
    ///
    /// ```
    /// use mediant::{Costmap, Traversal};
    ///
    /// let costmap = Costmap::from_bytes(5, 1, [0, 126, 253, 254, 255])?;
    /// let rooms = Traversal { unknown: Some(252), ..Traversal::default() };
    /// let costs = costmap.costs_with(2.0, &rooms)?;
    /// let costs = [0, 1, 2, 3, 4].map(|x| costs.cost((x, 0)));
    /// assert_eq!(costs, [Some(1.0), Some(2.0), None, None, Some(3.0)]);
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// As for [`costs`](Self::costs).
    pub fn costs_with(&self, weight: f64, traversal: &Traversal) -> Result<Costs, Error> {
        self.costs_unless(weight, traversal, &NEVER)
    }

    fn costs_unless(&self, weight: f64, by: &Traversal, interrupt: &Interrupt) -> Result<Costs, Error> {
        Grid::check_size(self.width().into(), self.height().into())?;
        Costs::of_surface(self.0.to_costs(weight, by, interrupt)?, interrupt)
    }

    /// This costmap with its rows in the opposite order, as between messages of ROS and pictures.
    #[must_use]
    pub fn flipped(&self) -> Self {
        Self(self.0.flipped())
    }

    /// The number of columns.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.0.width()
    }

    /// The number of rows.
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.0.height()
    }

    /// The byte of a cell; `None` outside.
    #[must_use]
    pub fn get(&self, cell: impl Into<Vertex>) -> Option<u8> {
        let Vertex { x, y } = cell.into();
        self.0.get(u32::try_from(x).ok()?, u32::try_from(y).ok()?)
    }

    /// The bytes, row by row from the top.
    #[must_use]
    pub const fn bytes(&self) -> &[u8] {
        self.0.bytes()
    }

    /// This costmap, for work that stops at a deadline or by a flag.
    #[must_use]
    pub fn within(&self, limits: impl Into<Limits>) -> Within<'_, Self> {
        Within { of: self, limits: limits.into() }
    }
}

impl Within<'_, Costmap> {
    /// [`Costmap::inflated`].
    ///
    /// # Errors
    /// As for [`Costmap::inflated`], and [`Error::Stopped`].
    pub fn inflated(&self, inflation: &Inflation) -> Result<Costmap, Error> {
        self.of.inflated_unless(inflation, self.limits.interrupt())
    }

    /// [`Costmap::costs_with`].
    ///
    /// # Errors
    /// As for [`Costmap::costs_with`], and [`Error::Stopped`].
    pub fn costs_with(&self, weight: f64, traversal: &Traversal) -> Result<Costs, Error> {
        self.of.costs_unless(weight, traversal, self.limits.interrupt())
    }
}

impl Costs {
    /// The costs of a surface, and the map of its blocked cells.
    pub(crate) fn of_surface(surface: CostSurface, interrupt: &Interrupt) -> Result<Self, Error> {
        let is_blocked = |x: u32, y: u32| surface.is_blocked(x as i32, y as i32);
        let (width, height) = (surface.width(), surface.height());
        let map = Map::long((width, height), interrupt, is_blocked)?;
        Ok(Self::of_parts(map, Arc::new(surface)))
    }
}

/// Blocked cells are lethal, all others free.
impl From<&Map> for Costmap {
    fn from(map: &Map) -> Self {
        Self(Bytes::from_grid(map.grid()))
    }
}

impl fmt::Debug for Costmap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (width, height) = (self.width(), self.height());
        f.debug_struct("Costmap").field("width", &width).field("height", &height).finish_non_exhaustive()
    }
}
