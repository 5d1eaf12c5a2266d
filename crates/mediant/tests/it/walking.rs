//! Walking over elevation: spaces, queries, fields and errors, against the fields of the crate.

use std::sync::Arc;

use mediant::{
    Change, Engine, Error, ErrorCode, Exceptions, Ground, K, Langmuir, Limits, Map, Motion, Pace, Path,
    Point, Query, Rectangle, Space, Vertex, Walking,
    call::Call,
    errors::{QueryError, SetupError, WalkingError},
    files::{Georeference, Surface},
};
use mediant_costs::{CostFieldQuery, Heading, WalkingField, WalkingGraph, WalkingMap};
use mediant_grid::{CornerRule, Interrupt, Rules};
use mediant_oracle::{Rng, seeds};

use super::k;

/// A random map to walk on, at the door and in the crate.
struct World {
    space: Space,
    graph: Arc<WalkingGraph>,
    size: (u32, u32),
    about: String,
}

impl World {
    fn new(seed: u64) -> Self {
        let mut rng = Rng::new(seed);
        let size = (2 + rng.below(11), 2 + rng.below(11));
        let cells = (size.0 * size.1) as usize;
        let blocked: Vec<bool> = (0..cells).map(|_| rng.chance(6)).collect();
        let heights: Vec<f64> = (0..cells).map(|_| f64::from(rng.below(40)) / 4.0).collect();
        let frictions: Vec<f64> = (0..cells).map(|_| f64::from(rng.below(8)) / 16.0).collect();
        let pace = match seed % 3 {
            0 => Pace::Tobler,
            1 => Pace::Langmuir(Langmuir::default()),
            _ => Pace::Table(vec![(-1.0, 2.0), (0.0, 0.5), (2.0, 4.0)]),
        };
        let rough = seed % 2 == 1;
        let cell_size = (f64::from(20 + rng.below(20)), f64::from(20 + rng.below(20)));
        let (rule, k) = (CornerRule::ALL[(seed / 3 % 3) as usize], k(2 + (seed / 2 % 7) as u32));
        let motion = Motion::new(k, rule);
        let map = Map::from_bits(size.0, blocked.iter().copied()).expect("a small map");
        let about = format!("seed {seed}: {motion}, {pace:?}, rough: {rough}\n{map}\n{heights:?}");
        let walking = match rough {
            true => map.walking_with_friction(heights.clone(), frictions.clone(), cell_size, &pace),
            false => map.walking(heights.clone(), cell_size, &pace),
        };
        let walking = walking.unwrap_or_else(|error| panic!("{error}: {about}"));
        let ground = |x: u32, y: u32| {
            let at = (y * size.0 + x) as usize;
            (!blocked[at]).then_some((heights[at], if rough { frictions[at] } else { 0.0 }))
        };
        let ground = WalkingMap::with_friction(size, cell_size, &pace, &Interrupt::NEVER, ground);
        let ground = Arc::new(ground.expect("the same numbers"));
        assert_eq!(*ground, **walking.ground(), "{about}");
        let graph = WalkingGraph::new(ground, Rules::Center(rule), k).expect("a small k");
        let space = walking.space(motion).expect("a small k");
        Self { space, graph: Arc::new(graph), size, about }
    }

    fn vertices(&self) -> impl Iterator<Item = Vertex> + use<> {
        let (width, height) = self.size;
        (0..height as i32).flat_map(move |y| (0..width as i32).map(move |x| Vertex::new(x, y)))
    }

    fn free(&self, rng: &mut Rng, count: u32) -> Vec<Vertex> {
        let all: Vec<Vertex> = self.vertices().filter(|&at| self.space.is_free(at)).collect();
        (0..count).filter(|_| !all.is_empty()).map(|_| all[rng.below(all.len() as u32) as usize]).collect()
    }

    fn field(&self, heading: Heading, sources: &[Vertex]) -> WalkingField {
        let query = CostFieldQuery::new(sources).with_allocation();
        WalkingField::new(Arc::clone(&self.graph), heading, query, &Interrupt::NEVER).expect("free")
    }

