//! Cost surfaces: maps with a cost for each cell.

use std::fmt;

use mediant_grid::{Grid, Interrupt, MapId, Versioned, room_for};

use crate::{
    error::CostsError,
    layout::Layout,
    scale::{Scale, is_amount},
};

/// A cost surface: a map whose free cells have a cost a unit of length.
///
/// It never changes; [`edit`](Self::edit) makes another one. Its costs are kept as integers of 32 bits:
/// exactly where they are integers, else rounded once, by 2⁻³² of the greatest at most.
///
/// ```
/// use mediant_costs::CostSurface;
///
/// // A road of cost 1 between swamps of cost 5; 0 stands for a wall here.
/// let rows = [[5, 5, 5, 0], [1, 1, 1, 1], [5, 0, 5, 5]];
/// let map = CostSurface::from_fn(4, 3, |x, y| match rows[y as usize][x as usize] {
///     0 => None,
///     cost => Some(f64::from(cost)),
/// })?;
/// assert_eq!((map.cost(0, 1), map.cost(3, 0)), (Some(1.0), None));
/// # Ok::<(), mediant_costs::CostsError>(())
/// ```
#[derive(Clone)]
pub struct CostSurface {
    layout: Layout,
    /// By position; 0 is blocked.
    weights: Versioned<u32>,
    scale: Scale,
    id: MapId,
}

/// The meaning of a surface's integers. [`CostSurface::in_units`] makes the same surface again, of its costs
/// and these, wherever they were sent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CostUnits {
    /// The [bounds](CostSurface::bounds) of the costs.
    pub bounds: (f64, f64),
    /// The unit of costs as they are kept: each is a multiple of it, below 2³². It is 1 where all are
    /// integers.
    pub step: f64,
    /// The width and the height of a cell.
    pub cell_size: (f64, f64),
}

/// The width and the height of a cell where nothing is said: 1 × 1.
const UNIT_CELL: (f64, f64) = (1.0, 1.0);
/// The stage that an interrupted call names.
const STAGE: &str = "reading the costs";

/// The costs that were seen so far.
#[derive(Default)]
struct Bounds {
    /// The least and the greatest.
    bounds: Option<(f64, f64)>,
    has_fractions: bool,
}

impl Bounds {
    fn include(&mut self, (x, y): (u32, u32), cost: f64) -> Result<(), CostsError> {
        if !is_amount(cost) {
            return Err(CostsError::Cost { x, y, cost });
        }
        self.has_fractions |= cost.fract() != 0.0;
        let (least, greatest) = self.bounds.unwrap_or((cost, cost));
        self.bounds = Some((least.min(cost), greatest.max(cost)));
        Ok(())
    }

    fn scale(&self, layout: Layout, cell_size: (f64, f64)) -> Result<Scale, CostsError> {
        let vertices = (u64::from(layout.width()) + 1) * (u64::from(layout.height()) + 1);
        Scale::new(vertices, self.bounds.unwrap_or((1.0, 1.0)), !self.has_fractions, cell_size)
    }
}

impl CostSurface {
    /// The longest side, in cells.
    pub const MAX_SIDE: u32 = Layout::MAX_SIDE;

    /// The surface of `width` × `height` cells of size 1 × 1, for which `cost(x, y)` is the cost a unit of
    /// length, or `None` for a blocked cell. It is asked twice for each cell.
    ///
    /// # Errors
    /// [`CostsError::Size`], before anything is allocated; [`CostsError::Cost`] for the first cost, row by
    /// row, that is no positive number; [`CostsError::Range`] for costs too far apart.
    pub fn from_fn(
        width: u32,
        height: u32,
        cost: impl Fn(u32, u32) -> Option<f64>,
    ) -> Result<Self, CostsError> {
        Self::with_cells((width, height), UNIT_CELL, &Interrupt::NEVER, cost)
    }

