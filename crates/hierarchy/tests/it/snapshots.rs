//! Drawings of paths of the hierarchical planners, for a reader to check by eye. Waypoints are 0, 1, 2, … in
//! order.

use std::fmt::Write;

use crate::common::{Bound, Setting, Solve, ask, chpa, clusters, grid_graph, hpa, k, number, segments};
use mediant_grid::{AsciiMap, CornerRule, PlacementKind, draw};
use mediant_hierarchy::{Clustering, FallbackPolicy};
use mediant_search::Ends;

const HALL: &str = "
    ........#...........
    ........#...........
    ...##........#......
    s..##...#....#...##.
    .....#.##....#...##.
    .....#.......#......
    .......#..####..#...
    .......#........#..g
    ####.###.....####...
    ....................
";

/// The sizes of the indexes, and drawings of the paths from `s` to `g`, each below its cost.
fn picture(number_of_k: u32) -> String {
    let map = AsciiMap::parse(HALL).expect("the drawing is a map");
    let query = Ends::new(map.mark('s').expect("s is drawn"), map.mark('g').expect("g is drawn"));
    let grid_graph = grid_graph(&map.grid, k(number_of_k), CornerRule::Never);
    let graph = clusters(&grid_graph, Clustering { side: 5, levels: 2 });
    let segments = segments(&grid_graph, 3);
    let mut text = format!(
        "k = {number_of_k}: {} clusters, {} nodes; {} segments, {} edges\n",
        graph.clusters(),
        graph.nodes(),
        segments.segments(),
        segments.edges()
    );
    let mut add = |name: &str, mut planner: Solve<'_>| {
        let (answer, counters) = ask(&mut planner, query);
        let answer = answer.expect("there is a path");
        let path = answer.path().expect("there is a path");
        let picture = draw(&map.grid, PlacementKind::Center, path.waypoints());
        let fallbacks = counters.fallbacks;
        writeln!(text, "{name}: {:.4}, fallbacks {fallbacks}\n{picture}", path.cost())
            .expect("a text takes all");
    };
    let bound = Some(Bound::GridGraph);
    let setting = Setting { phases: [bound; 2], step: number(2), fallback: FallbackPolicy::default() };
    add("HPA*, unstraightened", hpa(&grid_graph, &graph, false));
    add("HPA*", hpa(&grid_graph, &graph, true));
    add("CHPA*", chpa(&grid_graph, &segments, setting));
    let hasty =
        Setting { step: number(1), fallback: FallbackPolicy::Complete { detour: number(1) }, ..setting };
    add("CHPA*, which goes no detour", chpa(&grid_graph, &segments, hasty));
    text
}

#[test]
fn hall_k2() {
    insta::assert_snapshot!(picture(2));
}

#[test]
fn hall_k3() {
    insta::assert_snapshot!(picture(3));
}
