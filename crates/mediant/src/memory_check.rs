//! Whether there is room for what takes much memory.

use crate::error::Error;

/// Checks that there is so much memory, by asking for it. (Another thread may take it before it is used.)
pub(crate) fn check(what: &'static str, bytes: u64) -> Result<(), Error> {
    if has_room(bytes) { Ok(()) } else { Err(Error::OutOfMemory { what, bytes }) }
}

/// The items of an iterator in a list, as long as there is room for them.
pub(crate) fn collected<T>(what: &'static str, items: impl IntoIterator<Item = T>) -> Result<Vec<T>, Error> {
    let items = items.into_iter();
    let mut list = Vec::new();
    let refused = |count: usize| {
        let bytes = count.saturating_mul(size_of::<T>()) as u64;
        move |_| Error::OutOfMemory { what, bytes }
    };
    let count = items.size_hint().0;
    list.try_reserve_exact(count).map_err(refused(count))?;
    for item in items {
        if list.len() == list.capacity() {
            list.try_reserve(1).map_err(refused(list.len() + 1))?;
        }
        list.push(item);
    }
    Ok(list)
}

/// [`check`] for numbers of cells.
#[cfg(feature = "costs")]
pub(crate) fn check_cells(size: (u32, u32), each: u64) -> Result<(), Error> {
    let bytes = (u64::from(size.0) * u64::from(size.1)).saturating_mul(each);
    if has_room(bytes) { Ok(()) } else { Err(Error::NoRoom { size, bytes }) }
}

fn has_room(bytes: u64) -> bool {
    usize::try_from(bytes).is_ok_and(mediant_grid::has_room)
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
