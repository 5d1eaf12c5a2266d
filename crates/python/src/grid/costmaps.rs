//! Robots' costmaps: costs around obstacles, and bytes that are costs.

use mediant::{Costmap, Error, Inflation, Limits, Traversal, errors::CostsError, grid};
use numpy::{PyArrayDescrMethods, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::{exceptions::PyTypeError, prelude::*, types::PyBytes};

use super::Grid;
use crate::{
    arguments::{integer, number},
    arrays::plane,
    background::detached,
    errors::{argument, raised, raised_for},
    world::placed,
};

#[pymethods]
impl Grid {
    /// This grid with costs around its blocked cells, as the inflation layer of nav2 has them.
    ///
    /// Lengths are in meters where the grid has a `world`, else in cells. At a distance d from the center of
    /// the nearest blocked cell, a cell has the byte 252 · exp(-factor · (d - inscribed radius)), rounded
    /// down, and costs 1 + weight · byte / 252 for each cell of length. A path costs its length in cells, and
    /// more near obstacles. The outside of the map is no obstacle.
    ///
    /// Parameters
    /// ----------
    /// inflation_radius : float
    ///     The distance from obstacles up to which cells cost more, rounded up to whole cells: at least the
    ///     inscribed radius.
    /// inscribed_radius : float
    ///     The radius of the robot: cells at most so far from the center of a blocked one are blocked, too.
    /// cost_scaling_factor : float, optional
    ///     The rate at which costs fall, per unit of length; by default they fall to those of byte 1 at the
    ///     inflation radius.
    /// weight : float
    ///     How much the bytes count, 0 or more: the dearest cells cost 1 + weight.
    ///
    /// Returns
    /// -------
    /// Grid
    ///     With costs, at the same place in the world.
    ///
    /// Raises
    /// ------
    /// ArgumentError
    ///     For a number that is negative or not finite, for an inflation radius below the inscribed one, and
    ///     for a weight above 65535.
    /// OptionError
    ///     For a grid that has costs.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> grid = mediant.Grid.from_rows(["#......"])
    /// >>> costs = grid.inflated(inflation_radius=4, inscribed_radius=1, cost_scaling_factor=1).costs
    /// >>> costs.round(2).tolist()
    /// [[nan, nan, 1.73, 1.27, 1.1, 1.0, 1.0]]
    #[pyo3(
        signature = (*, inflation_radius, inscribed_radius = None, cost_scaling_factor = None, weight = None),
        text_signature = "($self, *, inflation_radius, inscribed_radius=0.0, cost_scaling_factor=None, \
                          weight=2.0)"
    )]
    fn inflated(
        &self,
        py: Python<'_>,
        inflation_radius: &Bound<'_, PyAny>,
        inscribed_radius: Option<&Bound<'_, PyAny>>,
        cost_scaling_factor: Option<&Bound<'_, PyAny>>,
        weight: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        self.without_costs(
            "inflation",
            "inflate the grid of the blocked cells alone: Grid(grid.to_numpy())",
        )?;
        let or = |name, value: Option<&Bound<'_, PyAny>>, default| {
            value.map_or(Ok(default), |value| number(name, value))
        };
        let radius = number("inflation_radius", inflation_radius)?;
        let inscribed = or("inscribed_radius", inscribed_radius, 0.0)?;
        // Beyond that distance less than 1 of 252 would be left.
        let falling = if radius > inscribed { 252.0_f64.ln() / (radius - inscribed) } else { 0.0 };
        let inflation = Inflation {
            resolution: self.shared.world.map_or(1.0, |frame| frame.resolution()),
            inscribed_radius: inscribed,
            inflation_radius: radius,
            cost_scaling_factor: or("cost_scaling_factor", cost_scaling_factor, falling.min(f64::MAX))?,
            ..Inflation::default()
        };
        let weight = or("weight", weight, WEIGHT)?;
        let map = self.map().clone();
        let inflate = move |limits: &Limits| {
            let costmap = Costmap::from(&map).within(limits.clone()).inflated(&inflation)?;
            costmap.within(limits.clone()).costs_with(weight, &Traversal::default())
        };
        let costs = detached(py, self.cells(), Limits::new(), inflate)?.map_err(refused)?;
        Ok(Self::new(costs, self.shared.world))
    }

    /// The grid of a robot's costmap, a byte a cell, as nav2 has it.
    ///
    /// 0 is free, 1 to 252 is free and the nearer to an obstacle the more, 253 so near that the robot touches
    /// it, 254 an obstacle, 255 unknown. A cell up to 252 costs 1 + weight · byte / 252 for each cell of
    /// length; 253 and 254 are blocked.
    ///
    /// Parameters
    /// ----------
    /// costmap : array_like of int
    ///     The bytes, shape (rows, columns), the highest row first. The messages of ROS begin with the lowest
    ///     one: give ``array[::-1]``.
    /// weight : float
    ///     How much the bytes count, 0 or more: the dearest cells cost 1 + weight. It is what Smac 2D of nav2
    ///     calls ``cost_travel_multiplier``.
    /// unknown : int, optional
    ///     The byte for which unknown cells are taken, 0 to 252; by default they are blocked.
    /// world : World, optional
    ///     The place in the world of a map of this shape.
    ///
    /// Returns
    /// -------
    /// Grid
    ///     With costs.
    ///
    /// Raises
    /// ------
    /// ArgumentError
    ///     For numbers that are no bytes, for a weight that is negative, not finite or above 65535, and for
    ///     an unknown byte above 252.
    /// MapError
    ///     For a side of 0, or of more than 32768 cells.
    /// TypeError
    ///     For an array that holds no integers.
    ///
    /// Examples
    /// --------
    /// >>> import mediant
    /// >>> mediant.Grid.from_costmap([[0, 126, 252, 253, 254, 255]]).costs.tolist()
    /// [[1.0, 2.0, 3.0, nan, nan, nan]]
    /// >>> mediant.Grid.from_costmap([[0, 255]], weight=4, unknown=252).costs.tolist()
    /// [[1.0, 5.0]]
    #[staticmethod]
    #[pyo3(
        signature = (costmap, *, weight = None, unknown = None, world = None),
        text_signature = "(costmap, *, weight=2.0, unknown=None, world=None)"
    )]
    fn from_costmap(
        costmap: &Bound<'_, PyAny>,
        weight: Option<&Bound<'_, PyAny>>,
        unknown: Option<&Bound<'_, PyAny>>,
        world: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let costmap_of_bytes = read(&plane("costmap", costmap)?)?;
        let weight = weight.map_or(Ok(WEIGHT), |weight| number("weight", weight))?;
        let unknown = unknown.map(free_byte).transpose()?;
        let cells = costmap_of_bytes.bytes().len() as u64;
        let traversal = Traversal { unknown, ..Traversal::default() };
        let make =
            move |limits: &Limits| costmap_of_bytes.within(limits.clone()).costs_with(weight, &traversal);
        let costs = detached(costmap.py(), cells, Limits::new(), make)?.map_err(refused)?;
        let world = world.map_or(Ok(None), |world| placed(world, costs.map()))?;
        Ok(Self::new(costs, world))
    }
}

