//! Connected components of the free cells, so that 'is there any path?' is one comparison.

use std::sync::Arc;

use crate::{
    Grid, Vertex,
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

/// The connected components of a grid's free cells.
///
/// They are found by runs of free cells: each run of a row is joined with the runs that it meets in the row
/// above. A label is stored for each run of each word of the map, so the memory follows the runs, not the
/// cells: a sixteenth of a byte a cell, and four bytes a run.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Components, Connectivity, Vertex};
/// let map = AsciiMap::parse("
///     .#
///     #.
/// ")?;
/// let grid = Arc::new(map.grid);
/// assert_eq!(Components::new(&grid, Connectivity::Four).count(), 2);
/// let eight = Components::new(&grid, Connectivity::Eight);
/// assert_eq!((eight.count(), eight.of(Vertex::new(1, 1))), (1, Some(0)));
/// # Ok::<(), mediant_grid::GridError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Components {
    grid: Arc<Grid>,
    /// For each word of the grid's rows, the place in `labels` of its first run.
    first: Box<[u32]>,
    /// The component of each run of free cells of a word, word by word.
    labels: Box<[u32]>,
    count: u32,
}

/// A run of free cells in one row: columns `first` to `last`.
#[derive(Clone, Copy)]
struct RowRun {
    first: u32,
    last: u32,
    set: u32,
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
        let reach = u32::from(connectivity == Connectivity::Eight);
        let rows = grid.rows();
        let mut first = Vec::with_capacity(rows.words().len());
        let (mut sets, mut labels) = (Sets::default(), Vec::new());
        let (mut above, mut row): (Vec<RowRun>, Vec<RowRun>) = (Vec::new(), Vec::new());
        for y in 0..grid.height() as i32 {
            interrupt.check(DURING)?;
            let start = rows.index(0, y).0 as usize / 64;
            // The words of the frame hold no run.
            first.resize(start, labels.len() as u32);
            let words = &rows.words()[start..start + rows.bits_per_row() as usize / 64];
            for (word, base) in words.iter().zip((0..).step_by(64)) {
                first.push(labels.len() as u32);
                let mut free = !word;
                while free != 0 {
                    let bit = free.trailing_zeros();
                    let length = (free >> bit).trailing_ones();
                    let run = base + bit;
                    match row.last_mut() {
                        // A run that reaches the end of a word goes on in the next one.
                        Some(open) if bit == 0 && open.last + 1 == base => open.last += length,
                        _ => row.push(RowRun { first: run, last: run + length - 1, set: sets.add() }),
                    }
                    labels.extend(row.last().map(|run| run.set));
                    free &= (!0_u64).checked_shl(bit + length).unwrap_or(0);
                }
            }
            sets.join_rows(&above, &row, reach);
            std::mem::swap(&mut above, &mut row);
            row.clear();
        }
        let (names, count) = sets.names(interrupt)?;
        for labels in labels.chunks_mut(PART) {
            interrupt.check(DURING)?;
            labels.iter_mut().for_each(|label| *label = names[*label as usize]);
        }
        labels.shrink_to_fit();
        let (first, labels) = (first.into_boxed_slice(), labels.into_boxed_slice());
        Ok(Self { grid: Arc::clone(grid), first, labels, count })
    }

    /// The number of components.
    #[must_use]
    pub const fn count(&self) -> u32 {
        self.count
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        size_of_val(&*self.first) + size_of_val(&*self.labels)
    }

    /// The component of a cell, numbered from 0 in row-major order of their first cells; `None` for blocked
    /// cells and outside the map.
    #[must_use]
    pub fn of(&self, cell: Vertex) -> Option<u32> {
        if !self.grid.is_free(cell.x, cell.y) {
            return None;
        }
        let rows = self.grid.rows();
        let at = rows.index(cell.x, cell.y).0;
        let (word, bit) = ((at / 64) as usize, at % 64);
        let free = !rows.words()[word];
        // The runs of the word that begin up to the cell; its own is the last of them.
        let begun = free & !(free << 1) & (!0 >> (63 - bit));
        let run = self.first[word] + begun.count_ones() - 1;
        Some(self.labels[run as usize])
    }
}

/// The runs that are handled between two questions of an interrupt.
const PART: usize = 1 << 16;

/// Disjoint sets of run numbers; the smallest number of a set is its root.
#[derive(Default)]
struct Sets {
    parents: Vec<u32>,
}

impl Sets {
    fn add(&mut self) -> u32 {
        let new = self.parents.len() as u32;
        self.parents.push(new);
        new
    }

    fn root(&mut self, mut of: u32) -> u32 {
        while self.parents[of as usize] != of {
            let parent = self.parents[of as usize];
            self.parents[of as usize] = self.parents[parent as usize];
            of = parent;
        }
        of
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.parents[a.max(b) as usize] = a.min(b);
    }

    /// Joins the runs of a row with those that they meet in the row above; runs `reach` columns apart meet.
    fn join_rows(&mut self, above: &[RowRun], row: &[RowRun], reach: u32) {
        let mut met = 0;
        for run in row {
            // Runs above that end before this one begins do not meet the later ones either.
            while above.get(met).is_some_and(|other| other.last + reach < run.first) {
                met += 1;
            }
            for other in above[met..].iter().take_while(|other| other.first <= run.last + reach) {
                self.join(run.set, other.set);
            }
        }
    }

    /// The number of each run's set, with the sets numbered in the order of their roots, and the number of
    /// sets.
    fn names(mut self, interrupt: &Interrupt) -> Result<(Vec<u32>, u32), Interrupted> {
        let mut names = Vec::with_capacity(self.parents.len());
        let mut count = 0;
        for i in 0..self.parents.len() as u32 {
            interrupt.check_every(PART, i as usize, DURING)?;
            // A root comes before all others of its set, so its name is known when they need it.
            let root = self.root(i);
            names.push(if root == i { count } else { names[root as usize] });
            count += u32::from(root == i);
        }
        Ok((names, count))
    }
}
