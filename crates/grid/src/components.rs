//! Connected components of the free cells, so that 'is there any path?' is one comparison.

use crate::{Grid, Vertex};

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
/// above.
///
/// ```
/// use mediant_grid::{AsciiMap, Components, Connectivity, Vertex};
/// let map = AsciiMap::parse("
///     .#
///     #.
/// ")?;
/// assert_eq!(Components::new(&map.grid, Connectivity::Four).count(), 2);
/// let eight = Components::new(&map.grid, Connectivity::Eight);
/// assert_eq!((eight.count(), eight.of(Vertex::new(1, 1))), (1, Some(0)));
/// # Ok::<(), mediant_grid::GridError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Components {
    width: u32,
    labels: Labels,
    count: u32,
}

/// The component of each cell, row by row, in as few bytes as the number of components takes; their largest
/// number for blocked cells. Most maps take one byte a cell.
#[derive(Clone, Debug)]
enum Labels {
    One(Box<[u8]>),
    Two(Box<[u16]>),
    Four(Box<[u32]>),
}

/// A run of free cells in one row: columns `first` to `last`.
#[derive(Clone, Copy)]
struct Run {
    first: u32,
    last: u32,
    label: u32,
}

impl Components {
    /// The components of a grid.
    #[must_use]
    pub fn new(grid: &Grid, connectivity: Connectivity) -> Self {
        let reach = u32::from(connectivity == Connectivity::Eight);
        let mut sets = Sets::default();
        let mut rows: Vec<Vec<Run>> = Vec::with_capacity(grid.height() as usize);
        for y in 0..grid.height() {
            let mut runs = runs_of_row(grid, y);
            let above = rows.last().map_or(&[][..], Vec::as_slice);
            let mut met = 0;
            for run in &mut runs {
                run.label = sets.add();
                // Runs above that end before this one begins do not meet the later ones either.
                while above.get(met).is_some_and(|other| other.last + reach < run.first) {
                    met += 1;
                }
                for other in above[met..].iter().take_while(|other| other.first <= run.last + reach) {
                    sets.join(run.label, other.label);
                }
            }
            rows.push(runs);
        }
        let (names, count) = sets.names();
        let labels = match count {
            0..=0xFF => Labels::One(labels(grid, &rows, |run| names[run as usize] as u8, u8::MAX)),
            0x100..=0xFFFF => Labels::Two(labels(grid, &rows, |run| names[run as usize] as u16, u16::MAX)),
            _ => Labels::Four(labels(grid, &rows, |run| names[run as usize], u32::MAX)),
        };
        Self { width: grid.width(), labels, count }
    }

    /// The number of components.
    #[must_use]
    pub const fn count(&self) -> u32 {
        self.count
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        match &self.labels {
            Labels::One(labels) => size_of_val(&**labels),
            Labels::Two(labels) => size_of_val(&**labels),
            Labels::Four(labels) => size_of_val(&**labels),
        }
    }

    /// The component of a cell, numbered from 0 in row-major order of their first cells; `None` for blocked
    /// cells and outside the map.
    #[must_use]
    pub fn of(&self, cell: Vertex) -> Option<u32> {
        if cell.x as u32 >= self.width || cell.y < 0 {
            return None;
        }
        let at = cell.y as usize * self.width as usize + cell.x as usize;
        let label = match &self.labels {
            Labels::One(labels) => u32::from(*labels.get(at)?),
            Labels::Two(labels) => u32::from(*labels.get(at)?),
            Labels::Four(labels) => *labels.get(at)?,
        };
        // The label of blocked cells is no component: they are numbered from 0.
        (label < self.count).then_some(label)
    }
}

/// A label for each cell: that of its run, or `blocked`.
fn labels<L: Copy>(grid: &Grid, rows: &[Vec<Run>], name: impl Fn(u32) -> L, blocked: L) -> Box<[L]> {
    let width = grid.width() as usize;
    let mut labels = vec![blocked; width * grid.height() as usize].into_boxed_slice();
    for (runs, cells) in rows.iter().zip(labels.chunks_exact_mut(width)) {
        for run in runs {
            cells[run.first as usize..=run.last as usize].fill(name(run.label));
        }
    }
    labels
}

/// The runs of free cells in row y.
fn runs_of_row(grid: &Grid, y: u32) -> Vec<Run> {
    let rows = grid.rows();
    let start = rows.index(0, y as i32).0 as usize / 64;
    let words = &rows.words()[start..start + rows.bits_per_row() as usize / 64];
    let mut runs: Vec<Run> = Vec::new();
    for (word, base) in words.iter().zip((0..).step_by(64)) {
        let mut free = !word;
        while free != 0 {
            let first = free.trailing_zeros();
            let length = (free >> first).trailing_ones();
            match runs.last_mut() {
                // A run that reaches the end of a word goes on in the next one.
                Some(run) if first == 0 && run.last + 1 == base => run.last += length,
                _ => runs.push(Run { first: base + first, last: base + first + length - 1, label: 0 }),
            }
            free &= (!0_u64).checked_shl(first + length).unwrap_or(0);
        }
    }
    runs
}

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

    /// The number of each run's set, with the sets numbered in the order of their roots, and the number of
    /// sets.
    fn names(mut self) -> (Vec<u32>, u32) {
        let mut names = Vec::with_capacity(self.parents.len());
        let mut count = 0;
        for i in 0..self.parents.len() as u32 {
            // A root comes before all others of its set, so its name is known when they need it.
            let root = self.root(i);
            names.push(if root == i { count } else { names[root as usize] });
            count += u32::from(root == i);
        }
        (names, count)
    }
}
