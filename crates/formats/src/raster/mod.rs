//! Pictures of maps, in shades of gray: PGM, PBM and PNG.

mod cursor;
pub(crate) mod error;
#[cfg(feature = "surface")]
mod gray;
mod netpbm;
mod options;
mod plain;
#[cfg(feature = "png")]
mod png;
pub(crate) mod samples;
mod write;

use std::path::Path;

use mediant_grid::{Grid, Interrupt, Interrupted, uninterrupted};

pub use error::RasterError;
#[cfg(feature = "surface")]
pub(crate) use gray::Gray;
pub use options::{MapOptions, RosVersion, Unknown};
#[cfg(all(feature = "surface", feature = "png"))]
pub(crate) use png::write_gray as write_gray_png;
pub use write::RasterFormat;

use crate::{
    foreign::kind_or_quote,
    read::{ReadError, grid_of_checked_sides, read_regular},
};
use error::check_sides;
use samples::{Samples, scaled};

/// A picture: for each pixel its shade, from 0 (black) to [`white`](Self::white), and, if the picture has
/// it, its opacity. Row 0 is the top one.
///
/// The shade of a pixel with colours is their mean. It is kept as their sum, so that no shade is rounded: a
/// picture of three channels of 8 bits has shades of 0 to 765. Beside it is kept their luma, which today's
/// ROS maps are read by. Samples count as they are stored; a gamma or a colour profile changes nothing.
///
/// ```
/// use mediant_formats::{MapOptions, Raster};
/// let raster = Raster::parse(b"P2 3 1 255  0 127 128")?;
/// let grid = raster.to_grid(&MapOptions::default());
/// assert!(grid.is_blocked(1, 0) && grid.is_free(2, 0));
/// # Ok::<(), mediant_formats::RasterError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Raster {
    width: u32,
    height: u32,
    white: u32,
    /// width · height of them.
    shades: Samples,
    opacities: Option<Opacities>,
    /// Of a picture with colours, for each pixel its luma in 8 bits. Of others it follows from the shades.
    lumas: Option<Samples>,
}

/// How opaque each pixel is.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Opacities {
    opaque: u32,
    samples: Samples,
}

/// Whether bytes begin as a file of the Netpbm family does.
#[cfg(feature = "surface")]
pub(crate) fn is_netpbm(bytes: &[u8]) -> bool {
    netpbm::kind(bytes).is_some()
}

/// The stage that an interruption names.
const READING: &str = "reading the picture";

pub(crate) const PNG_SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";

impl Raster {
    /// The most pixels: 2²⁸, as 16,384 × 16,384 have. Pictures are compressed, up to a thousand to one, so it
    /// is this number that bounds the memory that a small file takes: a byte a pixel for gray of 8 bits, 3
    /// for colours of 8 bits, at most 7 for colours of 16 bits with opacity. It may be three times that while
    /// the picture is read, and five times if it is interlaced.
    pub const MAX_PIXELS: u64 = 1 << 28;

    /// The largest shade of white: of three channels of 16 bits.
    pub const MAX_WHITE: u32 = 3 * 0xffff;

    /// Whether bytes begin as a picture does that [`parse`](Self::parse) reads, or tells what it is.
    pub(crate) fn is_picture(bytes: &[u8]) -> bool {
        bytes.starts_with(PNG_SIGNATURE) || netpbm::kind(bytes).is_some()
    }

    /// Reads a PNG (feature `png`), PGM or PBM from its bytes.
    ///
    /// A PNG may have any kind of pixels, and may be interlaced; of an animated one the still picture is
    /// read. A PGM or PBM is plain or binary (P1, P2, P4, P5), with a maxval of up to 65,535. In a PBM 1 is
    /// black.
    ///
    /// # Errors
    /// [`RasterError`] says what is wrong. Memory grows with what was decoded, never with what the header
    /// states.
    pub fn parse(bytes: &[u8]) -> Result<Self, RasterError> {
        Self::parse_interruptible(bytes, &Interrupt::NEVER)
    }

    pub(crate) fn parse_interruptible(bytes: &[u8], interrupt: &Interrupt) -> Result<Self, RasterError> {
        if bytes.starts_with(PNG_SIGNATURE) {
            #[cfg(feature = "png")]
            return png::read(bytes, check_sides, interrupt);
            #[cfg(not(feature = "png"))]
            return Err(RasterError::PngIsOff);
        }
        match netpbm::kind(bytes) {
            Some(kind) => netpbm::read(kind, bytes, check_sides, interrupt),
            None => Err(RasterError::Unknown { found: kind_or_quote(bytes) }),
        }
    }

