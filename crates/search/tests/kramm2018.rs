//! Kramm, Rivera, Hernández & Baier 2018, 'A Suboptimality Bound for 2^k Grid Path Planning', Theorem 3: vertices at centers,
//! against any-angle paths that may bend at cell corners.
//!
//! The reference is a grid with each cell divided into four: the centers of the old cells are corner vertices of the new ones,
//! as are the old corners.

mod common;

use std::sync::Arc;

use common::with_engines;
use mediant_grid::{AsciiMap, CornerRule, DiagonalGap, Grid, Rules, Vertex};
use mediant_moves::{K, bound_at_centers};
use mediant_oracle::{Explicit, Rng, describe, noise};
use mediant_search::Query;

const SLACK: f64 = 1e-9;

/// The gap rule of corners that says of diagonal gaps what the rule of centers says.
fn gap(corners: CornerRule) -> DiagonalGap {
    if corners == CornerRule::Always { DiagonalGap::Open } else { DiagonalGap::Closed }
}

/// The any-angle reference of a grid.
struct Reference(Explicit);

impl Reference {
    fn new(grid: &Grid, corners: CornerRule) -> Self {
        let halves = Grid::from_fn(2 * grid.width(), 2 * grid.height(), |x, y| {
            grid.is_blocked(x as i32 / 2, y as i32 / 2)
        });
        Self(Explicit::new(&halves.expect("a valid size"), Rules::Corner(gap(corners)), None))
    }

    /// The any-angle optima from one center to others.
    fn costs(&self, start: Vertex, goals: &[Vertex]) -> Vec<Option<f64>> {
        let center = |cell: Vertex| Vertex::new(2 * cell.x + 1, 2 * cell.y + 1);
        let costs = self.0.costs_from(center(start));
        goals.iter().map(|&goal| costs.to(center(goal)).map(|cost| cost / 2.0)).collect()
    }
}

/// The largest ratio of the cost over N(k) to the any-angle optimum between any two free cells, and where.
fn worst(grid: &Arc<Grid>, corners: CornerRule, k: u32) -> (f64, Vertex, Vertex) {
    let rules = Rules::Center(corners);
    let free: Vec<Vertex> = (0..grid.height() as i32)
        .flat_map(|y| (0..grid.width() as i32).map(move |x| Vertex::new(x, y)))
        .collect();
    let free: Vec<Vertex> = free.into_iter().filter(|cell| grid.is_free(cell.x, cell.y)).collect();
    let reference = Reference::new(grid, corners);
    let mut worst = (0.0, Vertex::default(), Vertex::default());
    with_engines(grid, rules, k, |mut engines| {
        for &start in &free {
            for (&goal, best) in free.iter().zip(reference.costs(start, &free)) {
                let (outcome, _) = engines[0].solve(Query::new(start, goal)).expect("both ends are free");
                let cost = outcome.path().map(|path| path.cost());
                let Some(best) = best else {
                    assert_eq!(cost, None, "{}", describe(grid, rules, start, goal, 0));
                    continue;
                };
                let cost = cost.unwrap_or(f64::INFINITY);
                assert!(cost >= best * (1.0 - SLACK), "k = {k}: {}", describe(grid, rules, start, goal, 0));
                if cost > worst.0 * best {
                    worst = (cost / best, start, goal);
                }
            }
        }
    });
    worst
}

fn grid(drawing: &str) -> Arc<Grid> {
    Arc::new(AsciiMap::parse(drawing).expect("the drawing is a map").grid)
}

#[test]
fn explore() {
    for k in 2..=5 {
        let mut best = 0.0;
        for cells in 0..1_u32 << 12 {
            let g = Arc::new(Grid::from_fn(4, 3, |x, y| cells >> (4 * y + x) & 1 == 1).expect("ok"));
            let w = worst(&g, CornerRule::One, k);
            if w.0 > best + 1e-12 {
                best = w.0;
                println!(
                    "{k} {w:?} {} {}",
                    bound_at_centers(K::new(k).expect("k")),
                    describe(&g, Rules::Center(CornerRule::One), w.1, w.2, 0)
                );
            }
        }
    }
    let _ = (Rng::new(0), noise(&mut Rng::new(0), 1, 1, 1), grid("."));
}
