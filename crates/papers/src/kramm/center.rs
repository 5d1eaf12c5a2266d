//! Figure 6: two cells that meet in a corner, and the one cell that joins them. No map is worse for paths
//! between centers (Theorem 3).

use std::sync::Arc;

use mediant::Map;
use mediant_grid::{AsciiMap, DiagonalGap, Grid, Vertex};
use mediant_oracle::Visibility;
use mediant_report::GridDrawing;
use mediant_search::Ends;

use crate::{Error, setups::setup};

/// A move may touch one obstacle, but not pass between two. So the path goes around through three free cells;
/// an any-angle path keeps to the corners of the obstacles between them.
const WORST: &str = "
    #s.
    g#.
    ...
";

/// The instance.
pub(super) struct Worst {
    grid: Arc<Grid>,
    start: Vertex,
    goal: Vertex,
}

impl Worst {
    pub(super) fn new() -> Result<Self, Error> {
        let wrong = || Error::Reproduce("the drawing of Figure 6 is no map with two ends".to_owned());
        let map = AsciiMap::parse(WORST).map_err(|_| wrong())?;
        let (start, goal) = map.mark('s').zip(map.mark('g')).ok_or_else(wrong)?;
        Ok(Self { grid: Arc::new(map.grid), start, goal })
    }

    /// An optimal path over N(k), as A* finds it, in cells: the center of the first cell is (0.5, 0.5).
    pub(super) fn path(&self, k: u32) -> Result<Vec<(f64, f64)>, Error> {
        let wrong = |wrong: &dyn std::fmt::Display| Error::Reproduce(format!("Figure 6, k = {k}: {wrong}"));
        let setup = setup(&format!("astar:{k}:one"))?;
        let mut planner = setup.planner(&Map::from(Arc::clone(&self.grid))).map_err(|error| wrong(&error))?;
        let answer = planner.find(Ends::new(self.start, self.goal)).map_err(|error| wrong(&error))?;
        let path = answer.path().ok_or_else(|| wrong(&"no path"))?;
        Ok(path.waypoints().iter().map(|at| (f64::from(at.x) + 0.5, f64::from(at.y) + 0.5)).collect())
    }

    /// An optimal any-angle path. It is one between corners of a grid with each cell divided into four, whose
    /// vertices are the centers and the corners of these cells.
    pub(super) fn any_angle(&self) -> Result<Vec<(f64, f64)>, Error> {
        let (width, height) = (2 * self.grid.width(), 2 * self.grid.height());
        let quarters = Grid::from_fn(width, height, |x, y| self.grid.is_blocked(x as i32 / 2, y as i32 / 2))
            .map_err(|wrong| Error::Reproduce(wrong.to_string()))?;
        let visibility = Visibility::new(&quarters, DiagonalGap::Closed);
        let center = |cell: Vertex| Vertex::new(2 * cell.x + 1, 2 * cell.y + 1);
        let graph = visibility.over(None);
        let path = graph.costs_from(center(self.start)).path_to(center(self.goal)).unwrap_or_default();
        Ok(path.iter().map(|at| (f64::from(at.x) / 2.0, f64::from(at.y) / 2.0)).collect())
    }

    /// The optimum over N(k) over that at any angle.
    pub(super) fn ratio(&self, k: u32) -> Result<f64, Error> {
        Ok(length(&self.path(k)?) / length(&self.any_angle()?))
    }

    pub(super) fn drawing(&self) -> Result<String, Error> {
        let named = |name: &str, path: &[(f64, f64)]| format!("{name}: length {:.4}", length(path));
        let (two, more, any) = (self.path(2)?, self.path(3)?, self.any_angle()?);
        let drawing = GridDrawing::new("The worst case between cell centers", &self.grid)
            .note("Paths may touch an obstacle's corner, but not pass between two obstacles")
            .path(named("over N(2)", &two), two.iter().copied())
            .path(named("over N(k), k ≥ 3", &more), more.iter().copied())
            .path(named("any angle", &any), any.iter().copied());
        Ok(drawing.svg())
    }
}

fn length(path: &[(f64, f64)]) -> f64 {
    path.windows(2).map(|ends| (ends[1].0 - ends[0].0).hypot(ends[1].1 - ends[0].1)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_drawing_is_the_worst_case() {
        let worst = Worst::new().unwrap();
        let root = std::f64::consts::SQRT_2;
        assert!((worst.ratio(2).unwrap() - 6.0 / (2.0 + root)).abs() < 1e-12);
        for k in 3..=9 {
            assert!((worst.ratio(k).unwrap() - (3.0 * root - 3.0)).abs() < 1e-12, "k = {k}");
        }
        assert!((length(&worst.any_angle().unwrap()) - (2.0 + root)).abs() < 1e-12);
    }
}
