//! Costs of cells: queries with every wish, fields, edits and errors, against Dijkstra's algorithm on the
//! explicit graph with exact integrals.

use std::sync::Arc;

use mediant::{
    Answer, Change, Costs, Demand, Engine, Error, ErrorCode, Exceptions, FiniteK, Guarantee, K, Limit,
    Limits, Map, Motion, Path, PlacementKind, Planner, Query, Replanned, Rules, Smoothing, Space, Vertex,
    call::Call,
    errors::{QueryError, SetupError},
    options::{ConfiguredEngine, GuidedOptions, HeuristicName},
};
use mediant_costs::CostGraph;
use mediant_moves::{Cost, CostTable};
use mediant_oracle::{
    Integral, Rng, WeightedGraph, WeightedMap, random_free_vertex, random_vertex, random_weighted, seeds,
    weighted_path_cost,
};

use crate::k;

/// A random map with costs, and what the oracle knows of it.
struct World {
    map: WeightedMap,
    costs: Costs,
    space: Space,
    k: FiniteK,
    rules: Rules,
    oracle: WeightedGraph,
    graph: CostGraph,
    metric: CostTable,
    about: String,
}

impl World {
    fn new(seed: u64) -> Self {
        let (map, about) = random_weighted(seed);
        let (rules, k) = (Rules::ALL[(seed % 5) as usize], k(2 + ((seed / 5) % 7) as u32));
        Self::of(map, rules, k, &format!("seed {seed}: {about}"))
    }

    fn of(map: WeightedMap, rules: Rules, k: FiniteK, about: &str) -> Self {
        let about = format!("{rules}, k = {k}, {about}\n{map}");
        let (x, y) = map.cell_size();
        let costs = Map::from(map.grid().clone()).costs(map.weights().iter().copied());
        let costs = costs.and_then(|costs| costs.with_cell_size(x, y));
        let costs = costs.unwrap_or_else(|error| panic!("{error}: {about}"));
        let space = costs.space(Motion::new(k, rules)).expect("a small k");
        Self {
            oracle: WeightedGraph::new(&map, rules, Some(k)),
            graph: CostGraph::new(Arc::clone(costs.surface()), rules, k).expect("a small k"),
            metric: CostTable::new(k).expect("a small k"),
            map,
            costs,
            space,
            k,
            rules,
            about,
        }
    }

    /// The engines' rounding of an exact integral.
    fn rounded(&self) -> impl Fn(&Integral) -> u64 {
        |integral| {
            let sum = u64::try_from(integral.numerator).expect("weights have 32 bits");
            self.graph.cost_of_sum(integral.by, sum).expect("a move of N(k)").to_bits()
        }
    }

    fn to_f64(&self, cost: u64) -> f64 {
        self.graph.to_f64(Cost::from_bits(cost))
    }

    /// The least costs from a vertex to all, row by row.
    fn costs_from(&self, start: Vertex) -> Vec<Option<u64>> {
        self.oracle.costs(&[start], self.rounded())
    }

    fn vertices(&self) -> Vec<Vertex> {
        let (width, height) = self.graph.size();
        (0..height as i32).flat_map(|y| (0..width as i32).map(move |x| Vertex::new(x, y))).collect()
    }

    fn free(&self, rng: &mut Rng, count: u32) -> Vec<Vertex> {
        let placement = self.rules.placement();
        (0..count).filter_map(|_| random_free_vertex(rng, self.map.grid(), placement)).collect()
    }

    /// A vertex, also in and around walls.
    fn any(&self, rng: &mut Rng) -> Vertex {
        random_vertex(rng, self.map.grid(), self.rules.placement())
    }

    fn planners(&self) -> [Planner; 2] {
        [Engine::AStar, Engine::Dijkstra]
            .map(|engine| self.space.planner(engine).unwrap_or_else(|error| panic!("{error}")))
    }

    /// Fails unless a path is legal and has the cost that it states, which is this one.
    #[track_caller]
    fn check_path(&self, path: &Path, cost: u64) {
        let about = &self.about;
        let replayed =
            weighted_path_cost(&self.map, self.rules, Some(self.k), path.waypoints(), self.rounded());
        assert!(matches!(replayed, Ok(found) if found == cost), "{path}: {replayed:?}, not {cost}: {about}");
        assert_eq!(path.cost(), self.to_f64(cost), "{path}: {about}");
        assert_eq!(self.space.cost(path), Some(path.cost()), "{path}: {about}");
        assert_eq!(path.length(), Path::new(path.waypoints().to_vec()).cost(), "{path}: {about}");
        assert_eq!(path.bends(), path.len().saturating_sub(2), "{path} goes straight on: {about}");
    }

