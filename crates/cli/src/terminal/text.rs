//! Numbers for people, and tables that line up.

use std::io::{self, Write};

use anstyle::Style;

use super::screen::{BOLD, Screen};

/// A time with three digits and a unit: `812 ns`, `1.23 µs`, `45.6 ms`.
pub(crate) fn time(nanos: f64) -> String {
    let units = [(1e3, 1.0, "ns"), (1e6, 1e3, "µs"), (1e9, 1e6, "ms"), (f64::INFINITY, 1e9, "s")];
    // The limits are a little low, so that 999.9 of a unit is not shown as 1000.
    let (_, unit, name) = units.into_iter().find(|(below, ..)| nanos < below * 0.9995).unwrap_or(units[3]);
    let value = nanos / unit;
    let digits = if name == "ns" || value >= 99.95 {
        0
    } else if value >= 9.995 {
        1
    } else {
        2
    };
    format!("{value:.digits$} {name}")
}

/// A whole number with commas between the thousands.
pub(crate) fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let groups: Vec<&str> = digits
        .as_bytes()
        .rchunks(3)
        .rev()
        .map(|group| std::str::from_utf8(group).unwrap_or_default())
        .collect();
    groups.join(",")
}

/// `1 query`, `2 queries`.
pub(crate) fn count(n: u64, one: &str, many: &str) -> String {
    format!("{} {}", grouped(n), if n == 1 { one } else { many })
}

/// How much more than 1 a ratio is, in percent with a sign: `+8.24 %`.
pub(crate) fn percent_over(ratio: f64, digits: usize) -> String {
    let percent = (ratio - 1.0) * 100.0;
    // Rounding noise below zero must not print a minus.
    let percent = if percent.abs() < 0.5 * 0.1_f64.powi(digits as i32) { 0.0 } else { percent };
    format!("{percent:+.digits$} %")
}

/// How much longer a length is than another by their ratio, in percent: `8.24 %`, `0.0120 %`.
pub(crate) fn excess(ratio: f64) -> String {
    let percent = (ratio - 1.0) * 100.0;
    let digits = if percent < 0.095 { 4 } else { 2 };
    format!("{percent:.digits$} %")
}

/// Text with its control characters escaped, since a file's name may hold codes that a terminal obeys.
pub(crate) fn printable(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for c in text.chars() {
        if c.is_control() { shown.extend(c.escape_default()) } else { shown.push(c) }
    }
    shown
}

/// To which side a column's texts are pushed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Align {
    Left,
    Right,
}

struct Row {
    /// Two characters for the left margin.
    lead: String,
    style: Style,
    cells: Vec<String>,
}

/// A table whose columns are as wide as what stands in them.
pub(crate) struct Table {
    heads: Vec<(&'static str, Align)>,
    rows: Vec<Row>,
}

impl Table {
    pub(crate) fn new(heads: impl Into<Vec<(&'static str, Align)>>) -> Self {
        Self { heads: heads.into(), rows: Vec::new() }
    }

    /// Adds a row; missing cells at its end are empty.
    pub(crate) fn row(&mut self, cells: impl Into<Vec<String>>) {
        self.row_with("  ".to_owned(), Style::new(), cells);
    }

    /// Adds a row in a style, with `lead` (two characters, painted as may be) in the left margin.
    pub(crate) fn row_with(&mut self, lead: String, style: Style, cells: impl Into<Vec<String>>) {
        self.rows.push(Row { lead, style, cells: cells.into() });
    }

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
        let head = line(&mut self.heads.iter().map(|&(head, _)| head));
        writeln!(screen, "  {}", screen.paint(BOLD, head))?;
        for Row { lead, style, cells } in &self.rows {
            let row = line(&mut cells.iter().map(String::as_str));
            writeln!(screen, "{lead}{}", screen.paint(*style, row))?;
        }
        Ok(())
    }
}

/// Words on as many lines as they need, each begun with `first` or as many spaces.
pub(crate) fn wrap(first: &str, words: impl IntoIterator<Item = String>, columns: usize) -> String {
    let indent = " ".repeat(first.chars().count());
    let (mut text, mut used, mut fresh) = (first.to_owned(), first.chars().count(), true);
    for word in words {
        let length = word.chars().count();
        if !fresh && used + 1 + length > columns {
            text += "\n";
            text += &indent;
            (used, fresh) = (indent.len(), true);
        }
        if !fresh {
            text += " ";
            used += 1;
        }
        text += &word;
        used += length;
        fresh = false;
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_three_digits_and_a_unit() {
        let shown = [0.0, 7.0, 999.0, 999.9, 1_234.0, 99_960.0, 999_600.0, 45_600_000.0, 9.99e9, 1.5e12];
        let shown: Vec<String> = shown.into_iter().map(time).collect();
        let expected = [
            "0 ns", "7 ns", "999 ns", "1.00 µs", "1.23 µs", "100 µs", "1.00 ms", "45.6 ms", "9.99 s",
            "1500 s",
        ];
        assert_eq!(shown, expected);
    }

    #[test]
    fn only_control_characters_are_escaped() {
        assert_eq!(printable("\u{1b}[31mé\r\n\u{9b}`\\'"), r"\u{1b}[31mé\r\n\u{9b}`\'");
    }

    #[test]
    fn thousands_are_grouped() {
        assert_eq!([0, 999, 1_000, 12_345_678].map(grouped), ["0", "999", "1,000", "12,345,678"]);
    }

    #[test]
    fn percentages_have_a_sign_and_no_negative_zero() {
        assert_eq!(percent_over(1.0824, 2), "+8.24 %");
        assert_eq!(percent_over(1.0 - 1e-12, 2), "+0.00 %");
        assert_eq!(percent_over(0.5, 1), "-50.0 %");
    }

    #[test]
    fn what_is_longer_by_little_has_more_digits() {
        assert_eq!([1.0824, 1.001, 1.00012, 12.5].map(excess), ["8.24 %", "0.10 %", "0.0120 %", "1150.00 %"]);
    }

    #[test]
    fn words_are_wrapped_and_indented() {
        let words = ["aa", "bb", "cc", "dddddddddd"].map(str::to_owned);
        assert_eq!(wrap("x: ", words, 8), "x: aa bb\n   cc\n   dddddddddd");
    }
}
