//! Labels and graphs of an earlier map: each answer costs as much as one of a new graph, and most come from
//! the earlier map.

use std::sync::Arc;

use mediant_grid::{Centers, Change, CornerRule, Corners, FreeSpace};
use mediant_moves::K;
use mediant_oracle::{Rng, on_all_cores, random_change, random_vertex, seeds, suite_grid};
use mediant_search::{Ends, Planner};
use mediant_subgoal::{EarlierMap, EarlierSearch, Hierarchy, SubgoalAStar, SubgoalGraph, SubgoalPlacement};

use super::common::{GAPS, all_ks, graph, k, labels, space};

/// The planner on a graph of the present map.
type Present<P> = SubgoalAStar<Arc<FreeSpace<P>>, Arc<SubgoalGraph<P>>, P>;

fn present<P: SubgoalPlacement>(now: &Arc<FreeSpace<P>>, k: K) -> Present<P> {
    let graph = Arc::new(graph(now, k, Hierarchy::Contracted));
    SubgoalAStar::new(Arc::clone(now), graph).expect("it is the graph of this map")
}

/// The answers that came from the earlier map, and all.
type Tally = [usize; 2];

/// A chain of edits after which labels are never made anew.
fn check<P: SubgoalPlacement>(seed: u64, k: K, rule: P::Rule, by_labels: bool) -> Tally {
    const EDITS: usize = 6;
    const QUERIES: usize = 12;
    let mut rng = Rng::new(seed ^ 0xEA12_1E12);
    let (grid, kind) = suite_grid(seed);
    let then = Arc::new(space::<P>(&grid, rule));
    let (mut now, mut map) = (Arc::clone(&then), None::<Arc<EarlierMap<P>>>);
    let mut planner: Option<EarlierSearch<P, Present<P>>> = None;
    let mut tally = [0; 2];
    for edit in 0..EDITS {
        let change = one_or_more(&mut rng, &now);
        let next = Arc::new(now.after(&change));
        let said =
            format!("seed {seed}, {kind}, k = {k}, {}, edit {edit}, {:?}", then.rules(), change.cells());
        let earlier = match &map {
            Some(map) => map.after(&next, &change),
            None if by_labels => EarlierMap::of_labels(&then, &Arc::new(labels(&then, k)), &next, &change),
            None => {
                let graph = Arc::new(graph(&then, k, Hierarchy::Contracted));
                EarlierMap::of_graph(&then, &graph, &next, &change)
            }
        };
        let earlier = Arc::new(earlier.expect("few cells have changed"));
        now = next;
        let mut fresh = present(&now, k);
        planner = Some(match planner {
            None => EarlierSearch::new(Arc::clone(&earlier), present(&now, k)).expect("they fit"),
            Some(mut planner) => {
                let other = present(&now, k);
                let follow = |known: &mut Present<P>| {
                    *known = other;
                    Ok::<(), mediant_grid::Mismatch>(())
                };
                planner.follow(Arc::clone(&earlier), follow).expect("they fit");
                planner
            }
        });
        let planner = planner.as_mut().expect("it was just made");
        for _ in 0..QUERIES {
            let [start, goal] = [(); 2].map(|()| random_vertex(&mut rng, now.grid(), P::KIND));
            let query = Ends::new(start, goal);
            let expected = fresh.distance(query);
            let answer = planner.solve(query);
            tally[0] += usize::from(planner.is_from_earlier());
            tally[1] += usize::from(matches!(expected, Ok(Some(_))));
            let found = answer.map(|answer| answer.path().cloned());
            assert_eq!(
                found.as_ref().map(Option::is_some),
                expected.as_ref().map(Option::is_some),
                "{query}, {said}"
            );
            if let (Ok(Some(path)), Ok(Some(cost))) = (found, &expected) {
                assert_eq!(path.check(&now), Ok(()), "{query}, {said}");
                let length = planner.guarantee().length(&path);
                assert!(
                    (length - cost).abs() <= cost * 1e-9,
                    "{query}: {length}, not {cost}, {path}, {said}"
                );
                let distance = planner.distance(query);
                let is_same = distance.as_ref().is_ok_and(|distance| match distance {
                    Some(distance) if k == K::Any => (distance - cost).abs() <= cost * 1e-9,
                    distance => *distance == Some(*cost),
                });
                assert!(is_same, "{query}: {distance:?}, not {cost}, {said}");
            }
        }
        map = Some(earlier);
    }
    tally
}

/// Mostly a cell or two; seldom any edit.
fn one_or_more<P: SubgoalPlacement>(rng: &mut Rng, now: &FreeSpace<P>) -> Change {
    let grid = now.grid();
    if rng.below(4) == 0 {
        return random_change(rng, grid);
    }
    let count = 1 + rng.below(2);
    let cells: Vec<_> = (0..count)
        .map(|_| {
            let (x, y) = (rng.below(grid.width()), rng.below(grid.height()));
            (x, y, !grid.is_blocked(x as i32, y as i32))
        })
        .collect();
    Change::new(Arc::clone(grid)).edit_cells(cells)
}

fn check_all(seed: u64) -> Tally {
    let mut sum = [0; 2];
    let mut add = |tally: Tally| sum.iter_mut().zip(tally).for_each(|(sum, count)| *sum += count);
    for by_labels in [true, false] {
        for gap in GAPS {
            all_ks().for_each(|k| add(check::<Corners>(seed, k, gap, by_labels)));
        }
        for rule in [CornerRule::Never, CornerRule::One, CornerRule::Always] {
            add(check::<Centers>(seed, k(2), rule, by_labels));
        }
        add(check::<Centers>(seed, k(3), CornerRule::Never, by_labels));
    }
    sum
}

#[test]
fn answers_cost_as_much_as_those_of_a_new_graph() {
    let tallies = on_all_cores(seeds(25), check_all);
    let [from_earlier, all] = tallies.into_iter().fold([0; 2], |[a, b], [c, d]| [a + c, b + d]);
    assert!(from_earlier > all / 3, "{from_earlier} of {all} answers from the earlier map");
}
