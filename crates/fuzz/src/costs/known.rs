//! The oracle's knowledge of a map with costs.

use std::{
    cell::{OnceCell, RefCell},
    collections::BTreeMap,
    sync::Arc,
};

use mediant::{Costs, FiniteK, Map, Path, Rules, Vertex};
use mediant_costs::CostGraph;
use mediant_grid::Grid;
use mediant_moves::Cost;
use mediant_oracle::{
    Integral, WeightedGraph, WeightedMap, vertex_is_free, weighted_path_cost, weighted_path_length,
};

/// Costs that are summed in floating point differ by less than this part of themselves.
pub(super) const ROOM: f64 = 1e-6;

/// A map, and what the oracle knows of it once it is asked.
pub(super) struct Known {
    map: WeightedMap,
    rules: Rules,
    k: FiniteK,
    /// It rounds the cost of a move; nothing else of it is asked.
    rounding: CostGraph,
    graph: OnceCell<WeightedGraph>,
    from: RefCell<BTreeMap<(i32, i32), Vec<Option<u64>>>>,
}

impl Known {
    /// `costs` are those of `map`: their units depend on what they were before an edit.
    pub(super) fn new(map: WeightedMap, costs: &Costs, rules: Rules, k: FiniteK) -> Self {
        let rounding = CostGraph::new(Arc::clone(costs.surface()), rules, k).expect("a small k");
        Self { map, rules, k, rounding, graph: OnceCell::new(), from: RefCell::new(BTreeMap::new()) }
    }

    pub(super) const fn map(&self) -> &WeightedMap {
        &self.map
    }

    fn rounded(&self) -> impl Fn(&Integral) -> u64 {
        |integral| {
            let sum = u64::try_from(integral.numerator).expect("small weights");
            self.rounding.cost_of_sum(integral.by, sum).expect("a move of N(k)").to_bits()
        }
    }

    /// The least cost between two vertices, in the map's unit.
    pub(super) fn cost(&self, from: Vertex, to: Vertex) -> Option<f64> {
        let graph = self.graph.get_or_init(|| WeightedGraph::new(&self.map, self.rules, Some(self.k)));
        let mut known = self.from.borrow_mut();
        let costs = known.entry((from.x, from.y)).or_insert_with(|| graph.costs(&[from], self.rounded()));
        let cost = costs[graph.index(to)?]?;
        Some(self.rounding.to_f64(Cost::from_bits(cost)))
    }

    pub(super) fn is_free(&self, at: Vertex) -> bool {
        vertex_is_free(self.map.grid(), self.rules.placement(), at)
    }

    /// The columns and rows of vertices.
    pub(super) fn size(&self) -> (i32, i32) {
        let (width, height) = self.rounding.size();
        (width as i32, height as i32)
    }

    /// All free vertices, row by row.
    pub(super) fn free(&self) -> Vec<Vertex> {
        let (width, height) = self.size();
        let all = (0..height).flat_map(|y| (0..width).map(move |x| Vertex::new(x, y)));
        all.filter(|&at| self.is_free(at)).collect()
    }

    /// The cost of a path over N(k), exactly; `None` if it is not legal.
    pub(super) fn exact(&self, path: &Path) -> Option<f64> {
        let cost = weighted_path_cost(&self.map, self.rules, Some(self.k), path.waypoints(), self.rounded());
        cost.ok().map(|cost| self.rounding.to_f64(Cost::from_bits(cost)))
    }

    /// The cost of a path at any angle, in floating point; `None` if it is not legal.
    pub(super) fn measured(&self, path: &Path) -> Option<f64> {
        weighted_path_length(&self.map, self.rules, None, path.waypoints()).ok()
    }
}

/// The map with other costs; `None` blocks a cell.
pub(super) fn edited(map: &WeightedMap, cells: &[(Vertex, Option<u32>)]) -> WeightedMap {
    let (width, height) = (map.grid().width(), map.grid().height());
    // The last word about a cell counts.
    let word = |x: u32, y: u32| {
        let is_here = |cell: &Vertex| (cell.x, cell.y) == (x as i32, y as i32);
        let word = cells.iter().rev().find(|(cell, _)| is_here(cell)).map(|&(_, weight)| weight);
        word.unwrap_or_else(|| map.weight(x as i32, y as i32))
    };
    let grid = Grid::from_fn(width, height, |x, y| word(x, y).is_none()).expect("the same size");
    let (x, y) = map.cell_size();
    WeightedMap::from_fn(grid, |x, y| word(x, y).unwrap_or(1)).with_cell_size(x, y)
}

/// The library's costs of such a map.
pub(super) fn costs(map: &WeightedMap) -> Costs {
    let costs = Map::from(map.grid().clone()).costs(map.weights().iter().copied());
    let (x, y) = map.cell_size();
    costs.and_then(|costs| costs.with_cell_size(x, y)).unwrap_or_else(|error| panic!("{error}\n{map}"))
}
