//! Cells that count otherwise for one query, and discs among obstacles that change: as maps that were edited.

use std::sync::Arc;

use mediant::{
    Change, Disc, Ends, Engine, Error, ErrorCode, Exceptions, K, Limits, Map, Motion, PlacementKind, Planner,
    Query, Rectangle, Rules, Setup, Vertex,
};
use mediant_grid::Grid;
use mediant_oracle::{Rng, noise, on_all_cores, random_change, random_grid, random_vertex, seeds};

use super::k;

/// A map with some cells changed, cell by cell, and ends that are free.
fn changed(map: &Map, cells: &[(Vertex, bool)], free: &[Vertex]) -> Map {
    let is_blocked = |x: u32, y: u32| {
        let at = Vertex::new(x as i32, y as i32);
        let said = cells.iter().rev().find(|(cell, _)| *cell == at).map(|&(_, blocked)| blocked);
        !free.contains(&at) && said.unwrap_or_else(|| map.is_blocked((at.x, at.y)))
    };
    Map::from_fn(map.width(), map.height(), is_blocked).expect("the size of a map")
}

/// The ends that exceptions make free: between corners the cell to the right and below, or the last one.
fn freed(map: &Map, rules: Rules, ends: [Vertex; 2]) -> Vec<Vertex> {
    let motion = Motion::new(if rules.placement() == PlacementKind::Corner { K::ANY } else { K::N8 }, rules);
    let space = map.space(motion).expect("a space");
    let cell = |at: Vertex| Vertex::new(at.x.min(map.width() as i32 - 1), at.y.min(map.height() as i32 - 1));
    ends.into_iter().filter(|&end| !space.is_free(end)).map(cell).collect()
}

/// Compares one query, with exceptions of its own, with a planner on the map that was edited so.
fn check_one(
    planner: &mut Planner,
    setup: Setup,
    (map, grid): (&Map, &Grid),
    (rng, seed): (&mut Rng, u64),
    counts: &mut [usize; 2],
) {
    let rules = setup.rules();
    let mut vertex = || random_vertex(rng, grid, rules.placement());
    let query = Ends::new(vertex(), vertex());
    let cells: Vec<(Vertex, bool)> =
        (0..4).map(|n| (random_vertex(rng, grid, PlacementKind::Center), n % 2 == 0)).collect();
    let mut exceptions = Exceptions::new().free_ends();
    for &(cell, blocked) in &cells {
        exceptions = if blocked { exceptions.blocked([cell]) } else { exceptions.free([cell]) };
    }
    let named = changed(map, &cells, &[]);
    let expected_map = changed(map, &cells, &freed(&named, rules, [query.start, query.goal]));
    let (answer, searched_by) = match planner.find_except(query, &exceptions) {
        Ok(found) => (Ok(found.answer), found.searched_by),
        // CHPA* as published gives up where a new index of the map would, too.
        Err(Error::Query(error)) => (Err(error), setup.engine.kind()),
        Err(error) => panic!("seed {seed}, {setup}: {error}"),
    };
    let by = Setup { engine: searched_by.into(), ..setup };
    let engine = if searched_by == setup.engine.kind() { setup } else { by };
    let expected = engine.planner(&expected_map).expect("a planner").find(query);
    let said = format!("seed {seed}, {setup}, searched by {searched_by}");
    let (answer, expected) = match (answer, expected) {
        (Ok(answer), Ok(expected)) => (answer, expected),
        (answer, expected) => return assert_eq!(answer, expected, "{said}"),
    };
    assert_eq!(answer.path().is_some(), expected.path().is_some(), "{said}");
    if engine.optimal_over().is_some() || setup.optimal_over().is_some() {
        let costs = [&answer, &expected].map(|answer| answer.cost().unwrap_or(0.0));
        assert!((costs[0] - costs[1]).abs() < 1e-6, "{costs:?}, {said}");
    }
    let space = expected_map.space(setup.motion).expect("a space");
    assert!(answer.path().is_none_or(|path| space.check(path).is_ok()), "{said}");
    counts[0] += usize::from(answer.path().is_some());
    counts[1] += usize::from(searched_by != setup.engine.kind());
}

