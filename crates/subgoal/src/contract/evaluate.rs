//! Shortcuts of subgoals that may be contracted, found for many of them at once.

use mediant_grid::{Interrupted, room_for};

use super::{Contraction, DURING, ShortcutFinder, Shortcuts, SubgoalGeometry};
use crate::chunks::Pool;

/// The shortcuts that contracting a subgoal takes, with the work to find them.
pub(super) struct Evaluation {
    pub(super) id: u32,
    /// Empty if they are not kept.
    pub(super) shortcuts: Shortcuts,
    /// The number of shortcuts.
    pub(super) count: usize,
    /// The number of arcs that witness searches scanned.
    pub(super) arcs_scanned: u64,
}

/// The memory that is asked for before a subgoal is looked at. Most take less, a few take more.
const BYTES: usize = 1 << 9;

/// Scratch memory for each thread.
pub(super) type Finders = Pool<ShortcutFinder>;

impl<G: SubgoalGeometry + Sync> Contraction<G> {
    /// Finds the shortcuts of subgoals, by witness searches that scan `limit` arcs each; in their order. If
    /// they are not kept, they are just counted: before any subgoal is contracted there are many.
    pub(super) fn evaluate(
        &self,
        ids: &[u32],
        finders: &Finders,
        limit: u64,
        are_kept: bool,
    ) -> Result<Vec<Evaluation>, Interrupted> {
        room_for::<[u8; BYTES]>(ids.len(), DURING)?;
        let evaluate_one = |finder: &mut ShortcutFinder, id| {
            let evaluation = self.evaluate_one(finder, id, limit)?;
            let shortcuts = if are_kept { evaluation.shortcuts } else { Shortcuts::new() };
            Ok(Evaluation { shortcuts, ..evaluation })
        };
        let evaluate = |ids: &[u32]| -> Result<Vec<Evaluation>, Interrupted> {
            finders.lend(ShortcutFinder::default, |finder| {
                ids.iter().map(|&id| evaluate_one(finder, id)).collect()
            })
        };
        #[cfg(feature = "parallel")]
        if ids.len() > 1 && mediant_grid::threads::are_there() {
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
        let count = shortcuts.len();
        Ok(Evaluation { id, shortcuts, count, arcs_scanned: finder.witness.arcs_scanned - before })
    }
}
