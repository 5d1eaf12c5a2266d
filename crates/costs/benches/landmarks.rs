//! Paths with landmarks beside paths without, paths at any angle, and landmarks after edits. `cargo bench -p
//! mediant-costs --bench landmarks` writes the tables of `docs/measurements/costs.md`; `-- paths 512 4` those
//! of one kind (`paths`, `any-angle` or `edits`) for one side and one k.
//!
//! All planners answer the same queries, and the exact costs of A* are compared.
#![allow(clippy::print_stdout, reason = "a program talks to its user")]
#![allow(clippy::unwrap_used, reason = "a measurement may fail")]

use std::{sync::Arc, time::Instant};

use mediant_costs::{CostAStar, CostGraph, CostSurface, CostTheta, Landmarks, smooth};
use mediant_grid::{CornerRule, Interrupt, Rules, Vertex};
use mediant_moves::{Cost, FiniteK};
use mediant_oracle::Rng;
use mediant_search::{Counters, Ends, Path, Planner};

const QUERIES: usize = 100;
const COUNTS: [usize; 3] = [4, 8, 16];

/// A cost of each cell, row by row; 0 is blocked.
type Cells = Vec<u32>;

fn friction(side: u32, rng: &mut Rng) -> Cells {
    (0..side * side).map(|_| 16 + rng.below(144)).collect()
}

/// Heights from 0 to 1 by midpoint displacement, on a side of a power of two and one.
fn heights(side: usize, rng: &mut Rng) -> Vec<f64> {
    let size = (side - 1).next_power_of_two() + 1;
    let mut heights = vec![0.0; size * size];
    let (mut step, mut spread) = (size - 1, 1.0);
    let mut random = |spread: f64| (f64::from(rng.below(1 << 20)) / f64::from(1 << 19) - 1.0) * spread;
    while step > 1 {
        let half = step / 2;
        for y in (half..size).step_by(step) {
            for x in (half..size).step_by(step) {
                let corner = |dx: usize, dy: usize| heights[(y - half + dy) * size + x - half + dx];
                let mean = (corner(0, 0) + corner(step, 0) + corner(0, step) + corner(step, step)) / 4.0;
                heights[y * size + x] = mean + random(spread);
            }
        }
        for y in (0..size).step_by(half) {
            for x in ((y / half + 1) % 2 * half..size).step_by(step) {
                let near =
                    [(x.wrapping_sub(half), y), (x + half, y), (x, y.wrapping_sub(half)), (x, y + half)];
                let on: Vec<f64> = near
                    .iter()
                    .filter(|at| at.0 < size && at.1 < size)
                    .map(|at| heights[at.1 * size + at.0])
                    .collect();
                heights[y * size + x] = on.iter().sum::<f64>() / on.len() as f64 + random(spread);
            }
        }
        (step, spread) = (half, spread * 0.55);
    }
    (0..side * side).map(|at| heights[at / side * size + at % side]).collect()
}

/// The steeper, the dearer: 10 on level ground.
fn elevation(side: u32, rng: &mut Rng) -> Cells {
    let side = side as usize;
    let heights = heights(side, rng);
    let slope = |at: usize| {
        let (x, y) = (at % side, at / side);
        let height = |x: usize, y: usize| heights[y.min(side - 1) * side + x.min(side - 1)];
        let (dx, dy) = (height(x + 1, y) - height(x, y), height(x, y + 1) - height(x, y));
        (dx * dx + dy * dy).sqrt()
    };
    let slopes: Vec<f64> = (0..side * side).map(slope).collect();
    let mean = slopes.iter().sum::<f64>() / slopes.len() as f64;
    slopes.iter().map(|slope| 10 + (20.0 * slope / mean) as u32).collect()
}

/// Road, grass, forest, swamp: 1, 2, 5 and 10, each cell that of the nearest of random places.
fn patches(side: u32, rng: &mut Rng) -> Cells {
    const PITCH: u32 = 16;
    let columns = side / PITCH + 2;
    let places: Vec<(i32, i32, u32)> = (0..columns * columns)
        .map(|at| {
            let (x, y) = (at % columns * PITCH + rng.below(PITCH), at / columns * PITCH + rng.below(PITCH));
            (x as i32, y as i32, *rng.pick(&[1, 2, 5, 10]).unwrap())
        })
        .collect();
    let cell = |at: u32| {
        let (x, y) = ((at % side + PITCH / 2) as i32, (at / side + PITCH / 2) as i32);
        let (column, row) = (x / PITCH as i32, y / PITCH as i32);
        let near = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (column + dx, row + dy)));
        let near =
            near.filter(|&(x, y)| (0..columns as i32).contains(&x) && (0..columns as i32).contains(&y));
        let near = near.map(|(column, row)| places[row as usize * columns as usize + column as usize]);
        near.min_by_key(|place| (place.0 - x).pow(2) + (place.1 - y).pow(2)).unwrap().2
    };
    (0..side * side).map(cell).collect()
}

