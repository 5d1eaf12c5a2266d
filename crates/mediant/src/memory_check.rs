//! Whether there is room for what takes much memory.

use crate::error::Error;

/// Checks that there is so much memory, by asking for it. (Another thread may take it before it is used.)
pub(crate) fn check(what: &'static str, bytes: u64) -> Result<(), Error> {
    let room = usize::try_from(bytes).is_ok_and(|bytes| Vec::<u8>::new().try_reserve_exact(bytes).is_ok());
    if room { Ok(()) } else { Err(Error::OutOfMemory { what, bytes }) }
}
