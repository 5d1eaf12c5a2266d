//! Maps of discs and squares that follow edits of the obstacles.

use std::{ops::Range, sync::Arc};

use mediant_grid::{Change as GridChange, Grid, Rectangle, Vertex};

use crate::{change::Change, error::Error, map::Map, motion::Motion, space::Space};

/// A disc among obstacles that change: the map of the obstacles, and that of the disc ([`Map::disc`]).
///
/// ```
/// use mediant::{Engine, K, Map, Motion, Rectangle};
///
/// let motion = Motion::centers(K::N8);
/// let disc = Map::from_fn(40, 9, |_, _| false)?.disc(1.5, motion)?;
/// let space = disc.map().space(motion)?;
/// let index = space.prepare(Engine::JpsBlock)?;
/// let post = Rectangle::new(20, 4, 1, 1);
/// let disc = disc.edit(post, |_, _| true)?;
/// // The disc keeps off the post.
/// assert!(disc.map().is_blocked((21, 4)) && disc.obstacles().is_free((21, 4)));
/// // The index of its map follows.
/// let change = disc.change(&space);
/// let index = index.repair(&change)?;
/// let space = change.after();
/// assert!(space.path((2, 4), (37, 4))?.is_some_and(|path| path.cost() > 35.0));
/// # Ok::<(), mediant::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Disc {
    agent: Agent,
    radius: f64,
    motion: Motion,
}

impl Disc {
    pub(super) fn new(obstacles: &Map, radius: f64, motion: Motion) -> Result<Self, Error> {
        Ok(Self { agent: Agent::new(obstacles, obstacles.for_disc(radius, motion)?), radius, motion })
    }

    fn follow(&self, change: GridChange) -> Result<Self, Error> {
        // An obstacle farther than this from every point of a cell cannot touch the disc. It saturates.
        let reach = self.radius.ceil() as i64 + 1;
        let measure = |map: &Map| map.for_disc(self.radius, self.motion);
        Ok(Self { agent: self.agent.follow(change, [reach; 2], measure)?, ..*self })
    }

    /// The radius of the disc, in cells.
    #[must_use]
    pub const fn radius(&self) -> f64 {
        self.radius
    }

    /// Where the disc may be: the map to search.
    #[must_use]
    pub const fn map(&self) -> &Map {
        &self.agent.map
    }

    /// The map of the obstacles.
    #[must_use]
    pub const fn obstacles(&self) -> &Map {
        &self.agent.obstacles
    }

    /// The disc among other obstacles in a rectangle: see [`Map::edit`]. The work follows the cells that
    /// change and the size of the disc, not the map.
    ///
    /// # Errors
    /// As for [`Map::edit`].
    pub fn edit(&self, at: Rectangle, blocked: impl FnMut(u32, u32) -> bool) -> Result<Self, Error> {
        self.obstacles().check_edit(at)?;
        self.follow(GridChange::new(Arc::clone(self.obstacles().grid())).edit(at, blocked))
    }

    /// The disc among other obstacles in scattered cells: see [`Map::edit_cells`].
    ///
    /// # Errors
    /// As for [`Map::edit_cells`].
    pub fn edit_cells<C: Into<Vertex>>(
        &self,
        cells: impl IntoIterator<Item = (C, bool)>,
    ) -> Result<Self, Error> {
        let cells = self.obstacles().check_cells(cells)?;
        self.follow(GridChange::new(Arc::clone(self.obstacles().grid())).edit_cells(cells))
    }

    /// The disc after a change of the obstacles, of whatever motion the change has its spaces.
    ///
    /// # Errors
    /// None for the change of a map that this disc was made for; else those of making it anew.
    pub fn after(&self, change: &Change) -> Result<Self, Error> {
        self.follow(change.of_grid().clone())
    }

    /// The change from a space on the map of the disc before the last edit to this one, by which indexes
    /// are [repaired](crate::Index::repair). For a space on an older map, the maps are compared word by word.
    #[must_use]
    pub fn change(&self, before: &Space) -> Change {
        self.agent.change(before)
    }
}

