//! Maps that change: whatever was prepared follows a chain of edits, and answers as if it were made anew.

use mediant::{
    Answer, Change, Ends, Engine, Guarantee, Index, K, Map, Motion, Origin, PlacementKind, Planner,
    Rectangle, Rules, Setup, Space,
};
use mediant_grid::{Change as GridChange, Grid};
use mediant_oracle::{Explicit, Rng, caves, on_all_cores, random_change, random_vertex, seeds, suite_grid};

use super::map;

/// In which sense a repaired index equals a new one: the table of the crate doc.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Sense {
    /// Saved, it has the same bytes.
    Bytes,
    /// Its paths are the same.
    Path,
    /// Its paths are as long.
    Cost,
}

fn sense(engine: Engine) -> Sense {
    match engine {
        Engine::Hpa | Engine::Chpa => Sense::Bytes,
        Engine::JpsBlock | Engine::JpsPlus | Engine::Anya | Engine::Subgoal | Engine::Landmarks => {
            Sense::Cost
        }
        _ => Sense::Path,
    }
}

/// Every engine with a motion of this number that it takes.
fn setups(number: u64) -> Vec<Setup> {
    let rules = Rules::ALL[number as usize % Rules::ALL.len()];
    let ks = [K::N8, K::N4, K::N16, K::ANY, K::N32, K::N64, K::N8, K::new(7).expect("a k")];
    let k = ks[number as usize / Rules::ALL.len() % ks.len()];
    let motion = Motion::new(k, rules);
    Engine::ALL
        .into_iter()
        .map(|engine| Setup::new(engine, motion))
        .filter(|setup| setup.check().is_ok())
        .collect()
}

/// Checks that an index that was repaired, and the planner that follows it, answer as a new index.
fn check_same(one: &mut Planner, new: &Index, queries: &[Ends], message: &str) {
    let repaired = one.index();
    let sense = sense(new.setup().engine.kind());
    if sense == Sense::Bytes {
        let [repaired, new] = [repaired, new].map(|index| index.to_bytes().expect("it is saved"));
        assert!(repaired == new, "{message}: other bytes");
    }
    let space = new.space();
    let mut other = new.planner();
    for &query in queries {
        let message = format!("{message}, {} to {}", query.start, query.goal);
        match (one.find(query), other.find(query)) {
            (Ok(Answer::Found(path)), Ok(Answer::Found(expected))) => {
                assert_eq!(space.check(&path), Ok(()), "{message}: {path}");
                if sense == Sense::Cost {
                    assert!((path.cost() - expected.cost()).abs() < 1e-6, "{message}: {path}, {expected}");
                } else {
                    assert_eq!(path, expected, "{message}");
                }
            }
            (found, expected) => assert_eq!(found, expected, "{message}"),
        }
    }
}

/// Checks that a planner that followed edits finds shortest paths, by an oracle that knows the map alone;
/// returns the number of queries.
fn check_shortest(planner: &mut Planner, space: &Space, queries: &[Ends], message: &str) -> usize {
    let (grid, motion) = (space.map().grid(), space.motion());
    let is_small = grid.width() * grid.height() <= 600;
    let guarantee = planner.index().setup().guarantee();
    if !is_small || !matches!(guarantee, Guarantee::Optimal(_) | Guarantee::OptimalAnyAngle) {
        return 0;
    }
    let oracle = Explicit::new(grid, motion.rules, motion.k.finite());
    for &query in queries {
        let expected = oracle.costs_from(query.start).to(query.goal);
        let found = planner.find(query).ok().and_then(|answer| answer.into_path()).map(|path| path.cost());
        let same = match (found, expected) {
            (Some(found), Some(expected)) => (found - expected).abs() < 1e-6,
            (found, expected) => found == expected,
        };
        assert!(same, "{message}, {} to {}: {found:?}, not {expected:?}", query.start, query.goal);
    }
    queries.len()
}

