//! Benchmarks on four generated maps: whole queries of each engine for every k that it takes up to 8 and for
//! any-angle paths, the generation of successors, the open list, and what a space costs. Use these times only
//! to compare one revision with another.

use std::{hint::black_box, sync::Arc};

use criterion::{BenchmarkId, Criterion, Throughput};
use mediant::{Engine, Map, Motion, Setup, Space};
use mediant_grid::{
    Centers, CornerRule, Corners, DiagonalGap, Grid, GridGraph, Placement, Rules, Vertex, VertexId,
};
use mediant_moves::{Cost, FiniteK, K};
use mediant_oracle::{Rng, caves, maze, noise, random_free_vertex, sparse};
use mediant_search::{
    Ends,
    parts::{Entry, OpenList},
};

const SEED: u64 = 1;
const SIDE: u32 = 160;
const QUERIES: usize = 10;
const ENTRIES: u32 = 4096;
const ENGINES: [Engine; 10] = [
    Engine::AStar,
    Engine::Canonical,
    Engine::Jps,
    Engine::JpsBlock,
    Engine::JpsPlus,
    Engine::Theta,
    Engine::LazyTheta,
    Engine::Anya,
    Engine::Subgoal,
    Engine::SubgoalTheta,
];
const RULES: [Rules; 2] = [Rules::Center(CornerRule::Never), Rules::Corner(DiagonalGap::Open)];

fn main() {
    let mut c = Criterion::default().sample_size(20).configure_from_args();
    let mut rng = Rng::new(SEED);
    let maps = [
        ("caves", Arc::new(caves(&mut rng, SIDE, SIDE))),
        ("noise", Arc::new(noise(&mut rng, SIDE, SIDE, 25))),
        ("maze", Arc::new(maze(&mut rng, SIDE, SIDE))),
        ("sparse", Arc::new(sparse(&mut rng, SIDE, 100))),
    ];
    for engine in ENGINES {
        for (name, grid) in &maps {
            let ks = (2..=8).filter_map(|k| FiniteK::new(k).ok()).map(K::Finite).chain([K::Any]);
            let setups = ks.flat_map(|k| RULES.map(|rules| Setup::new(engine, Motion::new(k, rules))));
            for setup in setups.filter(|setup| setup.check().is_ok()) {
                queries(&mut c, setup, name, grid);
            }
        }
    }
    for (name, grid) in &maps {
        for k in [3, 5, 8] {
            successors::<Centers>(&mut c, name, grid, CornerRule::Never, k);
            successors::<Corners>(&mut c, name, grid, DiagonalGap::Open, k);
        }
    }
    heap(&mut c);
    spaces(&mut c);
    c.final_summary();
}

fn grid_graph<P: Placement>(grid: &Arc<Grid>, rule: P::Rule, k: u32) -> GridGraph<P> {
    let k = FiniteK::new(k).expect("k is at least 2");
    GridGraph::new(Arc::clone(grid), k, rule).expect("k is at most 12")
}

/// Random queries, the same for every k. All of them have a path.
fn random_queries(grid: &Grid, space: &Space) -> Vec<Ends> {
    let (mut rng, placement) = (Rng::new(SEED), space.motion().rules.placement());
    let mut end = || random_free_vertex(&mut rng, grid, placement).expect("the map has free cells");
    let pairs = std::iter::repeat_with(|| (end(), end()));
    let connected = pairs.filter(|&(start, goal)| space.connected(start, goal));
    connected.take(QUERIES).map(|(start, goal)| Ends::new(start, goal)).collect()
}

/// Benchmarks all queries together, on a warm planner.
fn queries(c: &mut Criterion, setup: Setup, map: &str, grid: &Arc<Grid>) {
    let space = setup.space(&Map::from(Arc::clone(grid))).expect("the setup was checked");
    let queries = random_queries(grid, &space);
    let mut planner = setup.prepare(&space).expect("the setup was checked").planner();
    let mut group = c.benchmark_group(format!("{}/{}/{map}", setup.engine.kind(), setup.rules().placement()));
    group.throughput(Throughput::Elements(queries.len() as u64));
    group.bench_function(BenchmarkId::from_parameter(setup.k()), |b| {
        b.iter(|| queries.iter().for_each(|&query| _ = black_box(planner.find(black_box(query)))));
    });
    group.finish();
}

