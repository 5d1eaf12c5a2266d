//! Indexes: what an engine prepares of a space.

#![allow(unsafe_code, reason = "functions of C")]

use std::{
    collections::HashMap,
    ffi::{CString, c_char},
    sync::{Arc, OnceLock},
};

use library::{Change, Demand, Engine, Ground, Guarantee, Index, Space, search::Progress};

use crate::{
    bytes::BytesHandle,
    code::Code,
    failure::{Failure, call},
    handles::{Held, Kind, Table},
    map::MapHandle,
    memory,
    space::SpaceHandle,
    watch::{Watch, Watcher},
    words,
};

/// A space, prepared for an engine. It never changes; any number of threads may use it. `{0}` is no index.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct IndexHandle {
    /// Its number.
    pub id: u64,
}

impl Held for Index {
    type Kept = Arc<Self>;

    fn handles() -> &'static Table<Arc<Self>> {
        static HANDLES: Table<Arc<Index>> = Table::new(Kind::Index);
        &HANDLES
    }
}

impl IndexHandle {
    /// Keeps an index, and writes its handle.
    ///
    /// # Safety
    /// As for [`memory::put`].
    unsafe fn put(index: Index, place: *mut Self) -> Result<(), Failure> {
        memory::check_place("index", place)?;
        let id = Index::handles().share(index)?;
        // SAFETY: the caller promises it.
        unsafe { memory::put("index", place, Self { id }) }
    }
}

/// The name of an engine, which stays for ever.
pub(crate) fn static_name(engine: Engine) -> Result<*const c_char, Failure> {
    static NAMES: OnceLock<HashMap<&'static str, CString>> = OnceLock::new();
    let named = |engine: &Engine| Some((engine.name(), CString::new(engine.name()).ok()?));
    let names = NAMES.get_or_init(|| Engine::ALL.iter().filter_map(named).collect());
    let name = names.get(engine.name()).map(|name| name.as_ptr());
    name.ok_or_else(|| Failure { code: Code::Other, text: "an engine without a name".to_owned() })
}

/// Prepares an index for many paths. `engine` has the parameters `engine`, its options, and `smooth`, as in
/// `"engine=subgoal memory=100MB"`; null is the best engine for what the space is. The watcher is told how
/// far each stage is.
///
/// # Safety
/// `engine` is a text or null; `watcher` is null or leads to one; `index` leads to a handle's memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_index_prepare(
    space: SpaceHandle,
    engine: *const c_char,
    watcher: *const Watcher,
    index: *mut IndexHandle,
) -> Code {
    call(|| {
        memory::check_place("index", index)?;
        let space = Space::handles().get(space.id)?;
        // SAFETY: the caller promises it.
        let (call, watch) =
            unsafe { (words::read("engine", engine, words::PREPARATION)?, Watch::read(watcher)?) };
        let (setup, _) = space.setup(&call, Demand::Paths(u64::MAX))?;
        let tell = |Progress { done, total, .. }: Progress| watch.tell(done, total);
        let made = space.within(words::limits(&watch)).prepare_with_progress(setup.engine, &tell);
        let made = made.map_err(|error| watch.failure(error))?;
        // SAFETY: as above.
        unsafe { IndexHandle::put(made.with_smoothing(setup.smoothing), index) }
    })
}

/// Reads an index that `mediant_index_save` wrote, of the same map. `options` are those of its engine; null
/// is as it was prepared.
///
/// # Safety
/// `path` is a text, `options` one or null; `index` leads to a handle's memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_index_load(
    map: MapHandle,
    path: *const c_char,
    options: *const c_char,
    index: *mut IndexHandle,
) -> Code {
    call(|| {
        let ground = Ground::handles().get(map.id)?;
        // SAFETY: the caller promises it.
        let (path, call) =
            unsafe { (memory::text("path", path)?, words::read("options", options, words::OPTIONS)?) };
        let path = path.ok_or_else(|| Failure::argument("path", "it is null"))?;
        let loaded = ground.load(path, library::Limits::new())?;
        let loaded = if call.has_options() { loaded.with_call(&call)? } else { loaded };
        // SAFETY: as above.
        unsafe { IndexHandle::put(loaded, index) }
    })
}

/// The index of bytes that `mediant_index_to_bytes` gave, of the same map.
///
/// # Safety
/// `bytes` leads to `size` bytes; `options` is a text or null; `index` leads to a handle's memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_index_from_bytes(
    map: MapHandle,
    bytes: *const u8,
    size: usize,
    options: *const c_char,
    index: *mut IndexHandle,
) -> Code {
    call(|| {
        let ground = Ground::handles().get(map.id)?;
        // SAFETY: the caller promises it.
        let (bytes, call) = unsafe {
            (memory::array("bytes", bytes, size)?, words::read("options", options, words::OPTIONS)?)
        };
        let read = ground.index_from_bytes(bytes.to_vec(), library::Limits::new())?;
        let read = if call.has_options() { read.with_call(&call)? } else { read };
        // SAFETY: as above.
        unsafe { IndexHandle::put(read, index) }
    })
}