    /// The best pair of ends: by cost, then by goal, then by start.
    fn best(&self, starts: &[Vertex], goals: &[Vertex]) -> Option<(u64, Vertex, Vertex)> {
        let known: Vec<_> = starts.iter().map(|&start| (start, self.costs_from(start))).collect();
        let to = |goal: Vertex| {
            let at = self.oracle.index(goal);
            known.iter().filter_map(move |(start, costs)| Some((costs[at?]?, *start, goal)))
        };
        goals.iter().flat_map(|&goal| to(goal)).min_by_key(|&(cost, ..)| cost)
    }

    fn distance(&self, from: Vertex, to: Vertex) -> u64 {
        self.metric.distance(from.to(to)).to_bits()
    }
}

fn ends(path: &Path) -> (Vertex, Vertex) {
    (path.waypoints()[0], path.waypoints()[path.len() - 1])
}

/// The answer in steps of one expansion; the bound and the best so far are looked at after each.
fn in_steps(world: &World, planner: &mut Planner, query: &Query, optimum: Option<u64>) -> Answer {
    let about = &world.about;
    planner.begin(query).unwrap_or_else(|error| panic!("{error}: {about}"));
    let mut last = 0.0;
    loop {
        if let Some(answer) = planner.step(1).expect("A* never gives up") {
            return answer;
        }
        let bound = planner.lower_bound();
        assert!(bound >= last * (1.0 - 1e-9), "a bound of {bound} after {last}: {about}");
        if let Some(optimum) = optimum {
            assert!(bound <= world.to_f64(optimum) * (1.0 + 1e-9), "{query}: {bound}: {about}");
        }
        last = bound;
        let best = planner.best().expect("a search was begun");
        assert_eq!(world.space.cost(&best), Some(best.cost()), "{best}: {about}");
    }
}

/// Checks a query against the best pair of ends.
fn check(
    world: &World,
    planner: &mut Planner,
    query: &Query,
    best: Option<(u64, Vertex, Vertex)>,
    (is_nearest, is_any): (bool, bool),
) {
    let about = format!("{query}, {:?}: {}", planner.index().setup().engine.kind(), world.about);
    let answer = planner.find(query).unwrap_or_else(|error| panic!("{error}: {about}"));
    let stepped = in_steps(world, planner, query, best.map(|(cost, ..)| cost));
    assert_eq!(stepped, answer, "{about}");
    let Some((cost, start, goal)) = best else {
        assert_eq!(answer, Answer::Unreachable, "{about}");
        return;
    };
    let path = match &answer {
        Answer::Found(path) if !is_nearest => path,
        Answer::Nearest(path) if is_nearest => path,
        _ => panic!("{answer:?}: {about}"),
    };
    world.check_path(path, cost);
    if !is_any {
        assert_eq!(ends(path), (start, goal), "{about}");
    }
    let guarantee = planner.guarantee();
    assert_eq!(guarantee, Guarantee::Cheapest(world.k));
    assert_eq!(answer.distance(guarantee), path.cost());
    assert_eq!(answer.any_angle_lower_bound(guarantee, world.rules), None);
    assert_eq!(planner.bound(), None);
    if !is_nearest {
        assert_eq!(answer.lower_bound(guarantee), path.cost());
    }
    // Limits.
    let cost = world.to_f64(cost);
    for (limit, is_found) in [(cost * 0.999, cost == 0.0), (cost, true), (cost * 1.001, true)] {
        let limited = planner.find(query.clone().within(Limits::new().cost(limit))).expect("it was answered");
        if is_found {
            // A tolerance may lead to another end that is as near.
            assert_eq!(limited.cost(), answer.cost(), "{limited:?} within {limit}: {about}");
            continue;
        }
        let Answer::Stopped(stopped) = limited else { panic!("{limited:?} within {limit}: {about}") };
        assert_eq!(stopped.by, Limit::Cost, "{about}");
        let bound = stopped.lower_bound;
        assert!(bound > limit && bound <= cost * (1.0 + 1e-9), "{stopped:?} within {limit}: {about}");
        assert!(stopped.best.cost() <= limit * (1.0 + 1e-9), "{stopped:?}: {about}");
        assert_eq!(world.space.cost(&stopped.best), Some(stopped.best.cost()), "{about}");
    }
    if let Answer::Stopped(stopped) =
        planner.find(query.clone().within(Limits::new().expansions(3))).expect("it was answered")
    {
        assert!(stopped.by == Limit::Expansions && stopped.lower_bound <= cost * (1.0 + 1e-9), "{about}");
    }
}

