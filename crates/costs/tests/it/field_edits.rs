//! Fields that follow edits, against those of the edited surfaces made anew.

use std::sync::{Arc, atomic::AtomicBool};

use mediant_costs::{CostField, CostFieldError, CostFieldQuery, CostGraph, CostSurface};
use mediant_grid::{CornerRule, DiagonalGap, Interrupt, Rules, Vertex};
use mediant_oracle::{Rng, random_free_vertex};

use crate::common::{for_random_maps, graph, vertices};

type Edit = Vec<(u32, u32, Option<f64>)>;

/// A gap in the middle of a map, between the cells of one diagonal or the other.
fn gap(map: &CostSurface, is_turned: bool) -> Edit {
    let (x, y) = (map.width() / 2, map.height() / 2);
    let [free, blocked] = [Some(map.bounds().0), None];
    let [one, other] = if is_turned { [free, blocked] } else { [blocked, free] };
    let (left, above) = (x.saturating_sub(1), y.saturating_sub(1));
    vec![(left, above, one), (x, above, other), (left, y, other), (x, y, one)]
}

/// Costs that rise and fall, walls and cells that are freed, edits of nothing, and seldom one beyond the
/// bounds.
fn random_edit(map: &CostSurface, rng: &mut Rng) -> Edit {
    if rng.chance(25) {
        return gap(map, rng.chance(50));
    }
    let (least, greatest) = map.bounds();
    let most = [1, 1, 3, 9][rng.below(4) as usize];
    (0..1 + rng.below(most))
        .map(|_| {
            let (x, y) = (rng.below(map.width()), rng.below(map.height()));
            let between =
                (least + f64::from(rng.below(1 + (greatest - least).min(1e6) as u32))).min(greatest);
            let known = map.cost(x, y);
            let costs = [None, None, Some(least), Some(greatest), Some(between), Some(between), known];
            let beyond = rng.chance(1).then_some(greatest * 2.0);
            (x, y, beyond.or(costs[rng.below(7) as usize]))
        })
        .collect()
}

/// Panics unless two fields answer alike: costs, directions, allocation, paths and rows.
fn assert_same(repaired: &CostField, anew: &CostField, about: &str) {
    assert_eq!((repaired.query(), repaired.identity()), (anew.query(), anew.identity()), "{about}");
    for at in vertices(anew.graph()) {
        assert_eq!(repaired.cost(at), anew.cost(at), "{at}: {about}");
        assert_eq!(repaired.direction(at), anew.direction(at), "{at}: {about}");
        assert_eq!(repaired.allocation(at), anew.allocation(at), "{at}: {about}");
        assert_eq!(repaired.path_from(at), anew.path_from(at), "{at}: {about}");
    }
    assert_eq!(repaired.clone().into_rows(), anew.clone().into_rows(), "{about}");
}

/// The queries of a chain of edits: one source or several, with and without allocation and limit.
fn random_query<'q>(graph: &Arc<CostGraph>, sources: &'q [Vertex], rng: &mut Rng) -> CostFieldQuery<'q> {
    let query = CostFieldQuery::new(sources);
    let query = if rng.chance(50) { query.with_allocation() } else { query };
    let whole = CostField::new(Arc::clone(graph), query, &Interrupt::NEVER).expect("the sources are free");
    let greatest = whole.iter().map(|(_, cost)| cost).fold(0.0, f64::max);
    if rng.chance(30) { query.within(greatest * f64::from(rng.below(100)) / 100.0) } else { query }
}

