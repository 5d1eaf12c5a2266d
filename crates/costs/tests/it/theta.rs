//! Straight segments, Theta* and smoothing, against the oracle's legality and integrals.

use std::sync::Arc;

use mediant_costs::{CostField, CostFieldQuery, CostGraph, CostTheta, Landmarks, smooth};
use mediant_grid::{Interrupt, Rules, Vertex};
use mediant_moves::{Cost, FiniteK, Vector};
use mediant_oracle::{
    Rng, WeightedGraph, WeightedMap, random_free_vertex, segment_is_legal, weighted_path_length,
};
use mediant_search::{Answer, Ends, Path, Planner};

use crate::common::{for_random_maps, graph, rounded, vertices};

/// Asserts that a cost is near an integral of so many roundings.
fn assert_near(graph: &CostGraph, cost: Cost, integral: f64, roundings: u32, about: &str) {
    let told = graph.to_f64(cost);
    let room = 1e-9 * integral + f64::from(roundings + 1) * graph.map().unit();
    assert!((told - integral).abs() <= room, "{told}, where {integral} is exact: {about}");
}

#[test]
fn segments_are_legal_and_cost_as_the_oracle_has_it() {
    let (mut legal, mut not, mut moves) = (0, 0, 0);
    for_random_maps(100, |map, surface, rules, k, about| {
        let graph = graph(surface, rules, k);
        let mut rng = Rng::new(u64::from(k));
        let (width, height) = graph.size();
        for _ in 0..60 {
            let reach = *rng.pick(&[2, 5, 12, 40]).unwrap_or(&2);
            let from = Vertex::new(rng.below(width) as i32, rng.below(height) as i32);
            let near = |at: i32, rng: &mut Rng| at - reach / 2 + rng.below(reach as u32 + 1) as i32;
            let to = Vertex::new(near(from.x, &mut rng), near(from.y, &mut rng));
            let found = graph.line_cost(from, to);
            assert_eq!(
                found.is_some(),
                segment_is_legal(map.grid(), rules, from, to),
                "{from} → {to}: {about}"
            );
            assert_eq!(found, graph.line_cost(to, from), "{from} → {to}: {about}");
            let Some(cost) = found else {
                not += 1;
                continue;
            };
            legal += 1;
            let d = from.to(to);
            let integral = map.integral(rules.placement(), from, to).expect("it is legal");
            let about = format!("{from} → {to}: {about}");
            assert_near(&graph, cost, integral.length(map.cell_size()), d.gcd(), &about);
            let times = d.gcd().max(1) as i32;
            let v = Vector::new(d.x / times, d.y / times);
            if let Some(one) = graph.move_cost(from, v) {
                let moved = graph.path_cost(&Path::new(vec![from, to]));
                assert_eq!(moved, Some(cost), "{about}");
                assert!(times > 1 || cost == one, "{about}");
                moves += 1;
            }
        }
    });
    assert!(legal > 5_000 && not > 5_000 && moves > 2_000, "{legal}, {not}, {moves}");
}

#[test]
fn long_segments_are_those_of_their_parts() {
    let map =
        mediant_costs::CostSurface::from_fn(900, 700, |x, y| Some(f64::from(1 + (x * 7 + y * 13) % 50)));
    let graph = graph(&Arc::new(map.expect("a surface")), Rules::ALL[0], 3);
    for (dx, dy) in [(89, 64), (3, 1), (1, 1), (0, 7), (5, 2), (30, 23)] {
        let whole = graph.line_cost(Vertex::new(0, 0), Vertex::new(10 * dx, 10 * dy)).expect("all are free");
        let part =
            |at| graph.line_cost(Vertex::new(at * dx, at * dy), Vertex::new(at * dx + dx, at * dy + dy));
        let parts: u64 = (0..10).filter_map(part).map(Cost::to_bits).sum();
        assert!(whole.to_bits().abs_diff(parts) <= 10, "({dx}, {dy}): {whole:?}, {parts}");
    }
}