/// Rooms of 20 × 20 cells with doors of six, and dear cells beside the walls: 10 far from them, 100 at them.
fn rooms(side: u32, rng: &mut Rng) -> Cells {
    const PITCH: u32 = 21;
    let columns = side / PITCH + 1;
    let doors: Vec<[u32; 2]> = (0..columns * columns).map(|_| [rng.below(15), rng.below(15)]).collect();
    let is_wall = |x: u32, y: u32| {
        let [across, down] = doors[(y / PITCH * columns + x / PITCH) as usize];
        let is_door = |at: u32, door: u32| (door..door + 6).contains(&at);
        x % PITCH == 20 && !is_door(y % PITCH, across) || y % PITCH == 20 && !is_door(x % PITCH, down)
    };
    let cell = |at: u32| {
        let (x, y) = (at % side, at / side);
        if is_wall(x, y) {
            return 0;
        }
        let near = (-6..=6_i32).flat_map(|dy| (-6..=6_i32).map(move |dx| (dx, dy)));
        let walls = near.filter(|&(dx, dy)| {
            let at = (x.wrapping_add_signed(dx), y.wrapping_add_signed(dy));
            at.0 < side && at.1 < side && is_wall(at.0, at.1)
        });
        let nearest = walls.map(|(dx, dy)| dx * dx + dy * dy).min();
        nearest.map_or(10, |square| 10 + (90.0 * (-0.5 * (f64::from(square).sqrt() - 1.0)).exp()) as u32)
    };
    (0..side * side).map(cell).collect()
}

fn noise(side: u32, rng: &mut Rng) -> Cells {
    (0..side * side).map(|_| u32::from(!rng.chance(20))).collect()
}

/// A surface, by its side and random numbers.
type Surface = fn(u32, &mut Rng) -> Cells;

const SURFACES: [(&str, Surface); 5] = [
    ("friction 16 … 159", friction),
    ("elevation", elevation),
    ("patches", patches),
    ("rooms", rooms),
    ("walls 20 %, cost 1", noise),
];

/// The answers of a planner to the queries, and its work.
struct Row {
    costs: Vec<Cost>,
    /// Expansions a query.
    expanded: f64,
    /// Milliseconds a query: of each the shortest of the passes.
    time: f64,
}

const PASSES: usize = 3;

/// The rows of planners that answer the same queries in turn, each of them all at once, pass by pass: what
/// slows the machine slows all.
fn rows(graph: &CostGraph, planners: &mut [Engine], queries: &[Ends]) -> Vec<Row> {
    let mut times = vec![vec![f64::INFINITY; queries.len()]; planners.len()];
    for _ in 0..PASSES {
        for (planner, times) in planners.iter_mut().zip(&mut times) {
            for (&ends, best) in queries.iter().zip(times) {
                let start = Instant::now();
                planner.path(graph, ends, &mut Counters::default());
                *best = best.min(start.elapsed().as_secs_f64());
            }
        }
    }
    let each = 1.0 / queries.len() as f64;
    let row = |(planner, times): (&mut Engine, &Vec<f64>)| {
        let mut counters = Counters::default();
        let paths = queries.iter().map(|&ends| planner.path(graph, ends, &mut counters));
        let costs = paths.map(|path| graph.segments_cost(&path).unwrap()).collect();
        Row { costs, expanded: counters.expanded as f64 * each, time: times.iter().sum::<f64>() * 1e3 * each }
    };
    planners.iter_mut().zip(&times).map(row).collect()
}

enum Engine {
    AStar(CostAStar),
    Smooth(CostAStar),
    Theta(CostTheta),
}

impl Engine {
    fn path(&mut self, graph: &CostGraph, ends: Ends, counters: &mut Counters) -> Path {
        let path = match self {
            Self::AStar(planner) | Self::Smooth(planner) => planner.solve_observed(ends, counters),
            Self::Theta(planner) => planner.solve_observed(ends, counters),
        };
        let path = path.unwrap().into_path().unwrap();
        if let Self::Smooth(_) = self { smooth(graph, &path).unwrap().0 } else { path }
    }
}

/// The graph of a surface, and queries whose ends are joined.
fn problems(surface: Surface, side: u32, k: u32) -> (Arc<CostGraph>, Vec<Ends>) {
    let mut rng = Rng::new(u64::from(side));
    let cells = surface(side, &mut rng);
    let cost = |x: u32, y: u32| Some(f64::from(cells[(y * side + x) as usize])).filter(|&cost| cost > 0.0);
    let map = Arc::new(CostSurface::from_fn(side, side, cost).unwrap());
    let rules = Rules::Center(CornerRule::Never);
    let graph = Arc::new(CostGraph::new(map, rules, FiniteK::new(k).unwrap()).unwrap());
    let mut planner = CostAStar::new(Arc::clone(&graph));
    let mut queries = Vec::new();
    while queries.len() < QUERIES {
        let mut vertex = || Vertex::new(rng.below(side) as i32, rng.below(side) as i32);
        let ends = Ends::new(vertex(), vertex());
        let is_free = graph.is_free(ends.start) && graph.is_free(ends.goal);
        if is_free && planner.solve(ends).unwrap().path().is_some() {
            queries.push(ends);
        }
    }
    (graph, queries)
}

