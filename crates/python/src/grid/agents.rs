//! Agents of a size, and paths that keep off walls.

use mediant::{
    Error, Ground, Limits, Map, Rectangle, Vertex,
    grid::{Clearance, Fit, Outside},
};
use pyo3::{prelude::*, types::PyDict};

use super::Grid;
use crate::{
    arguments::{integer, positive, vertex, word},
    arrays::{PathPoints, rows_array},
    background::{detached, in_pool, on_thread},
    errors::{argument, raised},
    keywords::{Keywords, MOTION},
};

#[pymethods]
impl Grid {
    /// The distance of each cell to the nearest obstacle.
    ///
    /// Parameters
    /// ----------
    /// fit : {"centers", "whole-cells"}
    ///     From the center of the cell, or from its nearest point.
    /// outside : {"blocked", "open"}
    ///     Whether the outside of the map is an obstacle.
    ///
    /// Returns
    /// -------
    /// numpy.ndarray
    ///     Shape (rows, columns), float64, in cells: the distance to the nearest point of an obstacle; 0 in
    ///     blocked cells, ``inf`` if there is no obstacle.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> mediant.Grid.from_rows(["...#."]).clearance(outside="open").tolist()
    /// [[2.5, 1.5, 0.5, 0.0, 0.5]]
    #[pyo3(
        signature = (*, fit = None, outside = None),
        text_signature = "($self, *, fit='centers', outside='blocked')"
    )]
    fn clearance<'py>(
        &self,
        py: Python<'py>,
        fit: Option<&Bound<'py, PyAny>>,
        outside: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (fit, outside) = (read_fit(fit)?.unwrap_or(Fit::Centers), read_outside(outside)?);
        let (width, height) = (self.map().width() as i32, self.map().height() as i32);
        let distances = self.measured(py, (fit, outside), move |clearance, limits| {
            let (mut distances, interrupt) =
                (Vec::with_capacity(width as usize * height as usize), limits.interrupt());
            for y in 0..height {
                interrupt.check("measuring clearances")?;
                let row = (0..width).map(|x| clearance.largest_disc(Vertex::new(x, y)).unwrap_or(0.0));
                distances.extend(row);
            }
            Ok(distances)
        })?;
        rows_array(py, distances, width as usize)
    }

    /// The grid of a disc: free where the disc fits. The paths of its center are those of a point on that
    /// grid. An edit of that grid gives a new obstacle no margin: edit the obstacles, and make it again.
    ///
    /// Parameters
    /// ----------
    /// radius : float, optional
    ///     In cells. Half a cell and less changes nothing between centers.
    /// meters : float, optional
    ///     The radius in meters, in place of `radius`, for a grid with a `world`.
    /// fit : {"centers", "whole-cells"}, optional
    ///     Whether the disc must fit around the center of a cell, or around all of its points. By default the
    ///     looser one that keeps the radius along every path of the motion.
    /// outside : {"blocked", "open"}
    ///     Whether the disc may not stick out over the edge of the map, or may.
    /// **motion
    ///     As in `find`.
    ///
    /// Returns
    /// -------
    /// Grid
    ///     With more blocked cells, and the same costs.
    ///
    /// Raises
    /// ------
    /// ArgumentError
    ///     For a radius that is negative or no number, none or two of them, or one in meters where there is
    ///     no
    ///     `world`.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> grid = mediant.Grid.from_rows([".....", "..#..", "....."])
    /// >>> grid.for_disc(0.5).distance((0, 0), (0, 4))
    /// 4.0
    /// >>> grid.for_disc(0.6).is_free((0, 0))
    /// False
    #[pyo3(
        signature = (radius = None, *, meters = None, fit = None, outside = None, **motion),
        text_signature = "($self, radius=None, *, meters=None, fit=None, outside='blocked', k=None, neighbors=None, \
            placement=None, corners=None, gap=None)"
    )]
    fn for_disc<'py>(
        &self,
        py: Python<'py>,
        radius: Option<&Bound<'py, PyAny>>,
        meters: Option<&Bound<'py, PyAny>>,
        fit: Option<&Bound<'py, PyAny>>,
        outside: Option<&Bound<'py, PyAny>>,
        motion: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Self> {
        self.without_elevation()?;
        let motion = Keywords::read("for_disc", motion, MOTION)?.motion()?;
        let fit = read_fit(fit)?.unwrap_or_else(|| Fit::exact(motion.rules, motion.k));
        let (cells, outside) = (self.radius(radius, meters)?, read_outside(outside)?);
        let measured = move |clearance: &Clearance, limits: &Limits| {
            Ok(clearance.for_disc_interruptible(cells, &limits.interrupt())?)
        };
        let map: Map = self.measured(py, (fit, outside), measured)?.into();
        let Ground::Costs(costs) = self.ground() else { return Ok(Self::new(map, self.shared.world)) };
        let all = Rectangle::new(0, 0, map.width(), map.height());
        let is_blocked = |x: u32, y: u32| map.is_blocked((x as i32, y as i32));
        let costs = py.detach(|| costs.edit(all, is_blocked)).map_err(raised)?;
        Ok(Self::new(costs, self.shared.world))
    }

    /// The grid of an agent that covers side × side cells. Its place is its top left cell.
    ///
    /// Parameters
    /// ----------
    /// side : int
    ///     The number of cells.
    ///
    /// Returns
    /// -------
    /// Grid
    ///     Free where all its cells are.
    ///
    /// Raises
    /// ------
    /// ArgumentError
    ///     For a side of 0.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> mediant.Grid.from_rows(["...", "..#"]).for_square(2).to_numpy().tolist()
    /// [[False, True, True], [True, True, True]]
    fn for_square(&self, py: Python<'_>, side: &Bound<'_, PyAny>) -> PyResult<Self> {
        let side = u32::try_from(integer("side", side, 1)?).unwrap_or(u32::MAX);
        self.without_costs("agent of several cells", "give costs that are means over its cells")?;
        let map = self.map().clone();
        let work = move |limits: &Limits| map.within(limits).for_square(side);
        let map = detached(py, self.cells(), Limits::new(), work)?.map_err(raised)?;
        Ok(Self::new(map, self.shared.world))
    }

    /// Of all paths that are not much longer than the shortest, one that keeps off walls farthest.
    ///
    /// Parameters
    /// ----------
    /// start, goal : tuple of int
    ///     (row, column).
    /// surplus : float
    ///     The allowed excess over the shortest length: 0.1 allows 10 % more.
    /// points : {"waypoints", "vertices", "touched"}
    ///     The points of the array: see `find`.
    /// **motion
    ///     As in `find`.
    ///
    /// Returns
    /// -------
    /// tuple or None
    ///     The path, shape (n, 2), int32, and the radius in cells of the disc that keeps its distance to all
    ///     obstacles along it. None if there is no path.
    ///
    /// Raises
    /// ------
    /// QueryError
    ///     For a start or goal that is blocked or outside the map.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> grid = mediant.Grid.from_rows(["." * 9] * 4 + ["....#...."] + ["." * 9] * 3)
    /// >>> path, radius = grid.widest_path((3, 1), (3, 7), surplus=0.5)
    /// >>> radius
    /// 1.5
    #[pyo3(
        signature = (start, goal, *, surplus, points = None, **motion),
        text_signature = "($self, start, goal, *, surplus, points='waypoints', k=None, neighbors=None, placement=None, \
            corners=None, gap=None)"
    )]
    fn widest_path<'py>(
        &self,
        start: &Bound<'py, PyAny>,
        goal: &Bound<'py, PyAny>,
        surplus: &Bound<'py, PyAny>,
        points: Option<&Bound<'py, PyAny>>,
        motion: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Option<(Bound<'py, PyAny>, f64)>> {
        let (py, points) = (start.py(), PathPoints::read(points)?);
        let space = self.moved("widest_path", py, motion)?;
        let rules = space.motion().rules;
        let (start, goal) = (vertex("start", start)?, vertex("goal", goal)?);
        let surplus = positive("surplus", surplus)?;
        let work =
            move |limits: &Limits| in_pool(None, || space.within(limits).widest_path(start, goal, surplus));
        let widest = on_thread(py, Limits::new(), work, |_| Ok(()))?.map_err(raised)?;
        widest.map(|widest| Ok((points.array(py, &widest.path, rules)?, widest.radius))).transpose()
    }
}

