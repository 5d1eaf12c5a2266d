//! Handles: how a program of C holds maps, planners and all else.
//!
//! A handle is the number of a place in a table, with the kind of what is there and how often the place was
//! taken. It is looked up at each call, never followed as a pointer. So one that is null, made up, freed, or
//! of another kind is found out, whatever the program did.
//!
//! Most objects never change. Their places hold an `Arc`, of which a call takes a clone: any number of
//! threads use the same object, and one may free it while another is in a call, which ends as if nothing
//! had happened. A planner is in its place itself, and locked for as long as a call uses it; so a second call
//! at the same time is an error, and nobody waits.
//!
//! A place whose count of takings is used up is not taken again.

use std::sync::{
    Arc, Mutex, MutexGuard, OnceLock, PoisonError, TryLockError,
    atomic::{AtomicU32, Ordering},
};

use crate::{code::Code, failure::Failure};

/// The kinds of objects. The numbers are parts of handles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Map = 1,
    Space,
    Index,
    Planner,
    Goals,
    Field,
    Batch,
    Bytes,
}

impl Kind {
    const fn name(self) -> &'static str {
        match self {
            Self::Map => "map",
            Self::Space => "space",
            Self::Index => "index",
            Self::Planner => "planner",
            Self::Goals => "goals",
            Self::Field => "field",
            Self::Batch => "batch",
            Self::Bytes => "bytes",
        }
    }

    /// The sentence that an object of this kind is, or was, something; names of several things take a plural.
    fn says(self, was: (&str, &str), what: &str) -> String {
        let verb = if matches!(self, Self::Goals | Self::Bytes) { was.1 } else { was.0 };
        format!("the {} {verb} {what}", self.name())
    }
}

/// Of one, and of several.
const IS: (&str, &str) = ("is", "are");
const WAS: (&str, &str) = ("was", "were");

/// An object that has a table of its kind.
pub(crate) trait Held {
    /// The content of its places: itself, or an `Arc` of it.
    type Kept: Send + 'static;

    fn handles() -> &'static Table<Self::Kept>;
}

/// The bits of a place's number, and of the count of its takings. The kind is above both.
const PLACE_BITS: u32 = 28;
const COUNT_BITS: u32 = 28;
const MOST_COUNTS: u32 = (1 << COUNT_BITS) - 1;

/// The places of the first chunk; each further one has twice as many as the one before.
const FIRST: usize = 64;
const CHUNKS: usize = (PLACE_BITS - FIRST.ilog2()) as usize;

/// The objects of one kind. Places never move: a chunk is made when all before it are taken.
pub(crate) struct Table<T> {
    kind: Kind,
    chunks: [OnceLock<Box<[Place<T>]>>; CHUNKS],
    free: Mutex<Free>,
}

/// A place, and what is there. It has a cache line of its own: threads with objects of their own do not wait
/// for one another.
#[repr(align(64))]
struct Place<T> {
    /// The count of its takings. It is looked at before the lock: so a handle that was freed does not lock
    /// the object that is there now, whose owner would be told that it is busy.
    taken: AtomicU32,
    object: Mutex<Option<T>>,
}

/// The places that can be taken.
struct Free {
    /// Places that were freed.
    freed: Vec<u32>,
    /// The number of those that were ever taken.
    taken: u32,
    /// The number of objects.
    held: usize,
}

impl<T> Table<T> {
    pub(crate) const fn new(kind: Kind) -> Self {
        let free = Free { freed: Vec::new(), taken: 0, held: 0 };
        Self { kind, chunks: [const { OnceLock::new() }; CHUNKS], free: Mutex::new(free) }
    }

    /// Keeps an object, and returns its handle.
    pub(crate) fn keep(&self, object: T) -> Result<u64, Failure> {
        let number = self.next()?;
        let place = self.place(number).ok_or_else(|| self.unknown(WAS, "never made"))?;
        let mut there = lock(&place.object);
        let count = place.taken.load(Ordering::Relaxed) + 1;
        place.taken.store(count, Ordering::Relaxed);
        *there = Some(object);
        Ok((self.kind as u64) << (PLACE_BITS + COUNT_BITS)
            | u64::from(count) << PLACE_BITS
            | u64::from(number))
    }

