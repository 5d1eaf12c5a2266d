//! Landmarks: against Dijkstra's algorithm on the explicit graph, after edits, and as bytes.

use std::sync::Arc;

use mediant_costs::{CostAStar, CostGraph, CostSurface, Landmarks, LandmarksError};
use mediant_grid::{CornerRule, DiagonalGap, Interrupt, Rules, Vertex};
use mediant_moves::{Cost, FiniteK};
use mediant_oracle::{Rng, WeightedGraph, random_free_vertex, random_weighted, seeds};
use mediant_search::{Counters, Ends, Planner};

use crate::common::{for_random_maps, graph, rounded, surface, vertices};

fn landmarks(graph: &Arc<CostGraph>, count: usize) -> Arc<Landmarks> {
    Arc::new(Landmarks::new(graph, count, &Interrupt::NEVER).expect("a number of landmarks"))
}

/// That no bound is too great: reading the bytes compares the bounds at both ends of each move.
fn assert_consistent(graph: &CostGraph, landmarks: &Landmarks, about: &str) {
    let bytes = landmarks.to_bytes(graph).expect("landmarks of this graph");
    let read = Landmarks::from_bytes(graph, &bytes, &Interrupt::NEVER);
    assert_eq!(read.as_ref(), Ok(landmarks), "{about}");
}

#[test]
fn paths_by_landmarks_are_the_cheapest_and_take_no_more_expansions() {
    let (mut found, mut fewer) = (0, 0);
    for_random_maps(100, |map, surface, rules, k, about| {
        let graph = graph(surface, rules, k);
        let oracle = WeightedGraph::new(map, rules, FiniteK::new(k).ok());
        let mut rng = Rng::new(u64::from(k));
        let landmarks = landmarks(&graph, 1 + rng.below(16) as usize);
        assert_consistent(&graph, &landmarks, about);
        let Some(start) = random_free_vertex(&mut rng, map.grid(), rules.placement()) else { return };
        let expected = oracle.costs(&[start], rounded(&graph));
        let guided = CostAStar::with_landmarks(Arc::clone(&graph), Arc::clone(&landmarks));
        let mut guided = guided.expect("landmarks of this graph");
        let mut plain = CostAStar::new(Arc::clone(&graph));
        for (goal, expected) in vertices(&graph).zip(expected).filter(|_| rng.chance(12)) {
            if !graph.is_free(goal) {
                continue;
            }
            let [mut with, mut without] = [Counters::default(), Counters::default()];
            let ends = Ends::new(start, goal);
            let answer = guided.solve_observed(ends, &mut with).expect("the ends are free");
            plain.solve_observed(ends, &mut without).expect("the ends are free");
            let cost = answer.path().map(|path| graph.path_cost(path).map(Cost::to_bits));
            assert_eq!(cost, expected.map(Some), "{start} → {goal}: {about}");
            let bound = landmarks.least_cost(&graph, start, goal).expect("landmarks of this graph");
            assert!(expected.is_none_or(|cost| bound.to_bits() <= cost), "{start} → {goal}: {about}");
            // Of nodes with equal f either planner may expand some that the other one does not.
            if with.expanded > without.expanded {
                assert!(with.expanded - without.expanded < 30, "{start} → {goal}: {about}");
            }
            found += usize::from(cost.is_some());
            fewer += usize::from(with.expanded < without.expanded);
        }
    });
    assert!(found > 2_500 && fewer > found / 4, "{found}, {fewer}");
}

/// Another surface of the same units, and the cells that differ.
fn edited(current: &CostSurface, rng: &mut Rng, most: u32) -> (CostSurface, Vec<(u32, u32)>) {
    let (least, greatest) = current.bounds();
    let cells: Vec<(u32, u32, Option<f64>)> = (0..1 + rng.below(most))
        .map(|_| {
            let cost = [None, Some(least), Some(greatest), Some(least)][rng.below(4) as usize];
            (rng.below(current.width()), rng.below(current.height()), cost)
        })
        .collect();
    let next = current.edit(cells.iter().copied()).expect("within the bounds");
    (next, cells.into_iter().map(|(x, y, _)| (x, y)).collect())
}