/// Asserts that a path is legal, of straight segments, and that its cost is the integral along it. Returns
/// it.
fn checked(graph: &CostGraph, map: &WeightedMap, rules: Rules, path: &Path, about: &str) -> Cost {
    let length = weighted_path_length(map, rules, None, path.waypoints());
    let length = length.unwrap_or_else(|fault| panic!("{path}: {fault}: {about}"));
    let cost = graph.segments_cost(path).unwrap_or_else(|| panic!("{path}: {about}"));
    let points: u32 = path.waypoints().windows(2).map(|ends| ends[0].to(ends[1]).gcd()).sum();
    assert_near(graph, cost, length, points, about);
    assert_eq!(path.cost(), graph.to_f64(cost), "{path}: {about}");
    let cell_cost = |(x, y): (u32, u32)| map.weight(x as i32, y as i32).map_or(f64::NAN, f64::from);
    let along: f64 = graph.crossings(path).iter().map(|&(cell, length)| cell_cost(cell) * length).sum();
    assert!((along - length).abs() <= 1e-9 * length, "{path}: {along} along its cells, {length}: {about}");
    cost
}

#[test]
fn no_path_is_dearer_than_over_the_neighborhood() {
    let (mut found, mut cheaper) = (0, [0; 3]);
    for_random_maps(60, |map, surface, rules, k, about| {
        let graph = graph(surface, rules, k);
        let oracle = WeightedGraph::new(map, rules, FiniteK::new(k).ok());
        let mut rng = Rng::new(u64::from(k));
        let Some(start) = random_free_vertex(&mut rng, map.grid(), rules.placement()) else { return };
        let expected = oracle.costs(&[start], rounded(&graph));
        let landmarks = Landmarks::new(&graph, 4, &Interrupt::NEVER).map(Arc::new).expect("four landmarks");
        let mut planners = [
            CostTheta::new(Arc::clone(&graph)),
            CostTheta::lazy(Arc::clone(&graph)),
            CostTheta::new(Arc::clone(&graph)).guided_by(landmarks).expect("its landmarks"),
        ];
        for (goal, expected) in vertices(&graph).zip(expected).filter(|_| rng.chance(8)) {
            for (planner, cheaper) in planners.iter_mut().zip(&mut cheaper) {
                let Ok(answer) = planner.solve(Ends::new(start, goal)) else {
                    assert!(!graph.is_free(goal), "{start} → {goal}: {about}");
                    continue;
                };
                let about = format!("{start} → {goal}: {about}");
                assert_eq!(answer.path().is_some(), expected.is_some(), "{about}");
                let Some((path, expected)) = answer.path().zip(expected) else { continue };
                let cost = checked(&graph, map, rules, path, &about).to_bits();
                assert!(cost <= expected, "{path} costs {cost}, over N(k) {expected}: {about}");
                assert_eq!([path.waypoints()[0], path.waypoints()[path.len() - 1]], [start, goal], "{about}");
                found += 1;
                *cheaper += usize::from(cost < expected);
            }
        }
    });
    assert!(found > 2_500 && cheaper.iter().all(|&cheaper| cheaper > found / 30), "{found}, {cheaper:?}");
}

#[test]
fn smoothing_never_raises_the_cost() {
    let (mut found, mut fewer, mut cheaper) = (0, 0, 0);
    for_random_maps(60, |map, surface, rules, k, about| {
        let graph = graph(surface, rules, k);
        let mut rng = Rng::new(u64::from(k));
        let Some(start) = random_free_vertex(&mut rng, map.grid(), rules.placement()) else { return };
        let field = CostField::new(Arc::clone(&graph), CostFieldQuery::new(&[start]), &Interrupt::NEVER);
        let field = field.expect("the source is free");
        let mut theta = CostTheta::lazy(Arc::clone(&graph));
        let mut last: Option<Path> = None;
        for at in vertices(&graph).filter(|_| rng.chance(8)) {
            let Some(path) = field.path_from(at) else { continue };
            let straight = theta.solve(Ends::new(at, start)).expect("both are free");
            // A detour over the source is shortened most. At a closed gap it may be no path.
            let is_closed = rules == Rules::ALL[4];
            let detour = last.replace(path.clone()).filter(|_| !is_closed && path.len() > 1);
            let detour = detour.and_then(|last| path.joined(&last.reversed()).ok());
            for path in [Some(path), straight.into_path(), detour].into_iter().flatten() {
                let about = format!("{path}: {about}");
                let before = checked(&graph, map, rules, &path, &about);
                let (smoothed, cost) = smooth(&graph, &path).unwrap_or_else(|| panic!("{about}"));
                assert_eq!(checked(&graph, map, rules, &smoothed, &about), cost, "{smoothed}: {about}");
                assert!(cost <= before, "{smoothed}: {about}");
                let ends = |path: &Path| [path.waypoints()[0], path.waypoints()[path.len() - 1]];
                assert_eq!(ends(&smoothed), ends(&path), "{about}");
                found += 1;
                fewer += usize::from(smoothed.len() < path.len());
                cheaper += usize::from(cost < before);
            }
        }
    });
    assert!(found > 2_500 && fewer > found / 8 && cheaper > found / 10, "{found}, {fewer}, {cheaper}");
}

