//! The maps of the ROS `map_server`: a YAML file and a picture.

pub(crate) mod error;
mod flat;
mod flow;
mod occupancy;
mod settings;
mod yaml;

#[cfg(feature = "save")]
use std::io::Write;
use std::path::{Path, PathBuf};

use mediant_grid::{Grid, Interrupt};

pub use error::RosError;
pub use settings::{RosMode, RosSettings};

use crate::{
    Raster, WorldFrame,
    read::{ReadError, read_regular},
};
#[cfg(feature = "save")]
use crate::{
    RasterFormat,
    save::{NewFile, WriteError},
};

/// A ROS map: settings, and the picture of the ground. Row 0 of the picture is row 0 of the grid;
/// [`frame`](Self::frame) says where the cells are in the world, where y runs up.
///
/// The mode and the thresholds make an occupancy of each pixel, from 0 (free) to 100 (occupied), or unknown:
/// as the `map_server` of nav2 does it today, or as that of ROS 1 did. [`RosVersion`](crate::RosVersion) says
/// how they differ. In raw mode `negate` counts for nothing.
///
/// ```
/// use mediant_formats::{MapOptions, Raster, RosMap, RosSettings, RosVersion};
/// let picture = Raster::parse(b"P2 3 1 255  254 205 0")?;
/// let map = RosMap::new(RosSettings::new("depot.pgm", 0.05, [-1.0, -1.0, 0.0]), picture)?;
/// assert_eq!([0, 1, 2].map(|x| map.occupancy(x, 0, RosVersion::Ros2)), [Some(0), None, Some(100)]);
/// let grid = map.to_grid(&MapOptions::default());
/// assert!(grid.is_free(0, 0) && grid.is_blocked(1, 0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct RosMap {
    settings: RosSettings,
    raster: Raster,
    frame: WorldFrame,
}

/// The shade that savers write for free pixels, in 255 shades; occupied ones are black.
const FREE: u32 = 254;

impl RosMap {
    /// The map of these settings and this picture.
    ///
    /// # Errors
    /// [`RosError`] for a resolution that is not positive, an origin that is not finite, or a threshold for
    /// free cells that is not below that for occupied ones.
    pub fn new(settings: RosSettings, raster: Raster) -> Result<Self, RosError> {
        settings.check_thresholds(|| "settings".to_owned())?;
        let frame = WorldFrame::new(settings.resolution, settings.origin, raster.width(), raster.height())?;
        Ok(Self { settings, raster, frame })
    }

    /// The map of a grid, as savers write it: trinary, free cells of shade 254 of 255, blocked ones black.
    /// `image` is the name that the picture is to have, beside the YAML file; the resolution is in meters a
    /// cell, the origin is that of [`WorldFrame`].
    ///
    /// # Errors
    /// As those of [`new`](Self::new), and [`RosError::Raster`] for a grid that is too large for a picture.
    pub fn from_grid(
        grid: &Grid,
        image: impl Into<String>,
        resolution: f64,
        origin: [f64; 3],
    ) -> Result<Self, RosError> {
        let shade = |x: u32, y: u32| if grid.is_free(x as i32, y as i32) { FREE } else { 0 };
        let raster = Raster::from_fn(grid.width(), grid.height(), 0xff, shade)?;
        Self::new(RosSettings::new(image, resolution, origin), raster)
    }

    /// Reads a YAML file and the picture that it names. A picture with a relative path is looked for beside
    /// the YAML file.
    ///
    /// # Errors
    /// [`ReadError`] for a YAML file or a picture that is missing, cannot be read, or is wrong.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, ReadError> {
        let path = path.as_ref();
        Self::from_yaml(path, &read_regular(path)?, read_regular, &Interrupt::NEVER)
    }

    /// The map whose YAML file has this path and this content; `read` gives the bytes of its picture.
    pub(crate) fn from_yaml(
        path: &Path,
        yaml: &[u8],
        read: impl FnMut(&Path) -> Result<Vec<u8>, ReadError>,
        interrupt: &Interrupt,
    ) -> Result<Self, ReadError> {
        let (settings, image, bytes) = Self::files(path, yaml, read)?;
        let raster = Raster::parse_interruptible(&bytes, interrupt)
            .map_err(|error| ReadError::of_raster(&image, error).of_image(path))?;
        Self::new(settings, raster).map_err(|source| ReadError::Ros { path: path.to_owned(), source })
    }

    /// The settings of a YAML file, and the path and the bytes of its picture.
    pub(crate) fn files(
        path: &Path,
        yaml: &[u8],
        mut read: impl FnMut(&Path) -> Result<Vec<u8>, ReadError>,
    ) -> Result<(RosSettings, PathBuf, Vec<u8>), ReadError> {
        let settings =
            RosSettings::parse(yaml).map_err(|source| ReadError::Ros { path: path.to_owned(), source })?;
        let image = beside(path, &settings.image);
        let bytes = read(&image).map_err(|error| error.of_image(path))?;
        Ok((settings, image, bytes))
    }

    /// Writes the YAML file, and the picture where the settings say: as PNG if its name ends in `.png` (and
    /// the feature `png` is on), else as PGM. Older files are replaced when both are written.
    ///
    /// Needs the feature `save`.
    ///
    /// # Errors
    /// [`WriteError`] for files that cannot be written; those that were there stay. A name that ends in
    /// `.png` without that feature, or in `.pbm`, which has no gray, is an error before anything is
    /// written; so is the name of the YAML file.
    #[cfg(feature = "save")]
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), WriteError> {
        let path = path.as_ref();
        let image = beside(path, &self.settings.image);
        let ends_in = |end: &str| image.extension().is_some_and(|found| found.eq_ignore_ascii_case(end));
        let format = RasterFormat::of_path(&image);
        let unfit = image == path || ends_in("pbm") || ends_in("png") && format.is_none();
        if unfit {
            return Err(WriteError::ImageName { path: image });
        }
        let (mut picture, mut yaml) = (NewFile::create(&image)?, NewFile::create(path)?);
        let unwritable = |path: &Path| {
            let path = path.to_owned();
            move |source| WriteError::Unwritable { path, source }
        };
        let format = format.unwrap_or(RasterFormat::Pgm);
        self.raster.write(format, &mut picture).map_err(unwritable(&image))?;
        yaml.write_all(self.settings.to_yaml().as_bytes()).map_err(unwritable(path))?;
        picture.replace()?;
        yaml.replace()
    }

    /// The settings in the YAML file.
    #[must_use]
    pub const fn settings(&self) -> &RosSettings {
        &self.settings
    }

    /// The picture.
    #[must_use]
    pub const fn raster(&self) -> &Raster {
        &self.raster
    }

    /// Where the cells are in the world.
    #[must_use]
    pub const fn frame(&self) -> WorldFrame {
        self.frame
    }
}

/// The path of a picture that a YAML file names.
fn beside(yaml: &Path, image: &str) -> PathBuf {
    yaml.parent().unwrap_or(Path::new("")).join(image)
}
