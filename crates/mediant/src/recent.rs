//! The spaces and planners that the paths of a map, or of costs of its cells, used last.
//!
//! `map.path`, and the same call of every language, prepares a little at its first use. It is kept with the
//! map, so the next call with the same parameters finds it there.
//!
//! A map that was made by an edit knows the last map before it of which anything was kept, and the change
//! since. So its first paths follow what was kept there, by work that follows the change. Costs do the same.

use std::{
    fmt,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};

use mediant_grid::{Change as GridChange, Rectangle};
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
    surface::Surface,
};

/// The last spaces and planners of a map, or of costs, by motion and by setup.
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
    /// Where costs changed.
    with_costs: Vec<Rectangle>,
}

/// The most rectangles of a change that what is kept follows.
const MOST_CELLS: usize = 1 << 12;

impl Recent {
    /// Nothing is kept yet of the map after a change, or of its costs, which changed in these places.
    pub(crate) fn after(before: &Arc<Self>, change: &GridChange, with_costs: Vec<Rectangle>) -> Self {
        let before = if before.is_empty() {
            let older = before.before().clone();
            older.and_then(|mut older| {
                older.with_costs.extend(with_costs);
                Some(Before { change: older.change.then(change.clone())?, ..older })
            })
        } else {
            Some(Before { recent: Arc::clone(before), change: change.clone(), with_costs })
        };
        let is_small =
            |before: &Before| before.change.cells().len().max(before.with_costs.len()) <= MOST_CELLS;
        Self { before: Mutex::new(before.filter(is_small)), ..Self::default() }
    }

    fn is_empty(&self) -> bool {
        self.spaces.is_empty() && self.planners.is_empty()
    }

