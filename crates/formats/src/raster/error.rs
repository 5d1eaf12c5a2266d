//! Why bytes are not a picture.

use mediant_grid::{Grid, GridError, Interrupted};

use super::Raster;

/// Bytes that are not a picture that can be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RasterError {
    /// The bytes do not begin as a picture does.
    #[error(
        "expected a picture, PNG, PGM or PBM, found {found}; is this the file that you meant? \
         Convert other pictures to PNG"
    )]
    Unknown {
        /// How the bytes begin, quoted.
        found: String,
    },
    /// A picture of the Netpbm family with colours, P3, P6 or P7.
    #[error(
        "expected a PGM or PBM (P1, P2, P4 or P5), found {found}; convert it to PGM, for example by `ppmtopgm`"
    )]
    Colours {
        /// The first two bytes, quoted.
        found: String,
    },
    /// A PNG, but the feature `png` of this crate is off.
    #[error(
        "a PNG, which this program was built without; convert it to PGM, or turn on the feature `png` of \
         mediant-formats"
    )]
    PngIsOff,
    /// A number of the header of a PGM or PBM is missing, or something else stands in its place.
    #[error("line {line}, column {column}: expected {expected}, found {found}; {HEADER_FORM}")]
    Header {
        /// The line, from 1.
        line: usize,
        /// The column, in bytes from 1.
        column: usize,
        /// The expected number or white space.
        expected: &'static str,
        /// The text found there.
        found: String,
    },
    /// A side is 0 or longer than [`Grid::MAX_SIDE`].
    #[error("the picture is no map: {source}; scale it down or split it")]
    Size {
        /// The sides.
        source: GridError,
    },
    /// There are more pixels than [`Raster::MAX_PIXELS`].
    #[error(
        "a picture of {width} × {height} pixels: expected at most {max} pixels in all; scale it down or split it",
        max = Raster::MAX_PIXELS
    )]
    Pixels {
        /// The width.
        width: u32,
        /// The height.
        height: u32,
    },
    /// The lightest shade that was named is 0 or more than [`Raster::MAX_WHITE`].
    #[error("expected a shade for white of 1 to {max}, found {found}", max = Raster::MAX_WHITE)]
    White {
        /// The shade.
        found: u32,
    },
    /// A sample of a PGM or PBM is no number, or more than the largest that the header states.
    #[error(
        "{place}: expected a sample of 0 to {max}, found {found}; mend the sample or the maxval in the header"
    )]
    Sample {
        /// The line and column, or in a binary file the pixel.
        place: String,
        /// The largest sample, from the header.
        max: u32,
        /// The text found there.
        found: String,
    },
    /// The file ends before the last pixel.
    #[error(
        "expected {expected} {unit} of pixels after the header, found {found}; is the file cut short, or a \
         side in the header too large?"
    )]
    Short {
        /// `bytes`, or `samples` in a plain file.
        unit: &'static str,
        /// Their number, by the header.
        expected: u64,
        /// Their number in the file.
        found: u64,
    },
    /// The file goes on after the last pixel.
    #[error(
        "expected the end of the file after {expected} {unit} of pixels, found {found}; remove what follows, \
         or mend the sides in the header"
    )]
    Long {
        /// `bytes`, or `samples` in a plain file.
        unit: &'static str,
        /// Their number, by the header.
        expected: u64,
        /// The rest of the file.
        found: String,
    },
    /// The header of a binary PGM or PBM ends in CR LF, and there is more after the pixels.
    #[error(
        "the lines of the header end in CR LF, of which LF would be the first pixel; end them in LF alone, \
         and copy the file as binary"
    )]
    LineEnds,
    /// A PNG that is damaged, cut short, or of a kind that does not exist.
    #[error("the PNG cannot be read: {message}; save the picture anew")]
    Png {
        /// The decoder's message.
        message: String,
    },
    /// There is not enough memory for the picture.
    #[error("not enough memory for the picture; scale it down or split it")]
    Memory,
    /// An interrupt stopped the reading.
    #[error(transparent)]
    Interrupted(#[from] Interrupted),
}

const HEADER_FORM: &str = "a PGM begins with `P5`, the width, the height and the largest sample, a PBM with \
                           `P4`, the width and the height";

impl From<std::collections::TryReserveError> for RasterError {
    fn from(_: std::collections::TryReserveError) -> Self {
        Self::Memory
    }
}

/// The sides that a header states, if a picture may have them. Nothing is allocated before.
pub(super) fn check_sides(width: u64, height: u64) -> Result<(u32, u32), RasterError> {
    Grid::check_size(width, height).map_err(|source| RasterError::Size { source })?;
    // No loss: both are at most MAX_SIDE.
    let (width, height) = (width as u32, height as u32);
    if u64::from(width) * u64::from(height) > Raster::MAX_PIXELS {
        return Err(RasterError::Pixels { width, height });
    }
    Ok((width, height))
}
