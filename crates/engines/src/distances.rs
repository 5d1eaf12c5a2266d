//! How far it is from one vertex to all others.

use std::sync::Arc;

use mediant_grid::{Grid, GridGraph, Placement, Vertex};
use mediant_search::{Dijkstra, Wavefront};

use crate::{Engine, EngineError, Ground, Setup, SetupError, setup::those};

/// The vertices that can be reached from `start`, row by row, with their distances: in cells, by the wavefront algorithm in moves.
///
/// # Errors
/// [`EngineError`] for a setup that does not exist, an engine that finds no distances, or a start that is blocked or outside the
/// map.
pub fn distances(setup: Setup, grid: &Arc<Grid>, start: Vertex) -> Result<Vec<(Vertex, f64)>, EngineError> {
    match Ground::new(setup, grid)? {
        Ground::Centers(grid_graph) => on(setup, &grid_graph, start),
        Ground::Corners(grid_graph) => on(setup, &grid_graph, start),
        Ground::AnyAngle(_) => Err(without_distances(setup.engine).into()),
    }
}

fn on<P: Placement>(
    setup: Setup,
    grid_graph: &GridGraph<P>,
    start: Vertex,
) -> Result<Vec<(Vertex, f64)>, EngineError> {
    Ok(match setup.engine {
        Engine::Dijkstra => {
            let costs = Dijkstra::new(grid_graph, mediant_search::Zero).distances(start)?;
            costs.iter().map(|(at, cost)| (at, cost.to_f64())).collect()
        }
        Engine::Wavefront => {
            let moves = Wavefront::new(grid_graph).distances(start)?;
            moves.iter().map(|(at, moves)| (at, f64::from(moves))).collect()
        }
        engine => return Err(without_distances(engine).into()),
    })
}

fn without_distances(engine: Engine) -> SetupError {
    let others = those(|about| about.distances);
    SetupError::Without { engine, what: "distances to all vertices", others }
}
