//! What k is worth: the costs for k = 2 to 8 over those for k = 12.

use std::{cmp::Reverse, collections::BinaryHeap, sync::Arc};

use mediant_costs::{CostField, CostFieldQuery, CostGraph};
use mediant_grid::{Interrupt, Vertex};
use mediant_moves::{FiniteK, Neighborhood, Vector};
use mediant_oracle::Rng;
use mediant_report::{Row, stats::mean};

use super::{
    Part, SEED,
    surfaces::{Kind, graph},
};
use crate::compare::CompareError;

/// Small, since every vertex has 4,096 moves.
const SIDE: u32 = 160;
/// The sources, a field each.
const SOURCES: usize = 2;
const KS: [u32; 7] = [2, 3, 4, 5, 6, 7, 8];
/// The k that stands for all angles: its paths are at most 0.0006 % longer than the shortest on free ground.
const REFERENCE: u32 = 12;

pub(super) fn measure(surfaces: &[Kind]) -> Result<Vec<Row>, CompareError> {
    let mut rows = Vec::new();
    for surface in surfaces {
        let finest = surface.graph(SIDE, KS[KS.len() - 1])?;
        let mut surplus: Vec<Vec<f64>> = vec![Vec::new(); KS.len()];
        for source in sources(&finest) {
            let reference = reference(&finest, source)?;
            for (k, surplus) in KS.into_iter().zip(&mut surplus) {
                let field = field(&graph(finest.map(), k)?, source)?;
                let costs = field.iter().filter(|&(at, _)| at != source);
                surplus.extend(costs.map(|(at, _)| {
                    let [found, least] =
                        [field.cost(at), reference[index(at)]].map(Option::unwrap_or_default);
                    100.0 * (finest.to_f64(found) / finest.to_f64(least) - 1.0)
                }));
            }
        }
        for (k, mut surplus) in KS.into_iter().zip(surplus) {
            surplus.sort_by(f64::total_cmp);
            let row = Part::Worth.row(surface.name(), SIDE, k).with("pairs", surplus.len() as f64);
            let most = surplus.get(surplus.len() * 95 / 100).copied();
            let row = row.with("mean", mean(&surplus)).with("most", most);
            rows.push(row.with("worst", surplus.last().copied()));
        }
    }
    Ok(rows)
}

const fn index(at: Vertex) -> usize {
    at.y as usize * SIDE as usize + at.x as usize
}

/// Random vertices from which much can be reached.
fn sources(graph: &Arc<CostGraph>) -> Vec<Vertex> {
    let mut rng = Rng::new(SEED);
    let mut found = Vec::new();
    for _ in 0..1_000 {
        let at = Vertex::new(rng.below(SIDE) as i32, rng.below(SIDE) as i32);
        let reached = field(graph, at).map_or(0, |field| field.iter().count());
        if found.len() < SOURCES && reached as u32 > SIDE * SIDE / 4 {
            found.push(at);
        }
        if found.len() == SOURCES {
            break;
        }
    }
    found
}

fn field(graph: &Arc<CostGraph>, source: Vertex) -> Result<CostField, CompareError> {
    let field = CostField::new(Arc::clone(graph), CostFieldQuery::new(&[source]), &Interrupt::NEVER);
    field.map_err(CompareError::of_costs)
}

/// The least costs for k = 12: Dijkstra's algorithm on all moves. It begins with the costs for a lower k,
/// which paths over N(12) have as well; a move that cannot better a cost, even over the cheapest cells, is
/// left out.
fn reference(
    graph: &Arc<CostGraph>,
    source: Vertex,
) -> Result<Vec<Option<mediant_moves::Cost>>, CompareError> {
    let k = FiniteK::new(REFERENCE).map_err(CompareError::of_costs)?;
    let (least, _) = graph.map().bounds();
    let unit = graph.map().unit();
    let moves: Vec<(Vector, u64)> = Neighborhood::new(k)
        .map_err(CompareError::of_costs)?
        .iter()
        .map(|v| (v, (least * v.norm() / unit) as u64))
        .collect();
    let known = field(graph, source)?;
    let mut costs: Vec<_> =
        (0..SIDE * SIDE).map(|at| known.cost(Vertex::new((at % SIDE) as i32, (at / SIDE) as i32))).collect();
    let mut open: BinaryHeap<_> = costs
        .iter()
        .zip(0_u32..)
        .filter_map(|(cost, at)| Some(Reverse((cost.as_ref()?.to_bits(), at))))
        .collect();
    while let Some(Reverse((cost, at))) = open.pop() {
        if costs[at as usize].map(mediant_moves::Cost::to_bits) != Some(cost) {
            continue;
        }
        let from = Vertex::new((at % SIDE) as i32, (at / SIDE) as i32);
        for &(v, at_least) in &moves {
            let to = Vertex::new(from.x + v.x, from.y + v.y);
            let is_inside = (0..SIDE as i32).contains(&to.x) && (0..SIDE as i32).contains(&to.y);
            let Some(best) = is_inside.then(|| costs[index(to)]).flatten() else { continue };
            if cost + at_least >= best.to_bits() {
                continue;
            }
            let Some(of_move) = graph.line_cost(from, to) else { continue };
            let new = cost + of_move.to_bits();
            if new < best.to_bits() {
                costs[index(to)] = Some(mediant_moves::Cost::from_bits(new));
                open.push(Reverse((new, index(to) as u32)));
            }
        }
    }
    Ok(costs)
}
