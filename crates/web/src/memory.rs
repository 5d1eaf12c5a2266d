//! Whether there is room for what is asked: where memory cannot grow, WebAssembly stops for good.

use mediant::Map;
use wasm_bindgen::JsValue;

use crate::errors::no_memory;

/// The bytes that a vertex takes at most, in a space: its component, and while components are found.
pub(crate) const SPACE: u64 = 16;
/// In an index, but for a subgoal graph's, which depends on the map.
pub(crate) const INDEX: u64 = 32;
/// In a planner.
pub(crate) const PLANNER: u64 = 32;
/// In costs of cells, and while they are read.
pub(crate) const COSTS: u64 = 32;
/// In a costmap and its costs, and while obstacles are inflated.
pub(crate) const COSTMAP: u64 = 48;
/// In a field.
pub(crate) const FIELD: u64 = 24;

/// The most vertices that a map can have.
pub(crate) fn vertices(map: &Map) -> u64 {
    (u64::from(map.width()) + 1) * (u64::from(map.height()) + 1)
}

/// Checks that there is room for what takes so many bytes for each of so many vertices.
pub(crate) fn check(what: &str, vertices: u64, bytes: u64) -> Result<(), JsValue> {
    let needed = vertices.saturating_mul(bytes);
    if needed <= never_used() {
        return Ok(());
    }
    let room = usize::try_from(needed).is_ok_and(|needed| Vec::<u8>::new().try_reserve_exact(needed).is_ok());
    if room { Ok(()) } else { Err(no_memory(what)) }
}

/// The bytes by which memory can still grow.
#[cfg(target_arch = "wasm32")]
fn never_used() -> u64 {
    const PAGE: u64 = 1 << 16;
    (1 << 32) - (core::arch::wasm32::memory_size::<0>() as u64 * PAGE)
}

#[cfg(not(target_arch = "wasm32"))]
fn never_used() -> u64 {
    u64::MAX
}
