//! Whether there is room for what grows with a map.

use std::hint::black_box;

use crate::interrupt::{Interrupted, StoppedBy};

/// Smaller pieces are not asked for: that would take longer than it is worth.
const LEAST: usize = 1 << 16;

/// Asks for the memory of so many values before they are made, and gives it back: an allocation that fails
/// ends the program. (Another thread may take it meanwhile.)
#[doc(hidden)]
pub fn room_for<T>(count: usize, during: &'static str) -> Result<(), Interrupted> {
    let bytes = count.saturating_mul(size_of::<T>());
    if bytes < LEAST || has_room(bytes) {
        return Ok(());
    }
    Err(Interrupted { by: StoppedBy::Memory { bytes: bytes as u64 }, during })
}

/// Whether so much memory can be had.
#[doc(hidden)]
#[must_use]
pub fn has_room(bytes: usize) -> bool {
    let mut room = Vec::<u8>::new();
    let is_there = room.try_reserve_exact(bytes).is_ok();
    // An allocation that nobody looks at may be left out.
    black_box(&room);
    is_there
}

/// Makes room for so many values more in a list that grows by and by, unless it is small.
#[doc(hidden)]
pub fn room_in<T>(list: &mut Vec<T>, more: usize, during: &'static str) -> Result<(), Interrupted> {
    let bytes = list.len().saturating_add(more).saturating_mul(size_of::<T>());
    if bytes < LEAST / 2 || list.capacity() - list.len() >= more || list.try_reserve(more).is_ok() {
        return Ok(());
    }
    let bytes = bytes as u64;
    Err(Interrupted { by: StoppedBy::Memory { bytes }, during })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_than_there_is_is_refused() {
        assert!(room_for::<u64>(1 << 20, "testing").is_ok());
        let error = room_for::<u64>(usize::MAX / 8, "testing").expect_err("more than there is");
        assert_eq!(error.to_string(), "no room for what is made while testing");
        assert!(room_for::<u64>(usize::MAX, "testing").is_err());
        let mut list = vec![1_u64];
        assert!(room_in(&mut list, 1 << 14, "testing").is_ok() && list.capacity() > 1 << 14);
        let error = room_in(&mut list, usize::MAX / 8, "testing").expect_err("more than there is");
        assert!(matches!(error.by, StoppedBy::Memory { bytes } if bytes > isize::MAX as u64));
    }
}