/// Compares on one map; the number of queries that were answered by a path, and by another engine.
fn check(seed: u64) -> [usize; 2] {
    let rng = &mut Rng::new(seed);
    let map = Map::from(random_grid(seed).0);
    let rules = Rules::ALL[seed as usize % Rules::ALL.len()];
    let k = match (rules.placement(), rng.below(3)) {
        (PlacementKind::Corner, 0) => K::ANY,
        (_, 1) => K::N4,
        _ => K::N8,
    };
    let mut counts = [0, 0];
    for setup in Setup::all(Motion::new(k, rules)) {
        let mut planner = setup.planner(&map).expect("a planner");
        let mut map = map.clone();
        // A query leaves its planner for the next, also if this one follows to another map in between.
        for round in 0..4 {
            let grid = Arc::clone(map.grid());
            check_one(&mut planner, setup, (&map, &grid), (rng, seed), &mut counts);
            if round % 2 == 1 {
                map = Map::from(Arc::clone(random_change(rng, &grid).after()));
                let change = Change::to(planner.index().space(), &map);
                let index = planner.index().repair(&change).expect("its map");
                planner.follow(&index).expect("the same setup");
            }
        }
    }
    counts
}

#[test]
fn answers_are_those_of_the_edited_map() {
    let seeds = seeds(40);
    let maps = seeds.end as usize;
    let counts = on_all_cores(seeds, check);
    let sum = |at: usize| counts.iter().map(|counts| counts[at]).sum::<usize>();
    assert!(sum(0) > 5 * maps && sum(1) > maps, "{} paths, {} by another engine", sum(0), sum(1));
}

#[test]
fn an_agent_that_marks_its_own_cell_leaves_it_with_every_engine() {
    let map = Map::from_rows([".....", "@..@.", "....."]).expect("a map");
    for setup in Setup::all(Motion::new(K::N8, Rules::ALL[0])) {
        let mut planner = setup.planner(&map).expect("a planner");
        let query = Ends::new((3, 1), (0, 1));
        assert!(planner.find(query).is_err(), "{setup}");
        let answer = planner.find_except(query, &Exceptions::new().free_ends()).expect("free ends");
        let cost = answer.answer.cost().expect("there is a way");
        // Wavefronts have the fewest moves: two diagonal ones and one along the row are as many.
        let promises = setup.optimal_over() == Some(setup.k());
        assert!(cost > 2.9 && (!promises || cost == 3.0), "{cost}, {setup}");
    }
    let space = map.space(Motion::centers(K::N8)).expect("a space");
    let mut planner = space.planner(Engine::Subgoal).expect("a planner");
    let none = planner.find_except(Query::new((0, 0), (4, 0)), &Exceptions::new()).expect("free ends");
    assert_eq!(none.searched_by, planner.index().searched_by(), "nothing changed, so nothing is made anew");
    let outside = planner.find_except(Query::new((0, 0), (4, 0)), &Exceptions::new().blocked([(5, 0)]));
    assert_eq!(outside.map_err(|error| error.code()), Err(ErrorCode::EditOutside));
    let outside = planner.find_except(Query::new((0, 0), (9, 0)), &Exceptions::new().free_ends());
    assert!(matches!(outside, Err(Error::Query(_))), "{outside:?}");
}

/// Edits a disc's obstacles again and again; the number of cells that the disc lost or won.
fn check_disc(seed: u64) -> usize {
    let rng = &mut Rng::new(seed);
    // Half of the maps have few obstacles, so that large discs have room.
    let sparse = |rng: &mut Rng| {
        let (width, height) = (5 + rng.below(60), 5 + rng.below(60));
        Grid::from_fn(width, height, |_, _| rng.chance(2)).expect("a small map")
    };
    let grid = if seed.is_multiple_of(2) { random_grid(seed).0 } else { sparse(rng) };
    let rules = Rules::ALL[seed as usize % Rules::ALL.len()];
    let k = if rng.below(2) == 0 { K::N8 } else { K::Finite(k(4)) };
    let motion = Motion::new(k, rules);
    let radius = [0.0, 0.3, 0.5, 0.75, 1.0, 1.5, 2.3, 40.0][rng.below(8) as usize];
    let mut disc: Disc = Map::from(grid.clone()).disc(radius, motion).expect("a radius");
    let mut differ = 0;
    for _ in 0..6 {
        let at = random_vertex(rng, &grid, PlacementKind::Center);
        let (x, y) = (at.x as u32, at.y as u32);
        let at = Rectangle { x, y, width: 1 + rng.below(4), height: 1 + rng.below(4) };
        let blocked = rng.below(2) == 0;
        let edited = disc.edit(at, |_, _| blocked).expect("a rectangle on the map");
        let anew = edited.obstacles().for_disc(radius, motion).expect("a radius");
        assert_eq!(edited.map(), &anew, "seed {seed}, radius {radius}, {motion}, {at:?}");
        let cells = (0..grid.height() as i32).flat_map(|y| (0..grid.width() as i32).map(move |x| (x, y)));
        differ += cells.filter(|&(x, y)| anew.is_blocked((x, y)) != disc.map().is_blocked((x, y))).count();
        disc = edited;
    }
    differ
}

