//! A file that a raster is read from, on a disk or in memory.

use std::io::{self, Read, Seek, SeekFrom};

use mediant_grid::Interrupt;

use super::{READING, Samples, Surface, SurfaceError, SurfaceOptions};
use crate::read::PIECE;

/// Bytes that can be read from any place.
pub(super) trait ReadSeek: Read + Seek {}

impl<T: Read + Seek> ReadSeek for T {}

/// A file, and how it is to be read.
pub(super) struct Source<'a> {
    pub(super) reader: &'a mut dyn ReadSeek,
    /// Its bytes.
    pub(super) length: u64,
    pub(super) options: &'a SurfaceOptions,
    pub(super) interrupt: &'a Interrupt,
}

impl<'a> Source<'a> {
    /// The file from its begin.
    pub(super) fn new(
        reader: &'a mut dyn ReadSeek,
        options: &'a SurfaceOptions,
        interrupt: &'a Interrupt,
    ) -> Result<Self, SurfaceError> {
        let length = reader.seek(SeekFrom::End(0))?;
        reader.seek(SeekFrom::Start(0))?;
        Ok(Self { reader, length, options, interrupt })
    }

    /// Checks the sides that a header states, and whether the samples fit in the budget.
    pub(super) fn check(
        &self,
        width: u64,
        height: u64,
        samples: &Samples,
    ) -> Result<(u32, u32), SurfaceError> {
        let sides = Surface::check_size(width, height)?;
        let (max, found) = (self.options.max_bytes, width * height * samples.number_bytes() as u64);
        if found > max {
            return Err(SurfaceError::Budget { max, found });
        }
        Ok(sides)
    }

    /// The band that is read, from 0, of so many.
    pub(super) fn band(&self, bands: u16) -> Result<u16, SurfaceError> {
        match self.options.band {
            None if bands == 1 => Ok(0),
            Some(band) if (1..=bands).contains(&band) => Ok(band - 1),
            found => Err(SurfaceError::Band { bands, found }),
        }
    }

    /// At most this many bytes from here on.
    pub(super) fn read(&mut self, most: u64) -> Result<Vec<u8>, SurfaceError> {
        let mut bytes = Vec::new();
        let here = self.reader.stream_position()?;
        let there = self.length.saturating_sub(here).min(most);
        // The extra byte is for the read that finds the end.
        bytes
            .try_reserve_exact(usize::try_from(there).map_err(|_| SurfaceError::Memory)?.saturating_add(1))?;
        let mut rest = (&mut *self.reader).take(most);
        loop {
            self.interrupt.check(READING)?;
            if rest.by_ref().take(PIECE as u64).read_to_end(&mut bytes)? == 0 {
                return Ok(bytes);
            }
        }
    }

    /// Gives the next `count` bytes to a function, some at a time; of each time but the last their number is
    /// a multiple of 8.
    pub(super) fn each_piece(
        &mut self,
        count: u64,
        mut piece: impl FnMut(&mut [u8]) -> Result<(), SurfaceError>,
    ) -> Result<(), SurfaceError> {
        let mut bytes = Vec::new();
        let mut done = 0;
        while done < count {
            self.interrupt.check(READING)?;
            bytes.clear();
            (&mut *self.reader).take((count - done).min(PIECE as u64)).read_to_end(&mut bytes)?;
            done += bytes.len() as u64;
            if bytes.is_empty() || (done < count && bytes.len() < PIECE) {
                // The file was longer when it was opened.
                return Err(io::Error::from(io::ErrorKind::UnexpectedEof).into());
            }
            piece(&mut bytes)?;
        }
        Ok(())
    }
}
