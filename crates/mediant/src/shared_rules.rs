//! The pruning rules of canonical search, shared by the indexes of all maps.
//!
//! A pruning rule depends only on k and the rules of motion, and takes a second or two to compute at k = 8.
//! So each is computed when an index first needs it, and kept as long as the process lives.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use mediant_grid::{Centers, Corners, GridGraph, Mismatch, Placement};
use mediant_moves::FiniteK;
use mediant_search::{CanonicalRule, Pruning};

/// A pruning rule, once it was computed.
type Cell<P> = Arc<OnceLock<Arc<CanonicalRule<P>>>>;

/// The pruning rules of one placement that were asked for.
pub(crate) type Known<P> = Mutex<Vec<((FiniteK, <P as Placement>::Rule), Cell<P>)>>;

static CENTERS: Known<Centers> = Mutex::new(Vec::new());
static CORNERS: Known<Corners> = Mutex::new(Vec::new());

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

/// The pruning rule on a grid graph. A thread that needs a rule waits only while another computes the same.
pub(crate) fn pruning<P: Shared>(graph: &GridGraph<P>) -> Result<Arc<Pruning<P>>, Mismatch> {
    let key = (graph.k(), graph.rule());
    let mut known = P::known().lock().unwrap_or_else(PoisonError::into_inner);
    let cell = match known.iter().find(|(of, _)| *of == key) {
        Some((_, cell)) => Arc::clone(cell),
        None => {
            let cell = Cell::default();
            known.push((key, Arc::clone(&cell)));
            cell
        }
    };
    drop(known);
    let rule = cell.get_or_init(|| Arc::new(CanonicalRule::new(graph.k(), graph.rule())));
    Ok(Arc::new(Pruning::with_rule(graph, Arc::clone(rule))?))
}
