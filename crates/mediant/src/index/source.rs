//! How an index is made: anew, or from its bytes.

use mediant_subgoal::Progress;

/// What an index is made from, besides the setup and the space.
#[derive(Clone, Copy)]
pub(super) struct Source<'a> {
    /// The bytes of a saved index; `None` to prepare a new one.
    pub(super) bytes: Option<&'a [u8]>,
    /// Hears how far the preparation is, on any thread.
    pub(super) progress: &'a (dyn Fn(Progress) + Sync),
}
