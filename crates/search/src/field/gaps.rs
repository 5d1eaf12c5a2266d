//! Distances at closed gaps.
//!
//! Under [`DiagonalGap::Closed`] a path touches a gap with its ends alone: the search of a field enters none.
//! Its distances everywhere else are final. A path that ends at a gap comes through the quadrant of the
//! vertex's own cell, from a vertex that is none; so its distance follows from those of its neighbors. (No
//! move joins two gaps at which paths may end: each would have to leave through the lower right quadrant.)
//!
//! One case is left, at k = 2. Where two opposite corners of a cell are gaps, the way from one of the other
//! two corners to the opposite one leads along the edges of the cell, past a gap. All four neighbors of such
//! a cell are blocked, so that nothing but the cell's own corners is within reach.

use mediant_grid::{
    DiagonalGap, FreeSpace, GridGraph, Interrupt, Interrupted, Placement, Rules, Vertex, VertexId,
};
use mediant_moves::{Cost, FiniteK, Vector};

/// The corners of a cell, clockwise from the upper left one, as offsets.
const CORNERS: [Vector; 4] = [Vector::new(0, 0), Vector::new(1, 0), Vector::new(1, 1), Vector::new(0, 1)];

/// Under [`DiagonalGap::Closed`], adds the distances at gaps, and within cells that are closed in by gaps.
pub(super) fn end_at_gaps<P: Placement>(
    graph: &GridGraph<P>,
    sources: &[VertexId],
    limit: Cost,
    costs: &mut [Cost],
    interrupt: &Interrupt,
) -> Result<(), Interrupted> {
    if !graph.has_closed_gaps() {
        return Ok(());
    }
    for id in (0..graph.vertex_count() as u32).map(VertexId) {
        interrupt.check_every(1 << 16, id.index(), "finding the distances of a field")?;
        let at = graph.vertex(id);
        if !graph.is_closed_gap(at) || costs[id.index()] == Cost::ZERO {
            continue;
        }
        let mut best = Cost::MAX;
        graph.for_each_legal_move(at, |index| {
            let (back, from) = (graph.step(index), at + graph.step(index).vector());
            let known = costs[back.target(id).index()];
            if known != Cost::MAX && !graph.is_closed_gap(from) && graph.may_turn(Some(from), at, None) {
                best = best.min(known + back.cost);
            }
        });
        costs[id.index()] = if best > limit { Cost::MAX } else { best };
    }
    if graph.k() == FiniteK::N4 {
        for &source in sources {
            for (cell, corner) in closed_cells(graph, graph.vertex(source)) {
                for (steps, to) in
                    [(1, 1), (1, 3), (2, 2)].map(|(n, on)| (n, cell + CORNERS[(corner + on) % 4]))
                {
                    let cost = Cost::of_move(Vector::new(1, 0)) * steps;
                    let known = graph.id(to).and_then(|id| costs.get_mut(id.index()));
                    if let Some(known) = known.filter(|known| cost < **known && cost <= limit)
                        && may_end_in(graph, to, cell)
                    {
                        *known = cost;
                    }
                }
            }
        }
    }
    Ok(())
}

/// The cells closed in by gaps at a corner of which a path may start or end at `at`, and which corner that
/// is.
fn closed_cells<P: Placement>(space: &FreeSpace<P>, at: Vertex) -> impl Iterator<Item = (Vertex, usize)> {
    let cells = CORNERS.into_iter().zip(0..).map(move |(corner, number)| (at + -corner, number));
    cells.filter(move |&(cell, _)| {
        let gaps = CORNERS.map(|corner| space.is_closed_gap(cell + corner));
        let is_closed = gaps[0] && gaps[2] || gaps[1] && gaps[3];
        space.grid().is_free(cell.x, cell.y) && is_closed && may_end_in(space, at, cell)
    })
}

/// Whether a path may start or end at a corner of a free cell, within the cell.
fn may_end_in<P: Placement>(space: &FreeSpace<P>, at: Vertex, cell: Vertex) -> bool {
    !space.is_closed_gap(at) || at == cell
}

/// At k = 2, the corner of a closed-in cell by which a path from `at` leads to a source at the opposite
/// corner.
pub(super) fn past_a_gap<P: Placement>(
    graph: &GridGraph<P>,
    at: Vertex,
    is_source: impl Fn(Vertex) -> bool,
) -> Option<[Vertex; 2]> {
    if graph.k() != FiniteK::N4 || graph.rules() != Rules::Corner(DiagonalGap::Closed) {
        return None;
    }
    closed_cells(graph, at).find_map(|(cell, corner)| {
        let [past, to] = [1, 2].map(|on| cell + CORNERS[(corner + on) % 4]);
        (is_source(to) && may_end_in(graph, to, cell)).then_some([past, to])
    })
}
