//! Connected components of the free cells, so that 'is there any path?' is one comparison.
//!
//! The map is cut into tiles of 64 × 64 cells. In each tile the runs of free cells make *regions*, which have
//! numbers; the pairs of regions that meet across the borders of tiles make the regions components, by a
//! union-find over them. So an edit finds the regions of the tiles anew in which cells changed. If these meet
//! the regions around them as before, nothing else is done: whatever changed within a tile, a region that
//! meets the same regions beyond the border keeps its number. Otherwise all pairs are joined anew, when a
//! component is next asked for.
//!
//! Versions of a map share the tiles that did not change, by rows of tiles.

mod patch;
mod tile;

use std::sync::{Arc, OnceLock};

use self::{
    patch::Changed,
    tile::{DIRECTIONS, RowRuns, SIDE, Tile},
};
use crate::{
    Change, Grid, Rectangle, Vertex,
    interrupt::{Interrupt, Interrupted, uninterrupted},
};

/// The stage that an interrupted call names.
const DURING: &str = "finding connected components";

/// Which free cells count as neighbors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Connectivity {
    /// Cells that share an edge.
    Four,
    /// Cells that share an edge or a corner.
    Eight,
}

impl Connectivity {
    /// The most columns between two runs of neighboring rows that meet.
    const fn reach(self) -> u32 {
        match self {
            Self::Four => 0,
            Self::Eight => 1,
        }
    }
}

/// The connected components of a grid's free cells.
///
/// A label is stored for each run of free cells of a word of the map, so the memory follows the runs, not the
/// cells: a thirtieth of a byte a cell, and four bytes a run. [`after`](Self::after) follows an edit.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Change, Components, Connectivity, Vertex};
/// let map = AsciiMap::parse("
///     .#
///     #.
/// ")?;
/// let grid = Arc::new(map.grid);
/// let four = Components::new(&grid, Connectivity::Four);
/// assert_eq!(four.count(), 2);
/// let eight = Components::new(&grid, Connectivity::Eight);
/// assert_eq!((eight.count(), eight.of(Vertex::new(1, 1))), (1, eight.of(Vertex::new(0, 0))));
/// let opened = four.after(&Change::new(grid).edit_cells([(1, 0, false)]));
/// assert_eq!((opened.count(), four.count()), (1, 2));
/// # Ok::<(), mediant_grid::GridError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Components {
    grid: Arc<Grid>,
    connectivity: Connectivity,
    /// The tiles, row by row.
    tiles: Vec<Arc<[Arc<Tile>]>>,
    /// The number of regions, and the first number that none of them ever had.
    regions: u32,
    next: u32,
    joined: Arc<OnceLock<Joined>>,
}

/// Regions joined to components.
#[derive(Debug)]
struct Joined {
    /// For each number of a region, that which stands for its component. Later numbers stand for themselves.
    roots: Box<[u32]>,
    /// By how many the components are fewer than the regions.
    fewer: u32,
}

impl Components {
    /// The components of a grid.
    #[must_use]
    pub fn new(grid: &Arc<Grid>, connectivity: Connectivity) -> Self {
        uninterrupted(|never| Self::interruptible(grid, connectivity, never))
    }

    /// [`new`](Self::new), which an interrupt can stop; it asks before each row.
    ///
    /// # Errors
    /// [`Interrupted`].
    pub fn interruptible(
        grid: &Arc<Grid>,
        connectivity: Connectivity,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let [columns, rows] = [grid.width(), grid.height()].map(|side| (side as usize).div_ceil(SIDE));
        let mut next = 0;
        let mut tile = |column, row| {
            let mut tile = Tile::new(words(grid, (column, row)), connectivity, interrupt)?;
            tile.number_from(next);
            next += tile.regions();
            Ok(tile)
        };
        let mut tiles: Vec<Vec<Tile>> = Vec::with_capacity(rows);
        for row in 0..rows {
            tiles.push((0..columns).map(|column| tile(column, row)).collect::<Result<_, _>>()?);
        }
        for row in 0..rows {
            interrupt.check(DURING)?;
            for column in 0..columns {
                let contacts = std::array::from_fn(|direction| {
                    let beside = beside((column, row), direction);
                    let other = beside.and_then(|(column, row)| tiles.get(row)?.get(column));
                    let contacts =
                        other.map(|other| tiles[row][column].contacts_with(other, direction, connectivity));
                    contacts.unwrap_or_default().into()
                });
                tiles[row][column].contacts = contacts;
            }
        }
        let tiles = tiles.into_iter().map(|row| row.into_iter().map(Arc::new).collect()).collect();
        let components =
            Self { grid: Arc::clone(grid), connectivity, tiles, regions: next, next, joined: Arc::default() };
        let joined = components.join(interrupt)?;
        Ok(Self { joined: Arc::new(joined.into()), ..components })
    }

