//! The events that observers are told: on one map literally, on random maps by replay.

use std::{collections::HashMap, sync::Arc};

use mediant_grid::{
    AsciiMap, Centers, CornerRule, Corners, DiagonalGap, FreeSpace, Grid, GridGraph, Placement, Rules,
    Vertex, VertexId,
};
use mediant_moves::{Cost, FiniteK, Neighborhood, Vector, distance, distance_any_angle};
use mediant_oracle::{
    Explicit, Rng, Visibility, describe, random_free_vertex, seeds, segment_is_legal, suite_grid,
};
use mediant_search::{
    AStar, Answer, Anya, Counters, Ends, Hk, NodeEvent, Norm, Observer, Planner,
    parts::{Entry, OpenList},
};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Event {
    Expanded(NodeEvent),
    Generated(NodeEvent),
    Updated(NodeEvent),
    Percolated(u32),
}

/// Records all events.
#[derive(Default)]
struct Log(Vec<Event>);

impl Observer for Log {
    fn expanded(&mut self, node: NodeEvent) {
        self.0.push(Event::Expanded(node));
    }

    fn generated(&mut self, node: NodeEvent) {
        self.0.push(Event::Generated(node));
    }

    fn updated(&mut self, node: NodeEvent) {
        self.0.push(Event::Updated(node));
    }

    fn percolated(&mut self, swaps: u32) {
        self.0.push(Event::Percolated(swaps));
    }
}

/// An event as a line of text; `None` for swaps.
fn line(event: &Event) -> Option<String> {
    let (word, node) = match event {
        Event::Expanded(node) => ("expanded", node),
        Event::Generated(node) => ("generated", node),
        Event::Updated(node) => ("updated", node),
        Event::Percolated(_) => return None,
    };
    let parent = node.parent.map_or("nowhere".to_owned(), |parent| parent.to_string());
    Some(format!("{word} {} from {parent}: g {:.3}, f {:.3}", node.at, node.g.to_f64(), node.f.to_f64()))
}

#[test]
fn events_on_a_small_map() {
    let drawing = "
        s.#.
        #..#
        .#.g
    ";
    let map = AsciiMap::parse(drawing).expect("the drawing is a map");
    let query = Ends::new(map.mark('s').expect("s is drawn"), map.mark('g').expect("g is drawn"));
    let k = FiniteK::new(4).expect("k is at least 2");
    let grid_graph =
        GridGraph::<Centers>::new(Arc::new(map.grid), k, CornerRule::Never).expect("k is in range");
    let mut log = Log::default();
    AStar::new(&grid_graph, Hk).solve_observed(query, &mut log).expect("both ends are free");
    let lines: Vec<String> = log.0.iter().filter_map(line).collect();
    assert_eq!(
        lines,
        [
            "generated (0, 0) from nowhere: g 0.000, f 3.650",
            "expanded (0, 0) from nowhere: g 0.000, f 3.650",
            "generated (1, 0) from (0, 0): g 1.000, f 3.828",
            "generated (2, 1) from (0, 0): g 2.236, f 3.650",
            "expanded (2, 1) from (0, 0): g 2.236, f 3.650",
            "generated (2, 2) from (2, 1): g 3.236, f 4.236",
            "generated (1, 1) from (2, 1): g 3.236, f 5.472",
            "expanded (1, 0) from (0, 0): g 1.000, f 3.828",
            // From now on f ties with that of (2, 2), which is nearer to the goal.
            "updated (1, 1) from (1, 0): g 2.000, f 4.236",
            "expanded (2, 2) from (2, 1): g 3.236, f 4.236",
            "generated (3, 2) from (2, 2): g 4.236, f 4.236",
        ]
    );
}

/// An observer whose type is not known, behind a reference.
#[test]
fn a_trait_object_watches_a_search() {
    let map = AsciiMap::parse("s..\n.#.\n..g").expect("the drawing is a map");
    let query = Ends::new(map.mark('s').expect("s is drawn"), map.mark('g').expect("g is drawn"));
    let grid_graph = GridGraph::<Centers>::new(Arc::new(map.grid), FiniteK::N8, CornerRule::Never);
    let grid_graph = grid_graph.expect("k is in range");
    let (mut expected, mut found) = (Counters::default(), Counters::default());
    let mut planner = AStar::new(&grid_graph, Hk);
    let answer = planner.solve_observed(query, &mut expected).expect("both ends are free");
    let mut observer: &mut dyn Observer = &mut found;
    assert_eq!(planner.solve_observed(query, &mut observer), Ok(answer));
    assert_eq!(found, expected);
    assert!(expected.expanded > 0 && expected.generated > 0);
}

