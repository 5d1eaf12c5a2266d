//! Paths at any angle between the centers of cells: `Motion::centers(K::ANY)`.

use mediant::{
    Answer, CornerRule, DiagonalGap, Engine, ErrorCode, Guarantee, K, Limits, Map, Motion, Point, Query,
    Rules, Setup, Vertex,
};
use mediant_oracle::{
    PointVisibility, Rng, describe, magnified, random_free_point, random_free_vertex, random_vertex, seeds,
    suite_grid,
};

const GAPS: [DiagonalGap; 2] = [DiagonalGap::Open, DiagonalGap::Closed];

/// The engines that search it.
const ENGINES: [Engine; 2] = [Engine::Anya, Engine::Subgoal];

fn motion(gap: DiagonalGap) -> Motion {
    Motion::new(K::ANY, Rules::CenterGap(gap))
}

fn is_same(found: Option<f64>, expected: Option<f64>) -> bool {
    match (found, expected) {
        (Some(found), Some(expected)) => (found - expected).abs() <= 1e-9 * expected.max(1.0),
        (found, expected) => found == expected,
    }
}

/// The oracle's coordinates are those of corners, in parts of a cell.
fn parts(center: Vertex) -> (i64, i64) {
    Point::from(center).at_corners().parts()
}

#[test]
fn every_engine_finds_the_shortest_path_and_no_path_over_moves_is_shorter() {
    let mut found = 0;
    for (seed, gap) in seeds(80).flat_map(|seed| GAPS.map(|gap| (seed, gap))) {
        let (grid, mut rng) = (suite_grid(seed).0, Rng::new(seed));
        let oracle = PointVisibility::new(&grid, gap);
        let map = Map::from(grid.clone());
        let space = map.space(motion(gap)).expect("any angle between centers");
        let doubled = Map::from(magnified(&grid, 2)).space(Motion::new(K::ANY, gap)).expect("any angle");
        let mut doubled = doubled.planner(Engine::Anya).expect("Anya");
        let mut planners = ENGINES.map(|engine| space.planner(engine).expect("a small map"));
        // Of two paths over N(k) under rules that do not connect more.
        let rules = match gap {
            DiagonalGap::Open => [CornerRule::Always, CornerRule::One],
            DiagonalGap::Closed => [CornerRule::One, CornerRule::Never],
        };
        let over = rules.map(|rule| map.space(Motion::new(2 + (seed % 7) as u32, rule)).expect("a small k"));
        let mut over = over.map(|space| space.planner(Engine::AStar).expect("A*"));
        for _ in 0..8 {
            let free = |rng: &mut Rng| random_free_vertex(rng, &grid, mediant::PlacementKind::Center);
            let (Some(start), Some(goal)) = (free(&mut rng), free(&mut rng)) else { continue };
            let case = describe(&grid, Rules::CenterGap(gap), start, goal, seed);
            let expected = oracle.cost(parts(start), parts(goal));
            let twice = |at: Vertex| (2 * at.x + 1, 2 * at.y + 1);
            let at_corners = doubled.distance([twice(start), twice(goal)]).expect("free");
            assert!(is_same(at_corners.map(|cost| cost / 2.0), expected), "{at_corners:?}; {case}");
            assert_eq!(space.connected(start, goal), expected.is_some(), "{case}");
            for planner in &mut planners {
                let engine = planner.index().setup().engine.kind();
                let path = planner.path(start, goal).expect("both are free");
                let cost = path.as_ref().map(mediant::Path::cost);
                assert!(is_same(cost, expected), "{engine}: {cost:?}, not {expected:?}; {case}");
                assert_eq!(planner.distance([start, goal]).expect("free"), cost, "{engine}; {case}");
                let Some(path) = path else { continue };
                assert_eq!(space.check(&path), Ok(()), "{path}; {case}");
                let ends = [start, goal].map(|end| Some(Point::from(end)));
                assert_eq!([path.start(), path.goal()], ends, "{path}; {case}");
                let bends = path.points().skip(1).take(path.len().saturating_sub(2));
                assert!(bends.clone().all(|at| at.at_corners().vertex().is_some()), "{path}; {case}");
                assert_eq!(space.sees(start, goal), path.len() <= 2, "{path}; {case}");
                found += 1;
            }
            for planner in &mut over {
                let longer = planner.distance([start, goal]).expect("both are free");
                assert!(
                    longer.is_none_or(|longer| expected.is_some_and(|cost| cost <= longer * (1.0 + 1e-9))),
                    "{longer:?} over {}, {expected:?}; {case}",
                    planner.index().setup()
                );
            }
        }
    }
    assert!(found > 800, "{found}");
}

