//! Indexes for a map that changed.

use mediant_grid::{Interrupt, MapId, Mismatch};

use super::{Index, Origin};
use crate::{change::Change, engines::Source, error::Error, never::NEVER};

impl Index {
    /// The index for the map after a change, by work that follows the change where the engine's index can be
    /// repaired, else prepared anew; [`origin`](Self::origin) says which it was. This index stays as it is.
    /// In which sense a repaired index equals a new one is [told for each
    /// engine](crate#maps-that-change).
    ///
    /// ```
    /// use mediant::{Engine, K, Map, Motion, Origin, Rectangle};
    ///
    /// let space = Map::from_fn(40, 30, |x, _| x == 20)?.space(Motion::centers(K::N8))?;
    /// let change = space.edit(Rectangle::new(20, 7, 1, 2), |_, _| false)?;
    /// let index = space.prepare(Engine::Hpa)?.repair(&change)?;
    /// assert_eq!(index.origin(), Origin::Repaired);
    /// assert_eq!(space.prepare(Engine::Subgoal)?.repair(&change)?.origin(), Origin::Prepared);
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Mismatch`] for a change of another map, of other rules or another k; those of
    /// [`Space::prepare`](crate::Space::prepare).
    pub fn repair(&self, change: &Change) -> Result<Self, Error> {
        self.repaired(change, &NEVER)
    }

    pub(crate) fn repaired(&self, change: &Change, interrupt: &Interrupt) -> Result<Self, Error> {
        let (belongs_to, before, after) = (self.identity(), change.before().identity(), change.after());
        if belongs_to != before {
            let (prepared, other) = ("the index", "the space before the change");
            return Err(Mismatch { prepared, belongs_to, other, other_belongs_to: before }.into());
        }
        if before == after.identity() {
            return Ok(Self { space: after.clone(), origin: Origin::Unchanged, ..self.clone() });
        }
        if let Some(repaired) = self.repaired_if_it_can_be(change, interrupt)? {
            return Ok(repaired);
        }
        let source = Source { interrupt, ..self.source() };
        Ok(Self { setup: self.setup, ..Self::from_source(after, self.setup.engine, source)? })
    }

    /// The index for the map after a change of its own; `None` if it must be prepared anew.
    pub(crate) fn repaired_if_it_can_be(
        &self,
        change: &Change,
        interrupt: &Interrupt,
    ) -> Result<Option<Self>, Error> {
        let (before, after) = (change.before().identity(), change.after());
        let is_of_the_same_size = before.map.map(MapId::size) == after.identity().map.map(MapId::size);
        let repaired = if is_of_the_same_size { self.prepared.repaired(change, interrupt)? } else { None };
        let to = |prepared| Self { space: after.clone(), origin: Origin::Repaired, prepared, ..self.clone() };
        Ok(repaired.map(to))
    }
}
