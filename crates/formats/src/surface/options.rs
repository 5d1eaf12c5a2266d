//! The kinds of files that rasters are in, and options for reading them.

use std::path::Path;

use crate::{raster::PNG_SIGNATURE, text::Lines, text::words};

/// Options for reading a raster.
///
/// ```
/// use mediant_formats::SurfaceOptions;
/// let options = SurfaceOptions { band: Some(2), ..SurfaceOptions::default() };
/// assert_eq!(options.max_bytes, 8 << 30);
/// ```
///
/// Needs the feature `surface`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SurfaceOptions {
    /// The band to read, from 1, of a GeoTIFF, or of an NPY of three dimensions: bands, rows and columns.
    /// `None` where there must be one only. Other kinds of files have one band.
    pub band: Option<u16>,
    /// The most bytes that the numbers of a raster may take, 2³³ by default: enough for the largest raster of
    /// 16 bits. A file that needs more is refused before anything is allocated. A reader that unpacks a PNG
    /// or a GeoTIFF, or turns the columns of an NPY into rows, may take three times that for a while.
    pub max_bytes: u64,
}

impl Default for SurfaceOptions {
    fn default() -> Self {
        Self { band: None, max_bytes: 8 << 30 }
    }
}

/// A kind of file that has a raster of numbers.
///
/// Needs the feature `surface`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum SurfaceFormat {
    /// An array of NumPy, `.npy`.
    Npy,
    /// An ESRI ASCII grid, `.asc`.
    EsriAscii,
    /// A PGM, of up to 16 bits.
    Pgm,
    /// A PNG of gray, of up to 16 bits. Needs the feature `png`.
    Png,
    /// A GeoTIFF, or another TIFF of numbers. Needs the feature `geotiff`.
    GeoTiff,
}

impl SurfaceFormat {
    /// The kind of a file by its first bytes; 64 of them do. `None` for files of other kinds.
    #[must_use]
    pub fn of(bytes: &[u8]) -> Option<Self> {
        let begins = |some: &[&[u8]]| some.iter().any(|begin| bytes.starts_with(begin));
        if begins(&[b"\x93NUMPY"]) {
            return Some(Self::Npy);
        }
        if begins(&[PNG_SIGNATURE]) {
            return Some(Self::Png);
        }
        if begins(&[b"II*\0", b"MM\0*", b"II+\0", b"MM\0+"]) {
            return Some(Self::GeoTiff);
        }
        if crate::raster::is_netpbm(bytes) {
            return Some(Self::Pgm);
        }
        let first = Lines::new(bytes).find(|line| !line.is_blank())?;
        let (_, word) = words(first.text).next()?;
        super::esri::Key::of(word).map(|_| Self::EsriAscii)
    }

    /// The kind that the name of a file stands for: `.npy`, `.asc`, `.pgm`, `.png`, `.tif` or `.tiff`. The
    /// case of the letters does not count.
    #[must_use]
    pub fn of_path(path: impl AsRef<Path>) -> Option<Self> {
        let extension = path.as_ref().extension()?.to_str()?.to_ascii_lowercase();
        Some(match extension.as_str() {
            "npy" => Self::Npy,
            "asc" => Self::EsriAscii,
            "pgm" => Self::Pgm,
            "png" => Self::Png,
            "tif" | "tiff" => Self::GeoTiff,
            _ => return None,
        })
    }
}
