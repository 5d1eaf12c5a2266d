//! Labels of vertices: the same distances as without, within every budget of memory.

use mediant_grid::{
    Centers, CornerRule, Corners, DiagonalGap, FreeSpace, Grid, Interrupt, Interrupted, Vertex,
};
use mediant_moves::{Cost, K};
use mediant_oracle::{Rng, noise, on_all_cores, rooms, seeds};
use mediant_search::{Answer, Ends, Planner};
use mediant_subgoal::{HubLabelSearch, HubLabels, Stage, SubgoalError, SubgoalPlacement};

use super::exact::is_equal;
use crate::common::{GAPS, k, labels, space, with_vertices};

fn within<P: SubgoalPlacement>(labels: &HubLabels<P>, space: &FreeSpace<P>, most: usize) -> HubLabels<P> {
    let made = labels.clone().with_vertices(space, most, &|_| {}, &Interrupt::NEVER);
    made.expect("they are of this space")
}

/// Distances and paths of one pair of ends after another, by labels within several budgets.
fn check<P: SubgoalPlacement>(grid: &Grid, rule: P::Rule, k: K, seed: u64) -> usize {
    let (space, mut rng) = (space::<P>(grid, rule), Rng::new(seed));
    let without = labels(&space, k);
    let all = within(&without, &space, usize::MAX);
    let span = all.memory_bytes() - without.memory_bytes();
    let budgets = [0, 1, 2, 4, 7].map(|eighths| without.memory_bytes() + span * eighths / 8);
    let with: Vec<_> = budgets.iter().map(|&most| within(&without, &space, most)).collect();
    for (labels, most) in with.iter().zip(budgets) {
        assert!(labels.memory_bytes() <= most, "{} of {most} bytes; seed {seed}", labels.memory_bytes());
    }
    assert!(with.is_sorted_by_key(HubLabels::labels_of_vertices), "seed {seed}");
    let mut planners: Vec<_> = with
        .iter()
        .chain([&all])
        .map(|labels| HubLabelSearch::new(&space, labels).expect("its space"))
        .collect();
    let (width, height) = P::vertices(grid);
    let mut found = 0;
    for _ in 0..300 {
        let mut free = || loop {
            let at = Vertex::new(rng.below(width) as i32, rng.below(height) as i32);
            if space.is_free(at) {
                break at;
            }
        };
        let ends = Ends::new(free(), free());
        let costs: Vec<Option<Cost>> =
            planners.iter_mut().map(|planner| planner.cost(ends).expect("free ends")).collect();
        for (planner, &cost) in planners.iter_mut().zip(&costs) {
            let is_same = costs[0].zip(cost).map_or(costs[0] == cost, |(a, b)| is_equal(k, a, b));
            assert!(is_same, "{ends:?}, k = {k}, {}, seed {seed}: {costs:?}", space.rules());
            let Ok(Answer::Found(path)) = planner.solve(ends) else { continue };
            let length = cost.map_or(f64::NAN, Cost::to_f64);
            let is_same = (path.cost() - length).abs() <= 1e-8 * length.max(1.0);
            assert!(is_same, "{ends:?}, k = {k}, seed {seed}: {length}, {path}");
            found += 1;
        }
    }
    found
}

#[test]
fn every_budget_gives_the_same_distances() {
    let ks = [k(2), k(3), k(5), K::Any];
    let of = |seed: u64| {
        let mut rng = Rng::new(seed);
        let grid = if seed.is_multiple_of(3) { noise(&mut rng, 30, 40, 20) } else { rooms(&mut rng, 40, 30) };
        check::<Corners>(&grid, GAPS[seed as usize % 2], ks[seed as usize / 2 % 4], seed)
            + check::<Centers>(&grid, CornerRule::Never, k(2 + seed as u32 % 2), seed)
    };
    let found: usize = on_all_cores(seeds(16), of).into_iter().sum();
    assert!(found > 2000 * seeds(16).end as usize, "{found} paths");
}

#[test]
fn labels_of_vertices_can_be_made_anew_and_stopped() {
    let grid = rooms(&mut Rng::new(5), 60, 60);
    let space = space::<Corners>(&grid, DiagonalGap::Open);
    let without = labels(&space, K::Any);
    let all = with_vertices(&without, &space, false);
    assert!(all.labels_of_vertices() > 3 * without.labels() && without.labels() > 3 * without.subgoals());
    // They replace those that there are.
    assert_eq!(within(&all, &space, usize::MAX).to_bytes(), all.to_bytes());
    assert_eq!(within(&all, &space, 0).to_bytes(), without.to_bytes());
    let told = std::sync::Mutex::new(Vec::new());
    let progress = |step| told.lock().expect("nobody panics").push(step);
    without.clone().with_vertices(&space, usize::MAX, &progress, &Interrupt::NEVER).expect("its space");
    let told = told.into_inner().expect("nobody panics");
    let last = told.last().expect("there is a piece");
    assert_eq!((last.stage, last.done), (Stage::Vertices, last.total));
    let stopped =
        without.clone().with_vertices(&space, usize::MAX, &|_| {}, &Interrupt::new().deadline(|| true));
    assert!(matches!(stopped, Err(SubgoalError::Interrupted(Interrupted { .. }))), "{stopped:?}");
    let other = crate::common::space::<Corners>(&grid, DiagonalGap::Closed);
    let error = without.with_vertices(&other, usize::MAX, &|_| {}, &Interrupt::NEVER);
    assert!(matches!(error, Err(SubgoalError::Mismatch(_))), "{error:?}");
}
