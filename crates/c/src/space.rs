//! Spaces: maps with rules of motion.

#![allow(unsafe_code, reason = "functions of C")]

use std::{ffi::c_char, sync::Arc};

use library::{Ground, Limits, Path, Space};

use crate::{
    code::Code,
    failure::{Failure, call},
    handles::{Held, Kind, Table},
    map::MapHandle,
    memory,
    points::{self, Point},
    words,
};

/// A map with rules of motion: what is searched. It never changes; any number of threads may use it. `{0}`
/// is no space.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct SpaceHandle {
    /// Its number.
    pub id: u64,
}

impl Held for Space {
    type Kept = Arc<Self>;

    fn handles() -> &'static Table<Arc<Self>> {
        static HANDLES: Table<Arc<Space>> = Table::new(Kind::Space);
        &HANDLES
    }
}

impl SpaceHandle {
    /// Keeps a space, and writes its handle.
    ///
    /// # Safety
    /// As for [`memory::put`].
    pub(crate) unsafe fn put(space: Space, place: *mut Self) -> Result<(), Failure> {
        memory::check_place("space", place)?;
        let id = Space::handles().share(space)?;
        // SAFETY: the caller promises it.
        unsafe { memory::put("space", place, Self { id }) }
    }
}

/// A map with rules of motion: `motion` has the parameters `k` or `neighbors`, `placement`, `corners`, `gap`,
/// as in `"k=any gap=closed"`. Null is eight directions between the centers of cells, without cutting
/// corners.
///
/// # Safety
/// `motion` is a text or null; `space` leads to a handle's memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_space_new(
    map: MapHandle,
    motion: *const c_char,
    space: *mut SpaceHandle,
) -> Code {
    call(|| {
        let ground = Ground::handles().get(map.id)?;
        // SAFETY: the caller promises it.
        let motion = unsafe { words::read("motion", motion, words::MOTION) }?.motion()?;
        // SAFETY: as above.
        unsafe { SpaceHandle::put(ground.keep_space(motion, Limits::new())?, space) }
    })
}

/// Frees a space. What was made of it stays.
#[unsafe(no_mangle)]
pub extern "C" fn mediant_space_free(space: SpaceHandle) -> Code {
    call(|| Space::handles().free(space.id))
}

/// Whether a path may stand on a point: 1 or 0.
///
/// # Safety
/// `free` leads to memory for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_space_is_free(space: SpaceHandle, at: Point, free: *mut i32) -> Code {
    call(|| {
        let is_free = Space::handles().get(space.id)?.is_free(at.inner("at")?);
        // SAFETY: the caller promises it.
        unsafe { memory::put("free", free, i32::from(is_free)) }
    })
}

/// Whether there is a path between two points: 1 or 0, in constant time.
///
/// # Safety
/// `connected` leads to memory for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_space_connected(
    space: SpaceHandle,
    from: Point,
    to: Point,
    connected: *mut i32,
) -> Code {
    call(|| {
        let space = Space::handles().get(space.id)?;
        let is_connected = space.connected(from.inner("from")?, to.inner("to")?);
        // SAFETY: the caller promises it.
        unsafe { memory::put("connected", connected, i32::from(is_connected)) }
    })
}

/// Whether the straight segment between two points obeys the rules of motion: 1 or 0. It is judged for
/// itself: a closed gap that it passes is in its way, one at which it begins or ends is not.
///
/// # Safety
/// `seen` leads to memory for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_space_sees(
    space: SpaceHandle,
    from: Point,
    to: Point,
    seen: *mut i32,
) -> Code {
    call(|| {
        let space = Space::handles().get(space.id)?;
        let sees = space.sees(from.inner("from")?, to.inner("to")?);
        // SAFETY: the caller promises it.
        unsafe { memory::put("seen", seen, i32::from(sees)) }
    })
}

/// Checks whether a path obeys the rules of motion, at any angle: so whether it still holds after an edit. If
/// it does not, the code is `MEDIANT_CODE_BROKEN_PATH`, and the message names the segment and the first
/// blocked cell on it.
///
/// # Safety
/// `points` leads to `count` points.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_space_check(space: SpaceHandle, points: *const Point, count: usize) -> Code {
    call(|| {
        let space = Space::handles().get(space.id)?;
        // SAFETY: the caller promises it.
        let path: Path = unsafe { points::path(points, count) }?;
        let broken = |error| Failure { code: Code::BrokenPath, text: format!("{error}") };
        space.check(&path).map_err(broken)
    })
}
