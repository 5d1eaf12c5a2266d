//! Writes pictures.

use std::{
    io::{self, Write},
    path::Path,
};

use super::{
    Raster,
    samples::{pack_bits, push_sample},
};

/// A format that pictures are written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum RasterFormat {
    /// P1: black and white, as text.
    PlainPbm,
    /// P2: gray, as text.
    PlainPgm,
    /// P4: black and white, one bit a pixel.
    Pbm,
    /// P5: gray.
    Pgm,
    /// PNG: gray. Needs the feature `png`.
    #[cfg(feature = "png")]
    Png,
}

/// The longest line of a plain file, by the manual page of PGM.
const LINE: usize = 70;

impl RasterFormat {
    /// The format that the name of a file stands for: `.pgm`, `.pbm`, and `.png` with the feature `png`. The
    /// case of the letters does not count.
    #[must_use]
    pub fn of_path(path: impl AsRef<Path>) -> Option<Self> {
        let extension = path.as_ref().extension()?.to_str()?.to_ascii_lowercase();
        match extension.as_str() {
            "pgm" => Some(Self::Pgm),
            "pbm" => Some(Self::Pbm),
            #[cfg(feature = "png")]
            "png" => Some(Self::Png),
            _ => None,
        }
    }
}

impl Raster {
    /// Writes the picture in a format.
    ///
    /// A PNG has gray of 1 bit if [`white`](Self::white) is 1, else of 8 bits up to 255, else of 16, and the
    /// opacity if the picture has it. A PGM has a maxval of 255 where white divides 255, else white itself,
    /// at most 65,535; it has no opacity. A PBM is black where the picture is darker than one half. So a
    /// picture that was read comes back with the same fractions of white, but for colours: in a PNG, and
    /// beyond 65,535 in a PGM, their means are rounded.
    ///
    /// ```
    /// use mediant_formats::{Raster, RasterFormat};
    /// let mut file = Vec::new();
    /// Raster::parse(b"P1 3 1 011")?.write(RasterFormat::PlainPgm, &mut file)?;
    /// assert_eq!(file, b"P2\n3 1\n255\n255 0 0\n");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Errors of the writer.
    pub fn write(&self, format: RasterFormat, mut out: impl Write) -> io::Result<()> {
        let (width, height) = (self.width, self.height);
        let maxval = if 255 % self.white == 0 { 255 } else { self.white.min(0xffff) };
        match format {
            RasterFormat::PlainPbm => write!(out, "P1\n{width} {height}\n")?,
            RasterFormat::Pbm => write!(out, "P4\n{width} {height}\n")?,
            RasterFormat::PlainPgm => write!(out, "P2\n{width} {height}\n{maxval}\n")?,
            RasterFormat::Pgm => write!(out, "P5\n{width} {height}\n{maxval}\n")?,
            #[cfg(feature = "png")]
            RasterFormat::Png => return super::png::write(self, out),
        }
        let mut row = Vec::new();
        for y in 0..height {
            row.clear();
            match format {
                RasterFormat::PlainPbm => self.plain_row("", |x| u32::from(self.is_black(x, y)), &mut row),
                RasterFormat::PlainPgm => {
                    self.plain_row(" ", |x| self.scaled_shade(x, y, maxval), &mut row);
                }
                RasterFormat::Pbm => pack_bits(&mut row, (0..width).map(|x| self.is_black(x, y))),
                _ => (0..width).for_each(|x| push_sample(&mut row, self.scaled_shade(x, y, maxval), maxval)),
            }
            out.write_all(&row)?;
        }
        Ok(())
    }

    /// A row as text, in lines of at most [`LINE`] characters.
    fn plain_row(&self, between: &str, sample: impl Fn(u32) -> u32, row: &mut Vec<u8>) {
        let mut length = 0;
        for x in 0..self.width {
            let text = sample(x).to_string();
            if length > 0 && length + between.len() + text.len() > LINE {
                row.push(b'\n');
                length = 0;
            }
            let between = if length > 0 { between } else { "" };
            row.extend(between.bytes().chain(text.bytes()));
            length += between.len() + text.len();
        }
        row.push(b'\n');
    }

    /// Whether a pixel is darker than one half.
    fn is_black(&self, x: u32, y: u32) -> bool {
        2 * self.shade(x, y).unwrap_or(0) < self.white
    }
}
