//! The pruning rules of canonical search, shared by the indexes of many maps.
//!
//! A pruning rule depends only on k and the rules of motion, and takes a second or two to compute at k = 8.

use std::sync::{Arc, Mutex, PoisonError};

use mediant_grid::{Centers, Corners, GridGraph, Mismatch, Placement};
use mediant_moves::FiniteK;
use mediant_search::{CanonicalRule, Pruning};

/// The pruning rules of one placement that are known.
type Known<P> = Mutex<Vec<((FiniteK, <P as Placement>::Rule), Arc<CanonicalRule<P>>)>>;

/// The pruning rules of canonical search: each is computed when an index first needs it, then kept.
///
/// One value serves all maps and threads. A thread that needs a rule waits while another computes one.
#[derive(Debug, Default)]
pub struct SharedRules {
    centers: Known<Centers>,
    corners: Known<Corners>,
}

/// A placement, with its part of [`SharedRules`].
pub(crate) trait Shared: Placement {
    /// The rules of this placement.
    fn known(rules: &SharedRules) -> &Known<Self>;
}

impl Shared for Centers {
    fn known(rules: &SharedRules) -> &Known<Self> {
        &rules.centers
    }
}

impl Shared for Corners {
    fn known(rules: &SharedRules) -> &Known<Self> {
        &rules.corners
    }
}

impl SharedRules {
    /// No rules yet.
    #[must_use]
    pub const fn new() -> Self {
        Self { centers: Mutex::new(Vec::new()), corners: Mutex::new(Vec::new()) }
    }

    /// The pruning rule on a grid graph.
    pub(crate) fn pruning<P: Shared>(&self, graph: &GridGraph<P>) -> Result<Arc<Pruning<P>>, Mismatch> {
        let key = (graph.k(), graph.rule());
        let mut known = P::known(self).lock().unwrap_or_else(PoisonError::into_inner);
        let rule = match known.iter().find(|(of, _)| *of == key) {
            Some((_, rule)) => Arc::clone(rule),
            None => {
                let rule = Arc::new(CanonicalRule::new(graph.k(), graph.rule()));
                known.push((key, Arc::clone(&rule)));
                rule
            }
        };
        drop(known);
        Ok(Arc::new(Pruning::with_rule(graph, rule)?))
    }
}
