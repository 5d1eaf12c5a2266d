//! Timelines: queries on a map that changes, and the edits between them.

use std::{collections::HashMap, path::Path, sync::Arc};

use mediant::{Costs, Point, PointEnds, Vertex, grid::Grid};
use mediant_formats::{DynamicEvent, DynamicScenario, Optimal, Patch, PlacedPatch};
use serde::{Deserialize, de::IgnoredAny};

use super::queries::{Item, NO_PATH};
use crate::{
    check::file::{bytes, lines, shown},
    edit::{CellCosts, EditLine, LastCosts, check_place, json_problem},
    failure::Failure,
    map::NamedMap,
};

/// An edit of the map.
#[derive(Clone, Debug)]
pub(crate) struct Edit {
    pub(crate) cells: PlacedPatch,
    /// The number of queries before it, of those that are taken.
    pub(crate) after: usize,
    /// The costs of the cells after it, on a map of costs.
    pub(crate) costs: Option<CellCosts>,
    /// Whether the next edit belongs to the same change.
    pub(crate) more: bool,
    /// Whether it makes the map that the run begins with out of one without obstacles.
    pub(crate) initial: bool,
}

/// Queries, and the edits between them.
#[derive(Debug, Default)]
pub(crate) struct Timeline {
    pub(crate) queries: Vec<Item>,
    pub(crate) edits: Vec<Edit>,
}

/// A line of a timeline. The output of a run is one, too.
#[derive(Debug, Deserialize)]
#[serde(tag = "type", rename_all = "lowercase")]
enum Line {
    Edit(EditLine),
    Query { start: Point, goal: Point },
    Run(IgnoredAny),
    Summary(IgnoredAny),
}

impl Timeline {
    /// Reads the JSON lines of a file for a map; `-` is stdin.
    pub(crate) fn read(path: &Path, map: &NamedMap) -> Result<Self, Failure> {
        Self::parse(&bytes(path)?, path, map)
    }

    /// Reads the JSON lines of a file's bytes for a map.
    pub(crate) fn parse(bytes: &[u8], path: &Path, map: &NamedMap) -> Result<Self, Failure> {
        let mut last = LastCosts::new(map.costs.as_ref());
        let mut timeline = Self::default();
        for (line, text) in lines(bytes) {
            let wrong = |problem: String| Failure::PathFile { path: shown(path), line, problem };
            match serde_json::from_slice(text) {
                Ok(Line::Edit(edit)) => {
                    let cells = edit.cells().map_err(wrong)?;
                    check_place(&cells.patch, &map.ground).map_err(wrong)?;
                    let costs = last.after(&cells).map_err(wrong)?;
                    timeline.edit(cells.patch, costs, edit.more);
                }
                Ok(Line::Query { start, goal }) => timeline.query(PointEnds::new(start, goal), None),
                Ok(Line::Run(_) | Line::Summary(_)) => {}
                Err(error) => return Err(wrong(json_problem(&error))),
            }
        }
        if timeline.queries.is_empty() && timeline.edits.is_empty() {
            return Err(Failure::NoEvents { path: shown(path) });
        }
        timeline.end_change();
        Ok(timeline)
    }

    /// The events of a scenario, whose map at its first query is this one.
    pub(crate) fn of_scenario(scenario: &DynamicScenario, map: &Grid) -> Self {
        let (width, height) = (map.width(), map.height());
        let rows = (0..height).flat_map(|y| (0..width).map(move |x| map.is_blocked(x as i32, y as i32)));
        let patch = Arc::new(Patch::new(width, rows));
        let initial = Edit {
            cells: PlacedPatch { patch, x: 0, y: 0 },
            after: 0,
            costs: None,
            more: false,
            initial: true,
        };
        let mut timeline = Self { edits: vec![initial], ..Self::default() };
        for event in scenario.events() {
            match event {
                DynamicEvent::Patch(cells) => timeline.edit(cells.clone(), None, true),
                DynamicEvent::Query(query) => {
                    let reference = match query.optimal {
                        Optimal::Unknown => None,
                        Optimal::NoPath => Some(NO_PATH),
                        Optimal::Length(length) => Some(length),
                    };
                    timeline.query(PointEnds::new(query.start, query.goal), reference);
                }
            }
        }
        timeline.end_change();
        timeline
    }

    fn edit(&mut self, cells: PlacedPatch, costs: Option<CellCosts>, more: bool) {
        self.edits.push(Edit { cells, after: self.queries.len(), costs, more, initial: false });
    }

    fn query(&mut self, ends: PointEnds, reference: Option<f64>) {
        self.end_change();
        self.queries.push(Item { index: self.queries.len(), ends, reference });
    }

    /// No edit that follows belongs to the last change.
    fn end_change(&mut self) {
        if let Some(edit) = self.edits.last_mut() {
            edit.more = false;
        }
    }

    /// Takes only the queries whose index is divisible by `every`, at most `limit` of them, and the edits up
    /// to the last.
    pub(crate) fn take(mut self, every: usize, limit: usize) -> Self {
        for edit in &mut self.edits {
            edit.after = edit.after.div_ceil(every);
        }
        self.queries.retain(|item| item.index % every == 0);
        if self.queries.len() > limit {
            self.queries.truncate(limit);
            self.edits.retain(|edit| edit.after < limit);
        }
        self
    }

    /// The edits, change by change.
    pub(crate) fn changes(edits: &[Edit]) -> impl Iterator<Item = &[Edit]> {
        edits.chunk_by(|edit, _| edit.more)
    }
}

/// The number of cells that each edit of a change alters, on the map before the change.
pub(crate) fn altered(change: &[Edit], map: &NamedMap) -> Vec<u64> {
    match &map.costs {
        Some(costs) => altered_costs(change, costs),
        None => altered_cells(change, &map.ground),
    }
}

/// [`altered`], by the costs of cells.
fn altered_costs(change: &[Edit], costs: &Costs) -> Vec<u64> {
    let mut now = HashMap::new();
    let mut is_altered = |&&(at, cost): &&(Vertex, Option<f64>)| {
        now.insert(at, cost).unwrap_or_else(|| costs.cost(at)) != cost
    };
    change.iter().map(|edit| edit.costs.iter().flatten().filter(&mut is_altered).count() as u64).collect()
}

/// [`altered`], by the cells that are blocked.
fn altered_cells(change: &[Edit], map: &Grid) -> Vec<u64> {
    let altered = |(number, edit): (usize, &Edit)| {
        let at = edit.cells.rectangle();
        let meets = |other: &PlacedPatch| {
            let other = other.rectangle();
            let meet = |a, a_length, b, b_length| a < b + b_length && b < a + a_length;
            meet(at.x, at.width, other.x, other.width) && meet(at.y, at.height, other.y, other.height)
        };
        let earlier: Vec<&PlacedPatch> =
            change[..number].iter().rev().map(|edit| &edit.cells).filter(|&other| meets(other)).collect();
        let was = |x: u32, y: u32| {
            let before = earlier.iter().find_map(|cells| cells.cell(x, y));
            before.unwrap_or_else(|| !edit.initial && map.is_blocked(x as i32, y as i32))
        };
        let rows = edit.cells.patch.rows().zip(at.y..);
        let cells = rows.flat_map(|(row, y)| row.iter().zip(at.x..).map(move |(&now, x)| (now, x, y)));
        cells.filter(|&(now, x, y)| now != was(x, y)).count() as u64
    };
    change.iter().enumerate().map(altered).collect()
}