#[test]
fn every_index_follows_a_chain_of_edits() {
    let of_oracle = on_all_cores(seeds(40), |seed| {
        let mut of_oracle = 0;
        let mut rng = Rng::new(seed);
        let map = Map::from(suite_grid(seed).0);
        for setup in setups(seed) {
            let mut space = setup.space(&map).expect("it is searched");
            let mut index = setup.prepare(&space).expect("a small map");
            let (first, mut planner) = ((space.clone(), index.clone()), index.planner());
            for step in 0..20 {
                let change = random_change(&mut rng, space.map().grid());
                let message = format!("seed {seed}, {setup}, edit {step}: {:?}", change.cells());
                let change = space.edit_cells(cells(&change)).expect("they are on the map");
                index = index.repair(&change).unwrap_or_else(|error| panic!("{message}: {error}"));
                space = change.after().clone();
                let new =
                    setup.prepare(&setup.space(space.map()).expect("it is searched")).expect("a small map");
                planner.follow(&index).unwrap_or_else(|error| panic!("{message}: {error}"));
                let queries = queries(&mut rng, &space);
                check_same(&mut planner, &new, &queries, &message);
                if step == 19 {
                    of_oracle += check_shortest(&mut planner, &space, &queries, &message);
                }
                if rng.below(6) == 0 {
                    index = index.finish().unwrap_or_else(|error| panic!("{message}: {error}"));
                    assert!(index.is_finished(), "{message}");
                }
            }
            // The first version is held all the time, and still answers for its own map.
            let new = setup.prepare(&first.0).expect("a small map");
            planner.follow(&first.1).unwrap_or_else(|error| panic!("seed {seed}, {setup}: {error}"));
            let message = format!("seed {seed}, {setup}, the first");
            check_same(&mut planner, &new, &queries(&mut rng, &first.0), &message);
        }
        of_oracle
    });
    let of_oracle: usize = of_oracle.into_iter().sum();
    assert!(of_oracle > 500, "{of_oracle} queries of the oracle");
}

fn queries(rng: &mut Rng, space: &Space) -> Vec<Ends> {
    let kind = space.motion().rules.placement();
    let mut at = || random_vertex(rng, space.map().grid(), kind);
    (0..5).map(|_| Ends::new(at(), at())).collect()
}

/// The cells of a change, and whether they are blocked after it.
fn cells(change: &GridChange) -> impl Iterator<Item = ((i32, i32), bool)> {
    let all = change.cells().iter().flat_map(|at| {
        (at.y..at.y + at.height).flat_map(|y| (at.x..at.x + at.width).map(move |x| (x as i32, y as i32)))
    });
    all.map(|(x, y)| ((x, y), change.after().is_blocked(x, y)))
}

/// Paths on edited maps, with nothing prepared by name.
#[test]
fn paths_on_edited_maps_are_those_of_new_maps() {
    on_all_cores(seeds(60), |seed| {
        let mut rng = Rng::new(seed);
        let mut map = Map::from(suite_grid(seed).0);
        for step in 0..20 {
            let change = random_change(&mut rng, map.grid());
            map = map.edit_cells(cells(&change)).expect("they are on the map");
            // Now and then there are several edits between two paths.
            if rng.below(3) == 0 {
                continue;
            }
            let new = Map::from(Grid::clone(map.grid()));
            for _ in 0..3 {
                let [start, goal] =
                    [(); 2].map(|()| random_vertex(&mut rng, map.grid(), PlacementKind::Center));
                let [one, other] = [&map, &new].map(|map| {
                    map.path(start, goal)
                        .map(|path| path.map(|path| path.cost()))
                        .map_err(|error| error.to_string())
                });
                let same = match (&one, &other) {
                    (Ok(Some(one)), Ok(Some(other))) => (one - other).abs() < 1e-6,
                    (one, other) => one == other,
                };
                assert!(same, "seed {seed}, edit {step}, {start} to {goal}: {one:?}, {other:?}");
            }
        }
    });
}

