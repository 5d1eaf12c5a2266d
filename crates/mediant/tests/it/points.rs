//! Ends anywhere at the door: by every engine at any angle, with all wishes, in steps, after edits.

use mediant::{Answer, DiagonalGap, Engine, K, Limit, Limits, Map, Motion, Point, Query, errors::QueryError};
use mediant_oracle::{PointVisibility, Rng, describe_points, random_free_point, seeds, suite_grid};

fn point((x, y): (i64, i64)) -> Point {
    Point::from_parts(x, y)
}

fn parts(at: Point) -> (i64, i64) {
    at.parts()
}

/// The engines at any angle that take any point.
const ENGINES: [Engine; 2] = [Engine::Anya, Engine::Subgoal];

#[test]
fn every_engine_finds_the_shortest_path_of_several_ends() {
    let mut found = 0;
    for (seed, gap) in
        seeds(60).flat_map(|seed| [DiagonalGap::Open, DiagonalGap::Closed].map(|gap| (seed, gap)))
    {
        let (grid, mut rng) = (suite_grid(seed).0, Rng::new(seed));
        let oracle = PointVisibility::new(&grid, gap);
        let space = Map::from(grid.clone()).space(Motion::new(K::ANY, gap)).expect("any angle");
        for engine in ENGINES {
            let mut planner = space.planner(engine).expect("a small map");
            for _ in 0..6 {
                let ends: Vec<_> = (0..4).filter_map(|_| random_free_point(&mut rng, &grid)).collect();
                let [a, b, c, d] = ends[..] else { continue };
                let pairs = [(a, c), (b, c), (a, d), (b, d)];
                let expected =
                    pairs.iter().filter_map(|&(from, to)| oracle.cost(from, to)).min_by(f64::total_cmp);
                let query = Query::between([a, b].map(point), [c, d].map(point));
                let case = describe_points(&grid, gap, a, c, seed);
                let answer = planner.find(query.clone()).expect("all ends are free");
                let cost = answer.cost();
                let is_same = match (cost, expected) {
                    (Some(cost), Some(best)) => (cost - best).abs() <= 1e-9 * best,
                    (cost, best) => cost == best,
                };
                assert!(is_same, "{engine}: {cost:?}, not {expected:?}; {case}");
                if let Some(path) = answer.path() {
                    assert_eq!(space.check(path), Ok(()), "{path}; {case}");
                    let ends = [path.start(), path.goal()].map(|end| end.map(parts));
                    assert!([Some(a), Some(b)].contains(&ends[0]) && [Some(c), Some(d)].contains(&ends[1]));
                    found += 1;
                }
                planner.begin(query).expect("all ends are free");
                let mut in_steps = None;
                while in_steps.is_none() {
                    in_steps = planner.step(1).expect("a search was begun");
                }
                assert_eq!(in_steps.and_then(|answer| answer.cost()), cost, "{engine} in steps; {case}");
            }
        }
    }
    assert!(found > 800, "{found}");
}

#[test]
fn wishes_look_at_vertices_and_never_at_points_between() {
    let rows = ["....", ".##.", "...."];
    let space = Map::from_rows(rows).expect("a map").space(Motion::corners(K::ANY)).expect("any angle");
    for engine in ENGINES {
        let mut planner = space.planner(engine).expect("a small map");
        let mut find = |query: Query| planner.find(query).expect("the ends are on the map");
        let blocked = (1.5, 1.25);
        // Two vertices are equally near; the path to the second one is the shorter.
        let nearest = find(Query::new((3.75, 0.5), blocked).nearest());
        let Answer::Nearest(path) = nearest else { panic!("{nearest:?}") };
        assert_eq!(path.goal(), Some(Point::from((2, 1))));
        let snapped = find(Query::new((1.25, 1.25), (0.5, 0.5)).snap());
        assert_eq!(snapped.path().and_then(|path| path.start()), Some(Point::from((1, 1))));
        let tolerant = find(Query::new((0.25, 0.5), blocked).tolerance(0.6));
        assert_eq!(tolerant.path().and_then(|path| path.goal()), Some(Point::from((1, 1))));
        // A free goal between vertices may be taken itself.
        let tolerant = find(Query::new((0.5, 0.5), (0.5, 0.25)).tolerance(0.1));
        assert_eq!(tolerant.cost(), Some(0.25));
        let limited = find(Query::new((0.25, 1.5), (3.75, 1.5)).within(Limits::new().cost(3.0)));
        assert!(matches!(&limited, Answer::Stopped(stopped) if stopped.by == Limit::Cost), "{limited:?}");
        let Answer::Stopped(stopped) = limited else { panic!("it was stopped") };
        assert_eq!(stopped.best.start(), Some(Point::from((0.25, 1.5))));
        assert!(stopped.lower_bound >= 3.0 && stopped.lower_bound <= 4.0, "{}", stopped.lower_bound);
    }
    let error = space.planner(Engine::Anya).expect("Anya").find([blocked_point(), (0.0, 0.0)]).unwrap_err();
    assert!(matches!(error, QueryError::Blocked { .. }), "{error}");
}

fn blocked_point() -> (f64, f64) {
    (1.5, 1.5)
}

#[test]
fn after_an_edit_points_are_answered_on_the_new_map() {
    let space = Map::new(9, 9).expect("a map").space(Motion::corners(K::ANY)).expect("any angle");
    for engine in ENGINES {
        let index = space.prepare(engine).expect("a small map");
        let mut planner = index.planner();
        let query = || Query::new((0.5, 4.5), (8.5, 4.5));
        assert_eq!(planner.find(query()).expect("both are free").cost(), Some(8.0));
        let change = space.edit_cells([((4, 4), true)]).expect("a cell of the map");
        planner.follow(&index.repair(&change).expect("a change of this map")).expect("the same engine");
        let around = planner.find(query()).expect("both are free").cost().expect("there is a way");
        let expected = 2.0 * (3.5_f64.powi(2) + 0.25).sqrt() + 1.0;
        assert!((around - expected).abs() < 1e-9, "{engine}: {around}");
        assert!(!change.after().is_free((4.5, 4.5)) && change.after().is_free((4.0, 4.5)));
        assert!(!change.after().sees((0.5, 4.5), (8.5, 4.5)) && change.after().sees((0.5, 4.0), (8.5, 4.0)));
    }
}

#[test]
fn over_moves_and_between_centers_points_are_refused() {
    let map = Map::new(9, 9).expect("a map");
    for motion in [Motion::corners(3), Motion::centers(3)] {
        let space = map.space(motion).expect("a space");
        assert!(!space.is_free((0.5, 0.5)) && !space.sees((0.5, 0.5), (2, 2)));
        let mut planner = space.planner(Engine::AStar).expect("A*");
        for query in [Query::new((0.5, 0.5), (2, 2)), Query::new((0, 0), (2, 2.5)).snap().nearest()] {
            let error = planner.find(query).unwrap_err();
            assert!(matches!(error, QueryError::Between { .. }), "{error}");
        }
        assert!(planner.distance(((0, 0), (1, 0.5))).is_err());
    }
}
