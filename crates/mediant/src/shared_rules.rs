//! The pruning rules of canonical search, shared by the indexes of all maps.
//!
//! A pruning rule depends only on k and the rules of motion, and takes a second or two to compute at k = 8.
//! So each is computed when an index first needs it, and kept as long as the process lives, as the tables of
//! search graphs are.

use std::sync::Arc;

use mediant_grid::{Centers, Corners, GridGraph, PerMotion, Placement};
use mediant_search::{CanonicalRule, Pruning};

use crate::error::Error;

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

/// The pruning rule on a grid graph.
pub(crate) fn pruning<P: Shared>(graph: &GridGraph<P>) -> Result<Arc<Pruning<P>>, Error> {
    let compute = || Arc::new(CanonicalRule::new(graph.k(), graph.rule()));
    let rule = P::known().get(graph.rules(), graph.k(), compute)?;
    Ok(Arc::new(Pruning::with_rule(graph, Arc::clone(rule))?))
}
