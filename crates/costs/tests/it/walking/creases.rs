//! By how much times differ with the direction alone, where they should not: OSGeo/grass 4956.

use std::sync::Arc;

use mediant_costs::{CostFieldQuery, Heading, WalkingField, WalkingGraph};
use mediant_grid::{CornerRule, Interrupt, Rules, Vertex};
use mediant_moves::FiniteK;

use super::ground::{Ground, Way};

const SIDE: i32 = 61;
const RULES: Rules = Rules::Center(CornerRule::Always);

/// A slope of 10 % along x, with a friction of 1 everywhere, in cells of 10 m.
fn plane() -> Ground {
    let elevations: Vec<Vec<Option<f64>>> =
        (0..SIDE).map(|_| (0..SIDE).map(|x| Some(f64::from(x))).collect()).collect();
    let frictions = vec![vec![Some(1.0); SIDE as usize]; SIDE as usize];
    Ground::of_rows(&elevations, &frictions, (10.0, 10.0))
}

/// The least and the greatest of the times from the middle to 27 cells away, uphill in all directions, over
/// those along straight lines.
fn spread(times: &[f64]) -> (f64, f64) {
    let ratios = (-90..=90).map(|degrees| {
        let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
        let (x, y) = ((27.0 * cos).round(), (27.0 * sin).round());
        let at = (SIDE / 2 + y as i32) * SIDE + SIDE / 2 + x as i32;
        let length = 10.0 * x.hypot(y);
        times[at as usize] / (length * (0.72 + 1.0) + 6.0 * x)
    });
    ratios.fold((f64::INFINITY, 0.0), |(least, greatest), ratio| (ratio.min(least), ratio.max(greatest)))
}

#[test]
fn friction_along_the_move_makes_no_creases_beyond_those_of_the_neighborhood() {
    let ground = plane();
    let middle = Vertex::new(SIDE / 2, SIDE / 2);
    // Friction once a move: moves that are long are cheap, so that times fold along them.
    let once = ground.times(RULES, 4, middle, Heading::FromSources, Way::FrictionOnce);
    let (least, greatest) =
        spread(&once.into_iter().map(|time| time.unwrap_or(f64::NAN)).collect::<Vec<_>>());
    assert!(greatest / least > 1.13, "{least} to {greatest}");
    // Along the move: what is left is the polygon of N(k), less with each k.
    for (k, bound) in [(3, 1.073), (4, 1.026), (5, 1.0125), (6, 1.0073), (7, 1.0047)] {
        let map = ground.map("a plane");
        let graph = WalkingGraph::new(map, RULES, FiniteK::new(k).expect("a small k"));
        let query = [middle];
        let field = WalkingField::new(
            Arc::new(graph.expect("a small k")),
            Heading::FromSources,
            CostFieldQuery::new(&query),
            &Interrupt::NEVER,
        );
        let (least, greatest) = spread(&field.expect("the middle is free").into_rows());
        assert!(least > 1.0 - 1e-9 && greatest < bound, "k = {k}: {least} to {greatest}");
    }
}

/// A dike of 5 m, one cell wide, on a plain.
#[test]
fn no_move_passes_a_dike_as_if_it_were_not_there() {
    let elevations: Vec<Vec<Option<f64>>> =
        (0..SIDE).map(|_| (0..SIDE).map(|x| Some(if x == 35 { 5.0 } else { 0.0 })).collect()).collect();
    let frictions = vec![vec![Some(0.0); SIDE as usize]; SIDE as usize];
    let ground = Ground::of_rows(&elevations, &frictions, (10.0, 10.0));
    let middle = Vertex::new(30, 30);
    let behind = |times: Vec<Option<f64>>| times[(30 * SIDE + 40) as usize].unwrap_or(f64::NAN);
    let time = |k, way| behind(ground.times(RULES, k, middle, Heading::FromSources, way));
    // 100 m, and the dike: 5 m up, and down a slope of 50 %, which is steep.
    let straight = 72.0 + 30.0 + 9.999;
    assert!((time(3, Way::Cut) - straight).abs() < 1e-9);
    let whole = time(4, Way::EndToEnd);
    // Two knight's moves, over the dike and back to the row.
    assert!(whole < 0.72 * 105.0, "{whole}");
    for k in 4..=6 {
        let time = time(k, Way::Cut);
        assert!(time > straight - 15.0, "k = {k}: {time}");
    }
}
