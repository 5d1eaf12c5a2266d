//! The pruning rules of canonical search. One depends on k and the rules of motion only, and takes a second or two to
//! make at k = 8, so that the indexes of many maps share it.

use std::sync::{Arc, Mutex, PoisonError};

use mediant_grid::{Centers, Corners, GridGraph, Placement};
use mediant_moves::FiniteK;
use mediant_search::{CanonicalRule, Pruning};

/// The rules of one placement that were asked for.
type Known<P> = Mutex<Vec<((FiniteK, <P as Placement>::Rule), Arc<CanonicalRule<P>>)>>;

/// The pruning rules that were asked for, each made once.
#[derive(Debug, Default)]
pub struct SharedRules {
    centers: Known<Centers>,
    corners: Known<Corners>,
}

/// A placement of which there are shared rules.
pub(crate) trait Shared: Placement {
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
    /// None yet.
    #[must_use]
    pub const fn new() -> Self {
        Self { centers: Mutex::new(Vec::new()), corners: Mutex::new(Vec::new()) }
    }

    /// The pruning of canonical search on a grid graph.
    pub(crate) fn pruning<P: Shared>(&self, graph: &GridGraph<P>) -> Arc<Pruning<P>> {
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
        Arc::new(Pruning::with_rule(graph, rule))
    }
}
