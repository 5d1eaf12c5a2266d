//! Reads and writes arrays of NumPy, by its NEP 1.

use std::io::{self, SeekFrom, Write};

use super::{READING, Surface, SurfaceError, npy_header::Header, source::Source};

/// Numbers that are written at a time.
const SOME: usize = 1 << 16;

/// The sides that the header states.
pub(super) fn size(source: &mut Source<'_>) -> Result<(u64, u64), SurfaceError> {
    let Header { width, height, .. } = Header::read(source)?;
    Ok((width, height))
}

pub(super) fn read(source: &mut Source<'_>) -> Result<Surface, SurfaceError> {
    let header = Header::read(source)?;
    let Header { number, big_endian, by_columns, .. } = header;
    let mut samples = number.none();
    let (width, height) = source.check(header.width, header.height, &samples)?;
    let band = source.band(header.bands)?;
    let bytes = header.width * header.height * number.bytes() as u64;
    let expected = bytes.saturating_mul(header.bands.into());
    let found = source.length - source.reader.stream_position()?;
    if found < expected {
        return Err(SurfaceError::Short { unit: "bytes of numbers", expected, found });
    }
    if found > expected {
        let found = format!("{} more", found - expected);
        return Err(SurfaceError::Long { unit: "bytes of numbers", expected, found });
    }
    // The file has them all.
    let cells = usize::try_from(header.width * header.height).map_err(|_| SurfaceError::Memory)?;
    super::samples::each!(&mut samples, all => all.try_reserve_exact(cells)?);
    // The file is as long, so that this is no more than its length.
    source.reader.seek(SeekFrom::Current((bytes * u64::from(band)) as i64))?;
    // Of columns it is the height that the place of a number goes by.
    let side = if by_columns { height } else { width };
    source.each_piece(bytes, |bytes| number.extend(&mut samples, bytes, big_endian, side))?;
    if by_columns {
        samples = samples.transposed((width as usize, height as usize), source.interrupt)?;
    }
    source.interrupt.check(READING)?;
    Surface::new(width, height, samples)
}

impl Surface {
    /// Writes the raster as an array of NumPy of two dimensions, rows and columns, in the type of its
    /// samples. Floats that stand for 'no data' become NaN; integers stay as they are, since such a file
    /// cannot say which of them it is. It says nothing of the place in the world, either.
    ///
    /// # Errors
    /// Errors of the writer.
    pub fn to_npy(&self, mut out: impl Write) -> io::Result<()> {
        out.write_all(&super::npy_header::of(self))?;
        let marker = self.marker.filter(|_| self.samples.are_floats());
        let mut bytes = Vec::new();
        for start in (0..self.samples.len()).step_by(SOME) {
            let end = self.samples.len().min(start + SOME);
            bytes.clear();
            self.samples.push_little_endian(start..end, &mut bytes);
            if let Some(marker) = marker {
                let size = self.samples.number_bytes();
                let none: &[u8] = if size == 4 { &f32::NAN.to_le_bytes() } else { &f64::NAN.to_le_bytes() };
                for (at, number) in (start..).zip(bytes.chunks_exact_mut(size)) {
                    if self.samples.get(at) == Some(marker) {
                        number.copy_from_slice(none);
                    }
                }
            }
            out.write_all(&bytes)?;
        }
        Ok(())
    }
}