/// The weight of bytes where none is given: as in the program.
const WEIGHT: f64 = 2.0;

/// The bytes of an array.
fn read(array: &Bound<'_, PyUntypedArray>) -> PyResult<Costmap> {
    let name = "costmap";
    let side = |axis: usize| u32::try_from(array.shape()[axis]).unwrap_or(u32::MAX);
    let (rows, columns) = (side(0), side(1));
    let size = grid::Grid::check_size(columns.into(), rows.into());
    size.map_err(|error| raised_for(name, Error::from(error)))?;
    let dtype = array.dtype();
    if !matches!(dtype.kind(), b'i' | b'u') {
        return Err(PyTypeError::new_err(format!("{name}: expected integers from 0 to 255, found {dtype}")));
    }
    for (end, is_byte) in [("min", "__ge__"), ("max", "__le__")] {
        let found = array.call_method0(end)?.call_method0("__int__")?;
        let limit = if end == "min" { 0 } else { 255 };
        if !found.call_method1(is_byte, (limit,))?.is_truthy()? {
            let wrong = format!("expected bytes, found {found}: percentages go to Grid.from_occupancy");
            return Err(argument(name, &wrong));
        }
    }
    let bytes = array.call_method1("astype", ("uint8",))?.call_method0("tobytes")?;
    let costmap = Costmap::from_bytes(columns, rows, bytes.cast::<PyBytes>()?.as_bytes());
    costmap.map_err(|error| raised_for(name, error))
}

/// A byte of a cell that can be crossed.
fn free_byte(value: &Bound<'_, PyAny>) -> PyResult<u8> {
    let found = integer("unknown", value, 0)?;
    let byte = u8::try_from(found).ok().filter(|&byte| byte <= Costmap::DEAREST);
    byte.ok_or_else(|| argument("unknown", &format!("expected an integer from 0 to 252, found {found}")))
}

/// The exception for settings of costs that cannot be.
fn refused(error: Error) -> PyErr {
    match &error {
        Error::Costs(CostsError::Setting { name, value, expected }) => {
            argument(name, &format!("expected {expected}, found {value}"))
        }
        Error::Costs(error @ CostsError::SmallInflation { .. }) => {
            argument("inflation_radius", &error.to_string())
        }
        Error::Costs(error @ CostsError::Range { .. }) => argument("weight", &error.to_string()),
        _ => raised(error),
    }
}