#[test]
fn a_repaired_field_is_the_one_made_anew() {
    let (mut repairs, mut anews, mut blocked) = (0, 0, 0);
    for_random_maps(40, |map, surface, rules, k, about| {
        let mut rng = Rng::new(u64::from(k) + u64::from(map.grid().width()) * 99);
        let before = graph(surface, rules, k);
        let middle = Vertex::new((surface.width() / 2) as i32, (surface.height() / 2) as i32);
        let sources: Vec<Vertex> = (0..1 + rng.below(4))
            .filter_map(|_| random_free_vertex(&mut rng, map.grid(), rules.placement()))
            .chain(Some(middle).filter(|&at| before.is_free(at)))
            .collect();
        let query = random_query(&before, &sources, &mut rng);
        let new = |graph: &Arc<CostGraph>| CostField::new(Arc::clone(graph), query, &Interrupt::NEVER);
        let mut field = new(&before).expect("the sources are free");
        for number in 0..8 {
            let edit = random_edit(field.graph().map(), &mut rng);
            let about = format!("{query:?}, edit {number}: {edit:?}, {about}");
            let cells: Vec<(u32, u32)> =
                edit.iter().map(|&(x, y, _)| (x, y)).chain([(0, 0), (999, 3)]).collect();
            // Costs too far apart.
            let Ok(map) = field.graph().map().edit(edit) else { continue };
            let after = field.graph().after(Arc::new(map), &cells).expect("the same k");
            let after = Arc::new(after);
            let found = field.repaired(&after, &cells, &Interrupt::NEVER);
            let anew = new(&after);
            field = match (found, anew) {
                (Ok(Some(repaired)), Ok(anew)) => {
                    assert_same(&repaired, &anew, &about);
                    repairs += 1;
                    repaired
                }
                (Ok(None), Ok(anew)) => {
                    anews += 1;
                    anew
                }
                (found, anew) => {
                    let [found, anew] = [found.map(|_| ()), anew.map(|_| ())];
                    assert_eq!(found, anew, "{about}");
                    blocked += 1;
                    continue;
                }
            };
        }
    });
    assert!(repairs > 6 * anews && anews > 20 && blocked > 50, "{repairs}, {anews}, {blocked}");
}

/// Land of cost 1 to 9.
fn land(side: u32) -> Arc<CostSurface> {
    let mut rng = Rng::new(3);
    let cells: Vec<u32> = (0..side * side).map(|_| 1 + rng.below(9)).collect();
    let cost = |x: u32, y: u32| Some(f64::from(cells[(y * side + x) as usize]));
    Arc::new(CostSurface::from_fn(side, side, cost).expect("a surface"))
}

#[test]
fn small_changes_of_large_maps_are_repaired_and_great_ones_are_not() {
    let rules = Rules::Center(CornerRule::One);
    let before = graph(&land(200), rules, 4);
    let sources = [Vertex::new(100, 100), Vertex::new(3, 190)];
    let query = CostFieldQuery::new(&sources).with_allocation();
    let mut field = CostField::new(Arc::clone(&before), query, &Interrupt::NEVER).expect("free");
    let mut rng = Rng::new(8);
    let edit = |field: &CostField, edit: Edit| {
        let cells: Vec<(u32, u32)> = edit.iter().map(|&(x, y, _)| (x, y)).collect();
        let map = field.graph().map().edit(edit).expect("within the bounds");
        let after = Arc::new(field.graph().after(Arc::new(map), &cells).expect("the same k"));
        field.repaired(&after, &cells, &Interrupt::NEVER)
    };
    for step in 0..40 {
        let cost = [Some(1.0), Some(9.0), None][rng.below(3) as usize];
        let cells = (0..1 + step % 3).map(|_| (rng.below(90), rng.below(200), cost)).collect();
        field = edit(&field, cells).expect("the sources are free").expect("a small change");
    }
    let anew = CostField::new(Arc::clone(field.graph()), query, &Interrupt::NEVER).expect("free");
    assert_same(&field, &anew, "after 40 edits");
    // All cells; and all around a source.
    let all = (0..200).flat_map(|y| (0..200).map(move |x| (x, y, Some(9.0)))).collect();
    assert!(edit(&field, all).expect("the sources are free").is_none());
    let ring = (90..111).flat_map(|n| [(n, 90), (n, 110), (90, n), (110, n)]);
    let ring = edit(&field, ring.map(|(x, y)| (x, y, None)).collect());
    assert!(ring.expect("the sources are free").is_none());
    // The memory of a repair that was given up is none of the field's.
    assert_same(&field, &anew, "after great changes");
    let wall = edit(&field, vec![(3, 190, None)]);
    assert!(matches!(wall, Err(CostFieldError::Query(_))), "{wall:?}");
}

