//! Scenarios, of maps that stay and of maps that change.

use mediant_formats::{DynamicEvent, DynamicScenario, Optimal, Patch, Scenario};

use crate::bytes::halves;

/// The most cells of a map on which patches are placed.
const MOST: u64 = 1 << 16;

/// A scenario; or, with a zero between them, patches and a scenario of a map that changes.
pub(crate) fn run(data: &[u8]) {
    let (first, second) = halves(data);
    still(first);
    let Ok(patches) = Patch::parse_all(first) else { return };
    for patch in &patches {
        assert!(patch.rows().all(|row| row.len() == patch.width() as usize));
        assert_eq!(patch.rows().len(), patch.height() as usize);
    }
    let Ok(scenario) = DynamicScenario::parse(second, &patches) else { return };
    assert!(DynamicScenario::is_one(second) && DynamicScenario::patch_file(second).is_ok());
    if u64::from(scenario.width()) * u64::from(scenario.height()) > MOST {
        return;
    }
    let mut grid = scenario.grid();
    for event in scenario.events() {
        match event {
            DynamicEvent::Patch(placed) => {
                let at = placed.rectangle();
                grid = grid.with_rectangle(at, |x, y| placed.is_blocked(x, y));
                let corner = (at.x as i32, at.y as i32);
                assert_eq!(grid.is_blocked(corner.0, corner.1), placed.is_blocked(at.x, at.y));
            }
            DynamicEvent::Query(query) => {
                assert!(!matches!(query.optimal, Optimal::Length(length) if length.is_nan()));
            }
        }
    }
}

fn still(text: &[u8]) {
    let Ok(scenario) = Scenario::parse(text) else { return };
    assert_eq!(scenario.as_bytes(), text);
    if let Ok(written) = Scenario::from_instances(scenario.instances().to_vec()) {
        let again = Scenario::parse(written.as_bytes()).expect("a scenario that was written");
        assert_eq!(again.instances(), scenario.instances());
    }
}