    /// The number of a place that nothing is in.
    fn next(&self) -> Result<u32, Failure> {
        let mut free = lock(&self.free);
        let number = match free.freed.pop() {
            Some(number) => number,
            None if (free.taken as usize) < (FIRST << CHUNKS) - FIRST => {
                let chunk = chunk_of(free.taken);
                let empty = || Place { taken: AtomicU32::new(0), object: Mutex::new(None) };
                self.chunks[chunk].get_or_init(|| (0..FIRST << chunk).map(|_| empty()).collect());
                free.taken += 1;
                free.taken - 1
            }
            None => {
                let text = format!("too many objects of the kind {}: free some", self.kind.name());
                return Err(Failure { code: Code::Memory, text });
            }
        };
        free.held += 1;
        Ok(number)
    }

    /// The place with a number, if it was ever taken.
    #[inline]
    fn place(&self, number: u32) -> Option<&Place<T>> {
        let chunk = chunk_of(number);
        self.chunks.get(chunk)?.get()?.get(number as usize + FIRST - (FIRST << chunk))
    }

    /// The place of a handle of this kind, and the count of takings that it has.
    #[inline]
    fn find(&self, handle: u64) -> Result<(&Place<T>, u32), Failure> {
        if handle >> (PLACE_BITS + COUNT_BITS) != self.kind as u64 {
            let what = if handle == 0 { "null" } else { "of another type, or made up" };
            return Err(self.unknown(IS, what));
        }
        let number = handle as u32 & ((1 << PLACE_BITS) - 1);
        let place = self.place(number).ok_or_else(|| self.unknown(WAS, "never made"))?;
        let count = (handle >> PLACE_BITS) as u32 & MOST_COUNTS;
        if place.is(count) { Ok((place, count)) } else { Err(self.unknown(WAS, "freed")) }
    }

    /// Gives an object to a call, which has it alone.
    #[inline]
    pub(crate) fn alone<R>(
        &self,
        handle: u64,
        work: impl FnOnce(&mut T) -> Result<R, Failure>,
    ) -> Result<R, Failure> {
        let (place, count) = self.find(handle)?;
        let mut there = match place.object.try_lock() {
            Ok(there) => there,
            Err(TryLockError::WouldBlock) => return Err(self.busy()),
            // A call that panicked may have left anything there.
            Err(TryLockError::Poisoned(_)) => return Err(self.broken()),
        };
        match &mut *there {
            Some(object) if place.is(count) => work(object),
            _ => Err(self.unknown(WAS, "freed")),
        }
    }

    /// Frees an object that calls have alone, unless one has it.
    pub(crate) fn free_alone(&self, handle: u64) -> Result<(), Failure> {
        let (place, count) = self.find(handle)?;
        match place.object.try_lock() {
            Ok(there) => self.empty(handle, (place, count), there),
            Err(TryLockError::WouldBlock) => Err(self.busy()),
            Err(TryLockError::Poisoned(there)) => self.empty(handle, (place, count), there.into_inner()),
        }
    }

    /// Takes an object out of its place.
    fn empty(
        &self,
        handle: u64,
        (place, count): (&Place<T>, u32),
        mut there: MutexGuard<'_, Option<T>>,
    ) -> Result<(), Failure> {
        let object = there.take_if(|_| place.is(count)).ok_or_else(|| self.unknown(WAS, "freed"))?;
        // Nobody waits for the place while the object is dropped.
        drop(there);
        drop(object);
        let mut free = lock(&self.free);
        free.held -= 1;
        if count < MOST_COUNTS && !place.object.is_poisoned() {
            free.freed.push(handle as u32 & ((1 << PLACE_BITS) - 1));
        }
        Ok(())
    }

    /// The number of objects.
    pub(crate) fn held(&self) -> usize {
        lock(&self.free).held
    }

    #[cold]
    fn unknown(&self, was: (&str, &str), what: &str) -> Failure {
        Failure { code: Code::Handle, text: self.kind.says(was, what) }
    }

