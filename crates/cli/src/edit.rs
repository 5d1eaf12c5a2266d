//! Edits of a map, as the lines of `--format jsonl` and of timelines tell them.

use std::sync::Arc;

use mediant::grid::Grid;
use mediant_formats::{Patch, PlacedPatch};
use serde::Deserialize;

/// An edit as it stands in a line: `#` is blocked, `.` free.
#[derive(Debug, Deserialize)]
pub(crate) struct EditLine {
    x: i64,
    y: i64,
    rows: Vec<String>,
    /// Whether the next edit belongs to the same change.
    #[serde(default)]
    pub(crate) more: bool,
}

impl EditLine {
    /// The cells of the edit; the error is in words.
    pub(crate) fn cells(&self) -> Result<PlacedPatch, String> {
        let Self { x, y, rows, .. } = self;
        let width = rows.first().map_or(0, String::len);
        if width == 0 {
            return Err("an edit has rows of one cell or more, such as \"rows\": [\"..#\"]".to_owned());
        }
        let mut cells = Vec::new();
        for (number, row) in rows.iter().enumerate() {
            for cell in row.chars() {
                match cell {
                    '#' | '.' => cells.push(cell == '#'),
                    _ => {
                        return Err(format!(
                            "row {number} has the cell `{cell}`: write # for blocked, . for free"
                        ));
                    }
                }
            }
            if row.len() != width {
                let found = row.len();
                return Err(format!(
                    "row {number} has {found} cells, and row 0 has {width}: make them equally long"
                ));
            }
        }
        let (Ok(x), Ok(y)) = (u32::try_from(*x), u32::try_from(*y)) else {
            return Err(format!("the edit at ({x}, {y}) is outside the map"));
        };
        Ok(PlacedPatch { patch: Arc::new(Patch::new(width as u32, cells)), x, y })
    }
}

/// Checks that an edit is on a map; the error is in words.
pub(crate) fn check_place(cells: &PlacedPatch, grid: &Grid) -> Result<(), String> {
    let at = cells.rectangle();
    let fits = |first: u32, count: u32, side: u32| u64::from(first) + u64::from(count) <= u64::from(side);
    if fits(at.x, at.width, grid.width()) && fits(at.y, at.height, grid.height()) {
        return Ok(());
    }
    Err(format!("the edit of {at} is not on the map, which has {} × {} cells", grid.width(), grid.height()))
}

/// A JSON error without its line, which is always 1 in a file of lines.
pub(crate) fn json_problem(error: &serde_json::Error) -> String {
    let text = error.to_string();
    let text = text.split(" at line ").next().unwrap_or_default();
    if error.is_syntax() { format!("this is not JSON ({text})") } else { text.to_owned() }
}