    #[track_caller]
    fn check_path(&self, path: &Path, time: f64) {
        let replayed = self.graph.path_cost(path).map(|cost| self.graph.to_f64(cost));
        assert_eq!((replayed, path.cost()), (Some(time), time), "{path}: {}", self.about);
        assert_eq!(self.space.cost(path), Some(time), "{path}: {}", self.about);
        assert!(self.space.check(path).is_ok(), "{path}: {}", self.about);
    }
}

#[test]
fn fields_are_those_of_the_crate() {
    let mut reached = 0;
    for seed in seeds(90) {
        let (world, mut rng) = (World::new(seed), Rng::new(seed));
        let about = &world.about;
        let count = 1 + rng.below(3);
        let sources = world.free(&mut rng, count);
        let [to, from] = [Heading::ToSources, Heading::FromSources].map(|way| world.field(way, &sources));
        let field_to = world.space.field(sources.clone()).expect("free");
        let field_from = world.space.field_from(sources.clone()).expect("free");
        for (field, known) in [(&field_to, &to), (&field_from, &from)] {
            assert_eq!(field.identity(), world.space.identity(), "{about}");
            assert_eq!(field.lengths(), known.rows().collect::<Vec<_>>(), "{about}");
            assert!(field.iter().eq(known.iter()), "{about}");
            assert_eq!((field.width(), field.height()), world.size, "{about}");
            for at in world.vertices() {
                let source = known.allocation(at).map(|number| sources[number as usize].into());
                assert_eq!((field.get(at), field.nearest_source(at)), (known.get(at), source), "{about}");
                assert_eq!(field.next(at), known.next(at).map(Point::from), "{at}: {about}");
                reached += u32::from(source.is_some());
            }
        }
        for (at, time) in field_to.iter() {
            let path = field_to.path_from(at).unwrap_or_else(|| panic!("{at}: {about}"));
            world.check_path(&path, time);
            assert_eq!((path.waypoints()[0], field_to.path_to(at)), (at, None), "{about}");
        }
        for (at, time) in field_from.iter() {
            let path = field_from.path_to(at).unwrap_or_else(|| panic!("{at}: {about}"));
            world.check_path(&path, time);
            let end = path.waypoints().last().copied();
            assert_eq!((end, field_from.path_from(at)), (Some(at), None), "{about}");
        }
        let limit = field_from.iter().map(|(_, time)| time).fold(0.0, f64::max) * 0.5;
        let within = world.space.within(Limits::new()).field_from_within(sources.clone(), limit);
        let within = within.expect("free");
        for at in world.vertices() {
            let expected = field_from.get(at).filter(|&time| time <= limit * (1.0 + 1e-9));
            assert_eq!(within.get(at), expected, "{at} within {limit}: {about}");
        }
        let corridor = field_from.corridor(&field_to).expect("one heading each");
        assert_eq!(corridor, from.corridor(&to).expect("one heading each"), "{about}");
        assert_eq!(field_to.corridor(&field_to).unwrap_err().code(), ErrorCode::Mismatch, "{about}");
        if let &[only] = &sources[..] {
            let all = world.space.distances(Engine::Dijkstra, only).expect("free");
            assert!(field_from.iter().eq(all), "{about}");
        }
    }
    assert!(reached > 2_000, "only {reached}");
}

