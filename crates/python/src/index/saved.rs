//! Indexes with other options, for other maps, as files and bytes.

use std::sync::Arc;

use mediant::{Change, Ground, Limits, Map, Setup};
use pyo3::{
    prelude::*,
    types::{PyBytes, PyDict, PyTuple},
};

use super::Index;
use crate::{
    arguments::file,
    background::{detached, in_pool, on_thread},
    errors::{raised, wrong_type},
    grid::Grid,
    keywords::{Keywords, OPTIONS},
};

/// The most tiles of 64 × 64 cells that change while Ctrl-C is not looked for: some 10 ms.
const MOST_TILES: usize = 1_000;

#[pymethods]
impl Index {
    /// The same index for queries with other options of its engine, such as another heuristic or smoothing.
    ///
    /// Parameters
    /// ----------
    /// **options
    ///     As in `Grid.prepare`. Options that are left out have their defaults, except those that decided
    ///     what is prepared: ``levels`` and ``side`` stay as they are.
    ///
    /// Returns
    /// -------
    /// Index
    ///     It shares what is prepared with this one.
    ///
    /// Raises
    /// ------
    /// OptionError
    ///     For options that the engine does not take, or that decide what is prepared, if this index has
    ///     others.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> index = mediant.Grid.from_rows(["...", "..."]).prepare("astar")
    /// >>> index.with_options(heuristic="euclidean").setup
    /// 'astar:3:never,euclidean'
    #[pyo3(
        signature = (**options),
        text_signature = "($self, *, heuristic=None, levels=None, memory=None, side=None, landmarks=None, smooth=None)"
    )]
    fn with_options(&self, options: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let keywords = Keywords::read("with_options", options, OPTIONS)?;
        let index = self.planners.index().with_call(&keywords.call).map_err(raised)?;
        Ok(Self::new(self.grid.clone(), index))
    }

    /// The index for an edited grid.
    ///
    /// It is repaired by work that follows the difference of the grids where the engine's index can be, else
    /// prepared anew: `origin` says which it was. This index stays as it is, but that it hands the scratch
    /// memory of its searches on to the new one. Of subgoals something is left to make anew: see `finish`.
    ///
    /// Parameters
    /// ----------
    /// grid : Grid
    ///     The edited grid.
    ///
    /// Returns
    /// -------
    /// Index
    ///     It finds paths of the same lengths as one prepared anew.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> grid = mediant.Grid.from_rows(["....", "####", "...."])
    /// >>> opened = grid.edit((1, 2), [[False]])
    /// >>> grid.prepare("hpa").repair(opened).path((0, 0), (2, 0)) is not None
    /// True
    fn repair(&self, py: Python<'_>, grid: &Bound<'_, PyAny>) -> PyResult<Self> {
        let Ok(changed) = grid.cast::<Grid>() else { return Err(wrong_type("grid", "a Grid", grid)) };
        let (changed, planners) = (changed.get().clone(), Arc::clone(&self.planners));
        let ground = changed.ground().clone();
        let work = move |limits: &Limits| {
            let index = planners.index();
            let mut change = Change::to(index.space(), ground.map());
            let size = |map: &Map| (map.width(), map.height());
            if change.cells().len() > MOST_TILES
                || size(ground.map()) != size(index.space().map())
                || !matches!(ground, Ground::Map(_))
            {
                // Following the change would take longer than a second look for Ctrl-C may. Costs and
                // elevations keep a space of their own.
                let space = ground.keep_space(index.setup().motion, limits)?;
                change = Change::between(index.space(), &space)?;
            }
            let repaired = in_pool(None, || index.within(limits).repair(&change))?;
            planners.hand_on(&repaired)
        };
        let planners = on_thread(py, Limits::new(), work, |_| Ok(()))?.map_err(raised)?;
        Ok(Self { grid: changed, planners: Arc::new(planners) })
    }

    /// This index with all that a repair left made anew.
    ///
    /// After `repair`, subgoals go on with the labels or the graph of the earlier map, where these prove the
    /// answer; elsewhere another engine searches. Answers are exact all the time (`Answer.searched_by` tells
    /// by which engine). To make them anew takes as long as `Grid.prepare`, with the GIL released: call it
    /// from a thread, after some edits. If the grid has changed again meanwhile, `repair` the finished index
    /// for it.
    ///
    /// Returns
    /// -------
    /// Index
    ///     The same as one prepared anew; this index, if nothing was left (`is_finished`).
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> grid = mediant.Grid.from_rows(["....", "##.#", "...."])
    /// >>> index = grid.prepare().repair(grid.edit((1, 0), [[False]]))
    /// >>> index.find((0, 0), (2, 0)).searched_by
    /// 'jps-block'
    /// >>> index.finish().find((0, 0), (2, 0)).searched_by
    /// 'subgoal'
    fn finish(&self, py: Python<'_>) -> PyResult<Self> {
        let planners = Arc::clone(&self.planners);
        let work = move |limits: &Limits| in_pool(None, || planners.index().within(limits).finish());
        let index = on_thread(py, Limits::new(), work, |_| Ok(()))?.map_err(raised)?;
        Ok(Self::new(self.grid.clone(), index))
    }

    /// Writes the index to a file, for `Grid.load`. An older file there is replaced as a whole.
    ///
    /// Parameters
    /// ----------
    /// path : str or os.PathLike
    ///     The file.
    ///
    /// Raises
    /// ------
    /// OptionError
    ///     For an engine whose index is not saved.
    /// FileError
    ///     If the operating system refuses.
    ///
    /// Examples
    /// --------
    /// >>> import pathlib, tempfile
    /// >>> import mediant
    /// >>> grid = mediant.Grid.from_rows(["....", ".##.", "...."])
    /// >>> file = pathlib.Path(tempfile.mkdtemp()) / "map.index"
    /// >>> grid.prepare().save(file)
    /// >>> grid.load(file).distance((0, 0), (2, 3))
    /// 5.0
    fn save(&self, py: Python<'_>, path: &Bound<'_, PyAny>) -> PyResult<()> {
        let path = file("path", path)?;
        let index = self.planners.index().clone();
        let save = move |limits: &Limits| index.within(limits).save(path);
        detached(py, u64::MAX, Limits::new(), save)?.map_err(raised)
    }

    /// The bytes of the index's file, for `Grid.index_from_bytes`.
    ///
    /// Returns
    /// -------
    /// bytes
    ///     With a checksum; the map is not among them.
    ///
    /// Raises
    /// ------
    /// OptionError
    ///     For an engine whose index is not saved.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> grid = mediant.Grid.from_rows(["....", ".##.", "...."])
    /// >>> grid.index_from_bytes(grid.prepare().to_bytes()).engine
    /// 'subgoal'
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let index = self.planners.index().clone();
        let write = move |limits: &Limits| index.within(limits).to_bytes();
        let bytes = detached(py, u64::MAX, Limits::new(), write)?.map_err(raised)?;
        Ok(PyBytes::new(py, &bytes))
    }

    /// By the grid, the setup and the saved bytes, for pickle. An engine that saves nothing is prepared anew.
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let (py, index) = (slf.py(), slf.get());
        let bytes = match index.setup().index_version() {
            Ok(_) => Some(index.to_bytes(py)?),
            Err(_) => None,
        };
        let state = (index.grid.clone(), index.setup_text(), bytes).into_pyobject(py)?;
        Ok((slf.get_type().getattr("_of_state")?, state))
    }

    /// The index of a state that `__reduce__` gave.
    #[staticmethod]
    fn _of_state(
        py: Python<'_>,
        grid: &Bound<'_, Grid>,
        setup: &str,
        bytes: Option<Vec<u8>>,
    ) -> PyResult<Self> {
        let setup: Setup = setup.parse().map_err(|error: mediant::errors::TextError| raised(error))?;
        let grid = grid.get().clone();
        let ground = grid.ground().clone();
        let work = move |limits: &Limits| match bytes {
            None => {
                let space = ground.keep_space(setup.motion, limits)?;
                let index = space.within(limits).prepare(setup.engine)?;
                Ok::<_, mediant::Error>(index.with_smoothing(setup.smoothing))
            }
            Some(bytes) => {
                let index = ground.index_from_bytes(bytes, limits)?;
                Ok(index.with_options(setup.engine)?.with_smoothing(setup.smoothing))
            }
        };
        let index = detached(py, u64::MAX, Limits::new(), work)?.map_err(raised)?;
        Ok(Self::new(grid, index))
    }
}
