//! The same integers on every platform.

use std::sync::Arc;

use mediant_costs::{CostFieldQuery, Heading, Langmuir, Pace, WalkingField, WalkingGraph, WalkingMap};
use mediant_grid::{CornerRule, Interrupt, Rules, Vertex};
use mediant_moves::{Cost, FiniteK};

#[test]
fn costs_are_these_integers() {
    let ground = |x: u32, y: u32| {
        let rough = f64::from((7 * x * x + 13 * x * y + 3 * y * y) % 41) / 3.0;
        let friction = f64::from((5 * x + 3 * y) % 7) / 9.0;
        ((x + 4 * y) % 17 != 5).then_some((rough + 0.1 * f64::from(x), friction))
    };
    let digest = |pace: &Pace, k: u32, heading: Heading| {
        let map = WalkingMap::with_friction((30, 20), (9.7, 11.3), pace, &Interrupt::NEVER, ground);
        let rules = Rules::Center(CornerRule::One);
        let graph =
            WalkingGraph::new(Arc::new(map.expect("a map")), rules, FiniteK::new(k).expect("a small k"));
        let graph = Arc::new(graph.expect("a small k"));
        let field =
            WalkingField::new(graph, heading, CostFieldQuery::new(&[Vertex::new(4, 3)]), &Interrupt::NEVER)
                .expect("the source is free");
        let places = (0..20).flat_map(|y| (0..30).map(move |x| Vertex::new(x, y)));
        let costs = places.map(|at| field.cost(at).map_or(0, Cost::to_bits));
        costs.fold(0_u64, |digest, cost| digest.wrapping_mul(0x9E37_79B9_7F4A_7C15).rotate_left(17) ^ cost)
    };
    let (tobler, langmuir) = (Pace::Tobler, Pace::Langmuir(Langmuir::default()));
    let found = [
        digest(&tobler, 3, Heading::FromSources),
        digest(&tobler, 7, Heading::ToSources),
        digest(&langmuir, 5, Heading::FromSources),
        digest(&langmuir, 8, Heading::ToSources),
    ];
    let expected =
        [0x4dea_7814_529d_28db, 0x5a07_5585_5bd6_9559, 0xf946_3ea9_376b_8a3d, 0x3417_15a5_e86c_9b75];
    assert_eq!(found, expected, "{found:#x?}");
}
