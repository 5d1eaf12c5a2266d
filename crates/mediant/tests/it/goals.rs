//! Many goals at once, against a query for each.

use mediant::{
    DiagonalGap, Engine, Error, ErrorCode, Goals, Index, K, Map, Motion, Planner, Point, Query, Rules, Setup,
    Vertex,
};
use mediant_oracle::{Rng, on_all_cores, random_free_vertex, random_grid, seeds};

use super::{NEVER, OPEN, setup};

/// Some free vertices, one of them twice.
fn vertices(rng: &mut Rng, map: &Map, setup: Setup, count: usize) -> Option<Vec<Vertex>> {
    let one = |rng: &mut Rng| random_free_vertex(rng, map.grid(), setup.rules().placement());
    let mut all: Vec<Vertex> = (0..count).map(|_| one(rng)).collect::<Option<_>>()?;
    all.push(*all.first()?);
    Some(all)
}

/// Compares the distances to goals, and the nearest one, with a query for each.
fn check(planner: &mut Planner, goals: &Goals, start: Vertex, text: &str) {
    let mut length = |goal: Point| planner.find(Query::new(start, goal)).expect("free ends").cost();
    let lengths: Vec<f64> =
        goals.points().iter().map(|&goal| length(goal).unwrap_or(f64::INFINITY)).collect();
    let is_near = |one: f64, other: f64| one == other || (one - other).abs() < 1e-9 * other;
    let distances = planner.distances(start, goals).expect("a free start");
    assert_eq!(distances.len(), lengths.len(), "{text}");
    for (&distance, &length) in distances.iter().zip(&lengths) {
        assert!(is_near(distance, length), "{start}: {distance}, {length}: {text}");
    }
    let nearest = planner.nearest(start, goals).expect("a free start");
    let least = lengths.iter().copied().min_by(f64::total_cmp).filter(|least| least.is_finite());
    assert_eq!(nearest.is_some(), least.is_some(), "{start}: {text}");
    if let Some(((goal, distance), least)) = nearest.zip(least) {
        assert!(is_near(distance, least) && is_near(lengths[goal], least), "{start}: {distance}: {text}");
        // The first of those that are equal to the bit.
        let first = goals.points().iter().position(|&at| at == goals.points()[goal]);
        assert_eq!(first, Some(goal), "{text}");
    }
}

#[test]
fn goals_are_as_far_as_single_queries_say() {
    let checked = on_all_cores(0..seeds(60).end, |seed| {
        let rng = &mut Rng::new(seed);
        let map = Map::from(random_grid(seed).0);
        let mut checked = 0;
        for text in [
            "subgoal:2:one",
            "subgoal:3:never",
            "subgoal:3:never,levels=contracted",
            "subgoal:4:closed",
            "subgoal:any:open",
            "subgoal:any:closed",
            "subgoal:5:open,taut",
            "astar:4:always",
            "anya",
        ] {
            let setup = setup(text);
            let index = setup.space(&map).and_then(|space| setup.prepare(&space)).expect("an index");
            let (Some(starts), Some(goals)) = (vertices(rng, &map, setup, 3), vertices(rng, &map, setup, 9))
            else {
                continue;
            };
            let goals = index.goals(goals).expect("free goals");
            let mut planner = index.planner();
            for start in starts {
                check(&mut planner, &goals, start, &format!("{setup}, seed {seed}"));
                checked += 1;
            }
        }
        checked
    });
    assert!(checked.iter().sum::<u32>() > 500, "{checked:?}");
}

/// The index of an engine on a small map.
fn small(engine: Engine, motion: Motion) -> Index {
    let map = Map::from_rows(["..#.", "..#.", "...."]).expect("a map");
    map.space(motion).and_then(|space| space.prepare(engine)).expect("an index")
}

#[test]
fn goals_serve_every_index_of_their_map_and_motion() {
    let centers = Motion::new(K::N8, NEVER);
    let [labels, astar] = [Engine::Subgoal, Engine::AStar].map(|engine| small(engine, centers));
    for goals in [labels.goals([(3, 0), (0, 2)]), astar.goals([(3, 0), (0, 2)])] {
        let goals = goals.expect("free goals");
        for index in [&labels, &astar] {
            check(&mut index.planner(), &goals, Vertex::new(0, 0), "either");
        }
        let other = small(Engine::Subgoal, Motion::new(K::N8, OPEN));
        let (found, identity) = (other.planner().nearest((0, 0), &goals), goals.identity());
        let Err(Error::Mismatch(wrong)) = found else { panic!("{found:?}") };
        assert_eq!((wrong.belongs_to, wrong.other_belongs_to), (other.identity(), identity));
        assert!(other.planner().distances((0, 0), &goals).is_err());
    }
}

#[test]
fn bad_ends_and_no_goals() {
    for engine in [Engine::Subgoal, Engine::AStar] {
        let index = small(engine, Motion::new(K::N8, NEVER));
        let code = |goals: &[(i32, i32)]| {
            index.goals(goals.iter().copied()).map(|_| ()).map_err(|error| error.code())
        };
        assert_eq!(code(&[(0, 0), (2, 0)]), Err(ErrorCode::GoalBlocked));
        assert_eq!(code(&[(0, 0), (0, 3)]), Err(ErrorCode::GoalOutside));
        let none = index.goals([(0, 0); 0]).expect("no goals");
        let mut planner = index.planner();
        assert_eq!(planner.distances((0, 0), &none).ok(), Some(Vec::new()));
        assert_eq!(planner.nearest((0, 0), &none).ok(), Some(None));
        for goals in [none, index.goals([(0, 0)]).expect("a goal")] {
            let code = |error: Error| error.code();
            assert_eq!(planner.distances((2, 0), &goals).map_err(code), Err(ErrorCode::StartBlocked));
            assert_eq!(planner.nearest((9, 0), &goals).map_err(code), Err(ErrorCode::StartOutside));
        }
    }
}

/// Two goals at 2√2 at any angle: in sight, and around two corners.
#[test]
fn of_equally_near_goals_the_first_is_the_nearest() {
    let map = Map::from_rows(["..", "#.", "..", ".."]).expect("a map");
    let space = map.space(Motion::new(K::ANY, Rules::Corner(DiagonalGap::Closed))).expect("a space");
    for engine in [Engine::Subgoal, Engine::Anya] {
        let index = space.prepare(engine).expect("an index");
        for goals in [[(0, 4), (0, 0)], [(0, 0), (0, 4)]] {
            let goals = index.goals(goals).expect("free goals");
            let nearest = index.planner().nearest((2, 2), &goals).expect("a free start");
            let (number, length) = nearest.expect("there is a way");
            assert_eq!(number, 0, "{engine}");
            assert!((length - 8_f64.sqrt()).abs() < 1e-8, "{engine}: {length}");
        }
    }
}

#[test]
fn goals_are_shared_by_threads() {
    fn check<T: Clone + Send + Sync + 'static>(_: &T) {}
    let index = small(Engine::Subgoal, Motion::new(K::N8, NEVER));
    check(&index.goals([(0, 0)]).expect("a goal"));
}
