//! Fields of a space are the distances of single paths; the same for maps of agents and widest paths.

use mediant::{
    Change, Ends, Engine, ErrorCode, Field, K, Map, Motion, Point, Query, Rectangle, Setup, Space, Vertex,
    grid::{Fit, Outside},
};
use mediant_grid::Rules;
use mediant_oracle::{Rng, on_all_cores, random_change, random_grid, seeds, suite_grid};

use super::{NEVER, OPEN};

fn world(k: K, rules: Rules, seed: u64) -> (Space, Vec<Vertex>) {
    on_map(&Map::from(random_grid(seed).0), k, rules)
}

/// A space on a map, and its free vertices.
fn on_map(map: &Map, k: K, rules: Rules) -> (Space, Vec<Vertex>) {
    let space = map.space(Motion::new(k, rules)).expect("a space");
    let (width, height) = (space.map().width() as i32, space.map().height() as i32);
    let all = (0..=height).flat_map(|y| (0..=width).map(move |x| Vertex::new(x, y)));
    let free = all.filter(|&at| space.is_free(at)).collect();
    (space, free)
}

fn some(rng: &mut Rng, free: &[Vertex]) -> Vertex {
    free[rng.below(free.len() as u32) as usize]
}

#[test]
fn a_field_is_the_distances_of_paths() {
    for (k, rules) in [(K::N4, NEVER), (K::N8, NEVER), (K::N16, OPEN), (K::ANY, OPEN)] {
        for seed in 0..8 {
            let (space, free) = world(k, rules, seed);
            if free.is_empty() {
                continue;
            }
            let rng = &mut Rng::new(seed);
            let sources = [some(rng, &free), some(rng, &free)];
            let field = space.field(sources).expect("free sources");
            let engine = if k == K::ANY { Engine::Anya } else { Engine::AStar };
            let mut planner = space.planner(engine).expect("an engine");
            let limit = field.iter().map(|(_, length)| length).fold(0.0, f64::max) / 2.0;
            let near = space.field_within(sources, limit).expect("free sources");
            for &at in &free {
                let text = || format!("{}, seed {seed}: {at} to {sources:?}", space.motion());
                let lengths = sources.map(|source| {
                    planner.find(Query::new(at, source)).expect("free ends").cost().unwrap_or(f64::INFINITY)
                });
                let best = lengths[0].min(lengths[1]);
                let found = field.get(at).unwrap_or(f64::INFINITY);
                assert!(found == best || (found - best).abs() < 1e-8 * best, "{found}, {best}: {}", text());
                let is_near = |length: f64| length <= limit * (1.0 + 2_f64.powi(-31));
                assert_eq!(near.get(at).is_some(), field.get(at).is_some_and(is_near), "{}", text());
                let Some(path) = field.path_from(at) else { continue };
                assert!((path.cost() - found).abs() <= 1e-8 * (1.0 + found), "{}", text());
                assert_eq!(space.check(&path), Ok(()), "{}", text());
                assert_eq!(path.goal(), field.nearest_source(at), "{}", text());
                assert_eq!(field.next(at).is_none(), sources.contains(&at), "{}", text());
                assert!(
                    field.direction(at).is_none_or(|(x, y)| (x.hypot(y) - 1.0).abs() < 1e-12),
                    "{}",
                    text()
                );
            }
            assert_eq!(field.lengths().len() as u32, field.width() * field.height());
            assert_eq!(field.lengths().iter().filter(|it| it.is_finite()).count(), field.iter().count());
            assert_eq!(field.identity(), space.identity());
        }
    }
}