    /// The components after a change of the map, by work that follows the tiles in which cells changed. If
    /// components must be joined anew, that is done when one is first asked for.
    #[must_use]
    pub fn after(&self, change: &Change) -> Self {
        let mut changed: Vec<(usize, usize, Rectangle)> =
            change.cells().iter().map(|at| (at.y as usize / SIDE, at.x as usize / SIDE, *at)).collect();
        changed.sort_unstable_by_key(|&(row, column, _)| (row, column));
        changed.dedup_by(|&mut (row, column, at), (kept_row, kept_column, all)| {
            let is_same = (row, column) == (*kept_row, *kept_column);
            if is_same {
                *all = all.around(at);
            }
            is_same
        });
        let tiles = self.tiles.iter().map(|row| row.len()).sum::<usize>();
        // Repairing a tile takes at most twice as long as making it.
        if changed.len() > tiles.div_ceil(2) {
            return Self::new(change.after(), self.connectivity);
        }
        let mut after = Self { grid: Arc::clone(change.after()), ..self.clone() };
        let mut meets_as_before = true;
        for (row, column, at) in changed {
            meets_as_before &= after.repair((column, row), at, change.before());
        }
        if !meets_as_before {
            after.joined = Arc::default();
        }
        after
    }

    /// Finds the regions of a tile anew, in which cells of a rectangle have changed. Returns whether they
    /// meet those around as before.
    fn repair(&mut self, at: (usize, usize), cells: Rectangle, map_before: &Grid) -> bool {
        let before = Arc::clone(&self.tiles[at.1][at.0]);
        let within = |first: u32, length: u32| [first % SIDE as u32, (first + length - 1) % SIDE as u32];
        let changed = Changed { rows: within(cells.y, cells.height), columns: within(cells.x, cells.width) };
        let free = |map: &Grid, row: u32| word(map, at.0, at.1 * SIDE + row as usize);
        let words_of = (|row| free(map_before, row), |row| free(&self.grid, row));
        if let Some(tile) = before.patched(changed, words_of, self.connectivity) {
            Arc::make_mut(&mut self.tiles[at.1])[at.0] = Arc::new(tile);
            return true;
        }
        let tile = Tile::new(words(&self.grid, at), self.connectivity, &Interrupt::NEVER);
        let Ok(mut tile) = tile else { unreachable!("nothing stops this work") };
        let places = std::array::from_fn(|direction| {
            beside(at, direction)
                .filter(|&(column, row)| row < self.tiles.len() && column < self.tiles[row].len())
        });
        let around: [Option<Arc<Tile>>; 8] = places.map(|place: Option<(usize, usize)>| {
            place.map(|(column, row)| Arc::clone(&self.tiles[row][column]))
        });
        let around = around.each_ref().map(Option::as_deref);
        // The contacts of the tile, first those that it keeps itself.
        let known = std::array::from_fn::<_, 8, _>(|direction| match direction {
            0..4 => Some(&before.contacts[direction]),
            _ => around[direction].map(|other| &other.contacts[direction - 4]),
        });
        let mut met: Vec<u32> = Vec::new();
        for (direction, contacts) in known.iter().enumerate() {
            let own = usize::from(direction >= 4);
            met.extend(contacts.iter().flat_map(|contacts| contacts.iter()).map(|contact| contact[own]));
        }
        met.sort_unstable();
        met.dedup();
        tile.number_like(&before, (&around, &met), self.connectivity, &mut self.next);
        self.regions = self.regions - before.regions() + tile.regions();
        tile.contacts = before.contacts.clone();
        let (mut as_before, mut others) = (true, Vec::new());
        for (direction, other) in around.iter().enumerate() {
            let (Some(other), Some(known)) = (other, known[direction]) else { continue };
            let new = if direction < 4 {
                tile.contacts_with(other, direction, self.connectivity)
            } else {
                other.contacts_with(&tile, direction - 4, self.connectivity)
            };
            if *new == **known {
                continue;
            }
            as_before = false;
            if direction < 4 {
                tile.contacts[direction] = new.into();
            } else if let Some(place) = places[direction] {
                others.push((place, direction - 4, new));
            }
        }
        let mut put = |(column, row): (usize, usize), tile: Tile| {
            Arc::make_mut(&mut self.tiles[row])[column] = Arc::new(tile);
        };
        for (place, direction, contacts) in others {
            let Some(other) = around[direction + 4] else { continue };
            let mut other = other.clone();
            other.contacts[direction] = contacts.into();
            put(place, other);
        }
        put(at, tile);
        as_before
    }