    /// The width and the height that the header of a picture states, which [`parse`](Self::parse) reads
    /// whole.
    ///
    /// # Errors
    /// [`RasterError`] for a header that is wrong, or states sides that no picture may have.
    pub fn size(bytes: &[u8]) -> Result<(u32, u32), RasterError> {
        if bytes.starts_with(PNG_SIGNATURE) {
            #[cfg(feature = "png")]
            return png::size(bytes);
            #[cfg(not(feature = "png"))]
            return Err(RasterError::PngIsOff);
        }
        match netpbm::kind(bytes) {
            Some(kind) => netpbm::size(kind, bytes),
            None => Err(RasterError::Unknown { found: kind_or_quote(bytes) }),
        }
    }

    /// Reads a file.
    ///
    /// # Errors
    /// [`ReadError`] for a file that is missing, cannot be read, or is no picture.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, ReadError> {
        let path = path.as_ref();
        Self::parse(&read_regular(path)?).map_err(|error| ReadError::of_raster(path, error))
    }

    /// A picture of `width` × `height` opaque pixels; `shade(x, y)` is asked once for each, row by row. A
    /// shade above `white` counts as white.
    ///
    /// # Errors
    /// [`RasterError`] for sides or a number of pixels that a picture cannot have, for a `white` that is 0 or
    /// more than [`MAX_WHITE`](Self::MAX_WHITE), and where memory does not suffice.
    pub fn from_fn(
        width: u32,
        height: u32,
        white: u32,
        mut shade: impl FnMut(u32, u32) -> u32,
    ) -> Result<Self, RasterError> {
        check_sides(u64::from(width), u64::from(height))?;
        if white == 0 || white > Self::MAX_WHITE {
            return Err(RasterError::White { found: white });
        }
        let mut shades = Samples::up_to(white);
        for y in 0..height as i32 {
            shades.extend((0..width as i32).map(|x| shade(x as u32, y as u32).min(white)))?;
        }
        Ok(Self { width, height, white, shades, opacities: None, lumas: None })
    }

    /// The same picture with another opacity: `opacity(x, y)`, from 0 to `opaque`, is asked once for each
    /// pixel, row by row. Larger numbers count as `opaque`, and an `opaque` of 0 as 1.
    ///
    /// # Errors
    /// [`RasterError::Memory`] where memory does not suffice.
    pub fn with_opacity(
        mut self,
        opaque: u16,
        mut opacity: impl FnMut(u32, u32) -> u16,
    ) -> Result<Self, RasterError> {
        let opaque = opaque.max(1);
        let mut samples = Samples::up_to(u32::from(opaque));
        for y in 0..self.height {
            // Sides are at most MAX_SIDE, which fits.
            let row = 0..self.width as i32;
            samples.extend(row.map(|x| u32::from(opacity(x as u32, y).min(opaque))))?;
        }
        self.opacities = Some(Opacities { opaque: u32::from(opaque), samples });
        Ok(self)
    }

    /// The picture of a grid: blocked cells black (0), free cells white (1).
    ///
    /// # Errors
    /// [`RasterError::Pixels`] for a grid of more than [`MAX_PIXELS`](Self::MAX_PIXELS) cells, and
    /// [`RasterError::Memory`].
    pub fn from_grid(grid: &Grid) -> Result<Self, RasterError> {
        Self::from_fn(grid.width(), grid.height(), 1, |x, y| u32::from(grid.is_free(x as i32, y as i32)))
    }

    /// The grid of the picture, one cell a pixel: dark pixels are blocked, see [`MapOptions`].
    #[must_use]
    pub fn to_grid(&self, options: &MapOptions) -> Grid {
        uninterrupted(|never| self.to_grid_interruptible(options, never))
    }

    pub(crate) fn to_grid_interruptible(
        &self,
        options: &MapOptions,
        interrupt: &Interrupt,
    ) -> Result<Grid, Interrupted> {
        let limit = options.threshold.ceil_of(self.white);
        let (white, invert) = (self.white, options.invert);
        let unknown = options.unknown == Unknown::Blocked;
        let dark = |shade: u32| (if invert { white - shade } else { shade }) < limit;
        match self.opaque() {
            None => self.grid_where(interrupt, |shade, _| dark(shade)),
            Some(opaque) => {
                self.grid_where(
                    interrupt,
                    |shade, opacity| {
                        if 2 * opacity < opaque { unknown } else { dark(shade) }
                    },
                )
            }
        }
    }

    /// The grid in which those cells are blocked for whose shade and opacity `blocked` says so. The opacity
    /// is 0 in pictures without.
    pub(crate) fn grid_where(
        &self,
        interrupt: &Interrupt,
        blocked: impl Fn(u32, u32) -> bool,
    ) -> Result<Grid, Interrupted> {
        match &self.shades {
            Samples::U8(shades) => self.grid_of(shades, interrupt, blocked),
            Samples::U16(shades) => self.grid_of(shades, interrupt, blocked),
            Samples::U32(shades) => self.grid_of(shades, interrupt, blocked),
        }
    }

    fn grid_of<S: Copy + Into<u32>>(
        &self,
        shades: &[S],
        interrupt: &Interrupt,
        blocked: impl Fn(u32, u32) -> bool,
    ) -> Result<Grid, Interrupted> {
        match &self.opacities {
            None => self.grid_by_pixel(interrupt, |at| blocked(shades[at].into(), 0)),
            Some(opacities) => self.grid_by_pixel(interrupt, |at| {
                blocked(shades[at].into(), opacities.samples.get(at).unwrap_or(0))
            }),
        }
    }

    /// The grid in which those cells are blocked for whose number, row by row, `blocked` says so.
    fn grid_by_pixel(
        &self,
        interrupt: &Interrupt,
        blocked: impl Fn(usize) -> bool,
    ) -> Result<Grid, Interrupted> {
        let width = self.width as usize;
        let blocked = |x: u32, y: u32| blocked(y as usize * width + x as usize);
        grid_of_checked_sides((self.width, self.height), interrupt, blocked)
    }

    /// The number of columns, 1 to [`Grid::MAX_SIDE`].
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// The number of rows, 1 to [`Grid::MAX_SIDE`].
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.height
    }

    /// The shade of white pixels: the largest that the format allows, times the number of channels.
    #[must_use]
    pub const fn white(&self) -> u32 {
        self.white
    }

    /// The shade of a pixel, 0 to [`white`](Self::white); `None` outside.
    #[must_use]
    pub fn shade(&self, x: u32, y: u32) -> Option<u32> {
        self.shades.get(self.index(x, y)?)
    }

    /// The shade of a pixel as a part of `largest`.
    fn scaled_shade(&self, x: u32, y: u32, largest: u32) -> u32 {
        scaled(self.shade(x, y).unwrap_or(0), self.white, largest)
    }

    /// The opacity of opaque pixels; `None` if all pixels of a picture of this kind are opaque.
    #[must_use]
    pub fn opaque(&self) -> Option<u32> {
        self.opacities.as_ref().map(|opacities| opacities.opaque)
    }

    /// The opacity of a pixel, 0 to [`opaque`](Self::opaque); `None` outside, and where all are opaque.
    #[must_use]
    pub fn opacity(&self, x: u32, y: u32) -> Option<u32> {
        self.opacities.as_ref()?.samples.get(self.index(x, y)?)
    }

    /// The luma of a pixel, in 8 bits as GraphicsMagick computes it; `None` outside.
    pub(crate) fn luma(&self, x: u32, y: u32) -> Option<u8> {
        let at = self.index(x, y)?;
        match &self.lumas {
            Some(lumas) => lumas.get(at).map(|luma| luma as u8),
            None => self.shades.get(at).map(|shade| self.luma_of_gray(shade)),
        }
    }

    /// The luma of a gray pixel: the shade in 16 bits, of which the lower 8 are cut off.
    fn luma_of_gray(&self, shade: u32) -> u8 {
        (scaled(shade, self.white, 0xffff) / 257) as u8
    }

    /// The grid in which those cells are blocked for whose luma `blocked` says so, and for pixels that are
    /// not wholly opaque, where they count, `unknown`.
    pub(crate) fn grid_of_lumas(
        &self,
        interrupt: &Interrupt,
        blocked: &[bool; 256],
        unknown: Option<bool>,
    ) -> Result<Grid, Interrupted> {
        let opaque = self.opaque();
        let hidden = self.opacities.as_ref().zip(opaque).zip(unknown);
        let of_gray = match self.lumas {
            Some(_) => Vec::new(),
            // Shades are few, and pixels many.
            None => (0..=self.white).map(|shade| blocked[usize::from(self.luma_of_gray(shade))]).collect(),
        };
        self.grid_by_pixel(interrupt, |at| match (&hidden, &self.lumas) {
            (Some(((opacities, opaque), unknown)), _) if opacities.samples.get(at) < Some(*opaque) => {
                *unknown
            }
            (_, Some(lumas)) => lumas.get(at).is_none_or(|luma| blocked[luma as usize & 0xff]),
            (_, None) => self.shades.get(at).is_none_or(|shade| of_gray[shade as usize]),
        })
    }

    fn index(&self, x: u32, y: u32) -> Option<usize> {
        (x < self.width && y < self.height).then(|| y as usize * self.width as usize + x as usize)
    }
}
