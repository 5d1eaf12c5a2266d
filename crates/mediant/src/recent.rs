//! The spaces and planners that the paths of a map used last.
//!
//! `map.path`, and the same call of every language, prepares a little at its first use. It is kept with the
//! map, so the next call with the same parameters finds it there.
//!
//! A map that was made by an edit knows the last map before it of which anything was kept, and the change
//! since. So its first paths follow what was kept there, by work that follows the change.

use std::{
    fmt,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};

use mediant_grid::Change as GridChange;
use mediant_search::Limits;

use crate::{
    call::{Call, CallError},
    change::Change,
    demand::Demand,
    error::Error,
    map::Map,
    motion::Motion,
    planners::Planners,
    setup::Setup,
    space::Space,
};

/// The last spaces and planners of a map, by motion and by setup.
#[derive(Default)]
pub(crate) struct Recent {
    spaces: Kept<Motion, Space>,
    planners: Kept<Setup, Arc<Planners>>,
    before: Mutex<Option<Before>>,
}

/// The values that are kept with an earlier map, and the change since.
#[derive(Clone)]
struct Before {
    recent: Arc<Recent>,
    change: GridChange,
}

/// The most rectangles of a change that what is kept follows.
const MOST_CELLS: usize = 1 << 12;

impl Recent {
    /// Nothing is kept yet of the map after a change.
    fn after(before: &Arc<Self>, change: &GridChange) -> Self {
        let before = if before.is_empty() {
            let older = before.before().clone();
            older.and_then(|older| Some(Before { change: older.change.then(change.clone())?, ..older }))
        } else {
            Some(Before { recent: Arc::clone(before), change: change.clone() })
        };
        let before = before.filter(|before| before.change.cells().len() <= MOST_CELLS);
        Self { before: Mutex::new(before), ..Self::default() }
    }

    fn is_empty(&self) -> bool {
        self.spaces.is_empty() && self.planners.is_empty()
    }

    /// Gives up the map before, if anything is kept of this one: so that two maps take turns, and no more.
    fn settle(&self) {
        if !self.is_empty() {
            let given_up = self.before().take();
            drop(given_up);
        }
    }

    fn before(&self) -> MutexGuard<'_, Option<Before>> {
        self.before.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The values that were used last, by key, the last one first.
struct Kept<K, V>(Mutex<Vec<(K, V)>>);

impl<K, V> Default for Kept<K, V> {
    fn default() -> Self {
        Self(Mutex::new(Vec::new()))
    }
}

impl<K: PartialEq, V: Clone> Kept<K, V> {
    /// The number of values that are kept. A caller that uses more in turn should prepare an index each.
    const MOST: usize = 4;

    fn get(&self, key: &K) -> Option<V> {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let at = kept.iter().position(|(known, _)| known == key)?;
        kept[..=at].rotate_right(1);
        Some(kept[0].1.clone())
    }

    fn is_empty(&self) -> bool {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).is_empty()
    }

    fn put(&self, key: K, value: &V) {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        kept.insert(0, (key, value.clone()));
        kept.truncate(Self::MOST);
    }
}

/// Without the kept values, which say nothing of the map.
impl fmt::Debug for Recent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Recent")
    }
}

impl Map {
    /// The map after a change of this one.
    pub(crate) fn after(&self, change: impl FnOnce(GridChange) -> GridChange) -> Self {
        self.recent().settle();
        let change = change(GridChange::new(Arc::clone(self.grid())));
        Self::with_recent(Arc::clone(change.after()), Recent::after(self.recent(), &change))
    }

    /// The setup of a call: of the engine that it names, or for the next path on this map, which may change
    /// before the one after it ([`Demand::Paths`] of one).
    ///
    /// # Errors
    /// [`CallError`] for parameters that do not go together.
    pub fn setup(&self, call: &Call) -> Result<Setup, CallError> {
        Ok(call.setup(Demand::Paths(1), (call.motion()?, self))?.0)
    }

    /// The space of a motion, if it is kept with the map.
    #[must_use]
    pub fn kept_space(&self, motion: Motion) -> Option<Space> {
        self.recent().spaces.get(&motion)
    }

    /// The space of a motion, kept with the map for the next call. [`space`](Self::space) makes one that is
    /// not kept. Of the limits the deadline and the flag count.
    ///
    /// # Errors
    /// As for [`space`](Self::space), and [`Error::Stopped`].
    pub fn keep_space(&self, motion: Motion, limits: impl Into<Limits>) -> Result<Space, Error> {
        if let Some(space) = self.kept_space(motion) {
            return Ok(space);
        }
        let before = self.recent().before().clone();
        let known = before.and_then(|before| Some((before.recent.spaces.get(&motion)?, before.change)));
        let space = match known {
            Some((known, change)) => known.follow(&change, None),
            None => self.within(limits).space(motion)?,
        };
        self.recent().spaces.put(motion, &space);
        Ok(space)
    }

    /// The planners of a setup, if they are kept with the map.
    #[must_use]
    pub fn kept_planners(&self, setup: &Setup) -> Option<Arc<Planners>> {
        self.recent().planners.get(setup)
    }

    /// The planners of a setup, kept with the map for the next call: of each map those of the last four
    /// setups. Of the limits the deadline and the flag count.
    ///
    /// # Errors
    /// As for [`space`](Self::space) and [`Space::prepare`], and [`Error::Stopped`].
    pub fn keep_planners(&self, setup: &Setup, limits: impl Into<Limits>) -> Result<Arc<Planners>, Error> {
        if let Some(planners) = self.kept_planners(setup) {
            return Ok(planners);
        }
        let limits = limits.into();
        let before = self.recent().before().clone();
        let space = self.keep_space(setup.motion, &limits)?;
        let known = before.and_then(|before| Some((before.recent.planners.get(setup)?, before.change)));
        let planners = match known {
            Some((known, change)) => {
                let change = Change::of_spaces([known.index().space(), &space], change);
                known.hand_on(&known.index().within(&limits).repair(&change)?)?
            }
            None => {
                let index = space.within(&limits).prepare(setup.engine)?;
                Planners::new(index.with_smoothing(setup.smoothing))
            }
        };
        let planners = Arc::new(planners);
        self.recent().planners.put(*setup, &planners);
        Ok(planners)
    }
}
