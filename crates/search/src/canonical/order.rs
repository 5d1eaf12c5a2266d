//! The order of the moves, and which of them follow one another on open ground.

/// The rank of a move as the last one of a path: even indices first, then by index. Of two equally cheap
/// paths to a vertex, the one whose last move has the lower rank is the earlier one.
pub(crate) const fn rank(index: usize) -> usize {
    (index & 1) << 16 | index
}

/// The natural successors of move `a` among `count` moves: those that follow it on open ground.
pub(crate) fn natural(a: usize, count: usize) -> impl Iterator<Item = usize> {
    let spread = a & 1;
    (count - spread..=count + spread).map(move |offset| (a + offset) % count)
}
