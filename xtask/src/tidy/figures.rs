//! Figures that somebody typed into the pages that promise figures from records.
//!
//! README and the page of performance have tables that `cargo xtask describe` draws. A figure beside them
//! would stay as it is when the next record comes.

use std::path::Path;

use super::finding::Finding;
use crate::tree::Tree;

const PAGES: [&str; 2] = ["README.md", "docs/performance.md"];
/// The words after a number that make it a figure of time, size or speed.
const UNITS: [&str; 20] = [
    "µs",
    "ms",
    "ns",
    "s",
    "seconds",
    "minutes",
    "microsecond",
    "microseconds",
    "millisecond",
    "milliseconds",
    "nanosecond",
    "nanoseconds",
    "kB",
    "MB",
    "GB",
    "bytes",
    "%",
    "percent",
    "times",
    "faster",
];

pub(super) fn check(tree: &Tree, findings: &mut Vec<Finding>) {
    for page in PAGES.map(Path::new) {
        let text = tree.bytes(page).and_then(|bytes| std::str::from_utf8(bytes).ok()).unwrap_or_default();
        for (line, figure) in typed(text) {
            let message =
                format!("`{figure}` is typed by hand: figures of this page are drawn from a record");
            findings.push(Finding { file: page.to_owned(), line, message });
        }
    }
}

/// The figures that stand neither in code nor between the marks of a drawn table, with their lines.
fn typed(text: &str) -> Vec<(usize, String)> {
    let (mut code, mut drawn) = (false, false);
    let mut found = Vec::new();
    for (number, line) in (1..).zip(text.lines()) {
        if line.contains("described: ") {
            drawn = !line.contains("described: end");
        } else if line.trim_start().starts_with("```") {
            code ^= true;
        } else if !code && !drawn {
            // Every second part between backticks is code.
            let prose: String = line.split('`').step_by(2).collect::<Vec<_>>().join("…");
            found.extend(in_line(&prose).map(|figure| (number, figure)));
        }
    }
    found
}

/// Numbers with a unit after them; in a row of a table, those with a decimal point too.
fn in_line(line: &str) -> impl Iterator<Item = String> {
    let is_row = line.starts_with('|');
    let words: Vec<&str> = line.split_whitespace().map(|word| word.trim_matches(is_around)).collect();
    let mut found = Vec::new();
    for (at, word) in
        words.iter().enumerate().filter(|(_, word)| word.starts_with(|c: char| c.is_ascii_digit()))
    {
        let unit = words.get(at + 1).filter(|next| UNITS.contains(next));
        if let Some(unit) = unit {
            found.push(format!("{word} {unit}"));
        } else if is_row && word.contains('.') {
            found.push((*word).to_owned());
        }
    }
    found.into_iter()
}

fn is_around(c: char) -> bool {
    c != '%' && !c.is_alphanumeric()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_found_where_they_are_typed() {
        let text = "# A\n\nA path takes 1.3 µs, not `5 ms`.\n\n<!-- described: speed -->\n| a | 0.47 |\n\
                    <!-- described: end -->\n\n```text\n9 MB\n```\n\nRust 1.88, k = 2 to 12; 18 maps.\n\
                    | a | **0.80** | 3 |\nIt is (2 times) as long, 5 % more.\n";
        let found = typed(text);
        let expected = [(3, "1.3 µs"), (14, "0.80"), (15, "2 times"), (15, "5 %")]
            .map(|(line, text)| (line, text.to_owned()));
        assert_eq!(found, expected);
    }

    #[test]
    fn pages_without_typed_figures_pass() {
        let mut findings = Vec::new();
        let page = |text: &str| Tree::new(vec![("README.md".into(), text.as_bytes().to_vec())]);
        check(&page("# A\n\nFast.\n"), &mut findings);
        assert!(findings.is_empty());
        check(&page("# A\n\nA path in 2 µs.\n"), &mut findings);
        assert_eq!(findings.len(), 1);
        assert_eq!(findings[0].line, 3);
    }
}