/// Queries with several ends, a tolerance, limits, tables and distances to many goals: each by the fields
/// from all starts.
#[test]
fn queries_lead_from_their_starts() {
    let mut differing = 0;
    for seed in seeds(60) {
        let (world, mut rng) = (World::new(seed), Rng::new(seed + 1));
        let about = &world.about;
        let (starts, goals) = (world.free(&mut rng, 3), world.free(&mut rng, 3));
        let [Some(&start), Some(&goal)] = [starts.first(), goals.first()] else { continue };
        let time = |start: Vertex, goal: Vertex| world.field(Heading::FromSources, &[start]).get(goal);
        differing += u32::from(time(start, goal) != time(goal, start));
        for engine in [Engine::AStar, Engine::Dijkstra] {
            let index = world.space.prepare(engine).expect("it walks");
            let mut planner = index.planner();
            for (&start, &goal) in starts.iter().zip(&goals) {
                let found = planner.path(start, goal).expect("free");
                assert_eq!(found.as_ref().map(Path::cost), time(start, goal), "{start} → {goal}: {about}");
                found.iter().for_each(|path| world.check_path(path, path.cost()));
                assert_eq!(planner.distance((start, goal)).expect("free"), time(start, goal), "{about}");
            }
            let least = |starts: &[Vertex], goals: &[Vertex]| {
                let pairs = starts.iter().flat_map(|&start| goals.iter().map(move |&goal| (start, goal)));
                pairs.filter_map(|(start, goal)| time(start, goal)).min_by(f64::total_cmp)
            };
            let found = planner.find(Query::between(starts.clone(), goals.clone())).expect("free");
            assert_eq!(found.cost(), least(&starts, &goals), "{about}");
            let around: Vec<Vertex> = world
                .vertices()
                .filter(|&at| world.space.is_free(at) && at.to(goal).norm_squared() <= 9)
                .collect();
            for limits in [Limits::new(), Limits::new().expansions(u64::MAX)] {
                let query = Query::new(start, goal).tolerance(3.0).within(limits);
                let found = planner.find(query).expect("free");
                assert_eq!(found.cost(), least(&[start], &around), "{start} → {goal}: {about}");
                found.path().iter().for_each(|path| world.check_path(path, path.cost()));
            }
            let table = index.table(starts.clone(), goals.clone()).expect("free");
            let prepared = index.goals(goals.clone()).expect("free");
            for (row, &start) in starts.iter().enumerate() {
                let expected: Vec<f64> =
                    goals.iter().map(|&goal| time(start, goal).unwrap_or(f64::INFINITY)).collect();
                assert_eq!(table.row(row), expected, "{about}");
                assert_eq!(planner.distances(start, &prepared).expect("free"), expected, "{about}");
                let nearest = planner.nearest(start, &prepared).expect("free").map(|(_, time)| time);
                assert_eq!(nearest, least(&[start], &goals), "{about}");
            }
            if let Some(whole) = time(start, goal).filter(|&time| time > 0.0) {
                let limited = |cost: f64| Query::new(start, goal).within(Limits::new().cost(cost));
                assert!(planner.find(limited(whole)).expect("free").path().is_some(), "{about}");
                let stopped = planner.find(limited(whole * 0.9)).expect("free");
                assert!(stopped.path().is_none(), "{stopped}: {about}");
            }
        }
    }
    assert!(differing > 20, "only {differing} ways and ways back differ");
}

fn hill() -> Walking {
    let heights = (0..12).map(|cell| f64::from(cell % 4));
    Map::new(4, 3).expect("a map").walking(heights, (10.0, 10.0), &Pace::Tobler).expect("a hill")
}

fn code<T: std::fmt::Debug>(result: Result<T, Error>) -> (ErrorCode, String) {
    let error = result.expect_err("it is wrong");
    (error.code(), error.to_string())
}

