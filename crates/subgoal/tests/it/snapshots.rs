//! Paths over subgoal graphs, drawn, so that a reader can check them by eye.
//!
//! The waypoints are numbered 0, 1, 2, …; cells are drawn at odd columns and rows, vertices at even ones.

use std::fmt::Write;

use mediant_grid::{AsciiMap, Corners, DiagonalGap, PlacementKind, draw};
use mediant_moves::K;
use mediant_search::{Ends, Planner};
use mediant_subgoal::{SubgoalAStar, SubgoalTheta};

use crate::common::{graph, k, levels, space};

const HALL: &str = "
    ........#.......
    ........#.......
    ................
    ...##...........
    s..##...#...##..
    .....#.#........
    .......#..####..
    .......#......#g
";

/// The numbers of subgoals and edges, then the path of each planner from `s` to `g`, with its cost.
fn picture(k: K, gap: DiagonalGap) -> String {
    let map = AsciiMap::parse(HALL).expect("the drawing is a map");
    let query = Ends::new(map.mark('s').expect("s is drawn"), map.mark('g').expect("g is drawn"));
    let space = space::<Corners>(&map.grid, gap);
    let graph = |hierarchy| graph(&space, k, hierarchy);
    let (one, two) = (graph(levels(1)), graph(levels(2)));
    let mut text = format!(
        "k = {k}, gap {gap}: {} subgoals, {} edges; {} subgoals on level 2\n",
        one.subgoals(),
        one.edges().count(),
        two.core()
    );
    let mut add = |name: &str, planner: &mut dyn FnMut(Ends) -> Option<mediant_search::Path>| {
        let path = planner(query).expect("there is a path");
        let picture = draw(&map.grid, PlacementKind::Corner, path.waypoints());
        write!(text, "{name}: {:.4}\n{picture}", path.cost()).expect("a text takes all");
    };
    let mut a_star = SubgoalAStar::new(&space, &two).expect("the graph is for this space");
    let mut theta = SubgoalTheta::new(&space, &two).expect("the graph is for this space");
    add("Sub2-A*", &mut |query| a_star.solve(query).ok()?.path().cloned());
    add("Sub2-Theta*", &mut |query| theta.solve(query).ok()?.path().cloned());
    text
}

#[test]
fn hall_k3() {
    insta::assert_snapshot!(picture(k(3), DiagonalGap::Open));
}

#[test]
fn hall_k5() {
    insta::assert_snapshot!(picture(k(5), DiagonalGap::Open));
}

#[test]
fn hall_any_angle() {
    insta::assert_snapshot!(picture(K::Any, DiagonalGap::Open));
}

#[test]
fn hall_k5_gap_closed() {
    insta::assert_snapshot!(picture(k(5), DiagonalGap::Closed));
}