/// A square of n × n cells among obstacles that change: the map of the obstacles, and that of the square
/// ([`Map::square`]).
///
/// ```
/// use mediant::{Map, Rectangle};
///
/// let square = Map::new(40, 9)?.square(3)?;
/// let square = square.edit(Rectangle::new(20, 4, 1, 1), |_, _| true)?;
/// // Its place is its top left cell.
/// assert!(square.map().is_blocked((18, 2)) && square.map().is_free((21, 4)));
/// # Ok::<(), mediant::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Square {
    agent: Agent,
    side: u32,
}

impl Square {
    pub(super) fn new(obstacles: &Map, side: u32) -> Result<Self, Error> {
        Ok(Self { agent: Agent::new(obstacles, obstacles.for_square(side)?), side })
    }

    fn follow(&self, change: GridChange) -> Result<Self, Error> {
        let reach = [i64::from(self.side) - 1, 0];
        Ok(Self { agent: self.agent.follow(change, reach, |map| map.for_square(self.side))?, ..*self })
    }

    /// The side of the square, in cells.
    #[must_use]
    pub const fn side(&self) -> u32 {
        self.side
    }

    /// Where the square may be: the map to search.
    #[must_use]
    pub const fn map(&self) -> &Map {
        &self.agent.map
    }

    /// The map of the obstacles.
    #[must_use]
    pub const fn obstacles(&self) -> &Map {
        &self.agent.obstacles
    }

    /// The square among other obstacles in a rectangle: see [`Map::edit`]. The work follows the cells that
    /// change and the size of the square, not the map.
    ///
    /// # Errors
    /// As for [`Map::edit`].
    pub fn edit(&self, at: Rectangle, blocked: impl FnMut(u32, u32) -> bool) -> Result<Self, Error> {
        self.obstacles().check_edit(at)?;
        self.follow(GridChange::new(Arc::clone(self.obstacles().grid())).edit(at, blocked))
    }

    /// The square among other obstacles in scattered cells: see [`Map::edit_cells`].
    ///
    /// # Errors
    /// As for [`Map::edit_cells`].
    pub fn edit_cells<C: Into<Vertex>>(
        &self,
        cells: impl IntoIterator<Item = (C, bool)>,
    ) -> Result<Self, Error> {
        let cells = self.obstacles().check_cells(cells)?;
        self.follow(GridChange::new(Arc::clone(self.obstacles().grid())).edit_cells(cells))
    }

    /// The square after a change of the obstacles, of whatever motion the change has its spaces.
    ///
    /// # Errors
    /// None for the change of a map that this square was made for; else those of making it anew.
    pub fn after(&self, change: &Change) -> Result<Self, Error> {
        self.follow(change.of_grid().clone())
    }

    /// The change from a space on the map of the square before the last edit to this one, by which indexes
    /// are [repaired](crate::Index::repair). For a space on an older map, the maps are compared word by word.
    #[must_use]
    pub fn change(&self, before: &Space) -> Change {
        self.agent.change(before)
    }
}

/// A map that is made from another one, cell by cell from what is near.
#[derive(Clone, Debug)]
struct Agent {
    obstacles: Map,
    map: Map,
    /// The last change of `map`.
    change: GridChange,
}

impl Agent {
    fn new(obstacles: &Map, map: Map) -> Self {
        let change = GridChange::new(Arc::clone(map.grid()));
        Self { obstacles: obstacles.clone(), map, change }
    }

