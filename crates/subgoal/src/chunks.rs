//! Work on all subgoals, in chunks: on all cores with the feature `parallel`, with the same result.

use std::{
    ops::Range,
    sync::{
        Mutex, PoisonError,
        atomic::{AtomicUsize, Ordering},
    },
};

use mediant_grid::{Interrupted, room_for};

/// Subgoals that one thread handles at a time.
const CHUNK: usize = 64;
/// The memory that is asked for before a chunk: its results are many small pieces.
const AHEAD: usize = 1 << 18;

/// The results of `work` on each chunk of the numbers below `count`, in order; an error of one ends it.
pub(crate) fn in_chunks<S, T: Send>(
    count: usize,
    scratch: impl Fn() -> S + Send + Sync,
    progress: &(impl Fn(usize) + Sync),
    work: impl Fn(&mut S, Range<u32>) -> Result<T, Interrupted> + Send + Sync,
) -> Result<Vec<T>, Interrupted> {
    let done = AtomicUsize::new(0);
    let chunk = |scratch: &mut S, chunk: usize| {
        room_for::<u8>(AHEAD, "preparing subgoals")?;
        let ids = chunk * CHUNK..count.min((chunk + 1) * CHUNK);
        let made = work(scratch, ids.start as u32..ids.end as u32)?;
        progress(done.fetch_add(ids.len(), Ordering::Relaxed) + ids.len());
        Ok(made)
    };
    let chunks = 0..count.div_ceil(CHUNK);
    #[cfg(feature = "parallel")]
    if mediant_grid::threads::are_there() {
        use rayon::prelude::*;
        return chunks.into_par_iter().map_init(scratch, chunk).collect();
    }
    let mut scratch = scratch();
    chunks.map(|number| chunk(&mut scratch, number)).collect()
}

/// Scratch memory that threads borrow, one each.
pub(crate) struct Pool<S>(Mutex<Vec<S>>);

impl<S> Default for Pool<S> {
    fn default() -> Self {
        Self(Mutex::new(Vec::new()))
    }
}

impl<S> Pool<S> {
    /// Lends scratch memory, which is made if none is left.
    pub(crate) fn lend<T>(&self, new: impl FnOnce() -> S, work: impl FnOnce(&mut S) -> T) -> T {
        let spare = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let known = spare().pop();
        let mut scratch = known.unwrap_or_else(new);
        let done = work(&mut scratch);
        spare().push(scratch);
        done
    }
}
