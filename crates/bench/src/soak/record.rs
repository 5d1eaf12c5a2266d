//! Measurements of a soak, as text and as a record.

use std::{fs, io, path::Path};

use mediant_report::{Column, Machine, Provenance, Record, Row, revision};

use super::{Kind, Options, Soak, SoakError, latency::Latencies};

const QUARTERS: [&str; 4] = ["quarter 1", "quarter 2", "quarter 3", "quarter 4"];

/// The values of an operation's row: column, value.
fn values(latencies: &Latencies) -> [(&'static str, Option<f64>); 4] {
    [
        ("p50", latencies.percentile(500)),
        ("p99", latencies.percentile(990)),
        ("p99.9", latencies.percentile(999)),
        ("max", (latencies.count() > 0).then(|| latencies.longest())),
    ]
}

/// Medians of memory, as text.
pub(super) fn by_quarter(quarters: &[f64; 4]) -> String {
    let texts = quarters.map(|bytes| format!("{:.3}", bytes / 1e6));
    format!("{} MB by quarter", texts.join(", "))
}

/// The allocated and the resident memory by quarter of the rounds.
fn memory(soak: &Soak) -> [Option<[f64; 4]>; 2] {
    [soak.quarters(|memory| Some(memory.allocated)), soak.quarters(|memory| memory.resident)]
}

/// Prints a table.
pub(super) fn print(soak: &Soak, out: &mut dyn io::Write) -> Result<(), SoakError> {
    writeln!(
        out,
        "{} rounds, {} edits, {} operations; all engines agree",
        soak.rounds,
        soak.edits,
        soak.log.count()
    )?;
    writeln!(out, "{:<9} {:>9} {:>9} {:>9} {:>9} {:>9}", "ms", "count", "p50", "p99", "p99.9", "max")?;
    for kind in Kind::ALL {
        let latencies = soak.log.of(kind);
        write!(out, "{:<9} {:>9}", kind.name(), latencies.count())?;
        for (_, value) in values(latencies) {
            write!(out, " {:>9}", value.map_or_else(String::new, |value| format!("{value:.3}")))?;
        }
        writeln!(out)?;
    }
    let [allocated, resident] = memory(soak);
    for (quarters, what) in [(allocated, "allocated"), (resident, "resident")] {
        let quarters =
            quarters.map_or_else(|| "is not told here".to_owned(), |quarters| by_quarter(&quarters));
        writeln!(out, "{what} memory after a round: {quarters}")?;
    }
    Ok(())
}

/// The record: rows of operations, then of memory.
fn record(root: &Path, options: &Options, soak: &Soak) -> Record {
    let mut rows: Vec<Row> = Kind::ALL
        .into_iter()
        .map(|kind| {
            let latencies = soak.log.of(kind);
            let row = Row::new().key("what", kind).with("count", latencies.count() as f64);
            values(latencies).into_iter().fold(row, |row, (column, value)| row.with(column, value))
        })
        .collect();
    let [allocated, resident] = memory(soak);
    rows.extend(QUARTERS.into_iter().enumerate().map(|(number, name)| {
        let of = |quarters: Option<[f64; 4]>| quarters.map(|quarters| quarters[number] / 1e6);
        Row::new().key("what", name).with("allocated", of(allocated)).with("resident", of(resident))
    }));
    let drawn = format!(
        "cargo xtask soak --minutes {} --seed {} --threads {} --side {}: {} rounds and {} edits",
        options.minutes, options.seed, options.threads, options.side, soak.rounds, soak.edits
    );
    Record {
        id: "soak".to_owned(),
        title: "All engines in one process: latencies by operation, and memory".to_owned(),
        provenance: Provenance {
            revision: revision(root),
            machine: Machine::here(),
            sets: Vec::new(),
            maps: soak.rounds as usize,
            instances: soak.log.count(),
            drawn,
            seed: Some(options.seed),
            quick: false,
            bundled: false,
            passes: Some(1),
        },
        columns: vec![
            Column::key("what", "the operation, or the quarter of the rounds"),
            Column::time("count", "", "operations; each answer was compared"),
            Column::time("p50", "ms", "latency that half of the operations do not exceed"),
            Column::time("p99", "ms", "latency that 99 % of the operations do not exceed"),
            Column::time("p99.9", "ms", "latency that 99.9 % of the operations do not exceed"),
            Column::time("max", "ms", "the longest latency"),
            Column::time("allocated", "MB", "median of the allocated memory after each round of the quarter"),
            Column::time("resident", "MB", "median of the resident memory after each round of the quarter"),
        ],
        rows,
    }
}

/// Writes the record.
pub(super) fn write(root: &Path, options: &Options, soak: &Soak) -> Result<(), SoakError> {
    let folder = root.join("docs").join("proof");
    fs::create_dir_all(&folder).map_err(SoakError::at(&folder))?;
    let path = folder.join("soak.json");
    fs::write(&path, record(root, options, soak).json()).map_err(SoakError::at(&path))
}
