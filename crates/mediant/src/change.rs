//! Edits of a map, as values.

#[cfg(feature = "costs")]
mod costs;

use std::sync::{Arc, OnceLock};

use mediant_grid::{Change as GridChange, Mismatch, Rectangle, Vertex};

#[cfg(feature = "costs")]
use crate::costs::newly_blocked;
use crate::{error::Error, map::Map, space::Space, surface::Surface};

/// An edit of a space: the space before, the space after, and the cells between. Indexes are
/// [repaired](crate::Index::repair) by it: what was prepared of the cells that did not change stays.
///
/// In a space of [costs](Map::costs) a change blocks cells, or changes their costs
/// ([`edit_costs`](Self::edit_costs)). A cell that is freed needs a cost.
///
/// ```
/// use mediant::{Engine, Map, Motion, Origin, Rectangle};
///
/// let space = Map::from_fn(40, 30, |x, _| x == 20)?.space(Motion::centers(3))?;
/// let index = space.prepare(Engine::Hpa)?;
/// // A door opens, and two posts are set far away: one change.
/// let change = space.edit(Rectangle::new(20, 7, 1, 2), |_, _| false)?.edit_cells([((0, 29), true), ((1, 0),
/// true)])?; let index = index.repair(&change)?;
/// assert_eq!(index.origin(), Origin::Repaired);
/// assert!(change.after().path((0, 0), (39, 0))?.is_some());
/// # Ok::<(), mediant::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Change {
    before: Space,
    /// Made when it is first asked for: after the last of several edits.
    after: OnceLock<Space>,
    change: GridChange,
    /// The costs after the change, if cells have costs then.
    surface: Option<Surface>,
    /// Where cells or costs changed, if cells had costs before or have them after it.
    with_costs: Vec<Rectangle>,
}

impl Change {
    /// The change of no cell.
    #[must_use]
    pub fn new(space: &Space) -> Self {
        let change = GridChange::new(Arc::clone(space.map().grid()));
        let surface = space.surface().cloned();
        Self { before: space.clone(), after: space.clone().into(), change, surface, with_costs: Vec::new() }
    }

    /// The change from one space to another, whose cells are found by comparing the two maps; that of all
    /// cells if they are of different sizes.
    ///
    /// # Errors
    /// [`Error::Mismatch`] for spaces of other rules or another k.
    pub fn between(before: &Space, after: &Space) -> Result<Self, Error> {
        if before.motion() != after.motion() {
            let (prepared, other) = ("the space before", "the space after");
            let (belongs_to, other_belongs_to) = (before.identity(), after.identity());
            return Err(Mismatch { prepared, belongs_to, other, other_belongs_to }.into());
        }
        let change = Self {
            after: after.clone().into(),
            surface: after.surface().cloned(),
            ..Self::to(before, after.map())
        };
        #[cfg(feature = "costs")]
        let change = change.with_differences();
        Ok(change)
    }

    /// The change from a space to that of another map with the same motion: its cells are found by comparing
    /// the two maps, word by word, and the space after it follows them. A map has no costs: nor has the space
    /// after it.
    ///
    /// ```
    /// use mediant::{Change, Map, Motion};
    ///
    /// let map = Map::new(40, 30)?;
    /// let space = map.space(Motion::default())?;
    /// let change = Change::to(&space, &map.set((3, 4), true)?);
    /// assert_eq!(change.cells().len(), 1);
    /// # Ok::<(), mediant::Error>(())
    /// ```
    #[must_use]
    pub fn to(before: &Space, map: &Map) -> Self {
        let [old, new] = [before.map(), map].map(|map| Arc::clone(map.grid()));
        let change = GridChange::between(old, Arc::clone(&new)).unwrap_or_else(|| GridChange::new(new));
        Self::of_grids(before, change)
    }

    /// The change of a grid, from a space of the grid before it.
    pub(crate) fn of_grids(before: &Space, change: GridChange) -> Self {
        let after = OnceLock::new();
        Self { before: before.clone(), after, change, surface: None, with_costs: Vec::new() }
    }