impl Grid {
    /// A radius in cells, of one that is given in cells or in meters.
    pub(super) fn radius(
        &self,
        cells: Option<&Bound<'_, PyAny>>,
        meters: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<f64> {
        match (cells, meters, self.shared.world) {
            (Some(cells), None, _) => positive("radius", cells),
            (None, Some(meters), Some(world)) => Ok(world.cells(positive("meters", meters)?)),
            (None, Some(_), None) => {
                Err(argument("meters", "this grid has no place in the world: give the radius in cells"))
            }
            _ => Err(argument("radius", "give it in cells, or as meters=")),
        }
    }

    /// Measures the clearance, and applies `of` to it.
    fn measured<T: Send + 'static>(
        &self,
        py: Python<'_>,
        (fit, outside): (Fit, Outside),
        of: impl FnOnce(&Clearance, &Limits) -> Result<T, Error> + Send + 'static,
    ) -> PyResult<T> {
        let map = self.map().clone();
        let work =
            move |limits: &Limits| in_pool(None, || of(&map.within(limits).clearance(fit, outside)?, limits));
        on_thread(py, Limits::new(), work, |_| Ok(()))?.map_err(raised)
    }
}

fn read_fit(value: Option<&Bound<'_, PyAny>>) -> PyResult<Option<Fit>> {
    let Some(value) = value.filter(|value| !value.is_none()) else { return Ok(None) };
    word("fit", value).map(Some)
}

fn read_outside(value: Option<&Bound<'_, PyAny>>) -> PyResult<Outside> {
    value.map_or(Ok(Outside::Blocked), |value| word("outside", value))
}