#[test]
fn every_wish_is_that_of_brute_force() {
    let mut found = 0;
    for seed in seeds(140) {
        let world = World::new(seed);
        let mut rng = Rng::new(seed);
        let mut planners = world.planners();
        let (starts, goals) = (world.free(&mut rng, 3), world.free(&mut rng, 3));
        let (Some(&start), Some(&goal)) = (starts.first(), goals.first()) else { continue };
        let best = world.best(&[start], &[goal]);
        let several = world.best(&starts, &goals);
        let tolerance = f64::from(1 + rng.below(4));
        let near: Vec<Vertex> = world
            .vertices()
            .into_iter()
            .filter(|&at| at.distance(goal) <= tolerance && world.space.is_free(at))
            .collect();
        let near_best = world.best(&[start], &near);
        let shut = world.any(&mut rng);
        let from = world.costs_from(start);
        let reached = world.vertices().into_iter().zip(&from).filter(|(_, cost)| cost.is_some());
        let least = reached.clone().map(|(at, _)| world.distance(at, shut)).min();
        let nearest: Vec<Vertex> =
            reached.filter(|&(at, _)| Some(world.distance(at, shut)) == least).map(|(at, _)| at).collect();
        let nearest_best = world.best(&[start], &nearest);
        let snapped = |at: Vertex| {
            let free = world.vertices().into_iter().filter(|&at| world.space.is_free(at));
            free.min_by_key(|&free| world.distance(free, at)).expect("some vertex is free")
        };
        let snapped_best = world.best(&[snapped(shut)], &[goal]);
        for planner in &mut planners {
            check(&world, planner, &Query::new(start, goal), best, (false, false));
            let query = Query::between(starts.clone(), goals.clone());
            check(&world, planner, &query, several, (false, false));
            check(&world, planner, &Query::new(start, goal).tolerance(tolerance), near_best, (false, true));
            let is_reached = world.oracle.index(shut).is_some_and(|at| from[at].is_some());
            check(&world, planner, &Query::new(start, shut).nearest(), nearest_best, (!is_reached, false));
            check(&world, planner, &Query::new(shut, goal).snap(), snapped_best, (false, false));
        }
        let [planner, dijkstra] = &mut planners;
        let distance = best.map(|(cost, ..)| world.to_f64(cost));
        assert_eq!(planner.distance((start, goal)), Ok(distance), "{}", world.about);
        let (guided, blind) = (planner.find_counted((start, goal)), dijkstra.find_counted((start, goal)));
        let [(_, guided), (_, blind)] = [guided, blind].map(|found| found.expect("both are free"));
        assert!(guided.expanded <= blind.expanded, "{}", world.about);
        assert_eq!(best.is_none(), !world.space.connected(start, goal), "{}", world.about);
        if best.is_none() {
            assert_eq!(blind.expanded, 0, "the components know: {}", world.about);
        }
        let table = planner.index().table(starts.clone(), goals.clone()).expect("all are free");
        for (row, &start) in starts.iter().enumerate() {
            for (column, &goal) in goals.iter().enumerate() {
                let cost =
                    world.best(&[start], &[goal]).map_or(f64::INFINITY, |(cost, ..)| world.to_f64(cost));
                assert_eq!(table.get(row, column), Some(cost), "{start} → {goal}: {}", world.about);
            }
        }
        let prepared = planner.index().goals(goals.clone()).expect("all are free");
        let nearest = planner.nearest(start, &prepared).expect("it is free");
        let expected = world.best(&[start], &goals).map(|(cost, _, goal)| {
            (goals.iter().position(|&at| at == goal).expect("one of them"), world.to_f64(cost))
        });
        assert_eq!(nearest, expected, "{}", world.about);
        found += usize::from(best.is_some());
    }
    assert!(found > 80, "only {found}");
}