    /// Joins the regions that meet.
    fn join(&self, interrupt: &Interrupt) -> Result<Joined, Interrupted> {
        let (mut sets, mut fewer) = (Sets { parents: (0..self.next).collect() }, 0);
        for row in &self.tiles {
            interrupt.check(DURING)?;
            for &[one, other] in row.iter().flat_map(|tile| tile.contacts.iter().flat_map(|all| all.iter())) {
                fewer += u32::from(sets.join(one, other));
            }
        }
        for i in 0..self.next {
            interrupt.check_every(1 << 16, i as usize, DURING)?;
            sets.parents[i as usize] = sets.root(i);
        }
        Ok(Joined { roots: sets.parents.into_boxed_slice(), fewer })
    }

    fn joined(&self) -> &Joined {
        self.joined.get_or_init(|| uninterrupted(|never| self.join(never)))
    }

    /// The number of components.
    #[must_use]
    pub fn count(&self) -> u32 {
        self.regions - self.joined().fewer
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        let joined = self.joined.get().map_or(0, |joined| size_of_val(&*joined.roots));
        joined + self.tiles.iter().flat_map(|row| row.iter()).map(|tile| tile.memory_bytes()).sum::<usize>()
    }

    /// The component of a cell, as a number that no other component of the map has; `None` for blocked cells
    /// and outside the map.
    #[must_use]
    pub fn of(&self, cell: Vertex) -> Option<u32> {
        if !self.grid.is_free(cell.x, cell.y) {
            return None;
        }
        let (x, y) = (cell.x as usize, cell.y as usize);
        let free = !self.grid.rows().row(cell.y).word(cell.x & !63);
        let region = self.tiles[y / SIDE][x / SIDE].of(y % SIDE, cell.x as u32 % 64, free);
        Some(self.joined().roots.get(region as usize).copied().unwrap_or(region))
    }
}

/// The words of free cells of a tile.
fn words(grid: &Grid, (column, row): (usize, usize)) -> impl Iterator<Item = u64> {
    let rows = row * SIDE..((row + 1) * SIDE).min(grid.height() as usize);
    rows.map(move |y| word(grid, column, y))
}

/// The free cells of a row of a tile in this column of tiles.
fn word(grid: &Grid, column: usize, y: usize) -> u64 {
    !grid.rows().row(y as i32).word((SIDE * column) as i32)
}

/// The place of the tile in a direction; `None` to the left of the map and above it.
fn beside((column, row): (usize, usize), direction: usize) -> Option<(usize, usize)> {
    let (dx, dy) = DIRECTIONS[direction];
    Some((column.checked_add_signed(dx as isize)?, row.checked_add_signed(dy as isize)?))
}

/// Disjoint sets of numbers; the smallest number of a set is its root.
#[derive(Default)]
struct Sets {
    parents: Vec<u32>,
}

impl Sets {
    /// The number of sets that were added, which is the number of the next one.
    fn len(&self) -> u32 {
        self.parents.len() as u32
    }

    /// Adds so many sets.
    fn add(&mut self, sets: u32) {
        self.parents.extend(self.len()..self.len() + sets);
    }

    fn root(&mut self, mut of: u32) -> u32 {
        while self.parents[of as usize] != of {
            let parent = self.parents[of as usize];
            self.parents[of as usize] = self.parents[parent as usize];
            of = parent;
        }
        of
    }

    /// Joins the sets of two numbers. Returns whether they were two.
    fn join(&mut self, a: u32, b: u32) -> bool {
        let (a, b) = (self.root(a), self.root(b));
        self.parents[a.max(b) as usize] = a.min(b);
        a != b
    }

