//! Shortcuts of subgoals that may be contracted, found for many of them at once.

use std::sync::{Mutex, PoisonError};

use mediant_grid::Interrupted;

use super::{Contraction, ShortcutFinder, Shortcuts, SubgoalGeometry};

/// The shortcuts that contracting a subgoal takes, with the work to find them.
pub(super) struct Evaluation {
    pub(super) id: u32,
    pub(super) shortcuts: Shortcuts,
    /// The number of arcs that witness searches scanned.
    pub(super) arcs_scanned: u64,
}

/// Scratch memory for each thread.
#[derive(Default)]
pub(super) struct Finders(Mutex<Vec<ShortcutFinder>>);

impl Finders {
    fn lend<T>(&self, work: impl FnOnce(&mut ShortcutFinder) -> T) -> T {
        let spare = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let mut finder = spare().pop().unwrap_or_default();
        let done = work(&mut finder);
        spare().push(finder);
        done
    }
}

impl<G: SubgoalGeometry + Sync> Contraction<G> {
    /// Finds the shortcuts of subgoals, by witness searches that scan `limit` arcs each; in their order.
    pub(super) fn evaluate(
        &self,
        ids: &[u32],
        finders: &Finders,
        limit: u64,
    ) -> Result<Vec<Evaluation>, Interrupted> {
        let evaluate = |ids: &[u32]| -> Result<Vec<Evaluation>, Interrupted> {
            finders.lend(|finder| ids.iter().map(|&id| self.evaluate_one(finder, id, limit)).collect())
        };
        #[cfg(feature = "parallel")]
        if ids.len() > 1 {
            use rayon::prelude::*;
            let at_once = (ids.len() / 64).clamp(1, 16);
            let all = ids.par_chunks(at_once).map(evaluate).collect::<Result<Vec<_>, _>>()?;
            return Ok(all.into_iter().flatten().collect());
        }
        evaluate(ids)
    }

    fn evaluate_one(
        &self,
        finder: &mut ShortcutFinder,
        id: u32,
        limit: u64,
    ) -> Result<Evaluation, Interrupted> {
        let before = finder.witness.arcs_scanned;
        let (shortcuts, _) = self.find_shortcuts(finder, id, limit)?;
        Ok(Evaluation { id, shortcuts, arcs_scanned: finder.witness.arcs_scanned - before })
    }
}