/// Random edits by seed, each engine's index along them: a repaired index answers as one made anew, is as
/// large, and says how it came about. That of Anya may leave out less, JPS+ has room for more, subgoals are
/// those of the map before, and landmarks know less, but paths cost the same. That of Sub-Theta\* is made
/// anew once, with a record.
#[test]
fn repaired_indexes_are_as_good_as_new_ones() {
    let (mut rng, mut repaired) = (Rng::new(16), 0);
    for motion in
        [Motion::centers(K::N8), Motion::centers(K::N4), Motion::corners(K::N16), Motion::corners(K::ANY)]
    {
        let mut space = Map::from(caves(&mut rng, 50, 40)).space(motion).expect("a space");
        let mut indexes: Vec<_> = Setup::all(motion)
            .map(|setup| setup.prepare(&space).unwrap_or_else(|error| panic!("{setup}: {error}")))
            .collect();
        let mut recorded = Vec::new();
        for edit in 0..3 {
            let mut side = |length| rng.below(length);
            let at = Rectangle { x: side(50), y: side(40), width: side(20), height: side(9) };
            let before = space.clone();
            let mut change =
                before.edit(at, |x, y| (x * 7 + y * 3 + edit) % 5 == 0).expect("cells of the map");
            // One cell far away, and then what is found by comparing the maps.
            if edit > 0 {
                change = change.edit_cells([((0, 0), edit == 1)]).expect("a cell of the map");
            }
            space = change.after().clone();
            if edit == 2 {
                change = Change::between(&before, &space).expect("the same motion");
            }
            for index in &mut indexes {
                let (setup, is_same) = (index.setup(), index.identity() == space.identity());
                *index = index.repair(&change).unwrap_or_else(|error| panic!("{setup}: {error}"));
                let anew = setup.prepare(&space).expect("as before");
                let kind = setup.engine.kind();
                let has_landmarks = kind == Engine::Landmarks;
                let costs_alone =
                    has_landmarks || matches!(kind, Engine::Anya | Engine::JpsPlus | Engine::Subgoal);
                let is_recorded = recorded.contains(&setup);
                let has_record = kind == Engine::SubgoalTheta;
                let origin = match is_same {
                    true => Origin::Unchanged,
                    false if has_record && !is_recorded => Origin::Prepared,
                    // These are made anew if much has changed.
                    false if has_landmarks || has_record => index.origin(),
                    false => Origin::Repaired,
                };
                assert!(is_same || origin != Origin::Unchanged, "{setup}, edit {edit}");
                repaired += usize::from(has_record && origin == Origin::Repaired);
                if has_record && !is_same && !is_recorded {
                    recorded.push(setup);
                }
                let same = index.repair(&Change::new(index.space())).expect("the same space");
                assert_eq!((same.origin(), same.to_bytes().ok()), (Origin::Unchanged, index.to_bytes().ok()));
                assert_eq!((index.setup(), index.origin()), (setup, origin));
                assert_eq!(index.identity(), space.identity());
                let is_larger = recorded.contains(&setup);
                let is_as_large = (index.memory_bytes() == anew.memory_bytes()) != is_larger;
                assert!(costs_alone || is_as_large, "{setup}, edit {edit}");
                check_bytes(index, &anew, costs_alone);
                // Numbers of its own: so the edits do not depend on how many setups there are.
                check_alike(index, &anew, costs_alone, &mut Rng::new(u64::from(edit)));
            }
        }
        // A map of another size shares nothing with the last one.
        let other = map().space(motion).expect("a space");
        for index in indexes {
            let change = Change::between(index.space(), &other).expect("the same motion");
            let index = index.repair(&change).expect("its map");
            assert_eq!((index.origin(), index.identity()), (Origin::Prepared, other.identity()));
        }
    }
    assert!(repaired > 0, "none was repaired by its record");
}

/// Checks that an index is saved as one made anew; of landmarks, that it is read as it was saved.
fn check_bytes(index: &Index, anew: &Index, costs_alone: bool) {
    let (setup, bytes, expected) = (index.setup(), index.to_bytes().ok(), anew.to_bytes().ok());
    let Some(bytes) = bytes.clone().filter(|_| costs_alone) else {
        return assert_eq!(bytes, expected, "{setup}");
    };
    let read = index.space().index_from_bytes(bytes.clone()).expect("its bytes").to_bytes().ok();
    let has_landmarks = setup.engine.kind() == Engine::Landmarks;
    assert_eq!(read, if has_landmarks { Some(bytes) } else { expected }, "{setup}");
}

