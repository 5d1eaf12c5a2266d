//! How an index is made: anew, or from its bytes.

use mediant_grid::Interrupt;
use mediant_subgoal::Progress;

use crate::never::NEVER;

/// The sources of an index besides the setup and the space.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    /// The bytes of a saved index; `None` to prepare a new one.
    pub(crate) bytes: Option<&'a [u8]>,
    /// Whether it is for a single path: what takes longer than it saves one is left out.
    pub(crate) for_one_path: bool,
    /// Whether it is for a map that has changed before: what helps to follow further edits is made, too.
    pub(crate) for_changes: bool,
    /// Hears how far the preparation is, on any thread.
    pub(crate) progress: &'a (dyn Fn(Progress) + Sync),
    /// Stops the preparation.
    pub(crate) interrupt: &'a Interrupt,
}

impl<'a> Source<'a> {
    /// To prepare a new index.
    pub(crate) fn new(progress: &'a (dyn Fn(Progress) + Sync)) -> Self {
        Self { bytes: None, for_one_path: false, for_changes: false, progress, interrupt: &NEVER }
    }
}
