//! The maps of the ROS `map_server`: a YAML file and a picture.

pub(crate) mod error;
mod flat;
mod settings;

use std::{
    cmp::Ordering,
    fs, io,
    path::{Path, PathBuf},
};

use mediant_grid::Grid;

pub use error::RosError;
pub use settings::{RosMode, RosSettings};

use crate::{
    ImageOptions, Raster, RasterFormat, Unknown, WorldFrame,
    read::{ReadError, read_regular},
};

/// A ROS map: settings, and the picture of the ground. Row 0 of the picture is row 0 of the grid;
/// [`frame`](Self::frame) says where the cells are in the world, where y runs up.
///
/// A pixel is *occupied to* 1 − its shade, as a part of white, or to its shade if the map is negated; the
/// mode and the thresholds make an occupancy of that, from 0 (free) to 100 (occupied), or unknown. This
/// follows the `map_server` of nav2. In trinary mode the opacity of a picture that has it is one more channel
/// of the mean, as there; in raw mode `negate` counts for nothing.
///
/// ```
/// use mediant_formats::{ImageOptions, Raster, RosMap, RosSettings};
/// let picture = Raster::parse(b"P2 3 1 255  254 205 0")?;
/// let map = RosMap::new(RosSettings::new("depot.pgm", 0.05, [-1.0, -1.0, 0.0]), picture)?;
/// assert_eq!([0, 1, 2].map(|x| map.occupancy(x, 0)), [Some(0), None, Some(100)]);
/// let grid = map.to_grid(&ImageOptions::default());
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
        Self::from_yaml(path, &read_regular(path)?, read_regular)
    }

    /// The map whose YAML file has this path and this content; `read` gives the bytes of its picture.
    pub(crate) fn from_yaml(
        path: &Path,
        yaml: &[u8],
        read: impl FnMut(&Path) -> Result<Vec<u8>, ReadError>,
    ) -> Result<Self, ReadError> {
        let (settings, image, bytes) = Self::files(path, yaml, read)?;
        let raster = Raster::parse(&bytes)
            .map_err(|source| ReadError::Raster { path: image, source }.of_image(path))?;
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
    /// the feature `png` is on), else as PGM.
    ///
    /// # Errors
    /// Those of the file system, with the path. A name that ends in `.png` without that feature, or in
    /// `.pbm`, which has no gray, is an error before anything is written; so is the name of the YAML file.
    pub fn save(&self, path: impl AsRef<Path>) -> io::Result<()> {
        let path = path.as_ref();
        let image = beside(path, &self.settings.image);
        let ends_in = |end: &str| image.extension().is_some_and(|found| found.eq_ignore_ascii_case(end));
        let format = RasterFormat::of_path(&image);
        let unfit = image == path || ends_in("pbm") || ends_in("png") && format.is_none();
        if unfit {
            let message =
                format!("{}: no name for the picture of a ROS map; end it in .pgm", image.display());
            return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
        }
        let named = |path: &Path| {
            let path = path.display().to_string();
            move |error: io::Error| {
                io::Error::new(error.kind(), format!("{path}: cannot be written: {error}"))
            }
        };
        let mut picture = Vec::new();
        self.raster.write(format.unwrap_or(RasterFormat::Pgm), &mut picture)?;
        fs::write(&image, picture).map_err(named(&image))?;
        fs::write(path, self.settings.to_yaml()).map_err(named(path))
    }

    /// The grid: cells that are more occupied than `options.threshold` allows are blocked, unknown ones as
    /// `options.unknown` says. See [`ImageOptions`].
    #[must_use]
    pub fn to_grid(&self, options: &ImageOptions) -> Grid {
        let unknown = options.unknown == Unknown::Blocked;
        let (numerator, denominator) = options.threshold.parts();
        // p / 100 > 1 − threshold, in whole numbers.
        let limit = 100 * u64::from(denominator - numerator);
        let blocked = |occupancy: Option<u8>| {
            occupancy.map_or(unknown, |p| u64::from(p) * u64::from(denominator) > limit)
        };
        match self.raster.opaque() {
            Some(opaque) if self.settings.mode == RosMode::Trinary => {
                self.raster.grid_where(|shade, opacity| blocked(self.trinary_of_four(shade, opacity, opaque)))
            }
            opaque => {
                // Shades are few, and pixels many.
                let table: Vec<bool> =
                    (0..=self.raster.white()).map(|shade| blocked(self.of_shade(shade))).collect();
                let hidden = opaque.filter(|_| self.settings.mode == RosMode::Scale);
                self.raster.grid_where(|shade, opacity| match hidden {
                    Some(opaque) if opacity < opaque => unknown,
                    _ => table.get(shade as usize).copied().unwrap_or(unknown),
                })
            }
        }
    }

    /// The occupancy of cell (x, y), 0 to 100; `None` if it is unknown, and outside the map.
    #[must_use]
    pub fn occupancy(&self, x: u32, y: u32) -> Option<u8> {
        let shade = self.raster.shade(x, y)?;
        let opacity = self.raster.opaque().zip(self.raster.opacity(x, y));
        match (self.settings.mode, opacity) {
            (RosMode::Trinary, Some((opaque, opacity))) => self.trinary_of_four(shade, opacity, opaque),
            (RosMode::Scale, Some((opaque, opacity))) if opacity < opaque => None,
            _ => self.of_shade(shade),
        }
    }

    /// The occupancy of an opaque pixel.
    fn of_shade(&self, shade: u32) -> Option<u8> {
        let (shade, white) = (u64::from(shade), u64::from(self.raster.white()));
        match self.settings.mode {
            RosMode::Trinary => match self.threshold(shade, white) {
                Ordering::Less => Some(0),
                Ordering::Equal => None,
                Ordering::Greater => Some(100),
            },
            RosMode::Scale => Some(self.scale(shade, white)),
            RosMode::Raw => {
                // The nearest of 255 shades, half up.
                let sample = (2 * 255 * shade + white) / (2 * white);
                u8::try_from(sample).ok().filter(|&sample| sample <= 100)
            }
        }
    }

    /// The trinary occupancy of a pixel whose opacity is the fourth channel of the mean.
    fn trinary_of_four(&self, shade: u32, opacity: u32, opaque: u32) -> Option<u8> {
        let [shade, opacity, opaque, white] = [shade, opacity, opaque, self.raster.white()].map(u64::from);
        match self.threshold(3 * shade * opaque + opacity * white, 4 * white * opaque) {
            Ordering::Less => Some(0),
            Ordering::Equal => None,
            Ordering::Greater => Some(100),
        }
    }

    /// Whether a pixel is free, between the thresholds, or occupied.
    fn threshold(&self, shade: u64, white: u64) -> Ordering {
        let occupied = if self.settings.negate { shade } else { white - shade };
        if self.settings.occupied_thresh.compare(occupied, white) == Ordering::Greater {
            Ordering::Greater
        } else if self.settings.free_thresh.compare(occupied, white) == Ordering::Less {
            Ordering::Less
        } else {
            Ordering::Equal
        }
    }

    /// 0 to 100, by proportion between the thresholds, rounded to the nearest, half to even.
    fn scale(&self, shade: u64, white: u64) -> u8 {
        match self.threshold(shade, white) {
            Ordering::Less => return 0,
            Ordering::Greater => return 100,
            Ordering::Equal => {}
        }
        let occupied = if self.settings.negate { shade } else { white - shade };
        let wide = |(n, d): (u32, u32)| (u128::from(n), u128::from(d));
        let (free, free_by) = wide(self.settings.free_thresh.parts());
        let (full, full_by) = wide(self.settings.occupied_thresh.parts());
        let (occupied, white) = (u128::from(occupied), u128::from(white));
        // 100 · (occupied / white − free) / (full − free); below 2²⁰ · 2³² · 2³² · 2⁷. Neither difference is
        // negative, since free ≤ occupied / white, and the latter is not 0.
        let over = 100 * (occupied * free_by - free * white) * full_by;
        let under = white * (full * free_by - free * full_by);
        let (whole, rest) = (over / under, over % under);
        let up = match (2 * rest).cmp(&under) {
            Ordering::Less => false,
            Ordering::Equal => whole % 2 == 1,
            Ordering::Greater => true,
        };
        // At most 100, which occupied = full gives.
        (whole as u8).saturating_add(u8::from(up))
    }

    /// What the YAML file says.
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