    /// [`from_fn`](Self::from_fn) for cells of another size, which an interrupt can stop. The unit of length
    /// is that of the cell size.
    ///
    /// # Errors
    /// As for [`from_fn`](Self::from_fn); [`CostsError::CellSize`]; [`CostsError::Interrupted`].
    pub fn with_cells(
        (width, height): (u32, u32),
        cell_size: (f64, f64),
        interrupt: &Interrupt,
        cost: impl Fn(u32, u32) -> Option<f64>,
    ) -> Result<Self, CostsError> {
        let layout = Self::layout_of(width, height)?;
        let mut bounds = Bounds::default();
        for y in 0..height {
            interrupt.check(STAGE)?;
            for (x, cost) in (0..width).filter_map(|x| Some((x, cost(x, y)?))) {
                bounds.include((x, y), cost)?;
            }
        }
        let scale = bounds.scale(layout, cell_size)?;
        Self::filled(layout, scale, interrupt, |x, y| cost(x, y).and_then(|cost| scale.weight(cost)))
    }

    /// The surface that has these [units](Self::units), of its costs as it tells them.
    ///
    /// ```
    /// use mediant_costs::CostSurface;
    /// use mediant_grid::Interrupt;
    ///
    /// // The greatest cost was another one: the units are those of before.
    /// let map = CostSurface::from_fn(3, 1, |x, _| Some(0.5 + f64::from(x)))?.edit([(2, 0, Some(0.7))])?;
    /// let again = CostSurface::in_units((3, 1), map.units(), &Interrupt::NEVER, |x, y| map.cost(x, y))?;
    /// assert_eq!(again.id(), map.id());
    /// # Ok::<(), mediant_costs::CostsError>(())
    /// ```
    ///
    /// # Errors
    /// As for [`with_cells`](Self::with_cells); [`CostsError::Cost`], too, for a cost out of bounds.
    pub fn in_units(
        (width, height): (u32, u32),
        units: CostUnits,
        interrupt: &Interrupt,
        cost: impl Fn(u32, u32) -> Option<f64>,
    ) -> Result<Self, CostsError> {
        let layout = Self::layout_of(width, height)?;
        let CostUnits { bounds: (least, greatest), step, cell_size } = units;
        let mut bounds = Bounds { bounds: None, has_fractions: step.to_bits() != 1.0_f64.to_bits() };
        bounds.include((0, 0), least)?;
        bounds.include((0, 0), greatest)?;
        let scale = bounds.scale(layout, cell_size)?;
        for y in 0..height {
            interrupt.check(STAGE)?;
            let mut costs = (0..width).filter_map(|x| Some((x, cost(x, y)?)));
            if let Some((x, cost)) = costs.find(|&(_, cost)| scale.weight(cost).is_none()) {
                return Err(CostsError::Cost { x, y, cost });
            }
        }
        Self::filled(layout, scale, interrupt, |x, y| cost(x, y).and_then(|cost| scale.weight(cost)))
    }

    /// The surface of cells of a side, given by bytes, row by row, whose costs are those of a table.
    pub(crate) fn of_bytes(
        (width, height): (u32, u32),
        bytes: &[u8],
        costs: &[Option<f64>; 256],
        side: f64,
        interrupt: &Interrupt,
    ) -> Result<Self, CostsError> {
        let layout = Self::layout_of(width, height)?;
        let (mut bounds, mut seen) = (Bounds::default(), [false; 256]);
        for (y, row) in (0..height).zip(bytes.chunks_exact(width as usize)) {
            interrupt.check(STAGE)?;
            for (x, &byte) in (0..width).zip(row) {
                if !std::mem::replace(&mut seen[usize::from(byte)], true)
                    && let Some(cost) = costs[usize::from(byte)]
                {
                    bounds.include((x, y), cost)?;
                }
            }
        }
        let scale = bounds.scale(layout, (side, side))?;
        let weights = costs.map(|cost| cost.and_then(|cost| scale.weight(cost)));
        let index = |x: u32, y: u32| y as usize * width as usize + x as usize;
        Self::filled(layout, scale, interrupt, |x, y| weights[usize::from(bytes[index(x, y)])])
    }

