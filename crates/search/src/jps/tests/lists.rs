//! Jump lists against jumps that are made step by step, and tables from their bytes.

use std::sync::Arc;

use mediant_grid::{Centers, Grid, GridGraph, Identity, Placement, Vector, Vertex, uninterrupted};
use mediant_moves::{Cost, FiniteK};
use mediant_oracle::{Rng, every, noise};

use super::{
    super::{
        BlockJps, Jps, JpsPlus, JumpError, JumpFinder, JumpPointSearch, JumpTable, axial::AxialStops,
        planes::JumpPlanes,
    },
    Reference, Suite, forced_of, long_grids, on_all, pattern_at, suite_grids,
};
use crate::{
    Ends, Hk, Planner, Zero,
    canonical::Pruning,
    successors::{ExpandedNode, KnownPath, LookUp, Successor, Successors},
};

/// Jump lists lead where steps lead, with the goal in sight or anywhere, and tables come back from their
/// bytes.
#[derive(Default)]
pub(super) struct Lists {
    lists: usize,
    jumps: usize,
    goals_in_sight: usize,
    longest: i32,
}

impl Suite for Lists {
    fn check<P: Placement>(&mut self, reference: &Reference<P>, case: &dyn Fn(Vertex, Vertex) -> String) {
        let graph = &reference.graph;
        let pruning = Arc::new(Pruning::new(graph));
        let table = uninterrupted(|never| {
            let axial = AxialStops::new(graph, never)?;
            let planes = JumpPlanes::with_dead_ends(graph, &pruning, axial, 0, never)?;
            JumpTable::from_planes(graph, &pruning, planes, never)
        });
        self.lists += table.lists().len();
        let mut looked_up = JpsPlus::with_finder(graph, pruning, Arc::new(table), Zero).unwrap();
        let mut by_steps = Jps::new(graph, Zero);
        let free: Vec<_> = reference.vertices().filter(|&(_, at)| graph.is_free(at)).collect();
        let rng = &mut Rng::new(graph.vertex_count() as u64);
        for &(id, at) in &free {
            let arrives = |&by: &usize| reference.has_forced(at, by) && !reference.is_closed_gap(at);
            for by in (0..reference.move_count()).step_by(2).filter(arrives) {
                let node = ExpandedNode { id, at, by: Some(by) };
                let (_, goal) = free[rng.below(free.len() as u32) as usize];
                if goal == at {
                    // No search goes on from its goal.
                    continue;
                }
                let (found, scanned) = successors(&mut looked_up, node, goal);
                if scanned > 0 {
                    // No path arrives there by this move, or gaps are near.
                    let may_arrive = graph.is_legal(at + -graph.step(by).vector(), graph.step(by).vector());
                    assert!(!may_arrive || graph.has_closed_gaps(), "no list, move {by}, {}", case(at, goal));
                    continue;
                }
                let (expected, _) = successors(&mut by_steps, node, goal);
                if reference.is_in_sight(at, by, goal) {
                    // Nothing but the goal need be visited.
                    let to_goal = (goal, graph.costs().distance(at.to(goal)));
                    let mut others = found.iter().filter(|&&next| next != to_goal);
                    assert!(found.contains(&to_goal), "move {by}, {}", case(at, goal));
                    assert!(others.all(|next| expected.contains(next)), "move {by}, {}", case(at, goal));
                    self.goals_in_sight += 1;
                } else {
                    assert_eq!(found, expected, "move {by}, {}", case(at, goal));
                }
                self.jumps += found.len();
                let length = |&(to, _): &(Vertex, Cost)| at.x.abs_diff(to.x).max(at.y.abs_diff(to.y));
                self.longest = self.longest.max(found.iter().map(length).max().unwrap_or(0) as i32);
            }
        }
        let table = JumpTable::new(graph).unwrap();
        let again = JumpTable::from_bytes(graph, &table.to_bytes());
        assert_eq!(again.as_ref(), Ok(&table), "{}", case(Vertex::default(), Vertex::default()));
    }
}