#[test]
fn bad_elevations_are_errors_that_say_what_to_do() {
    let map = Map::from_rows(["..", ".#"]).expect("a map");
    let walking = |heights: [f64; 4]| map.walking(heights, (10.0, 10.0), &Pace::Tobler);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let (code, text) = code(walking([0.0, bad, 0.0, 0.0]));
        assert!(code == ErrorCode::Cost && text.contains("(1, 0)") && text.contains("blocked"), "{text}");
        assert!(walking([0.0, 1.0, 0.0, bad]).is_ok(), "blocked cells are not looked at");
    }
    for wrong in [vec![0_u8; 3], vec![0; 5], Vec::new()] {
        let (code, text) = code(map.walking(wrong, (10.0, 10.0), &Pace::Tobler));
        assert!(code == ErrorCode::Cost && text.contains("elevations for 4 cells"), "{text}");
    }
    let rough = |friction: f64| map.walking_with_friction([0; 4], [friction; 4], (1.0, 1.0), &Pace::Tobler);
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(code(rough(bad)).0, ErrorCode::Cost);
    }
    let few = map.walking_with_friction([0; 4], [0.0; 3], (1.0, 1.0), &Pace::Tobler);
    assert!(matches!(few, Err(Error::Walking(WalkingError::Count { what: "frictions", .. }))));
    for size in [(0.0, 1.0), (1.0, -1.0), (f64::NAN, 1.0), (1.0, f64::INFINITY)] {
        assert_eq!(code(map.walking([0; 4], size, &Pace::Tobler)).0, ErrorCode::Number, "{size:?}");
    }
    for table in [vec![], vec![(1.0, 1.0), (0.0, 1.0)], vec![(0.0, -1.0)], vec![(0.0, f64::NAN)]] {
        let paced = map.walking([0, 1, 2, 3], (1.0, 1.0), &Pace::Table(table.clone()));
        assert_eq!(code(paced).0, ErrorCode::Number, "{table:?}");
    }
    // Downhill it would take less than no time.
    let steep =
        map.walking([0, 900, 0, 0], (1.0, 1.0), &Pace::Langmuir(Langmuir { d: 5.0, ..Langmuir::default() }));
    assert!(steep.is_err());
    let unknown = "naismith".parse::<Pace>().map_err(Error::from);
    assert_eq!(unknown.map_err(|error| error.code()), Err(ErrorCode::UnknownName));
    let stop = Limits::new().deadline(|| true);
    assert_eq!(code(map.within(&stop).walking([0; 4], (1.0, 1.0), &Pace::Tobler)).0, ErrorCode::Stopped);
    let space = hill().within(Limits::new()).space(3).expect("nothing stops it");
    assert_eq!(code(space.within(&stop).field_from([(0, 0)])).0, ErrorCode::Stopped);
    assert_eq!(code(space.within(&stop).path((0, 0), (3, 2))).0, ErrorCode::Stopped);
}

#[test]
fn rasters_of_elevations_are_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let heights = Surface::new(3, 2, vec![1_i16, 2, 3, -99, 5, 6]).expect("six").with_no_data(Some(-99.0));
    let placed = heights.clone().with_georeference(Georeference::from_cell_size(30.0, 20.0).expect("a size"));
    let friction = Surface::new(3, 2, vec![0.5, 0.5, f64::NAN, 0.5, 0.0, 0.0]).expect("six");
    for name in ["dem.tif", "dem.asc"] {
        let file = folder.path().join(name);
        placed.save(&file).expect("a file");
        let (walking, place) = Walking::open(&file, &Pace::Tobler).expect("elevations");
        assert_eq!((walking.cell_size(), place.cell_size()), ((30.0, 20.0), Some((30.0, 20.0))));
        let found = [(0, 0), (0, 1), (2, 1)].map(|at| walking.elevation(at));
        assert_eq!(found, [Some(1.0), None, Some(6.0)]);
    }
    let map = Map::from_rows(["...", ".#."]).expect("a map");
    let rough = map.walking_of(&placed, Some(&friction), &Pace::Tobler).expect("the same size");
    let blocked: Vec<bool> = (0..6).map(|at| rough.map().is_blocked((at % 3, at / 3))).collect();
    assert_eq!(blocked, [false, false, true, true, true, false]);
    assert_eq!((rough.friction((0, 0)), rough.friction((2, 1))), (Some(0.5), Some(0.0)));
    let file = folder.path().join("dem.npy");
    heights.save(&file).expect("a file");
    let (code_of, text) = code(Walking::open(&file, &Pace::Tobler));
    assert!(code_of == ErrorCode::Cost && text.contains("dem.npy") && text.contains("size"), "{text}");
    let other = Map::new(2, 2).expect("a map").walking_of(&placed, None, &Pace::Tobler);
    assert!(matches!(other, Err(Error::OtherSize { .. })));
}

