//! Costs of cells.

use std::{collections::BTreeMap, fmt, sync::Arc};

use mediant_costs::{CostSurface, CostsError};
use mediant_grid::{Change, Grid, Interrupt, MapId, Rectangle, Vertex};

use crate::{
    error::Error, map::Map, memory_check, motion::Motion, never::NEVER, recent::Recent, space::Space,
};

/// A map whose free cells have a cost a unit of length: a cost surface, made by [`Map::costs`]. It never
/// changes; an edit makes another one. Clones share it.
///
/// **What a path costs.** A move costs the sum, over the cells that it crosses, of its length in the cell
/// times the cell's cost. So a step between two cells has half of its length in each. A move along the line
/// between two cells, as there are between corners, costs the lesser one of the two. Costs are exact integers
/// inside: results are the same on every platform, and where all cells cost 1 they are lengths.
///
/// **What there is on costs.** [`space`](Self::space) makes a [`Space`] for k = 2 to 8, with the queries,
/// limits, fields, tables and edits that all spaces have. Its engines are A*, Dijkstra's algorithm, A* on
/// landmarks, which are its index, Theta* and Lazy Theta*; others say so. The paths of the last two, and
/// smoothed ones ([`Smoothing::Linear`](crate::Smoothing::Linear)), turn at any angle, and cost no more than
/// the least over N(k). [`Path::cost`](crate::Path::cost), fields and limits are in
/// costs, [`Path::length`](crate::Path::length), tolerances and what is 'nearest' in cells. The bounds
/// against paths at any angle say nothing on costs. There are no exceptions, and
/// paths are not pulled taut.
#[derive(Clone)]
pub struct Costs {
    map: Map,
    surface: Arc<CostSurface>,
    recent: Arc<Recent>,
}

/// Costs of cells that were edited: column, row and cost; `None` is blocked.
pub(crate) type Edits = Vec<(u32, u32, Option<f64>)>;