#[test]
fn fields_are_those_of_the_oracle() {
    let mut reached = 0;
    for seed in seeds(120) {
        let world = World::new(seed);
        let about = &world.about;
        let mut rng = Rng::new(seed);
        let count = 1 + rng.below(3);
        let sources = world.free(&mut rng, count);
        let expected = world.oracle.nearest(&sources, world.rounded());
        let field = world.space.field(sources.clone()).expect("the sources are free");
        assert_eq!(field.identity(), world.space.identity());
        let mut listed = field.iter();
        let lengths = field.lengths();
        let (width, height) = (field.width() as usize, field.height() as usize);
        assert_eq!((width * height, lengths.len()), (expected.len(), expected.len()), "{about}");
        let mut planner = world.space.planner(Engine::AStar).expect("it knows costs");
        for ((at, expected), length) in world.vertices().into_iter().zip(&expected).zip(&lengths) {
            let Some((cost, source)) = *expected else {
                assert_eq!((field.get(at), field.nearest_source(at), *length), (None, None, f64::INFINITY));
                assert!(field.path_from(at).is_none() && field.next(at).is_none(), "{at}: {about}");
                continue;
            };
            reached += 1;
            let told = world.to_f64(cost);
            assert_eq!((field.get(at), *length), (Some(told), told), "{at}: {about}");
            assert_eq!(listed.next(), Some((at, told)), "{about}");
            assert_eq!(field.nearest_source(at), Some(sources[source]), "{at}: {about}");
            let path = field.path_from(at).expect("it is in the field");
            world.check_path(&path, cost);
            assert!(sources.contains(&ends(&path).1), "{path}: {about}");
            let next = path.vertices().nth(1).filter(|_| cost > 0);
            assert_eq!(field.next(at), next, "{path}: {about}");
            if let (Some(next), Some((x, y))) = (next, field.direction(at)) {
                let d = at.to(next);
                assert!((x * d.norm() - f64::from(d.x)).abs() + (y * d.norm() - f64::from(d.y)).abs() < 1e-9);
            }
            if rng.chance(3) && sources.len() == 1 {
                assert_eq!(planner.distance((at, sources[0])), Ok(Some(told)), "{at}: {about}");
            }
        }
        let greatest = expected.iter().flatten().map(|&(cost, _)| cost).max().unwrap_or(0);
        let limit = world.to_f64(greatest) * 0.6;
        let within = world.space.within(Limits::new()).field_within(sources.clone(), limit);
        let within = within.expect("the sources are free");
        for at in world.vertices() {
            let expected = field.get(at).filter(|&cost| cost <= limit * (1.0 + 1e-9));
            assert_eq!(within.get(at), expected, "{at} within {limit}: {about}");
        }
        let corridor = field.corridor(&within).expect("the same space");
        for ((one, other), sum) in lengths.iter().zip(within.lengths()).zip(corridor) {
            assert!(sum == one + other || (sum - one - other).abs() < 1e-9 * sum, "{about}");
        }
        if let &[source] = &sources[..] {
            let all = world.space.distances(Engine::Dijkstra, source).expect("it is free");
            assert!(field.iter().eq(all), "{about}");
        }
    }
    assert!(reached > 5_000, "only {reached}");
}

#[test]
fn costs_of_1_are_lengths_and_another_space() {
    for seed in seeds(60) {
        let (map, about) = random_weighted(seed);
        let map = Map::from(map.grid().clone());
        // The pruning that fields without costs need takes long for large k.
        let (rules, k) = (Rules::ALL[(seed % 5) as usize], k(2 + ((seed / 5) % 4) as u32));
        let motion = Motion::new(k, rules);
        let cells = map.width() as usize * map.height() as usize;
        let costs = map.costs(vec![1_u8; cells]).expect("costs of 1");
        let (plain, space) = (map.space(motion).expect("a small k"), costs.space(motion).expect("a small k"));
        assert_ne!(plain.identity(), space.identity());
        let mut planners = [&plain, &space].map(|space| space.planner(Engine::AStar).expect("it takes all"));
        let mut rng = Rng::new(seed);
        let ends = |rng: &mut Rng| random_free_vertex(rng, map.grid(), rules.placement());
        for _ in 0..4 {
            let (Some(start), Some(goal)) = (ends(&mut rng), ends(&mut rng)) else { continue };
            let [one, other] = planners.each_mut().map(|planner| planner.distance((start, goal)));
            assert_eq!(one, other, "seed {seed}: {start} → {goal}, {motion}: {about}\n{map}");
            let [one, other] = [&plain, &space].map(|space| space.field([start]).expect("it is free"));
            assert_eq!(one.lengths(), other.lengths(), "seed {seed}: {start}, {motion}: {about}\n{map}");
            assert_eq!(one.corridor(&other).unwrap_err().code(), ErrorCode::Mismatch);
        }
    }
}