/// Benchmarks the legal moves of all free vertices, row by row.
fn successors<P: Placement>(c: &mut Criterion, map: &str, grid: &Arc<Grid>, rule: P::Rule, k: u32) {
    let grid_graph = grid_graph::<P>(grid, rule, k);
    let (width, height) = P::vertices(grid);
    let all = (0..height as i32).flat_map(|y| (0..width as i32).map(move |x| Vertex::new(x, y)));
    let vertices: Vec<Vertex> = all.filter(|&at| grid_graph.is_free(at)).collect();
    let mut group = c.benchmark_group(format!("successors/{}/{map}", P::KIND));
    group.throughput(Throughput::Elements(vertices.len() as u64));
    group.bench_function(BenchmarkId::from_parameter(k), |b| {
        b.iter(|| {
            let mut sum = 0;
            for &at in black_box(&vertices) {
                grid_graph.for_each_legal_move(at, |index| sum += index);
            }
            sum
        });
    });
    group.finish();
}

/// Benchmarks the open list: pushes random entries, decreases every second one, pops all.
fn heap(c: &mut Criterion) {
    let mut rng = Rng::new(SEED);
    let mut cost = || Cost::from_bits(1 << 40 | rng.bits() >> 24);
    let costs: Vec<(Cost, Cost)> = (0..ENTRIES).map(|_| (cost(), cost())).collect();
    let mut open = OpenList::default();
    let mut slots = vec![0_u32; ENTRIES as usize];
    let mut group = c.benchmark_group("heap");
    group.throughput(Throughput::Elements(u64::from(ENTRIES)));
    group.bench_function("push, decrease, pop", |b| {
        b.iter(|| {
            let mut swaps = 0;
            for (id, &(f, h)) in (0..).map(VertexId).zip(black_box(&costs)) {
                swaps += open.push(Entry::new(f, h, id), |id, slot| slots[id.index()] = slot);
            }
            for id in (0..slots.len()).step_by(2) {
                swaps +=
                    open.decrease(slots[id], Cost::from_bits(1 << 39), |id, slot| slots[id.index()] = slot);
            }
            while let Some((_, more)) = open.pop(|id, slot| slots[id.index()] = slot) {
                swaps += more;
            }
            swaps
        });
    });
    group.finish();
}

/// Benchmarks what each map costs before its first query: a space, its search graph, and an index that
/// prepares nothing. Tables of the motion are there already.
fn spaces(c: &mut Criterion) {
    let map = Map::from_fn(4, 4, |x, y| (x, y) == (1, 2)).expect("a valid size");
    for k in [2, 3, 5, 12].map(|k| FiniteK::new(k).expect("k is at least 2")) {
        for rules in RULES {
            let motion = Motion::new(k, rules);
            let mut group = c.benchmark_group(format!("space/{}/4x4", rules.placement()));
            group.bench_function(BenchmarkId::from_parameter(k), |b| {
                b.iter(|| {
                    let space = black_box(&map).space(motion).expect("k is at most 12");
                    space.prepare(Engine::AStar).expect("it takes every motion")
                });
            });
            group.finish();
        }
    }
    let map = Map::from_fn(80, 25, |x, y| x == 40 && y != 12).expect("a valid size");
    let space = map.space(Motion::centers(K::N8)).expect("k is at most 12");
    let (start, goal) = ((3, 3), (76, 20));
    let mut group = c.benchmark_group("one path/80x25");
    group.bench_function("map", |b| b.iter(|| map.path(start, goal)));
    group.bench_function("space", |b| b.iter(|| space.path(start, goal)));
    group.finish();
}
