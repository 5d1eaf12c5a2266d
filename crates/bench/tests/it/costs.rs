//! The study of cost surfaces: the page is that of its records, and these say that the costs are right.

use mediant_bench::compare::costs::drawn;

use crate::pages::{is_drawn, record};

#[test]
fn the_page_is_drawn_from_the_records() {
    is_drawn("costs", &drawn(&record("costs"), Some(&record("costs-elsewhere"))));
}

/// Six surfaces, each beside three programs.
#[test]
fn costs_are_those_of_other_programs() {
    let record = record("costs-elsewhere");
    let rows: Vec<_> = record.select(&[("part", "agreement")]).collect();
    assert_eq!(rows.len(), 18);
    for row in rows {
        assert_eq!(row.number("same"), Some(1.0), "{}", row.text("surface"));
        assert!(row.number("differs").is_some_and(|most| most < 1e-9), "{}", row.text("surface"));
    }
}

/// The more moves, the cheaper the paths, on each surface.
#[test]
fn costs_fall_with_k() {
    let record = record("costs");
    let rows: Vec<_> = record.select(&[("part", "worth")]).collect();
    assert!(rows.len() >= 42, "{}", rows.len());
    for pair in rows.windows(2).filter(|pair| pair[0].text("surface") == pair[1].text("surface")) {
        let [less, more] = [pair[0].number("mean"), pair[1].number("mean")];
        assert!(more.is_some() && more <= less, "{} k = {}", pair[1].text("surface"), pair[1].text("k"));
    }
}
