//! Values that depend on the rules of motion and k alone, which the process computes once.

use std::sync::OnceLock;

use mediant_moves::{CostTable, FiniteK, KError};

use crate::Rules;

/// The largest k of a search graph.
pub(crate) const MAX_K: u32 = 12;

/// The number of k with a search graph: from 2 on.
const KS: usize = MAX_K as usize - 1;

/// A value for each placement with its rule of motion and each k of a search graph. Each is computed when it
/// is first asked for, and kept as long as the process lives: there are 55 at most. Reading takes no lock. A
/// thread waits only while another computes the same value.
///
/// Hidden: for the crates of this workspace, as a `static`.
#[doc(hidden)]
#[derive(Debug)]
pub struct PerMotion<V> {
    known: [[OnceLock<V>; KS]; Rules::COUNT],
}

impl<V> PerMotion<V> {
    /// Nothing is computed yet.
    #[must_use]
    pub const fn new() -> Self {
        Self { known: [const { [const { OnceLock::new() }; KS] }; Rules::COUNT] }
    }

    /// The value for these rules and this k.
    ///
    /// # Errors
    /// [`KError::TooLarge`] above [`GridGraph::MAX_K`](crate::GridGraph::MAX_K).
    pub fn get(&self, rules: Rules, k: FiniteK, compute: impl FnOnce() -> V) -> Result<&V, KError> {
        Ok(self.cell(rules, k)?.get_or_init(compute))
    }

    /// The value for these rules and this k, whose computing may be stopped: two threads that ask first at
    /// the same time both compute it, and one is kept.
    ///
    /// # Errors
    /// As for [`get`](Self::get); within, the error of `compute`.
    pub fn get_or_stop<E>(
        &self,
        rules: Rules,
        k: FiniteK,
        compute: impl FnOnce() -> Result<V, E>,
    ) -> Result<Result<&V, E>, KError> {
        let cell = self.cell(rules, k)?;
        if let Some(value) = cell.get() {
            return Ok(Ok(value));
        }
        Ok(compute().map(|value| cell.get_or_init(|| value)))
    }

    fn cell(&self, rules: Rules, k: FiniteK) -> Result<&OnceLock<V>, KError> {
        let too_large = || KError::TooLarge { k: k.get().into(), max: MAX_K };
        self.known[rules.number()].get(k.depth() as usize).ok_or_else(too_large)
    }
}

impl<V> Default for PerMotion<V> {
    fn default() -> Self {
        Self::new()
    }
}

/// The costs of the moves of N(k), and h_k: the table that the process keeps.
///
/// Hidden, as [`PerMotion`] is.
///
/// # Errors
/// [`KError::TooLarge`] above [`CostTable::MAX_K`].
#[doc(hidden)]
pub fn cost_table(k: FiniteK) -> Result<&'static CostTable, KError> {
    const KS: usize = CostTable::MAX_K as usize - 1;
    static KNOWN: [OnceLock<Result<CostTable, KError>>; KS] = [const { OnceLock::new() }; KS];
    let too_large = || KError::TooLarge { k: k.get().into(), max: CostTable::MAX_K };
    let known = KNOWN.get(k.depth() as usize).ok_or_else(too_large)?;
    known.get_or_init(|| CostTable::new(k)).as_ref().map_err(|&error| error)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_value_is_computed_once() {
        let (known, mut computed) = (PerMotion::new(), 0);
        let ks = || (2..=12).map(|k| FiniteK::new(k).expect("k is at least 2"));
        let mut pass = || {
            for (rules, k) in Rules::ALL.into_iter().flat_map(|rules| ks().map(move |k| (rules, k))) {
                let value = known.get(rules, k, || {
                    computed += 1;
                    (rules, k)
                });
                assert_eq!(value, Ok(&(rules, k)));
            }
        };
        pass();
        pass();
        assert_eq!(computed, 5 * 11);
        let beyond = FiniteK::new(13).expect("k is at least 2");
        let refused = known.get(Rules::ALL[0], beyond, || unreachable!("it is not kept"));
        assert_eq!(refused, Err(KError::TooLarge { k: 13, max: 12 }));
    }
}
