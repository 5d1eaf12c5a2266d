//! Tables, as Markdown and as plain text.

/// How the cells of a column are aligned.
#[derive(Clone, Copy, Debug)]
enum Align {
    /// To the left, for names.
    Left,
    /// To the right, for numbers.
    Right,
}

/// A table with a heading. Shorter rows are filled with empty cells.
///
/// ```
/// use mediant_report::Table;
/// let mut table = Table::new(["map", "µs"]);
/// table.row(["arena", "1.5"]);
/// assert_eq!(table.markdown(), "| map | µs |\n|---|--:|\n| arena | 1.5 |\n");
/// ```
#[derive(Clone, Debug)]
pub struct Table {
    align: Vec<Align>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// A table without rows. The first column holds names, the others numbers.
    #[must_use]
    pub fn new<T: Into<String>>(heading: impl IntoIterator<Item = T>) -> Self {
        Self { align: vec![Align::Left], rows: vec![heading.into_iter().map(Into::into).collect()] }
    }

    /// The same table with this many columns of names at the left.
    #[must_use]
    pub fn names(mut self, columns: usize) -> Self {
        self.align = vec![Align::Left; columns];
        self
    }

    /// Adds a row.
    pub fn row<T: Into<String>>(&mut self, cells: impl IntoIterator<Item = T>) {
        self.rows.push(cells.into_iter().map(Into::into).collect());
    }

    /// Whether there is no row below the heading.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.rows.len() < 2
    }

    fn align(&self, column: usize) -> Align {
        self.align.get(column).copied().unwrap_or(Align::Right)
    }

    fn columns(&self) -> usize {
        self.rows.iter().map(Vec::len).max().unwrap_or(0)
    }

    /// The lines of the table as plain text: aligned columns under an underlined heading.
    #[must_use]
    pub fn lines(&self) -> Vec<String> {
        let cell = |row: &Vec<String>, column: usize| row.get(column).cloned().unwrap_or_default();
        let width = |column| self.rows.iter().map(|row| cell(row, column).chars().count()).max().unwrap_or(0);
        let widths: Vec<usize> = (0..self.columns()).map(width).collect();
        let line = |row: &Vec<String>| {
            let cells = widths.iter().enumerate().map(|(column, &width)| match self.align(column) {
                Align::Left => format!("{:width$}", cell(row, column)),
                Align::Right => format!("{:>width$}", cell(row, column)),
            });
            cells.collect::<Vec<_>>().join("  ").trim_end().to_owned()
        };
        let rule = widths.iter().map(|&width| "─".repeat(width)).collect::<Vec<_>>().join("──");
        let mut lines: Vec<String> = self.rows.iter().map(line).collect();
        lines.insert(1, rule);
        lines
    }

    /// The table as Markdown, with a newline at its end. A `|` in a cell is escaped.
    #[must_use]
    pub fn markdown(&self) -> String {
        let line = |row: &Vec<String>| {
            let cells = (0..self.columns())
                .map(|column| row.get(column).map_or(String::new(), |cell| cell.replace('|', "\\|")));
            format!("| {} |\n", cells.collect::<Vec<_>>().join(" | "))
        };
        let rule = (0..self.columns()).map(|column| match self.align(column) {
            Align::Left => "---",
            Align::Right => "--:",
        });
        let rule = format!("|{}|\n", rule.collect::<Vec<_>>().join("|"));
        let mut lines: Vec<String> = self.rows.iter().map(line).collect();
        lines.insert(1, rule);
        lines.concat()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_aligned() {
        let mut table = Table::new(["map", "µs"]);
        assert!(table.is_empty());
        table.row(["a|b", "1.5"]);
        table.row(["longer", "12345"]);
        table.row(["short"]);
        assert_eq!(
            table.markdown(),
            "| map | µs |\n|---|--:|\n| a\\|b | 1.5 |\n| longer | 12345 |\n| short |  |\n"
        );
        assert_eq!(
            table.lines(),
            ["map        µs", "─────────────", "a|b       1.5", "longer  12345", "short"]
        );
        assert!(table.names(2).markdown().starts_with("| map | µs |\n|---|---|\n"));
    }
}