    /// Gives up the map before, if anything is kept of this one: so that two maps take turns, and no more.
    pub(crate) fn settle(&self) {
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

/// A map, or costs of its cells, which keeps the spaces that are made of it.
pub(crate) trait Keeps {
    fn recent(&self) -> &Arc<Recent>;

    /// A space that is not kept.
    fn make(&self, motion: Motion, limits: Limits) -> Result<Space, Error>;

    /// Its costs, with the rules and the k of a space of earlier ones, which differ in these places.
    fn surface_like(&self, earlier: &Space, places: &[Rectangle]) -> Result<Option<Surface>, Error>;

    fn kept(&self, motion: Motion) -> Option<Space> {
        self.recent().spaces.get(&motion)
    }

    fn keep(&self, motion: Motion, limits: impl Into<Limits>) -> Result<Space, Error> {
        if let Some(space) = self.kept(motion) {
            return Ok(space);
        }
        let before = self.recent().before().clone();
        let known = before.and_then(|before| Some((before.recent.spaces.get(&motion)?, before)));
        let space = match known {
            Some((known, before)) => {
                known.follow(&before.change, self.surface_like(&known, &before.with_costs)?)
            }
            None => self.make(motion, limits.into())?,
        };
        self.recent().spaces.put(motion, &space);
        Ok(space)
    }

    fn kept_planners_of(&self, setup: &Setup) -> Option<Arc<Planners>> {
        self.recent().planners.get(setup)
    }

    fn keep_planners_of(&self, setup: &Setup, limits: impl Into<Limits>) -> Result<Arc<Planners>, Error> {
        if let Some(planners) = self.kept_planners_of(setup) {
            return Ok(planners);
        }
        let limits = limits.into();
        let before = self.recent().before().clone();
        let space = self.keep(setup.motion, &limits)?;
        space.check_setup(setup)?;
        let known = before.and_then(|before| Some((before.recent.planners.get(setup)?, before)));
        let planners = match known {
            Some((known, Before { change, with_costs, .. })) => {
                let change = Change::of_spaces([known.index().space(), &space], change, with_costs);
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

impl Keeps for Map {
    fn recent(&self) -> &Arc<Recent> {
        self.recent()
    }

    fn make(&self, motion: Motion, limits: Limits) -> Result<Space, Error> {
        self.within(limits).space(motion)
    }

    fn surface_like(&self, _: &Space, _: &[Rectangle]) -> Result<Option<Surface>, Error> {
        Ok(None)
    }
}

/// Defines the public methods by which a map, and costs, keep spaces and planners.
macro_rules! keeps {
    () => {
        /// The space of a motion, if it is kept here.
        #[must_use]
        pub fn kept_space(&self, motion: Motion) -> Option<Space> {
            self.kept(motion)
        }

        /// The space of a motion, kept here for the next call: [`space`](Self::space) makes one that is not
        /// kept. Of the limits the deadline and the flag count.
        ///
        /// # Errors
        /// As for [`space`](Self::space), and [`Error::Stopped`].
        pub fn keep_space(&self, motion: Motion, limits: impl Into<Limits>) -> Result<Space, Error> {
            self.keep(motion, limits)
        }

        /// The planners of a setup, if they are kept here.
        #[must_use]
        pub fn kept_planners(&self, setup: &Setup) -> Option<Arc<Planners>> {
            self.kept_planners_of(setup)
        }

        /// The planners of a setup, kept here for the next call: those of the last four setups. Of the limits
        /// the deadline and the flag count.
        ///
        /// # Errors
        /// As for [`space`](Self::space) and [`Space::prepare`], and [`Error::Stopped`].
        pub fn keep_planners(
            &self,
            setup: &Setup,
            limits: impl Into<Limits>,
        ) -> Result<Arc<Planners>, Error> {
            self.keep_planners_of(setup, limits)
        }
    };
}

impl Map {
    /// The map after a change of this one.
    pub(crate) fn after(&self, change: impl FnOnce(GridChange) -> GridChange) -> Self {
        self.recent().settle();
        let change = change(GridChange::new(Arc::clone(self.grid())));
        let recent = Recent::after(self.recent(), &change, Vec::new());
        Self::with_recent(Arc::clone(change.after()), recent)
    }

    /// The setup of a call: of the engine that it names, or for the next path on this map, which may change
    /// before the one after it ([`Demand::Paths`] of one).
    ///
    /// # Errors
    /// [`CallError`] for parameters that do not go together.
    pub fn setup(&self, call: &Call) -> Result<Setup, CallError> {
        Ok(call.setup(Demand::Paths(1), (call.motion()?, self))?.0)
    }

    keeps!();
}

#[cfg(feature = "costs")]
mod on_costs {
    use std::sync::Arc;

    use mediant_grid::Rectangle;
    use mediant_search::Limits;

    use super::{Keeps, Recent};
    use crate::{
        call::{Call, CallError},
        choice::Choice,
        costs::Costs,
        error::Error,
        motion::Motion,
        planners::Planners,
        setup::Setup,
        space::Space,
        surface::Surface,
    };

    impl Keeps for Costs {
        fn recent(&self) -> &Arc<Recent> {
            self.recent()
        }

        fn make(&self, motion: Motion, limits: Limits) -> Result<Space, Error> {
            self.within(limits).space(motion)
        }

        fn surface_like(&self, earlier: &Space, places: &[Rectangle]) -> Result<Option<Surface>, Error> {
            earlier.surface().map(|surface| surface.after(self, places)).transpose()
        }
    }

    impl Costs {
        /// The setup of a call: of the engine that it names, or for the next path on these costs.
        /// [`keep_planners`](Self::keep_planners) refuses an engine that knows no costs.
        ///
        /// # Errors
        /// [`CallError`] for parameters that do not go together.
        pub fn setup(&self, call: &Call) -> Result<Setup, CallError> {
            setup_on_costs(call)
        }

        keeps!();
    }

    /// The setup of a call where paths have costs.
    pub(super) fn setup_on_costs(call: &Call) -> Result<Setup, CallError> {
        let engine = call.configured(call.engine().unwrap_or(Choice::ON_COSTS.engine))?;
        Ok(Setup { smoothing: call.smoothing(), ..Setup::new(engine, call.motion()?) })
    }
}

#[cfg(feature = "walking")]
mod over_elevation {
    use std::sync::Arc;

    use mediant_grid::Rectangle;
    use mediant_search::Limits;

    use super::{Keeps, Recent, on_costs::setup_on_costs};
    use crate::{
        call::{Call, CallError},
        error::Error,
        motion::Motion,
        planners::Planners,
        setup::Setup,
        space::Space,
        surface::Surface,
        walking::Walking,
    };

    impl Keeps for Walking {
        fn recent(&self) -> &Arc<Recent> {
            self.recent()
        }

        fn make(&self, motion: Motion, limits: Limits) -> Result<Space, Error> {
            self.within(limits).space(motion)
        }

        // There are no edits of elevations.
        fn surface_like(&self, _: &Space, _: &[Rectangle]) -> Result<Option<Surface>, Error> {
            Ok(None)
        }
    }

    impl Walking {
        /// The setup of a call: of the engine that it names, or A*. [`keep_planners`](Self::keep_planners)
        /// refuses an engine that does not walk.
        ///
        /// # Errors
        /// [`CallError`] for parameters that do not go together.
        pub fn setup(&self, call: &Call) -> Result<Setup, CallError> {
            setup_on_costs(call)
        }

        keeps!();
    }
}