/// The state of a search, from its events alone.
#[derive(Default)]
struct Replay {
    open: OpenList,
    slots: HashMap<VertexId, u32>,
    /// The last event of each vertex, and whether it was expanded.
    nodes: HashMap<Vertex, (NodeEvent, bool)>,
    /// Swaps of the replayed open list: by pushes and pops, and by decreases.
    swaps: [u32; 2],
}

impl Replay {
    fn pop(&mut self) -> Option<Entry> {
        let Self { open, slots, swaps, .. } = self;
        let (entry, count) = open.pop(|id, slot| _ = slots.insert(id, slot))?;
        swaps[0] += count;
        Some(entry)
    }

    fn apply<P: Placement>(&mut self, event: Event, grid_graph: &GridGraph<P>, goal: Vertex) {
        let (Event::Expanded(node) | Event::Generated(node) | Event::Updated(node)) = event else { return };
        let id = grid_graph.id(node.at).expect("a vertex of the map");
        let h = grid_graph.costs().distance(node.at.to(goal));
        assert_eq!(node.f, node.g + h, "f is g and the heuristic");
        let known = self.nodes.get(&node.at).copied();
        if let Event::Expanded(node) = event {
            assert_eq!(known, Some((node, false)), "generated before, expanded as last reported, and once");
            self.nodes.insert(node.at, (node, true));
            let entry = self.pop().expect("a node in the open list");
            assert_eq!((entry.id(), entry.f()), (id, node.f), "the least entry is expanded");
            return;
        }
        match node.parent {
            None => assert!(self.nodes.is_empty() && node.g == Cost::ZERO, "only the start has no parent"),
            Some(parent) => {
                let step = parent.to(node.at);
                let moves = Neighborhood::new(grid_graph.k()).expect("k is in range");
                assert!(
                    moves.contains(step)
                        && segment_is_legal(grid_graph.grid(), grid_graph.rules(), parent, node.at)
                );
                let (from, is_expanded) = self.nodes[&parent];
                assert!(is_expanded && node.g == from.g + Cost::of_move(step), "not a step from {from:?}");
            }
        }
        let slots = &mut self.slots;
        let moved = |id, slot| _ = slots.insert(id, slot);
        if let Event::Generated(_) = event {
            assert_eq!(known, None, "generated once");
            self.swaps[0] += self.open.push(Entry::new(node.f, h, id), moved);
        } else {
            let (before, is_expanded) = known.expect("generated before");
            assert!(node.g < before.g && !is_expanded, "{before:?} needed no update");
            let slot = slots[&id];
            self.swaps[1] +=
                self.open.decrease(slot, before.g - node.g, |id, slot| _ = slots.insert(id, slot));
        }
        self.nodes.insert(node.at, (node, false));
    }
}

/// Replays searches on one map. Returns the number of swaps by decreases.
fn replay<P: Placement>(grid: &Arc<Grid>, rule: P::Rule, k: FiniteK, seed: u64) -> u32 {
    let grid_graph = GridGraph::<P>::new(Arc::clone(grid), k, rule).expect("k is in range");
    let mut planner = AStar::new(&grid_graph, Hk);
    let mut rng = Rng::new(seed ^ 0xE7E);
    let mut free = || random_free_vertex(&mut rng, grid, grid_graph.rules().placement());
    let mut swaps_by_decreases = 0;
    for (start, goal) in (0..4).filter_map(|_| Some((free()?, free()?))).collect::<Vec<_>>() {
        let case = || format!("k = {k}; {}", describe(grid, grid_graph.rules(), start, goal, seed));
        let (query, mut log, mut counters) = (Ends::new(start, goal), Log::default(), Counters::default());
        let answer = planner.solve_observed(query, &mut log).expect("both ends are free");
        assert_eq!(planner.solve_observed(query, &mut counters).as_ref(), Ok(&answer), "{}", case());
        let Answer::Found(path) = answer else {
            assert_eq!((log.0.len(), counters), (0, Counters::default()), "{}", case());
            continue;
        };
        let mut replay = Replay::default();
        log.0.iter().for_each(|&event| replay.apply(event, &grid_graph, goal));
        // The goal is taken from the open list, and not expanded.
        assert_eq!(replay.pop().map(Entry::id), grid_graph.id(goal), "{}", case());
        let (last, is_expanded) = replay.nodes[&goal];
        assert!((last.g.to_f64() - path.cost()).abs() < 1e-6 && !is_expanded, "{}", case());

        let count = |is: fn(&Event) -> bool| log.0.iter().filter(|event| is(event)).count() as u64;
        let expected = Counters {
            expanded: count(|event| matches!(event, Event::Expanded(_))),
            generated: count(|event| matches!(event, Event::Generated(_))),
            updated: count(|event| matches!(event, Event::Updated(_))),
            percolations: u64::from(replay.swaps[0] + replay.swaps[1]),
            scanned: 0,
            fallbacks: 0,
        };
        assert_eq!(counters, expected, "{}", case());
        assert!(counters.generated > counters.expanded, "{}", case());
        swaps_by_decreases += replay.swaps[1];
    }
    swaps_by_decreases
}

