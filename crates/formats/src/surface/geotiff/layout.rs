//! The layout of the samples of a TIFF, checked before any of them is read.

use super::{
    super::{Surface, number::Number, source::Source},
    Directory, SurfaceError, error,
};

/// The numbers of tags.
const WIDTH: u16 = 256;
const HEIGHT: u16 = 257;
const BITS: u16 = 258;
const COMPRESSION: u16 = 259;
pub(super) const PHOTOMETRIC: u16 = 262;
const STRIP_OFFSETS: u16 = 273;
const BANDS: u16 = 277;
const STRIP_ROWS: u16 = 278;
const STRIP_BYTES: u16 = 279;
const PLANAR: u16 = 284;
const TILE_WIDTH: u16 = 322;
const TILE_HEIGHT: u16 = 323;
const TILE_OFFSETS: u16 = 324;
const TILE_BYTES: u16 = 325;
const SAMPLE_FORMAT: u16 = 339;

/// More than any of the compressions makes of a byte: deflate 1032, LZW 2731, PackBits 64.
const MOST_UNPACKED: u64 = 4096;

/// The samples of a TIFF.
#[derive(Debug)]
pub(super) struct Layout {
    pub(super) width: u32,
    pub(super) height: u32,
    /// The type of the samples; `U8` where they have fewer bits.
    pub(super) number: Number,
    pub(super) bits: u64,
    /// The samples of each cell in a chunk, and which of them is read, from 0.
    pub(super) bands: u16,
    pub(super) band: u16,
    /// The first chunk of the band that is read.
    pub(super) first: u64,
    /// Whether the samples are not compressed: the file has as many bytes as they take.
    pub(super) is_stored: bool,
    pub(super) chunks: Chunks,
}

/// Strips or tiles: rectangles of samples, each compressed for itself.
#[derive(Debug)]
pub(super) struct Chunks {
    is_tiled: bool,
    /// Columns and rows of a chunk.
    pub(super) width: u64,
    pub(super) height: u64,
    /// The number of chunks beside and below each other.
    pub(super) across: u64,
    pub(super) down: u64,
    /// Of each chunk of all bands: its place in the file, and its bytes there. Both are 0 for a chunk that is
    /// left out.
    pub(super) places: Vec<(u64, u64)>,
}

impl Layout {
    /// Width and height as they are stated.
    pub(super) fn sides(directory: &Directory, source: &mut Source<'_>) -> Result<(u64, u64), SurfaceError> {
        let side = |tag, source: &mut Source<'_>| -> Result<u64, SurfaceError> {
            directory.first(tag, source)?.ok_or_else(|| error("width and height", "none"))
        };
        Ok((side(WIDTH, source)?, side(HEIGHT, source)?))
    }

    pub(super) fn read(directory: &Directory, source: &mut Source<'_>) -> Result<Self, SurfaceError> {
        let (width, height) = Self::sides(directory, source)?;
        let (width, height) = Surface::check_size(width, height)?;
        let first = |tag, default, source: &mut Source<'_>| -> Result<u64, SurfaceError> {
            Ok(directory.first(tag, source)?.unwrap_or(default))
        };
        let all_bands = u16::try_from(first(BANDS, 1, source)?).ok().filter(|&bands| bands > 0);
        let all_bands = all_bands.ok_or_else(|| error("1 to 65535 bands", "another number"))?;
        let band = source.band(all_bands)?;
        let bits = same(BITS, 1, directory, source)?;
        let number = number(bits, same(SAMPLE_FORMAT, 1, directory, source)?)?;
        source.check(width.into(), height.into(), &number.none())?;
        let compression = first(COMPRESSION, 1, source)?;
        check_compression(compression)?;
        let photometric = first(PHOTOMETRIC, 1, source)?;
        if photometric == 6 {
            return Err(error("a raster of numbers", "a photograph (YCbCr)"));
        }
        let is_planar = first(PLANAR, 1, source)? == 2;
        let planes = if is_planar { u64::from(all_bands) } else { 1 };
        let (bands, band, plane) = if is_planar { (1, 0, band) } else { (all_bands, band, 0) };
        let chunks = Chunks::read((width, height), planes, directory, source)?;
        let first = u64::from(plane) * chunks.across * chunks.down;
        let is_stored = compression == 1;
        let layout = Self { width, height, number, bits, bands, band, first, is_stored, chunks };
        layout.check(source)?;
        Ok(layout)
    }

    /// The bytes of a row of a chunk of this width.
    pub(super) fn row_bytes(&self, width: u64) -> u64 {
        (width * self.bits * u64::from(self.bands)).div_ceil(8)
    }

    /// The rows of the chunks that are so far down, without those below the raster.
    pub(super) fn rows(&self, down: u64) -> u64 {
        self.chunks.height.min(u64::from(self.height) - down * self.chunks.height)
    }

    /// Checks that the file has all chunks of the band, and that none is said to be larger than it can be.
    fn check(&self, source: &Source<'_>) -> Result<(), SurfaceError> {
        if self.bits < 8 && self.bands > 1 {
            return Err(error("bands of at least 8 bits", format!("{} bits", self.bits)));
        }
        let mut sum: u64 = 0;
        let chunks = &self.chunks;
        for at in 0..chunks.across * chunks.down {
            let (place, count) = chunks.places[(self.first + at) as usize];
            if (place, count) == (0, 0) {
                continue;
            }
            let rows = if chunks.is_tiled { chunks.height } else { self.rows(at / chunks.across) };
            // A width of 2³² of 64 bits and 2¹⁶ bands fits.
            let size = self.row_bytes(chunks.width).saturating_mul(rows);
            let most = if self.is_stored { source.length } else { count.saturating_mul(MOST_UNPACKED) };
            if size > most {
                let expected = format!("strips or tiles whose {size} bytes are all in the file");
                return Err(error(expected, format!("one of {count} bytes; is it cut short?")));
            }
            let end = if self.is_stored { size } else { count };
            if place.checked_add(end).is_none_or(|end| end > source.length) {
                let expected = place.saturating_add(end);
                return Err(SurfaceError::Short { unit: "bytes", expected, found: source.length });
            }
            sum = sum.saturating_add(size);
        }
        if self.is_stored && sum > source.length {
            let expected = format!("{sum} bytes of strips or tiles");
            return Err(error(expected, "some that are stored in one place"));
        }
        Ok(())
    }
}

