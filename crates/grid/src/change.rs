//! Edits of a map, as values.

use std::sync::Arc;

use crate::{Grid, Rectangle, grid::GridEdit};

/// An edit: the map before, the map after, and the cells between. It begins with a map that is not changed,
/// and takes any number of rectangles and scattered cells; whatever was prepared of the map before can be
/// repaired by work that follows these cells.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{Change, Grid, Rectangle};
///
/// let hall = Arc::new(Grid::from_fn(100, 50, |x, _| x == 30)?);
/// let door = Rectangle { x: 30, y: 7, width: 1, height: 2 };
/// let change = Change::new(hall).edit(door, |_, _| false).edit_cells([(99, 49, true)]);
/// assert!(change.after().is_free(30, 8) && change.before().is_blocked(30, 8));
/// assert_eq!(change.cells().len(), 2, "two places far apart");
/// # Ok::<(), mediant_grid::GridError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Change<M = Grid> {
    before: Arc<M>,
    after: Arc<M>,
    /// Outside of these the two are equal.
    cells: Vec<Rectangle>,
}

impl<M> Change<M> {
    /// The map before the change.
    #[must_use]
    pub const fn before(&self) -> &Arc<M> {
        &self.before
    }

    /// The map after the change.
    #[must_use]
    pub const fn after(&self) -> &Arc<M> {
        &self.after
    }

    /// Rectangles on the map outside of which the two are equal; empty if nothing was changed. Each lies in
    /// one block of 64 × 64 cells, and the cells that one edit changes in a block have one.
    #[must_use]
    pub fn cells(&self) -> &[Rectangle] {
        &self.cells
    }
}

impl Change {
    /// The change of no cell.
    #[must_use]
    pub fn new(map: Arc<Grid>) -> Self {
        Self { before: Arc::clone(&map), after: map, cells: Vec::new() }
    }

    /// The change from one map to another, whose cells are found by comparing the words of both; `None` for
    /// maps of different sizes.
    #[must_use]
    pub fn between(before: Arc<Grid>, after: Arc<Grid>) -> Option<Self> {
        if before.id().size() != after.id().size() {
            return None;
        }
        let cells = before.differences(&after);
        Some(Self { before, after, cells })
    }

    /// This change with other cells in a rectangle: `blocked(x, y)` is asked once for each cell that lies
    /// both in the rectangle and on the map, row by row.
    #[must_use]
    pub fn edit(self, at: Rectangle, mut blocked: impl FnMut(u32, u32) -> bool) -> Self {
        let at = self.after.on_map(at);
        self.with(|edit| at.cells().for_each(|(x, y)| edit.set(x, y, blocked(x, y))))
    }

    /// This change with other scattered cells: of each its column, its row, and whether it is blocked. The
    /// last word on a cell counts. Cells beyond the map are left out.
    #[must_use]
    pub fn edit_cells(self, cells: impl IntoIterator<Item = (u32, u32, bool)>) -> Self {
        let (width, height) = (self.after.width(), self.after.height());
        self.with(|edit| {
            let on_map = |&(x, y, _): &(u32, u32, bool)| x < width && y < height;
            cells.into_iter().filter(on_map).for_each(|(x, y, blocked)| edit.set(x, y, blocked));
        })
    }

    fn with(mut self, make: impl FnOnce(&mut GridEdit)) -> Self {
        // The map between two edits of one change is nobody's.
        let (mut edit, held) = match Arc::try_unwrap(self.after) {
            Ok(between) => (between.into_edit(), None),
            Err(held) => (held.begin_edit(), Some(held)),
        };
        make(&mut edit);
        let (after, cells) = edit.finish();
        self.after = held.filter(|_| cells.is_empty()).unwrap_or_else(|| Arc::new(after));
        self.cells.extend(cells);
        self
    }

    /// This change and the one after it, as one; `None` if the second does not begin where this one ends.
    #[must_use]
    pub fn then(mut self, next: Self) -> Option<Self> {
        if self.after.id() != next.before.id() {
            return None;
        }
        self.after = next.after;
        self.cells.extend(next.cells);
        Some(self)
    }
}