/// Random edits: costs within the bounds and beyond, walls, and cells that are freed.
fn random_edit(world: &Costs, rng: &mut Rng) -> Vec<(Vertex, Option<f64>)> {
    let (least, greatest) = world.bounds();
    (0..1 + rng.below(6))
        .map(|_| {
            let costs = [None, None, Some(least), Some(greatest), Some(greatest), Some(greatest + 1.0)];
            let cost = costs[rng.below(6) as usize].filter(|&cost| cost < 4e9);
            (random_vertex(rng, world.map().grid(), PlacementKind::Center), cost)
        })
        .collect()
}

#[test]
fn what_was_prepared_follows_edits_of_costs() {
    let mut searched = 0;
    for seed in seeds(60) {
        let world = World::new(seed);
        let motion = world.space.motion();
        let mut rng = Rng::new(seed);
        let mut costs = world.costs.clone();
        let mut space = world.space.clone();
        let mut planners = world.planners();
        let sources = world.free(&mut rng, 2);
        let mut field = world.space.field(sources.clone()).expect("the sources are free");
        for edit in 0..5 {
            let about = format!("edit {edit}: {}", world.about);
            let cells = random_edit(&costs, &mut rng);
            let Ok(next) = costs.edit_cells(cells.iter().copied()) else { continue };
            let change = if rng.chance(50) {
                space.edit_costs(cells.iter().copied()).expect("these costs can be")
            } else {
                Change::between(&space, &next.space(motion).expect("the same k")).expect("the same motion")
            };
            let after = change.after().clone();
            assert_eq!(after.identity(), next.space(motion).expect("the same k").identity(), "{about}");
            assert_eq!((after.costs(), after.map()), (Some(&next), next.map()), "{about}");
            for &(cell, cost) in &cells {
                let changed = costs.cost(cell) != next.cost(cell);
                let (x, y) = (cell.x as u32, cell.y as u32);
                let is_in = change
                    .cells()
                    .iter()
                    .any(|at| (at.x..at.x + at.width).contains(&x) && (at.y..at.y + at.height).contains(&y));
                assert!(is_in || !changed, "{cell} {cost:?}: {about}");
                assert_eq!(next.map().is_free(cell), next.cost(cell).is_some(), "{about}");
            }
            for planner in &mut planners {
                let before = planner.index().clone();
                let index = before.repair(&change).expect("a change of its space");
                planner.follow(&index).expect("the same engine");
                let kind = index.setup().engine.kind();
                let mut new = after.planner(kind).expect("it knows costs");
                for _ in 0..3 {
                    let at =
                        |rng: &mut Rng| random_free_vertex(rng, next.map().grid(), motion.rules.placement());
                    let (Some(start), Some(goal)) = (at(&mut rng), at(&mut rng)) else { continue };
                    let [one, other] = [&mut *planner, &mut new]
                        .map(|planner| planner.find_counted((start, goal)).expect("both are free"));
                    assert_eq!(one, other, "{start} → {goal}: {about}");
                    searched += usize::from(one.0.path().is_some());
                }
            }
            let anew = after.field(sources.clone());
            match field.repair(&change) {
                Ok(repaired) => {
                    let anew = anew.expect("the same sources");
                    assert_eq!(repaired.lengths(), anew.lengths(), "{about}");
                    field = repaired;
                }
                Err(error) => {
                    assert_eq!(error.code(), anew.expect_err("it is blocked").code(), "{about}");
                    break;
                }
            }
            (costs, space) = (next, after);
        }
    }
    assert!(searched > 300, "only {searched}");
}

fn plain_space() -> Space {
    Map::from_rows(["....", ".#..", "...."]).expect("a map").space(Motion::default()).expect("k = 3")
}

/// Costs of 1, but one of 3.
fn costs() -> Costs {
    let map = Map::from_rows(["....", ".#..", "...."]).expect("a map");
    map.costs([1, 3, 1, 1, 1, 0, 1, 1, 1, 1, 1, 1]).expect("costs")
}

fn space() -> Space {
    costs().space(Motion::default()).expect("k = 3")
}