/// Over N(k) all shortest paths between two vertices have the same length, whoever measures it, and as a
/// limit it reaches the other vertex.
#[test]
fn all_that_is_measured_is_the_same_number() {
    let mut count = 0;
    for (k, rules) in [(K::N4, NEVER), (K::N8, NEVER), (K::N16, OPEN), (K::N32, NEVER), (K::N8, OPEN)] {
        for seed in 0..6 {
            let (space, free) = world(k, rules, seed);
            if free.is_empty() {
                continue;
            }
            let rng = &mut Rng::new(seed);
            let start = some(rng, &free);
            let goals: Vec<Vertex> = (0..5).map(|_| some(rng, &free)).collect();
            let field = space.field([start]).expect("a free source");
            let expected: Vec<f64> = goals.iter().map(|&at| field.get(at).unwrap_or(f64::INFINITY)).collect();
            for setup in Setup::all(Motion::new(k, rules)).filter(|setup| setup.optimal_over() == Some(k)) {
                let text = || format!("{setup}, seed {seed}: {start} to {goals:?}");
                let index = setup.prepare(&space).expect("an index");
                let mut planner = index.planner();
                let mut one = |&goal| planner.distance(Ends::new(start, goal)).expect("free ends");
                let each: Vec<f64> = goals.iter().map(|at| one(at).unwrap_or(f64::INFINITY)).collect();
                assert_eq!(each, expected, "{}", text());
                let table = index.table([start], goals.iter().copied()).expect("free ends");
                assert_eq!(table.row(0), expected, "{}", text());
                let prepared = index.goals(goals.iter().copied()).expect("free goals");
                let at_once = planner.distances(start, &prepared).expect("a free start");
                assert_eq!(at_once, expected, "{}", text());
                let nearest = planner.nearest(start, &prepared).expect("a free start");
                let least = expected.iter().copied().filter(|it| it.is_finite()).reduce(f64::min);
                assert_eq!(nearest.map(|(_, length)| length), least, "{}", text());
            }
            for (&at, &length) in goals.iter().zip(&expected).filter(|(_, length)| length.is_finite()) {
                let path = space.path(start, at).expect("free ends").expect("a path");
                for limit in [length, path.cost()] {
                    let near = space.field_within([start], limit).expect("a free source");
                    assert_eq!(near.get(at), Some(length), "{at} within {limit} of {start}, seed {seed}");
                }
                count += 1;
            }
        }
    }
    assert!(count > 60, "{count}");
    let open = Map::from_rows(["....", "....", "....", "...."]).expect("a map");
    let space = open.space(Motion::centers(K::N8)).expect("a space");
    let corner = space.field_within([(0, 0)], 2_f64.sqrt()).expect("a free source").get((1, 1));
    assert!(corner.is_some_and(|length| (length - 2_f64.sqrt()).abs() < 1e-9));
}

#[test]
fn mistakes_of_fields_and_agents() {
    let map = Map::from_rows(["..#"]).expect("a map");
    let space = map.space(Motion::centers(K::N8)).expect("a space");
    let code = |at: (i32, i32), limit| space.field_within([at], limit).map_err(|error| error.code()).err();
    assert_eq!(code((0, 0), 1.0), None);
    assert_eq!(code((2, 0), 1.0), Some(ErrorCode::StartBlocked));
    assert_eq!(code((3, 0), 1.0), Some(ErrorCode::StartOutside));
    assert_eq!(code((0, 0), -1.0), Some(ErrorCode::Number));
    assert_eq!(code((0, 0), f64::NAN), Some(ErrorCode::Number));
    let nowhere: [Vertex; 0] = [];
    assert_eq!(space.field(nowhere).expect("no source").iter().count(), 0);
    for radius in [-1.0, f64::NAN, f64::INFINITY] {
        let error = map.for_disc(radius, space.motion()).expect_err("no radius");
        assert_eq!(error.code(), ErrorCode::Number);
    }
    assert_eq!(map.for_square(0).expect_err("no square").code(), ErrorCode::Number);
    assert_eq!(map.for_disc(0.0, space.motion()).expect("a map").id(), map.id());
    let surplus = |surplus| space.widest_path((0, 0), (1, 0), surplus).map_err(|error| error.code());
    assert_eq!(surplus(-0.1), Err(ErrorCode::Number));
    for any in [0.0, f64::INFINITY] {
        assert_eq!(surplus(any).expect("a path").expect("a path").path.cost(), 1.0);
    }
    let stays = space.widest_path((0, 0), (0, 0), f64::INFINITY).expect("free").expect("a path");
    assert_eq!(stays.path.cost(), 0.0);
}

/// No path that is short enough lies on the map of a larger disc: all radii are tried.
#[test]
fn the_widest_path_is_the_widest() {
    let mut wider = 0;
    for seed in 0..40 {
        let (k, rules) = [(K::N8, NEVER), (K::N16, OPEN), (K::ANY, OPEN)][seed as usize % 3];
        let rng = &mut Rng::new(seed);
        // A wall across, with a narrow and a wide opening, and a few blocked cells.
        let map = Map::from_fn(24, 18, |x, y| x == 12 && y != 8 && y < 12 || rng.chance(2));
        let (space, free) = on_map(&map.expect("a map"), k, rules);
        let (start, goal) = (some(rng, &free), some(rng, &free));
        let surplus = [0.0, 0.1, 0.5][rng.below(3) as usize];
        let text = format!("{}, seed {seed}: {start} to {goal}, {surplus}", space.motion());
        let found = space.widest_path(start, goal, surplus).expect("free ends");
        let shortest = space.path(start, goal).expect("free ends");
        assert_eq!(found.is_some(), shortest.is_some(), "{text}");
        let Some((found, shortest)) = found.zip(shortest) else { continue };
        let limit = shortest.cost() * (1.0 + surplus) + 1e-9;
        assert!(found.path.cost() <= limit && space.check(&found.path).is_ok(), "{text}");
        let clearance = space.map().clearance(Fit::exact(rules, k), Outside::Blocked);
        let is_possible = |radius: f64| {
            let agent = Map::from(clearance.for_disc(radius).expect("a radius")).space(space.motion());
            let path = agent.expect("a space").path(start, goal);
            path.is_ok_and(|path| path.is_some_and(|path| path.cost() <= limit))
        };
        assert!(found.radius == 0.0 || is_possible(found.radius), "{text}");
        assert!(
            clearance.radii().into_iter().all(|radius| radius <= found.radius || !is_possible(radius)),
            "{text}"
        );
        wider += usize::from(found.path.cost() > shortest.cost() + 1e-9);
    }
    assert!(wider > 2, "{wider} paths are wider than the shortest");
}

