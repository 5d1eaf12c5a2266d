//! The study of maps that change: the page is that of the record, and the library's choice that of the study.

use mediant_bench::compare::changes::{MOST, PATHS, cases, drawn};

use crate::pages::{is_drawn, record};

/// Where a look at the map does not tell the best engine: map, motion, and paths between two edits.
const EXCEPTIONS: &[(&str, &str, u64)] = &[
    ("brc202d", "3:open", 1),
    ("brc202d", "3:open", 100),
    ("icecrown", "3:open", 1),
    ("icecrown", "3:open", 10_000),
];
/// The most that the choice takes there, over the best engine.
const MOST_OF_EXCEPTIONS: f64 = 2.0;

#[test]
fn the_page_is_drawn_from_the_record() {
    is_drawn("changes", &drawn(&record("changes")));
}

/// On each map, for each motion and each number of paths between two edits.
#[test]
fn the_recommended_engine_is_nearly_the_best() {
    let record = record("changes");
    let cases = cases(&record);
    assert!(cases.len() > 50, "{}", cases.len());
    let mut wrong = Vec::new();
    for (case, paths) in cases.iter().flat_map(|case| PATHS.map(|paths| (case, paths))) {
        let (best, least) = case.best(paths).expect("engines");
        let (taken, time) = case.taken(paths).expect("an engine of the study");
        let is_exception = EXCEPTIONS.contains(&(case.map, case.motion, paths));
        let ratio = time / least;
        // One that is not needed is wrong as well, so that the list only shrinks.
        if is_exception != (ratio > MOST) || ratio > MOST_OF_EXCEPTIONS {
            wrong.push(format!(
                "({:?}, {:?}, {paths}), // {taken} {ratio:.2} × {best}",
                case.map, case.motion
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
