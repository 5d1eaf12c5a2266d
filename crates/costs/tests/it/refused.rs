//! Bad input: errors that say which and why, before memory is asked for.

use std::sync::{Arc, atomic::AtomicBool};

use mediant_costs::{CostField, CostFieldError, CostFieldQuery, CostGraph, CostSurface, CostsError};
use mediant_grid::{CornerRule, Interrupt, Rules, Vertex};
use mediant_moves::FiniteK;
use mediant_search::{End, QueryError};

#[test]
fn bad_costs_are_named_with_their_cell() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e-121, 1e121] {
        let map = CostSurface::from_fn(4, 3, |x, y| Some(if (x, y) == (2, 1) { bad } else { 1.0 }));
        let error = map.expect_err("no cost");
        assert!(matches!(error, CostsError::Cost { x: 2, y: 1, .. }), "{error}");
        assert!(error.to_string().contains("blocked"), "{error}");
        let fine = CostSurface::from_fn(4, 3, |_, _| Some(1.0)).expect("costs of 1");
        assert!(matches!(fine.edit([(2, 1, Some(bad))]), Err(CostsError::Cost { x: 2, y: 1, .. })));
    }
}

/// Units are neither 0 nor infinite, however small or large all costs are.
#[test]
fn the_least_and_the_greatest_costs_and_sides_are_exact() {
    for (cost, side) in [(1e-120, 1e-120), (1e120, 1e120), (1e-120, 1e120), (1e120, 1e-120)] {
        let map = CostSurface::with_cells((40, 1), (side, side), &Interrupt::NEVER, |_, _| Some(cost))
            .expect("a map");
        let rules = Rules::Center(CornerRule::Never);
        let graph = CostGraph::new(Arc::new(map), rules, FiniteK::N8).expect("k = 3");
        let query = [Vertex::new(0, 0)];
        let field = CostField::new(Arc::new(graph), CostFieldQuery::new(&query), &Interrupt::NEVER);
        let found = field.expect("a field").get(Vertex::new(39, 0)).expect("open ground");
        let expected = 39.0 * cost * side;
        assert!((found / expected - 1.0).abs() < 1e-9, "{cost} {side}: {found}, not {expected}");
    }
}

#[test]
fn sizes_are_refused_before_a_cell_is_asked_for() {
    for (width, height) in [(0, 5), (5, 0), ((1 << 20) + 1, 1), (1 << 20, 1 << 20)] {
        let map = CostSurface::from_fn(width, height, |_, _| panic!("asked"));
        assert!(matches!(map, Err(CostsError::Size { .. })));
    }
}

#[test]
fn ranges_k_cells_and_sources_are_checked() {
    let wide = CostSurface::from_fn(2, 1, |x, _| Some(if x == 0 { 1e-6 } else { 1.5 }));
    assert!(matches!(wide, Err(CostsError::Range { .. })));
    for cell_size in [(0.0, 1.0), (1.0, -2.0), (f64::NAN, 1.0), (1.0, 1e9), (1e-121, 1e-121), (1e121, 1e121)]
    {
        let map = CostSurface::with_cells((2, 2), cell_size, &Interrupt::NEVER, |_, _| Some(1.0));
        assert!(matches!(map, Err(CostsError::CellSize { .. })));
    }
    let map = Arc::new(CostSurface::from_fn(3, 2, |x, _| (x > 0).then_some(1.0)).expect("costs of 1"));
    assert!(matches!(map.edit([(3, 0, None)]), Err(CostsError::Outside { x: 3, y: 0 })));
    let rules = Rules::Center(CornerRule::Never);
    let nine = FiniteK::new(9).expect("a k");
    assert!(matches!(CostGraph::new(Arc::clone(&map), rules, nine), Err(CostsError::K { max: 8, .. })));
    let graph = Arc::new(CostGraph::new(map, rules, FiniteK::N8).expect("k = 3"));
    let field = |at: Vertex, limit| {
        CostField::new(Arc::clone(&graph), CostFieldQuery::new(&[at]).within(limit), &Interrupt::NEVER)
    };
    let [blocked, outside] = [Vertex::new(0, 0), Vertex::new(7, 0)].map(|at| field(at, 1.0).err());
    let (end, last) = (End::Start, Vertex::new(2, 1));
    let query = |error| Some(CostFieldError::Query(error));
    assert_eq!(blocked, query(QueryError::Blocked { end, at: Vertex::new(0, 0).into() }));
    assert_eq!(outside, query(QueryError::Outside { end, at: Vertex::new(7, 0).into(), last }));
    assert!(matches!(field(Vertex::new(1, 0), -1.0), Err(CostFieldError::Limit { .. })));
    assert!(matches!(field(Vertex::new(1, 0), f64::NAN), Err(CostFieldError::Limit { .. })));
    let stopped = Interrupt::new().cancel(Arc::new(AtomicBool::new(true)));
    let field = CostField::new(Arc::clone(&graph), CostFieldQuery::new(&[Vertex::new(1, 0)]), &stopped);
    assert!(matches!(field, Err(CostFieldError::Interrupted(_))));
}

#[test]
fn a_map_without_a_free_cell_is_a_map() {
    let map = Arc::new(CostSurface::from_fn(3, 3, |_, _| None).expect("no cell is free"));
    let graph = Arc::new(CostGraph::new(map, Rules::Center(CornerRule::One), FiniteK::N4).expect("k = 2"));
    let field = CostField::new(graph, CostFieldQuery::new(&[]), &Interrupt::NEVER).expect("no source");
    assert!(field.into_rows().iter().all(|cost| cost.is_infinite()));
}
