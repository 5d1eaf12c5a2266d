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
use mediant_oracle::{Rng, Surface};
use mediant_search::{Counters, Ends, Path, Planner};

const QUERIES: usize = 100;
const COUNTS: [usize; 3] = [4, 8, 16];

const SURFACES: [Surface; 5] =
    [Surface::Friction, Surface::Elevation, Surface::Patches, Surface::Rooms, Surface::Walls];

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
    let cells = surface.costs(side, &mut rng);
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
    for surface in SURFACES {
        let name = surface.name();
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
    for surface in SURFACES {
        let name = surface.name();
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
    for surface in SURFACES {
        let name = surface.name();
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
