//! Whether there is room for what takes much memory.

use crate::error::Error;

/// Checks that there is so much memory, by asking for it. (Another thread may take it before it is used.)
pub(crate) fn check(what: &'static str, bytes: u64) -> Result<(), Error> {
    if has_room(bytes) { Ok(()) } else { Err(Error::OutOfMemory { what, bytes }) }
}

/// [`check`] for numbers of cells.
#[cfg(feature = "costs")]
pub(crate) fn check_cells(size: (u32, u32), each: u64) -> Result<(), Error> {
    let bytes = (u64::from(size.0) * u64::from(size.1)).saturating_mul(each);
    if has_room(bytes) { Ok(()) } else { Err(Error::NoRoom { size, bytes }) }
}

fn has_room(bytes: u64) -> bool {
    usize::try_from(bytes).is_ok_and(|bytes| Vec::<u8>::new().try_reserve_exact(bytes).is_ok())
}

#[cfg(all(test, feature = "costs"))]
mod tests {
    use super::*;
    use crate::code::ErrorCode;

    #[test]
    fn numbers_without_room_are_refused_by_their_size() {
        assert!(check_cells((100_000, 300), 5).is_ok());
        let error = check_cells((1 << 20, 4000), 1 << 40).expect_err("more than there is");
        let text = error.to_string();
        assert_eq!(error.code(), ErrorCode::Memory, "{text}");
        assert!(text.contains("1048576 × 4000 cells") && text.contains("cut the raster"), "{text}");
    }
}
