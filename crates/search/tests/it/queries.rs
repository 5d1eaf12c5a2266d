//! Invalid queries: the errors, and their texts.

use std::sync::Arc;

use mediant_grid::{AsciiMap, CornerRule, Corners, DiagonalGap, FreeSpace, Grid, GridGraph, Rules, Vertex};
use mediant_moves::FiniteK;
use mediant_search::{
    AStar, Anya, Canonical, End, Ends, Hk, Jps, LazyThetaStar, PaperCanonical, Planner, QueryError,
    SearchStatus, ThetaStar, Wavefront,
};

use crate::common::with_engines;

const CENTERS: Rules = Rules::Center(CornerRule::Never);
const CORNERS: Rules = Rules::Corner(DiagonalGap::Open);

/// The error of a query, the same for every engine.
fn error(grid: &Arc<Grid>, rules: Rules, start: (i32, i32), goal: (i32, i32)) -> Option<QueryError> {
    with_engines(grid, rules, 3, |mut engines| {
        let query = Ends::new(start, goal);
        let errors: Vec<_> = engines.iter_mut().map(|engine| engine.solve(query).err()).collect();
        assert!(errors.windows(2).all(|pair| pair[0] == pair[1]), "{errors:?}");
        errors[0]
    })
}

/// Blocked: cells (1, 0), (2, 0), (1, 1), (2, 1); at corners vertex (2, 1), and (2, 0) on the border.
fn grid() -> Arc<Grid> {
    let drawing = "
        .##.
        .##.
        ....
    ";
    Arc::new(AsciiMap::parse(drawing).expect("the drawing is a map").grid)
}

#[test]
fn ends_outside_the_map_are_reported_with_its_last_vertex() {
    let (grid, free) = (grid(), (0, 0));
    for (rules, last) in [(CENTERS, Vertex::new(3, 2)), (CORNERS, Vertex::new(4, 3))] {
        let inside = (last.x, last.y);
        assert_eq!(error(&grid, rules, free, inside), None);
        let beyond = [
            (last.x + 1, 0),
            (0, last.y + 1),
            (-1, 0),
            (0, -1),
            (i32::MIN, 0),
            (0, i32::MIN),
            (i32::MAX, 0),
            (0, i32::MAX),
            (i32::MIN, i32::MAX),
            (i32::MAX, i32::MIN),
        ];
        for outside in beyond {
            let said = |end| Some(QueryError::Outside { end, at: outside.into(), last });
            assert_eq!(error(&grid, rules, outside, free), said(End::Start), "{rules}");
            assert_eq!(error(&grid, rules, free, outside), said(End::Goal), "{rules}");
            // The start is checked first, whatever is wrong with the goal; also when both are the same.
            assert_eq!(error(&grid, rules, outside, (-7, -7)), said(End::Start), "{rules}");
            assert_eq!(error(&grid, rules, outside, outside), said(End::Start), "{rules}");
        }
    }
}

#[test]
fn blocked_ends_are_reported() {
    let (grid, free) = (grid(), (0, 0));
    for (rules, blocked) in [(CENTERS, [(1, 0), (2, 1)]), (CORNERS, [(2, 0), (2, 1)])] {
        for blocked in blocked {
            let said = |end| Some(QueryError::Blocked { end, at: blocked.into() });
            assert_eq!(error(&grid, rules, blocked, free), said(End::Start), "{rules}");
            assert_eq!(error(&grid, rules, free, blocked), said(End::Goal), "{rules}");
            assert_eq!(error(&grid, rules, blocked, blocked), said(End::Start), "{rules}");
            // The start first: a blocked one before a goal outside.
            assert_eq!(error(&grid, rules, blocked, (i32::MAX, 0)), said(End::Start), "{rules}");
        }
    }
    // A corner of a blocked cell is a free vertex if a free cell touches it.
    assert_eq!(error(&grid, CORNERS, (1, 1), (2, 2)), None);
}

#[test]
fn errors_say_what_to_do() {
    let grid = grid();
    let text = |start, goal| error(&grid, CENTERS, start, goal).map(|error| error.to_string());
    assert_eq!(
        text((0, 0), (4, -1)).as_deref(),
        Some("the goal (4, -1) is outside the map, whose vertices run from (0, 0) to (3, 2)")
    );
    assert_eq!(text((1, 1), (0, 0)).as_deref(), Some("the start (1, 1) is blocked: choose a free vertex"));
}

/// After a query without an answer a planner knows no path, also not those of the query before.
fn check_forgotten(planner: &mut impl Planner) {
    let found = planner.solve(Ends::new((0, 0), (2, 2)));
    assert!(found.is_ok_and(|answer| answer.path().is_some()));
    assert!(planner.path_to((2, 2).into()).is_some());
    assert_eq!(planner.begin(Ends::new((0, 0), (5, 2)), &mut ()), Ok(SearchStatus::Unreachable));
    for at in [(0, 0), (2, 2), (1, 1), (5, 2), (9, 9)] {
        assert_eq!(planner.path_to(at.into()), None, "{at:?}");
    }
}

#[test]
fn a_query_without_an_answer_leaves_no_path() {
    let grid = Arc::new(AsciiMap::parse("..#..\n..#..\n").expect("a map").grid);
    let graph = GridGraph::<Corners>::new(Arc::clone(&grid), FiniteK::N8, DiagonalGap::Open).expect("k = 3");
    check_forgotten(&mut AStar::new(&graph, Hk));
    check_forgotten(&mut Canonical::new(&graph, Hk));
    check_forgotten(&mut PaperCanonical::new(&graph, Hk));
    check_forgotten(&mut Jps::new(&graph, Hk));
    check_forgotten(&mut Wavefront::new(&graph));
    check_forgotten(&mut ThetaStar::new(&graph, Hk));
    check_forgotten(&mut LazyThetaStar::new(&graph, Hk));
    let space = FreeSpace::<Corners>::new(grid, DiagonalGap::Open);
    check_forgotten(&mut Anya::new(&space));
}
