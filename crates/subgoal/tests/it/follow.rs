//! Planners that follow to another map know nothing of the one before, and answer as new ones.

use std::sync::Arc;

use mediant_grid::{Centers, CornerRule, Corners, DiagonalGap, FreeSpace, Vertex};
use mediant_moves::{Cost, K};
use mediant_oracle::{Rng, random_vertex, seeds, suite_grid};
use mediant_search::{Counters, Ends, Observer, Planner, SearchStatus};
use mediant_subgoal::{
    Hierarchy, HubLabelSearch, HubLabels, SubgoalAStar, SubgoalGraph, SubgoalPlacement, SubgoalTheta,
};

use super::common::{graph, k, labels, levels, space};

/// Pauses a search after some expansions.
struct Pause(u32);

impl Observer for Pause {
    fn pauses(&mut self, _: Cost) -> bool {
        self.0 = self.0.saturating_sub(1);
        self.0 == 0
    }
}

/// A space with its graphs and labels.
struct Prepared<P: SubgoalPlacement> {
    space: Arc<FreeSpace<P>>,
    contracted: Arc<SubgoalGraph<P>>,
    leveled: Arc<SubgoalGraph<P>>,
    labels: Arc<HubLabels<P>>,
}

/// Follows to each map in turn, from a search that is paused. Returns the number of paths compared.
fn check<P: SubgoalPlacement, S: Planner>(
    maps: &[Prepared<P>],
    rng: &mut Rng,
    new: impl Fn(&Prepared<P>) -> S,
    follow: impl Fn(&mut S, &Prepared<P>),
    said: &str,
) -> usize {
    let query = |rng: &mut Rng, map: &Prepared<P>| {
        let [start, goal] = [(); 2].map(|()| random_vertex(rng, map.space.grid(), P::KIND));
        Ends::new(start, goal)
    };
    let (mut planner, mut found) = (new(&maps[0]), 0);
    for (map, next) in maps.iter().zip(&maps[1..]) {
        _ = planner.solve(query(rng, map));
        if planner.begin(query(rng, map), &mut ()).is_ok() {
            _ = planner.proceed(&mut Pause(1 + rng.below(9)));
        }
        follow(&mut planner, next);
        let mut fresh = new(next);
        assert_eq!(planner.identity(), fresh.identity());
        for at in (0..30).flat_map(|y| (0..30).map(move |x| Vertex::new(x, y))) {
            assert!(planner.path_to(at).is_none(), "{at}, {said}");
        }
        assert_eq!(planner.proceed(&mut ()), Ok(SearchStatus::Unreachable), "{said}");
        for _ in 0..5 {
            let (query, mut counters) = (query(rng, next), [Counters::default(); 2]);
            let answer = planner.solve_observed(query, &mut counters[0]);
            let expected = fresh.solve_observed(query, &mut counters[1]);
            found += usize::from(answer.as_ref().is_ok_and(|answer| answer.path().is_some()));
            assert_eq!((answer, counters[0]), (expected, counters[1]), "{query:?}, {said}");
            assert_eq!(planner.distance(query), fresh.distance(query), "{query:?}, {said}");
        }
    }
    found
}

fn check_all<P: SubgoalPlacement>(k: K, rule: P::Rule, seed: u64) -> usize {
    let rng = &mut Rng::new(seed);
    let maps = [seed, seed + 1, seed, seed + 2].map(|seed| {
        let space = Arc::new(space::<P>(&suite_grid(seed).0, rule));
        Prepared {
            contracted: Arc::new(graph(&space, k, Hierarchy::Contracted)),
            leveled: Arc::new(graph(&space, k, levels(2))),
            labels: Arc::new(labels(&space, k)),
            space,
        }
    });
    let said = format!("k = {k}, {}, seed {seed}", maps[0].space.rules());
    let mut found = 0;
    macro_rules! check {
        ($planner:ident, $index:ident) => {
            let new = |map: &Prepared<P>| {
                $planner::new(Arc::clone(&map.space), Arc::clone(&map.$index)).expect("it fits")
            };
            let follow = |planner: &mut _, map: &Prepared<P>| -> () {
                $planner::follow(planner, Arc::clone(&map.space), Arc::clone(&map.$index)).expect("it fits");
            };
            found += check(&maps, rng, new, follow, &said);
            let [one, other, ..] = &maps;
            if one.space.identity() != other.space.identity() {
                let refused = new(one).follow(Arc::clone(&one.space), Arc::clone(&other.$index));
                assert!(refused.is_err(), "{said}");
            }
        };
    }
    check!(SubgoalAStar, contracted);
    check!(SubgoalAStar, leveled);
    check!(SubgoalTheta, leveled);
    check!(HubLabelSearch, labels);
    found
}

#[test]
fn a_planner_that_followed_knows_nothing_of_the_map_before() {
    let mut found = 0;
    for seed in seeds(20) {
        let gap = [DiagonalGap::Open, DiagonalGap::Closed][seed as usize % 2];
        found += check_all::<Corners>([k(3), K::Any][seed as usize / 2 % 2], gap, seed);
        found += check_all::<Centers>(k(2 + seed as u32 % 2), CornerRule::Never, seed);
    }
    assert!(found > 40 * seeds(20).end as usize, "only {found} paths");
}