/// With gaps closed it connects what `never` and `one` do.
#[test]
fn what_is_connected_is_what_the_moves_connect() {
    for seed in seeds(60) {
        let (grid, mut rng) = (suite_grid(seed).0, Rng::new(seed));
        let map = Map::from(grid.clone());
        let spaces = [
            (Motion::centers(K::ANY), [CornerRule::Never, CornerRule::One].as_slice()),
            (motion(DiagonalGap::Open), &[CornerRule::Always]),
        ];
        for (motion, rules) in spaces {
            let space = map.space(motion).expect("any angle between centers");
            let over = |&rule| map.space(Motion::new(3, rule)).expect("k = 3");
            for over in rules.iter().map(over) {
                for _ in 0..20 {
                    let [a, b] =
                        [0; 2].map(|_| random_vertex(&mut rng, &grid, mediant::PlacementKind::Center));
                    assert_eq!(
                        space.connected(a, b),
                        over.connected(a, b),
                        "{motion}: {a}, {b}, seed {seed}"
                    );
                    assert_eq!(space.is_free(a), over.is_free(a), "{motion}: {a}, seed {seed}");
                }
            }
        }
    }
}

/// DESIGN §7: the optimum that N(k) between centers does not tend to.
#[test]
fn a_certificate_between_centers_is_the_optimum_or_the_straight_line() {
    let map = Map::from_rows([".@.", "..."]).expect("a map");
    let best = 1.0 + 2.0_f64.sqrt();
    let certified = |motion: Motion| {
        let mut planner = map.space(motion).expect("a space").planner(Engine::AStar).expect("A*");
        let answer = planner.find([(0, 0), (2, 0)]).expect("both are free");
        (answer.cost(), answer.any_angle_lower_bound(planner.guarantee(), motion.rules))
    };
    for k in 3..=8 {
        // Half of it is more than nothing, but 4/√2 is more than the optimum.
        assert_eq!(certified(Motion::centers(k)), (Some(4.0), Some(2.0)), "k = {k}");
    }
    let mut planner =
        map.space(Motion::centers(K::ANY)).expect("a space").planner(Engine::Anya).expect("Anya");
    assert_eq!((planner.guarantee(), planner.bound()), (Guarantee::OptimalAnyAngle, Some(1.0)));
    let answer = planner.find([(0, 0), (2, 0)]).expect("both are free");
    let rules = planner.index().setup().rules();
    assert_eq!(answer.any_angle_lower_bound(planner.guarantee(), rules), Some(best));
    assert_eq!(answer.cost(), Some(best));
    let path = answer.path().expect("there is a way");
    assert_eq!(path.to_string(), "(0, 0) → (0.5, 0.5) → (1.5, 0.5) → (2, 0)");
}

