//! The first directory of a TIFF: its tags, and where their values are.
//!
//! The crate `tiff` reads it, too, but reserves memory by the counts that it states. Here they are compared
//! with the file first.

use std::io::SeekFrom;

use super::{super::source::Source, SurfaceError, error};

/// A tag and the place of its value.
struct Entry {
    tag: u16,
    kind: u16,
    count: u64,
    place: u64,
}

pub(super) struct Directory {
    big_endian: bool,
    entries: Vec<Entry>,
}

/// The bytes of a number of a type of values, and of its parts that have an order of bytes.
pub(super) const fn number_bytes(kind: u16) -> Option<(usize, usize)> {
    Some(match kind {
        // BYTE, ASCII, SBYTE, UNDEFINED.
        1 | 2 | 6 | 7 => (1, 1),
        // SHORT, SSHORT.
        3 | 8 => (2, 2),
        // LONG, SLONG, FLOAT, IFD.
        4 | 9 | 11 | 13 => (4, 4),
        // RATIONAL, SRATIONAL.
        5 | 10 => (8, 4),
        // DOUBLE, LONG8, SLONG8, IFD8.
        12 | 16..=18 => (8, 8),
        _ => return None,
    })
}

const END: &str = "the end of the file";

impl Directory {
    pub(super) fn read(source: &mut Source<'_>) -> Result<Self, SurfaceError> {
        source.reader.seek(SeekFrom::Start(0))?;
        let begin = source.read(16)?;
        let big_endian = begin.starts_with(b"MM");
        let word = |bytes: &[u8]| number(bytes, big_endian);
        let field = |at: usize, count: usize| begin.get(at..at + count).map(word);
        let is_big = field(2, 2) == Some(43);
        let place = if is_big {
            field(4, 4)
                .filter(|&form| form == if big_endian { 8 << 16 } else { 8 })
                .ok_or_else(|| error("a BigTIFF with places of 8 bytes", "others"))?;
            field(8, 8)
        } else {
            field(4, 4)
        };
        let place = place.ok_or_else(|| error("the place of the first image", END))?;
        let (count_bytes, entry_bytes) = if is_big { (8, 20) } else { (2, 12) };
        let count = word(&bytes_at(source, place, count_bytes)?);
        let size = count.checked_mul(entry_bytes).filter(|&size| size <= source.length);
        let size = size.ok_or_else(|| error(format!("{count} tags"), END))?;
        let bytes = bytes_at(source, place + count_bytes, size)?;
        let mut directory = Self { big_endian, entries: Vec::new() };
        for (entry, at) in bytes.chunks_exact(entry_bytes as usize).zip(0..) {
            let place = place + count_bytes + at * entry_bytes;
            directory.entries.extend(Entry::of(entry, place, big_endian, source.length)?);
        }
        Ok(directory)
    }

    fn entry(&self, tag: u16) -> Option<&Entry> {
        // As the crate `tiff` does: of a tag that is there twice the last counts.
        self.entries.iter().rfind(|entry| entry.tag == tag)
    }

    /// The type of a tag's numbers, and their bytes, the lowest of each first.
    pub(super) fn bytes(
        &self,
        tag: u16,
        source: &mut Source<'_>,
    ) -> Result<Option<(u16, Vec<u8>)>, SurfaceError> {
        let Some(entry) = self.entry(tag) else { return Ok(None) };
        let (whole, part) = number_bytes(entry.kind).unwrap_or((1, 1));
        let mut bytes = bytes_at(source, entry.place, entry.count * whole as u64)?;
        if self.big_endian {
            bytes.chunks_exact_mut(part).for_each(<[u8]>::reverse);
        }
        Ok(Some((entry.kind, bytes)))
    }

    /// The whole numbers of a tag; none if it is not there.
    pub(super) fn numbers(&self, tag: u16, source: &mut Source<'_>) -> Result<Vec<u64>, SurfaceError> {
        let Some((kind, bytes)) = self.bytes(tag, source)? else { return Ok(Vec::new()) };
        let (size, _) = number_bytes(kind).unwrap_or((1, 1));
        if !matches!(kind, 1 | 3 | 4 | 13 | 16 | 18) {
            return Err(error(format!("whole numbers as tag {tag}"), format!("values of type {kind}")));
        }
        let mut numbers = Vec::new();
        numbers.try_reserve_exact(bytes.len() / size)?;
        numbers.extend(bytes.chunks_exact(size).map(|bytes| number(bytes, false)));
        Ok(numbers)
    }

    /// The first whole number of a tag.
    pub(super) fn first(&self, tag: u16, source: &mut Source<'_>) -> Result<Option<u64>, SurfaceError> {
        Ok(self.numbers(tag, source)?.first().copied())
    }

    /// The bytes which say of a tag of one SHORT that it is this number, and their place.
    pub(super) fn patch(&self, tag: u16, value: u16) -> Option<(u64, [u8; 2])> {
        let entry = self.entry(tag).filter(|entry| entry.kind == 3 && entry.count == 1)?;
        Some((entry.place, if self.big_endian { value.to_be_bytes() } else { value.to_le_bytes() }))
    }
}

impl Entry {
    /// The tag of some bytes at a place; `None` for a type of values that nobody knows.
    fn of(bytes: &[u8], place: u64, big_endian: bool, length: u64) -> Result<Option<Self>, SurfaceError> {
        let word = |at: usize, count: usize| number(&bytes[at..][..count], big_endian);
        // No loss: two bytes each.
        let (tag, kind) = (word(0, 2) as u16, word(2, 2) as u16);
        let is_big = bytes.len() == 20;
        let half = if is_big { 8 } else { 4 };
        let count = word(4, half);
        let Some((size, _)) = number_bytes(kind) else {
            // The crate `tiff` skips too few bytes of such a tag of a BigTIFF.
            return if is_big {
                Err(error(format!("a known type of the values of tag {tag}"), format!("type {kind}")))
            } else {
                Ok(None)
            };
        };
        let inside = place + 4 + half as u64;
        let size = count.checked_mul(size as u64).filter(|&size| size <= length);
        let place = match size {
            Some(size) if size <= half as u64 => Some(inside),
            Some(size) => {
                let start = word(4 + half, half);
                Some(start).filter(|start| start.checked_add(size).is_some_and(|end| end <= length))
            }
            None => None,
        };
        let place = place.ok_or_else(|| error(format!("{count} values of tag {tag}"), END))?;
        Ok(Some(Self { tag, kind, count, place }))
    }
}

/// All bytes of a part of the file.
fn bytes_at(source: &mut Source<'_>, place: u64, count: u64) -> Result<Vec<u8>, SurfaceError> {
    source.reader.seek(SeekFrom::Start(place))?;
    let bytes = source.read(count)?;
    if bytes.len() as u64 == count {
        Ok(bytes)
    } else {
        Err(error(format!("{count} bytes of tags from byte {place} on"), END))
    }
}

/// The number of up to eight bytes.
fn number(bytes: &[u8], big_endian: bool) -> u64 {
    let add = |number: u64, &byte: &u8| number << 8 | u64::from(byte);
    if big_endian { bytes.iter().fold(0, add) } else { bytes.iter().rev().fold(0, add) }
}