impl Chunks {
    fn read(
        (width, height): (u32, u32),
        planes: u64,
        directory: &Directory,
        source: &mut Source<'_>,
    ) -> Result<Self, SurfaceError> {
        let (width, height) = (u64::from(width), u64::from(height));
        let is_tiled = directory.first(TILE_OFFSETS, source)?.is_some();
        let mut side = |tag, default| -> Result<u64, SurfaceError> {
            Ok(directory.first(tag, source)?.unwrap_or(default))
        };
        let (chunk_width, chunk_height) = if is_tiled {
            (side(TILE_WIDTH, 0)?, side(TILE_HEIGHT, 0)?)
        } else {
            (width, side(STRIP_ROWS, height)?.min(height))
        };
        if chunk_width == 0 || chunk_height == 0 {
            return Err(error("strips or tiles with rows and columns", "some without"));
        }
        let (across, down) = (width.div_ceil(chunk_width), height.div_ceil(chunk_height));
        let tags = if is_tiled { (TILE_OFFSETS, TILE_BYTES) } else { (STRIP_OFFSETS, STRIP_BYTES) };
        let (offsets, counts) = (directory.numbers(tags.0, source)?, directory.numbers(tags.1, source)?);
        // At most 2⁴⁰ chunks of 2¹⁶ bands.
        let chunks = across * down * planes;
        if offsets.len() as u64 != chunks || counts.len() as u64 != chunks {
            let found = format!("{} places and {} lengths", offsets.len(), counts.len());
            return Err(error(format!("{chunks} strips or tiles"), found));
        }
        let places = offsets.into_iter().zip(counts).collect();
        Ok(Self { is_tiled, width: chunk_width, height: chunk_height, across, down, places })
    }
}

/// A number that a tag states for each band, if it is the same for all.
fn same(tag: u16, default: u64, directory: &Directory, source: &mut Source<'_>) -> Result<u64, SurfaceError> {
    let numbers = directory.numbers(tag, source)?;
    let number = numbers.first().copied().unwrap_or(default);
    if numbers.iter().all(|&other| other == number) {
        Ok(number)
    } else {
        Err(error("bands of one type", "several types"))
    }
}

fn number(bits: u64, format: u64) -> Result<Number, SurfaceError> {
    Ok(match (format, bits) {
        (1, 1 | 2 | 4 | 8) => Number::U8,
        (1, 16) => Number::U16,
        (1, 32) => Number::U32,
        (1, 64) => Number::U64,
        (2, 8) => Number::I8,
        (2, 16) => Number::I16,
        (2, 32) => Number::I32,
        (2, 64) => Number::I64,
        (3, 16) => Number::F16,
        (3, 32) => Number::F32,
        (3, 64) => Number::F64,
        _ => {
            let kind = match format {
                1 => "whole numbers",
                2 => "whole numbers with a sign",
                3 => "floats",
                5 | 6 => "complex numbers",
                _ => "unknown samples",
            };
            return Err(error("whole numbers or floats of up to 64 bits", format!("{kind} of {bits} bits")));
        }
    })
}

fn check_compression(compression: u64) -> Result<(), SurfaceError> {
    let name = match compression {
        1 | 5 | 8 | 32773 | 32946 => return Ok(()),
        2..=4 => "a fax compression",
        6 | 7 => "JPEG",
        34887 => "LERC",
        34925 => "LZMA",
        50000 => "Zstandard",
        50001 => "WebP",
        50002 => "JPEG XL",
        other => return Err(error(KNOWN, format!("number {other}"))),
    };
    Err(error(KNOWN, name))
}

const KNOWN: &str = "no compression, LZW, deflate or PackBits";
