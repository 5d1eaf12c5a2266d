//! Memory of the caller: texts and arrays that come in, places where results go out.
//!
//! This is the one place where the library trusts a caller. Null pointers and misaligned ones are errors, and
//! so are arrays that no memory can hold. A pointer to other memory than the header asks for cannot be told:
//! what it leads to is read, or written over.

#![allow(unsafe_code, reason = "pointers of C")]

use std::{
    ffi::{CStr, c_char},
    slice,
};

use crate::{
    failure::Failure,
    points::{Cell, Ends, Point},
};

/// Types of which every pattern of bits is a value, so that memory of the caller may hold any.
///
/// # Safety
/// As it says.
pub(crate) unsafe trait Plain: Copy {}

// SAFETY: all are numbers.
unsafe impl Plain for u8 {}
// SAFETY: as above.
unsafe impl Plain for i32 {}
// SAFETY: as above.
unsafe impl Plain for u64 {}
// SAFETY: as above.
unsafe impl Plain for f32 {}
// SAFETY: as above.
unsafe impl Plain for f64 {}
// SAFETY: as above.
unsafe impl Plain for usize {}
// SAFETY: two numbers, and nothing between them.
unsafe impl Plain for Point {}
// SAFETY: as above.
unsafe impl Plain for Cell {}
// SAFETY: two points, and nothing between them.
unsafe impl Plain for Ends {}

/// The text of an argument; `None` for null.
///
/// # Safety
/// A pointer that is not null leads to bytes that end with 0, and that do not change during the call.
pub(crate) unsafe fn text<'a>(name: &str, text: *const c_char) -> Result<Option<&'a str>, Failure> {
    if text.is_null() {
        return Ok(None);
    }
    // SAFETY: the caller promises it.
    let text = unsafe { CStr::from_ptr(text) };
    text.to_str().map(Some).map_err(|_| Failure::argument(name, "it is not UTF-8"))
}

#[inline]
fn check<T>(name: &str, data: *const T, count: usize) -> Result<(), Failure> {
    if data.is_null() {
        return Err(Failure::argument(name, "it is null"));
    }
    if !data.is_aligned() {
        return Err(Failure::argument(name, "it is not aligned as its type is"));
    }
    match count.checked_mul(size_of::<T>()) {
        Some(bytes) if isize::try_from(bytes).is_ok() => Ok(()),
        _ => Err(Failure::argument(name, "it has more elements than memory can hold")),
    }
}

/// An array of the caller's, to be read. Null is an empty one if it has no elements.
///
/// # Safety
/// A pointer that is neither null nor misaligned leads to `count` values, which do not change while the
/// result is used.
#[inline]
pub(crate) unsafe fn array<'a, T: Plain>(
    name: &str,
    data: *const T,
    count: usize,
) -> Result<&'a [T], Failure> {
    if count == 0 {
        return Ok(&[]);
    }
    check(name, data, count)?;
    // SAFETY: it is not null, aligned, and not too large; the rest the caller promises.
    Ok(unsafe { slice::from_raw_parts(data, count) })
}

/// A value of the caller's.
///
/// # Safety
/// A pointer that is neither null nor misaligned leads to a value.
pub(crate) unsafe fn value<T: Copy>(name: &str, data: *const T) -> Result<T, Failure> {
    check(name, data, 1)?;
    // SAFETY: it is not null and aligned; the rest the caller promises.
    Ok(unsafe { data.read() })
}

/// Writes a result.
///
/// # Safety
/// A pointer that is neither null nor misaligned leads to memory of the caller's for one value.
#[inline]
pub(crate) unsafe fn put<T>(name: &str, place: *mut T, value: T) -> Result<(), Failure> {
    check(name, place, 1)?;
    // SAFETY: it is not null and aligned; that it may be written, the caller promises.
    unsafe { place.write(value) };
    Ok(())
}

/// Checks the place of a result before the work: so a call without one does none.
#[inline]
pub(crate) fn check_place<T>(name: &str, place: *mut T) -> Result<(), Failure> {
    check(name, place, 1)
}

/// As [`check_place`], for an array with room for so many values.
#[inline]
pub(crate) fn check_room<T>(name: &str, data: *mut T, room: usize) -> Result<(), Failure> {
    if room == 0 { Ok(()) } else { check(name, data, room) }
}

/// Writes as many values as an array of the caller's has room for, at its beginning.
///
/// # Safety
/// A pointer that is neither null nor misaligned leads to memory of the caller's for `room` values.
#[inline]
pub(crate) unsafe fn fill<T: Plain>(
    name: &str,
    data: *mut T,
    room: usize,
    values: impl IntoIterator<Item = T>,
) -> Result<(), Failure> {
    if room == 0 {
        return Ok(());
    }
    check(name, data, room)?;
    for (at, value) in values.into_iter().take(room).enumerate() {
        // SAFETY: `at` is less than `room`; the memory may hold anything before.
        unsafe { data.add(at).write(value) };
    }
    Ok(())
}

/// Writes a text, ended by 0, as much as there is room for, and its length without the end.
///
/// # Safety
/// A pointer that is not null leads to memory of the caller's for `room` bytes; as for [`put`].
pub(crate) unsafe fn put_text(
    name: &str,
    (place, room): (*mut c_char, usize),
    text: &str,
    length: *mut usize,
) -> Result<(), Failure> {
    check_place("length", length)?;
    // Not in the middle of a letter.
    let kept = (0..=text.len().min(room.saturating_sub(1))).rev().find(|&end| text.is_char_boundary(end));
    let bytes = text.as_bytes()[..kept.unwrap_or(0)].iter().chain([&0]);
    // SAFETY: the caller promises it.
    unsafe {
        fill(name, place.cast::<u8>(), room, bytes.copied())?;
        put("length", length, text.len())
    }
}
