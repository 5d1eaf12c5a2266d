//! The distances from one vertex to all others.

use std::sync::Arc;

use mediant_grid::{Grid, GridGraph, Placement, Vertex};
use mediant_search::{Dijkstra, Wavefront};

use crate::{Engine, EngineError, EngineKind, SearchSpace, Setup, SetupError};

/// The vertices that can be reached from `start`, row by row, with their distances: in cells, or by the wavefront algorithm in
/// moves.
///
/// # Errors
/// [`EngineError`] for a setup that does not exist, an engine that finds no distances, or a start that is blocked or outside
/// the map.
pub fn distances(setup: Setup, grid: &Arc<Grid>, start: Vertex) -> Result<Vec<(Vertex, f64)>, EngineError> {
    match SearchSpace::new(setup, grid)? {
        SearchSpace::Centers(graph) => on(setup, &graph, start),
        SearchSpace::Corners(graph) => on(setup, &graph, start),
        SearchSpace::AnyAngle(_) => Err(without_distances(setup).into()),
    }
}

fn on<P: Placement>(
    setup: Setup,
    graph: &GridGraph<P>,
    start: Vertex,
) -> Result<Vec<(Vertex, f64)>, EngineError> {
    Ok(match setup.engine {
        Engine::Dijkstra => {
            let costs = Dijkstra::new(graph, mediant_search::Zero).distances(start)?;
            costs.iter().map(|(at, cost)| (at, cost.to_f64())).collect()
        }
        Engine::Wavefront => {
            let moves = Wavefront::new(graph).distances(start)?;
            moves.iter().map(|(at, moves)| (at, f64::from(moves))).collect()
        }
        _ => return Err(without_distances(setup).into()),
    })
}

fn without_distances(setup: Setup) -> SetupError {
    let others = EngineKind::names_of(|kind| kind.capabilities().distances);
    SetupError::Without { engine: setup.engine.kind(), what: "distances to all vertices", others }
}