#[test]
fn after_edits_paths_are_the_cheapest() {
    let mut found = 0;
    for seed in seeds(60) {
        let (map, about) = random_weighted(seed);
        for (rules, number) in Rules::ALL.into_iter().zip(0..) {
            let k = 2 + ((seed + number) % 7) as u32;
            let mut rng = Rng::new(seed ^ number << 32);
            let mut current = surface(&map, &about);
            let mut before = graph(&current, rules, k);
            let mut index = landmarks(&before, 4);
            let mut planner = CostAStar::with_landmarks(Arc::clone(&before), Arc::clone(&index));
            let planner = planner.as_mut().expect("landmarks of this graph");
            for edit in 0..5 {
                let (next, cells) = edited(&current, &mut rng, 1 + 5 * (edit % 2));
                current = Arc::new(next);
                let after = graph(&current, rules, k);
                let about = format!("seed {seed}, edit {edit}: {rules}, k = {k}, {about}");
                let repaired = index.repaired(&before, &after, &cells, &Interrupt::NEVER);
                index = Arc::new(repaired.expect("the change of this graph"));
                assert_consistent(&after, &index, &about);
                planner.follow_with(Arc::clone(&after), Arc::clone(&index)).expect("its landmarks");
                let mut plain = CostAStar::new(Arc::clone(&after));
                let free: Vec<Vertex> = vertices(&after).filter(|&at| after.is_free(at)).collect();
                if free.is_empty() {
                    break;
                }
                for _ in 0..3 {
                    let [start, goal] = [(); 2].map(|()| free[rng.below(free.len() as u32) as usize]);
                    let [cost, expected] = [&mut *planner, &mut plain].map(|planner| {
                        let answer = planner.solve(Ends::new(start, goal)).expect("both are free");
                        answer.path().map(|path| after.path_cost(path).expect("legal moves"))
                    });
                    assert_eq!(cost, expected, "{start} → {goal}: {about}");
                    found += usize::from(cost.is_some());
                }
                before = after;
            }
        }
    }
    assert!(found > 1_500, "only {found}");
}

/// Land of cost 1 to 9, with walls.
fn land(width: u32, height: u32) -> Arc<CostSurface> {
    let mut rng = Rng::new(3);
    let cells: Vec<u32> =
        (0..width * height).map(|_| if rng.chance(10) { 0 } else { 1 + rng.below(9) }).collect();
    let cost = |x: u32, y: u32| Some(f64::from(cells[(y * width + x) as usize])).filter(|&cost| cost > 0.0);
    Arc::new(CostSurface::from_fn(width, height, cost).expect("a surface"))
}

#[test]
fn a_change_that_is_not_told_is_refused() {
    let rules = Rules::Center(CornerRule::Never);
    let map = land(40, 30);
    let before = graph(&map, rules, 3);
    let index = landmarks(&before, 4);
    let after = map.edit([(3, 4, Some(1.0)), (20, 20, None)]).expect("within the bounds");
    let after = graph(&Arc::new(after), rules, 3);
    let repaired = |before: &CostGraph, after: &Arc<CostGraph>, cells: &[(u32, u32)]| {
        index.repaired(before, after, cells, &Interrupt::NEVER)
    };
    assert!(repaired(&before, &after, &[(3, 4), (20, 20), (0, 0), (3, 4), (99, 99)]).is_ok());
    let refused = |found| matches!(found, Err(LandmarksError::Mismatch(_)));
    assert!(refused(repaired(&before, &after, &[(3, 4)])));
    assert!(refused(repaired(&after, &before, &[(3, 4), (20, 20)])));
    assert!(refused(repaired(&before, &graph(&map, rules, 4), &[])));
    assert!(CostAStar::with_landmarks(Arc::clone(&after), Arc::clone(&index)).is_err());
    // Other units: made anew.
    let tenths = Arc::new(map.edit([(5, 5, Some(0.5))]).expect("a surface anew"));
    let after = graph(&tenths, rules, 3);
    assert_eq!(repaired(&before, &after, &[(5, 5)]).as_ref(), Ok(&*landmarks(&after, 4)));
}

