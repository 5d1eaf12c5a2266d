//! The library itself: its version, its words, the mathematics of the neighborhoods.

#![allow(unsafe_code, reason = "functions of C")]

use std::ffi::c_char;

use library::{
    Goals, Ground, Guarantee, Index, K, Space,
    moves::{FiniteK, Neighborhood},
};

use crate::{
    batch::Batch, code::Code, failure::call, field::OfSpace, handles::Held, memory, planner::State,
    points::Cell, words,
};

/// The version of the library, as `0.1.0`. It stays for ever.
#[unsafe(no_mangle)]
pub extern "C" fn mediant_version() -> *const c_char {
    const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), "\0");
    VERSION.as_ptr().cast()
}

/// The first number of the version that this header is of.
pub const VERSION_MAJOR: u32 = 0;

/// The second number of the version that this header is of.
pub const VERSION_MINOR: u32 = 1;

/// The third number of the version that this header is of.
pub const VERSION_PATCH: u32 = 0;

/// The number of the interface that this header describes. It is another one as soon as something of it is
/// changed or goes; what is added leaves it.
pub const INTERFACE: u32 = 1;

/// The number of the interface that the library has. Where it is not `MEDIANT_INTERFACE`, the program was
/// compiled against another one, and must not call anything but this and `mediant_version`.
#[unsafe(no_mangle)]
pub extern "C" fn mediant_interface() -> u32 {
    INTERFACE
}

/// The number of objects that were made and not freed, of all kinds: for tests that nothing is forgotten.
#[unsafe(no_mangle)]
pub extern "C" fn mediant_objects() -> usize {
    [
        Ground::handles().held(),
        Space::handles().held(),
        Index::handles().held(),
        State::handles().held(),
        Goals::handles().held(),
        OfSpace::handles().held(),
        Batch::handles().held(),
        Vec::<u8>::handles().held(),
    ]
    .iter()
    .sum()
}

/// The moves of N(k), clockwise from (0, 1): as many as there is room for, and how many there are: 2^k.
///
/// # Safety
/// `moves` leads to memory for `room` cells; `count` leads to memory for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_moves(k: u32, moves: *mut Cell, room: usize, count: *mut usize) -> Code {
    call(|| {
        memory::check_place("count", count)?;
        let all = Neighborhood::new(FiniteK::new(k)?)?;
        let vectors = (0..all.len()).filter_map(|index| all.get(index)).map(|v| Cell { x: v.x, y: v.y });
        // SAFETY: the caller promises it.
        unsafe {
            memory::fill("moves", moves, room, vectors)?;
            memory::put("count", count, all.len() as usize)
        }
    })
}

/// The bound of a motion: its shortest paths over the shortest at any angle, at most. 1.08 is 8 %. NaN
/// where no bound is proven.
///
/// # Safety
/// `motion` is a text or null; `bound` leads to memory for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_bound(motion: *const c_char, bound: *mut f64) -> Code {
    call(|| {
        // SAFETY: the caller promises it.
        let motion = unsafe { words::read("motion", motion, words::MOTION) }?.motion()?;
        let guarantee = match motion.k {
            K::Finite(k) => Guarantee::Optimal(k),
            K::Any => Guarantee::OptimalAnyAngle,
        };
        // SAFETY: as above.
        unsafe { memory::put("bound", bound, guarantee.bound(motion.rules).unwrap_or(f64::NAN)) }
    })
}
