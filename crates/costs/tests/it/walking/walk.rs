//! Times of `r.walk`.

use std::sync::Arc;

use mediant_costs::{CostFieldQuery, Heading, Langmuir, Pace, WalkingField, WalkingGraph, WalkingMap};
use mediant_grid::{CornerRule, Interrupt, Rules, Vertex};
use mediant_moves::FiniteK;

/// Rows of numbers, `None` for `*`.
type Rows = Vec<Vec<Option<f64>>>;

#[test]
fn straight_and_diagonal_moves_cost_what_they_cost_in_r_walk() {
    let number = |word: &str| word.parse().ok();
    let of_line = |line: &str| line.split_whitespace().map(number).collect();
    let blocks: Vec<Rows> = include_str!("r.walk.txt")
        .split("\n\n")
        .skip(1)
        .map(|block| block.trim().lines().map(of_line).collect())
        .collect();
    let mut greatest = 0.0_f64;
    let mut compared = 0;
    for map in blocks.chunks_exact(5) {
        let [head, elevations, frictions, without, with] = map else { continue };
        let head: Vec<f64> = head[0].iter().copied().flatten().collect();
        let source = [Vertex::new(head[2] as i32, head[3] as i32)];
        let size = (elevations[0].len() as u32, elevations.len() as u32);
        for (lambda, expected) in [(0.0, without), (1.0, with)] {
            let of = |rows: &Rows, x: u32, y: u32| rows[y as usize][x as usize];
            let ground = |x, y| Some((of(elevations, x, y)?, of(frictions, x, y)? * lambda));
            let pace = Pace::Langmuir(Langmuir::default());
            let map = WalkingMap::with_friction(size, (head[0], head[1]), &pace, &Interrupt::NEVER, ground);
            let map = Arc::new(map.expect("a map"));
            let graph = WalkingGraph::new(map, Rules::Center(CornerRule::Always), FiniteK::N8);
            let graph = Arc::new(graph.expect("k = 3"));
            let query = CostFieldQuery::new(&source);
            let field = WalkingField::new(graph, Heading::FromSources, query, &Interrupt::NEVER);
            let found = field.expect("the start is free").into_rows();
            for (found, expected) in found.into_iter().zip(expected.iter().flatten()) {
                assert_eq!(found.is_finite(), expected.is_some(), "lambda {lambda}: {found}, {expected:?}");
                let Some(expected) = *expected else { continue };
                greatest = greatest.max((found - expected).abs());
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 2 * (36 + 25 + 55));
    // `r.out.ascii` prints six digits behind the point, unless told otherwise.
    assert!(greatest < 5e-9, "differs by {greatest}");
}