#[test]
fn cells_are_blocked_but_not_freed_without_a_cost() {
    let space = space();
    let blocked = space.edit_cells([((2, 0), true), ((3, 0), false)]).expect("none is freed");
    assert!(blocked.after().map().is_blocked((2, 0)));
    assert_eq!(blocked.after().costs().and_then(|costs| costs.cost((2, 0))), None);
    assert_eq!(blocked.cells().len(), 1);
    let freed = space.edit_cells([((1, 1), false)]).expect_err("it has no cost");
    assert!(matches!(freed, Error::Freed { cell } if cell == (1, 1).into()), "{freed}");
    assert!(freed.code() == ErrorCode::Cost && freed.to_string().contains("edit_costs"), "{freed}");
    let whole = mediant::Rectangle::new(0, 0, 9, 9);
    assert!(space.edit(whole, |_, _| false).is_err());
    let walls = space.edit(whole, |x, _| x == 1).expect("none is freed");
    assert!(walls.after().map().is_blocked((1, 2)) && walls.cells().len() == 2, "{:?}", walls.cells());
    // The last word counts.
    let kept = space.edit_cells([((1, 1), false), ((1, 1), true), ((0, 0), true), ((0, 0), false)]);
    assert_eq!(kept.expect("none is freed").after().identity(), space.identity());
    let opened = space.edit_costs([((1, 1), Some(2.0))]).expect("a cost").edit_cells([((1, 1), false)]);
    assert_eq!(opened.expect("it is free").after().costs().and_then(|costs| costs.cost((1, 1))), Some(2.0));
    assert_eq!(plain_space().edit_costs([((0, 0), Some(2.0))]).unwrap_err().code(), ErrorCode::Cost);
}

#[test]
fn changes_between_costs_and_none() {
    let (plain, space) = (plain_space(), space());
    let index = space.prepare(Engine::AStar).expect("it knows costs");
    let change = Change::between(&space, &plain).expect("the same motion");
    let lengths = index.repair(&change).expect("A* prepares it anew");
    assert_eq!(lengths.planner().distance([(0, 0), (3, 0)]), Ok(Some(3.0)));
    assert_eq!(Change::to(&space, plain.map()).after().identity(), plain.identity());
    let field = space.field([(0, 0)]).expect("it is free");
    assert_eq!(field.repair(&change).unwrap_err().code(), ErrorCode::Mismatch);
    let back = Change::between(&plain, &space).expect("the same motion");
    let index = lengths.repair(&back).expect("A* prepares it anew");
    let mut planner = lengths.planner();
    planner.follow(&index).expect("the same engine");
    assert_eq!(
        planner.distance([(0, 0), (3, 0)]),
        space.planner(Engine::AStar).unwrap().distance([(0, 0), (3, 0)])
    );
    let jps = plain.prepare(Engine::JpsBlock).expect("k = 3");
    assert_eq!(jps.repair(&back).unwrap_err().code(), ErrorCode::EngineWithout);
    let field = plain.field([(0, 0)]).expect("it is free");
    assert_eq!(field.repair(&back).unwrap_err().code(), ErrorCode::Mismatch);
    let further = change.edit_cells([((0, 0), true)]).expect("a cell of the map");
    assert!(index.repair(&further).is_ok());
    assert_eq!(jps.repair(&Change::new(&space)).unwrap_err().code(), ErrorCode::Mismatch);
}

#[test]
fn paths_are_replanned_and_mended_by_their_costs() {
    let map = Map::new(9, 5).expect("a map");
    let space = map.costs([1.0; 45]).expect("costs").space(Motion::default()).expect("k = 3");
    let path = space.path((0, 2), (8, 2)).expect("free").expect("there is a way");
    assert_eq!((path.cost(), path.length()), (8.0, 8.0));
    // Far from the path.
    let far = space.edit_costs([((8, 0), Some(3.0))]).expect("a cost");
    let mut planner = far.after().planner(Engine::AStar).expect("it knows costs");
    assert_eq!(planner.replan(&path, &far).expect("of its space"), Replanned::Kept);
    // On it: it holds, and is no longer the cheapest.
    let swamp = space.edit_costs([((4, 2), Some(30.0)), ((4, 1), Some(30.0))]).expect("a cost");
    let mut planner = swamp.after().planner(Engine::AStar).expect("it knows costs");
    let Replanned::Replaced(new) = planner.replan(&path, &swamp).expect("of its space") else {
        panic!("kept")
    };
    assert!(new.cost() < 10.0 && swamp.after().cost(&path) == Some(37.0));
    let Answer::Found(held) = planner.mend(&path).expect("free") else { panic!("it holds") };
    assert_eq!((held.waypoints(), held.cost()), (path.waypoints(), 37.0));
    let wall = space.edit_costs([((4, 2), None), ((0, 2), Some(2.0))]).expect("a wall");
    let mut planner = wall.after().planner(Engine::AStar).expect("it knows costs");
    let Answer::Found(mended) = planner.mend(&path).expect("free") else { panic!("there is a way") };
    let cost = wall.after().cost(&mended).expect("it is legal");
    assert!((mended.cost() - cost).abs() < 1e-9 && mended.length() < cost, "{mended}");
    assert_eq!(wall.least_by_freed(&path), 0.0);
}