#[test]
fn wishes_look_at_centers() {
    let rows = ["....", ".##.", "...."];
    let map = Map::from_rows(rows).expect("a map");
    let space = map.space(Motion::centers(K::ANY)).expect("any angle");
    for engine in ENGINES {
        let mut planner = space.planner(engine).expect("a small map");
        let mut find = |query: Query| planner.find(query).expect("the ends are on the map");
        let Answer::Nearest(path) = find(Query::new((0, 0), (1.25, 1)).nearest()) else { panic!("{engine}") };
        assert!([(1, 0), (1, 2)].map(|at| Some(Point::from(at))).contains(&path.goal()), "{path}");
        let snapped = find(Query::new((1, 1), (-9, -9)).snap());
        assert_eq!(snapped.path().map(ToString::to_string).as_deref(), Some("(1, 0) → (0, 0)"));
        let tolerant = find(Query::new((0, 1), (2, 1)).tolerance(1.0));
        assert!(tolerant.path().is_some_and(|path| path.goal() == Some(Point::from((2, 0)))), "{tolerant}");
        // The edge of the map is half a cell from the centers beside it.
        assert_eq!(find(Query::new((-0.5, -0.5), (-0.5, 2.5))).cost(), Some(3.0));
        let limited = find(Query::new((0, 1), (3, 1)).within(Limits::new().cost(3.2)));
        let Answer::Stopped(stopped) = limited else { panic!("{engine}: {limited}") };
        assert_eq!(stopped.best.start(), Some(Point::from((0, 1))), "{}", stopped.best);
        assert!(stopped.lower_bound >= 3.2, "{}", stopped.lower_bound);
        let (starts, goals) = ([(0, 1), (0, 0)], [(3, 1), (3, 0), (0, 0)]);
        let index = space.prepare(engine).expect("a small map");
        let table = index.table(starts, goals).expect("all are free");
        let known = index.goals(goals).expect("all are free");
        for (row, start) in starts.into_iter().enumerate() {
            let one = goals.map(|goal| planner.distance([start, goal]).expect("free").expect("a way"));
            assert_eq!(
                (table.row(row), planner.distances(start, &known).expect("free")),
                (&one[..], one.to_vec())
            );
            assert_eq!(planner.nearest(start, &known).expect("free"), Some((2, one[2])), "{engine}");
        }
    }
    let error = space.path((0, 0), (4, 0)).unwrap_err();
    assert_eq!(error.code(), ErrorCode::GoalOutside);
    assert!(error.to_string().contains("run from (0, 0) to (3, 2)"), "{error}");
    let error = space.path((1, 1), (3, 0)).unwrap_err();
    assert!(error.code() == ErrorCode::StartBlocked && error.to_string().contains("(1, 1)"), "{error}");
    assert!(space.path((0.2, 0), (2.7, 0.3)).expect("both are free").is_some());
}

#[test]
fn an_index_is_saved_and_follows_edits() {
    let map = Map::from_fn(40, 30, |x, y| x == 20 && y % 7 != 3).expect("a map");
    let space = map.space(Motion::centers(K::ANY)).expect("any angle");
    let index = space.prepare(Engine::Subgoal).expect("subgoals");
    let bytes = index.to_bytes().expect("it is saved");
    let read = map.index_from_bytes(bytes.clone()).expect("it was saved");
    assert_eq!(read.space().motion(), Motion::centers(K::ANY));
    let query = || Query::new((0, 0), (39, 29));
    let expected = index.planner().find(query()).expect("free");
    assert_eq!(read.planner().find(query()).expect("free"), expected);
    let other = map.space(Motion::corners(K::ANY)).expect("any angle");
    assert_eq!(other.index_from_bytes(bytes).unwrap_err().code(), ErrorCode::Mismatch);
    for engine in ENGINES {
        let index = space.prepare(engine).expect("a small map");
        let mut planner = index.planner();
        let path = planner.path((0, 0), (39, 29)).expect("free").expect("there is a way");
        let change = space.edit_cells((0..30).map(|y| ((20, y), true))).expect("cells of the map");
        assert!(space.check(&path).is_ok() && change.after().check(&path).is_err());
        assert!(change.check(&path).is_err());
        planner.follow(&index.repair(&change).expect("a change of this map")).expect("the same engine");
        assert_eq!(planner.find(query()).expect("free"), Answer::Unreachable, "{engine}");
    }
}

#[test]
fn rules_of_the_other_motion_are_refused() {
    let map = Map::new(9, 9).expect("a map");
    let refused = [
        (Motion::new(K::ANY, CornerRule::Never), "gap"),
        (Motion::new(K::ANY, CornerRule::Always), "gap"),
        (Motion::new(3, Rules::CenterGap(DiagonalGap::Open)), "corners"),
    ];
    for (motion, word) in refused {
        let error = map.space(motion).unwrap_err();
        assert!(error.code() == ErrorCode::Motion && error.to_string().contains(word), "{motion}: {error}");
    }
    for (text, gap) in [("anya:any:center-open", GAPS[0]), ("subgoal:any:center-closed", GAPS[1])] {
        let setup: Setup = text.parse().expect("a setup");
        assert_eq!((setup.to_string().as_str(), setup.motion), (text, motion(gap)));
    }
    assert!("astar:3:center-open".parse::<Setup>().is_err() && "anya:any:never".parse::<Setup>().is_err());
}

