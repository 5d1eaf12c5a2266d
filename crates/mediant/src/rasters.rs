//! Costs of cells from rasters of numbers: NPY, ESRI ASCII grids, PGM, PNG and GeoTIFF.

use std::path::Path as FilePath;

use mediant_costs::CostsError;
use mediant_formats::{
    Georeference, Surface, SurfaceOptions, read_surface, read_surface_interruptible, surface_size,
};
use mediant_grid::Interrupt;
use mediant_search::Limits;

use crate::{costs::Costs, error::Error, map::Map, never::NEVER, within::Within};

impl Costs {
    /// Reads a raster whose numbers are the costs of cells: NPY, an ESRI ASCII grid, PGM or PNG of gray, or
    /// with the feature `geotiff` a GeoTIFF, told by its content. Cells without data are blocked. The cells
    /// have the size that the file states, else 1 × 1: a cost is one a unit of length of that size.
    ///
    /// [`Map::costs_of`] joins the costs of a raster with the walls of a map, and
    /// [`Costmap::open`](crate::Costmap::open) reads maps of robots.
    ///
    /// ```no_run
    /// use mediant::{Costs, K, Motion};
    ///
    /// let space = Costs::open("friction.tif")?.space(Motion::centers(K::N16))?;
    /// let distance = space.field([(100, 200)])?.lengths();
    /// # let _ = distance;
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Read`] for a file that is missing, cannot be read, or is no such raster. [`Error::InFile`]
    /// with the errors of [`Map::costs_of`] inside, and with those of [`Costs::check_size`], which the header
    /// of the file is checked by.
    pub fn open(path: impl AsRef<FilePath>) -> Result<Self, Error> {
        Ok(Self::open_with(path, &SurfaceOptions::default())?.0)
    }

    /// Reads costs as [`open`](Self::open) does, with options, and with the place of the raster in the world,
    /// for a raster of results: [`Surface::with_georeference`].
    ///
    /// # Errors
    /// As for [`open`](Self::open).
    pub fn open_with(
        path: impl AsRef<FilePath>,
        options: &SurfaceOptions,
    ) -> Result<(Self, Georeference), Error> {
        let path = path.as_ref();
        check_header(path)?;
        let surface = read_surface(path, options)?;
        let costs = Self::from_surface(&surface).map_err(|error| error.in_file(path))?;
        Ok((costs, surface.georeference().clone()))
    }

    /// Reads costs as [`open_with`](Self::open_with) does, unless the deadline or the flag of the limits
    /// stops it before it is done.
    ///
    /// # Errors
    /// As for [`open`](Self::open), and [`Error::Stopped`].
    pub fn open_within(
        path: impl AsRef<FilePath>,
        options: &SurfaceOptions,
        limits: impl Into<Limits>,
    ) -> Result<(Self, Georeference), Error> {
        let (path, limits) = (path.as_ref(), limits.into());
        check_header(path)?;
        let surface = read_surface_interruptible(path, options, limits.interrupt())?;
        let map = Map::with_data(&surface)?;
        let costs = map.within(limits).costs_of(&surface).map_err(|error| error.in_file(path))?;
        Ok((costs, surface.georeference().clone()))
    }

    /// The costs of a raster; cells without data are blocked.
    ///
    /// # Errors
    /// As for [`Map::costs_of`].
    pub fn from_surface(surface: &Surface) -> Result<Self, Error> {
        Map::with_data(surface)?.costs_of(surface)
    }
}

impl Map {
    /// The map of a raster: cells without data are blocked. Where a side is longer than
    /// [`Grid::MAX_SIDE`](mediant_grid::Grid::MAX_SIDE), it is for [costs](Self::costs_of) alone.
    ///
    /// # Errors
    /// [`Error::Grid`] and [`Error::NoRoom`] for more cells than [costs](Costs::from_fn) can have.
    pub fn with_data(surface: &Surface) -> Result<Self, Error> {
        Costs::check_size(surface.width(), surface.height())?;
        let mut has_data = surface.iter().map(|number| number.is_some());
        let is_blocked = |_, _| !has_data.next().unwrap_or(false);
        Self::long((surface.width(), surface.height()), &NEVER, is_blocked)
    }

    /// This map with the costs of a raster of the same size. Cells are blocked that are blocked here or have
    /// no data there. They have the size that the raster states, else 1 × 1.
    ///
    /// ```
    /// use mediant::{Map, files::Surface};
    ///
    /// let map = Map::from_rows(["..#", "..."])?;
    /// let raster = Surface::new(3, 2, vec![4_u8, 4, 4, 0, 1, 1]).map_err(|error| error.to_string())?;
    /// let costs = map.costs_of(&raster.with_no_data(Some(0.0)))?;
    /// assert_eq!([costs.cost((0, 0)), costs.cost((2, 0)), costs.cost((0, 1))], [Some(4.0), None, None]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OtherSize`] for a raster of another size; [`Error::Degrees`] for one in longitudes and
    /// latitudes, where a cell is narrower the nearer it is to a pole; [`Error::Costs`] as for
    /// [`Map::costs`].
    pub fn costs_of(&self, surface: &Surface) -> Result<Costs, Error> {
        costs_unless(self, surface, &NEVER)
    }

