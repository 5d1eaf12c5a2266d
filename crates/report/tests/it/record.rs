//! Records: what comes back from JSON, what is found in them, and how two are compared.

use mediant_report::{Column, Provenance, Record, RecordError, Row};

fn record() -> Record {
    let row = |k, cost: f64, micros| Row::new().key("k", k).with("cost", cost).with("micros", micros);
    Record {
        id: "sample".to_owned(),
        title: "A sample \"quoted\"".to_owned(),
        provenance: Provenance { revision: "abc".to_owned(), instances: 2, ..Provenance::default() },
        columns: vec![
            Column::key("k", "the neighborhood"),
            Column::count("cost", "cells", "mean length"),
            Column::time("micros", "µs", "mean time"),
        ],
        rows: vec![row(2, 804.25, Some(1.5)), row(3, 668.0, None), row(3, f64::NAN, Some(3.0))],
    }
}

#[test]
fn json_comes_back() {
    let record = record();
    let text = record.json();
    assert_eq!(Record::parse(&text).unwrap(), record);
    assert!(text.contains("{\"cost\":668,\"k\":\"3\"}") && text.contains("804.25"), "{text}");
    assert_eq!(record.rows[2].number("cost"), None);
    assert!(matches!(Record::parse("{"), Err(RecordError::Form(_))));
    let misplaced = text.replace("\"cost\":668", "\"cost\":\"668\"");
    let error = Record::parse(&misplaced).unwrap_err().to_string();
    assert!(error.contains("row 1: column `cost`"), "{error}");
    assert!(Record::parse(&text.replace("\"cost\":668", "\"price\":668")).is_err());
}

#[test]
fn rows_are_found_by_their_keys() {
    let record = record();
    assert_eq!(record.number(&[("k", "3")], "cost"), Some(668.0));
    assert_eq!(record.number(&[("k", "4")], "cost"), None);
    assert_eq!(record.select(&[("k", "3")]).count(), 2);
    assert_eq!(record.distinct("k"), ["2", "3"]);
}

#[test]
fn counts_differ_and_times_do_not() {
    let (ours, mut theirs) = (record(), record());
    theirs.rows[0] = Row::new().key("k", 2).with("cost", 804.25).with("micros", 99.0);
    theirs.provenance.revision = "def".to_owned();
    theirs.provenance.machine.cpu = Some("another".to_owned());
    assert_eq!(ours.differences(&theirs, 0.0), []);
    theirs.rows[0] = Row::new().key("k", 2).with("cost", 804.26);
    let found = ours.differences(&theirs, 1e-9);
    assert_eq!(found.len(), 1);
    assert!(found[0].to_string().contains("row 0, cost"), "{}", found[0]);
    assert_eq!(ours.differences(&theirs, 1e-3), []);
    theirs.rows[1] = Row::new().key("k", 3);
    assert_eq!(ours.differences(&theirs, 1e-3).len(), 1);
    theirs.rows.pop();
    theirs.provenance.instances = 3;
    assert_eq!(ours.differences(&theirs, 1e-3).len(), 3);
}