#[test]
fn events_tell_the_whole_search() {
    let mut swaps_by_decreases = 0;
    for seed in seeds(100) {
        let grid = Arc::new(suite_grid(seed).0);
        for (rules, k) in Rules::ALL.into_iter().flat_map(|rules| [2, 3, 5].map(|k| (rules, k))) {
            let k = FiniteK::new(k).expect("k is at least 2");
            swaps_by_decreases += match rules {
                Rules::Center(corners) => replay::<Centers>(&grid, corners, k, seed),
                Rules::Corner(gap) | Rules::CenterGap(gap) => replay::<Corners>(&grid, gap, k, seed),
            };
        }
    }
    assert!(swaps_by_decreases > 100, "only {swaps_by_decreases} swaps by decreases");
}

/// Checks the events of a search by Anya: of each node its root, the root before that, and their costs, by
/// the distances from the start and the lengths of lines. Returns how many nodes had a root before theirs,
/// and of how many roots the cost is the distance.
fn check_roots<N: Norm>(
    (mut anya, space): (Anya<&FreeSpace<Corners>, N>, &FreeSpace<Corners>),
    query: Ends,
    case: &str,
    distance: impl Fn(Vertex) -> f64,
    length: impl Fn(Vector) -> f64,
) -> [usize; 2] {
    let mut log = Log::default();
    let answer = anya.solve_observed(query, &mut log).expect("both ends are free");
    let Answer::Found(path) = answer else {
        assert!(log.0.is_empty(), "{case}");
        return [0; 2];
    };
    let (mut last, mut counts) = (0.0_f64, [0; 2]);
    for event in log.0 {
        let (node, is_expanded) = match event {
            Event::Expanded(node) => (node, true),
            Event::Generated(node) => (node, false),
            other => panic!("{other:?}; {case}"),
        };
        let (g, f) = (node.g.to_f64(), node.f.to_f64());
        let is_in_order = !is_expanded || f >= last - 1e-6 && f <= path.cost() + 1e-6;
        assert!(g <= f + 1e-6 && is_in_order, "{node:?}; {case}");
        last = if is_expanded { f } else { last };
        counts[1] += usize::from((g - distance(node.at)).abs() < 1e-6);
        let Some(parent) = node.parent else {
            assert_eq!((node.at, g), (query.start, 0.0), "{case}");
            continue;
        };
        assert!(space.sees(parent, node.at), "{parent} to {}; {case}", node.at);
        assert!(g >= distance(parent) + length(parent.to(node.at)) - 1e-6, "{node:?}; {case}");
        counts[0] += 1;
    }
    counts
}

#[test]
fn events_of_anya_tell_its_roots() {
    let mut counts = [0; 2];
    for seed in seeds(60) {
        let grid = Arc::new(suite_grid(seed).0);
        for gap in DiagonalGap::ALL {
            let space = FreeSpace::<Corners>::new(Arc::clone(&grid), gap);
            let rng = &mut Rng::new(seed ^ 0xA47A);
            for _ in 0..6 {
                let mut free = || random_free_vertex(rng, &grid, Corners::KIND);
                let (Some(start), Some(goal)) = (free(), free()) else { continue };
                let case = describe(&grid, space.rules(), start, goal, seed);
                let (query, k) = (Ends::new(start, goal), FiniteK::new(2 + rng.below(5)).expect("from 2"));
                let visibility = Visibility::new(&grid, gap);
                let graph = visibility.over(None);
                let costs = graph.costs_from(start);
                let at = |at: Vertex| costs.to(at).expect("it is reached");
                let any_angle =
                    check_roots((Anya::new(&space), &space), query, &case, at, distance_any_angle);
                let graph = Explicit::new(&grid, space.rules(), Some(k));
                let costs = graph.costs_from(start);
                let at = |at: Vertex| costs.to(at).expect("it is reached");
                let (anya, case) = (Anya::over(&space, k).expect("a small k"), format!("k = {k}; {case}"));
                let over_k = check_roots((anya, &space), query, &case, at, |by| distance(by, k));
                for [more, exact] in [any_angle, over_k] {
                    counts = [counts[0] + more, counts[1] + exact];
                }
            }
        }
    }
    assert!(counts.iter().all(|&count| count > 1_000), "{counts:?}");
}