/// Writes an index to a file. The file is whole or not there.
///
/// # Safety
/// `path` is a text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_index_save(index: IndexHandle, path: *const c_char) -> Code {
    call(|| {
        let index = Index::handles().get(index.id)?;
        // SAFETY: the caller promises it.
        let path = unsafe { memory::text("path", path) }?;
        Ok(index.save(path.ok_or_else(|| Failure::argument("path", "it is null"))?)?)
    })
}

/// The index as bytes.
///
/// # Safety
/// `bytes` leads to a handle's memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_index_to_bytes(index: IndexHandle, bytes: *mut BytesHandle) -> Code {
    call(|| {
        let index = Index::handles().get(index.id)?;
        // SAFETY: the caller promises it.
        unsafe { BytesHandle::put(index.to_bytes()?, bytes) }
    })
}

/// Frees an index. Its planners stay.
#[unsafe(no_mangle)]
pub extern "C" fn mediant_index_free(index: IndexHandle) -> Code {
    call(|| Index::handles().free(index.id))
}

/// The index for a changed map of the same motion, repaired by work that follows the difference of the maps.
/// This index stays as it is.
///
/// # Safety
/// `repaired` leads to a handle's memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_index_repair(
    index: IndexHandle,
    space: SpaceHandle,
    repaired: *mut IndexHandle,
) -> Code {
    call(|| {
        let (index, space) = (Index::handles().get(index.id)?, Space::handles().get(space.id)?);
        let change = Change::between(index.space(), &space)?;
        // SAFETY: the caller promises it.
        unsafe { IndexHandle::put(index.repair(&change)?, repaired) }
    })
}

/// This index with all that a repair left made anew, which takes as long as to prepare it: do it after some
/// edits, in another thread.
///
/// # Safety
/// `watcher` is null or leads to one; `finished` leads to a handle's memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_index_finish(
    index: IndexHandle,
    watcher: *const Watcher,
    finished: *mut IndexHandle,
) -> Code {
    call(|| {
        let index = Index::handles().get(index.id)?;
        // SAFETY: the caller promises it.
        let watch = unsafe { Watch::read(watcher) }?;
        let made = index.within(words::limits(&watch)).finish().map_err(|error| watch.failure(error))?;
        // SAFETY: as above.
        unsafe { IndexHandle::put(made, finished) }
    })
}

/// The space of an index, such as of one that was loaded: another handle of the same space. Threads that look
/// up one handle wait for one another, for a moment each; with one of its own a thread does not.
///
/// # Safety
/// `space` leads to a handle's memory.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_index_space(index: IndexHandle, space: *mut SpaceHandle) -> Code {
    call(|| {
        let index = Index::handles().get(index.id)?;
        // SAFETY: the caller promises it.
        unsafe { SpaceHandle::put(index.space().clone(), space) }
    })
}

/// Whether nothing of an index is that of an earlier map: 1 or 0.
///
/// # Safety
/// `finished` leads to memory for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_index_is_finished(index: IndexHandle, finished: *mut i32) -> Code {
    call(|| {
        let is_finished = Index::handles().get(index.id)?.is_finished();
        // SAFETY: the caller promises it.
        unsafe { memory::put("finished", finished, i32::from(is_finished)) }
    })
}

/// The memory that an index takes beyond its space, in bytes.
///
/// # Safety
/// `bytes` leads to memory for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_index_memory(index: IndexHandle, bytes: *mut u64) -> Code {
    call(|| {
        let memory = Index::handles().get(index.id)?.memory_bytes();
        // SAFETY: the caller promises it.
        unsafe { memory::put("bytes", bytes, memory) }
    })
}

/// The engine, motion and options of an index as a text, ended by 0: as much as there is room for, always
/// ended; and its whole length without the end.
///
/// # Safety
/// `text` leads to memory for `room` bytes; `length` leads to memory for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_index_setup(
    index: IndexHandle,
    text: *mut c_char,
    room: usize,
    length: *mut usize,
) -> Code {
    call(|| {
        let setup = Index::handles().get(index.id)?.setup().to_string();
        // SAFETY: the caller promises it.
        unsafe { memory::put_text("text", (text, room), &setup, length) }
    })
}

/// The bound of an index: its paths over the shortest at any angle, at most. 1.08 is 8 %. NaN where no
/// bound is proven.
///
/// # Safety
/// `bound` leads to memory for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_index_bound(index: IndexHandle, bound: *mut f64) -> Code {
    call(|| {
        let index = Index::handles().get(index.id)?;
        let guarantee = match index.setup().guarantee() {
            Guarantee::Optimal(k) if index.space().costs().is_some() => Guarantee::Cheapest(k),
            guarantee => guarantee,
        };
        let known = guarantee.bound(index.setup().rules());
        // SAFETY: the caller promises it.
        unsafe { memory::put("bound", bound, known.unwrap_or(f64::NAN)) }
    })
}