    /// Checks that a surface may have these sides; nothing is allocated.
    ///
    /// # Errors
    /// [`CostsError::Size`] if not.
    pub fn check_size(width: u32, height: u32) -> Result<(), CostsError> {
        Self::layout_of(width, height).map(drop)
    }

    fn layout_of(width: u32, height: u32) -> Result<Layout, CostsError> {
        let (width, height) = (width.into(), height.into());
        Layout::new(width, height).ok_or(CostsError::Size { width, height })
    }

    /// The surface of these weights. A cell without one is blocked; so is one whose cost has become another
    /// since the scale was made.
    fn filled(
        layout: Layout,
        scale: Scale,
        interrupt: &Interrupt,
        weight: impl Fn(u32, u32) -> Option<u32>,
    ) -> Result<Self, CostsError> {
        room_for::<u32>(layout.len(), STAGE)?;
        let mut weights = vec![0; layout.len()];
        for y in 0..layout.height() {
            interrupt.check(STAGE)?;
            for x in 0..layout.width() {
                weights[layout.position(x as i32, y as i32)] = weight(x, y).unwrap_or(0);
            }
        }
        let id = identity(layout, &weights, &scale, interrupt)?;
        Ok(Self { layout, weights: weights.into(), scale, id })
    }

    /// The surface on which every free cell of a map costs 1: paths on it are those on the map.
    ///
    /// # Errors
    /// [`CostsError::Interrupted`].
    pub fn uniform(grid: &Grid, interrupt: &Interrupt) -> Result<Self, CostsError> {
        let size = (grid.width(), grid.height());
        Self::with_cells(size, UNIT_CELL, interrupt, |x, y| grid.is_free(x as i32, y as i32).then_some(1.0))
    }

