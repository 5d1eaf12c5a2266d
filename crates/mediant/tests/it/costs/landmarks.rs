//! Landmarks: the saved index on costs of cells and on maps without, its options, and damaged bytes.

use std::num::NonZeroU32;

use mediant::{
    Change, Engine, Error, ErrorCode, K, Map, Motion, Origin, Rules, Space,
    options::{ConfiguredEngine, EngineOption, LandmarkOptions, OptionValue},
};
use mediant_oracle::{Rng, random_weighted, seeds, suite_grid};

use super::{World, k, plain_space, space};

fn landmarks(count: u32) -> ConfiguredEngine {
    ConfiguredEngine::Landmarks(LandmarkOptions { landmarks: NonZeroU32::new(count) })
}

/// The number of landmarks that an index says that it has.
fn said(index: &mediant::Index) -> Option<OptionValue> {
    index.value(EngineOption::ALL.into_iter().find(|option| option.name == "landmarks")?)
}

#[test]
fn options_decide_how_many_there_are() {
    for space in [space(), plain_space()] {
        let mut bytes = 0;
        for (count, made) in [(1, 4), (4, 4), (5, 8), (8, 8), (9, 16), (16, 16)] {
            let index = space.prepare(landmarks(count)).expect("so many can be");
            assert_eq!(said(&index), NonZeroU32::new(made).map(OptionValue::Number));
            assert!(index.memory_bytes() >= bytes);
            bytes = index.memory_bytes();
            assert_eq!(
                index.clone().with_options(landmarks(made)).map(|index| said(&index)).ok(),
                Some(said(&index))
            );
            let other = index.clone().with_options(landmarks(made % 16 + 1)).expect_err("others");
            assert!(matches!(other, Error::LandmarkCount { found, .. } if found == made), "{other}");
            assert_eq!(other.code(), ErrorCode::IndexOptions);
            // The number stays, if it is left out.
            let same = index.with_options(Engine::Landmarks).expect("no number is named");
            assert_eq!(same.setup().engine, landmarks(made));
        }
        for count in [17, u32::MAX] {
            assert_eq!(space.prepare(landmarks(count)).unwrap_err().code(), ErrorCode::EngineOption);
        }
        let error =
            space.prepare(Engine::AStar).and_then(|index| index.with_options(landmarks(8))).unwrap_err();
        assert_eq!(error.code(), ErrorCode::EngineOption);
    }
    assert!(Map::new(3, 3).and_then(|map| map.space(Motion::centers(k(9)))?.prepare(landmarks(4))).is_err());
    assert!(
        Map::new(3, 3).and_then(|map| map.space(Motion::corners(K::ANY))?.prepare(landmarks(4))).is_err()
    );
}

#[test]
fn a_saved_index_belongs_to_its_costs() {
    let space = space();
    let index = space.prepare(Engine::Landmarks).expect("an index");
    let bytes = index.to_bytes().expect("it is saved");
    let read = space.index_from_bytes(bytes.clone()).expect("its bytes");
    assert_eq!((read.origin(), read.to_bytes().ok()), (Origin::Loaded, Some(bytes.clone())));
    assert_eq!(read.setup().engine, landmarks(8));
    let query = [(0, 0), (3, 2)];
    assert_eq!(read.planner().find_counted(query), index.planner().find_counted(query));
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("index");
    index.save(&file).expect("room");
    assert!(space.load(&file).is_ok() && space.load_for(landmarks(8), &file).is_ok());
    let other = space.load_for(landmarks(16), &file).expect_err("it has 8");
    assert_eq!(other.code(), ErrorCode::IndexOptions);
    // Neither the map without costs, nor other costs, k or rules.
    let plain = plain_space();
    let edited = space.edit_costs([((0, 0), Some(2.0))]).expect("a cost").after().clone();
    let finer = Space::clone(index.for_k(K::N16).expect("k = 4").space());
    for other in [&plain, &edited, &finer] {
        let error = other.index_from_bytes(bytes.clone()).expect_err("of other costs");
        assert_eq!(error.code(), ErrorCode::Mismatch, "{error}");
    }
    assert_eq!(space.map().index_from_bytes(bytes).unwrap_err().code(), ErrorCode::Mismatch);
    let of_plain = plain.prepare(Engine::Landmarks).and_then(|index| index.to_bytes()).expect("an index");
    assert!(plain.map().index_from_bytes(of_plain.clone()).is_ok());
    assert_eq!(space.index_from_bytes(of_plain).unwrap_err().code(), ErrorCode::Mismatch);
    // From costs to none it is prepared anew.
    let change = Change::between(&space, &plain).expect("the same motion");
    let lengths = index.repair(&change).expect("landmarks know both");
    assert_eq!(lengths.origin(), Origin::Prepared);
    assert_eq!(lengths.planner().distance(query), plain.planner(Engine::AStar).expect("A*").distance(query));
}

