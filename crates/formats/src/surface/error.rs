//! The reasons why a file is no raster.

use std::{collections::TryReserveError, io};

use mediant_grid::Interrupted;

use super::Surface;
use crate::raster::error::RasterError;

/// A file that is no raster, or numbers that make none.
///
/// Needs the feature `surface`.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SurfaceError {
    /// The bytes do not begin as a raster does.
    #[error(
        "expected a raster, NPY, ESRI ASCII grid, PGM, PNG or GeoTIFF, found {found}; is this the file that \
         you meant?"
    )]
    Unknown {
        /// The first bytes, quoted.
        found: String,
    },
    /// A kind of file that this crate was built without.
    #[error(
        "a {kind}, which this program was built without; convert it to NPY, or turn on the feature `{feature}` \
         of mediant-formats"
    )]
    Off {
        /// The kind of the file.
        kind: &'static str,
        /// The feature that reads it.
        feature: &'static str,
    },
    /// A side is 0 or longer than [`Surface::MAX_SIDE`], or there are more than [`Surface::MAX_CELLS`] cells.
    #[error(
        "a raster of {width} × {height} cells: expected sides of 1 to {side}, and at most {cells} cells in all; \
         make its cells larger, or split it",
        side = Surface::MAX_SIDE, cells = Surface::MAX_CELLS
    )]
    Size {
        /// The width.
        width: u64,
        /// The height.
        height: u64,
    },
    /// The numbers would take more bytes than the options allow.
    #[error(
        "a raster whose numbers take {found} bytes: expected at most {max}; allow more by `max_bytes`, make \
         its cells larger, or split it"
    )]
    Budget {
        /// The most bytes, from the options.
        max: u64,
        /// The bytes that the file needs.
        found: u64,
    },
    /// The number of samples is not that of the cells.
    #[error("expected {expected} numbers, one a cell, found {found}; mend the sides, or the numbers")]
    Samples {
        /// The number of cells.
        expected: u64,
        /// The number of samples.
        found: u64,
    },
    /// A cell size that is no positive number.
    #[error("expected a cell size of two positive numbers, found {x} and {y}")]
    CellSize {
        /// The width of a cell.
        x: f64,
        /// The height of a cell.
        y: f64,
    },
    /// The header of an NPY is damaged, or is that of no raster.
    #[error("the header of the NPY: expected {expected}, found {found}; {remedy}")]
    Npy {
        /// The part of the header.
        expected: &'static str,
        /// The text found there.
        found: String,
        /// The cure.
        remedy: &'static str,
    },
    /// An integer of 64 bits that a float of 64 bits does not hold exactly.
    #[error(
        "cell ({x}, {y}): expected an integer that 64-bit floats hold exactly, found {found}; convert the \
         numbers to `float64` where you know how exact they must be"
    )]
    Inexact {
        /// The column, from 0.
        x: u64,
        /// The row, from 0.
        y: u64,
        /// The integer.
        found: String,
    },
    /// A word of an ESRI ASCII grid is missing, or something else stands in its place.
    #[error("line {line}, column {column}: expected {expected}, found {found}; {remedy}")]
    Text {
        /// The line, from 1.
        line: u64,
        /// The column, in bytes from 1.
        column: u64,
        /// The expected word.
        expected: String,
        /// The text found there.
        found: String,
        /// The cure.
        remedy: &'static str,
    },
    /// The file ends before the last number.
    #[error(
        "expected {expected} {unit}, found {found}; is the file cut short, or a side in the header \
         too large?"
    )]
    Short {
        /// `bytes of numbers`, `numbers` in a text, or `bytes` of the whole file.
        unit: &'static str,
        /// Their number, by the header.
        expected: u64,
        /// Their number in the file.
        found: u64,
    },
    /// The file goes on after the last number.
    #[error(
        "expected the end of the file after {expected} {unit}, found {found}; remove what follows, \
         or mend the sides in the header"
    )]
    Long {
        /// `bytes of numbers`, `numbers` in a text, or `bytes` of the whole file.
        unit: &'static str,
        /// Their number, by the header.
        expected: u64,
        /// The rest of the file.
        found: String,
    },
    /// The PGM or PNG cannot be read.
    #[error(transparent)]
    Picture(#[from] RasterError),
    /// A picture with more than one number a pixel, or of one bit a pixel.
    #[error("expected a picture with one gray a pixel, found {found}; save it as gray without opacity")]
    NoGray {
        /// The kind of the picture.
        found: &'static str,
    },
    /// A GeoTIFF that is damaged, or of a kind that is not read here.
    #[error("the GeoTIFF: expected {expected}, found {found}; {remedy}")]
    Tiff {
        /// The part of the file.
        expected: String,
        /// The content found there.
        found: String,
        /// The cure.
        remedy: &'static str,
    },
    /// A raster of several bands, of which none was chosen, or one that it does not have.
    #[error("expected {}", of_bands(*bands, *found))]
    Band {
        /// The number of bands.
        bands: u16,
        /// The band that was chosen.
        found: Option<u16>,
    },
    /// A number that the format which is to be written cannot hold.
    #[error(
        "cell ({x}, {y}): expected a whole number of 0 to {max} for a {kind}, found {found}; scale and round \
         the numbers, or write NPY or GeoTIFF"
    )]
    NotWhole {
        /// The column, from 0.
        x: u32,
        /// The row, from 0.
        y: u32,
        /// The largest number.
        max: u32,
        /// The kind of the file.
        kind: &'static str,
        /// The number.
        found: f64,
    },
    /// There is not enough memory for the raster.
    #[error("not enough memory for the raster; make its cells larger, or split it")]
    Memory,
    /// The file cannot be read or sought in.
    #[error("cannot be read: {0}")]
    Io(#[from] io::Error),
    /// An interrupt stopped the reading.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
}

/// The expected band, in words, and the cure.
fn of_bands(bands: u16, found: Option<u16>) -> String {
    match found {
        Some(band) if bands == 1 => format!("band 1, which is the only one, found {band}; name no band"),
        _ => format!(
            "one band, found {bands}; choose one of 1 to {bands} by `band`{}",
            found.map(|band| format!(" (not {band})")).unwrap_or_default()
        ),
    }
}

impl From<TryReserveError> for SurfaceError {
    fn from(_: TryReserveError) -> Self {
        Self::Memory
    }
}
