//! Memory that is filled in pieces: all of a large map's at once takes some hundred milliseconds.

use mediant_grid::{Interrupt, Interrupted, room_for};

/// The values that are written between two questions of an interrupt.
const PIECE: usize = 1 << 18;

/// So many copies of a value.
pub(crate) fn filled<T: Copy>(value: T, count: usize, interrupt: &Interrupt) -> Result<Vec<T>, Interrupted> {
    room_for::<T>(count, "filling memory")?;
    let mut values = Vec::with_capacity(count);
    while values.len() < count {
        interrupt.check("filling memory")?;
        values.resize(count.min(values.len() + PIECE), value);
    }
    Ok(values)
}

/// Writes a value over all others.
pub(crate) fn refill<T: Copy>(values: &mut [T], value: T, interrupt: &Interrupt) -> Result<(), Interrupted> {
    for piece in values.chunks_mut(PIECE) {
        interrupt.check("filling memory")?;
        piece.fill(value);
    }
    Ok(())
}
