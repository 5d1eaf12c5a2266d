//! Bad input: errors that say which and why.

use std::sync::{Arc, atomic::AtomicBool};

use mediant_costs::{
    CostFieldError, CostFieldQuery, CostsError, Heading, Langmuir, Pace, WalkingError, WalkingField,
    WalkingGraph, WalkingMap,
};
use mediant_grid::{CornerRule, DiagonalGap, Interrupt, Rules, Vertex};
use mediant_moves::FiniteK;
use mediant_search::{End, QueryError};

fn map(pace: &Pace, ground: impl Fn(u32, u32) -> Option<(f64, f64)>) -> Result<WalkingMap, WalkingError> {
    WalkingMap::with_friction((4, 3), (10.0, 10.0), pace, &Interrupt::NEVER, ground)
}

#[test]
fn bad_ground_is_named_with_its_cell() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let of = |elevation, friction| {
            map(&Pace::Tobler, |x, y| Some(if (x, y) == (2, 1) { (elevation, friction) } else { (1.0, 0.0) }))
        };
        assert!(matches!(of(bad, 0.0), Err(WalkingError::Elevation { x: 2, y: 1, .. })));
        assert!(matches!(of(1.0, bad), Err(WalkingError::Friction { x: 2, y: 1, .. })));
        for friction in [-0.5, 1e-121, 1e121] {
            assert!(matches!(of(1.0, friction), Err(WalkingError::Friction { x: 2, y: 1, .. })));
        }
    }
    let of = |size, cell_size| {
        WalkingMap::new(size, cell_size, &Pace::Tobler, &Interrupt::NEVER, |_, _| Some(0.0))
    };
    assert!(matches!(of((0, 3), (1.0, 1.0)), Err(WalkingError::Costs(CostsError::Size { .. }))));
    assert!(matches!(of((3, 3), (1.0, -1.0)), Err(WalkingError::Costs(CostsError::CellSize { .. }))));
    let stopped = Interrupt::new().cancel(Arc::new(AtomicBool::new(true)));
    let stopped = WalkingMap::new((3, 3), (1.0, 1.0), &Pace::Tobler, &stopped, |_, _| Some(0.0));
    assert!(matches!(stopped, Err(WalkingError::Costs(CostsError::Interrupted(_)))));
}

#[test]
fn a_pace_is_positive_on_the_slopes_of_the_map() {
    let hill = |x: u32, _| Some((f64::from(x), 0.0));
    let table = |knots: &[(f64, f64)]| map(&Pace::Table(knots.to_vec()), hill);
    for bad in [&[][..], &[(0.1, 1.0), (0.0, 1.0)], &[(f64::NAN, 1.0)], &[(0.0, 1.0), (f64::INFINITY, 1.0)]] {
        assert!(matches!(table(bad), Err(WalkingError::Table)), "{bad:?}");
    }
    for time in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-121, 1e121] {
        // The first and the last of several count, too.
        for knots in [[(-0.05, time), (0.05, 1.0)], [(-0.05, 1.0), (0.05, time)]] {
            assert!(matches!(table(&knots), Err(WalkingError::Pace { .. })), "{knots:?}");
        }
        assert!(matches!(table(&[(0.0, time)]), Err(WalkingError::Pace { .. })), "{time}");
        assert!(
            matches!(table(&[(-9.0, 1.0), (0.0, time), (9.0, 1.0)]), Err(WalkingError::Pace { .. })),
            "{time}"
        );
    }
    // On slopes that the map has not, it is not asked.
    assert!(table(&[(-0.2, 1.0), (0.2, 1.0), (5.0, -9.0)]).is_ok());
    assert!(matches!(table(&[(-0.01, 1e-7), (0.01, 1.0)]), Err(WalkingError::Range { .. })));
    let never_steep = Langmuir { slope_factor: -1.0, ..Langmuir::default() };
    let cliff = |x: u32, _| Some((if x > 1 { 9.0 } else { 0.0 }, 0.0));
    assert!(matches!(map(&Pace::Langmuir(never_steep), cliff), Err(WalkingError::Pace { .. })));
    let nan = Langmuir { slope_factor: f64::NAN, ..Langmuir::default() };
    assert!(map(&Pace::Langmuir(nan), hill).is_err());
}

#[test]
fn corners_and_blocked_ends_are_refused() {
    let map = Arc::new(map(&Pace::Tobler, |x, _| (x > 0).then_some((1.0, 0.0))).expect("a map"));
    let corners = WalkingGraph::new(Arc::clone(&map), Rules::Corner(DiagonalGap::Open), FiniteK::N8);
    assert!(matches!(corners, Err(WalkingError::Corners)));
    let rules = Rules::Center(CornerRule::Never);
    let nine = WalkingGraph::new(Arc::clone(&map), rules, FiniteK::new(9).expect("a k"));
    assert!(matches!(nine, Err(WalkingError::Costs(CostsError::K { max: 8, .. }))));
    let graph = Arc::new(WalkingGraph::new(map, rules, FiniteK::N8).expect("k = 3"));
    let field = |at: Vertex, limit| {
        let sources = [at];
        let query = CostFieldQuery::new(&sources).within(limit);
        WalkingField::new(Arc::clone(&graph), Heading::ToSources, query, &Interrupt::NEVER).map(|_| ())
    };
    for at in [Vertex::new(0, 0), Vertex::new(7, 0)] {
        assert!(matches!(field(at, 1.0), Err(WalkingError::Field(CostFieldError::Query(_)))));
    }
    assert!(matches!(field(Vertex::new(1, 0), -1.0), Err(WalkingError::Field(CostFieldError::Limit { .. }))));
    assert_eq!(field(Vertex::new(1, 0), 1.0), Ok(()));
}

#[test]
fn ends_outside_the_map_are_told_the_last_vertex() {
    let map = map(&Pace::Tobler, |x, y| ((x, y) != (1, 1)).then_some((0.0, 0.0))).expect("a map");
    let rules = Rules::Center(CornerRule::Never);
    let k = FiniteK::new(3).expect("k is at least 2");
    let graph = WalkingGraph::new(Arc::new(map), rules, k).expect("a graph");
    for at in [Vertex::new(4, 0), Vertex::new(0, 3), Vertex::new(-1, 0)] {
        let told = graph.check(End::Goal, at);
        let last = Vertex::new(3, 2);
        assert_eq!(told, Err(QueryError::Outside { end: End::Goal, at: at.into(), last }));
    }
    let blocked = Vertex::new(1, 1);
    assert_eq!(
        graph.check(End::Start, blocked),
        Err(QueryError::Blocked { end: End::Start, at: blocked.into() })
    );
    assert_eq!(graph.check(End::Start, Vertex::new(3, 2)), Ok(()));
}

#[test]
fn the_times_of_a_map_lie_between_its_bounds() {
    let steady = Pace::Table(vec![(-1.0, 2.0), (1.0, 2.0)]);
    let flat = map(&steady, |x, _| Some((5.0, if x == 1 { 3.0 } else { 0.5 }))).expect("a map");
    assert_eq!(flat.bounds(), (2.5, 5.0));
    assert_eq!(map(&steady, |_, _| Some((5.0, 0.0))).expect("a map").bounds(), (2.0, 2.0));
}