impl Map {
    /// This map with costs of its cells, row by row: one for each cell, those of blocked cells are not looked
    /// at. A cost is a positive number, of any type that becomes an `f64`; a wall is a blocked cell of the
    /// map. Cells are 1 × 1; [`Costs::with_cell_size`] has others.
    ///
    /// ```
    /// use mediant::{Map, Motion};
    ///
    /// let map = Map::from_rows(["....", ".##.", "...."])?;
    /// // A road of cost 1 at the bottom, through land of cost 5.
    /// let costs = map.costs([
    ///     5, 5, 5, 5, //
    ///     1, 0, 0, 1, //
    ///     1, 1, 1, 1,
    /// ])?;
    /// let space = costs.space(Motion::centers(3))?;
    /// let path = space.path((0, 0), (3, 0))?.expect("there is a way");
    /// assert_eq!((path.cost(), path.length()), (11.0, 7.0));
    /// let field = space.field([(3, 2)])?;
    /// assert_eq!(field.get((0, 0)), Some(7.0));
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Costs`] for another number of costs than cells, for the first cost of a free cell that is
    /// zero, negative, infinite or not a number, and for costs that are more than 65,536 times as great as
    /// others (costs that are integers, on small maps, may differ by more); [`Error::OutOfMemory`].
    pub fn costs<C: Into<f64>>(&self, costs: impl IntoIterator<Item = C>) -> Result<Costs, Error> {
        Costs::new(self, costs, &NEVER)
    }
}

impl Costs {
    /// The costs of `width` × `height` cells of size 1 × 1, for which `cost(x, y)` is the cost of a cell, or
    /// `None` for a blocked one. It is asked twice for each.
    ///
    /// Sides may have up to [`CostSurface::MAX_SIDE`] cells, 2²⁰, as those of rasters may. If one is longer
    /// than [`Grid::MAX_SIDE`], there are A*, Dijkstra's algorithm, landmarks and fields on the costs, with
    /// all that paths and edits have; other engines, smoothing, and what there is on the [map](Self::map)
    /// without its costs say that they take no such sides.
    ///
    /// ```
    /// use mediant::{Costs, Map, Motion};
    ///
    /// // A pipeline along a strip of land.
    /// let strip = Costs::from_fn(100_000, 2, |x, y| (x % 1000 != 7 || y == 0).then_some(2.0))?;
    /// let field = strip.space(Motion::centers(4))?.field([(0, 0)])?;
    /// assert_eq!(field.get((99_999, 0)), Some(199_998.0));
    /// assert!(strip.map().path((0, 0), (9, 0)).is_err());
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Grid`] and [`Error::Costs`] for a side of 0, longer sides, and more cells than about 4.2
    /// billion, [`Error::NoRoom`] for more than there is memory, both before anything is allocated;
    /// [`Error::Costs`] as for [`Map::costs`].
    pub fn from_fn(width: u32, height: u32, cost: impl Fn(u32, u32) -> Option<f64>) -> Result<Self, Error> {
        Self::check_size(width, height)?;
        Self::of_surface(CostSurface::from_fn(width, height, cost)?, &NEVER)
    }

    /// Checks that there can be costs of so many cells, and that there is room for them: before the numbers
    /// of a file are read, say.
    ///
    /// # Errors
    /// [`Error::Grid`], [`Error::Costs`] or [`Error::NoRoom`] if not, as for [`from_fn`](Self::from_fn).
    pub fn check_size(width: u32, height: u32) -> Result<(), Error> {
        Grid::check_long_size(width.into(), height.into())?;
        CostSurface::check_size(width, height)?;
        memory_check::check_cells((width, height), BYTES_KEPT)
    }

    pub(crate) fn new<C: Into<f64>>(
        map: &Map,
        costs: impl IntoIterator<Item = C>,
        interrupt: &Interrupt,
    ) -> Result<Self, Error> {
        let columns = map.width() as usize;
        let expected = u64::from(map.width()) * u64::from(map.height());
        memory_check::check("the costs", expected.saturating_mul(BYTES))?;
        let costs = memory_check::collected("the costs", costs.into_iter().map(Into::into))?;
        if costs.len() as u64 != expected {
            return Err(CostsError::Count { found: costs.len(), expected }.into());
        }
        let cost = |x: u32, y: u32| costs[y as usize * columns + x as usize];
        Self::of(map, (1.0, 1.0), interrupt, cost)
    }

    pub(crate) fn of(
        map: &Map,
        cell_size: (f64, f64),
        interrupt: &Interrupt,
        cost: impl Fn(u32, u32) -> f64,
    ) -> Result<Self, Error> {
        let (grid, size) = (map.grid(), (map.width(), map.height()));
        let cost = |x: u32, y: u32| grid.is_free(x as i32, y as i32).then(|| cost(x, y));
        let surface = CostSurface::with_cells(size, cell_size, interrupt, cost)?;
        // Without what the map keeps for paths of its own.
        Ok(Self::of_parts(Arc::clone(grid).into(), Arc::new(surface)))
    }

    /// A map and the surface of its costs, which have the same blocked cells.
    pub(crate) fn of_parts(map: Map, surface: Arc<CostSurface>) -> Self {
        Self { map, surface, recent: Arc::default() }
    }

    /// These costs without what they keep, of which a space of them may become a part.
    pub(crate) fn alone(&self) -> Self {
        Self::of_parts(Arc::clone(self.map.grid()).into(), Arc::clone(&self.surface))
    }

    pub(crate) const fn recent(&self) -> &Arc<Recent> {
        &self.recent
    }

    /// The same costs on cells of another width and height, which are numbers of any unit of length: a cost
    /// is one a unit.
    ///
    /// ```
    /// use mediant::{Map, Motion};
    ///
    /// let costs = Map::new(4, 3)?.costs([2.0; 12])?.with_cell_size(30.0, 20.0)?;
    /// let path = costs.space(Motion::centers(4))?.path((0, 0), (0, 2))?.expect("there is a way");
    /// assert_eq!((path.cost(), path.length()), (80.0, 2.0));
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Costs`] for a size that is no positive number, or if one is more than 65,536 times the other.
    pub fn with_cell_size(&self, x: f64, y: f64) -> Result<Self, Error> {
        let cost = |x: u32, y: u32| self.surface.cost(x, y).unwrap_or(f64::NAN);
        Self::of(&self.map, (x, y), &NEVER, cost)
    }

    /// The map: which cells are blocked.
    #[must_use]
    pub const fn map(&self) -> &Map {
        &self.map
    }

    /// The cost of a cell a unit of length; `None` for a blocked cell and outside the map. Costs that are not
    /// integers are kept in 32 bits, rounded by 2⁻³² of the greatest at most.
    #[must_use]
    pub fn cost(&self, cell: impl Into<Vertex>) -> Option<f64> {
        let Vertex { x, y } = cell.into();
        self.surface.cost(u32::try_from(x).ok()?, u32::try_from(y).ok()?)
    }

    /// The least and the greatest cost of the map; after edits, those of the map that it was edited from, as
    /// long as all costs are between them.
    #[must_use]
    pub fn bounds(&self) -> (f64, f64) {
        self.surface.bounds()
    }

    /// The width and the height of a cell.
    #[must_use]
    pub fn cell_size(&self) -> (f64, f64) {
        self.surface.cell_size()
    }

    /// The same costs, but those of some cells: of each its new cost, or `None` for a wall. The last word on
    /// a cell counts. The work follows the cells where the costs stay within the
    /// [`bounds`](Self::bounds), else it follows the map.
    ///
    /// [`Space::edit_costs`] makes a [`Change`](crate::Change), which indexes, planners and fields follow.
    ///
    /// ```
    /// use mediant::Map;
    ///
    /// let costs = Map::new(3, 1)?.costs([1, 5, 1])?.edit_cells([((1, 0), Some(2.0)), ((2, 0), None)])?;
    /// assert_eq!((costs.cost((1, 0)), costs.cost((2, 0))), (Some(2.0), None));
    /// assert!(costs.map().is_blocked((2, 0)));
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::EditCell`] for a cell outside the map; [`Error::Costs`] as for [`Map::costs`].
    pub fn edit_cells<C: Into<Vertex>>(
        &self,
        cells: impl IntoIterator<Item = (C, Option<f64>)>,
    ) -> Result<Self, Error> {
        let cells = self.map.check_cells(cells)?;
        if self.has(&cells) {
            return Ok(self.clone());
        }
        self.recent.settle();
        let surface = Arc::new(self.surface.edit(cells.iter().copied())?);
        let places = cells.iter().map(|&(x, y, _)| Rectangle::new(x, y, 1, 1)).collect();
        let blocked = cells.into_iter().map(|(x, y, cost)| (x, y, cost.is_none()));
        let change = Change::new(Arc::clone(self.map.grid())).edit_cells(blocked);
        let recent = Recent::after(&self.recent, &change, places);
        Ok(Self { map: Arc::clone(change.after()).into(), surface, recent: Arc::new(recent) })
    }

    /// The same costs, but with cells of a rectangle blocked: `blocked(x, y)` is asked once for each of its
    /// cells, row by row. Cells of the rectangle beyond the map are left out.
    ///
    /// # Errors
    /// [`Error::Edit`] for a rectangle that lies outside the map as a whole; [`Error::Freed`] for a blocked
    /// cell that is freed: it needs a cost, of [`edit_cells`](Self::edit_cells).
    pub fn edit(&self, at: Rectangle, mut blocked: impl FnMut(u32, u32) -> bool) -> Result<Self, Error> {
        self.map.check_edit(at)?;
        let columns = at.x..at.x.saturating_add(at.width).min(self.map.width());
        let rows = at.y..at.y.saturating_add(at.height).min(self.map.height());
        let cells = rows.flat_map(|y| columns.clone().map(move |x| (x, y)));
        self.block_cells(cells.map(|(x, y)| (Vertex::new(x as i32, y as i32), blocked(x, y))))
    }

    /// The same costs, but with scattered cells blocked. The last word on a cell counts.
    ///
    /// # Errors
    /// [`Error::EditCell`] for a cell outside the map; [`Error::Freed`] as for [`edit`](Self::edit).
    pub fn block_cells<C: Into<Vertex>>(
        &self,
        cells: impl IntoIterator<Item = (C, bool)>,
    ) -> Result<Self, Error> {
        let cells = newly_blocked(self.map.grid(), self.map.check_cells(cells)?)?;
        self.edit_cells(cells.into_iter().map(|(x, y)| ((x as i32, y as i32), None)))
    }

    /// Whether an edit changes nothing: an equal version beside this one would be held as long as the index
    /// of either, and the next edit could not take its memory.
    pub(crate) fn has(&self, cells: &[(u32, u32, Option<f64>)]) -> bool {
        cells.iter().all(|&(x, y, cost)| self.surface.cost(x, y) == cost)
    }

    /// These costs with rules of motion and a k, from 2 to 8.
    ///
    /// # Errors
    /// [`Error::K`] for a number that is no k, [`SetupError::CostsK`](crate::errors::SetupError::CostsK) for
    /// another k.
    pub fn space(&self, motion: impl Into<Motion>) -> Result<Space, Error> {
        Space::of_costs(self, motion.into(), &NEVER)
    }

    /// The unit of the integers in which searches count costs, a power of two: an
    /// [`Observer`](crate::search::Observer) is told [`Cost`](crate::Cost)s of which
    /// [`to_bits`](crate::Cost::to_bits) has the number of units.
    #[must_use]
    pub fn unit(&self) -> f64 {
        self.surface.unit()
    }

    /// The identity: the same for costs with the same cells, costs and bounds. It is none of a map's.
    #[must_use]
    pub fn id(&self) -> MapId {
        self.surface.id()
    }

    /// The surface, for the typed crate `mediant-costs`.
    #[must_use]
    pub const fn surface(&self) -> &Arc<CostSurface> {
        &self.surface
    }
}

/// Of cells that are to be blocked or free, those that are blocked now. The last word on a cell counts.
pub(crate) fn newly_blocked(grid: &Grid, cells: Vec<(u32, u32, bool)>) -> Result<Vec<(u32, u32)>, Error> {
    let last: BTreeMap<(u32, u32), bool> =
        cells.into_iter().map(|(x, y, blocked)| ((x, y), blocked)).collect();
    let changed = |&(&(x, y), &blocked): &(&(u32, u32), &bool)| grid.is_free(x as i32, y as i32) == blocked;
    let changed: Vec<_> = last.iter().filter(changed).collect();
    match changed.iter().find(|&&(_, &blocked)| !blocked) {
        Some(&(&(x, y), _)) => Err(Error::Freed { cell: Vertex::new(x as i32, y as i32) }),
        None => Ok(changed.into_iter().map(|(&at, _)| at).collect()),
    }
}

/// The bytes of a cell while costs are read.
const BYTES: u64 = (size_of::<f64>() + size_of::<u32>()) as u64;

/// The bytes of a cell that are kept: its cost, twice its bit, and what the connected components take.
const BYTES_KEPT: u64 = size_of::<u32>() as u64 + 1;

/// Costs with the same cells, costs and bounds are one.
impl PartialEq for Costs {
    fn eq(&self, other: &Self) -> bool {
        self.surface == other.surface
    }
}

impl fmt::Debug for Costs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Costs")
            .field("id", &self.id())
            .field("bounds", &self.bounds())
            .finish_non_exhaustive()
    }
}
