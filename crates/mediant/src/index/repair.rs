//! Indexes for a map that changed.

use mediant_grid::{Interrupt, Mismatch, Rectangle};

use super::{Index, Origin};
use crate::{engines::Source, error::Error, space::Space, within::NEVER};

impl Index {
    /// The index for a changed map of the same rules and k. It gives the same answers as one prepared anew.
    /// Clusters and segments are repaired where the maps differ, which takes a copy of the index besides; the
    /// other engines' indexes are prepared anew. [`origin`](Self::origin) says which it was. This index stays
    /// as it is.
    ///
    /// ```
    /// use mediant::{Engine, K, Map, Motion, Origin, Rectangle};
    ///
    /// let space = Map::from_fn(40, 30, |x, _| x == 20)?.space(Motion::centers(K::N8))?;
    /// let door = Rectangle { x: 20, y: 7, width: 1, height: 2 };
    /// let opened = space.edit(door, |_, _| false)?;
    /// let index = space.prepare(Engine::Hpa)?.repair(&opened)?;
    /// assert_eq!(index.origin(), Origin::Repaired);
    /// assert_eq!(space.prepare(Engine::Subgoal)?.repair(&opened)?.origin(), Origin::Prepared);
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Mismatch`] for a space of other rules or another k; those of [`Space::prepare`].
    pub fn repair(&self, changed: &Space) -> Result<Self, Error> {
        self.repaired(changed, &NEVER)
    }

    pub(crate) fn repaired(&self, changed: &Space, interrupt: &Interrupt) -> Result<Self, Error> {
        let (belongs_to, found) = (self.identity(), changed.identity());
        if self.space.motion() != changed.motion() {
            let (prepared, other, other_belongs_to) = ("the index", "the changed space", found);
            return Err(Mismatch { prepared, belongs_to, other, other_belongs_to }.into());
        }
        if belongs_to == found {
            return Ok(Self { space: changed.clone(), origin: Origin::Unchanged, ..self.clone() });
        }
        let repaired = match self.changed_cells(changed) {
            Some(at) => self.prepared.repaired(changed, at, interrupt)?,
            None => None,
        };
        let Some(prepared) = repaired else {
            let source = Source { interrupt, ..self.source() };
            let prepared = Self::from_source(changed, self.setup.engine, source)?;
            return Ok(Self { setup: self.setup, ..prepared });
        };
        Ok(Self { space: changed.clone(), origin: Origin::Repaired, prepared, ..self.clone() })
    }

    /// The cells that differ from those of a changed map; `None` if its size differs.
    fn changed_cells(&self, changed: &Space) -> Option<Rectangle> {
        changed.map().grid().difference(self.space.map().grid())
    }
}
