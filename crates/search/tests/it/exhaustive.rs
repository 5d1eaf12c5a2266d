//! Every map of 4 × 4 cells, from every vertex to every other, k = 3, 4, 5, all five rules: the canonical and
//! jump point family against Dijkstra, exactly, in integer costs.
//!
//! By default on every 509th map; with `MEDIANT_EXHAUSTIVE=1` on all 65,536, with `MEDIANT_EXHAUSTIVE=3` on
//! every third.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::{
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
    thread,
};

use mediant_grid::{
    Centers, CornerRule, Corners, DiagonalGap, Grid, GridGraph, MoveSet, Placement, Vector, Vertex, VertexId,
};
use mediant_moves::{Cost, FiniteK};
use mediant_oracle::describe;
use mediant_search::{
    Answer, BlockJps, Canonical, CanonicalRule, Dijkstra, Ends, FieldQuery, Fields, Guarantee, Hk, Jps,
    JpsPlus, JumpTable, Path, Planner, Pruning, Zero,
    parts::{BlockFinder, StepwiseFinder},
};

const SIDE: u32 = 4;
const MAPS: u64 = 1 << (SIDE * SIDE);

/// How many answers are expected for k = 3, 4 and 5 if every so-manieth map is asked.
#[derive(Clone, Copy)]
struct Sample {
    every: u64,
    centers: [u64; 3],
    corners: [u64; 3],
}

/// The default sample first. Their steps are odd, so that the maps of each differ in all cells. The rules of
/// a placement do not matter: which vertices are free does not depend on them.
const SAMPLES: [Sample; 3] = [
    Sample { every: 509, centers: [48_024, 32_016, 32_016], corners: [287_784, 191_856, 191_856] },
    Sample {
        every: 3,
        centers: [8_913_216, 5_942_144, 5_942_144],
        corners: [50_766_372, 33_844_248, 33_844_248],
    },
    Sample {
        every: 1,
        centers: [26_738_688, 17_825_792, 17_825_792],
        corners: [152_297_472, 101_531_648, 101_531_648],
    },
];

/// One map under one rule and k, with what the answers of its engines are checked against.
struct Judge<'g, P: Placement> {
    grid_graph: &'g GridGraph<P>,
    map: u64,
    vertices: Vec<Vertex>,
    /// By vertex number.
    legal: Vec<MoveSet>,
    /// The distances by Dijkstra's algorithm, by the indices of start and goal in `vertices`.
    distances: Vec<Vec<Option<Cost>>>,
    compared: u64,
}

impl<'g, P: Placement> Judge<'g, P> {
    fn new(grid_graph: &'g GridGraph<P>, map: u64) -> Self {
        let all = (0..grid_graph.vertex_count() as u32).map(|id| grid_graph.vertex(VertexId(id)));
        let legal = all.clone().map(|at| grid_graph.legal_moves(at)).collect();
        let vertices: Vec<Vertex> = all.filter(|&at| grid_graph.is_free(at)).collect();
        let mut judge = Self { grid_graph, map, vertices, legal, distances: Vec::new(), compared: 0 };
        let mut dijkstra = Dijkstra::new(grid_graph, Zero);
        let mut distance = |start, goal| {
            let answer = dijkstra.solve(Ends::new(start, goal)).unwrap();
            answer.path().map(|path| judge.cost(path, start, goal).unwrap())
        };
        let from = |&start: &Vertex| judge.vertices.iter().map(|&goal| distance(start, goal)).collect();
        judge.distances = judge.vertices.iter().map(from).collect();
        judge
    }

    /// Compares the fields of all vertices with the distances.
    fn judge_fields(&mut self, mut fields: Fields<&GridGraph<P>, P>) {
        let (grid_graph, map) = (self.grid_graph, self.map);
        for (&start, distances) in self.vertices.iter().zip(&self.distances) {
            let field = fields.field(FieldQuery::new(&[start])).unwrap();
            for (&goal, &distance) in self.vertices.iter().zip(distances) {
                let case = || describe(grid_graph.grid(), grid_graph.rules(), start, goal, map);
                assert_eq!(field.get(goal), distance, "k = {}; {}", grid_graph.k(), case());
                let path = field.path_from(goal);
                let cost = path.map(|path| self.cost(&path, goal, start));
                assert_eq!(cost, distance.map(Ok), "k = {}; {}", grid_graph.k(), case());
            }
        }
    }

    /// Compares all answers of an engine with the distances.
    fn judge(&mut self, name: &str, mut planner: impl Planner) {
        let k = self.grid_graph.k();
        assert_eq!(planner.guarantee(), Guarantee::Optimal(k), "{name}");
        for (&start, distances) in self.vertices.iter().zip(&self.distances) {
            for (&goal, &distance) in self.vertices.iter().zip(distances) {
                let answer = planner.solve(Ends::new(start, goal)).unwrap();
                let found = match &answer {
                    Answer::Found(path) => Some(self.cost(path, start, goal)),
                    _ => None,
                };
                assert!(
                    found == distance.map(Ok),
                    "{name}, k = {k}: {answer:?} costs {found:?}, Dijkstra {distance:?}; {}",
                    describe(self.grid_graph.grid(), self.grid_graph.rules(), start, goal, self.map)
                );
                self.compared += 1;
            }
        }
    }

