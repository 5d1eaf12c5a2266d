//! Where no obstacle is near: how far a path can go straight on along an axis before it has to look.

use mediant_grid::{BitMatrix, GridGraph, Interrupt, Interrupted, Placement, Vector, Vertex, load};

/// The vertices with a blocked cell in the pattern around them, as bits: row by row, and column by column.
#[derive(Clone, Debug)]
pub(super) struct OpenGround {
    rows: BitMatrix,
    columns: BitMatrix,
}

impl OpenGround {
    pub(super) fn new<P: Placement>(
        graph: &GridGraph<P>,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let stop = (interrupt, "finding open ground");
        let (width, height) = P::vertices(graph.grid());
        let around = || (-1..=1).flat_map(|x| (-1..=1).map(move |y| (x, y)));
        let held: Vec<(i32, i32)> = around().filter(|&(x, y)| P::pattern_holds(x, y)).collect();
        let near = |cells: &BitMatrix, size: (u32, u32), offset: &dyn Fn((i32, i32)) -> (i32, i32)| {
            BitMatrix::from_words_interruptible(size, true, stop, |x, y| {
                let cell = held.iter().map(|&at| offset(at));
                cell.fold(0, |near, (dx, dy)| near | load(cells.words(), cells.index(x + dx, y + dy)))
            })
        };
        Ok(Self {
            rows: near(graph.grid().rows(), (width, height), &|(x, y)| (x, y))?,
            columns: near(graph.grid().columns(), (height, width), &|(x, y)| (y, x))?,
        })
    }

    /// The number of vertices near which there is no obstacle.
    pub(super) fn count(&self) -> usize {
        self.rows.words().iter().map(|word| word.count_zeros() as usize).sum()
    }

    /// Whether no obstacle is near a vertex of the map.
    #[inline]
    pub(super) fn is_open(&self, at: Vertex) -> bool {
        !self.rows.row(at.y).is_blocked(at.x)
    }

    /// The number of vertices in a row after `at`, along an axis, that are open; at most 64.
    #[inline]
    pub(super) fn ahead(&self, at: Vertex, along: Vector) -> u32 {
        let (row, x, forward) = if along.y == 0 {
            (self.rows.row(at.y), at.x, along.x > 0)
        } else {
            (self.columns.row(at.x), at.y, along.y > 0)
        };
        if forward { row.word(x + 1).trailing_zeros() } else { row.word(x - 64).leading_zeros() }
    }

    pub(super) fn memory_bytes(&self) -> usize {
        size_of_val(self.rows.words()) + size_of_val(self.columns.words())
    }
}
