//! A file of which two bytes read differently.

use std::io::{self, Read, Seek, SeekFrom};

use super::super::source::ReadSeek;

/// A file in which two bytes are others. The crate `tiff` turns gray around where white is 0, and refuses
/// palettes; samples that are costs are read as they are, so the tag that says so has to say 'gray'.
pub(super) struct Overlay<'a> {
    pub(super) file: &'a mut dyn ReadSeek,
    /// The place in the file.
    pub(super) at: u64,
    pub(super) patch: Option<(u64, [u8; 2])>,
}

impl Read for Overlay<'_> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let count = self.file.read(bytes)?;
        if let Some((place, patch)) = self.patch {
            for (place, byte) in (place..).zip(patch) {
                let here = place.checked_sub(self.at).filter(|&here| here < count as u64);
                if let Some(old) = here.and_then(|here| bytes.get_mut(here as usize)) {
                    *old = byte;
                }
            }
        }
        self.at += count as u64;
        Ok(count)
    }
}

impl Seek for Overlay<'_> {
    fn seek(&mut self, place: SeekFrom) -> io::Result<u64> {
        self.at = self.file.seek(place)?;
        Ok(self.at)
    }
}