    /// This map, where cells without data in a raster of the same size are blocked, too, and the size of a
    /// cell.
    pub(crate) fn on_surface(&self, surface: &Surface) -> Result<(Self, Option<(f64, f64)>), Error> {
        let (found, expected) = ((surface.width(), surface.height()), (self.width(), self.height()));
        if found != expected {
            return Err(Error::OtherSize { found, expected });
        }
        if surface.is_in_degrees() {
            return Err(Error::Degrees);
        }
        let mut has_data = surface.iter().map(|number| number.is_some());
        let is_blocked = |x: u32, y: u32| {
            let is_known = has_data.next().unwrap_or(false);
            !is_known || self.grid().is_blocked(x as i32, y as i32)
        };
        Ok((Self::long(found, &NEVER, is_blocked)?, surface.cell_size()))
    }
}

/// Checks that there can be the costs whose sides the header of a file states, before they are read.
fn check_header(path: &FilePath) -> Result<(), Error> {
    let (width, height) = surface_size(path)?;
    Costs::check_size(width, height).map_err(|error| error.in_file(path))
}

fn costs_unless(map: &Map, surface: &Surface, interrupt: &Interrupt) -> Result<Costs, Error> {
    let (map, cell_size) = map.on_surface(surface)?;
    let columns = surface.width() as usize;
    let cell = |(at, cost): (usize, Option<f64>)| ((at % columns) as u32, (at / columns) as u32, cost);
    // By the numbers of the file: 'no data' is no cost.
    let wrong = surface.iter().enumerate().map(cell).find(|&(x, y, cost)| {
        map.is_free((x as i32, y as i32)) && cost.is_some_and(|cost| !(cost.is_finite() && cost > 0.0))
    });
    if let Some((x, y, Some(cost))) = wrong {
        return Err(CostsError::Cost { x, y, cost }.into());
    }
    let cost = |x: u32, y: u32| surface.get(x, y).unwrap_or(f64::NAN);
    Costs::of(&map, cell_size.unwrap_or((1.0, 1.0)), interrupt, cost)
}

impl Within<'_, Map> {
    /// [`Map::costs_of`].
    ///
    /// # Errors
    /// As for [`Map::costs_of`], and [`Error::Stopped`].
    pub fn costs_of(&self, surface: &Surface) -> Result<Costs, Error> {
        costs_unless(self.of, surface, self.limits.interrupt())
    }
}

#[cfg(feature = "walking")]
mod walking {
    use std::path::Path as FilePath;

    use mediant_costs::Pace;
    use mediant_formats::{Georeference, Surface, SurfaceOptions, read_surface};
    use mediant_grid::Interrupt;

    use crate::{error::Error, map::Map, never::NEVER, walking::Walking, within::Within};

    impl Walking {
        /// Reads a raster of elevations, such as a digital elevation model: any file that
        /// [`Costs::open`](crate::Costs::open) reads. Cells without data are blocked. Elevations are in the
        /// unit of the size of a cell, which the file has to state.
        ///
        /// ```no_run
        /// use mediant::{K, Motion, Pace, Walking};
        ///
        /// let (walking, place) = Walking::open("dem.tif", &Pace::Tobler)?;
        /// let space = walking.space(Motion::centers(K::N16))?;
        /// // All that is an hour away.
        /// let reached = space.field_from_within([(100, 200)], 3600.0)?;
        /// # let _ = (reached, place);
        /// # Ok::<(), mediant::Error>(())
        /// ```
        ///
        /// # Errors
        /// [`Error::Read`] for a file that is missing, cannot be read, or is no such raster;
        /// [`Error::InFile`] with the errors of [`Map::walking_of`] inside.
        pub fn open(path: impl AsRef<FilePath>, pace: &Pace) -> Result<(Self, Georeference), Error> {
            let path = path.as_ref();
            super::check_header(path)?;
            let surface = read_surface(path, &SurfaceOptions::default())?;
            let walking = Map::with_data(&surface).and_then(|map| map.walking_of(&surface, None, pace));
            Ok((walking.map_err(|error| error.in_file(path))?, surface.georeference().clone()))
        }
    }

    impl Map {
        /// This map with the elevations of a raster of the same size, and with the frictions of another one,
        /// if there is one. Cells are blocked that are blocked here or have no data there.
        ///
        /// # Errors
        /// As for [`Map::walking_with_friction`] and [`Map::costs_of`]; [`Error::NoCellSize`] where the
        /// raster of elevations does not state the size of a cell.
        pub fn walking_of(
            &self,
            elevation: &Surface,
            friction: Option<&Surface>,
            pace: &Pace,
        ) -> Result<Walking, Error> {
            walking_unless(self, elevation, friction, pace, &NEVER)
        }
    }

    fn walking_unless(
        map: &Map,
        elevation: &Surface,
        friction: Option<&Surface>,
        pace: &Pace,
        interrupt: &Interrupt,
    ) -> Result<Walking, Error> {
        let (mut map, cell_size) = map.on_surface(elevation)?;
        let cell_size = cell_size.ok_or(Error::NoCellSize)?;
        if let Some(friction) = friction {
            map = map.on_surface(friction)?.0;
        }
        let number = |surface: &Surface, x, y| surface.get(x, y).unwrap_or(f64::NAN);
        let rough = |x: u32, y: u32| friction.map_or(0.0, |friction| number(friction, x, y));
        Walking::of(&map, (cell_size, pace), None, interrupt, |x, y| (number(elevation, x, y), rough(x, y)))
    }

    impl Within<'_, Map> {
        /// [`Map::walking_of`].
        ///
        /// # Errors
        /// As for [`Map::walking_of`], and [`Error::Stopped`].
        pub fn walking_of(
            &self,
            elevation: &Surface,
            friction: Option<&Surface>,
            pace: &Pace,
        ) -> Result<Walking, Error> {
            walking_unless(self.of, elevation, friction, pace, self.limits.interrupt())
        }
    }
}