/// Every engine follows on the map of an agent.
#[test]
fn every_engine_takes_an_agents_map() {
    let map = Map::from_fn(24, 16, |x, y| x == 12 && !(5..10).contains(&y)).expect("a map");
    for (k, rules) in [(K::N8, NEVER), (K::ANY, OPEN)] {
        let agent = map.for_disc(1.5, Motion::new(k, rules)).expect("a radius");
        for setup in Setup::all(Motion::new(k, rules)) {
            let answer = setup.planner(&agent).expect("a setup").find(Query::new((4, 3), (20, 12)));
            let path = answer.expect("free ends").into_path().unwrap_or_else(|| panic!("{setup}"));
            assert_eq!(setup.space(&agent).expect("a space").check(&path), Ok(()), "{setup}");
        }
    }
}

/// All that a field says of its vertices.
fn all(field: &Field) -> (Vec<f64>, Vec<Option<Point>>) {
    let next = field.iter().map(|(at, _)| field.next(at)).collect();
    (field.lengths(), next)
}

#[test]
fn fields_follow_chains_of_edits() {
    on_all_cores(seeds(60), |seed| {
        let rules = Rules::ALL[seed as usize % Rules::ALL.len()];
        let ks = [K::N8, K::N4, K::ANY, K::N16];
        let k = ks[seed as usize / Rules::ALL.len() % ks.len()];
        let rules = if k == K::ANY { OPEN } else { rules };
        let (mut space, free) = on_map(&suite_grid(seed).0.into(), k, rules);
        if free.is_empty() {
            return;
        }
        let rng = &mut Rng::new(seed);
        let sources = [some(rng, &free), some(rng, &free)];
        let limit = if rng.below(2) == 0 { f64::INFINITY } else { f64::from(rng.below(12)) };
        let mut field = space.field_within(sources, limit).expect("free sources");
        for step in 0..10 {
            let edit = random_change(rng, space.map().grid());
            let message = format!("seed {seed}, {}, from {sources:?}, edit {step}", space.motion());
            let new = edit.after().as_ref().clone();
            let new = Map::from(new).space(space.motion()).expect("the same motion");
            let change = Change::between(&space, &new).expect("the same motion");
            match (field.repair(&change), new.field_within(sources, limit)) {
                (Ok(repaired), Ok(expected)) => {
                    assert!(all(&repaired) == all(&expected), "{message}");
                    assert_eq!(repaired.identity(), new.identity(), "{message}");
                    (field, space) = (repaired, change.after().clone());
                }
                (repaired, expected) => {
                    let [error, expected] =
                        [repaired.err(), expected.err()].map(|it| it.map(|it| it.to_string()));
                    assert_eq!(error, expected, "{message}");
                }
            }
        }
    });
}

#[test]
fn fields_follow_edits_of_their_own_space_alone() {
    let space = Map::from_fn(9, 7, |_, _| false).expect("a map").space(3).expect("a space");
    let field = space.field([(0, 0)]).expect("a free source");
    let wall = space.edit(Rectangle::new(4, 0, 1, 6), |_, _| true).expect("on the map");
    let around = field.repair(&wall).expect("its own space");
    assert!(all(&around) == all(&wall.after().field([(0, 0)]).expect("a free source")));
    assert!(around.get((8, 0)) > field.get((8, 0)) && around.get((4, 0)).is_none());
    for other in [K::N4, K::N16] {
        let space = space.map().space(other).expect("a space");
        let change = space.edit_cells([((4, 4), true)]).expect("on the map");
        assert_eq!(field.repair(&change).map(|_| ()).map_err(|error| error.code()), Err(ErrorCode::Mismatch));
    }
    let change = space.edit_cells([((0, 0), true)]).expect("on the map");
    assert_eq!(field.repair(&change).map(|_| ()).map_err(|error| error.code()), Err(ErrorCode::StartBlocked));
    // A map of another size.
    for (k, rules) in [(K::N8, NEVER), (K::ANY, OPEN)] {
        let [small, large] = [5, 6].map(|side| {
            let map = Map::from_fn(side, side, |_, _| false).expect("a map");
            map.space(Motion::new(k, rules)).expect("a space")
        });
        let field = small.field([(0, 0)]).expect("a free source");
        let change = Change::between(&small, &large).expect("the same motion");
        let field = field.repair(&change).expect("the source is on the map");
        assert!(all(&field) == all(&large.field([(0, 0)]).expect("a free source")));
    }
}
