//! The distances from one vertex to all others.

use std::sync::Arc;

use mediant_grid::{Grid, GridGraph, Placement, Vertex};
use mediant_search::{Dijkstra, Wavefront};

use crate::{
    configured::ConfiguredEngine,
    error::{EngineError, SetupError},
    setup::Setup,
    space::Space,
};

/// The vertices that can be reached from `start`, row by row, with their distances: in cells, or in moves by
/// the wavefront algorithm.
///
/// ```
/// use std::sync::Arc;
/// use mediant::distances;
/// use mediant_grid::{Grid, Vertex};
///
/// let grid = Arc::new(Grid::from_fn(3, 1, |x, _| x == 2)?);
/// let found = distances("dijkstra".parse()?, &grid, Vertex::new(0, 0))?;
/// assert_eq!(found, [(Vertex::new(0, 0), 0.0), (Vertex::new(1, 0), 1.0)]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`EngineError`] for a setup whose parts do not fit together, an engine that finds no distances, or a start
/// that is blocked or outside the map.
pub fn distances(setup: Setup, grid: &Arc<Grid>, start: Vertex) -> Result<Vec<(Vertex, f64)>, EngineError> {
    match Space::new(setup, grid)? {
        Space::Centers(graph) => on(setup, &graph, start),
        Space::Corners(graph) => on(setup, &graph, start),
        Space::AnyAngle(_) => Err(SetupError::without_distances(setup.engine.kind()).into()),
    }
}

/// [`distances`] on a grid graph.
fn on<P: Placement>(
    setup: Setup,
    graph: &GridGraph<P>,
    start: Vertex,
) -> Result<Vec<(Vertex, f64)>, EngineError> {
    Ok(match setup.engine {
        ConfiguredEngine::Dijkstra => {
            let costs = Dijkstra::new(graph, mediant_search::Zero).distances(start)?;
            costs.iter().map(|(at, cost)| (at, cost.to_f64())).collect()
        }
        ConfiguredEngine::Wavefront => {
            let moves = Wavefront::new(graph).distances(start)?;
            moves.iter().map(|(at, moves)| (at, f64::from(moves))).collect()
        }
        _ => return Err(SetupError::without_distances(setup.engine.kind()).into()),
    })
}
