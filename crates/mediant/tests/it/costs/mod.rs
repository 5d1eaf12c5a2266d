//! Costs of cells: queries with every wish, fields, edits and errors, against Dijkstra's algorithm on the
//! explicit graph with exact integrals.

mod costmaps;
mod edits;
mod fields;
mod kept;
mod landmarks;
mod long;
mod queries;
mod rasters;
mod refused;
mod theta;

use std::sync::Arc;

use mediant::{
    Costs, Demand, Engine, FiniteK, Map, Motion, Path, PlacementKind, Planner, Rules, Space, Vertex,
    call::{Call, Group, Parameter, Spelling, Value},
    errors::SetupError,
};
use mediant_costs::CostGraph;
use mediant_moves::{Cost, CostTable};
use mediant_oracle::{
    Integral, Rng, WeightedGraph, WeightedMap, random_free_vertex, random_vertex, random_weighted,
    weighted_path_cost,
};

use super::k;

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

    fn planners(&self) -> [Planner; 3] {
        [Engine::AStar, Engine::Dijkstra, Engine::Landmarks]
            .map(|engine| self.space.planner(engine).unwrap_or_else(|error| panic!("{error}")))
    }

    /// Planners of all engines that know costs.
    fn all_planners(&self) -> Vec<Planner> {
        let known = Engine::ALL.into_iter().filter(|engine| engine.capabilities().costs);
        known.map(|engine| self.space.planner(engine).unwrap_or_else(|error| panic!("{error}"))).collect()
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
fn auto_follows_what_is_asked() {
    let space = space();
    assert_eq!(space.engine().engine, Engine::Landmarks);
    let engine = |demand| space.engine_for(demand).map(|choice| choice.engine);
    for (few, many) in [
        (Demand::Paths(1), Demand::Paths(101)),
        (Demand::Paths(100), Demand::Paths(u64::MAX)),
        (Demand::Changing { paths: 0 }, Demand::Changing { paths: 11 }),
        (Demand::Changing { paths: 10 }, Demand::Changing { paths: u64::MAX }),
    ] {
        assert_eq!((engine(few), engine(many)), (Ok(Engine::AStar), Ok(Engine::Landmarks)));
    }
    assert_eq!(engine(Demand::Distances), Ok(Engine::Dijkstra));
    assert_eq!(engine(Demand::Index), Ok(Engine::Landmarks));
    // Where all cells cost the same, landmarks find little.
    let equal = space.map().costs([3; 12]).expect("costs").space(Motion::default()).expect("k = 3");
    let of_equal = |demand| equal.engine_for(demand).map(|choice| choice.engine);
    assert_eq!((equal.engine().engine, of_equal(Demand::Paths(9_999))), (Engine::AStar, Ok(Engine::AStar)));
    assert_eq!(of_equal(Demand::Index), Ok(Engine::Landmarks));
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

/// Options that the recommended engine does not take lead to one that does.
#[test]
fn auto_takes_the_options_that_are_given() {
    let space = space();
    for (name, value, paths, engine) in [
        ("heuristic", "zero".into(), 1_000, Engine::AStar),
        ("landmarks", Value::from(16), 1, Engine::Landmarks),
    ] {
        let mut call = Call::default();
        let parameter = Parameter::find(name, Spelling::Kebab, &Group::ALL).expect("a parameter");
        call.set(parameter, value).expect("a value of it");
        let (setup, choice) = space.setup(&call, Demand::Paths(paths)).expect("an engine takes it");
        assert_eq!((setup.engine.kind(), choice.map(|choice| choice.engine)), (engine, Some(engine)));
    }
    let mut call = Call::default();
    let side = Parameter::find("side", Spelling::Kebab, &Group::ALL).expect("a parameter");
    call.set(side, Value::from(4)).expect("a value of it");
    assert!(matches!(space.setup(&call, Demand::Paths(1)), Err(SetupError::Option { .. })));
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
