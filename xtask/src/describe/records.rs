//! Tables of `docs/proof.md`, each from a record in `docs/proof`.

use std::path::Path;

use mediant_report::{Column, ColumnKind, Record, Row, Table, Value, number, thousands};

use super::{Region, wrapped};
use crate::tree::Tree;

/// The page.
pub(super) const PAGE: &str = "docs/proof.md";
/// The folder of its records.
const FOLDER: &str = "docs/proof";
/// The columns of a line of prose.
const WIDTH: usize = 110;

/// A region for each record: its name is that of the file.
///
/// # Errors
/// In words, the file that is no record.
pub(super) fn regions(tree: &Tree) -> Result<Vec<Region>, String> {
    let records = tree.texts(&["json"]).filter(|(path, _)| path.parent() == Some(Path::new(FOLDER)));
    let region = |(path, text): (&Path, &str)| {
        let record = Record::parse(text).map_err(|error| format!("{}: {error}", path.display()))?;
        let name = path.file_stem().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        Ok(Region { file: PAGE, name, text: drawn(&record) })
    };
    records.map(region).collect()
}

/// The table of a record, and below it where its numbers come from.
fn drawn(record: &Record) -> String {
    let names = record.columns.iter().take_while(|column| column.kind == ColumnKind::Key).count();
    let mut table = Table::new(record.columns.iter().map(heading)).names(names);
    for row in &record.rows {
        table.row(record.columns.iter().map(|column| cell(row, column)));
    }
    format!("\n{}\n{}\n\n", table.markdown(), source(record))
}

/// Where the numbers of a record come from, in lines of prose.
pub(super) fn source(record: &Record) -> String {
    let provenance = &record.provenance;
    let machine = provenance.machine.cpu.as_deref().unwrap_or("a processor without a name");
    let revision = provenance.revision.get(..12).unwrap_or(&provenance.revision);
    let drawn = provenance.drawn.trim_end_matches('.');
    let source = format!("*{}: {drawn}. Revision {revision}, on {machine}.*", record.title);
    wrapped(&source, WIDTH).join("\n")
}

fn heading(column: &Column) -> String {
    if column.unit.is_empty() { column.name.clone() } else { format!("{}, {}", column.name, column.unit) }
}

/// Whole numbers in full, since they are counts; others in three digits.
fn cell(row: &Row, column: &Column) -> String {
    match row.values().find(|(name, _)| *name == column.name) {
        Some((_, Value::Text(text))) => text.clone(),
        Some((_, &Value::Number(value))) if value.fract() == 0.0 => thousands(value),
        Some((_, &Value::Number(value))) => number(value),
        None => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use mediant_report::Provenance;

    use super::*;

    fn record() -> Record {
        Record {
            id: "soak".to_owned(),
            title: "Operations".to_owned(),
            provenance: Provenance {
                revision: "abc".to_owned(),
                drawn: "By seed.".to_owned(),
                ..Provenance::default()
            },
            columns: vec![
                Column::key("operation", "its name"),
                Column::count("count", "", "how many"),
                Column::time("p99", "µs", "the time"),
            ],
            rows: vec![
                Row::new().key("operation", "edit").with("count", 12_345.0).with("p99", 1.25),
                Row::new().key("operation", "save").with("count", 7.0),
            ],
        }
    }

    #[test]
    fn a_table_and_its_source() {
        assert_eq!(
            drawn(&record()),
            "\n| operation | count | p99, µs |\n|---|--:|--:|\n| edit | 12,345 | 1.25 |\n| save | 7 |  |\n\n\
             *Operations: By seed. Revision abc, on a processor without a name.*\n\n"
        );
    }

    #[test]
    fn only_records_have_regions() {
        let file = |path: &str, text: &str| (path.into(), text.as_bytes().to_vec());
        let tree = |files| regions(&Tree::new(files));
        let found = tree(vec![file("docs/proof/soak.json", &record().json()), file("docs/other.json", "{}")]);
        assert_eq!(
            found.map(|found| found.iter().map(|region| region.name.clone()).collect()),
            Ok(vec!["soak".to_owned()])
        );
        let wrong = tree(vec![file("docs/proof/soak.json", "{}")]);
        assert!(wrong.is_err_and(|wrong| wrong.starts_with("docs/proof/soak.json: ")));
    }
}