/// Checks that two indexes of a map of 50 × 40 cells answer alike, by the same counts or by costs alone.
fn check_alike(index: &Index, anew: &Index, costs_alone: bool, rng: &mut Rng) {
    let (setup, mut repaired, mut new) = (index.setup(), index.planner(), anew.planner());
    for _ in 0..8 {
        let mut end = || (rng.below(50) as i32, rng.below(40) as i32);
        let query = Ends::new(end(), end());
        if !costs_alone {
            assert_eq!(repaired.find_counted(query), new.find_counted(query), "{setup}, {query:?}");
            continue;
        }
        let [found, known] = [&mut repaired, &mut new]
            .map(|planner| planner.find(query).map(|answer| answer.cost().unwrap_or(-1.0)));
        let is_same = match (&found, &known) {
            // Of equally short paths one may become shorter when it is smoothed.
            (Ok(_), Ok(_)) if setup.smoothing.is_some() => true,
            (Ok(found), Ok(known)) => (found - known).abs() < 1e-9 * (1.0 + known.abs()),
            (found, known) => found == known,
        };
        assert!(is_same, "{setup}, {query:?}: {found:?}, {known:?}");
    }
}

/// An index that was read keeps its shape when it is made anew for a changed map.
#[test]
fn repaired_indexes_keep_their_shape() {
    let space = map().space(Motion::centers(K::N8)).expect("a space");
    let larger = Map::from_fn(40, 40, |x, y| x == y && x != 9).expect("a map").space(Motion::centers(K::N8));
    let larger = larger.expect("a space");
    for text in ["hpa,side=4,levels=1", "chpa,side=5", "subgoal,levels=2"] {
        let setup: Setup = text.parse().expect("a setup");
        let bytes = setup.prepare(&space).and_then(|index| index.to_bytes()).expect("an index");
        let change = Change::between(&space, &larger).expect("the same motion");
        let read = space.index_from_bytes(bytes).expect("its bytes").repair(&change).expect("its map");
        let anew = setup.prepare(&larger).expect("an index");
        assert_eq!(read.to_bytes().ok(), anew.to_bytes().ok(), "{text}");
    }
}

/// Labels of the map before answer where they prove to be right: nearly always after one cell, and not at all
/// where a door opens on the way. They are left again when all is finished, and when the cells are as before.
#[test]
fn labels_of_the_map_before_answer_most_queries() {
    let mut rng = Rng::new(38);
    for motion in [Motion::centers(K::N8), Motion::corners(K::N16), Motion::corners(K::ANY)] {
        // Two halls with a door in the wall between them.
        let map = Map::from_fn(80, 60, |x, y| x == 40 && y != 2 || x % 13 == 5 && y % 7 == 3);
        let space = map.and_then(|map| map.space(motion)).expect("a space");
        let index = space.prepare(Engine::Subgoal).expect("an index");
        assert!(index.is_finished());
        let (mut from_labels, mut found) = (0, 0);
        for _ in 0..30 {
            let cell = random_vertex(&mut rng, space.map().grid(), PlacementKind::Center);
            let change = space.edit_cells([(cell, space.map().is_free(cell))]).expect("on the map");
            let repaired = index.repair(&change).expect("it is repaired");
            assert_eq!((repaired.is_finished(), repaired.origin()), (false, Origin::Repaired));
            let mut planner = repaired.planner();
            for query in (0..10).flat_map(|_| queries(&mut rng, change.after())) {
                if planner.find(query).is_ok_and(|answer| answer.path().is_some()) {
                    found += 1;
                    from_labels += usize::from(planner.searched_by() == Engine::Subgoal);
                }
            }
            let back = Change::between(change.after(), &space).expect("the same motion");
            let again = repaired.repair(&back).expect("it is repaired");
            assert!(again.is_finished() && again.to_bytes().ok() == index.to_bytes().ok(), "{motion}");
        }
        assert!(from_labels * 100 > found * 97, "{motion}: {from_labels} of {found}");

        let opened = space.edit_cells([((40, 55), false)]).expect("on the map");
        let repaired = index.repair(&opened).expect("it is repaired");
        let mut planner = repaired.planner();
        let through = |planner: &mut Planner| planner.path((38, 55), (42, 55)).map(|path| path.is_some());
        assert_eq!((through(&mut planner), planner.searched_by() == Engine::Subgoal), (Ok(true), false));
        let finished = repaired.finish().expect("room");
        planner.follow(&finished).expect("its map");
        assert_eq!((through(&mut planner), planner.searched_by()), (Ok(true), Engine::Subgoal));
        let new = opened.after().prepare(Engine::Subgoal).expect("an index");
        assert_eq!(finished.to_bytes().ok(), new.to_bytes().ok());
    }
}