#[test]
fn a_path_with_a_segment_that_is_not_legal_is_not_smoothed() {
    let map = mediant_costs::CostSurface::from_fn(5, 3, |x, _| (x != 2).then_some(1.0)).expect("costs of 1");
    let graph = graph(&Arc::new(map), Rules::ALL[0], 3);
    let path = |waypoints: &[(i32, i32)]| Path::new(waypoints.iter().copied().map(Into::into).collect());
    for waypoints in [&[(0, 0), (4, 0)][..], &[(0, 0), (9, 9)], &[(2, 1)], &[(0, 0), (1, 1), (2, 1)]] {
        assert_eq!(smooth(&graph, &path(waypoints)), None, "{waypoints:?}");
    }
    let blocked = path(&[(0, 0), (1, 1), (2, 1)]);
    assert_eq!((graph.segments_cost(&blocked), graph.crossings(&blocked)), (None, Vec::new()));
    let alone = path(&[(1, 1)]);
    assert_eq!(smooth(&graph, &alone), Some((alone.clone(), Cost::ZERO)));
}

#[test]
fn a_planner_follows_an_edit_and_forgets_landmarks_of_another_graph() {
    let cost = |x, y| Some(f64::from(2 + (5 * x + 3 * y) % 7)).filter(|_| (x + 2 * y) % 11 > 0);
    let map = Arc::new(mediant_costs::CostSurface::from_fn(40, 30, cost).expect("a surface"));
    let (rules, k) = (Rules::ALL[1], 3);
    let before = graph(&map, rules, k);
    let landmarks = |graph: &Arc<CostGraph>| {
        Arc::new(Landmarks::new(graph, 4, &Interrupt::NEVER).expect("four landmarks"))
    };
    let (ends, road) = (Ends::new((1, 15), (39, 15)), (0..40).map(|x| (x, 15, Some(2.0))));
    let map = Arc::new(map.edit(road).expect("within the bounds"));
    let after = graph(&map, rules, k);
    for is_lazy in [false, true] {
        let new = |graph: &Arc<CostGraph>| match is_lazy {
            true => CostTheta::lazy(Arc::clone(graph)),
            false => CostTheta::new(Arc::clone(graph)),
        };
        let expected = new(&after).solve(ends).expect("both are free");
        assert_ne!(new(&before).solve(ends).expect("both are free"), expected);
        let mut planner = new(&before).guided_by(landmarks(&before)).expect("its landmarks");
        planner.solve(ends).expect("both are free");
        assert!(planner.follow_with(Arc::clone(&after), landmarks(&before)).is_err());
        planner.follow(Arc::clone(&after));
        assert_eq!(planner.solve(ends).expect("both are free"), expected);
        planner.follow_with(Arc::clone(&after), landmarks(&after)).expect("its landmarks");
        let answer = planner.solve(ends).expect("both are free");
        let cost = |answer: &Answer| answer.path().and_then(|path| after.segments_cost(path));
        assert!(cost(&answer).is_some() && cost(&expected).is_some());
        assert!(planner.solve(Ends::new((0, 0), (39, 29))).is_err(), "(0, 0) is blocked");
        let alone = planner.solve(Ends::new((1, 0), (1, 0))).expect("it is free");
        assert_eq!(alone.path().map(Path::len), Some(1));
    }
}
