//! Edits of costs of cells.

use std::sync::Arc;

use mediant_costs::CostSurface;
use mediant_grid::{Rectangle, Vertex};

use super::Change;
use crate::{
    costs::{Costs, Edits},
    error::Error,
    setup_error::SetupError,
    space::Space,
};

/// The side of the blocks in which costs are compared, as in the changes of maps.
const BLOCK: u32 = 64;

impl Change {
    /// This change with other costs of cells: see [`Costs::edit_cells`].
    ///
    /// # Errors
    /// As for [`Costs::edit_cells`]; [`SetupError::WithoutCosts`] where cells have no costs.
    pub fn edit_costs<C: Into<Vertex>>(
        self,
        cells: impl IntoIterator<Item = (C, Option<f64>)>,
    ) -> Result<Self, Error> {
        let cells = self.before.map().check_cells(cells)?;
        self.with_edits(cells)
    }

    /// The cells of this change whose costs differ between two surfaces.
    pub(crate) fn cells_between(&self, [old, new]: [&CostSurface; 2]) -> Vec<(u32, u32)> {
        let cells = self.each_cell(new.width(), new.height());
        cells.filter(|&(x, y)| old.cost(x, y) != new.cost(x, y)).collect()
    }

    /// The cells of this change that are on a map of this size.
    pub(crate) fn each_cell(&self, width: u32, height: u32) -> impl Iterator<Item = (u32, u32)> {
        self.cells().iter().flat_map(move |at| {
            let columns = at.x..at.x.saturating_add(at.width).min(width);
            let rows = at.y..at.y.saturating_add(at.height).min(height);
            rows.flat_map(move |y| columns.clone().map(move |x| (x, y)))
        })
    }

    pub(super) fn with_edits(mut self, cells: Edits) -> Result<Self, Error> {
        self.before.check_is_without_elevations()?;
        let surface = self.surface.as_ref().ok_or(SetupError::WithoutCosts)?;
        if surface.costs.has(&cells) {
            return Ok(self);
        }
        let edited = Arc::new(surface.costs.surface().edit(cells.iter().copied())?);
        let places: Vec<_> = cells.iter().map(|&(x, y, _)| Rectangle::new(x, y, 1, 1)).collect();
        self.change = self.change.edit_cells(cells.into_iter().map(|(x, y, cost)| (x, y, cost.is_none())));
        let map = Arc::clone(self.change.after()).into();
        self.surface = Some(surface.after(&Costs::of_parts(map, edited), &places)?);
        self.with_costs.extend(places);
        self.after.take();
        Ok(self)
    }

    /// This change with the places where costs differ, found by comparing all cells.
    pub(super) fn with_differences(mut self) -> Self {
        if !self.has_costs() {
            return self;
        }
        let map = self.before.map();
        let (width, height) = (map.width(), map.height());
        let all = Rectangle::new(0, 0, width, height);
        let (Some(old), Some(new)) =
            (self.before.costs(), self.surface.as_ref().map(|surface| &surface.costs))
        else {
            self.with_costs = vec![all];
            return self;
        };
        if old.id().size() != new.id().size() {
            self.with_costs = vec![all];
            return self;
        }
        let blocks = (0..height)
            .step_by(BLOCK as usize)
            .flat_map(|y| (0..width).step_by(BLOCK as usize).map(move |x| (x, y)));
        let (one, other) = (old.surface(), new.surface());
        let differing = |(left, top): (u32, u32)| {
            let rows = top..height.min(top + BLOCK);
            let cells = rows.flat_map(|y| (left..width.min(left + BLOCK)).map(move |x| (x, y)));
            let spans = cells.filter(|&(x, y)| one.cost(x, y) != other.cost(x, y));
            spans.fold(None, |known: Option<[u32; 4]>, (x, y)| {
                let [left, top, right, bottom] = known.unwrap_or([x, y, x, y]);
                Some([left.min(x), top.min(y), right.max(x), bottom.max(y)])
            })
        };
        let rectangle = |[left, top, right, bottom]: [u32; 4]| {
            Rectangle::new(left, top, right - left + 1, bottom - top + 1)
        };
        self.with_costs = blocks.filter_map(differing).map(rectangle).collect();
        self
    }
}

impl Space {
    /// This space of [costs](crate::Map::costs) with other costs of some cells: see [`Costs::edit_cells`].
    /// This space stays as it is; a change takes more edits, and indexes, planners and fields follow it.
    ///
    /// ```
    /// use mediant::{Engine, Map, Motion};
    ///
    /// let space = Map::new(9, 3)?.costs([1.0; 27])?.space(Motion::default())?;
    /// let mut planner = space.planner(Engine::AStar)?;
    /// // A swamp, and a wall.
    /// let change = space.edit_costs([((4, 1), Some(5.0)), ((4, 0), None)])?;
    /// planner.follow(&planner.index().repair(&change)?)?;
    /// let path = planner.path((0, 1), (8, 1))?.expect("there is a way");
    /// assert_eq!(path.to_string(), "(0, 1) → (3, 1) → (4, 2) → (5, 1) → (8, 1)");
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// As for [`Change::edit_costs`].
    pub fn edit_costs<C: Into<Vertex>>(
        &self,
        cells: impl IntoIterator<Item = (C, Option<f64>)>,
    ) -> Result<Change, Error> {
        Change::new(self).edit_costs(cells)
    }
}
