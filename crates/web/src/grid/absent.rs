//! The light module has no costs of cells.

use mediant::{Answer, Error, Guarantee, Map, Motion, Query, Setup, Space, call::Call};
use wasm_bindgen::prelude::*;

use super::Grid;

/// The answer to cells and keys that hold costs.
pub(crate) const COSTS: &str =
    "the light module has no costs of cells: import the whole one, 'mediant', for grid.withCosts";
/// The keys of a grid's options about costs.
pub(super) const KEYS: &str = "";

/// The costs of a grid's cells, which none has.
#[derive(Clone)]
pub(crate) enum OfCells {}

impl OfCells {
    pub(crate) const fn of(_: &Space) -> Option<Self> {
        None
    }

    pub(super) fn id(&self) -> String {
        match *self {}
    }

    pub(crate) fn space(&self, _: Motion) -> Result<Space, Error> {
        match *self {}
    }

    pub(super) fn on(&self, _: &Map) -> Result<Self, JsValue> {
        match *self {}
    }

    pub(super) fn setup(&self, _: &Call, _: Motion) -> Result<Setup, Error> {
        match *self {}
    }

    pub(super) fn find(&self, _: (&Call, Motion), _: Query) -> Result<(Answer, Guarantee), Error> {
        match *self {}
    }
}

/// The options of a new grid about costs, of which there are none.
#[derive(Default)]
pub(super) struct CostOptions(());

impl CostOptions {
    pub(super) const fn take(&mut self, _: &str, _: &JsValue) -> bool {
        false
    }

    #[expect(clippy::unnecessary_wraps, reason = "with costs there are mistakes")]
    pub(super) const fn on(&self, grid: Grid) -> Result<Grid, JsValue> {
        Ok(grid)
    }
}
