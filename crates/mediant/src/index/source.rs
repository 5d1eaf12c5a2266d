//! How an index is made: anew, or from its bytes.

use mediant_subgoal::Progress;

use crate::shared_rules::SharedRules;

/// What an index is made from, besides the setup and the search space.
#[derive(Clone, Copy)]
pub(super) struct Source<'a> {
    /// The bytes of a saved index; `None` to prepare a new one.
    pub(super) bytes: Option<&'a [u8]>,
    /// The pruning rules.
    pub(super) rules: &'a SharedRules,
    /// Hears how far the preparation is, on any thread.
    pub(super) progress: &'a (dyn Fn(Progress) + Sync),
}
