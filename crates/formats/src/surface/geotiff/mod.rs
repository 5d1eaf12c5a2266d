//! Reads and writes GeoTIFFs: the samples by the crate `tiff`, the place in the world here.
//!
//! The formats are those of TIFF 6.0 and of BigTIFF, the tags those of GeoTIFF 1.1 (OGC 19-008r4), and two of
//! GDAL, `GDAL_METADATA` and `GDAL_NODATA`.

mod chunks;
mod directory;
mod layout;
mod overlay;
mod place;
mod write;

pub use write::{GeoTiffOptions, TiffCompression};

use super::{Surface, SurfaceError, source::Source};
use directory::Directory;
use layout::Layout;

/// Of a damaged file, and of one that other programs read.
const ANEW: &str = "write the file anew, for example by `gdal_translate -co COMPRESS=DEFLATE`";

fn error(expected: impl Into<String>, found: impl Into<String>) -> SurfaceError {
    SurfaceError::Tiff { expected: expected.into(), found: found.into(), remedy: ANEW }
}

/// The sides that the file states.
pub(super) fn size(source: &mut Source<'_>) -> Result<(u64, u64), SurfaceError> {
    let directory = Directory::read(source)?;
    Layout::sides(&directory, source)
}

pub(super) fn read(source: &mut Source<'_>) -> Result<Surface, SurfaceError> {
    let directory = Directory::read(source)?;
    let layout = Layout::read(&directory, source)?;
    let tags = place::tags(&directory, source)?;
    let georeference = place::georeference(tags, layout.height)?;
    let no_data = place::no_data(&georeference);
    let samples = chunks::read(&directory, &layout, no_data, source)?;
    let surface = Surface::new(layout.width, layout.height, samples)?.with_no_data(no_data);
    Ok(surface.with_georeference(georeference))
}