#[test]
fn what_there_is_not_over_elevation_is_refused() {
    let (walking, space) = (hill(), hill().space(3).expect("k = 3"));
    assert_eq!(code(walking.space(Motion::corners(4))).0, ErrorCode::Motion);
    for motion in [Motion::centers(9), Motion::centers(K::ANY)] {
        let error = walking.space(motion).expect_err("too many");
        assert!(matches!(error, Error::Setup(SetupError::CostsK { max: 8, .. })), "{error}");
    }
    assert_eq!(code(walking.space(-1)).0, ErrorCode::K);
    assert_eq!((space.walking(), space.costs()), (Some(&walking), None));
    assert_ne!(space.identity(), walking.map().space(3).expect("k = 3").identity());
    for engine in Engine::ALL {
        let index = space.prepare(engine);
        match engine {
            Engine::AStar | Engine::Dijkstra => assert!(index.is_ok(), "{engine}"),
            _ => assert_eq!(code(index).0, ErrorCode::EngineWithout, "{engine}"),
        }
    }
    let index = space.prepare(space.engine()).expect("auto");
    assert_eq!(code(index.to_bytes()).0, ErrorCode::EngineWithout);
    assert_eq!(code(space.edit(Rectangle::new(0, 0, 1, 1), |_, _| true)).0, ErrorCode::EngineWithout);
    assert_eq!(code(space.edit_cells([((0, 0), true)])).0, ErrorCode::EngineWithout);
    assert_eq!(code(space.edit_costs([((0, 0), Some(1.0))])).0, ErrorCode::EngineWithout);
    assert_eq!(code(space.widest_path((0, 0), (2, 0), 0.5)).0, ErrorCode::EngineWithout);
    let except = index.planner().find_except([(0, 0), (2, 0)], &Exceptions::new());
    assert_eq!(code(except).0, ErrorCode::EngineWithout);
    let blocked = Map::from_rows(["#."]).expect("a map").walking([0, 0], (1.0, 1.0), &Pace::Tobler);
    let blocked = blocked.and_then(|walking| walking.space(3)).expect("k = 3");
    let outside = |error: Error| error.code();
    assert_eq!(blocked.path((0, 0), (1, 0)).map_err(outside), Err(ErrorCode::StartBlocked));
    assert_eq!(blocked.path((1, 0), (2, 0)).map_err(outside), Err(ErrorCode::GoalOutside));
    assert_eq!(code(blocked.field_from([(0, 0)])).0, ErrorCode::StartBlocked);
    assert_eq!(code(space.field_from_within([(0, 0)], -1.0)).0, ErrorCode::Number);
    assert_eq!(code(space.field_from_within([(0, 0)], f64::NAN)).0, ErrorCode::Number);
    assert!(space.cost(&Path::new(vec![(i32::MIN, 0).into(), (i32::MAX, 3).into()])).is_none());
    let plain = walking.map().space(3).expect("k = 3");
    let (field, other) = (space.field([(0, 0)]).expect("free"), plain.field([(0, 0)]).expect("free"));
    assert_eq!(code(field.corridor(&other)).0, ErrorCode::Mismatch);
    assert!(field.path_from((9, 9)).is_none() && other.path_to((1, 0)).is_some());
    let smooth = index.planner().find([(0, 0), (4, 0)]);
    assert!(matches!(smooth, Err(QueryError::Outside { .. })));
}

/// An index and a field follow to other elevations, or to none.
#[test]
fn what_was_prepared_follows_to_other_elevations() {
    let spaces = [0, 2].map(|more| {
        let heights = (0..12).map(|cell| f64::from(cell % 4 * more));
        let walking = Map::new(4, 3).expect("a map").walking(heights, (10.0, 10.0), &Pace::Tobler);
        walking.and_then(|walking| walking.space(3)).expect("k = 3")
    });
    let [flat, steep] = &spaces;
    let change = Change::between(flat, steep).expect("the same motion");
    let index = flat.prepare(Engine::AStar).expect("it walks");
    let mut planner = index.planner();
    let repaired = index.repair(&change).expect("it follows");
    planner.follow(&repaired).expect("it follows");
    let anew = steep.path((0, 0), (3, 1)).expect("free");
    assert_eq!(planner.path((0, 0), (3, 1)).expect("free"), anew);
    for (field, expected) in [
        (flat.field([(0, 0)]), steep.field([(0, 0)])),
        (flat.field_from([(0, 0)]), steep.field_from([(0, 0)])),
    ] {
        let repaired = field.expect("free").repair(&change).expect("it follows");
        assert_eq!(repaired.lengths(), expected.expect("free").lengths());
    }
    let other = index.for_k(K::N16).expect("k = 4");
    assert_eq!(other.space().walking(), flat.walking());
}

