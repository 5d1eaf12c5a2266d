//! The pruning rules of canonical search, shared by the indexes of all maps.
//!
//! A pruning rule depends only on k and the rules of motion, and takes a second or two to compute at k = 8.
//! So each is computed when an index first needs it, and kept as long as the process lives, as the tables of
//! search graphs are.

use std::sync::Arc;

use mediant_grid::{Centers, Corners, GridGraph, Interrupt, PerMotion, Placement};
use mediant_moves::FiniteK;
use mediant_search::{CanonicalRule, Pruning};

use crate::{change::Change, error::Error};

/// The pruning rules of one placement that were asked for.
pub(crate) type Known<P> = PerMotion<Arc<CanonicalRule<P>>>;

static CENTERS: Known<Centers> = PerMotion::new();
static CORNERS: Known<Corners> = PerMotion::new();

/// A placement whose pruning rules are shared.
pub(crate) trait Shared: Placement {
    /// The rules of this placement.
    fn known() -> &'static Known<Self>;
}

impl Shared for Centers {
    fn known() -> &'static Known<Self> {
        &CENTERS
    }
}

impl Shared for Corners {
    fn known() -> &'static Known<Self> {
        &CORNERS
    }
}

/// The pruning rule on a grid graph. Where an interrupt may stop it, it does not wait while another thread
/// computes the same.
pub(crate) fn pruning<P: Shared>(
    graph: &GridGraph<P>,
    interrupt: &Interrupt,
) -> Result<Arc<Pruning<P>>, Error> {
    let (k, rules) = (graph.k(), graph.rules());
    let rule = if interrupt.is_never() {
        P::known().get(rules, k, || Arc::new(CanonicalRule::new(k, graph.rule())))?
    } else {
        P::known().get_or_stop(rules, k, || {
            CanonicalRule::interruptible(k, graph.rule(), interrupt).map(Arc::new)
        })??
    };
    Ok(Arc::new(Pruning::with_rule_interruptible(graph, Arc::clone(rule), interrupt)??))
}

/// The pruning rule on the grid graph after a change; `None` if it must be made anew. The light build leaves
/// out how the tables of the map follow that a rule has above k = 3.
pub(crate) fn repaired<P: Shared>(
    pruning: &Pruning<P>,
    graph: &GridGraph<P>,
    change: &Change,
    interrupt: &Interrupt,
) -> Result<Option<Arc<Pruning<P>>>, Error> {
    if cfg!(feature = "all-engines") {
        return Ok(Some(Arc::new(pruning.repaired(graph, change.of_grid(), interrupt)??)));
    }
    (graph.k() <= FiniteK::N8).then(|| self::pruning(graph, interrupt)).transpose()
}
