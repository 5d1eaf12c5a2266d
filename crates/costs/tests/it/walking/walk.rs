//! Times of `r.walk`.

use std::sync::Arc;

use mediant_costs::{CostFieldQuery, Heading, Langmuir, Pace, WalkingField, WalkingGraph, WalkingMap};
use mediant_grid::{CornerRule, Interrupt, Rules, Vertex};
use mediant_moves::FiniteK;

use super::ground::{Ground, Way};

/// Rows of numbers, `None` for `*`.
type Rows = Vec<Vec<Option<f64>>>;

/// A map of `r.walk`, with its frictions times lambda.
struct Map {
    cell_size: (f64, f64),
    start: Vertex,
    elevations: Rows,
    frictions: Rows,
    /// The times with 8 neighbors, and with flag -k.
    times: [Rows; 2],
}

fn maps() -> Vec<Map> {
    let number = |word: &str| word.parse().ok();
    let of_line = |line: &str| line.split_whitespace().map(number).collect();
    let blocks: Vec<Rows> = include_str!("r.walk.txt")
        .split("\n\n")
        .skip(1)
        .map(|block| block.trim().lines().map(of_line).collect())
        .collect();
    let mut maps = Vec::new();
    for block in blocks.chunks_exact(7) {
        let [head, elevations, frictions, times @ ..] = block else { continue };
        let head: Vec<f64> = head[0].iter().copied().flatten().collect();
        for lambda in [0, 1] {
            let times_lambda = |friction: f64| friction * lambda as f64;
            maps.push(Map {
                cell_size: (head[0], head[1]),
                start: Vertex::new(head[2] as i32, head[3] as i32),
                elevations: elevations.clone(),
                frictions: frictions
                    .iter()
                    .map(|row| row.iter().map(|of| of.map(times_lambda)).collect())
                    .collect(),
                times: [times[lambda].clone(), times[2 + lambda].clone()],
            });
        }
    }
    assert_eq!(maps.len(), 6);
    maps
}

impl Map {
    fn field(&self, k: FiniteK) -> Vec<f64> {
        let of = |rows: &Rows, x: u32, y: u32| rows[y as usize][x as usize];
        let ground = |x, y| Some((of(&self.elevations, x, y)?, of(&self.frictions, x, y)?));
        let size = (self.elevations[0].len() as u32, self.elevations.len() as u32);
        let pace = Pace::Langmuir(Langmuir::default());
        let map = WalkingMap::with_friction(size, self.cell_size, &pace, &Interrupt::NEVER, ground);
        let graph = WalkingGraph::new(Arc::new(map.expect("a map")), Rules::Center(CornerRule::Always), k);
        let (graph, sources) = (Arc::new(graph.expect("a small k")), [self.start]);
        let field =
            WalkingField::new(graph, Heading::FromSources, CostFieldQuery::new(&sources), &Interrupt::NEVER);
        field.expect("the start is free").into_rows()
    }
}

#[test]
fn straight_and_diagonal_moves_cost_what_they_cost_in_r_walk() {
    let mut compared = 0;
    for map in maps() {
        for (found, expected) in map.field(FiniteK::N8).into_iter().zip(map.times[0].iter().flatten()) {
            assert_eq!(found.is_finite(), expected.is_some(), "{found}, {expected:?}");
            let Some(expected) = *expected else { continue };
            // `r.out.ascii` prints six digits behind the point, unless told otherwise.
            assert!((found - expected).abs() < 5e-9, "{found}, {expected}");
            compared += 1;
        }
    }
    assert_eq!(compared, 2 * (36 + 25 + 55));
}

#[test]
fn knights_moves_of_r_walk_differ_by_their_slope_alone() {
    let mut lower = 0;
    for map in maps() {
        let ground = Ground::of_rows(&map.elevations, &map.frictions, map.cell_size);
        let rules = Rules::Center(CornerRule::Always);
        let [cut, whole] =
            [Way::Cut, Way::EndToEnd].map(|way| ground.times(rules, 4, map.start, Heading::FromSources, way));
        let ours = map.field(FiniteK::N16);
        for (at, expected) in map.times[1].iter().flatten().enumerate() {
            let Some(expected) = *expected else { continue };
            let [cut, whole] = [cut[at], whole[at]].map(|time| time.unwrap_or(f64::NAN));
            assert!((whole - expected).abs() < 1e-9, "{whole}, {expected}");
            assert!((ours[at] - cut).abs() < 5e-9, "{}, {cut}", ours[at]);
            // On the rough ground of these maps it is cheaper to know the ends of a move alone.
            lower += usize::from(expected < ours[at] - 1.0);
        }
    }
    assert!(lower > 100, "only {lower}");
}
