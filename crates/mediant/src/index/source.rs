//! How an index is made: anew, beside one for another k, or from its bytes.

use mediant_grid::Interrupt;
use mediant_subgoal::Progress;

use super::parts::Prepared;
use crate::within::NEVER;

/// The bytes or the other index that an index is made from, besides setup and space, with its progress and
/// interrupt.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    /// The bytes of a saved index; `None` to prepare a new one.
    pub(crate) bytes: Option<&'a [u8]>,
    /// The parts for another k of the same map and rules; those that do not depend on k are shared.
    pub(crate) beside: Option<&'a Prepared>,
    /// Whether it is for a single path: what takes longer than it saves one is left out.
    pub(crate) for_one_path: bool,
    /// Hears how far the preparation is, on any thread.
    pub(crate) progress: &'a (dyn Fn(Progress) + Sync),
    /// Stops the preparation.
    pub(crate) interrupt: &'a Interrupt,
}

impl<'a> Source<'a> {
    /// To prepare a new index, beside no other.
    pub(crate) fn new(progress: &'a (dyn Fn(Progress) + Sync)) -> Self {
        Self { bytes: None, beside: None, for_one_path: false, progress, interrupt: &NEVER }
    }
}