/// The successors of a node in a search for a goal, in order, and the number of vertices scanned for them.
fn successors<P: Placement, J: JumpFinder<P>>(
    planner: &mut JumpPointSearch<&GridGraph<P>, Zero, P, J>,
    node: ExpandedNode,
    goal: Vertex,
) -> (Vec<(Vertex, Cost)>, u32) {
    planner.successors.begin(planner.graph, goal);
    let mut found = Vec::new();
    let mut visit = |next: Successor| {
        found.push((next.at, next.cost));
        KnownPath::NONE
    };
    let scanned = match planner.successors.look_up(planner.graph, node, goal, &mut visit) {
        LookUp::Unknown => planner.successors.for_each(planner.graph, node, goal, visit),
        LookUp::Visited => 0,
        LookUp::Goal(goal) => {
            visit(goal);
            0
        }
    };
    found.sort_unstable();
    (found, scanned)
}

#[test]
fn jump_lists_lead_where_steps_lead() {
    let mut suite = Lists::default();
    on_all(suite_grids().chain(long_grids()), &mut suite);
    assert!(suite.lists > 20_000 && suite.jumps > 40_000, "{}, {}", suite.lists, suite.jumps);
    assert!(suite.goals_in_sight > 3_000, "{}", suite.goals_in_sight);
    assert!(suite.longest > 3 * 64, "{}", suite.longest);
}

/// Jumps longer than a word can say have no list, and lead where they lead without.
#[test]
fn jumps_longer_than_a_list_can_say_are_scanned() {
    for (length, fits) in [(8000, true), (8180, true), (8200, false), (9000, false)] {
        // Two bumps on a corridor of three rows: the jumps between them are as long as it.
        let grid = Grid::from_fn(length + 20, 3, |x, y| y == 1 && (x == 8 || x == length + 8)).unwrap();
        for (k, grid) in [(3, grid.clone()), (2, transposed(&grid))] {
            let graph =
                &GridGraph::<Centers>::new(Arc::new(grid), FiniteK::new(k).unwrap(), Default::default())
                    .unwrap();
            let table = Arc::new(JumpTable::new(graph).unwrap());
            let has_long = table.lists().words().any(|word| word & 0x1fff > 7900 && word & 0x1fff != 0x1fff);
            assert_eq!(has_long, fits, "{length}, k = {k}");
            let mut planners = (JpsPlus::new(graph, table, Hk).unwrap(), BlockJps::new(graph, Hk).unwrap());
            let ends = [(0, 0), (0, 2), (12, 0), (length as i32 + 15, 2), (length as i32 + 2, 0)];
            for (start, goal) in ends.iter().flat_map(|&start| ends.map(|goal| (start, goal))) {
                let turned = |(x, y): (i32, i32)| if k == 2 { (y, x) } else { (x, y) };
                let query = Ends::new(turned(start), turned(goal));
                let costs =
                    (planners.0.solve(query).unwrap().cost(), planners.1.solve(query).unwrap().cost());
                assert_eq!(costs.0, costs.1, "{length}, k = {k}, {start:?} to {goal:?}");
            }
        }
    }
}

fn transposed(grid: &Grid) -> Grid {
    Grid::from_fn(grid.height(), grid.width(), |x, y| grid.is_blocked(y as i32, x as i32)).unwrap()
}

fn damaged_graph() -> GridGraph<Centers> {
    let grid = noise(&mut Rng::new(5), 20, 15, 20);
    GridGraph::new(Arc::new(grid), FiniteK::N8, Default::default()).unwrap()
}

