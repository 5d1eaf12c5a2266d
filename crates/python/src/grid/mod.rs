//! Grids: maps, with the spaces and planners that were used last.

mod agents;
mod fields;
mod making;
mod motion;
mod occupancy;
mod queries;

use std::sync::{Arc, Mutex, PoisonError};

use mediant::{Choice, Engine, Error, Limits, Map, Motion, Planners, Setup, Space, files::WorldFrame};
use pyo3::prelude::*;

use crate::{
    background::{detached, in_pool, on_thread},
    errors::raised,
    keywords::Keywords,
};

/// A map: which cells are blocked. Cell (row, column) is counted from the top left corner.
///
/// A grid never changes: `edit` makes another one. All threads can share it.
///
/// Parameters
/// ----------
/// array : array_like
///     Shape (rows, columns). Of bool: True where a cell is blocked. Of numbers: with at least one of the
///     criteria that follow, and blocked where one of them is met. It is read where it is, and not kept.
/// above : float, optional
///     Cells with a larger value are blocked.
/// below : float, optional
///     Cells with a smaller value are blocked.
/// values : iterable of float, optional
///     Cells with one of these values, in the array's type, are blocked. ``nan`` among them stands for all
///     that are no number.
/// resolution : float, optional
///     The side of a cell in meters. With it the grid has a place in the `world`.
/// origin : tuple of float, optional
///     The lower left corner of the map, below the last row: x and y in meters, and its turn in radians,
///     which may be left out; (0, 0) by default. For cells whose first row is the lowest, give
///     ``array[::-1]``; for those of an occupancy message there is `from_occupancy`.
///
/// Attributes
/// ----------
/// shape : tuple of int
///     The number of rows and columns.
/// world : World or None
///     Where the map is in the world, if that was said.
/// id : str
///     A name of the content: the same for grids with the same cells.
///
/// Raises
/// ------
/// MapError
///     For a side of 0, or of more than 32768 cells.
/// ArgumentError
///     For an array of another number of dimensions, or with values that are no number; and for a resolution
///     or an origin that places no map.
/// TypeError
///     For numbers without a criterion, and for arrays that hold neither numbers nor bool.
///
/// Examples
/// --------
/// >>> import numpy as np
/// >>> import mediant
/// >>> grid = mediant.Grid(np.array([[0, 0, 9], [0, 9, 0]]), above=5)
/// >>> grid
/// <mediant.Grid of 2 × 3 cells, 2 blocked>
/// >>> mediant.Grid(np.array([[1, 2, 3]]), values={1, 3}).to_numpy().tolist()
/// [[True, False, True]]
#[pyclass(frozen, module = "mediant")]
#[derive(Clone)]
pub(crate) struct Grid {
    shared: Arc<Shared>,
}

struct Shared {
    map: Map,
    world: Option<WorldFrame>,
    spaces: Recent<Motion, Space>,
    planners: Recent<Setup, Arc<Planners>>,
}

/// The values that were used last, by key.
struct Recent<K, V>(Mutex<Vec<(K, V)>>);

impl<K: PartialEq, V: Clone> Recent<K, V> {
    /// How many are kept. Who asks for more in turn should prepare an index each.
    const MOST: usize = 4;

    const fn new() -> Self {
        Self(Mutex::new(Vec::new()))
    }

    fn get(&self, key: &K) -> Option<V> {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let at = kept.iter().position(|(known, _)| known == key)?;
        kept[..=at].rotate_right(1);
        Some(kept[0].1.clone())
    }

    fn put(&self, key: K, value: V) {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        kept.insert(0, (key, value));
        kept.truncate(Self::MOST);
    }
}

impl Grid {
    pub(crate) fn new(map: Map, world: Option<WorldFrame>) -> Self {
        let (spaces, planners) = (Recent::new(), Recent::new());
        Self { shared: Arc::new(Shared { map, world, spaces, planners }) }
    }

    pub(crate) fn map(&self) -> &Map {
        &self.shared.map
    }

    /// The number of cells.
    fn cells(&self) -> u64 {
        u64::from(self.map().width()) * u64::from(self.map().height())
    }

    /// The grid with this motion, kept for the next call.
    fn space(&self, py: Python<'_>, motion: Motion) -> PyResult<Space> {
        self.space_within(py, motion, Limits::new())?.map_err(raised)
    }

    fn space_within(&self, py: Python<'_>, motion: Motion, limits: Limits) -> PyResult<Result<Space, Error>> {
        if let Some(space) = self.shared.spaces.get(&motion) {
            return Ok(Ok(space));
        }
        let map = self.map().clone();
        let space = detached(py, self.cells(), limits, move |limits| map.within(limits).space(motion))?;
        if let Ok(space) = &space {
            self.shared.spaces.put(motion, space.clone());
        }
        Ok(space)
    }

    /// The planners of an engine, kept for the next call: of the one that was asked for, or of one that
    /// prepares little. Within, [`Error::Stopped`] by the time limit of the call.
    fn planners(&self, py: Python<'_>, keywords: &Keywords) -> PyResult<Result<Arc<Planners>, Error>> {
        let motion = keywords.motion()?;
        let setup = |engine: Engine| -> PyResult<Setup> {
            let mut setup = Setup::new(keywords.configured(engine)?, motion.k, motion.rules);
            setup.smoothing = keywords.smoothing;
            Ok(setup)
        };
        let engine = keywords.engine.unwrap_or_else(|| Choice::for_next_path(motion, self.map()).engine);
        let setup = setup(engine)?;
        if let Some(planners) = self.shared.planners.get(&setup) {
            return Ok(Ok(planners));
        }
        let limits = keywords.preparation();
        let space = match self.space_within(py, motion, limits.clone())? {
            Ok(space) => space,
            Err(error) => return stopped(error),
        };
        let prepare = move |limits: &Limits| space.within(limits).prepare(setup.engine);
        let index = if setup.index_version().is_err() {
            detached(py, self.cells(), limits, prepare)?
        } else {
            on_thread(py, limits, move |limits| in_pool(None, || prepare(limits)), |_| Ok(()))?
        };
        let index = match index {
            Ok(index) => index.with_smoothing(setup.smoothing),
            Err(error) => return stopped(error),
        };
        let planners = Arc::new(Planners::new(index));
        self.shared.planners.put(setup, Arc::clone(&planners));
        Ok(Ok(planners))
    }
}

/// An error that a limit caused; others are raised.
fn stopped<T>(error: Error) -> PyResult<Result<T, Error>> {
    if matches!(error, Error::Stopped { .. }) { Ok(Err(error)) } else { Err(raised(error)) }
}

impl PartialEq for Grid {
    fn eq(&self, other: &Self) -> bool {
        self.map() == other.map() && self.shared.world == other.shared.world
    }
}
