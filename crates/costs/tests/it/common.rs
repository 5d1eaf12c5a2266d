//! Helpers of all tests.

use std::sync::Arc;

use mediant_costs::{CostGraph, CostSurface};
use mediant_grid::{Interrupt, Rules, Vertex};
use mediant_moves::FiniteK;
use mediant_oracle::{Integral, WeightedMap, random_weighted, seeds};

/// The surface of a map of the oracle; the description of the map in errors.
pub(crate) fn surface(map: &WeightedMap, about: &str) -> Arc<CostSurface> {
    let size = (map.grid().width(), map.grid().height());
    let cost = |x: u32, y: u32| map.weight(x as i32, y as i32).map(f64::from);
    let surface = CostSurface::with_cells(size, map.cell_size(), &Interrupt::NEVER, cost);
    Arc::new(surface.unwrap_or_else(|error| panic!("{about}: {error}")))
}

pub(crate) fn graph(surface: &Arc<CostSurface>, rules: Rules, k: u32) -> Arc<CostGraph> {
    let k = FiniteK::new(k).expect("a small k");
    Arc::new(CostGraph::new(Arc::clone(surface), rules, k).expect("a small k"))
}

/// The engines' rounding of an exact integral.
pub(crate) fn rounded(graph: &CostGraph) -> impl Fn(&Integral) -> u64 {
    |integral| {
        let sum = u64::try_from(integral.numerator).expect("weights have 32 bits");
        graph.cost_of_sum(integral.by, sum).expect("a move of N(k)").to_bits()
    }
}

/// Calls `check` for random maps with all rules, and for each a k, which differs from map to map.
pub(crate) fn for_random_maps(
    maps: u64,
    mut check: impl FnMut(&WeightedMap, &Arc<CostSurface>, Rules, u32, &str),
) {
    for seed in seeds(maps) {
        let (map, about) = random_weighted(seed);
        let about = format!("seed {seed}: {about}\n{map}");
        let surface = surface(&map, &about);
        for (rules, number) in Rules::ALL.into_iter().zip(0..) {
            let k = 2 + ((seed / 3 + number) % 7) as u32;
            check(&map, &surface, rules, k, &format!("{rules}, k = {k}, {about}"));
        }
    }
}

/// All vertices of a graph, row by row.
pub(crate) fn vertices(graph: &CostGraph) -> impl Iterator<Item = Vertex> + use<> {
    let (width, height) = graph.size();
    (0..height as i32).flat_map(move |y| (0..width as i32).map(move |x| Vertex::new(x, y)))
}
