//! Sub-Theta*, step by step.

use mediant_grid::{AsciiMap, Corners, DiagonalGap, Vertex};
use mediant_search::{Answer, Counters, Ends, NodeEvent, Observer, Planner};
use mediant_subgoal::{Hierarchy, SubgoalTheta};

use crate::common::{graph, k, levels, space};

/// Records events as text.
#[derive(Default)]
struct Log(Vec<String>);

impl Log {
    fn line(&mut self, word: &str, node: NodeEvent) {
        let parent = node.parent.map_or("nowhere".to_owned(), |parent| parent.to_string());
        let [g, f] = [node.g, node.f].map(|cost| cost.to_f64());
        self.0.push(format!("{word} {} from {parent}: g {g:.3}, f {f:.3}", node.at));
    }
}

impl Observer for Log {
    fn expanded(&mut self, node: NodeEvent) {
        self.line("expanded", node);
    }

    fn generated(&mut self, node: NodeEvent) {
        self.line("generated", node);
    }

    fn updated(&mut self, node: NodeEvent) {
        self.line("updated", node);
    }
}

/// The events of a search over N(3), and the path.
fn solve(drawing: &str, hierarchy: Hierarchy, [start, goal]: [(i32, i32); 2]) -> (Vec<String>, Vec<Vertex>) {
    let map = AsciiMap::parse(drawing).expect("the drawing is a map");
    let space = space::<Corners>(&map.grid, DiagonalGap::Open);
    let graph = graph(&space, k(3), hierarchy);
    let mut planner = SubgoalTheta::new(&space, &graph).expect("the graph is for this space");
    let (query, mut log, mut counters) = (Ends::new(start, goal), Log::default(), Counters::default());
    let answer = planner.solve_observed(query, &mut log).expect("both ends are free");
    assert_eq!(planner.solve_observed(query, &mut counters), Ok(answer.clone()));
    let count = |word| log.0.iter().filter(|line| line.starts_with(word)).count() as u64;
    let counts = [count("expanded"), count("generated"), count("updated")];
    assert_eq!([counters.expanded, counters.generated, counters.updated], counts);
    let Answer::Found(path) = answer else { return (log.0, Vec::new()) };
    (log.0, path.into_waypoints())
}

const BLOCKS: &str = "
    ..........
    ..##......
    ..##..##..
    ......##..
    ..........
";

#[test]
fn events_to_the_letter() {
    let (events, path) = solve(BLOCKS, levels(1), [(0, 2), (10, 3)]);
    let expected = [
        "generated (2, 3) from (0, 2): g 2.236, f 10.236",
        "generated (2, 1) from (0, 2): g 2.236, f 10.482",
        "expanded (2, 3) from (0, 2): g 2.236, f 10.236",
        "generated (4, 3) from (2, 3): g 4.236, f 10.236",
        "expanded (4, 3) from (2, 3): g 4.236, f 10.236",
        "generated (4, 1) from (4, 3): g 6.236, f 12.561",
        "generated (6, 2) from (4, 3): g 6.472, f 10.595",
        // (2, 3) sees it.
        "generated (6, 4) from (2, 3): g 6.359, f 10.482",
        "expanded (6, 4) from (2, 3): g 6.359, f 10.482",
        "generated (8, 4) from (6, 4): g 8.359, f 10.595",
        "expanded (2, 1) from (0, 2): g 2.236, f 10.482",
        "updated (4, 1) from (2, 1): g 4.236, f 10.561",
        "expanded (4, 1) from (2, 1): g 4.236, f 10.561",
        "expanded (8, 4) from (6, 4): g 8.359, f 10.595",
        "generated (8, 2) from (8, 4): g 10.359, f 12.595",
        // The goal; it is not expanded.
        "generated (10, 3) from (8, 4): g 10.595, f 10.595",
    ];
    assert_eq!(events, expected);
    assert_eq!(path, [(0, 2), (2, 3), (6, 4), (8, 4), (10, 3)].map(Vertex::from));
}

/// A goal that the start sees needs no search, so there are no events.
#[test]
fn what_is_in_sight_is_reached_straight() {
    for hierarchy in [levels(1), levels(2), Hierarchy::AllLevels, Hierarchy::Contracted] {
        let (events, path) = solve(BLOCKS, hierarchy, [(0, 0), (10, 1)]);
        assert_eq!((events.len(), path), (0, [(0, 0), (10, 1)].map(Vertex::from).to_vec()));
        let (events, path) = solve(BLOCKS, hierarchy, [(2, 1), (2, 1)]);
        assert_eq!((events.len(), path), (0, vec![Vertex::new(2, 1)]));
    }
}
