//! Straightening: HPA*'s smoothing, which shortens a path without leaving N(k).

use mediant_grid::{Centers, GridGraph, Vector, Vertex};
use mediant_moves::{Cost, decompose};

use crate::waypoints::waypoints;

/// How many turning points back a shortcut may begin. In the mean of 14 maps, k = 3: with 4 the paths of HPA*
/// are 0.57 % longer than optimal, and a query takes 1.08 times as long as without straightening; with 8 it
/// is 0.43 % and 1.25 times, with 16 0.42 % and 1.71 times.
const REACH: usize = 8;

/// The scratch memory of straightening.
#[derive(Clone, Debug, Default)]
pub(crate) struct Straighten {
    turns: Vec<Vertex>,
    /// For each turning point the cost of the best path to it, the index of the turning point before it on
    /// that path, and the vertex at which the path turns between the two.
    best: Vec<(Cost, usize, Vertex)>,
    cells: Vec<Vertex>,
}

impl Straighten {
    /// The waypoints of a path, shortened: the shortest path over its turning points. Two that are at most
    /// [`REACH`] apart are joined where [`free_elbow`] finds a free path between them. Botea 2004, Section
    /// 3.3, joins those on one straight line.
    pub(crate) fn path(&mut self, grid_graph: &GridGraph<Centers>, path: &[Vertex]) -> Vec<Vertex> {
        let Self { turns, best, cells } = self;
        waypoints(path, turns);
        best.clear();
        for (to, &at) in turns.iter().enumerate() {
            let Some((&before, &(cost, ..))) =
                to.checked_sub(1).and_then(|from| turns.get(from).zip(best.last()))
            else {
                best.push((Cost::ZERO, 0, at));
                continue;
            };
            let mut found = (cost + grid_graph.costs().distance(before.to(at)), to - 1, at);
            for from in to.saturating_sub(REACH)..to - 1 {
                let cost = best[from].0 + grid_graph.costs().distance(turns[from].to(at));
                if cost < found.0
                    && let Some(elbow) = free_elbow(grid_graph, turns[from], at)
                {
                    found = (cost, from, elbow);
                }
            }
            best.push(found);
        }
        cells.clear();
        let mut at = turns.len().saturating_sub(1);
        cells.extend(turns.get(at));
        while at > 0 {
            let (_, from, elbow) = best[at];
            at = from;
            cells.extend([elbow, turns[at]]);
        }
        cells.reverse();
        let mut path = Vec::with_capacity(cells.len());
        waypoints(cells, &mut path);
        path
    }
}

/// The vertex at which a path between two vertices turns that costs h_k and turns only once. There are two
/// such paths; `None` if neither is free.
pub(crate) fn free_elbow(grid_graph: &GridGraph<Centers>, from: Vertex, to: Vertex) -> Option<Vertex> {
    let parts = decompose(from.to(to), grid_graph.k())?;
    [(parts.v, parts.alpha), (parts.w, parts.beta)]
        .map(|(v, times)| from + Vector::new(v.x * times as i32, v.y * times as i32))
        .into_iter()
        .find(|&elbow| grid_graph.sees(from, elbow) && grid_graph.sees(elbow, to))
}