#[test]
fn bytes_of_another_length_are_refused() {
    let graph = damaged_graph();
    let bytes = JumpTable::new(&graph).unwrap().to_bytes();
    const HEAD: usize = Identity::BYTES;
    assert!(bytes.len() > HEAD + 20 * 15, "{}", bytes.len());
    for length in [HEAD, HEAD + 1, bytes.len() - 1, bytes.len() + 1, 2 * bytes.len()] {
        let mut other = bytes.clone();
        other.resize(length, 0);
        let error = JumpError::Length { expected: bytes.len() - HEAD, found: length - HEAD };
        assert_eq!(JumpTable::from_bytes(&graph, &other), Err(error));
    }
    for length in 0..HEAD {
        assert_eq!(JumpTable::from_bytes(&graph, &bytes[..length]), Err(JumpError::Bytes));
    }
}

#[test]
fn every_flipped_bit_is_refused() {
    let graph = damaged_graph();
    let bytes = JumpTable::new(&graph).unwrap().to_bytes();
    for bit in (0..8 * bytes.len()).step_by(every(7)) {
        let mut other = bytes.clone();
        other[bit / 8] ^= 1 << (bit % 8);
        let refused = JumpTable::from_bytes(&graph, &other);
        let is_named = match refused {
            Err(JumpError::Entry { .. }) => bit >= 8 * Identity::BYTES,
            Err(JumpError::Bytes | JumpError::Mismatch(_)) => bit < 8 * Identity::BYTES,
            _ => false,
        };
        assert!(is_named, "bit {bit}: {refused:?}");
    }
}

#[test]
fn tables_of_other_graphs_are_refused() {
    let graph = damaged_graph();
    let table = JumpTable::new(&graph).unwrap();
    let other = noise(&mut Rng::new(6), 20, 15, 20);
    let other = GridGraph::<Centers>::new(Arc::new(other), graph.k(), graph.rule()).unwrap();
    let refused = JumpTable::from_bytes(&other, &table.to_bytes());
    assert!(matches!(refused, Err(JumpError::Mismatch(_))), "{refused:?}");

    let k4 =
        GridGraph::<Centers>::new(Arc::clone(graph.grid()), FiniteK::new(4).unwrap(), graph.rule()).unwrap();
    assert!(JumpTable::new(&k4).is_err());
    let refused = JumpTable::from_bytes(&k4, &table.to_bytes());
    assert!(matches!(refused, Err(JumpError::Mismatch(_))), "{refused:?}");
}

#[test]
fn errors_say_what_was_expected_and_found() {
    let graph = damaged_graph();
    let table = JumpTable::new(&graph).unwrap();
    let mut bytes = table.to_bytes();
    let starts = 4 * (table.lists().len() + 1);
    let names = |place: usize| {
        let (id, by) = table.lists().place_of(place);
        let (at, by) = (graph.vertex(id), graph.step(by).vector());
        (at, by, format!("from ({}, {})", at.x, at.y), format!("by move ({}, {})", by.x, by.y))
    };
    // The first word of the first list, and the last one of the last list.
    for (byte, list) in [(starts, 0), (bytes.len() - 4 - Identity::BYTES, table.lists().len() - 1)] {
        bytes[Identity::BYTES + byte] ^= 0x80;
        let text = JumpTable::from_bytes(&graph, &bytes).unwrap_err().to_string();
        let (at, by, from, arriving) = names(list);
        assert!(text.contains(&from) && text.contains(&arriving) && text.contains("build it anew"), "{text}");
        assert!(pattern_has_forced(&graph, at, by), "{text}");
        bytes[Identity::BYTES + byte] ^= 0x80;
    }
    let length = bytes.len() - Identity::BYTES;
    bytes.pop();
    let text = JumpTable::from_bytes(&graph, &bytes).unwrap_err().to_string();
    let expected = format!("{} bytes, where that of this graph has {length}", length - 1);
    assert!(text.contains(&expected), "{text}");
}

/// Whether a path that arrives by a move of N(8) has forced successors, by the definition.
fn pattern_has_forced(graph: &GridGraph<Centers>, at: Vertex, by: Vector) -> bool {
    let index = graph.steps().iter().position(|step| step.vector() == by).unwrap();
    let pattern = pattern_at::<Centers>(graph.grid(), at);
    forced_of::<Centers>(graph.rule(), graph.k(), pattern) >> index & 1 == 1
}
