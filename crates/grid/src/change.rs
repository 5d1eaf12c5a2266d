//! Edits of a map, as values.

use std::{collections::BTreeMap, sync::Arc};

use crate::{Grid, Rectangle};

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

/// The side of the tiles in which scattered cells become one rectangle. A word of the map has as many cells.
const TILE: u32 = 64;

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

    /// Rectangles on the map outside of which the two are equal; empty if nothing was changed. Cells in one
    /// block of 64 × 64 have one rectangle, unless they were edited as several.
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
        let mut cells = Tiles::default();
        if before.id() != after.id() {
            for y in 0..before.height() {
                for (word, difference) in before.differing_words(&after, y) {
                    let (first, last) = (difference.trailing_zeros(), 63 - difference.leading_zeros());
                    let (x, width) = (word * TILE + first, last - first + 1);
                    cells.add(Rectangle { x, y, width, height: 1 });
                }
            }
        }
        Some(Self { before, after, cells: cells.into_rectangles() })
    }

    /// This change with other cells in a rectangle: `blocked(x, y)` is asked once for each cell that lies
    /// both in the rectangle and on the map, row by row.
    #[must_use]
    pub fn edit(mut self, at: Rectangle, blocked: impl FnMut(u32, u32) -> bool) -> Self {
        let at = self.after.on_map(at);
        if at.width > 0 && at.height > 0 {
            self.after = Arc::new(self.after.with_rectangle(at, blocked));
            self.cells.push(at);
        }
        self
    }

    /// This change with other scattered cells: of each its column, its row, and whether it is blocked. The
    /// last word on a cell counts. Cells beyond the map are left out.
    #[must_use]
    pub fn edit_cells(mut self, cells: impl IntoIterator<Item = (u32, u32, bool)>) -> Self {
        let (mut tiles, map) = (Tiles::default(), Arc::clone(&self.after));
        let on_map = |&(x, y, _): &(u32, u32, bool)| x < map.width() && y < map.height();
        let cells: Vec<_> = cells.into_iter().filter(on_map).collect();
        if cells.is_empty() {
            return self;
        }
        for &(x, y, _) in &cells {
            tiles.add(Rectangle { x, y, width: 1, height: 1 });
        }
        self.after = Arc::new(self.after.with_cells(cells));
        self.cells.extend(tiles.into_rectangles());
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

/// Rectangles of cells, one a tile.
#[derive(Default)]
struct Tiles(BTreeMap<(u32, u32), Rectangle>);

impl Tiles {
    /// Adds a rectangle that lies in one tile.
    fn add(&mut self, at: Rectangle) {
        let tile = (at.y / TILE, at.x / TILE);
        self.0.entry(tile).and_modify(|known| *known = known.around(at)).or_insert(at);
    }

    fn into_rectangles(self) -> Vec<Rectangle> {
        self.0.into_values().collect()
    }
}