#[test]
fn paths_and_answers_tell_cost_and_length() {
    let space = space();
    let mut planner = space.planner(space.engine()).expect("auto");
    let answer = planner.find([(0, 0), (2, 0)]).expect("free");
    let path = answer.path().expect("there is a way").clone();
    assert_eq!(path.to_string(), "(0, 0) → (2, 0)");
    assert_eq!((path.cost(), path.length(), answer.cost()), (4.0, 2.0, Some(4.0)));
    assert_eq!(answer.to_string(), "found: 2 waypoints, 2.00 cells, cost 4.00");
    assert_eq!(path.reversed().cost(), 4.0);
    let rest = path.rest((1, 0)).expect("on the path");
    assert_eq!((rest.cost(), space.cost(&rest)), (1.0, Some(2.0)));
    let there_and_back = path.joined(&path.reversed()).expect("they meet");
    assert_eq!((there_and_back.cost(), there_and_back.length()), (8.0, 4.0));
    assert_ne!(path, Path::new(path.waypoints().to_vec()));
    let json = serde_json::to_string(&path).expect("points");
    assert_eq!(json, "[[0,0],[2,0]]");
    assert_eq!(plain_space().cost(&path), Some(2.0));
    assert_eq!(space.cost(&Path::new(vec![(0, 0).into(), (3, 2).into()])), None);
}

#[test]
fn bad_costs_are_errors_that_say_what_to_do() {
    let map = Map::from_rows(["..", ".#"]).expect("a map");
    let code = |costs: [f64; 4]| map.costs(costs).map_err(|error| (error.code(), error.to_string()));
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let (code, text) = code([1.0, bad, 1.0, 1.0]).expect_err("no cost");
        assert!(code == ErrorCode::Cost && text.contains("(1, 0)") && text.contains("blocked"), "{text}");
        // Those of blocked cells are not looked at.
        assert!(map.costs([1.0, 1.0, 1.0, bad]).is_ok());
        let error = costs().edit_cells([((0, 0), Some(bad))]).expect_err("no cost");
        assert_eq!(error.code(), ErrorCode::Cost, "{error}");
    }
    for wrong in [vec![1_u8; 3], vec![1; 5], Vec::new()] {
        let error = map.costs(wrong).expect_err("another number");
        assert!(error.code() == ErrorCode::Cost && error.to_string().contains("4 cells"), "{error}");
    }
    assert_eq!(code([1e-9, 1.0, 1.5, 1.0]).expect_err("too far apart").0, ErrorCode::Cost);
    assert_eq!(costs().with_cell_size(0.0, 1.0).unwrap_err().code(), ErrorCode::Number);
    assert_eq!(costs().edit_cells([((4, 0), None)]).unwrap_err().code(), ErrorCode::EditOutside);
    let shut = Map::from_rows(["##"]).expect("a map").costs([0, 0]).expect("nothing is looked at");
    let error = shut.space(3).expect("k = 3").path((0, 0), (1, 0)).unwrap_err();
    assert_eq!(error.code(), ErrorCode::StartBlocked);
    let stop = Limits::new().deadline(|| true);
    let Err(error) = map.within(&stop).costs([1; 4]) else { panic!("out of time") };
    assert_eq!(error.code(), ErrorCode::Stopped);
    assert_eq!(space().within(&stop).field([(0, 0)]).unwrap_err().code(), ErrorCode::Stopped);
    assert!(costs().within(Limits::new()).space(3).is_ok());
}

