//! Ends anywhere at the door: by every engine at any angle, with all wishes, in steps, after edits.

use mediant::{
    Answer, Change, DiagonalGap, DirectionCode, Engine, ErrorCode, K, Limit, Limits, Map, Motion, Point,
    Query, errors::QueryError,
};
use mediant_oracle::{
    PointVisibility, Rng, describe_points, random_change, random_free_point, seeds, suite_grid,
};

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

/// Distances, paths, allocation and directions, from points and vertices mixed, in a space and within limits.
#[test]
fn fields_from_points_are_the_distances_of_paths() {
    let (mut reached, mut far) = ([0; 2], 0);
    for (seed, gap) in
        seeds(40).flat_map(|seed| [DiagonalGap::Open, DiagonalGap::Closed].map(|gap| (seed, gap)))
    {
        let (grid, mut rng) = (suite_grid(seed).0, Rng::new(seed));
        let oracle = PointVisibility::new(&grid, gap);
        let space = Map::from(grid.clone()).space(Motion::new(K::ANY, gap)).expect("any angle");
        let sources: Vec<_> = (0..3).filter_map(|_| random_free_point(&mut rng, &grid)).collect();
        let Some(&first) = sources.first() else { continue };
        let case = format!("from {sources:?}: {}", describe_points(&grid, gap, first, first, seed));
        let from: Vec<Point> = sources.iter().copied().map(point).collect();
        let costs: Vec<_> = sources.iter().map(|&source| oracle.costs_from(source)).collect();
        let field = space.field(&from).expect("free sources");
        assert_eq!(field.sources(), from, "{case}");
        let (width, height) = (field.width() as i32, field.height() as i32);
        let vertices = (0..height).flat_map(|y| (0..width).map(move |x| Point::from((x, y))));
        let asked = (0..10).filter_map(|_| random_free_point(&mut rng, &grid)).map(point);
        let allocation = field.allocation();
        let directions = field.directions(DirectionCode::ArcGisDegrees);
        let same = |a: Option<f64>, b: Option<f64>| {
            a.zip(b).map_or(a == b, |(a, b)| (a - b).abs() <= 1e-9 * b.max(1e-9))
        };
        for (number, at) in vertices.chain(asked).enumerate() {
            let best = costs.iter().filter_map(|costs| costs.to(parts(at))).min_by(f64::total_cmp);
            assert!(same(field.get(at), best), "{at}: {:?}, not {best:?}; {case}", field.get(at));
            let (path, back) = (field.path_from(at), field.path_to(at));
            assert!(same(path.as_ref().map(|path| path.cost()), best), "{at}; {case}");
            assert_eq!(back.map(|path| path.reversed()), path, "{at}; {case}");
            let source = field.nearest_source(at);
            assert_eq!(path.as_ref().and_then(|path| path.goal()), source, "{at}; {case}");
            if let Some(path) = &path {
                assert_eq!(space.check(path), Ok(()), "{path}; {case}");
                assert_eq!(field.next(at).is_some(), path.len() > 1, "{path}; {case}");
                reached[usize::from(at.vertex().is_none())] += 1;
            }
            if let Some(&known) = allocation.get(number) {
                let known = known.map(|number| from[number as usize]);
                assert_eq!(known, source, "{at}; {case}");
                let degrees = |(x, y): (f64, f64)| x.atan2(-y).to_degrees().rem_euclid(360.0);
                let expected = field.direction(at).map(degrees);
                let told = Some(directions[number]).filter(|_| field.next(at).is_some());
                let turn = |a: f64, b: f64| ((a - b + 180.0).rem_euclid(360.0) - 180.0).abs();
                let is_same = told.zip(expected).map_or(told == expected, |(a, b)| turn(a, b) < 1e-6);
                assert!(is_same, "{at}: {told:?}, not {expected:?}; {case}");
            }
        }
        let Some(limit) = field.iter().map(|(_, length)| length * 0.5).reduce(f64::max) else { continue };
        let cancelled = Limits::new().cancel(Default::default());
        let near = space.within(cancelled).field_within(&from, limit).expect("free sources");
        let within = field.iter().filter(|&(_, length)| length <= limit * (1.0 + 2_f64.powi(-31)));
        assert!(near.iter().eq(within), "within {limit}; {case}");
        far += field.iter().count() - near.iter().count();
    }
    assert!(reached.iter().all(|&count| count > 200) && far > 200, "{reached:?}, {far}");
}