    /// Joins the runs of free cells of a row with those of the row above that they meet.
    fn join_rows(&mut self, above: RowRuns, row: RowRuns, connectivity: Connectivity) {
        let mut join = |mut cells: u64, shift: i32| {
            while cells != 0 {
                let bit = cells.trailing_zeros();
                self.join(row.set(bit), above.set(bit.wrapping_add_signed(shift)));
                cells &= cells - 1;
            }
        };
        // Where they lie along one another, their first cells do.
        let along = row.free & above.free;
        join(along & !(along << 1), 0);
        if connectivity == Connectivity::Eight {
            // Elsewhere the end of one meets the other's.
            let ends = row.free & !above.free;
            join(ends & above.free << 1 & !(row.free << 1), -1);
            join(ends & above.free >> 1 & !(row.free >> 1), 1);
        }
    }

    /// For each number that of its set, with the sets numbered from 0 in the order of their roots; and the
    /// number of sets.
    fn names(mut self) -> (Vec<u32>, u32) {
        let mut count = 0;
        for i in 0..self.parents.len() {
            // A root comes before all others of its set, so its name is known when they need it. All numbers
            // before this one are names by now, and those that stand for others come before it.
            let parent = self.parents[i] as usize;
            self.parents[i] = if parent == i { count } else { self.parents[parent] };
            count += u32::from(parent == i);
        }
        (self.parents, count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A row that becomes one run of 64 cells has one label.
    #[test]
    fn a_small_change_keeps_one_label_a_run() {
        let map = Arc::new(Grid::from_fn(64, 64, |x, y| (x, y) == (30, 30)).expect("a map"));
        for connectivity in [Connectivity::Four, Connectivity::Eight] {
            let change = Change::new(Arc::clone(&map)).edit_cells([(30, 30, false)]);
            let [after, new] = [
                Components::new(&map, connectivity).after(&change),
                Components::new(change.after(), connectivity),
            ];
            assert_eq!(after.memory_bytes(), new.memory_bytes(), "{connectivity:?}");
        }
    }

    /// 4 bytes say of each region in which component it is, once somebody asks.
    #[test]
    fn memory_holds_the_tiles_and_what_joins_their_regions() {
        let map = Arc::new(Grid::from_fn(128, 64, |x, y| (x + y) % 2 == 1).expect("a map"));
        let change = Change::new(Arc::clone(&map)).edit_cells([(63, 0, false)]);
        let components = Components::new(&map, Connectivity::Four).after(&change);
        let (tiles, regions) = (components.memory_bytes(), components.next as usize);
        assert!(tiles >= 64 * 64 * size_of::<u32>(), "{tiles}");
        assert!(components.count() > 2000);
        assert_eq!(components.memory_bytes(), tiles + 4 * regions);
    }

    /// Small rectangles of a tile change. Counts the changes that are known to join and part nothing, and
    /// those after which it is still known how regions are joined. After all others it is found anew, and
    /// components are the same: only these counts show it.
    #[test]
    fn the_number_of_patched_tiles_is_pinned() {
        let hash = |x: u32, y: u32| (x.wrapping_mul(2_654_435_761) ^ y.wrapping_mul(40_503)) >> 7;
        let map = Arc::new(Grid::from_fn(130, 70, |x, y| hash(x, y) % 100 < 35).expect("a map"));
        let counts = [Connectivity::Four, Connectivity::Eight].map(|connectivity| {
            let components = Components::new(&map, connectivity);
            assert!(components.count() > 1);
            let (mut patched, mut joined) = (0, 0);
            for number in 0..2_000 {
                let [wide, high] = [1 + number % 7, 1 + number / 7 % 7];
                let (x, y) = (hash(number, 1) % (65 - wide), hash(number, 2) % (65 - high));
                let percent = [0, 20, 50, 100][(number / 49 % 4) as usize];
                let change = Change::new(Arc::clone(&map))
                    .edit(Rectangle::new(x, y, wide, high), |x, y| hash(x + number, y) % 100 < percent);
                let changed = Changed { rows: [y, y + high - 1], columns: [x, x + wide - 1] };
                let row_of = |map: &Arc<Grid>, row: u32| word(map, 0, row as usize);
                let rows = (|row| row_of(&map, row), |row| row_of(change.after(), row));
                patched += u32::from(components.tiles[0][0].patched(changed, rows, connectivity).is_some());
                joined += u32::from(Arc::ptr_eq(&components.joined, &components.after(&change).joined));
            }
            [patched, joined]
        });
        assert_eq!(counts, [[405, 1_865], [706, 1_986]]);
    }
}
