//! Features that the library does not have.

/// The answer to cells that hold costs where a cell is free or blocked.
pub const NO_COSTS: &str =
    "here a cell is free or blocked; a map with costs of cells is one that is made with `costs`";

/// How names of parameters that people look for begin, in small letters without hyphens and underscores; and
/// why there are none.
const ABSENT: [(&[&str], &str); 7] = [
    (&["weight", "cost", "terrain"], NO_COSTS),
    (&["oneway"], "a move that is allowed is allowed in both directions: there are no one-way cells"),
    (
        &["link", "portal", "teleport", "stair"],
        "moves lead along the map: there are no links between far cells",
    ),
    (
        &["wrap", "torus", "toroidal", "periodic"],
        "everything outside the map is blocked: it does not wrap around",
    ),
    (&["hex"], "cells are squares: there are no hexagons"),
    (&["layer", "floor", "3d"], "a map is flat: it has no layers and no third dimension"),
    (&["reserv", "agents"], "a path is that of one agent, and knows no time: there are no reservations"),
];

/// Why no call has a parameter of this name, if it asks for something that the library does not do: costs of
/// cells, one-way cells, links, maps that wrap around, hexagons, layers, reservations. For an error beside
/// the names that are known.
///
/// ```
/// use mediant::errors::{NO_COSTS, absent};
/// assert_eq!(absent("weights"), Some(NO_COSTS));
/// assert_eq!(absent("smooth"), None);
/// ```
#[must_use]
pub fn absent(name: &str) -> Option<&'static str> {
    let plain: String = name.to_ascii_lowercase().chars().filter(|c| !matches!(c, '_' | '-')).collect();
    let begins = |words: &[&str]| words.iter().any(|word| plain.starts_with(word));
    ABSENT.iter().find(|(words, _)| begins(words)).map(|&(_, why)| why)
}
