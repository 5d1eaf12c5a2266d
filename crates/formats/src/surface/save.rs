//! Writes rasters to files, by the ends of their names.

use std::path::Path;

use super::{Surface, SurfaceFormat};
use crate::{NewFile, WriteError};

impl Surface {
    /// Writes the raster to a file in the format that its name [ends in](SurfaceFormat::of_path), whole or
    /// not at all. A GeoTIFF is compressed by deflate.
    ///
    /// Needs the feature `save`.
    ///
    /// # Errors
    /// [`WriteError::SurfaceName`] for another end, also for `.png` and `.tif` without their features, and
    /// those of [`NewFile`] and of the format.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), WriteError> {
        let path = path.as_ref();
        let format = SurfaceFormat::of_path(path);
        let is_on = match format {
            None => false,
            Some(SurfaceFormat::Png) => cfg!(feature = "png"),
            Some(SurfaceFormat::GeoTiff) => cfg!(feature = "geotiff"),
            Some(_) => true,
        };
        let Some(format) = format.filter(|_| is_on) else {
            return Err(WriteError::SurfaceName { path: path.to_owned() });
        };
        NewFile::write_with(path, |file| match format {
            SurfaceFormat::Npy => self.to_npy(file),
            SurfaceFormat::EsriAscii => self.to_esri_ascii(file),
            SurfaceFormat::Pgm => self.to_pgm(file),
            #[cfg(feature = "png")]
            SurfaceFormat::Png => self.to_png(file),
            #[cfg(feature = "geotiff")]
            SurfaceFormat::GeoTiff => self.to_geotiff(file, &super::GeoTiffOptions::default()),
            #[cfg(not(all(feature = "png", feature = "geotiff")))]
            _ => unreachable!("the features were looked at"),
        })
    }
}
