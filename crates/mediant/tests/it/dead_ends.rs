//! An index of Anya leaves out dead ends: its paths cost the same as those of a search that does not.

use std::sync::Arc;

use mediant::{
    Answer, Change, Ends, Engine, Index, K, Map, Motion, Origin, Planners, Rectangle, Setup, Vertex,
    errors::QueryError,
};
use mediant_grid::{Corners, DiagonalGap, FreeSpace, Grid, Rules};
use mediant_oracle::{Rng, caves, maze, on_all_cores, random_free_vertex, rooms, seeds};
use mediant_search::{Anya, Planner as _};

use super::k;

/// Rooms with niches, a maze, or caves.
fn grid(rng: &mut Rng) -> Grid {
    let (width, height) = (20 + rng.below(60), 20 + rng.below(60));
    match rng.below(4) {
        0 => maze(rng, width, height),
        1 => caves(rng, width, height),
        _ => {
            let plan = rooms(rng, width, height);
            let niches: Vec<bool> = (0..width * height).map(|_| rng.chance(3)).collect();
            let blocked =
                |x: u32, y: u32| plan.is_blocked(x as i32, y as i32) || niches[(y * width + x) as usize];
            Grid::from_fn(width, height, blocked).expect("a small map")
        }
    }
}

fn queries(grid: &Grid, rng: &mut Rng, count: usize) -> Vec<Ends> {
    let corner = mediant::PlacementKind::Corner;
    let mut free = || random_free_vertex(rng, grid, corner);
    (0..count).filter_map(|_| Some(Ends::new(free()?, free()?))).collect()
}

/// The costs of the paths that the typed planner finds.
fn typed(grid: &Arc<Grid>, gap: DiagonalGap, k: K, queries: &[Ends]) -> Vec<Option<f64>> {
    let space = FreeSpace::<Corners>::new(Arc::clone(grid), gap);
    let cost = |found: Result<Answer, QueryError>| found.expect("both ends are free").cost();
    match k {
        K::Any => {
            let mut anya = Anya::new(&space);
            queries.iter().map(|&query| cost(anya.solve(query))).collect()
        }
        K::Finite(k) => {
            let mut anya = Anya::over(&space, k).expect("a small k");
            queries.iter().map(|&query| cost(anya.solve(query))).collect()
        }
    }
}

fn assert_same(found: &[Option<f64>], known: &[Option<f64>], text: &dyn Fn() -> String) {
    assert_eq!(found.len(), known.len());
    for (number, pair) in found.iter().zip(known).enumerate() {
        let is_same = match pair {
            (Some(found), Some(known)) => (found - known).abs() < 1e-9 * (1.0 + known),
            (found, known) => found == known,
        };
        assert!(is_same, "query {number}: {pair:?}; {}", text());
    }
}

fn costs(answers: Vec<Result<Answer, QueryError>>) -> Vec<Option<f64>> {
    answers.into_iter().map(|answer| answer.expect("both ends are free").cost()).collect()
}

fn check(seed: u64) -> [u64; 2] {
    let rng = &mut Rng::new(seed);
    let grid = Arc::new(grid(rng));
    let ks = [K::Any, K::Any, K::N4, K::N8, K::Finite(k(5))];
    let (k, gap) =
        (ks[seed as usize % ks.len()], [DiagonalGap::Open, DiagonalGap::Closed][rng.below(2) as usize]);
    let queries = queries(&grid, rng, 40);
    let known = typed(&grid, gap, k, &queries);
    let space = Map::from(Arc::clone(&grid)).space(Motion::new(k, gap)).expect("a space");
    let text = || format!("seed {seed}, k = {k}, {gap}");
    let expanded = |index: &Index| {
        let mut planner = index.planner();
        let counts = queries.iter().map(|&query| planner.find_counted(query).expect("free ends").1.expanded);
        counts.sum::<u64>()
    };
    let [with, without] = [space.prepare(Engine::Anya), space.prepare_for_one_path(Engine::Anya)]
        .map(|index| index.expect("an index"));
    for index in [&with, &without] {
        // All cores, and one planner; both answer alike.
        let planners = Planners::new(index.clone());
        let answers = planners.find_all(&queries);
        let mut one = index.planner();
        assert_eq!(queries.iter().map(|&query| one.find(query)).collect::<Vec<_>>(), answers, "{}", text());
        assert_same(&costs(answers), &known, &text);
    }
    let at_once = queries[..8.min(queries.len())].iter().map(|query| {
        space.path(query.start, query.goal).expect("both ends are free").map(|path| path.cost())
    });
    assert_same(&at_once.collect::<Vec<_>>(), &known[..8.min(queries.len())], &text);
    [expanded(&with), expanded(&without)]
}

#[test]
fn paths_cost_the_same_without_dead_ends() {
    let expanded = on_all_cores(seeds(60), check);
    let [with, without] = expanded.into_iter().fold([0; 2], |sum, one| [sum[0] + one[0], sum[1] + one[1]]);
    // The same search would expand as many nodes.
    assert!(10 * with < 9 * without, "{with} expansions, {without} with all dead ends");
}

