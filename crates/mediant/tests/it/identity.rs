//! Whatever is prepared serves the map, the rules and the k that it was prepared for, and nothing else.

use mediant::{Change, Error, ErrorCode, Map, Motion, Origin, Rectangle, Setup, Space};
use mediant_grid::Rules;
use mediant_moves::K;

use super::{k, map};

/// Every motion of small k.
fn motions() -> impl Iterator<Item = Motion> {
    let ks = [2, 3, 4].map(|n| K::Finite(k(n))).into_iter().chain([K::Any]);
    ks.flat_map(|k| Rules::ALL.map(|rules| Motion::new(k, rules)))
}

/// A map of the same size with one other cell, and one that is larger.
fn other_maps() -> [Map; 2] {
    let one = Rectangle { x: 4, y: 2, width: 1, height: 1 };
    let larger = Map::from_fn(12, 7, |x, y| x == 5 && y < 6).expect("a map");
    [map().edit(one, |_, _| true).expect("a cell of the map"), larger]
}

fn space(map: &Map, motion: Motion) -> Option<Space> {
    map.space(motion).ok()
}

/// The error names both, and is the same wherever it comes from.
#[track_caller]
fn assert_mismatch<T>(refused: Result<T, Error>, ours: &Space, theirs: &Space, what: &str) {
    let Err(error) = refused else { panic!("{what}: accepted") };
    assert!(matches!(error, Error::Mismatch(_)), "{what}: {error:?}");
    assert_eq!(error.code(), ErrorCode::Mismatch, "{what}");
    let said = error.to_string();
    for identity in [ours.identity(), theirs.identity()] {
        assert!(said.contains(&identity.to_string()), "{what}: {said}");
    }
}

#[test]
fn saved_indexes_are_read_only_where_they_belong() {
    let (mut accepted, mut refused) = (0, 0);
    let spaces: Vec<Space> = [map()]
        .into_iter()
        .chain(other_maps())
        .flat_map(|map| motions().filter_map(move |motion| space(&map, motion)))
        .collect();
    for motion in motions() {
        let Some(ours) = space(&map(), motion) else { continue };
        for setup in Setup::all(motion).filter(|setup| setup.index_version().is_ok()) {
            let Ok(bytes) = setup.prepare(&ours).and_then(|index| index.to_bytes()) else {
                panic!("{setup}: no bytes")
            };
            for theirs in &spaces {
                let read = theirs.index_from_bytes(bytes.clone());
                if theirs.identity() == ours.identity() {
                    let index = read.unwrap_or_else(|error| panic!("{setup}: {error}"));
                    assert_eq!((index.identity(), index.origin()), (ours.identity(), Origin::Loaded));
                    accepted += 1;
                } else {
                    assert_mismatch(read, &ours, theirs, &format!("{setup} in {}", theirs.motion()));
                    refused += 1;
                }
            }
        }
    }
    assert!(accepted > 80 && refused > 4_000, "{accepted} accepted, {refused} refused");
}

#[test]
fn indexes_are_repaired_only_for_their_own_motion() {
    let mut refused = 0;
    for motion in motions() {
        let Some(ours) = space(&map(), motion) else { continue };
        for setup in Setup::all(motion) {
            let index = setup.prepare(&ours).unwrap_or_else(|error| panic!("{setup}: {error}"));
            for other in motions().filter(|&other| other != motion) {
                for map in [map()].into_iter().chain(other_maps()) {
                    let Some(theirs) = space(&map, other) else { continue };
                    let case = format!("{setup}, {other}");
                    assert_mismatch(Change::between(&ours, &theirs), &ours, &theirs, &case);
                    assert_mismatch(index.repair(&Change::new(&theirs)), &ours, &theirs, &case);
                    refused += 1;
                }
            }
            // A setup is for every map, but for one motion.
            for other in motions().filter(|&other| other != motion) {
                let Some(theirs) = space(&map(), other) else { continue };
                let Err(error) = setup.prepare(&theirs) else { panic!("{setup}, {other}: accepted") };
                assert_eq!(error.code(), ErrorCode::Mismatch, "{setup}, {other}: {error}");
            }
        }
    }
    assert!(refused > 10_000, "{refused} refused");
}

/// Identity is by content: maps made in different ways are one map if their cells are the same.
#[test]
fn equal_maps_share_their_indexes() {
    let motion = Motion::corners(K::ANY);
    let at = Rectangle { x: 0, y: 0, width: 3, height: 3 };
    let there = map().edit(at, |_, _| false).expect("cells of the map");
    let back = there.edit(at, |x, y| map().is_blocked((x, y))).expect("cells of the map");
    let index = map().space(motion).and_then(|space| space.prepare(mediant::Engine::Subgoal));
    let bytes = index.and_then(|index| index.to_bytes()).expect("an index");
    let read = |map: &Map| map.space(motion).and_then(|space| space.index_from_bytes(bytes.clone()));
    assert_eq!(back.id(), map().id());
    assert!(read(&back).is_ok() && read(&there).is_err());
}
