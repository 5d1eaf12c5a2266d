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
    /// That of subgoals goes on with the labels or the graph of the earlier map, where these prove the
    /// answer; elsewhere another engine searches. [`finish`](Self::finish) makes them anew.
    ///
    /// ```
    /// use mediant::{Engine, K, Map, Motion, Origin, Rectangle};
    ///
    /// let space = Map::from_fn(40, 30, |x, _| x == 20)?.space(Motion::centers(K::N8))?;
    /// let change = space.edit(Rectangle::new(20, 7, 1, 2), |_, _| false)?;
    /// let index = space.prepare(Engine::Hpa)?.repair(&change)?;
    /// assert_eq!(index.origin(), Origin::Repaired);
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
        let source = Source { interrupt, for_changes: true, ..self.source() };
        Ok(Self { setup: self.setup, ..Self::from_source(after, self.setup.engine, source)? })
    }

    /// The same index in the form that it has after a repair.
    pub(crate) fn ready_for_changes(&self, interrupt: &Interrupt) -> Result<Self, Error> {
        let ready = self.prepared.ready_for_changes(&self.space, interrupt)?;
        Ok(ready.map_or_else(|| self.clone(), |prepared| Self { prepared, ..self.clone() }))
    }

    /// Whether nothing of the index is that of an earlier map: always, but for one of subgoals that was
    /// [repaired](Self::repair).
    #[must_use]
    pub fn is_finished(&self) -> bool {
        self.prepared.is_finished()
    }

    /// This index with all that a [repair](Self::repair) left made anew; it stays as it is. For subgoals that
    /// takes as long as to prepare them, so do it where nobody waits: on a thread of your own, after some
    /// edits. Until its planners [follow](crate::Planner::follow) to it, they answer as before, as exactly.
    /// If the map has changed again meanwhile, repair the finished index by the change from its space to
    /// the present one.
    ///
    /// ```
    /// use mediant::{Change, Engine, K, Map, Motion};
    ///
    /// let space = Map::from_fn(40, 30, |x, y| x == 20 && y != 9)?.space(Motion::corners(K::ANY))?;
    /// let index = space.prepare(Engine::Subgoal)?;
    /// let closed = space.edit_cells([((3, 3), true)])?;
    /// let index = index.repair(&closed)?;
    /// assert!(!index.is_finished());
    /// let mut planner = index.planner();
    /// let thread = std::thread::spawn({
    ///     let index = index.clone();
    ///     move || index.finish()
    /// });
    /// // The labels of the map before prove most answers.
    /// assert!(planner.path((0, 0), (39, 0))?.is_some());
    /// assert_eq!(planner.searched_by(), Engine::Subgoal);
    /// // Meanwhile the map changes again.
    /// let opened = closed.after().edit_cells([((20, 8), false)])?;
    ///
    /// let finished = thread.join().expect("it does not panic")?;
    /// assert!(finished.is_finished());
    /// let index = finished.repair(&Change::between(finished.space(), opened.after())?)?;
    /// planner.follow(&index)?;
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// As for [`Space::prepare`](crate::Space::prepare).
    pub fn finish(&self) -> Result<Self, Error> {
        self.finished(&NEVER)
    }

    pub(crate) fn finished(&self, interrupt: &Interrupt) -> Result<Self, Error> {
        if self.is_finished() {
            return Ok(self.clone());
        }
        let source = Source { interrupt, ..self.source() };
        Ok(Self { setup: self.setup, ..Self::from_source(&self.space, self.setup.engine, source)? })
    }

    /// The index for the map after a change of its own; `None` if it must be prepared anew.
    pub(crate) fn repaired_if_it_can_be(
        &self,
        change: &Change,
        interrupt: &Interrupt,
    ) -> Result<Option<Self>, Error> {
        let (before, after) = (change.before().identity(), change.after());
        let is_of_the_same_size = before.map.map(MapId::size) == after.identity().map.map(MapId::size);
        let is_of_the_same_kind = change.before().has_costs() == after.has_costs();
        let repaired = if is_of_the_same_size && is_of_the_same_kind {
            self.prepared.repaired(change, interrupt)?
        } else {
            None
        };
        let to = |prepared| Self { space: after.clone(), origin: Origin::Repaired, prepared, ..self.clone() };
        Ok(repaired.map(to))
    }
}
