//! The characters of free and of blocked cells.

use mediant::files::Tiles;
use wasm_bindgen::prelude::*;

use super::{CostOptions, KEYS};
use crate::{
    arguments::text,
    errors::argument,
    keywords::{entries, unknown_key},
};

pub(super) const TILES: &str = "a text of characters";

/// The characters of free and of blocked cells, and what is said of costs, from the options of `fromRows`.
pub(super) fn row_options(given: &JsValue) -> Result<(Tiles, CostOptions), JsValue> {
    let (mut free, mut blocked, mut of_costs) = (None, None, CostOptions::default());
    for (key, value) in entries("options", given)? {
        match key.as_str() {
            "free" | "blocked" if value.is_undefined() => {}
            "free" => free = Some(text(&key, TILES, &value)?),
            "blocked" => blocked = Some(text(&key, TILES, &value)?),
            _ if of_costs.take(&key, &value) => {}
            _ => return Err(unknown_key("options", &key, &["free, blocked", KEYS].join(", "))),
        }
    }
    Ok((tiles(free.as_deref(), blocked.as_deref())?, of_costs))
}

pub(super) fn tiles(free: Option<&str>, blocked: Option<&str>) -> Result<Tiles, JsValue> {
    let name = if free.is_some() { "free" } else { "blocked" };
    Tiles::new(free, blocked).map_err(|wrong| argument(name, &wrong.to_string()))
}