    /// The cost of a path's moves, if it is legal.
    fn cost(&self, path: &Path, start: Vertex, goal: Vertex) -> Result<Cost, &'static str> {
        let grid_graph = self.grid_graph;
        let (mut at, mut by, mut cost) = (start, None, Cost::ZERO);
        let [first, rest @ ..] = path.waypoints() else { return Err("no waypoint") };
        if *first != start || rest.last().unwrap_or(first) != &goal {
            return Err("other ends");
        }
        for &end in rest {
            let d = at.to(end);
            let is_ahead = |v: Vector| v.x * d.y == v.y * d.x && v.x * d.x + v.y * d.y > 0;
            let step = grid_graph.steps().iter().position(|step| is_ahead(step.vector()));
            let index = step.ok_or("no move of the neighborhood")?;
            while at != end {
                let id = grid_graph.id(at).ok_or("no multiple of a move")?;
                if !self.legal[id.index()].contains(index) || !grid_graph.may_step(at, by, index, goal) {
                    return Err("no legal move");
                }
                (at, by) = (at + grid_graph.step(index).vector(), Some(index));
                cost += grid_graph.step(index).cost;
            }
        }
        Ok(cost)
    }
}

/// Checks all engines against the distances on one map. Returns how many answers were compared.
fn compare<P: Placement>(map: u64, k: FiniteK, rule: P::Rule, canonical: &Arc<CanonicalRule<P>>) -> u64 {
    let grid = Grid::from_fn(SIDE, SIDE, |x, y| map >> (SIDE * y + x) & 1 == 1).unwrap();
    let grid_graph = &GridGraph::<P>::new(Arc::new(grid), k, rule).unwrap();
    let pruning = &Arc::new(Pruning::with_rule(grid_graph, Arc::clone(canonical)).unwrap());
    let mut judge = Judge::new(grid_graph, map);
    let (h, pruning) = (Hk, || Arc::clone(pruning));
    judge.judge_fields(Fields::with_pruning(grid_graph, pruning()).unwrap());
    judge.judge("canonical", Canonical::with_pruning(grid_graph, pruning(), h).unwrap());
    let jps = || Jps::with_finder(grid_graph, pruning(), StepwiseFinder, h).unwrap();
    judge.judge("jps", jps());
    judge.judge("jps, jumps of at most 2", jps().with_jump_limit(Some(2)));
    judge.judge("jps, with intermediate nodes", jps().with_intermediate(true));
    if k == FiniteK::N8 {
        let (blocks, table) = (
            BlockFinder::new(grid_graph, &pruning()).unwrap(),
            Arc::new(JumpTable::new(grid_graph).unwrap()),
        );
        judge.judge("jps-block", BlockJps::with_finder(grid_graph, pruning(), blocks, h).unwrap());
        judge.judge("jps-plus", JpsPlus::with_finder(grid_graph, pruning(), table, h).unwrap());
    }
    judge.compared
}

/// Compares on every so-manieth map. `expected` are the numbers of answers for each k.
fn check<P: Placement>(rule: P::Rule, every: u64, expected: [u64; 3]) {
    for (k, expected) in (3..).zip(expected) {
        let k = FiniteK::new(k).unwrap();
        let canonical = Arc::new(CanonicalRule::new(k, rule));
        let (next, compared) = (AtomicU64::new(0), AtomicU64::new(0));
        let work = || {
            let map = || Some(next.fetch_add(every, Ordering::Relaxed)).filter(|&map| map < MAPS);
            let sum = std::iter::from_fn(map).map(|map| compare::<P>(map, k, rule, &canonical)).sum();
            compared.fetch_add(sum, Ordering::Relaxed);
        };
        thread::scope(|scope| {
            let threads = thread::available_parallelism().map_or(1, usize::from);
            (0..threads).for_each(|_| _ = scope.spawn(work));
        });
        assert_eq!(compared.into_inner(), expected, "k = {k}, {}", P::rules(rule));
    }
}

#[test]
fn engines_are_exact_on_every_map_of_sixteen_cells() {
    let wanted = std::env::var("MEDIANT_EXHAUSTIVE").ok().and_then(|value| value.parse().ok());
    let sample = SAMPLES.into_iter().find(|sample| Some(sample.every) == wanted).unwrap_or(SAMPLES[0]);
    for corners in [CornerRule::Never, CornerRule::One, CornerRule::Always] {
        check::<Centers>(corners, sample.every, sample.centers);
    }
    for gap in [DiagonalGap::Open, DiagonalGap::Closed] {
        check::<Corners>(gap, sample.every, sample.corners);
    }
}
