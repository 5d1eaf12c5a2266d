//! Which moves canonical A* takes, seen from within.

use std::{collections::BTreeSet, sync::Arc};

use mediant_grid::{
    AsciiMap, Centers, Change, CornerRule, Corners, DiagonalGap, Grid, GridGraph, Interrupt, Placement,
    Vertex, VertexId,
};
use mediant_moves::FiniteK;
use mediant_oracle::{
    Rng, caves, noise, on_all_cores, random_change, random_vertex, rooms, seeds, suite_grid,
};

use super::{
    order::natural,
    planner::{Canonical, CanonicalMoves},
    pruning::Pruning,
    rule::ForcedLookup,
};
use crate::{
    Counters, Ends, Hk, Planner,
    parts::{JumpPointSearch, StepwiseFinder},
    successors::{ExpandedNode, KnownPath, Successors},
};

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

/// A grid graph with a pruning rule that followed there.
struct Version<P: Placement> {
    graph: Arc<GridGraph<P>>,
    pruning: Arc<Pruning<P>>,
}

impl<P: Placement> Version<P> {
    /// Checks that all it knows is true, and returns for how many arrivals something is known.
    fn check_facts(&self, said: &str) -> usize {
        let (ForcedLookup::Trees(trees), Some(cache)) =
            (&self.pruning.rule.lookup, &self.pruning.forced_cache)
        else {
            return 0;
        };
        let mut known = 0;
        for id in (0..self.graph.vertex_count() as u32).map(VertexId) {
            for by in 0..self.graph.steps().len() {
                if let Some(forced) = cache.get(id, by) {
                    let at = self.graph.vertex(id);
                    let is_forced = !trees.for_each_forced(by, self.graph.grid(), at, |_| false);
                    assert_eq!(forced, is_forced, "{said}: {at} by move {by}");
                    known += 1;
                }
            }
        }
        known
    }

    /// Searches by this rule and by a new one find the same in the same way.
    fn check_searches(&self, rng: &mut Rng, said: &str) {
        let (graph, rule) = (&self.graph, Arc::clone(&self.pruning.rule));
        let new = Arc::new(Pruning::with_rule(graph, rule).unwrap());
        for _ in 0..4 {
            let [start, goal] = [(); 2].map(|()| random_vertex(rng, graph.grid(), P::KIND));
            let search = |pruning: &Arc<Pruning<P>>| {
                let (mut counters, pruning) = ([Counters::default(); 2], || Arc::clone(pruning));
                let (query, graph) = (Ends::new(start, goal), || &**graph);
                let mut canonical = Canonical::with_pruning(graph(), pruning(), Hk).unwrap();
                let mut jps = JumpPointSearch::with_finder(graph(), pruning(), StepwiseFinder, Hk).unwrap();
                let answers = (
                    canonical.solve_observed(query, &mut counters[0]),
                    jps.solve_observed(query, &mut counters[1]),
                );
                (answers, counters)
            };
            assert_eq!(search(&self.pruning), search(&new), "{said}: {start} to {goal}");
        }
    }
}

/// Returns how many facts were kept.
fn check_chain<P: Placement>(k: FiniteK, rule: P::Rule, map: Grid, seed: u64) -> usize {
    let rng = &mut Rng::new(seed);
    let version = |grid: &Arc<Grid>| GridGraph::<P>::new(Arc::clone(grid), k, rule).unwrap();
    let graph = Arc::new(version(&Arc::new(map)));
    let pruning = Arc::new(Pruning::new(&graph));
    let mut last = Version { graph, pruning };
    let mut kept = 0;
    for step in 0..5 {
        let change = random_change(rng, last.graph.grid());
        let said = format!("k = {k}, {}, seed {seed}, edit {step}", last.graph.rules());
        last.check_searches(rng, &said);
        let graph = Arc::new(version(change.after()));
        let pruning = last.pruning.repaired(&graph, &change, &Interrupt::NEVER).unwrap().unwrap();
        let next = Version { graph, pruning: Arc::new(pruning) };
        kept += next.check_facts(&said);
        // The two share blocks, and both are filled further.
        last.check_searches(rng, &said);
        next.check_searches(rng, &said);
        last.check_facts(&said);
        next.check_facts(&said);
        last = next;
    }
    kept
}

/// Rules follow chains of edits, while the versions before are searched.
#[test]
fn rules_follow_edits() {
    for k in [4, 5, 7, 9].map(|k| FiniteK::new(k).unwrap()) {
        let few = if k.get() < 7 { 4 } else { 1 };
        on_all_cores(seeds(few), |seed| {
            let rng = &mut Rng::new(seed);
            let map = match (seed + u64::from(k.get())) % 4 {
                0 => suite_grid(seed).0,
                1 => rooms(rng, 50, 41),
                2 => caves(rng, 45, 44),
                _ => noise(rng, 40, 30, 10),
            };
            let corner = [CornerRule::Never, CornerRule::One, CornerRule::Always][seed as usize % 3];
            let gap = [DiagonalGap::Closed, DiagonalGap::Open][seed as usize % 2];
            let kept = check_chain::<Centers>(k, corner, map.clone(), seed)
                + check_chain::<Corners>(k, gap, map, seed);
            assert!(kept > 0 || k.get() > 8 || (seed + u64::from(k.get())) % 4 == 0, "k = {k}, seed {seed}");
        });
    }
}

#[test]
fn changes_of_other_maps_are_refused() {
    let map = Arc::new(noise(&mut Rng::new(1), 20, 10, 20));
    let change = Change::new(Arc::clone(&map)).edit_cells([(3, 3, map.is_free(3, 3))]);
    let graph = |map: &Arc<Grid>, k: u32| {
        GridGraph::<Centers>::new(Arc::clone(map), FiniteK::new(k).unwrap(), CornerRule::Never).unwrap()
    };
    let [before, after] = [change.before(), change.after()].map(|map| graph(map, 4));
    let (old, never) = (Pruning::new(&before), &Interrupt::NEVER);
    let back = Change::between(Arc::clone(change.after()), Arc::clone(&map)).unwrap();
    assert!(old.repaired(&after, &back, never).unwrap().is_err());
    assert!(old.repaired(&before, &change, never).unwrap().is_err());
    assert!(old.repaired(&graph(change.after(), 5), &change, never).unwrap().is_err());
    let repaired = old.repaired(&after, &change, never).unwrap().unwrap();
    assert_eq!(repaired.identity(), after.identity());
}
