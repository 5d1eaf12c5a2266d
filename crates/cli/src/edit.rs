//! Edits of a map, as the lines of `--format jsonl` and of timelines tell them.

use std::{collections::HashMap, sync::Arc};

use mediant::{Costs, Vertex, grid::Grid};
use mediant_formats::{Patch, PlacedPatch};
use serde::Deserialize;

/// An edit as it stands in a line: of `rows` `#` is blocked, `.` free; of `costs` each cell has its cost, or
/// `null` for a blocked one.
#[derive(Debug, Deserialize)]
pub(crate) struct EditLine {
    x: i64,
    y: i64,
    #[serde(default)]
    rows: Vec<String>,
    #[serde(default)]
    costs: Vec<Vec<Option<f64>>>,
    /// Whether the next edit belongs to the same change.
    #[serde(default)]
    pub(crate) more: bool,
}

/// The cells of an edit.
#[derive(Clone, Debug)]
pub(crate) struct EditCells {
    pub(crate) patch: PlacedPatch,
    /// Their costs, row by row, if the edit names some.
    costs: Option<Vec<Option<f64>>>,
}

/// Cells with their costs after an edit; blocked ones have none.
pub(crate) type CellCosts = Vec<(Vertex, Option<f64>)>;

impl EditLine {
    /// The cells of the edit; the error is in words.
    pub(crate) fn cells(&self) -> Result<EditCells, String> {
        let Self { x, y, rows, costs, .. } = self;
        let (width, cells, costs) = match (rows.is_empty(), costs.is_empty()) {
            (_, true) => (rows.first().map_or(0, String::len), blocked(rows)?, None),
            (true, false) => {
                let costs = costs_of(costs)?;
                (costs.0, costs.1.iter().map(Option::is_none).collect(), Some(costs.1))
            }
            (false, false) => {
                return Err("an edit has \"rows\" or \"costs\": leave one of them out".to_owned());
            }
        };
        let (Ok(x), Ok(y)) = (u32::try_from(*x), u32::try_from(*y)) else {
            return Err(format!("the edit at ({x}, {y}) is outside the map"));
        };
        let patch = Arc::new(Patch::new(width as u32, cells));
        Ok(EditCells { patch: PlacedPatch { patch, x, y }, costs })
    }
}

/// The cells of rows, row by row: whether each is blocked.
fn blocked(rows: &[String]) -> Result<Vec<bool>, String> {
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
        check_length(number, row.len(), width)?;
    }
    Ok(cells)
}

/// The width of rows of costs, and their cells.
fn costs_of(rows: &[Vec<Option<f64>>]) -> Result<(usize, Vec<Option<f64>>), String> {
    let width = rows.first().map_or(0, Vec::len);
    if width == 0 {
        return Err("an edit has costs of one cell or more, such as \"costs\": [[1, 2.5, null]]".to_owned());
    }
    for (number, row) in rows.iter().enumerate() {
        if let Some(cost) = row.iter().flatten().find(|&&cost| !(cost.is_finite() && cost > 0.0)) {
            return Err(format!(
                "row {number} has the cost {cost}: write a positive number, or null for blocked"
            ));
        }
        check_length(number, row.len(), width)?;
    }
    Ok((width, rows.concat()))
}

/// Checks that a row is as long as the first.
fn check_length(number: usize, found: usize, width: usize) -> Result<(), String> {
    if found == width {
        return Ok(());
    }
    Err(format!("row {number} has {found} cells, and row 0 has {width}: make them equally long"))
}

/// The costs that cells had last, by which an edit frees them.
pub(crate) struct LastCosts {
    /// The costs that were read; `None` on a map without costs.
    read: Option<Costs>,
    /// The costs of edits.
    given: HashMap<Vertex, f64>,
}

impl LastCosts {
    /// The costs of a map as it was read.
    pub(crate) fn new(costs: Option<&Costs>) -> Self {
        Self { read: costs.cloned(), given: HashMap::new() }
    }

    /// The cells with their costs after an edit; `None` on a map without costs. The error is in words.
    pub(crate) fn after(&mut self, edit: &EditCells) -> Result<Option<CellCosts>, String> {
        let Some(read) = &self.read else {
            return match edit.costs {
                Some(_) => {
                    Err("the edit has \"costs\", and the map has none: give it costs, or write \"rows\""
                        .to_owned())
                }
                None => Ok(None),
            };
        };
        let at = edit.patch.rectangle();
        let places = (at.y..at.y + at.height).flat_map(|y| (at.x..at.x + at.width).map(move |x| (x, y)));
        let mut cells = Vec::new();
        for (number, (x, y)) in places.enumerate() {
            let cell = Vertex::new(x as i32, y as i32);
            let cost = match &edit.costs {
                Some(costs) => costs.get(number).copied().flatten(),
                None if edit.patch.is_blocked(x, y) => None,
                None => {
                    let last = self.given.get(&cell).copied().or_else(|| read.cost(cell));
                    let cost = last.ok_or_else(|| {
                        format!(
                            "cell ({x}, {y}) never had a cost: write \"costs\" in place of \"rows\", such as \
                             \"costs\": [[1, 2.5, null]]"
                        )
                    })?;
                    Some(cost)
                }
            };
            self.given.extend(cost.map(|cost| (cell, cost)));
            cells.push((cell, cost));
        }
        Ok(Some(cells))
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