fn with_and_without(side: u32, k: u32) {
    println!("\n## {side} × {side}, k = {k}: landmarks, expansions, ms, times as fast\n");
    let mut factors = [0.0; COUNTS.len()];
    for (name, surface) in SURFACES {
        let (graph, queries) = problems(surface, side, k);
        let mut planners = vec![Engine::AStar(CostAStar::new(Arc::clone(&graph)))];
        let mut prepared = Vec::new();
        for count in COUNTS {
            let start = Instant::now();
            let landmarks = Arc::new(Landmarks::new(&graph, count, &Interrupt::NEVER).unwrap());
            prepared.push(start.elapsed().as_secs_f64());
            planners.push(Engine::AStar(CostAStar::with_landmarks(Arc::clone(&graph), landmarks).unwrap()));
        }
        let rows = rows(&graph, &mut planners, &queries);
        print!("| {name} | {:.0} | {:.2} |", rows[0].expanded, rows[0].time);
        for (number, row) in rows[1..].iter().enumerate() {
            assert_eq!(row.costs, rows[0].costs);
            let factor = rows[0].time / row.time;
            print!(" {:.2} | {:.0} | {:.2} | {factor:.1} |", prepared[number], row.expanded, row.time);
            factors[number] += factor.ln();
        }
        println!();
    }
    let means = factors.map(|sum| format!("{:.2}", (sum / SURFACES.len() as f64).exp()));
    println!("\nGeometric means: {}", means.join(", "));
}

fn any_angle(side: u32, k: u32) {
    println!("\n## {side} × {side}, k = {k}, 8 landmarks: ms, and percent of the cost of A*\n");
    for (name, surface) in SURFACES {
        let (graph, queries) = problems(surface, side, k);
        let landmarks = Arc::new(Landmarks::new(&graph, 8, &Interrupt::NEVER).unwrap());
        let a_star = || CostAStar::with_landmarks(Arc::clone(&graph), Arc::clone(&landmarks)).unwrap();
        let theta = |planner: CostTheta| Engine::Theta(planner.guided_by(Arc::clone(&landmarks)).unwrap());
        let mut planners = [
            Engine::AStar(a_star()),
            Engine::Smooth(a_star()),
            theta(CostTheta::lazy(Arc::clone(&graph))),
            theta(CostTheta::new(Arc::clone(&graph))),
        ];
        let rows = rows(&graph, &mut planners, &queries);
        print!("| {name} |");
        for row in &rows {
            let ratios = row
                .costs
                .iter()
                .zip(&rows[0].costs)
                .map(|(cost, by)| graph.to_f64(*cost) / graph.to_f64(*by));
            print!(" {:.2} | {:.2} |", row.time, 100.0 * ratios.sum::<f64>() / QUERIES as f64);
        }
        println!();
    }
}

/// One random cell after the other changes.
fn edits(side: u32, k: u32) {
    println!("\n## {side} × {side}, k = {k}, 8 landmarks, one cell: ms to make, to follow a rise, a fall\n");
    for (name, surface) in SURFACES {
        let (graph, _) = problems(surface, side, k);
        let start = Instant::now();
        let landmarks = Landmarks::new(&graph, 8, &Interrupt::NEVER).unwrap();
        print!("| {name} | {:.0} |", start.elapsed().as_secs_f64() * 1e3);
        let (least, greatest) = graph.map().bounds();
        for cost in [Some(greatest).filter(|&greatest| greatest > least), Some(least)] {
            let mut rng = Rng::new(1);
            let (mut before, mut current, mut times) = (Arc::clone(&graph), landmarks.clone(), Vec::new());
            for _ in 0..200 {
                let (x, y) = (rng.below(side), rng.below(side));
                let map = Arc::new(before.map().edit([(x, y, cost)]).unwrap());
                let after = Arc::new(CostGraph::new(map, graph.rules(), graph.k()).unwrap());
                let start = Instant::now();
                current = current.repaired(&before, &after, &[(x, y)], &Interrupt::NEVER).unwrap();
                times.push(start.elapsed().as_secs_f64() * 1e3);
                before = after;
            }
            // The first ones copy the numbers.
            let times = &times[3..];
            let greatest = times.iter().fold(0.0_f64, |greatest, &time| greatest.max(time));
            print!(" {:.4} (at most {greatest:.2}) |", times.iter().sum::<f64>() / times.len() as f64);
        }
        println!();
    }
}

fn main() {
    let words: Vec<String> = std::env::args().collect();
    let numbers: Vec<u32> = words.iter().filter_map(|word| word.parse().ok()).collect();
    let has = |name: &str| words.iter().any(|word| word == name);
    let all = ![has("paths"), has("any-angle"), has("edits")].contains(&true);
    let sides = numbers.first().map_or(vec![512, 1024], |&side| vec![side]);
    let ks = numbers.get(1).map_or(vec![3, 4, 6], |&k| vec![k]);
    for (side, k) in sides.iter().flat_map(|&side| ks.iter().map(move |&k| (side, k))) {
        if all || has("paths") {
            with_and_without(side, k);
        }
        if all || has("any-angle") {
            any_angle(side, k);
        }
        if all || has("edits") {
            edits(side, k);
        }
    }
}
