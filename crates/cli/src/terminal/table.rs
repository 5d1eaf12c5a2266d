//! Tables whose columns line up.

use std::{
    borrow::Cow,
    io::{self, Write},
};

use anstyle::Style;

use super::screen::{BOLD, Screen};

/// At which side the texts of a column line up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Align {
    Left,
    Right,
}

/// A row of a table.
struct Row {
    /// Two characters in the left margin.
    lead: String,
    style: Style,
    cells: Vec<String>,
}

/// A table whose columns are as wide as their widest cell.
pub(crate) struct TextTable {
    heads: Vec<(Cow<'static, str>, Align)>,
    rows: Vec<Row>,
}

impl TextTable {
    /// A table with these heads and no rows.
    pub(crate) fn new<H: Into<Cow<'static, str>>>(heads: impl IntoIterator<Item = (H, Align)>) -> Self {
        let heads = heads.into_iter().map(|(head, align)| (head.into(), align)).collect();
        Self { heads, rows: Vec::new() }
    }

    /// Adds a row; missing cells at its end are empty.
    pub(crate) fn row(&mut self, cells: impl Into<Vec<String>>) {
        self.row_with("  ".to_owned(), Style::new(), cells);
    }

    /// Adds a row in a style, with `lead` in the left margin: two characters, which may have a style of their
    /// own.
    pub(crate) fn row_with(&mut self, lead: String, style: Style, cells: impl Into<Vec<String>>) {
        self.rows.push(Row { lead, style, cells: cells.into() });
    }

    /// Writes the table, indented by two columns.
    pub(crate) fn write(&self, screen: &mut Screen) -> io::Result<()> {
        let width_of = |column: usize| {
            let cells = self.rows.iter().filter_map(|row| row.cells.get(column));
            let widest = cells.map(|cell| cell.chars().count()).max().unwrap_or(0);
            widest.max(self.heads[column].0.chars().count())
        };
        let widths: Vec<usize> = (0..self.heads.len()).map(width_of).collect();
        let line = |cells: &mut dyn Iterator<Item = &str>| {
            let mut line = String::new();
            for ((cell, &width), (_, align)) in cells.zip(&widths).zip(&self.heads) {
                if !line.is_empty() {
                    line += "  ";
                }
                match align {
                    Align::Left => line += &format!("{cell:<width$}"),
                    Align::Right => line += &format!("{cell:>width$}"),
                }
            }
            line.trim_end().to_owned()
        };
        let head = line(&mut self.heads.iter().map(|(head, _)| &**head));
        writeln!(screen, "  {}", screen.paint(BOLD, head))?;
        for Row { lead, style, cells } in &self.rows {
            let row = line(&mut cells.iter().map(String::as_str));
            writeln!(screen, "{lead}{}", screen.paint(*style, row))?;
        }
        Ok(())
    }
}
