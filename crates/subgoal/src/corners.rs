//! Subgoals and edges at corners, for N(k) and at any angle.

use mediant_grid::{
    BitMatrix, Corners, FreeSpace, Placement, Vertex, load,
    sight::{Quadrants, RowSummary, Targets, VisibilitySweep},
};
use mediant_moves::{Cost, K};

use crate::{
    direct_reachability::DirectFilter,
    error::SubgoalError,
    hierarchy::Hierarchy,
    placement::{BuildContext, EdgeCriterion, EdgeFinder, EdgeKind, EdgeTables, SubgoalPlacement},
};

/// Scratch memory for finding edges at corners.
#[derive(Debug, Default)]
pub struct CornerScratch {
    sweep: VisibilitySweep,
    direct: DirectFilter,
}

/// What makes visibility sweeps fast.
#[derive(Clone, Debug)]
pub struct SightTables {
    row_summary: RowSummary,
    /// The subgoals that taut paths pass in directions in which x and y have the same sign, and in directions
    /// in which they have opposite signs.
    tangents: [BitMatrix; 2],
}

impl EdgeTables for SightTables {
    fn memory_bytes(&self) -> usize {
        self.row_summary.memory_bytes()
            + self.tangents.iter().map(|marks| size_of_val(marks.words())).sum::<usize>()
    }
}

impl SubgoalPlacement for Corners {}

impl EdgeFinder for Corners {
    type Scratch = CornerScratch;
    type Tables = SightTables;

    fn check(_: &FreeSpace<Self>, _: K) -> Result<(), SubgoalError> {
        Ok(())
    }

    /// The subgoals are the convex corners of obstacles: vertices that touch one blocked cell, or two that
    /// meet diagonally, if a path may pass between them. (Hormazábal et al. 2017: a corner of an obstacle
    /// that a path can pass along a diagonal.)
    fn prepare(space: &FreeSpace<Self>) -> (BitMatrix, SightTables) {
        let cells = space.grid().rows();
        let (width, height) = Self::vertices(space.grid());
        let gaps_open = !Self::closes_gaps(space.rule());
        let around = |x, y| {
            [(-1, -1), (0, -1), (-1, 0), (0, 0)]
                .map(|(dx, dy)| load(cells.words(), cells.index(x + dx, y + dy)))
        };
        let convex = |[nw, ne, sw, se]: [u64; 4]| {
            let odd = nw ^ ne ^ sw ^ se;
            let one = odd & !(nw & ne | sw & se);
            let two = (nw ^ ne) & !(nw ^ se) & !(ne ^ sw);
            if gaps_open { one | two } else { one }
        };
        let made = |marks: &dyn Fn([u64; 4]) -> u64| {
            BitMatrix::from_words(width, height, false, |x, y| marks(around(x, y)))
        };
        // A taut path arrives and leaves through the quadrants beside that of the blocked cell.
        let same = |cells: [u64; 4]| convex(cells) & (cells[1] | cells[2]);
        let opposite = |cells: [u64; 4]| convex(cells) & (cells[0] | cells[3]);
        let tables = SightTables {
            row_summary: RowSummary::new(space.grid()),
            tangents: [made(&same), made(&opposite)],
        };
        (made(&convex), tables)
    }

    fn edge_criterion(k: K, hierarchy: Hierarchy) -> EdgeCriterion {
        if k == K::Any || hierarchy == Hierarchy::Contracted {
            EdgeCriterion::Taut
        } else {
            EdgeCriterion::Direct
        }
    }

    fn edges_from(
        context: BuildContext<'_, Self>,
        scratch: &mut CornerScratch,
        from: Vertex,
        kind: EdgeKind,
        mut visit: impl FnMut(u32, Cost),
    ) {
        let BuildContext { space, subgoals, tables, metric, k, criterion } = context;
        let SightTables { row_summary, tangents } = tables;
        let tangents = (criterion == EdgeCriterion::Taut).then_some(tangents);
        let quadrants = match (kind, tangents) {
            (EdgeKind::Graph, Some([same, _])) => {
                let tangent = if same.get(from.x, from.y) { 1 } else { -1 };
                Quadrants::only(tangent, 1).union(Quadrants::LINE)
            }
            (EdgeKind::Graph, None) => Quadrants::only(1, 1).union(Quadrants::only(-1, 1)),
            // A path leaves a closed gap through the quadrant of the vertex's own cell.
            (EdgeKind::Query, _) if space.is_closed_gap(from) => Quadrants::only(1, 1),
            (EdgeKind::Query, _) => Quadrants::ALL,
        };
        let CornerScratch { sweep, direct } = scratch;
        match (k, tangents) {
            (_, Some([same, opposite])) => {
                sweep.seen(space, row_summary, Targets { same, opposite }, from, quadrants, |at| {
                    let to = from.to(at);
                    if let Some(id) = subgoals.id(at).filter(|_| kind.includes(to)) {
                        visit(id, metric.distance(to));
                    }
                });
            }
            (K::Finite(k), None) => {
                direct.clear();
                sweep.seen(space, row_summary, subgoals.marks(), from, quadrants, |at| {
                    if let Some(id) = subgoals.id(at) {
                        direct.push(from.to(at), k.depth(), id);
                    }
                });
                direct.for_each_direct(|id| {
                    let to = from.to(subgoals.vertex(id));
                    if kind.includes(to) {
                        visit(id, metric.distance(to));
                    }
                });
            }
            // Does not occur: at any angle the edges are taut.
            (K::Any, None) => {}
        }
    }
}