    #[cold]
    fn busy(&self) -> Failure {
        let text = format!("the {} is used by another call: each thread needs its own", self.kind.name());
        Failure { code: Code::Busy, text }
    }

    #[cold]
    fn broken(&self) -> Failure {
        let text = format!("the {} broke in an earlier call: free it", self.kind.name());
        Failure { code: Code::Other, text }
    }
}

impl<T> Table<Arc<T>> {
    /// Keeps an object that never changes.
    pub(crate) fn share(&self, object: T) -> Result<u64, Failure> {
        self.keep(Arc::new(object))
    }

    /// The object of a handle.
    #[inline]
    pub(crate) fn get(&self, handle: u64) -> Result<Arc<T>, Failure> {
        let (place, count) = self.find(handle)?;
        match &*lock(&place.object) {
            Some(object) if place.is(count) => Ok(Arc::clone(object)),
            _ => Err(self.unknown(WAS, "freed")),
        }
    }

    /// Frees a handle. It waits for calls that look it up, each of which takes a moment.
    pub(crate) fn free(&self, handle: u64) -> Result<(), Failure> {
        let (place, count) = self.find(handle)?;
        self.empty(handle, (place, count), lock(&place.object))
    }
}

impl<T> Place<T> {
    /// Whether a handle with this count is that of what is there. The count changes only under the lock.
    #[inline]
    fn is(&self, count: u32) -> bool {
        self.taken.load(Ordering::Relaxed) == count
    }
}

/// Chunk c holds the places from FIRST · (2^c − 1) on.
const fn chunk_of(number: u32) -> usize {
    ((number as usize + FIRST).ilog2() - FIRST.ilog2()) as usize
}

/// Nothing that is locked for a moment only can be left half done.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use std::panic::{AssertUnwindSafe, catch_unwind};

    use super::*;

    const PLACE: u64 = (1 << PLACE_BITS) - 1;

    #[test]
    fn place_whose_count_is_used_up_is_not_taken_again() {
        let table: Table<Arc<u8>> = Table::new(Kind::Bytes);
        let first = table.share(1).unwrap();
        table.free(first).unwrap();
        let again = table.share(2).unwrap();
        assert!(again & PLACE == first & PLACE && again != first);
        table.free(again).unwrap();
        table.place(0).unwrap().taken.store(MOST_COUNTS - 1, Ordering::Relaxed);
        let last = table.share(3).unwrap();
        assert!(last & PLACE == first & PLACE && *table.get(last).unwrap() == 3);
        table.free(last).unwrap();
        let next = table.share(4).unwrap();
        assert!(next & PLACE != first & PLACE && *table.get(next).unwrap() == 4);
        assert!([first, again, last].iter().all(|&old| table.get(old).unwrap_err().code == Code::Handle));
        assert_eq!(table.held(), 1);
    }

    #[test]
    fn object_that_broke_can_only_be_freed() {
        let table: Table<u8> = Table::new(Kind::Planner);
        let handle = table.keep(1).unwrap();
        let broke =
            catch_unwind(AssertUnwindSafe(|| table.alone(handle, |_| -> Result<(), _> { panic!("broke") })));
        assert!(broke.is_err());
        assert_eq!(table.alone(handle, |_| Ok(())).unwrap_err().code, Code::Other);
        table.free_alone(handle).unwrap();
        assert_eq!(table.free_alone(handle).unwrap_err().code, Code::Handle);
        let next = table.keep(2).unwrap();
        assert!(next & PLACE != handle & PLACE);
        assert!(table.alone(next, |object| Ok(*object == 2)).unwrap());
        assert_eq!(table.held(), 1);
    }

    #[test]
    fn chunks_hold_all_places_in_order() {
        let table: Table<Arc<usize>> = Table::new(Kind::Map);
        // Of three chunks; Miri takes long for each.
        let count = if cfg!(miri) { 200 } else { 1000 };
        let handles: Vec<u64> = (0..count).map(|number| table.share(number).unwrap()).collect();
        for (number, &handle) in handles.iter().enumerate() {
            assert!(handle & PLACE == number as u64 && *table.get(handle).unwrap() == number);
        }
        assert!(table.place(u32::MAX >> (32 - PLACE_BITS)).is_none());
    }
}