/// Doors are opened and closed; the index follows, and so does that for a single path.
#[test]
fn a_changed_map_has_other_dead_ends() {
    on_all_cores(0..12, |seed| {
        let rng = &mut Rng::new(seed);
        let gap = [DiagonalGap::Open, DiagonalGap::Closed][seed as usize % 2];
        let k = if seed % 3 == 0 { K::N16 } else { K::Any };
        let mut space = Map::from(rooms(rng, 40, 40)).space(Motion::new(k, gap)).expect("a space");
        let (mut with, mut without) = (
            space.prepare(Engine::Anya).expect("an index"),
            space.prepare_for_one_path(Engine::Anya).expect("none"),
        );
        for _ in 0..12 {
            let at = Rectangle { x: rng.below(40), y: rng.below(40), width: 1, height: 1 };
            let change = space.edit(at, |x, y| !space.map().is_blocked((x, y))).expect("a cell of the map");
            let before = with.clone();
            with = with.repair(&change).expect("its map");
            without = without.repair(&change).expect("its map");
            space = change.after().clone();
            assert_eq!([with.origin(), without.origin()], [Origin::Repaired; 2]);
            assert_eq!(without.memory_bytes(), 0);
            assert!(with.memory_bytes() > 0);
            let queries = queries(space.map().grid(), rng, 12);
            let known = typed(space.map().grid(), gap, k, &queries);
            let text = || format!("seed {seed}");
            assert_same(&costs(Planners::new(with.clone()).find_all(&queries)), &known, &text);
            assert_same(&costs(Planners::new(without.clone()).find_all(&queries)), &known, &text);
            assert_eq!(
                before.repair(&Change::new(before.space())).expect("the same map").origin(),
                Origin::Unchanged
            );
        }
    });
}

/// Memory of dead ends is counted: an index for a single path has none, and its planners take less.
#[test]
fn a_single_path_prepares_nothing() {
    let (width, height) = (128, 64);
    let map = Map::from_fn(width, height, |x, y| x % 16 == 15 && y % 16 != 3).expect("a map");
    for motion in [Motion::corners(K::ANY), Motion::corners(K::N16)] {
        let space = map.space(motion).expect("a space");
        let (with, without) = (space.prepare(Engine::Anya), space.prepare_for_one_path(Engine::Anya));
        let (with, without) = (with.expect("an index"), without.expect("nothing"));
        assert_eq!((with.setup(), with.identity()), (without.setup(), without.identity()));
        assert_eq!(without.memory_bytes(), 0);
        // Half a byte a cell at least.
        assert!(with.memory_bytes() >= u64::from(width * height / 2), "{}", with.memory_bytes());
        assert!(with.scratch_bytes() >= without.scratch_bytes() + u64::from(width * height / 8));
        for other in [K::ANY, K::N8] {
            assert!(with.for_k(other).is_ok_and(|index| index.memory_bytes() == with.memory_bytes()));
            assert!(without.for_k(other).is_ok_and(|index| index.memory_bytes() == 0));
        }
    }
    // All other engines prepare what they always do. (The dead ends of block-based JPS are bits that it has
    // in any case.)
    for rules in Rules::ALL {
        for setup in Setup::all(Motion::new(K::N8, rules)).filter(|setup| setup.engine.kind() != Engine::Anya)
        {
            let space = setup.space(&map).expect("a space");
            let [one, many] = [space.prepare_for_one_path(setup.engine), space.prepare(setup.engine)];
            let [one, many] = [one, many].map(|index| index.expect("an index"));
            assert_eq!(one.memory_bytes(), many.memory_bytes(), "{setup}");
            assert_eq!(one.to_bytes().ok(), many.to_bytes().ok(), "{setup}");
        }
    }
}

/// An end may be anywhere: at each vertex of a map with a pocket, a room and a gap, from each other one.
#[test]
fn every_pair_of_ends_on_a_small_map() {
    let map =
        Map::from_rows(["...#....", ".#.#.##.", "...#.#..", "##.##.#.", "......#.", ".##.##..", "....#..."]);
    let map = map.expect("a map");
    let ends: Vec<Vertex> = (0..8).flat_map(|y| (0..9).map(move |x| Vertex::new(x, y))).collect();
    for gap in [DiagonalGap::Open, DiagonalGap::Closed] {
        for k in [K::Any, K::N4, K::N16] {
            let space = map.space(Motion::new(k, gap)).expect("a space");
            let free = ends.iter().filter(|&&at| space.is_free(at));
            let queries: Vec<Ends> =
                free.clone().flat_map(|&a| free.clone().map(move |&b| Ends::new(a, b))).collect();
            let known = typed(map.grid(), gap, k, &queries);
            let found = Planners::new(space.prepare(Engine::Anya).expect("an index")).find_all(&queries);
            assert_same(&costs(found), &known, &|| format!("k = {k}, {gap}"));
        }
    }
}
