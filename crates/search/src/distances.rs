//! The distances from one vertex to all others.

use mediant_grid::{DiagonalGap, GridGraph, Placement, Rules, Step, Vertex, VertexId};

/// The distances from a start to all vertices that can be reached: costs or numbers of moves.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Distances<T> {
    width: u32,
    /// By vertex number.
    values: Box<[Option<T>]>,
}

impl<T: Copy> Distances<T> {
    /// The distances by vertex number, on a grid graph with `width` vertices in a row.
    pub(crate) fn new(width: u32, values: Vec<Option<T>>) -> Self {
        debug_assert!(width > 0 && values.len().is_multiple_of(width as usize), "rows of {width} vertices");
        Self { width, values: values.into_boxed_slice() }
    }

    /// The distance to a vertex, 0 for the start; `None` when no path leads there, or when it is blocked or
    /// outside the map.
    #[must_use]
    pub fn get(&self, at: Vertex) -> Option<T> {
        let (x, y) = (u32::try_from(at.x).ok()?, usize::try_from(at.y).ok()?);
        let index = y.checked_mul(self.width as usize)?.checked_add(x as usize)?;
        (x < self.width).then(|| self.values.get(index).copied().flatten())?
    }

    /// The vertices that can be reached, row by row, with their distances.
    pub fn iter(&self) -> impl Iterator<Item = (Vertex, T)> {
        self.values.chunks_exact(self.width as usize).zip(0..).flat_map(|(row, y)| {
            row.iter().zip(0..).filter_map(move |(&value, x)| Some((Vertex::new(x, y), value?)))
        })
    }

    /// The number of vertices in a row.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// The number of rows of vertices.
    #[must_use]
    pub const fn height(&self) -> u32 {
        // At most 32,769 rows: see `Grid::MAX_SIDE`.
        (self.values.len() / self.width as usize) as u32
    }
}

/// Under [`DiagonalGap::Closed`], corrects the distances to gaps: makes them those of paths that end there.
///
/// A search without a goal knows at most how to pass a gap. A path that ends at one comes through the
/// quadrant of the vertex's own cell, and its last move from a vertex that the search knows. `values` are the
/// distances of the search by vertex number, `arrived_by` is the move by which it reached a vertex other than
/// the start, and `extended` makes a distance longer by one move.
pub(crate) fn end_at_gaps<P: Placement, T: Copy + Ord>(
    graph: &GridGraph<P>,
    start: Vertex,
    values: &mut [Option<T>],
    arrived_by: impl Fn(VertexId) -> usize,
    extended: impl Fn(T, &Step) -> T,
) {
    if graph.rules() != Rules::Corner(DiagonalGap::Closed) {
        return;
    }
    let grid = graph.grid();
    let last_move = |at: Vertex, id: VertexId| {
        let mut best = None;
        graph.for_each_legal_move(at, |index| {
            let back = graph.step(index);
            let (v, from) = (back.vector(), at + back.vector());
            let in_own_quadrant = v.x >= 0 && v.y >= 0 && grid.is_free(at.x, at.y);
            let Some(known) = values[back.target(id).index()].filter(|_| in_own_quadrant) else { return };
            let mut may = !grid.is_gap(from);
            if !may {
                let arrived_by = (from != start).then(|| arrived_by(back.target(id)));
                graph.for_each_successor(from, arrived_by, at, |index| {
                    may |= from + graph.step(index).vector() == at;
                });
            }
            let length = may.then(|| extended(known, back));
            best = best.into_iter().chain(length).min();
        });
        best
    };
    let gaps = (0..values.len() as u32).map(VertexId).map(|id| (graph.vertex(id), id));
    let gaps = gaps.filter(|&(at, _)| at != start && grid.is_gap(at));
    // Not one by one in place: the path to a gap may pass another one.
    let ends: Vec<_> = gaps.map(|(at, id)| (id, last_move(at, id))).collect();
    for (id, value) in ends {
        values[id.index()] = value;
    }
}
