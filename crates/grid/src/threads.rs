//! Whether work can be shared among threads, with the feature `parallel`.

use std::{error::Error, sync::OnceLock};

use rayon::ThreadPoolBuilder;

/// Whether rayon's current pool has threads. The first call outside any pool starts those of the global pool,
/// if nobody else did. Where the system refuses them, the caller does all its work by itself from then on:
/// rayon would panic, and makes no second attempt.
#[must_use]
pub fn are_there() -> bool {
    static GLOBAL: OnceLock<bool> = OnceLock::new();
    // Inside a pool the threads are running.
    rayon::current_thread_index().is_some() || *GLOBAL.get_or_init(start)
}

/// Starts the global pool, unless it runs.
fn start() -> bool {
    match ThreadPoolBuilder::new().build_global() {
        Ok(()) => true,
        // Without a source the error says that the pool was there before; the system's errors are sources.
        Err(error) => error.source().is_none(),
    }
}
