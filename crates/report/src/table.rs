//! Tables, as Markdown and as plain text.

/// Where the cells of a column stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// To the left: names.
    Left,
    /// To the right: numbers.
    Right,
}

/// A table in the making. Rows that are shorter than the heading are filled with empty cells.
#[derive(Clone, Debug)]
pub struct Table {
    align: Vec<Align>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// With a column of names, then columns of numbers.
    #[must_use]
    pub fn new<T: Into<String>>(heading: impl IntoIterator<Item = T>) -> Self {
        Self { align: vec![Align::Left], rows: vec![heading.into_iter().map(Into::into).collect()] }
    }

    /// With so many columns of names at the left.
    #[must_use]
    pub fn names(mut self, columns: usize) -> Self {
        self.align = vec![Align::Left; columns];
        self
    }

    /// Adds a row.
    pub fn row<T: Into<String>>(&mut self, cells: impl IntoIterator<Item = T>) {
        self.rows.push(cells.into_iter().map(Into::into).collect());
    }

    /// Whether there is no row but the heading.
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

    /// The lines of the table as plain text: the heading underlined, cells as wide as their columns.
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

/// Three significant digits, no more than three after the point, thousands apart.
#[must_use]
pub fn number(value: f64) -> String {
    match value.abs() {
        size if size < 0.9995 => format!("{value:.3}"),
        size if size < 9.995 => format!("{value:.2}"),
        size if size < 99.95 => format!("{value:.1}"),
        _ => thousands(value),
    }
}

/// A whole number, rounded, thousands apart.
#[must_use]
pub fn thousands(value: f64) -> String {
    let digits = format!("{:.0}", value.abs());
    let mut text = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at) % 3 == 0 {
            text.push(',');
        }
        text.push(digit);
    }
    if value <= -0.5 { format!("-{text}") } else { text }
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

    #[test]
    fn numbers_are_short() {
        let numbers = [0.0, 0.12345, 0.9999, 1.005, 9.999, 42.123, 999.6, 1_234_567.0, -2.36];
        let texts = numbers.map(number);
        assert_eq!(texts, ["0.000", "0.123", "1.00", "1.00", "10.0", "42.1", "1,000", "1,234,567", "-2.36"]);
        assert_eq!([0.4, -0.4, -1234.0].map(thousands), ["0", "0", "-1,234"]);
    }
}
