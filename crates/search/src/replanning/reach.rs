//! From where moves sweep a cell.

use mediant_grid::{Footprint, GridGraph, Placement, Vector};

/// The footprints of all moves of N(k), turned round: of a cell, the vertices from which moves sweep it.
#[derive(Clone, Debug)]
pub(super) struct Reach {
    /// These vertices, by their offsets from the cell; each once, row by row.
    pub(super) vertices: Box<[Vector]>,
    /// By vertices, the moves that sweep the cell from there: of a move and the move back only the first.
    pub(super) moves: Box<[Sweep]>,
}

/// A vertex, by its offset from a cell, and a move that sweeps the cell from there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Sweep {
    dy: i16,
    dx: i16,
    index: u16,
}

impl Sweep {
    /// From the cell to the vertex.
    #[inline]
    pub(super) fn offset(self) -> Vector {
        Vector::new(self.dx.into(), self.dy.into())
    }

    /// The index of the move.
    #[inline]
    pub(super) fn index(self) -> usize {
        self.index.into()
    }
}

impl Reach {
    pub(super) fn new<P: Placement>(graph: &GridGraph<P>) -> Self {
        let mut moves = Vec::new();
        // The second half are the moves back.
        let half = graph.steps().len() / 2;
        for (step, index) in graph.steps().iter().take(half).zip(0..) {
            let Footprint { free, either } = Footprint::new::<P>(graph.rule(), step.vector());
            let cells = free.into_iter().chain(either.into_iter().flatten());
            moves.extend(cells.map(|(x, y)| Sweep { dx: -x as i16, dy: -y as i16, index }));
        }
        moves.sort_unstable();
        moves.dedup();
        let ends = |sweep: &Sweep| {
            let v = graph.step(sweep.index()).vector();
            [sweep.offset(), sweep.offset() + v].map(|Vector { x, y }| (y, x))
        };
        let mut vertices: Vec<_> = moves.iter().flat_map(ends).collect();
        vertices.sort_unstable();
        vertices.dedup();
        Self {
            vertices: vertices.into_iter().map(|(y, x)| Vector::new(x, y)).collect(),
            moves: moves.into_boxed_slice(),
        }
    }

    pub(super) fn memory_bytes(&self) -> usize {
        size_of_val(&*self.vertices) + size_of_val(&*self.moves)
    }
}