#[test]
fn other_changes_than_these_are_refused() {
    let rules = Rules::Center(CornerRule::Never);
    let map = land(40);
    let before = graph(&map, rules, 3);
    let sources = [Vertex::new(1, 1)];
    let field = CostField::new(Arc::clone(&before), CostFieldQuery::new(&sources), &Interrupt::NEVER);
    let field = field.expect("it is free");
    let after = map.edit([(3, 4, Some(2.0)), (20, 20, None)]).expect("within the bounds");
    let after = graph(&Arc::new(after), rules, 3);
    let repaired = |after: &Arc<CostGraph>, cells: &[(u32, u32)]| {
        field.repaired(after, cells, &Interrupt::NEVER).map(|field| field.is_some())
    };
    assert_eq!(repaired(&after, &[(3, 4), (20, 20), (0, 0), (3, 4), (99, 99)]), Ok(true));
    let refused = |found| matches!(found, Err(CostFieldError::Mismatch(_)));
    assert!(refused(repaired(&after, &[(3, 4)])));
    assert!(refused(repaired(&graph(&map, rules, 4), &[])));
    assert!(refused(repaired(&graph(&map, Rules::Center(CornerRule::One), 3), &[])));
    // Other units, and another size.
    let tenths = Arc::new(map.edit([(5, 5, Some(0.5))]).expect("a surface anew"));
    assert_eq!(repaired(&graph(&tenths, rules, 3), &[(5, 5)]), Ok(false));
    assert_eq!(repaired(&graph(&land(41), rules, 3), &[]), Ok(false));
    let stopped = Interrupt::new().cancel(Arc::new(AtomicBool::new(true)));
    let stopped = field.repaired(&after, &[(3, 4), (20, 20)], &stopped);
    assert!(matches!(stopped, Err(CostFieldError::Interrupted(_))));
}

/// A list of cells changes, first one of them, then two, and so on: all are blocked, or cost the least or
/// the most. Counts the changes that the field follows. After all others it is made anew, and is equal: only
/// these counts show when a repair is given up.
#[test]
fn the_number_of_repairs_is_pinned() {
    let map = land(90);
    let mut rng = Rng::new(5);
    let cells: Vec<(u32, u32)> = (0..40).map(|_| (rng.below(90), rng.below(90))).collect();
    let repaired = |rules: Rules, k: u32, cost: Option<f64>, limit: f64| {
        let before = graph(&map, rules, k);
        let sources = [Vertex::new(50, 50), Vertex::new(3, 80)];
        let query = CostFieldQuery::new(&sources).within(limit);
        let field = CostField::new(Arc::clone(&before), query, &Interrupt::NEVER).expect("free");
        let is_repaired = |&count: &usize| {
            let cells = &cells[..count];
            let map = map.edit(cells.iter().map(|&(x, y)| (x, y, cost))).expect("within the bounds");
            let after = Arc::new(before.after(Arc::new(map), cells).expect("the same k"));
            field.repaired(&after, cells, &Interrupt::NEVER).expect("the sources are free").is_some()
        };
        (1..=cells.len()).filter(is_repaired).count()
    };
    let rules = [Rules::Center(CornerRule::One), Rules::Corner(DiagonalGap::Open)];
    let found = rules.map(|rules| {
        [2, 4].map(|k| {
            [None, Some(1.0), Some(9.0)]
                .map(|cost| [f64::INFINITY, 60.0].map(|limit| repaired(rules, k, cost, limit)))
        })
    });
    let at_centers = [[[8, 40], [18, 40], [8, 40]], [[10, 40], [18, 29], [10, 40]]];
    let at_corners = [[[18, 40], [18, 35], [20, 40]], [[8, 39], [18, 20], [8, 40]]];
    assert_eq!(found, [at_centers, at_corners]);
}
