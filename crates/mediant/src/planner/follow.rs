//! Planners that follow a map that changes.

use mediant_grid::Identity;

use super::{Planner, smoother};
use crate::{error::Error, index::Index, labeled::Asked, memory_check, setup_error::SetupError};

impl Planner {
    /// Continues on another index of the same engine and motion: the one for the map after an edit. It
    /// answers as a new planner of that index, with its options and its smoothing, by the same paths and
    /// counts. A search that was begun before is forgotten.
    ///
    /// A new planner touches new scratch memory, which takes longer than many queries. One that follows keeps
    /// its own where the map has the same size, and is ready within some microseconds, mostly within one.
    /// Where the new index searches in another way, as subgoals do that keep nothing, the search is made
    /// anew.
    ///
    /// ```
    /// use mediant::{Engine, K, Map, Motion, Rectangle};
    ///
    /// let mut space = Map::from_fn(40, 30, |x, _| x == 20)?.space(Motion::centers(K::N8))?;
    /// let mut index = space.prepare(Engine::Hpa)?;
    /// let mut planner = index.planner();
    /// for is_closed in [false, true] {
    ///     let change = space.edit(Rectangle::new(20, 7, 1, 2), |_, _| is_closed)?;
    ///     index = index.repair(&change)?;
    ///     space = change.after().clone();
    ///     planner.follow(&index)?;
    ///     assert_eq!(planner.path((0, 0), (39, 0))?.is_none(), is_closed);
    /// }
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Setup`] for an index of another engine; [`Error::Mismatch`] for one of other rules or another
    /// k; [`Error::OutOfMemory`] where memory is short. The planner stays as it is then.
    pub fn follow(&mut self, index: &Index) -> Result<(), Error> {
        self.index.check_successor(index)?;
        let (known, setup) = (self.index.setup(), index.setup());
        if known.engine != setup.engine || !index.follow(&mut self.search)? {
            memory_check::check("the planner", index.scratch_bytes())?;
            self.search = index.search()?;
        }
        self.smooth = setup.smoothing.map(|smoothing| smoother(index.space(), smoothing));
        let guarantee = self.search.guarantee();
        self.guarantee = if setup.smoothing.is_some() { guarantee.smoothed() } else { guarantee };
        self.begun = None;
        self.asked = Asked { search: None, costs: std::mem::take(&mut self.asked.costs) };
        self.excepted = self.excepted.take().and_then(|known| known.following(index)).map(Box::new);
        self.index = index.clone();
        Ok(())
    }
}

impl Index {
    /// Checks that planners of this index can follow to another.
    pub(crate) fn check_successor(&self, index: &Self) -> Result<(), Error> {
        let [known, engine] = [self, index].map(|index| index.setup().engine.kind());
        if known != engine {
            return Err(SetupError::OtherPlanner { known, engine }.into());
        }
        let needed = Identity { map: None, ..self.identity() };
        Ok(needed.check("the planner", ("the index", index.identity()))?)
    }
}