    /// The number of columns.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.layout.width()
    }

    /// The number of rows.
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.layout.height()
    }

    /// The width and the height of a cell.
    #[must_use]
    pub const fn cell_size(&self) -> (f64, f64) {
        self.scale.cell_size
    }

    /// The cost of a cell a unit of length, as it is kept; `None` for a blocked cell and outside.
    #[must_use]
    pub fn cost(&self, x: u32, y: u32) -> Option<f64> {
        if x >= self.width() || y >= self.height() {
            return None;
        }
        let weight = self.weights[self.layout.position(x as i32, y as i32)];
        (weight > 0).then(|| self.scale.cost_of_weight(weight))
    }

    /// Whether a cell is blocked; those outside the map are.
    #[must_use]
    pub fn is_blocked(&self, x: i32, y: i32) -> bool {
        u32::try_from(x).ok().zip(u32::try_from(y).ok()).is_none_or(|(x, y)| self.cost(x, y).is_none())
    }

    /// The bounds of the costs: the least and the greatest of the map, or of the one that it was edited from.
    #[must_use]
    pub fn bounds(&self) -> (f64, f64) {
        (self.scale.cost_of_weight(self.scale.least), self.scale.cost_of_weight(self.scale.greatest))
    }

    /// The unit of the integer costs of moves and paths on it: a power of two.
    #[must_use]
    pub fn unit(&self) -> f64 {
        self.scale.unit()
    }

    /// The units of its integers, and the bounds of its costs.
    #[must_use]
    pub fn units(&self) -> CostUnits {
        CostUnits { bounds: self.bounds(), step: self.scale.cost_of_weight(1), cell_size: self.cell_size() }
    }

    /// This surface with the costs of some cells changed: of each its column, its row, and its cost, or
    /// `None` for blocked. The last word on a cell counts. The work follows the cells, once the memory of an
    /// earlier version is given up; else the costs are copied.
    ///
    /// Costs within the [`bounds`](Self::bounds) keep the map's units, and so the integers of all paths that
    /// do not touch the cells. Others (and the first that is no integer on a map of integers) make a surface
    /// anew.
    ///
    /// # Errors
    /// [`CostsError::Outside`], [`CostsError::Cost`], [`CostsError::Range`].
    pub fn edit(&self, cells: impl IntoIterator<Item = (u32, u32, Option<f64>)>) -> Result<Self, CostsError> {
        let cells: Vec<_> = cells.into_iter().collect();
        let mut edit = self.weights.edit_if_room(STAGE)?;
        let mut id = self.id;
        for &(x, y, cost) in &cells {
            if x >= self.width() || y >= self.height() {
                return Err(CostsError::Outside { x, y });
            }
            let weight = match cost {
                None => 0,
                Some(cost) if !is_amount(cost) => {
                    return Err(CostsError::Cost { x, y, cost });
                }
                Some(cost) => match self.scale.weight(cost) {
                    Some(weight) => weight,
                    None => return self.anew(&cells),
                },
            };
            let at = self.layout.position(x as i32, y as i32);
            let pair = |weights: &[u32]| word(weights[at & !1], weights[at | 1]);
            let before = pair(edit.words());
            edit.set(at, weight);
            id = id.with_term(at as u64 / 2, [before, pair(edit.words())]);
        }
        Ok(Self { weights: edit.finish(), id, ..*self })
    }

    /// The identity of this surface with these cells as they are on another one, of the same size and units.
    pub(crate) fn id_with(&self, cells: &[(u32, u32)], other: &Self) -> MapId {
        let is_on = |x, y| x < self.width() && y < self.height();
        let on = cells.iter().filter(|&&(x, y)| is_on(x, y));
        let mut pairs: Vec<usize> = on.map(|&(x, y)| self.layout.position(x as i32, y as i32) / 2).collect();
        pairs.sort_unstable();
        pairs.dedup();
        let pair = |weights: &[u32], at: usize| word(weights[2 * at], weights[2 * at + 1]);
        pairs.into_iter().fold(self.id, |id, at| {
            id.with_term(at as u64, [pair(&self.weights, at), pair(&other.weights, at)])
        })
    }

    /// This surface with other costs, in units of their own.
    fn anew(&self, cells: &[(u32, u32, Option<f64>)]) -> Result<Self, CostsError> {
        let mut changed = std::collections::BTreeMap::new();
        changed.extend(cells.iter().map(|&(x, y, cost)| ((x, y), cost)));
        let size = (self.width(), self.height());
        Self::with_cells(size, self.cell_size(), &Interrupt::NEVER, |x, y| {
            changed.get(&(x, y)).copied().unwrap_or_else(|| self.cost(x, y))
        })
    }

    /// The identity of the surface: the same for all with the same cells, costs and units.
    #[must_use]
    pub const fn id(&self) -> MapId {
        self.id
    }

    /// The memory used, in bytes.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        size_of_val(&*self.weights)
    }

    pub(crate) const fn layout(&self) -> Layout {
        self.layout
    }

    pub(crate) const fn scale(&self) -> &Scale {
        &self.scale
    }

    /// By position; 0 is blocked.
    #[inline]
    pub(crate) fn weights(&self) -> &[u32] {
        &self.weights
    }
}

/// Two weights as a word.
const fn word(low: u32, high: u32) -> u64 {
    (high as u64) << 32 | low as u64
}

fn identity(
    layout: Layout,
    weights: &[u32],
    scale: &Scale,
    interrupt: &Interrupt,
) -> Result<MapId, CostsError> {
    let mut id = MapId::of_size(layout.width(), layout.height());
    for (number, value) in scale.words().into_iter().enumerate() {
        id = id.with_term(u64::MAX - number as u64, [0, value]);
    }
    for (band, weights) in weights.chunks(1 << 16).enumerate() {
        interrupt.check("digesting the costs")?;
        let (pairs, _) = weights.as_chunks::<2>();
        for (at, &[low, high]) in pairs.iter().enumerate().filter(|(_, pair)| **pair != [0, 0]) {
            id = id.with_term((band << 15 | at) as u64, [0, word(low, high)]);
        }
    }
    Ok(id)
}

/// Surfaces with the same cells, costs and units are one.
impl PartialEq for CostSurface {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id && self.weights() == other.weights()
    }
}

impl fmt::Debug for CostSurface {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("CostSurface")
            .field("id", &self.id)
            .field("bounds", &self.bounds())
            .finish_non_exhaustive()
    }
}
