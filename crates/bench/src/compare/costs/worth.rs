//! The worth of k: the costs for k = 2 to 8 over those for k = 12.

use std::{cmp::Reverse, collections::BinaryHeap};

use mediant::{Costs, Field, FiniteK, Path, Space, Vertex, moves::Neighborhood};
use mediant_oracle::Rng;
use mediant_report::{Row, stats::mean};

use super::{
    Part, SEED,
    surfaces::{Kind, space},
};
use crate::compare::CompareError;

/// Small, since every vertex has 4,096 moves.
const SIDE: u32 = 160;
/// The sources, a field each.
const SOURCES: usize = 2;
const KS: [u32; 7] = [2, 3, 4, 5, 6, 7, 8];
/// The k that stands for all angles.
const REFERENCE: u32 = 12;

pub(super) fn measure(surfaces: &[Kind]) -> Result<Vec<Row>, CompareError> {
    let mut rows = Vec::new();
    for surface in surfaces {
        let costs = surface.surface(SIDE)?;
        let finest = space(&costs, KS[KS.len() - 1])?;
        let mut surplus: Vec<Vec<f64>> = vec![Vec::new(); KS.len()];
        for source in sources(&finest)? {
            let reference = reference(&costs, &finest, source)?;
            for (k, surplus) in KS.into_iter().zip(&mut surplus) {
                let field = space(&costs, k)?.field([source])?;
                let others = field.iter().filter(|&(at, _)| at != source);
                surplus.extend(others.map(|(at, cost)| 100.0 * (cost / reference[index(at)] - 1.0)));
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

const fn vertex(index: usize) -> Vertex {
    Vertex::new((index % SIDE as usize) as i32, (index / SIDE as usize) as i32)
}

/// Random vertices from which a quarter of the cells and more can be reached.
fn sources(space: &Space) -> Result<Vec<Vertex>, CompareError> {
    let mut rng = Rng::new(SEED);
    let mut found = Vec::new();
    for _ in 0..1_000 {
        let at = vertex(rng.below(SIDE * SIDE) as usize);
        if found.len() < SOURCES && space.is_free(at) {
            let reached = space.field([at])?.iter().count();
            found.extend((4 * reached > (SIDE * SIDE) as usize).then_some(at));
        }
    }
    Ok(found)
}

/// The least costs for k = 12, infinite where there is no path: Dijkstra's algorithm on all moves. It begins
/// with the costs for a lower k, which paths over N(12) have as well; a move that cannot better a cost, even
/// over the cheapest cells, is left out.
fn reference(costs: &Costs, space: &Space, source: Vertex) -> Result<Vec<f64>, CompareError> {
    let k = FiniteK::new(REFERENCE).map_err(mediant::Error::from)?;
    let ((cheapest, _), unit) = (costs.bounds(), costs.unit());
    let moves = Neighborhood::new(k).map_err(mediant::Error::from)?;
    let moves: Vec<_> = moves.iter().map(|v| (v, cheapest * v.norm())).collect();
    let known: Field = space.field([source])?;
    let mut best = known.lengths();
    // Costs are multiples of the unit, a power of two: exact integers.
    let integer = |cost: f64| (cost / unit) as u64;
    let reached = best.iter().zip(0..).filter(|(cost, _)| cost.is_finite());
    let mut open: BinaryHeap<_> = reached.map(|(&cost, at)| Reverse((integer(cost), at))).collect();
    while let Some(Reverse((cost, at))) = open.pop() {
        if integer(best[at]) != cost {
            continue;
        }
        let (from, cost) = (vertex(at), best[at]);
        for &(v, least) in &moves {
            let to = Vertex::new(from.x + v.x, from.y + v.y);
            let is_inside = (0..SIDE as i32).contains(&to.x) && (0..SIDE as i32).contains(&to.y);
            if !is_inside || best[index(to)].is_infinite() || cost + least >= best[index(to)] {
                continue;
            }
            let Some(of_move) = space.cost(&Path::new(vec![from, to])) else { continue };
            if cost + of_move < best[index(to)] {
                best[index(to)] = cost + of_move;
                open.push(Reverse((integer(cost + of_move), index(to))));
            }
        }
    }
    Ok(best)
}
