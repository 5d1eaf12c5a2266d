//! Maps with longer sides than engines without costs take: what there is on them, and what is refused.

use std::sync::Arc;

#[cfg(feature = "costs")]
use mediant_grid::Interrupt;
use mediant_grid::{Clearance, Fit, Grid, Outside};
use mediant_search::Smoothing;

#[cfg(feature = "costs")]
use crate::error::Error;
use crate::{engine::Engine, map::Map, setup::Setup, setup_error::SetupError, space::Space};

/// The way out where cells have no costs.
const CUT: &str =
    "cut the map, or give its cells costs, on which astar, dijkstra, landmarks and fields take it";
/// The way out where they have.
const ON_COSTS: &str = "choose astar, dijkstra, landmarks or a field without smoothing, or cut the map";

impl Map {
    /// A map of any sides that costs take: with [longer](Grid::long) ones than [`Grid::MAX_SIDE`] it is for
    /// [`costs`](Self::costs) alone.
    #[cfg(feature = "costs")]
    pub(crate) fn long(
        (width, height): (u32, u32),
        interrupt: &Interrupt,
        blocked: impl FnMut(u32, u32) -> bool,
    ) -> Result<Self, Error> {
        Ok(Grid::long(width, height, interrupt, blocked)?.into())
    }

    /// Refuses a map with longer sides than something takes.
    pub(crate) fn check_sides(&self, what: &'static str) -> Result<(), SetupError> {
        self.refuse_long(what, CUT)
    }

    fn refuse_long(&self, what: &'static str, instead: &'static str) -> Result<(), SetupError> {
        match self.grid().is_long() {
            true => Err(SetupError::LongSide { what, size: (self.width(), self.height()), instead }),
            false => Ok(()),
        }
    }

    /// The clearance, on a map with sides that it takes; else that of one blocked cell, where nothing fits.
    pub(crate) fn clearance_or_none(&self, fit: Fit, outside: Outside) -> Clearance {
        let grid = Arc::clone(self.grid());
        let grid = match grid.is_long() {
            true => Grid::from_fn(1, 1, |_, _| true).map_or(grid, Arc::new),
            false => grid,
        };
        Clearance::new(grid, fit, outside)
    }
}

impl Space {
    /// Refuses what does not take the sides of the map.
    pub(crate) fn check_sides(&self, setup: &Setup) -> Result<(), SetupError> {
        let engine = setup.engine.kind();
        if !self.has_costs() {
            return self.map().check_sides(engine.name());
        }
        let knows = matches!(engine, Engine::AStar | Engine::Dijkstra | Engine::Landmarks);
        let smooths = (setup.smoothing == Some(Smoothing::Linear)).then_some("smoothing");
        let refused = if knows { smooths } else { Some(engine.name()) };
        refused.map_or(Ok(()), |what| self.map().refuse_long(what, ON_COSTS))
    }
}
