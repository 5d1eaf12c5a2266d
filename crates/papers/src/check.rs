//! Comparison of counts with those of an earlier run.

use std::{fs, path::Path};

use mediant_report::Record;

use crate::{Error, catalog::EXPERIMENTS, records::write};

/// The largest relative difference of equal counts: they are the same everywhere, but were written as text in
/// between.
const TOLERANCE: f64 = 1e-9;

/// Writes the counts that `--check` compares with. The counts of experiments that were not run stay.
pub(crate) fn bless(path: &Path, records: &[Record]) -> Result<(), Error> {
    let mut known = if path.is_file() { blessed(path)? } else { Vec::new() };
    known.retain(|old| !records.iter().any(|new| new.id == old.id));
    known.extend(records.iter().map(Record::counts));
    known.sort_by_key(|record| EXPERIMENTS.iter().position(|experiment| experiment.id == record.id));
    let texts: Vec<String> = known.iter().map(Record::json).collect();
    write(path, &format!("[\n{}]\n", texts.join(",\n")))
}

fn blessed(path: &Path) -> Result<Vec<Record>, Error> {
    let text = fs::read_to_string(path).map_err(Error::at(path))?;
    serde_json::from_str(&text).map_err(|wrong| Error::Reproduce(format!("{}: {wrong}", path.display())))
}

/// Compares the counts of the records with those that [`bless`] wrote, and prints their number if all agree.
pub(crate) fn check(path: &Path, records: &[Record]) -> Result<(), Error> {
    let known = blessed(path)?;
    let mut numbers = 0;
    let mut differences = Vec::new();
    for record in records {
        match known.iter().find(|known| known.id == record.id) {
            None => differences.push(format!("{}: not in {}", record.id, path.display())),
            Some(known) => {
                differences.extend(record.differences(known, TOLERANCE).iter().map(ToString::to_string));
            }
        }
        numbers += record.counts().rows.iter().map(|row| row.values().count()).sum::<usize>();
    }
    if differences.is_empty() {
        println!("{numbers} numbers of {} experiments are those of the last run", records.len());
        return Ok(());
    }
    let shown = differences.iter().take(20).map(|difference| format!("\n  {difference}")).collect::<String>();
    Err(Error::Reproduce(format!(
        "{} numbers are not those of {}:{shown}\n--bless writes the new ones, once it is known why",
        differences.len(),
        path.display()
    )))
}