#[test]
fn fields_lead_from_centers_to_sources_anywhere() {
    let mut known = 0;
    for (seed, gap) in seeds(40).flat_map(|seed| GAPS.map(|gap| (seed, gap))) {
        let (grid, mut rng) = (suite_grid(seed).0, Rng::new(seed));
        let oracle = PointVisibility::new(&grid, gap);
        let space = Map::from(grid.clone()).space(motion(gap)).expect("any angle between centers");
        let (Some(vertex), Some(point)) = (
            random_free_vertex(&mut rng, &grid, mediant::PlacementKind::Center),
            random_free_point(&mut rng, &grid),
        ) else {
            continue;
        };
        let sources = [Point::from(vertex), Point::from_parts(point.0, point.1).at_centers()];
        let field = space.field(sources).expect("two free sources");
        assert_eq!((field.sources(), field.identity()), (sources.to_vec(), space.identity()));
        let (lengths, allocation) = (field.lengths(), field.allocation());
        assert_eq!(lengths.len(), (field.width() * field.height()) as usize);
        let mut told = field.iter();
        for y in 0..field.height() as i32 {
            for x in 0..field.width() as i32 {
                let (at, number) = (Vertex::new(x, y), (y * field.width() as i32 + x) as usize);
                let costs = sources.map(|source| match grid.is_free(x, y) {
                    true => oracle.cost(parts(at), source.at_corners().parts()),
                    false => None,
                });
                let expected = costs.into_iter().flatten().min_by(f64::total_cmp);
                let case = describe(&grid, Rules::CenterGap(gap), at, vertex, seed);
                let found = field.get(at);
                assert!(is_same(found, expected), "{found:?}, not {expected:?} from {point:?}; {case}");
                assert_eq!(lengths[number], found.unwrap_or(f64::INFINITY), "{case}");
                let Some(found) = found else {
                    assert_eq!((field.path_from(at), allocation[number]), (None, None), "{case}");
                    continue;
                };
                assert_eq!(told.next(), Some((at, found)), "{case}");
                let path = field.path_from(at).expect("it has a distance");
                assert!(is_same(Some(path.length()), Some(found)), "{path}: {found}; {case}");
                assert_eq!((space.check(&path), path.start()), (Ok(()), Some(at.into())), "{path}; {case}");
                assert_eq!(path.goal(), field.nearest_source(at), "{path}; {case}");
                let source = allocation[number].map(|source| sources[source as usize]);
                assert_eq!(source, path.goal(), "{path}; {case}");
                known += 1;
            }
        }
        assert_eq!(told.next(), None, "seed {seed}");
        let limited = space.field_within(sources, 2.5).expect("a limit");
        let within = lengths.iter().filter(|&&length| length <= 2.5 * (1.0 + 1e-9)).count();
        assert_eq!(limited.iter().count(), within, "seed {seed}");
        // After an edit it is made anew.
        let cell = (rng.below(grid.width()) as i32, rng.below(grid.height()) as i32);
        let change = space.edit_cells([(cell, true)]).expect("a cell of the map");
        match (field.repair(&change), change.after().field(sources)) {
            (Ok(repaired), Ok(anew)) => assert_eq!(repaired.lengths(), anew.lengths(), "seed {seed}"),
            (Err(one), Err(other)) => assert_eq!(one.code(), other.code(), "seed {seed}"),
            (one, other) => panic!("{one:?}, {other:?}, seed {seed}"),
        }
    }
    assert!(known > 2_000, "{known}");
    let space = Map::from_rows(["..#"]).expect("a map").space(Motion::centers(K::ANY)).expect("any angle");
    for source in [(2.0, 0.0), (9.0, 0.0), (2.25, 0.0)] {
        let error = space.field([source]).unwrap_err();
        assert!(error.to_string().contains(&Point::from(source).to_string()), "{error}");
    }
}

/// Over N(k) an end outside the map is moved to a vertex of it first, at any angle to its edge.
#[test]
fn an_end_outside_the_map_is_moved_to_its_edge_first() {
    let map = Map::from_rows(["##", "#.", ".#"]).expect("a map");
    let start_of = |motion: Motion, engine: Engine| {
        let space = map.space(motion).expect("a space");
        let query = Query::new((-3, 1), (-3, 1)).snap();
        let answer = space.planner(engine).expect("it takes the motion").find(query).expect("free vertices");
        answer.path().and_then(mediant::Path::start)
    };
    assert_eq!(start_of(Motion::centers(K::N8), Engine::AStar), Some((1, 1).into()));
    for (gap, engine) in GAPS.into_iter().flat_map(|gap| ENGINES.map(|engine| (gap, engine))) {
        assert_eq!(start_of(motion(gap), engine), Some((0, 2).into()), "{gap}, {engine}");
    }
}
