//! Surfaces after edits.

use std::sync::Arc;

use mediant_costs::{CostAStar, CostField, CostFieldQuery, CostSurface};
use mediant_grid::{CornerRule, Interrupt, Rules, Vertex};
use mediant_oracle::{Rng, random_weighted, seeds};
use mediant_search::{Ends, Planner};

use crate::common::{graph, surface};

#[test]
fn an_edited_surface_is_the_one_made_anew() {
    for seed in seeds(60) {
        let (map, about) = random_weighted(seed);
        let mut current = surface(&map, &about);
        let mut rng = Rng::new(seed);
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
                    assert_eq!(next.cost(x, y), expected, "seed {seed}, edit {edit}: {cells:?}: {about}");
                }
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
fn a_planner_follows_and_a_field_is_made_anew() {
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
