//! Other cells, and a place in the world: the next version of a grid.

use mediant::{Map, Rectangle, Vertex};
use pyo3::{prelude::*, types::PyBool};

use super::Grid;
use crate::{
    arguments::{Points, flag, numpy_function, vertex},
    arrays::patch,
    errors::{argument, exception, instead, raised, wrong_type},
    world::placed,
};

#[pymethods]
impl Grid {
    /// This grid with other cells in a rectangle. This one stays as it is.
    ///
    /// Parameters
    /// ----------
    /// at : tuple of int
    ///     (row, column) of the rectangle's top left cell.
    /// blocked : array_like of bool
    ///     The new cells, shape (rows, columns) of the rectangle; True is blocked.
    ///
    /// Returns
    /// -------
    /// Grid
    ///     The next version.
    ///
    /// Raises
    /// ------
    /// MapError
    ///     For a rectangle that is not wholly on the map; where cells have costs, for a blocked cell that is
    ///     freed: `edit_costs` gives it a cost.
    /// OptionError
    ///     Where cells have elevations.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> grid = mediant.Grid.from_rows(["...", "..."])
    /// >>> grid.edit((0, 1), [[True], [True]]).distance((0, 0), (0, 2))
    /// inf
    fn edit(&self, at: &Bound<'_, PyAny>, blocked: &Bound<'_, PyAny>) -> PyResult<Self> {
        self.without_elevation()?;
        match Patch::read(self.map(), at, blocked)? {
            Some(patch) => {
                let edited = self.ground().edit(patch.at, |x, y| patch.is_blocked(x, y));
                Ok(Self::new(edited.map_err(raised)?, self.shared.world))
            }
            None => Ok(self.clone()),
        }
    }

    /// This grid with other scattered cells. This one stays as it is.
    ///
    /// Parameters
    /// ----------
    /// cells : array_like of int
    ///     A cell (row, column), or several with shape (n, 2).
    /// blocked : bool or array_like of bool
    ///     Whether they are blocked: one for all, or one for each, shape (n,). The last word on a cell
    ///     counts.
    ///
    /// Returns
    /// -------
    /// Grid
    ///     The next version.
    ///
    /// Raises
    /// ------
    /// MapError
    ///     For a cell outside the map, and as `edit`.
    /// OptionError
    ///     As `edit`.
    /// ArgumentError
    ///     For another number of values than of cells.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> grid = mediant.Grid.from_rows(["...", "..."])
    /// >>> grid.edit_cells([(0, 0), (1, 2)], True).to_numpy().astype(int).tolist()
    /// [[1, 0, 0], [0, 0, 1]]
    fn edit_cells(&self, cells: &Bound<'_, PyAny>, blocked: &Bound<'_, PyAny>) -> PyResult<Self> {
        self.without_elevation()?;
        let cells = cells_on("cells", cells, self.map())?;
        let blocked = flags("blocked", blocked, cells.len())?;
        let edited = self.ground().edit_cells(cells.into_iter().zip(blocked)).map_err(raised)?;
        Ok(Self::new(edited, self.shared.world))
    }

    /// This grid with another place in the world, or with none.
    ///
    /// Parameters
    /// ----------
    /// world : World or None
    ///     The place of a map of the same shape.
    ///
    /// Returns
    /// -------
    /// Grid
    ///     With the same cells.
    ///
    /// Raises
    /// ------
    /// ArgumentError
    ///     For the place of a map of another shape.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> grid = mediant.Grid.from_rows(["....", "...."])
    /// >>> grid.with_world(mediant.World(0.5, shape=grid.shape)).world.vertex_at(1.2, 0.1)
    /// (1, 2)
    #[pyo3(signature = (world), text_signature = "($self, world)")]
    fn with_world(&self, world: &Bound<'_, PyAny>) -> PyResult<Self> {
        // The clone shares the spaces and planners that this grid keeps.
        Ok(Self::new(self.ground().clone(), placed(world, self.map())?))
    }
}

/// The cells of a map that an argument names.
pub(crate) fn cells_on(name: &str, value: &Bound<'_, PyAny>, map: &Map) -> PyResult<Vec<Vertex>> {
    let cells = Points::read(name, value)?.into_vertices(name)?;
    let is_on = |at: i32, side: u32| u32::try_from(at).is_ok_and(|at| at < side);
    match cells.iter().find(|at| !(is_on(at.x, map.width()) && is_on(at.y, map.height()))) {
        None => Ok(cells),
        Some(at) => {
            let (rows, columns) = (map.height(), map.width());
            let (row, column) = (at.y, at.x);
            let text =
                format!("{name}: cell ({row}, {column}) is outside the map of {rows} × {columns} cells");
            Err(exception("MapError", &text, "edit-outside"))
        }
    }
}

/// A flag for each of so many cells: one for all, or an array.
fn flags(name: &str, value: &Bound<'_, PyAny>, count: usize) -> PyResult<Vec<bool>> {
    if value.is_instance_of::<PyBool>() {
        return Ok(vec![flag(name, value)?; count]);
    }
    let wrong =
        |cause| instead(value.py(), cause, wrong_type(name, "True, False or an array of them", value));
    let row = numpy_function(value.py(), "atleast_2d")?.call1((value,)).map_err(wrong)?;
    let (cells, rows, columns) = patch(name, &row)?;
    match (rows, columns) {
        (1, found) if found == count => Ok(cells),
        (1, 1) => Ok(vec![cells[0]; count]),
        _ => Err(argument(name, &format!("expected one value for each of {count} cells, or one for all"))),
    }
}

/// Other cells in a rectangle.
pub(crate) struct Patch {
    pub(crate) at: Rectangle,
    cells: Vec<bool>,
}

impl Patch {
    /// The arguments of an edit of a map; `None` without cells.
    pub(crate) fn read(
        map: &Map,
        at: &Bound<'_, PyAny>,
        blocked: &Bound<'_, PyAny>,
    ) -> PyResult<Option<Self>> {
        let (at, (cells, rows, columns)) = (vertex("at", at)?, patch("blocked", blocked)?);
        let (width, height) = (map.width() as usize, map.height() as usize);
        let fits = |first: i32, count: usize, side: usize| {
            usize::try_from(first).is_ok_and(|first| first < side && count <= side - first)
        };
        if !(fits(at.x, columns, width) && fits(at.y, rows, height)) {
            let text = format!(
                "at: a rectangle of {rows} × {columns} cells at ({}, {}) is not wholly on the map of \
                 {height} × {width} cells",
                at.y, at.x
            );
            return Err(exception("MapError", &text, "edit-outside"));
        }
        let at = Rectangle { x: at.x as u32, y: at.y as u32, width: columns as u32, height: rows as u32 };
        Ok((!cells.is_empty()).then_some(Self { at, cells }))
    }

    /// Whether a cell of the rectangle is to be blocked.
    pub(crate) fn is_blocked(&self, column: u32, row: u32) -> bool {
        self.cells[(row - self.at.y) as usize * self.at.width as usize + (column - self.at.x) as usize]
    }
}