/// Every byte of a file, damaged, is an error. Beyond the file's checksum, bytes of the landmarks that were
/// changed on purpose are refused, or are landmarks that find the same costs.
#[test]
fn damaged_bytes_are_errors() {
    for space in [space(), plain_space()] {
        let index = space.prepare(landmarks(4)).expect("an index");
        let bytes = index.to_bytes().expect("it is saved");
        for at in 0..bytes.len() {
            let mut damaged = bytes.clone();
            damaged[at] ^= 1 << (at % 8);
            assert!(space.index_from_bytes(damaged).is_err(), "byte {at}");
            assert!(space.index_from_bytes(bytes[..at].to_vec()).is_err(), "{at} bytes");
        }
    }
}

/// A repaired index can be saved, is read again, and finds the costs of a new one: with costs and without.
#[test]
fn repaired_landmarks_find_the_costs_of_new_ones() {
    let (mut repaired, mut compared) = (0, 0);
    for seed in seeds(40) {
        let (rules, k) = (Rules::ALL[(seed % 5) as usize], k(2 + ((seed / 5) % 7) as u32));
        let motion = Motion::new(k, rules);
        let mut rng = Rng::new(seed);
        let mut space = match seed % 2 {
            0 => Map::from(suite_grid(seed).0).space(motion).expect("a small k"),
            _ => World::of(random_weighted(seed).0, rules, k, "").space,
        };
        let mut index = space.prepare(Engine::Landmarks).expect("an index");
        let mut planner = index.planner();
        for edit in 0..4 {
            let about = format!("seed {seed}, edit {edit}, {motion}");
            let (width, height) = (space.map().width(), space.map().height());
            let mut cell = || (rng.below(width) as i32, rng.below(height) as i32);
            let cells: Vec<_> = (0..3).map(|_| cell()).collect();
            let change = match space.costs().map(|costs| costs.bounds().0) {
                Some(least) => space.edit_costs(cells.iter().map(|&at| (at, Some(least)))),
                None => {
                    let flipped = cells.iter().map(|&at| (at, space.map().is_free(at)));
                    space.edit_cells(flipped.collect::<Vec<_>>())
                }
            };
            let change = change.unwrap_or_else(|error| panic!("{error}: {about}"));
            index = index.repair(&change).unwrap_or_else(|error| panic!("{error}: {about}"));
            repaired += usize::from(index.origin() == Origin::Repaired);
            planner.follow(&index).expect("the same engine");
            space = change.after().clone();
            let bytes = index.to_bytes().expect("it is saved");
            let mut read =
                space.index_from_bytes(bytes).unwrap_or_else(|error| panic!("{error}: {about}")).planner();
            let mut other = space.planner(Engine::AStar).expect("it knows costs");
            for _ in 0..6 {
                let query = [cell(), cell()];
                let found = planner.distance(query);
                assert_eq!(found, other.distance(query), "{query:?}: {about}");
                assert_eq!(found, read.distance(query), "{query:?}: {about}");
                compared += usize::from(matches!(found, Ok(Some(_))));
            }
        }
    }
    assert!(repaired > 60 && compared > 150, "{repaired} repaired, {compared} compared");
}