    /// The change of a grid, between the spaces of the grid before and after it, whose costs changed in these
    /// places.
    pub(crate) fn of_spaces(
        [before, after]: [&Space; 2],
        change: GridChange,
        with_costs: Vec<Rectangle>,
    ) -> Self {
        let surface = after.surface().cloned();
        Self { after: after.clone().into(), surface, with_costs, ..Self::of_grids(before, change) }
    }

    /// This change with other cells in a rectangle: see [`Map::edit`](crate::Map::edit).
    ///
    /// # Errors
    /// As for [`Map::edit`](crate::Map::edit); [`Error::Freed`] for a blocked cell that is freed where cells
    /// have costs.
    pub fn edit(mut self, at: Rectangle, blocked: impl FnMut(u32, u32) -> bool) -> Result<Self, Error> {
        self.before.map().check_edit(at)?;
        self.before.check_is_without_elevations()?;
        #[cfg(feature = "costs")]
        if self.surface.is_some() {
            let mut blocked = blocked;
            let columns = at.x..at.x.saturating_add(at.width).min(self.before.map().width());
            let rows = at.y..at.y.saturating_add(at.height).min(self.before.map().height());
            let cells = rows.flat_map(|y| columns.clone().map(move |x| (x, y)));
            let cells: Vec<_> = cells.map(|(x, y)| (x, y, blocked(x, y))).collect();
            return self.block(cells);
        }
        self.change = self.change.edit(at, blocked);
        self.after.take();
        Ok(self)
    }

    /// This change with other scattered cells: see [`Map::edit_cells`](crate::Map::edit_cells).
    ///
    /// # Errors
    /// As for [`Map::edit_cells`](crate::Map::edit_cells); [`Error::Freed`] as for [`edit`](Self::edit).
    pub fn edit_cells<C: Into<Vertex>>(
        mut self,
        cells: impl IntoIterator<Item = (C, bool)>,
    ) -> Result<Self, Error> {
        let cells = self.before.map().check_cells(cells)?;
        self.before.check_is_without_elevations()?;
        #[cfg(feature = "costs")]
        if self.surface.is_some() {
            return self.block(cells);
        }
        self.change = self.change.edit_cells(cells);
        self.after.take();
        Ok(self)
    }

    /// This change with cells blocked where cells have costs.
    #[cfg(feature = "costs")]
    fn block(self, cells: Vec<(u32, u32, bool)>) -> Result<Self, Error> {
        let new = newly_blocked(self.change.after(), cells)?;
        self.with_edits(new.into_iter().map(|(x, y)| (x, y, None)).collect())
    }

    /// The space before the change.
    #[must_use]
    pub const fn before(&self) -> &Space {
        &self.before
    }

    /// The space after the change.
    #[must_use]
    pub fn after(&self) -> &Space {
        self.after.get_or_init(|| self.before.follow(&self.change, self.surface.clone()))
    }

    /// Rectangles outside of which the two maps, and costs, are equal; empty if nothing was changed.
    #[must_use]
    pub fn cells(&self) -> &[Rectangle] {
        if self.has_costs() { &self.with_costs } else { self.change.cells() }
    }

    /// Whether cells had costs before the change, or have them after it.
    pub(crate) fn has_costs(&self) -> bool {
        self.before.has_costs() || self.surface.is_some()
    }

    /// The change of the bit-packed grid, for the typed crates.
    #[must_use]
    pub const fn of_grid(&self) -> &GridChange {
        &self.change
    }
}

impl Space {
    /// This space with other cells in a rectangle: see [`Map::edit`](crate::Map::edit). This space stays as
    /// it is; a change takes more edits, and repairs indexes.
    ///
    /// # Errors
    /// As for [`Map::edit`](crate::Map::edit).
    pub fn edit(&self, at: Rectangle, blocked: impl FnMut(u32, u32) -> bool) -> Result<Change, Error> {
        Change::new(self).edit(at, blocked)
    }

    /// This space with other scattered cells: see [`Map::edit_cells`](crate::Map::edit_cells).
    ///
    /// # Errors
    /// As for [`Map::edit_cells`](crate::Map::edit_cells).
    pub fn edit_cells<C: Into<Vertex>>(
        &self,
        cells: impl IntoIterator<Item = (C, bool)>,
    ) -> Result<Change, Error> {
        Change::new(self).edit_cells(cells)
    }
}
