//! Surfaces after edits.

use std::sync::Arc;

use mediant_costs::{CostAStar, CostField, CostFieldQuery, CostGraph, CostSurface};
use mediant_grid::{CornerRule, DiagonalGap, Interrupt, PlacementKind, Rules, Vertex};
use mediant_moves::FiniteK;
use mediant_oracle::{Rng, random_free_vertex, random_weighted, seeds};
use mediant_search::{Ends, Planner};

use crate::common::{graph, surface};

#[test]
fn an_edited_surface_is_the_one_made_anew() {
    for seed in seeds(60) {
        let (map, about) = random_weighted(seed);
        let mut current = surface(&map, &about);
        let mut rng = Rng::new(seed);
        let rules = Rules::Corner(DiagonalGap::Closed);
        let k = FiniteK::new(2 + rng.below(7)).expect("a k");
        let mut followed = CostGraph::new(Arc::clone(&current), rules, k).expect("a small k");
        for edit in 0..8 {
            let cells: Vec<(u32, u32, Option<f64>)> = (0..1 + rng.below(5))
                .map(|_| {
                    let (least, greatest) = current.bounds();
                    let cost =
                        [None, Some(least), Some(greatest), Some(greatest * 2.0)][rng.below(4) as usize];
                    (rng.below(current.width()), rng.below(current.height()), cost)
                })
                .collect();
            let next = match current.edit(cells.iter().copied()) {
                Ok(next) => Arc::new(next),
                Err(error) => {
                    assert!(matches!(error, mediant_costs::CostsError::Range { .. }), "{error}");
                    continue;
                }
            };
            for y in 0..current.height() {
                for x in 0..current.width() {
                    let edited = cells.iter().rev().find(|&&(column, row, _)| (column, row) == (x, y));
                    let expected = edited.map_or_else(|| current.cost(x, y), |&(_, _, cost)| cost);
                    // Beyond 32 bits costs are rounded.
                    let most = (next.bounds().1 / 2.0_f64.powi(32)).floor();
                    let differs =
                        next.cost(x, y).zip(expected).map(|(cost, expected)| (cost - expected).abs());
                    let is_right = differs.is_none_or(|differs| differs <= most)
                        && next.cost(x, y).is_some() == expected.is_some();
                    assert!(is_right, "seed {seed}, edit {edit}, ({x}, {y}): {cells:?}: {about}");
                }
            }
            // Closed gaps follow the cells.
            let places: Vec<_> = cells.iter().map(|&(x, y, _)| (x, y)).collect();
            followed = followed.after(Arc::clone(&next), &places).expect("the same k");
            let anew = CostGraph::new(Arc::clone(&next), rules, k).expect("a small k");
            if let Some(source) = random_free_vertex(&mut rng, map.grid(), PlacementKind::Corner) {
                let rows = |graph: &CostGraph| {
                    let query = CostFieldQuery::new(std::slice::from_ref(&source));
                    let field = CostField::new(Arc::new(graph.clone()), query, &Interrupt::NEVER);
                    field.map(CostField::into_rows).map_err(|error| error.to_string())
                };
                assert_eq!(
                    rows(&followed),
                    rows(&anew),
                    "seed {seed}, edit {edit}, k = {k}: {cells:?}: {about}"
                );
            }
            // Undone, it is the same surface again.
            if next.unit() == current.unit() && next.bounds() == current.bounds() {
                let back = cells.iter().map(|&(x, y, _)| (x, y, current.cost(x, y)));
                let back = next.edit(back).expect("these costs were there");
                assert_eq!((back.id(), &back), (current.id(), &*current), "seed {seed}: {about}");
                let differs = (0..current.height())
                    .any(|y| (0..current.width()).any(|x| next.cost(x, y) != current.cost(x, y)));
                assert_eq!(next.id() != current.id(), differs, "seed {seed}: {about}");
            }
            current = next;
        }
    }
}

#[test]
fn a_planner_follows_an_edit() {
    let rules = Rules::Center(CornerRule::Never);
    let open = Arc::new(
        CostSurface::from_fn(30, 20, |x, _| Some(if x == 15 { 9.0 } else { 1.0 })).expect("a surface"),
    );
    let mut planner = CostAStar::new(graph(&open, rules, 4));
    let ends = Ends::new((0, 10), (29, 10));
    let cost = |planner: &mut CostAStar| {
        let answer = planner.solve(ends).expect("both are free");
        planner
            .graph()
            .clone()
            .path_cost(answer.path().expect("there is a way"))
            .map(|cost| planner.graph().to_f64(cost))
    };
    assert_eq!(cost(&mut planner), Some(29.0 + 8.0));
    let road = Arc::new(open.edit((0..20).map(|y| (15, y, Some(1.0)))).expect("within the bounds"));
    planner.follow(graph(&road, rules, 4));
    assert_eq!(cost(&mut planner), Some(29.0));
    let field =
        CostField::new(graph(&road, rules, 4), CostFieldQuery::new(&[Vertex::new(0, 10)]), &Interrupt::NEVER);
    assert_eq!(field.expect("it is free").get(Vertex::new(29, 10)), Some(29.0));
}