#[test]
fn fields_take_points_at_any_angle_alone() {
    let at = (0.5, 1.0);
    let blank = Map::from_fn(5, 4, |_, _| false).expect("a small map");
    let on_costs = blank.clone().costs([1; 20]).expect("a cost a cell");
    let spaces = [
        blank.space(Motion::default()),
        blank.space(Motion::new(K::N8, DiagonalGap::Open)),
        on_costs.space(Motion::default()),
    ];
    for space in spaces.map(|space| space.expect("a motion")) {
        for error in [space.field([at]).err(), space.field_from_within([at], 3.0).err()] {
            assert_eq!(error.map(|error| error.code()), Some(ErrorCode::Between), "{}", space.motion());
        }
        let field = space.field([(0, 1)]).expect("a free source");
        assert_eq!((field.get(at), field.next(at), field.path_from(at)), (None, None, None));
        assert_eq!(field.get((1.0, 1.0)), field.get((1, 1)));
    }
}

#[test]
fn fields_from_points_follow_edits() {
    let mut same = 0;
    for seed in seeds(40) {
        let (grid, mut rng) = (suite_grid(seed).0, Rng::new(seed));
        let gap = [DiagonalGap::Open, DiagonalGap::Closed][seed as usize % 2];
        let mut space = Map::from(grid.clone()).space(Motion::new(K::ANY, gap)).expect("any angle");
        let sources: Vec<Point> =
            (0..2).filter_map(|_| random_free_point(&mut rng, &grid)).map(point).collect();
        let limit = f64::from(rng.below(12)) + 0.3;
        let mut field = space.field_within(&sources, limit).expect("free sources");
        for _ in 0..10 {
            let edit = random_change(&mut rng, space.map().grid());
            let new =
                Map::from(edit.after().as_ref().clone()).space(space.motion()).expect("the same motion");
            let change = Change::between(&space, &new).expect("the same motion");
            match (field.repair(&change), new.field_within(&sources, limit)) {
                (Ok(repaired), Ok(expected)) => {
                    assert!(repaired.lengths() == expected.lengths(), "seed {seed}, from {sources:?}");
                    assert_eq!(repaired.sources(), sources);
                    for at in (0..6).filter_map(|_| random_free_point(&mut rng, new.map().grid())).map(point)
                    {
                        assert_eq!(repaired.path_from(at), expected.path_from(at), "seed {seed}, {at}");
                    }
                    (field, space) = (repaired, change.after().clone());
                    same += 1;
                }
                (repaired, expected) => {
                    let [found, expected] = [repaired, expected].map(|it| it.err().map(|it| it.to_string()));
                    assert_eq!(found, expected, "seed {seed}");
                }
            }
        }
    }
    assert!(same > 100, "{same}");
}

/// A limit that is a path's own length lets it through, however near its ends are to each other: the
/// rounding of its cost is then more than the 2⁻³¹ of itself by which a limit is longer.
#[test]
fn a_limit_at_the_length_between_the_nearest_points_is_met() {
    let space = Map::from_rows(["...", "...", "..."]).expect("a map");
    let space = space.space(Motion::corners(K::ANY)).expect("any angle");
    let near = 1.0 / 1024.0;
    for engine in ENGINES {
        let mut planner = space.planner(engine).expect("a small map");
        for (dx, dy) in [(1.0, 0.0), (1.0, 1.0), (2.0, 1.0), (3.0, 2.0), (5.0, 3.0), (13.0, 8.0)] {
            let (start, goal) = ((1.25, 1.25), (1.25 + dx * near, 1.25 + dy * near));
            let length = planner.path(start, goal).expect("free ends").expect("open ground").cost();
            let mut within = |cost| {
                let query = Query::new(start, goal).within(Limits::new().cost(cost));
                planner.find(query).expect("free ends").path().is_some()
            };
            assert!(within(length), "{engine}: {dx}, {dy}");
            assert!(!within(length * 0.999), "{engine}: {dx}, {dy}");
        }
    }
}
