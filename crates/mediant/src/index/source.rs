//! How an index is made: anew, beside one for another k, or from its bytes.

use mediant_subgoal::Progress;

use super::parts::Prepared;

/// What an index is made from, besides the setup and the space.
#[derive(Clone, Copy)]
pub(super) struct Source<'a> {
    /// The bytes of a saved index; `None` to prepare a new one.
    pub(super) bytes: Option<&'a [u8]>,
    /// What is prepared for another k of the same map and rules, to share what does not depend on k.
    pub(super) beside: Option<&'a Prepared>,
    /// Hears how far the preparation is, on any thread.
    pub(super) progress: &'a (dyn Fn(Progress) + Sync),
}