    /// The agent after a change of the obstacles. A cell decides about those up to `reach` to the left and
    /// above, and to the right and below; `measure` makes the agent's map from one of obstacles.
    fn follow(
        &self,
        change: GridChange,
        reach: [i64; 2],
        measure: impl Fn(&Map) -> Result<Map, Error>,
    ) -> Result<Self, Error> {
        let change = if change.before().id() == self.obstacles.id() {
            change
        } else {
            let after = Arc::clone(change.after());
            match GridChange::between(Arc::clone(self.obstacles.grid()), Arc::clone(&after)) {
                Some(change) => change,
                None => {
                    let obstacles = Map::from(after);
                    return Ok(Self::new(&obstacles, measure(&obstacles)?));
                }
            }
        };
        let obstacles = self.obstacles.after(|_| change.clone());
        let old = || Arc::clone(self.map.grid());
        let change = match near(&obstacles, change.cells(), reach) {
            Some(near) => near.iter().try_fold(GridChange::new(old()), |edit, near| {
                let measured = measure(&near.obstacles(&obstacles)?)?;
                Ok::<_, Error>(edit.edit(near.changed, |x, y| measured.is_blocked(near.place(x, y))))
            })?,
            None => {
                let new = measure(&obstacles)?;
                let new = new.grid();
                GridChange::between(old(), Arc::clone(new))
                    .unwrap_or_else(|| GridChange::new(Arc::clone(new)))
            }
        };
        let map = self.map.after(|_| change.clone());
        Ok(Self { obstacles, map, change })
    }

    fn change(&self, before: &Space) -> Change {
        if before.map().id() == self.change.before().id() {
            Change::of_grids(before, self.change.clone())
        } else {
            Change::to(before, &self.map)
        }
    }
}

/// The surroundings of cells that changed.
struct Near {
    /// The cells of the agent's map that may change.
    changed: Rectangle,
    /// The columns and rows of the obstacles that decide about them. Those beyond the map are blocked.
    read: [Range<i64>; 2],
}

impl Near {
    fn new(map: &Map, at: Rectangle, [before, after]: [i64; 2]) -> Self {
        let [columns, rows] =
            [(at.x, at.width, map.width()), (at.y, at.height, map.height())].map(|(first, count, side)| {
                let (first, end) = (i64::from(first), i64::from(first) + i64::from(count));
                let first = first.saturating_sub(before).max(0);
                let end = end.saturating_add(after).min(i64::from(side));
                // Of the changed cells these decide, and no others.
                (first..end, first.saturating_sub(after)..end.saturating_add(before))
            });
        let side = |range: &Range<i64>| (range.end - range.start) as u32;
        let [x, y] = [&columns.0, &rows.0].map(|range| range.start as u32);
        let changed = Rectangle::new(x, y, side(&columns.0), side(&rows.0));
        Self { changed, read: [columns.1, rows.1] }
    }

    /// The columns and rows that are read; `None` for more than a map can have.
    fn size(&self) -> Option<[u32; 2]> {
        let [width, height] = self.read.each_ref().map(|range| {
            let side = range.end.saturating_sub(range.start);
            u32::try_from(side).ok().filter(|&side| side <= Grid::MAX_SIDE)
        });
        Some([width?, height?])
    }

    /// The map of these obstacles alone.
    fn obstacles(&self, map: &Map) -> Result<Map, Error> {
        // All of these are near the map, so 32 bits hold them.
        let [left, top] = self.read.each_ref().map(|range| range.start as i32);
        let [width, height] = self.size().unwrap_or_default();
        Map::from_fn(width, height, |x, y| map.is_blocked((left + x as i32, top + y as i32)))
    }

    /// A cell of the map on the map of these obstacles.
    fn place(&self, x: u32, y: u32) -> (i32, i32) {
        let [left, top] = self.read.each_ref().map(|range| range.start as i32);
        (x as i32 - left, y as i32 - top)
    }
}

/// The surroundings of cells that changed; `None` if these are as many cells as the map has.
fn near(map: &Map, cells: &[Rectangle], reach: [i64; 2]) -> Option<Vec<Near>> {
    let mut left = u64::from(map.width()) * u64::from(map.height());
    let near = cells.iter().map(|&at| {
        let near = Near::new(map, at, reach);
        let [width, height] = near.size()?;
        left = left.checked_sub(u64::from(width) * u64::from(height))?;
        Some(near)
    });
    near.collect()
}