/// Spaces and planners are kept, without the map that keeps them; there is nothing saved and no edit.
#[test]
fn a_ground_of_elevations_keeps_its_planners() {
    let walking = hill();
    let ground = Ground::from(walking.clone());
    assert_eq!((ground.walking(), ground.costs(), ground.map()), (Some(&walking), None, walking.map()));
    let setup = ground.setup(&Call::default()).expect("k = 3");
    assert_eq!((setup.engine.kind(), setup.motion), (Engine::AStar, Motion::centers(3)));
    assert!(ground.kept_space(setup.motion).is_none() && ground.kept_planners(&setup).is_none());
    let planners = ground.keep_planners(&setup, Limits::new()).expect("k = 3");
    assert!(Arc::ptr_eq(&planners, &ground.keep_planners(&setup, Limits::new()).expect("k = 3")));
    let space = ground.kept_space(setup.motion).expect("it is kept");
    assert_eq!(space.walking(), Some(&walking));
    for ends in [[(0, 0), (3, 2)], [(3, 2), (0, 0)]] {
        let found = planners.find(ends).expect("free");
        let wanted = space.path(ends[0], ends[1]).expect("free").map(|path| path.cost());
        assert_eq!(found.cost(), wanted);
    }
    let jumps = ground.setup(&Call::default().with_engine(Some(Engine::Jps))).expect("a setup");
    assert!(matches!(ground.keep_planners(&jumps, Limits::new()), Err(Error::Setup(_))));
    let all = Rectangle::new(0, 0, 4, 3);
    assert_eq!(code(ground.edit(all, |_, _| true)).0, ErrorCode::EngineWithout);
    assert_eq!(code(ground.edit_cells([((0, 0), true)])).0, ErrorCode::EngineWithout);
    assert!(ground.edit_costs([((0, 0), Some(1.0))]).is_err());
    assert_eq!(code(ground.load("no such file", Limits::new())).0, ErrorCode::EngineWithout);
    assert_eq!(code(ground.index_from_bytes(vec![1], Limits::new())).0, ErrorCode::EngineWithout);
    drop((planners, space));
    let kept = Arc::downgrade(walking.ground());
    drop((ground, walking));
    assert!(kept.upgrade().is_none());
}

#[test]
fn copies_are_equal() {
    let heights = [0.1, 7.3, 2.9, 4.0, 4.1, 0.7];
    let map = Map::from_rows(["...", ".#."]).expect("a map");
    let at = |x: u32, y: u32| (y * 3 + x) as usize;
    let (size, pace, limits) = ((20.0, 30.0), Pace::Langmuir(Langmuir::default()), Limits::new());
    let ground = |x: u32, y: u32| (heights[at(x, y)], heights[at(x, y)] / 70.0);
    let walking = map.walking_by(size, &pace, &limits, ground).expect("elevations");
    let frictions = heights.map(|height| height / 70.0);
    assert_eq!(map.walking_with_friction(heights, frictions, size, &pace).ok().as_ref(), Some(&walking));
    assert_eq!((walking.pace(), walking.ground_bounds().elevation), (&pace, (0.1, 7.3)));
    let again = |x: u32, y: u32| {
        let at = (x as i32, y as i32);
        (walking.elevation(at).expect("free"), walking.friction(at).expect("free"))
    };
    let copy = map.walking_in(walking.ground_bounds(), size, &pace, &limits, again);
    assert_eq!(copy.ok().as_ref(), Some(&walking));
    let stop = Limits::new().deadline(|| true);
    assert_eq!(code(map.walking_by(size, &pace, &stop, ground)).0, ErrorCode::Stopped);
}
