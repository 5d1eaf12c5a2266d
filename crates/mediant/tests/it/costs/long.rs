//! Costs with longer sides than maps without costs may have.

use std::sync::Arc;

use mediant::{
    Answer, Change, Costmap, Costs, Engine, Error, ErrorCode, Field, Inflation, K, Limits, Map, Motion, Path,
    PlacementKind, Query, Rectangle, Rules, Smoothing, Space, Vertex,
    errors::SetupError,
    files::{Georeference, Surface},
    grid::{Clearance, Fit, Grid, Outside},
};
use mediant_costs::{CostAStar, CostField, CostFieldQuery, CostGraph, CostSurface};
use mediant_grid::{Change as GridChange, Interrupt};
use mediant_oracle::{Rng, random_free_vertex, seeds};
use mediant_search::Planner as _;

use crate::k;

/// A side a little longer than [`Grid::MAX_SIDE`], or beyond the numbers of 16 bits.
const SIZES: [(u32, u32); 3] = [(33_000, 5), (5, 33_000), (66_000, 2)];

/// The cells for one wall: so many that the long way stays open on most maps.
const FEW: [u64; 3] = [50, 50, 4001];

/// The cost of a cell by a seed.
fn cost(seed: u64, x: u32, y: u32) -> Option<f64> {
    let word =
        (u64::from(x) << 32 | u64::from(y)).wrapping_add(seed << 20).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let word = (word ^ word >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 40;
    (word % FEW[(seed % 3) as usize] != 0).then_some((1 + word / 8192 % 9) as f64)
}

struct Strip {
    costs: Costs,
    space: Space,
    motion: Motion,
    about: String,
}

impl Strip {
    fn new(seed: u64) -> Self {
        let (size, rules) = (SIZES[(seed % 3) as usize], Rules::ALL[(2 * seed % 5) as usize]);
        let motion = Motion::new(k(2 + (seed % 4) as u32), rules);
        let costs = Costs::from_fn(size.0, size.1, |x, y| cost(seed, x, y)).expect("a size of costs");
        let space = costs.space(motion).expect("a small k");
        Self { costs, space, motion, about: format!("seed {seed}: {size:?}, {motion}") }
    }

    fn free(&self, rng: &mut Rng) -> Vertex {
        let placement = self.motion.rules.placement();
        random_free_vertex(rng, self.costs.map().grid(), placement).expect("free cells")
    }

    /// A free vertex at the far end.
    fn far(&self, seed: u64) -> Vertex {
        let (width, height) = (self.costs.map().width() as i32, self.costs.map().height() as i32);
        let mut rng = Rng::new(seed);
        loop {
            let back = |side: i32, rng: &mut Rng| side - 1 - rng.below(side.min(60) as u32) as i32;
            let at = Vertex::new(back(width, &mut rng), back(height, &mut rng));
            if self.space.is_free(at) {
                return at;
            }
        }
    }
}

fn turned(at: Vertex) -> Vertex {
    Vertex::new(at.y, at.x)
}

#[test]
fn fields_and_paths_are_those_of_the_typed_crate_and_of_the_map_turned() {
    let mut found = 0;
    for seed in seeds(3) {
        let strip = Strip::new(seed);
        let about = &strip.about;
        let mut rng = Rng::new(seed);
        let (width, height) = (strip.costs.map().width(), strip.costs.map().height());
        let typed =
            Arc::new(CostSurface::from_fn(width, height, |x, y| cost(seed, x, y)).expect("a surface"));
        assert_eq!(typed.id(), strip.costs.id(), "{about}");
        let finite = strip.motion.k.finite().expect("a finite k");
        let graph = Arc::new(CostGraph::new(typed, strip.motion.rules, finite).expect("a small k"));
        let (far, near) = (strip.far(seed), strip.free(&mut rng));
        let field = strip.space.field([far]).expect("free");
        let expected = CostField::new(Arc::clone(&graph), CostFieldQuery::new(&[far]), &Interrupt::NEVER);
        let lengths = field.lengths();
        assert_eq!(lengths, expected.expect("free").into_rows(), "{about}");
        let other = Costs::from_fn(height, width, |x, y| cost(seed, y, x)).expect("a size of costs");
        let other = other.space(strip.motion).expect("a small k");
        let field_turned = other.field([turned(far)]).expect("free");
        for (number, &length) in lengths.iter().enumerate() {
            let columns = field.width() as usize;
            let at = Vertex::new((number % columns) as i32, (number / columns) as i32);
            let is_reached = length.is_finite();
            assert_eq!(field_turned.get(turned(at)), is_reached.then_some(length), "{at}: {about}");
            // Whether there is a way is known from components alone.
            if number % 37 == 0 {
                assert_eq!(strip.space.connected(at, far), is_reached, "{at}: {about}");
            }
        }
        let mut planners = [Engine::AStar, Engine::Dijkstra, Engine::Landmarks]
            .map(|engine| strip.space.planner(engine).expect("it takes long maps"));
        for goal in [near, strip.far(seed + 1000)] {
            let known = field.get(goal);
            let mut planner = CostAStar::new(Arc::clone(&graph));
            let typed = planner.solve((far, goal).into()).expect("both are free");
            assert_eq!(typed.path().map(Path::cost), known, "{goal}: {about}");
            for planner in &mut planners {
                let engine = planner.index().setup().engine.kind();
                let answer = planner.find((far, goal)).expect("both are free");
                assert_eq!(answer.cost(), known, "{engine} to {goal}: {about}");
                let Some(path) = answer.path() else { continue };
                assert_eq!(strip.space.check(path), Ok(()), "{engine} to {goal}: {about}");
                assert_eq!(strip.space.cost(path), known, "{engine} to {goal}: {about}");
                assert!(!strip.space.crossings(path).expect("costs").is_empty() || far == goal, "{about}");
                found += 1;
            }
            if let (Some(cost), Some(path)) = (known, field.path_from(goal)) {
                assert_eq!((path.cost(), strip.space.check(&path)), (cost, Ok(())), "{goal}: {about}");
            }
        }
    }
    assert!(found > 15, "{found} paths");
}

/// The field and the paths within a limit, in a part of the map that the limit does not lead out of.
#[test]
fn the_far_end_is_as_in_a_map_of_it_alone() {
    const SIDE: u32 = 300;
    let mut reached = 0;
    for seed in seeds(6) {
        let strip = Strip::new(seed);
        let (width, height) = (strip.costs.map().width(), strip.costs.map().height());
        let (left, top) = (width.saturating_sub(SIDE), height.saturating_sub(SIDE));
        let part = Costs::from_fn(width.min(SIDE), height.min(SIDE), |x, y| cost(seed, left + x, top + y))
            .expect("costs");
        let part = part.space(strip.motion).expect("a small k");
        let far = strip.far(seed);
        let moved = |at: Vertex| Vertex::new(at.x - left as i32, at.y - top as i32);
        let limit = f64::from(SIDE - 90);
        let field = strip.space.field_within([far], limit).expect("free");
        let expected = part.field_within([moved(far)], limit).expect("free");
        let listed: Vec<_> = field.iter().map(|(at, cost)| (moved(at), cost)).collect();
        // Their units differ: those of the larger map are larger.
        let near = |one: f64, other: f64| (one - other).abs() <= 1e-6 * one.max(other);
        for (found, expected) in listed.iter().zip(expected.iter()) {
            let is_same = found.0 == expected.0 && near(found.1, expected.1);
            assert!(is_same, "{found:?}, {expected:?}: {}", strip.about);
        }
        assert_eq!(listed.len(), expected.iter().count(), "{}", strip.about);
        reached += listed.len();
        let mut planner = strip.space.planner(Engine::AStar).expect("it takes long maps");
        let mut rng = Rng::new(seed);
        for _ in 0..8 {
            let goal = listed[rng.below(listed.len() as u32) as usize].0;
            let goal = Vertex::new(goal.x + left as i32, goal.y + top as i32);
            let limits = Limits::new().cost(limit);
            let answer = planner.find(Query::new(far, goal).within(limits)).expect("free");
            let Answer::Found(path) = answer else { panic!("{goal} is within the limit: {}", strip.about) };
            assert!(near(path.cost(), expected.get(moved(goal)).expect("within")), "{}", strip.about);
        }
    }
    assert!(reached > 500, "{reached}");
}

#[test]
fn edits_near_the_far_end_are_followed() {
    for seed in seeds(3) {
        let strip = Strip::new(seed);
        let mut rng = Rng::new(seed);
        let (mut space, far) = (strip.space.clone(), strip.far(seed));
        let mut planners =
            [Engine::AStar, Engine::Landmarks].map(|engine| space.planner(engine).expect("long"));
        let mut field = space.field_within([far], 400.0).expect("free");
        for edit in 0..2 {
            let about = format!("edit {edit}: {}", strip.about);
            let cells: Vec<(Vertex, Option<f64>)> = (0..12)
                .map(|number| strip.far(seed * 100 + edit * 20 + number))
                .filter(|&at| strip.costs.cost(at).is_some() && at != far)
                .map(|at| (at, [None, Some(1.0), Some(9.0)][rng.below(3) as usize]))
                .collect();
            let change = space.edit_costs(cells.iter().copied()).expect("within the bounds");
            let costs = space.costs().expect("costs").edit_cells(cells.iter().copied()).expect("the same");
            let anew = costs.space(strip.motion).expect("a small k");
            assert_eq!(change.after().identity(), anew.identity(), "{about}");
            assert_eq!(change.after().map(), anew.map(), "{about}");
            let scratch = Costs::from_fn(costs.map().width(), costs.map().height(), |x, y| {
                costs.cost((x as i32, y as i32))
            });
            assert_eq!(scratch.expect("costs").map().id(), costs.map().id(), "{about}");
            space = change.after().clone();
            if !space.is_free(far) {
                break;
            }
            for planner in &mut planners {
                let index = planner.index().repair(&change).expect("a change of its space");
                planner.follow(&index).expect("the same engine");
            }
            field = field.repair(&change).expect("the source is free");
            let all = anew.field([far]).expect("free");
            for (at, cost) in field.iter() {
                assert_eq!(all.get(at), Some(cost), "{at}: {about}");
            }
            for number in 0..5 {
                let goal = strip.far(seed * 1000 + number);
                if !space.is_free(goal) {
                    continue;
                }
                assert_eq!(space.connected(far, goal), all.get(goal).is_some(), "{goal}: {about}");
                for planner in &mut planners {
                    let answer = planner.find((far, goal)).expect("both are free");
                    assert_eq!(answer.cost(), all.get(goal), "{goal}: {about}");
                }
            }
        }
    }
}

#[track_caller]
fn refused<T>(result: Result<T, impl Into<Error>>, what: &str) {
    let Err(error) = result else { panic!("{what} takes a long map") };
    let error = error.into();
    let text = error.to_string();
    assert_eq!(error.code(), ErrorCode::MapSize, "{what}: {text}");
    let says = |word: &str| assert!(text.contains(word), "{what}: no `{word}` in: {text}");
    ["32768 cells", "100000 columns", "cut the map"].into_iter().for_each(says);
}

#[test]
fn what_there_is_not_on_long_maps_is_refused() {
    let costs = Costs::from_fn(100_000, 3, |x, y| (x % 50 != 7 || y == 1).then_some(2.0)).expect("costs");
    let map = costs.map();
    for (placement, motion) in
        [(PlacementKind::Center, Motion::centers(3)), (PlacementKind::Corner, Motion::corners(K::ANY))]
    {
        refused(map.space(motion), placement.name());
        refused(map.for_disc(1.0, motion), "a disc");
        refused(map.disc(1.0, motion), "a disc");
        refused(map.within(Limits::new()).for_disc(1.0, motion), "a disc");
        refused(map.keep_space(motion, Limits::new()), "a space that is kept");
    }
    refused(map.path((0, 0), (5, 0)), "a path");
    refused(map.within(Limits::new()).path((0, 0), (5, 0)), "a path");
    refused(map.for_square(2), "a square");
    refused(map.square(2), "a square");
    refused(map.within(Limits::new()).for_square(2), "a square");
    refused(map.within(Limits::new()).clearance(Fit::Centers, Outside::Blocked), "clearance");
    let nothing: Clearance = map.clearance(Fit::Centers, Outside::Blocked);
    assert!(nothing.for_disc(0.5).is_ok_and(|grid| !grid.has_free_cells()));
    assert_eq!(nothing.largest_disc((50_000, 1).into()), None);

    let space = costs.space(Motion::centers(4)).expect("k = 4");
    for engine in [Engine::Theta, Engine::LazyTheta] {
        refused(space.prepare(engine), engine.name());
        refused(space.planner(engine), engine.name());
        refused(space.make_ready(engine), engine.name());
    }
    let index = space.prepare(Engine::AStar).expect("it takes long maps");
    refused(index.with_smoothing(Some(Smoothing::Linear)).try_planner(), "smoothing");
    for engine in Engine::ALL.into_iter().filter(|engine| !engine.capabilities().costs) {
        let error = space.prepare(engine).expect_err("no costs");
        assert!(matches!(error, Error::Setup(SetupError::Costs { .. })), "{error}");
    }

    // A space without costs on a long map comes of a change to it alone.
    let small = Map::new(9, 9).expect("a map").space(3).expect("k = 3");
    let change = Change::to(&small, map);
    let after = change.after();
    assert!(after.is_free((99_999, 1)) && after.sees((99_990, 1), (99_999, 1)));
    refused(after.field([(0, 0)]), "a field");
    refused(after.distances(Engine::Wavefront, (0, 0)), "distances");
    refused(after.path((0, 0), (9, 0)), "a path");
    for engine in [Engine::AStar, Engine::Jps, Engine::Subgoal, Engine::Landmarks] {
        refused(small.prepare(engine).expect("a small map").repair(&change), engine.name());
    }
    refused(small.field([(0, 0)]).and_then(|field: Field| field.repair(&change)), "a field");
    let disc = Map::new(9, 9).expect("a map").disc(0.7, 3).expect("a disc");
    refused(disc.after(&Change::to(&small, map)), "a disc");
}

#[test]
fn sides_that_costs_cannot_have_are_refused_before_anything_is_allocated() {
    let most = 1 << 20;
    for (width, height) in [(0, 5), (5, 0), (most + 1, 1), (1, most + 1), (most, most), (u32::MAX, u32::MAX)]
    {
        let error = Costs::from_fn(width, height, |_, _| panic!("nothing is asked")).expect_err("no size");
        assert_eq!(error.code(), ErrorCode::MapSize, "{error}");
        let text = error.to_string();
        assert!(text.contains("1048576 cells") && text.contains("larger cells"), "{text}");
    }
    assert!(Costs::check_size(100_000, 300).is_ok());
    // Usual maps have sides as ever.
    assert_eq!(Map::new(Grid::MAX_SIDE + 1, 1).unwrap_err().code(), ErrorCode::MapSize);
    let no_data = Surface::new(40_000, 2, vec![f32::NAN; 80_000]).expect("a raster");
    let shut = Costs::from_surface(&no_data).expect("no free cell");
    let error = shut.space(3).expect("k = 3").path((39_999, 1), (0, 0)).unwrap_err();
    assert_eq!(error.code(), ErrorCode::StartBlocked);
}

#[test]
fn rasters_with_long_sides_are_read() {
    let folder = tempfile::tempdir().expect("a folder");
    for (width, height) in [(40_000, 2), (2, 33_000)] {
        let cells =
            (0..height).flat_map(|y| (0..width).map(move |x| cost(7, x, y).map_or(0.0, |cost| cost as f32)));
        let place = Georeference::from_cell_size(30.0, 30.0).expect("a size");
        let raster = Surface::new(width, height, cells.collect::<Vec<f32>>()).expect("a raster");
        let raster = raster.with_no_data(Some(0.0)).with_georeference(place);
        let expected = Costs::from_fn(width, height, |x, y| cost(7, x, y)).expect("costs");
        let expected = expected.with_cell_size(30.0, 30.0).expect("a size of cells");
        for name in ["land.tif", "land.asc"] {
            let file = folder.path().join(name);
            raster.save(&file).expect("a file");
            assert_eq!(Costs::open(&file).expect("a raster"), expected, "{name}");
        }
        let map = Map::with_data(&raster).expect("a long map");
        assert_eq!((map.costs_of(&raster).expect("costs"), &map), (expected.clone(), expected.map()));
        let walls = expected.block_cells([((width as i32 - 1, height as i32 - 1), true)]).expect("a wall");
        let costs = walls.map().costs_of(&raster).expect("costs");
        assert_eq!(costs.map(), walls.map());
    }
    // The header alone is looked at.
    let file = folder.path().join("vast.asc");
    std::fs::write(&file, "ncols 1048576\nnrows 4000000\ncellsize 1\n").expect("a file");
    let error = Costs::open(&file).expect_err("no size");
    assert!(error.to_string().contains("4000000"), "{error}");
}

#[test]
fn costmaps_with_long_sides_have_neither_costs_nor_inflation() {
    let costmap = Costmap::from_bytes(40_000, 2, vec![126; 80_000]).expect("a costmap");
    assert_eq!(costmap.costs(2.0).unwrap_err().code(), ErrorCode::MapSize);
    let costs = Costs::from_fn(40_000, 2, |_, _| Some(1.0)).expect("costs");
    let inflation = Inflation { inscribed_radius: 1.0, inflation_radius: 2.0, ..Inflation::default() };
    for wide in [costmap, Costmap::from(costs.map())] {
        assert_eq!(wide.inflated(&inflation).unwrap_err().code(), ErrorCode::MapSize);
    }
}

/// Blocks of a long map that are edited are those of the typed crate.
#[test]
fn walls_are_drawn_and_taken_away() {
    let costs = Costs::from_fn(70_000, 4, |_, _| Some(3.0)).expect("costs");
    let walled = costs.edit(Rectangle::new(69_990, 1, 50, 2), |x, _| x % 2 == 0).expect("on the map");
    let changed = GridChange::new(Arc::clone(costs.map().grid()))
        .edit(Rectangle::new(69_990, 1, 10, 2), |x, _| x % 2 == 0);
    assert_eq!(walled.map().grid(), changed.after());
    let error = walled.edit_cells([((70_000, 0), None)]).unwrap_err();
    assert_eq!(error.code(), ErrorCode::EditOutside);
    let open = walled.edit_cells([((69_990, 1), Some(3.0))]).expect("on the map");
    assert!(open.map().is_free((69_990, 1)) && open.map().is_blocked((69_992, 1)));
}
