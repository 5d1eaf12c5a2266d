//! The pages of studies are those of their records.

use std::fs;

use mediant_report::Record;
use mediant_sets::root;

/// The record of this name in `docs/results/data`.
pub(crate) fn record(name: &str) -> Record {
    let text = fs::read_to_string(root().join(format!("docs/results/data/{name}.json"))).expect("a record");
    Record::parse(&text).expect("a record")
}

/// Asserts that the files of a study, each with its place in `docs/results`, are those in the project.
pub(crate) fn is_drawn(study: &str, files: &[(String, String)]) {
    assert!(files.len() > 1, "a page and its charts");
    for (place, text) in files {
        let committed = fs::read_to_string(root().join("docs/results").join(place)).expect("a file");
        assert!(committed == *text, "{place}: run `cargo xtask compare --{study} --render`");
    }
}
