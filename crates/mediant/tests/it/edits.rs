//! Maps that change: whatever was prepared follows a chain of edits, and answers as if it were made anew.

use mediant::{Answer, Ends, Engine, Index, K, Map, Motion, PlacementKind, Planner, Rules, Setup, Space};
use mediant_grid::{Change, Grid};
use mediant_oracle::{Rng, on_all_cores, random_change, random_vertex, seeds, suite_grid};

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
        Engine::JpsBlock | Engine::JpsPlus | Engine::Anya | Engine::Subgoal => Sense::Cost,
        _ => Sense::Path,
    }
}

/// Every engine with a motion of this number that it takes.
fn setups(number: u64) -> Vec<Setup> {
    let rules = Rules::ALL[number as usize % Rules::ALL.len()];
    let ks = [K::N8, K::N4, K::N16, K::ANY, K::N8, K::N32];
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

#[test]
fn every_index_follows_a_chain_of_edits() {
    on_all_cores(seeds(40), |seed| {
        let mut rng = Rng::new(seed);
        let map = Map::from(suite_grid(seed).0);
        for setup in setups(seed) {
            let mut space = setup.space(&map).expect("it is searched");
            let mut index = setup.prepare(&space).expect("a small map");
            let (first, mut planner) = ((space.clone(), index.clone()), index.planner());
            for step in 0..12 {
                let change = random_change(&mut rng, space.map().grid());
                let message = format!("seed {seed}, {setup}, edit {step}: {:?}", change.cells());
                let change = space.edit_cells(cells(&change)).expect("they are on the map");
                index = index.repair(&change).unwrap_or_else(|error| panic!("{message}: {error}"));
                space = change.after().clone();
                let new =
                    setup.prepare(&setup.space(space.map()).expect("it is searched")).expect("a small map");
                planner.follow(&index).unwrap_or_else(|error| panic!("{message}: {error}"));
                check_same(&mut planner, &new, &queries(&mut rng, &space), &message);
            }
            // The first version is held all the time, and still answers for its own map.
            let new = setup.prepare(&first.0).expect("a small map");
            planner.follow(&first.1).unwrap_or_else(|error| panic!("seed {seed}, {setup}: {error}"));
            let message = format!("seed {seed}, {setup}, the first");
            check_same(&mut planner, &new, &queries(&mut rng, &first.0), &message);
        }
    });
}

fn queries(rng: &mut Rng, space: &Space) -> Vec<Ends> {
    let kind = space.motion().rules.placement();
    let mut at = || random_vertex(rng, space.map().grid(), kind);
    (0..5).map(|_| Ends::new(at(), at())).collect()
}

/// The cells of a change, and whether they are blocked after it.
fn cells(change: &Change) -> impl Iterator<Item = ((i32, i32), bool)> {
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
        for step in 0..12 {
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