#[test]
fn a_disc_keeps_off_new_obstacles() {
    let seeds = seeds(200);
    let maps = seeds.end as usize;
    let differ: usize = on_all_cores(seeds, check_disc).into_iter().sum();
    assert!(differ > 10 * maps, "{differ} cells");
}

/// Discs and squares through chains of edits: their maps are those made anew, and indexes on them follow.
fn check_agents(seed: u64) -> usize {
    let rng = &mut Rng::new(seed);
    let (width, height) = (5 + rng.below(60), 5 + rng.below(60));
    let first = Map::from(noise(rng, width, height, 3));
    let motion = Motion::new(K::N8, Rules::ALL[seed as usize % Rules::ALL.len()]);
    let (radius, side) = (f64::from(rng.below(12)) / 4.0, 1 + rng.below(4));
    let (mut disc, mut square) =
        (first.disc(radius, motion).expect("a radius"), first.square(side).expect("a side"));
    let mut spaces = [disc.map(), square.map()].map(|map| map.space(motion).expect("a space"));
    let mut indexes = spaces.each_ref().map(|space| space.prepare(Engine::AStar).expect("an index"));
    let (old, mut differ) = (spaces.clone(), 0);
    for step in 0..8 {
        let obstacles = disc.obstacles().space(motion).expect("a space");
        let change = random_change(rng, obstacles.map().grid());
        let change = Change::to(&obstacles, &Arc::clone(change.after()).into());
        // One follows the change, the other takes its cells.
        disc = disc.after(&change).expect("it follows");
        let blocked = |x: u32, y: u32| change.after().map().is_blocked((x as i32, y as i32));
        for &at in change.cells() {
            square = square.edit(at, blocked).expect("it is on the map");
            let change = square.change(&spaces[1]);
            indexes[1] = indexes[1].repair(&change).expect("it follows");
            spaces[1] = change.after().clone();
        }
        let change = disc.change(&spaces[0]);
        differ += change.cells().len();
        indexes[0] = indexes[0].repair(&change).expect("it follows");
        spaces[0] = change.after().clone();
        let said = format!("seed {seed}, edit {step}, radius {radius}, side {side}");
        let anew = [disc.obstacles().for_disc(radius, motion), square.obstacles().for_square(side)];
        for ((space, index), anew) in spaces.iter().zip(&indexes).zip(anew) {
            assert_eq!(space.map(), &anew.expect("a size"), "{said}");
            assert_eq!(index.identity(), space.identity(), "{said}");
        }
        assert_eq!(disc.obstacles(), square.obstacles(), "{said}");
        // A space that is older than the last edit.
        assert_eq!(disc.change(&old[0]).after().map(), disc.map(), "{said}");
        assert_eq!(square.change(&old[1]).after().map(), square.map(), "{said}");
        // A change of another map leads to the map after it.
        let moved = disc.after(&Change::new(&old[1])).expect("a map");
        assert_eq!(moved.map(), &old[1].map().for_disc(radius, motion).expect("a radius"), "{said}");
    }
    differ
}

#[test]
fn discs_and_squares_follow_changes() {
    let seeds = seeds(60);
    let maps = seeds.end as usize;
    let differ: usize = on_all_cores(seeds, check_agents).into_iter().sum();
    assert!(differ > 3 * maps, "{differ} rectangles");
}

#[test]
fn query_without_an_end_is_none_whatever_stops_it() {
    let space =
        Map::from_rows(["....", ".@..", "...."]).expect("a map").space(Motion::centers(3)).expect("k = 3");
    let mut planner = space.planner(Engine::Subgoal).expect("subgoals");
    let none: [Vertex; 0] = [];
    for query in [Query::between(none, [(0, 0)]), Query::between([(0, 0)], none)] {
        let query = query.within(Limits::new().deadline(|| true));
        let found = planner.find_except(query, &Exceptions::new().free([(1, 1)]));
        assert_eq!(found.unwrap_err().code(), ErrorCode::NoEnd);
    }
}
