//! One function for all kinds of rasters.

use std::{
    io::{BufReader, Cursor, Read, Seek, SeekFrom},
    path::Path,
};

use mediant_grid::Interrupt;

use super::{Surface, SurfaceError, SurfaceFormat, SurfaceOptions, esri, gray, npy, prj, source::Source};
use crate::{
    foreign::kind_or_quote,
    read::{ReadError, open_regular},
};

/// Reads a raster from a file of any [kind](SurfaceFormat), told by its content. A file of the same name that
/// ends in `.prj`, beside an ESRI ASCII grid, says whether the coordinates are degrees.
///
/// ```no_run
/// use mediant_formats::{SurfaceOptions, read_surface};
/// let friction = read_surface("friction.tif", &SurfaceOptions::default())?;
/// println!("{} × {}, cells of {:?}", friction.width(), friction.height(), friction.cell_size());
/// # Ok::<(), mediant_formats::ReadError>(())
/// ```
///
/// Needs the feature `surface`.
///
/// # Errors
/// [`ReadError`] for a file that is missing, cannot be read, or is no raster.
pub fn read_surface(path: impl AsRef<Path>, options: &SurfaceOptions) -> Result<Surface, ReadError> {
    read_surface_interruptible(path, options, &Interrupt::NEVER)
}

/// [`read_surface`], which an interrupt can stop; it asks for each mebibyte, each row or each tile of a file.
///
/// # Errors
/// As for [`read_surface`], and [`ReadError::Interrupted`].
pub fn read_surface_interruptible(
    path: impl AsRef<Path>,
    options: &SurfaceOptions,
    interrupt: &Interrupt,
) -> Result<Surface, ReadError> {
    let path = path.as_ref();
    let (file, _) = open_regular(path)?;
    let surface = Surface::read_from(BufReader::new(file), options, interrupt);
    let mut surface = surface.map_err(|error| ReadError::of_surface(path, error))?;
    // Of all formats without tags, ESRI ASCII grids alone have the size of a cell.
    let place = &mut surface.georeference;
    place.is_geographic = place.tags.is_empty() && place.cell_size.is_some() && prj::is_geographic(path);
    Ok(surface)
}

/// The width and the height that the header of a file states, before the raster is read.
///
/// Needs the feature `surface`.
///
/// # Errors
/// [`ReadError`] for a file that is missing, cannot be read, or has a header that is wrong or states sides
/// that no raster has.
pub fn surface_size(path: impl AsRef<Path>) -> Result<(u32, u32), ReadError> {
    let path = path.as_ref();
    let (file, _) = open_regular(path)?;
    Surface::size_from(BufReader::new(file)).map_err(|error| ReadError::of_surface(path, error))
}

impl Surface {
    /// Reads a raster from the bytes of a file of any [kind](SurfaceFormat).
    ///
    /// # Errors
    /// [`SurfaceError`] says what is wrong. Memory grows with the bytes and with what was unpacked, never
    /// with what the header states.
    pub fn parse(bytes: &[u8], options: &SurfaceOptions) -> Result<Self, SurfaceError> {
        Self::read_from(Cursor::new(bytes), options, &Interrupt::NEVER)
    }

    /// Reads a raster from a file that is on a disk or elsewhere. All of it belongs to the raster, whatever
    /// place in it `reader` is at.
    ///
    /// # Errors
    /// As for [`parse`](Self::parse), [`SurfaceError::Io`], and [`SurfaceError::Interrupted`].
    pub fn read_from(
        mut reader: impl Read + Seek,
        options: &SurfaceOptions,
        interrupt: &Interrupt,
    ) -> Result<Self, SurfaceError> {
        let mut source = Source::new(&mut reader, options, interrupt)?;
        match format_of(&mut source)? {
            SurfaceFormat::Npy => npy::read(&mut source),
            SurfaceFormat::EsriAscii => source.band(1).and_then(|_| esri::read(&mut source)),
            SurfaceFormat::Pgm | SurfaceFormat::Png => source.band(1).and_then(|_| gray::read(&mut source)),
            #[cfg(feature = "geotiff")]
            SurfaceFormat::GeoTiff => super::geotiff::read(&mut source),
            #[cfg(not(feature = "geotiff"))]
            SurfaceFormat::GeoTiff => Err(SurfaceError::Off { kind: "TIFF", feature: "geotiff" }),
        }
    }

    /// The width and the height that the header of a file states, which [`parse`](Self::parse) reads whole.
    ///
    /// ```
    /// use mediant_formats::Surface;
    /// assert_eq!(Surface::size(b"ncols 90000\nnrows 7000\ncellsize 25\n")?, (90_000, 7000));
    /// # Ok::<(), mediant_formats::SurfaceError>(())
    /// ```
    ///
    /// # Errors
    /// [`SurfaceError`] for a header that is wrong, or states sides that no raster has.
    pub fn size(bytes: &[u8]) -> Result<(u32, u32), SurfaceError> {
        Self::size_from(Cursor::new(bytes))
    }

    /// [`size`](Self::size) of a file that is on a disk or elsewhere.
    ///
    /// # Errors
    /// As for [`size`](Self::size), and [`SurfaceError::Io`].
    pub fn size_from(mut reader: impl Read + Seek) -> Result<(u32, u32), SurfaceError> {
        let (options, never) = (SurfaceOptions::default(), Interrupt::NEVER);
        let mut source = Source::new(&mut reader, &options, &never)?;
        let (width, height) = match format_of(&mut source)? {
            SurfaceFormat::Npy => npy::size(&mut source)?,
            SurfaceFormat::EsriAscii => esri::size(&mut source)?,
            SurfaceFormat::Pgm | SurfaceFormat::Png => gray::size(&mut source)?,
            #[cfg(feature = "geotiff")]
            SurfaceFormat::GeoTiff => super::geotiff::size(&mut source)?,
            #[cfg(not(feature = "geotiff"))]
            SurfaceFormat::GeoTiff => return Err(SurfaceError::Off { kind: "TIFF", feature: "geotiff" }),
        };
        Self::check_size(width, height)
    }
}

/// The kind of a file that is to be a raster; the reader is at its begin then.
fn format_of(source: &mut Source<'_>) -> Result<SurfaceFormat, SurfaceError> {
    let begin = source.read(64)?;
    source.reader.seek(SeekFrom::Start(0))?;
    SurfaceFormat::of(&begin).ok_or_else(|| SurfaceError::Unknown { found: kind_or_quote(&begin) })
}