#[test]
fn what_there_is_not_on_costs_is_refused() {
    let (costs, space) = (costs(), space());
    for motion in [Motion::corners(K::ANY), Motion::centers(9), Motion::corners(12), Motion::centers(K::ANY)]
    {
        let error = costs.space(motion).expect_err("too many");
        assert!(matches!(error, Error::Setup(SetupError::CostsK { max: 8, .. })), "{error}");
        assert_eq!(error.code(), ErrorCode::Motion);
    }
    assert_eq!(costs.space(-1).unwrap_err().code(), ErrorCode::K);
    let known = [Engine::AStar, Engine::Dijkstra];
    for engine in Engine::ALL.into_iter().filter(|engine| !known.contains(engine)) {
        for motion in [Motion::centers(3), Motion::corners(5)] {
            let error = costs.space(motion).expect("a small k").prepare(engine).expect_err("no costs");
            assert!(matches!(error, Error::Setup(SetupError::Costs { .. })), "{error}");
            assert!(error.to_string().contains("astar, dijkstra"), "{error}");
        }
        assert!(space.make_ready(engine).is_err() && space.distances(engine, (0, 0)).is_err());
    }
    assert!(space.make_ready(Engine::AStar).is_ok());
    let with = |heuristic| {
        space.prepare(ConfiguredEngine::AStar(GuidedOptions { heuristic: Some(heuristic) })).map(|_| ())
    };
    for (heuristic, is_known) in [
        (HeuristicName::Hk, true),
        (HeuristicName::Zero, true),
        (HeuristicName::Euclidean, false),
        (HeuristicName::SquaredEuclidean, false),
    ] {
        assert_eq!(with(heuristic).is_ok(), is_known, "{heuristic}");
    }
    let code = |error: Error| (error.code(), error.to_string().starts_with("on costs of cells there is no"));
    let refused = (ErrorCode::EngineWithout, true);
    let index = space.prepare(Engine::AStar).expect("it knows costs");
    assert_eq!(code(index.to_bytes().unwrap_err()), refused);
    assert_eq!(code(index.planner().find_except([(0, 0), (2, 0)], &Exceptions::new()).unwrap_err()), refused);
    assert_eq!(code(space.widest_path((0, 0), (2, 0), 0.5).unwrap_err()), refused);
    let smoothed = index.clone().with_smoothing(Some(Smoothing::Taut));
    assert_eq!(code(smoothed.try_planner().unwrap_err()), refused);
    let mut planner = smoothed.planner();
    assert_eq!(planner.find([(0, 0), (2, 0)]), Err(QueryError::Smoothing));
    assert_eq!(planner.distance([(0, 0), (2, 0)]), Err(QueryError::Smoothing));
    assert_eq!(planner.begin(Query::new((0, 0), (2, 0)).nearest()), Err(QueryError::Smoothing));
    assert_eq!(planner.find_counted([(0, 0), (2, 0)]).unwrap_err(), QueryError::Smoothing);
    // What was prepared belongs to the costs alone.
    let plain = plain_space();
    assert!(index.repair(&Change::new(&plain)).is_err());
    let other = index.for_k(K::N16).expect("k = 4");
    assert_eq!(other.space().costs(), Some(&costs));
    assert!(index.for_k(K::ANY).is_err());
    let goals = plain.prepare(Engine::AStar).and_then(|index| index.goals([(0, 0)])).expect("free");
    assert_eq!(index.planner().distances((0, 0), &goals).unwrap_err().code(), ErrorCode::Mismatch);
}

#[test]
fn auto_is_a_star() {
    let space = space();
    assert_eq!(space.engine().engine, Engine::AStar);
    let engine = |demand| space.engine_for(demand).map(|choice| choice.engine);
    assert_eq!(engine(Demand::Paths(1)), Ok(Engine::AStar));
    assert_eq!(engine(Demand::Paths(100_000)), Ok(Engine::AStar));
    assert_eq!(engine(Demand::Changing { paths: 9 }), Ok(Engine::AStar));
    assert_eq!(engine(Demand::Distances), Ok(Engine::Dijkstra));
    assert!(engine(Demand::Index).is_err());
    let (setup, choice) = space.setup(&Call::default(), Demand::Paths(9)).expect("auto");
    assert_eq!(
        (setup.engine.kind(), choice.map(|choice| choice.engine)),
        (Engine::AStar, Some(Engine::AStar))
    );
    let named = Call::default().with_engine(Some(Engine::Hpa));
    assert!(matches!(space.setup(&named, Demand::Paths(9)), Err(SetupError::Costs { .. })));
    assert!(space.memory_bytes() > 0 && space.is_free((0, 0)) && !space.is_free((1, 1)));
    assert_eq!(space.motion().rules.placement(), PlacementKind::Center);
}

/// Paths that are none on the map have no cost, wherever they lead.
#[test]
fn odd_paths_have_no_cost() {
    let space = space();
    let ends = [(0, 0), (1, 1), (-1, 0), (4, 0), (i32::MAX, i32::MIN), (i32::MIN, i32::MAX)];
    for (&one, &other) in ends.iter().flat_map(|one| ends.iter().map(move |other| (one, other))) {
        let cost = space.cost(&Path::new(vec![one.into(), other.into()]));
        assert_eq!(cost, (one == (0, 0) && other == (0, 0)).then_some(0.0), "{one:?} → {other:?}");
    }
    assert_eq!(space.cost(&Path::new(Vec::new())), Some(0.0));
}