#[test]
fn a_planner_forgets_landmarks_of_another_graph() {
    let rules = Rules::Center(CornerRule::One);
    let map = land(50, 50);
    let before = graph(&map, rules, 4);
    let mut planner =
        CostAStar::with_landmarks(Arc::clone(&before), landmarks(&before, 8)).expect("its landmarks");
    let cheap = (0..50).map(|x| (x, 25, Some(1.0)));
    let after = graph(&Arc::new(map.edit(cheap).expect("within the bounds")), rules, 4);
    planner.follow(Arc::clone(&after));
    let ends = Ends::new((0, 25), (49, 25));
    let answer = planner.solve(ends).expect("both are free");
    assert_eq!(
        answer.path().and_then(|path| after.path_cost(path)).map(|cost| after.to_f64(cost)),
        Some(49.0)
    );
}

#[test]
fn damaged_bytes_are_refused_or_harmless() {
    let closed = Rules::Corner(DiagonalGap::Closed);
    for (rules, k, count) in [(Rules::Center(CornerRule::Never), 4, 8), (closed, 3, 4)] {
        let graph = graph(&land(30, 20), rules, k);
        let whole = landmarks(&graph, count).to_bytes(&graph).expect("landmarks of this graph");
        let read = |bytes: &[u8]| Landmarks::from_bytes(&graph, bytes, &Interrupt::NEVER);
        for length in (0..60).chain([whole.len() - 4, whole.len() - 1]) {
            assert!(read(&whole[..length]).is_err(), "{length} bytes");
        }
        assert!(read(&[&whole[..], &[0; 4]].concat()).is_err());
        let mut refused = 0;
        let mut rng = Rng::new(7);
        for _ in 0..200 {
            let mut bytes = whole.clone();
            let at = if rng.chance(30) { rng.below(40) } else { rng.below(bytes.len() as u32) } as usize;
            bytes[at] ^= 1 << rng.below(8);
            match read(&bytes) {
                Err(_) => refused += 1,
                Ok(landmarks) => assert_consistent(&graph, &landmarks, &format!("byte {at}")),
            }
        }
        assert!(refused > 100, "only {refused}");
    }
}

#[test]
fn numbers_of_landmarks_are_checked_and_maps_without_free_cells_have_none() {
    let map = Arc::new(CostSurface::from_fn(3, 3, |_, _| None).expect("no cell is free"));
    let graph = graph(&map, Rules::Center(CornerRule::Always), 3);
    for count in [0, 17, usize::MAX] {
        let refused = Landmarks::new(&graph, count, &Interrupt::NEVER);
        assert_eq!(refused, Err(LandmarksError::Count { count }));
    }
    let index = landmarks(&graph, 5);
    assert_eq!((index.count(), index.memory_bytes()), (8, Landmarks::bytes(&graph, 5)));
    assert_consistent(&graph, &index, "no cell is free");
}

/// A list of cells becomes cheaper, first one of them, then two, and so on. Counts the changes that landmarks
/// follow. After all others they are made anew, and paths cost the same: only these counts show when a repair
/// is given up.
#[test]
fn the_number_of_repairs_is_pinned() {
    let map = land(80, 60);
    let mut rng = Rng::new(5);
    let cells: Vec<(u32, u32)> = (0..30).map(|_| (rng.below(80), rng.below(60))).collect();
    let found = [Rules::Center(CornerRule::One), Rules::Corner(DiagonalGap::Closed)].map(|rules| {
        [2, 5].map(|k| {
            let before = graph(&map, rules, k);
            let index = landmarks(&before, 3);
            let is_repaired = |&count: &usize| {
                let cells = &cells[..count];
                let after =
                    map.edit(cells.iter().map(|&(x, y)| (x, y, Some(1.0)))).expect("within the bounds");
                let after = graph(&Arc::new(after), rules, k);
                let found = index.repaired_if_quicker(&before, &after, cells, &Interrupt::NEVER);
                found.expect("the change of this graph").is_some()
            };
            (1..=cells.len()).filter(is_repaired).count()
        })
    });
    assert_eq!(found, [[12, 7], [8, 5]]);
}
