//! Rasters of numbers: NPY, ESRI ASCII grids, PGM, PNG and GeoTIFF.

mod error;
mod esri;
mod georeference;
#[cfg(feature = "geotiff")]
mod geotiff;
mod gray;
mod meters;
mod npy;
mod npy_header;
mod number;
mod options;
mod prj;
mod read;
mod samples;
#[cfg(feature = "save")]
mod save;
mod source;

pub use error::SurfaceError;
pub use georeference::Georeference;
#[cfg(feature = "geotiff")]
pub use geotiff::{GeoTiffOptions, TiffCompression};
pub use options::{SurfaceFormat, SurfaceOptions};
pub use read::{read_surface, read_surface_interruptible, surface_size};
pub use samples::Samples;

/// The stage that an interruption names.
const READING: &str = "reading the raster";

/// A raster of numbers, as costs and heights are: for each cell a number, in the type of its file, or none.
/// Row 0 is the top one.
///
/// A cell has no number where the file says so ('no data'), or where it is NaN.
///
/// ```
/// use mediant_formats::{Surface, SurfaceOptions};
/// let text = b"ncols 3\nnrows 2\nNODATA_value -1\n1 2 3\n4 -1 6\n";
/// let surface = Surface::parse(text, &SurfaceOptions::default())?;
/// assert_eq!((surface.get(2, 0), surface.get(1, 1)), (Some(3.0), None));
/// # Ok::<(), mediant_formats::SurfaceError>(())
/// ```
///
/// Needs the feature `surface`.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    width: u32,
    height: u32,
    /// width · height of them.
    samples: Samples,
    no_data: Option<f64>,
    /// `no_data` in the type of the samples: −3.4028235e38 in a text is the least float of 32 bits.
    marker: Option<f64>,
    georeference: Georeference,
}

impl Surface {
    /// The longest side: 2²⁰.
    pub const MAX_SIDE: u32 = 1 << 20;

    /// The most cells: 2³² − 2²⁴.
    pub const MAX_CELLS: u64 = (1 << 32) - (1 << 24);

    /// Checks that a raster may have these sides; nothing is allocated.
    ///
    /// # Errors
    /// [`SurfaceError::Size`] if not.
    pub fn check_size(width: u64, height: u64) -> Result<(u32, u32), SurfaceError> {
        let sides = 1..=u64::from(Self::MAX_SIDE);
        if !sides.contains(&width) || !sides.contains(&height) || width * height > Self::MAX_CELLS {
            return Err(SurfaceError::Size { width, height });
        }
        // No loss: both are at most MAX_SIDE.
        Ok((width as u32, height as u32))
    }

    /// A raster of numbers row by row from the top: a vector of any type of [`Samples`].
    ///
    /// # Errors
    /// [`SurfaceError::Size`] for sides that no raster has, and [`SurfaceError::Samples`] if there is not one
    /// number a cell.
    pub fn new(width: u32, height: u32, samples: impl Into<Samples>) -> Result<Self, SurfaceError> {
        Self::check_size(width.into(), height.into())?;
        let samples = samples.into();
        let (expected, found) = (u64::from(width) * u64::from(height), samples.len() as u64);
        if expected != found {
            return Err(SurfaceError::Samples { expected, found });
        }
        let georeference = Georeference::default();
        Ok(Self { width, height, samples, no_data: None, marker: None, georeference })
    }

    /// The same raster, in which this number stands for 'no data'. NaN always does.
    #[must_use]
    pub fn with_no_data(mut self, no_data: Option<f64>) -> Self {
        self.no_data = no_data.filter(|number| !number.is_nan());
        self.marker = match self.samples {
            Samples::F32(_) => {
                self.no_data.map(|number| f64::from(number as f32)).filter(|number| number.is_finite())
            }
            _ => self.no_data,
        };
        self
    }

    /// The same raster in another place of the world.
    #[must_use]
    pub fn with_georeference(mut self, georeference: Georeference) -> Self {
        self.georeference = georeference;
        self
    }

    /// The number of columns, 1 to [`MAX_SIDE`](Self::MAX_SIDE).
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// The number of rows, 1 to [`MAX_SIDE`](Self::MAX_SIDE).
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.height
    }

    /// All numbers, also those that stand for 'no data'.
    #[must_use]
    pub const fn samples(&self) -> &Samples {
        &self.samples
    }

    /// The numbers alone.
    #[must_use]
    pub fn into_samples(self) -> Samples {
        self.samples
    }

    /// The number that stands for 'no data'.
    #[must_use]
    pub const fn no_data(&self) -> Option<f64> {
        self.no_data
    }

    /// The width and the height of a cell, both positive; `None` if the file says nothing of it.
    #[must_use]
    pub const fn cell_size(&self) -> Option<(f64, f64)> {
        self.georeference.cell_size()
    }

    /// The place of the raster in the world.
    #[must_use]
    pub const fn georeference(&self) -> &Georeference {
        &self.georeference
    }

    /// Whether the coordinates are longitudes and latitudes: see [`Georeference::is_in_degrees`].
    #[must_use]
    pub fn is_in_degrees(&self) -> bool {
        self.georeference.is_in_degrees()
    }

    /// The number of a cell; `None` where it has none, and outside.
    #[must_use]
    #[inline]
    pub fn get(&self, x: u32, y: u32) -> Option<f64> {
        if x >= self.width || y >= self.height {
            return None;
        }
        self.number(y as usize * self.width as usize + x as usize)
    }

    /// The numbers of all cells, row by row from the top; `None` for each that has none.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Option<f64>> + '_ {
        (0..self.samples.len()).map(|at| self.number(at))
    }

    #[inline]
    fn number(&self, at: usize) -> Option<f64> {
        self.samples.get(at).filter(|number| !number.is_nan() && self.marker != Some(*number))
    }
}
