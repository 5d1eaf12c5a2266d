//! Rasters in pictures: PGM and PNG of gray, whose shades are the numbers.

use std::io::{self, Write};

use super::{Samples, Surface, SurfaceError, source::Source};
use crate::{
    raster::{Gray, samples::Samples as Shades},
    read::PIECE,
};

/// The sides that the header states.
pub(super) fn size(source: &mut Source<'_>) -> Result<(u64, u64), SurfaceError> {
    Ok(Gray::of(&source.read(PIECE as u64)?)?.sides)
}

pub(super) fn read(source: &mut Source<'_>) -> Result<Surface, SurfaceError> {
    let bytes = source.read(source.length)?;
    let gray = Gray::of(&bytes)?;
    let (width, height) = gray.sides;
    let kind = if gray.largest > 0xff { Samples::U16(Vec::new()) } else { Samples::U8(Vec::new()) };
    let (width, height) = source.check(width, height, &kind)?;
    let samples = match gray.read(&bytes, source.interrupt)? {
        Shades::U8(all) => Samples::U8(all),
        Shades::U16(all) => Samples::U16(all),
        Shades::U32(all) => Samples::U32(all),
    };
    Surface::new(width, height, samples)
}

impl Surface {
    /// Writes the raster as a binary PGM: of 8 bits if its samples are [`Samples::U8`], else of 16. It says
    /// nothing of 'no data' and of the place in the world.
    ///
    /// # Errors
    /// Errors of the writer; [`SurfaceError::NotWhole`] inside of one for a number that is not a whole one of
    /// 0 to 65,535.
    pub fn to_pgm(&self, mut out: impl Write) -> io::Result<()> {
        write!(out, "P5\n{} {}\n{}\n", self.width, self.height, self.largest_gray())?;
        self.each_row_of_gray("PGM", |row| out.write_all(row))
    }

    /// Writes the raster as a PNG of gray: of 8 bits if its samples are [`Samples::U8`], else of 16. It says
    /// nothing of 'no data' and of the place in the world.
    ///
    /// Needs the feature `png`.
    ///
    /// # Errors
    /// As for [`to_pgm`](Self::to_pgm).
    #[cfg(feature = "png")]
    pub fn to_png(&self, out: impl Write) -> io::Result<()> {
        let is_wide = self.largest_gray() > 0xff;
        crate::raster::write_gray_png(out, (self.width, self.height), is_wide, |rows| {
            self.each_row_of_gray("PNG", |row| rows.write_all(row))
        })
    }

    const fn largest_gray(&self) -> u32 {
        if matches!(self.samples, Samples::U8(_)) { 0xff } else { 0xffff }
    }

    /// Gives the bytes of each row to a function, the higher byte of a number first.
    fn each_row_of_gray(
        &self,
        kind: &'static str,
        mut write: impl FnMut(&[u8]) -> io::Result<()>,
    ) -> io::Result<()> {
        let max = self.largest_gray();
        let mut bytes = Vec::new();
        for y in 0..self.height {
            bytes.clear();
            for x in 0..self.width {
                let at = y as usize * self.width as usize + x as usize;
                let found = self.samples.get(at).unwrap_or(f64::NAN);
                if found.fract() != 0.0 || !(0.0..=f64::from(max)).contains(&found) {
                    let error = SurfaceError::NotWhole { x, y, max, kind, found };
                    return Err(io::Error::new(io::ErrorKind::InvalidInput, error));
                }
                let [higher, lower] = (found as u16).to_be_bytes();
                if max > 0xff {
                    bytes.push(higher);
                }
                bytes.push(lower);
            }
            write(&bytes)?;
        }
        Ok(())
    }
}
