//! Fields after edits, repaired and made anew. `cargo bench -p mediant-costs --bench fields` writes the
//! figures of `docs/measurements/costs.md`; `-- 512 3` those of one side and one k.
#![allow(clippy::print_stdout, reason = "a program talks to its user")]
#![allow(clippy::unwrap_used, reason = "a measurement may fail")]

use std::{sync::Arc, time::Instant};

use mediant_costs::{CostField, CostFieldQuery, CostGraph, CostSurface};
use mediant_grid::{CornerRule, Interrupt, Rules, Vertex};
use mediant_moves::FiniteK;
use mediant_oracle::{Rng, Surface};

const SURFACES: [Surface; 5] =
    [Surface::Friction, Surface::Elevation, Surface::Patches, Surface::Rooms, Surface::Walls];
const EDITS: usize = 200;

/// One random cell after the other gets a random cost of the surface, or is blocked as some are. The source
/// is the free vertex that is nearest to the middle in its row.
fn edits(surface: Surface, side: u32, k: u32) {
    let mut rng = Rng::new(u64::from(side));
    let cells = surface.costs(side, &mut rng);
    let known = |cost: u32| Some(f64::from(cost)).filter(|&cost| cost > 0.0);
    let cost = |x: u32, y: u32| known(cells[(y * side + x) as usize]);
    let map = Arc::new(CostSurface::from_fn(side, side, cost).unwrap());
    let rules = Rules::Center(CornerRule::Never);
    let mut graph = Arc::new(CostGraph::new(map, rules, FiniteK::new(k).unwrap()).unwrap());
    let half = side as i32 / 2;
    let source = (half..).map(|x| Vertex::new(x, half)).find(|&at| graph.is_free(at)).unwrap();
    let sources = [source];
    let query = CostFieldQuery::new(&sources);
    let new = |graph: &Arc<CostGraph>| CostField::new(Arc::clone(graph), query, &Interrupt::NEVER).unwrap();
    let timed = |graph| {
        let start = Instant::now();
        let field = new(graph);
        (field, start.elapsed().as_secs_f64() * 1e3)
    };
    let anew = (0..3).map(|_| timed(&graph).1).fold(f64::INFINITY, f64::min);
    let (mut field, mut times, mut given_up) = (new(&graph), Vec::new(), Vec::new());
    for _ in 0..EDITS {
        let cell = (rng.below(side), rng.below(side));
        let cost = known(cells[rng.below(side * side) as usize]);
        if cell == (source.x as u32, source.y as u32) {
            continue;
        }
        let map = graph.map().edit([(cell.0, cell.1, cost)]).unwrap();
        graph = Arc::new(graph.after(Arc::new(map), &[cell]).unwrap());
        let start = Instant::now();
        let repaired = field.repaired(&graph, &[cell], &Interrupt::NEVER).unwrap();
        let took = start.elapsed().as_secs_f64() * 1e3;
        field = match repaired {
            Some(repaired) => {
                times.push(took);
                repaired
            }
            None => {
                given_up.push(took);
                new(&graph)
            }
        };
    }
    assert_eq!(field.clone().into_rows(), new(&graph).into_rows());
    // The first one copies the costs.
    let times = &mut times[1..];
    times.sort_by(f64::total_cmp);
    let mean = times.iter().sum::<f64>() / times.len() as f64;
    let (median, worst) = (times[times.len() / 2], times[times.len() - 1]);
    let longest = given_up.iter().fold(0.0_f64, |longest, &time| longest.max(time));
    println!(
        "| {} | {side}² | {k} | {anew:.1} | {median:.4} | {mean:.4} | {worst:.2} | {} of {EDITS} ({longest:.2}) |",
        surface.name(),
        given_up.len()
    );
}

fn main() {
    let numbers: Vec<u32> = std::env::args().filter_map(|word| word.parse().ok()).collect();
    let sides = numbers.first().map_or(vec![512, 2048], |&side| vec![side]);
    let ks = numbers.get(1).map_or(vec![3, 5], |&k| vec![k]);
    println!("ms: anew; repaired: median, mean, worst; given up (at most)");
    for (side, k) in sides.iter().flat_map(|&side| ks.iter().map(move |&k| (side, k))) {
        SURFACES.into_iter().for_each(|surface| edits(surface, side, k));
    }
}
