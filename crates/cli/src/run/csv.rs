//! `--format csv`: a line for each query, for tables of other programs.

use std::io::{self, Write};

use super::{
    answer::{EditRecord, QueryRecord, RunHead},
    report::Report,
    summary::Summary,
};
use crate::terminal::screen::Screen;

/// The columns. Scripts rely on them and on their order.
const COLUMNS: &str = "index,start_x,start_y,goal_x,goal_y,status,cost,reference,waypoints,expanded,nanos";

/// Writes the line of each query as it comes. Edits and the summary have none.
pub(crate) struct Csv<'s> {
    screen: &'s mut Screen,
}

impl<'s> Csv<'s> {
    pub(crate) fn new(screen: &'s mut Screen) -> Self {
        Self { screen }
    }
}

impl Report for Csv<'_> {
    fn begin(&mut self, _: &RunHead<'_>) -> io::Result<()> {
        writeln!(self.screen, "{COLUMNS}")
    }

    fn edit(&mut self, _: &EditRecord<'_>) -> io::Result<()> {
        Ok(())
    }

    fn query(&mut self, record: QueryRecord) -> io::Result<()> {
        // Empty where there is no such number.
        let number = |value: Option<f64>| value.map_or(String::new(), |value| value.to_string());
        let (start, goal) = record.ends();
        let waypoints = record.path().map_or(String::new(), |path| path.points().count().to_string());
        writeln!(
            self.screen,
            "{},{},{},{},{},{},{},{},{waypoints},{},{}",
            record.item.index,
            start.x(),
            start.y(),
            goal.x(),
            goal.y(),
            record.status(),
            number(record.cost()),
            number(record.item.reference),
            record.counters.expanded,
            record.nanos
        )
    }

    fn end(&mut self, _: &Summary) -> io::Result<()> {
        self.screen.flush()
    }
}
