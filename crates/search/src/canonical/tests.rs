//! Which moves canonical A* takes, seen from within.

use std::{collections::BTreeSet, sync::Arc};

use mediant_grid::{AsciiMap, Centers, CornerRule, GridGraph, Vertex};
use mediant_moves::FiniteK;

use super::{order::natural, planner::CanonicalMoves, pruning::Pruning};
use crate::successors::{ExpandedNode, KnownPath, Successors};

/// Up to k = 6 those that the rule leaves, everywhere; from k = 7 on all legal ones at vertices with a forced
/// successor.
#[test]
fn where_there_is_a_turn_all_legal_moves_are_taken_from_k_7_on() {
    let row = |y| (0..40).map(|x| if (x, y) == (20, 20) { '#' } else { '.' }).collect::<String>();
    let drawing: Vec<String> = (0..40).map(row).collect();
    let grid = Arc::new(AsciiMap::parse(&drawing.join("\n")).unwrap().grid);
    for k in [4, 6, 7] {
        check(&GridGraph::new(Arc::clone(&grid), FiniteK::new(k).unwrap(), CornerRule::Never).unwrap());
    }
}

fn check(graph: &GridGraph<Centers>) {
    let pruning = Arc::new(Pruning::new(graph));
    let moves = CanonicalMoves { pruning: Arc::clone(&pruning) };
    let count = graph.steps().len();
    let (mut with_forced, mut fewer) = (0, 0);
    for at in (14..27).flat_map(|y| (14..27).map(move |x| Vertex::new(x, y))) {
        let Some(id) = graph.id(at).filter(|_| graph.is_free(at)) else { continue };
        for by in 0..count {
            let node = ExpandedNode { id, at, by: Some(by) };
            let mut taken = BTreeSet::new();
            moves.for_each(graph, node, Vertex::new(0, 0), |next| {
                assert!(taken.insert(next.by));
                KnownPath::NONE
            });
            let (mut legal, mut left) = (BTreeSet::new(), BTreeSet::new());
            graph.for_each_legal_move(at, |index| _ = legal.insert(index));
            pruning.for_each(graph, &node, by, |index| _ = left.insert(index));
            let case = format!("k = {}, at {at} by move {by}", graph.k());
            let forced = left.iter().any(|&index| natural(by, count).all(|other| other != index));
            let all = forced && graph.k().get() >= 7;
            assert_eq!(taken, if all { legal.clone() } else { left.clone() }, "{case}");
            with_forced += u32::from(forced);
            fewer += u32::from(left.len() < legal.len());
        }
    }
    assert!(with_forced > 0 && fewer > with_forced, "k = {}: {with_forced}, {fewer}", graph.k());
}
