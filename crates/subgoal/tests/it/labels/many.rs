//! Distances to many goals at once are those of one query each.

use std::collections::BTreeSet;

use mediant_grid::{AsciiMap, Centers, CornerRule, Corners, DiagonalGap, FreeSpace, Grid, Vertex};
use mediant_moves::{Cost, K};
use mediant_oracle::{Rng, caves, on_all_cores, rooms, seeds};
use mediant_search::{End, Ends, Planner, QueryError};
use mediant_subgoal::{HubLabelSearch, HubLabels, SubgoalPlacement};

use super::exact::is_equal;
use crate::common::{GAPS, k, labels, space};

fn free<P: SubgoalPlacement>(space: &FreeSpace<P>) -> Vec<Vertex> {
    let (width, height) = P::vertices(space.grid());
    let all = (0..height as i32).flat_map(|y| (0..width as i32).map(move |x| Vertex::new(x, y)));
    all.filter(|&at| space.is_free(at)).collect()
}

/// The number of goals that are as near as the nearest, up to rounding.
fn all_near(all: &[Option<Cost>], nearest: Option<(usize, Cost)>) -> usize {
    let Some((_, least)) = nearest else { return 0 };
    all.iter().flatten().filter(|cost| is_equal(K::Any, **cost, least)).count()
}

/// Random goals, some twice, some equal to the start. Returns the numbers of goals without and with a path,
/// and of starts at any angle to which several goals are the nearest.
fn check<P: SubgoalPlacement>(grid: &Grid, k: K, rule: P::Rule, seed: u64) -> [usize; 3] {
    let (space, mut rng, mut counts) = (space::<P>(grid, rule), Rng::new(seed), [0, 0]);
    let (labels, free) = (labels(&space, k), free(&space));
    let mut planner = HubLabelSearch::new(&space, &labels).expect("the labels are for this space");
    let (mut at_once, mut ties) = (vec![None; 99], 0);
    // Of many goals most are not looked at.
    for count in [12, 12, 3, 150] {
        let mut pick = || rng.pick(&free).copied();
        let mut goals: Vec<Vertex> = (0..count).filter_map(|_| pick()).collect();
        goals.extend(goals.clone().iter().step_by(3));
        let prepared = labels.goals(&space, goals.iter().copied()).expect("the goals are free");
        assert_eq!(prepared.vertices(), goals);
        let starts = [pick(), pick(), goals.get(2).copied()];
        for start in starts.into_iter().flatten() {
            let case = |goal| format!("from {start} to {goal}, k = {k}, {}, seed {seed}", space.rules());
            planner.distances(start, &prepared, &mut at_once).expect("the start is free");
            let nearest = planner.nearest(start, &prepared).expect("the start is free");
            let each: Vec<Option<Cost>> = goals
                .iter()
                .map(|&goal| planner.cost(Ends::new(start, goal)).expect("both ends are free"))
                .collect();
            assert_eq!(at_once.len(), each.len());
            for ((own, other), &goal) in each.iter().zip(&at_once).zip(&goals) {
                let is_same = own.zip(*other).map_or(own == other, |(a, b)| is_equal(k, a, b));
                assert!(is_same, "{own:?}, with others {other:?}; {}", case(goal));
                counts[usize::from(own.is_some())] += 1;
            }
            // Ties: the first of the nearest. At any angle costs are rounded; those of the paths are not.
            let guarantee = planner.guarantee();
            let mut exact = |number: usize, cost: Cost| match k {
                K::Finite(_) => cost,
                K::Any => {
                    let answer = planner.solve(Ends::new(start, goals[number])).expect("the ends are free");
                    guarantee.cost(answer.path().expect("it has a length"))
                }
            };
            let all = at_once.iter().zip(0..).filter_map(|(cost, number)| Some((number, (*cost)?)));
            let least = all.min_by_key(|&(number, cost)| (exact(number, cost), number));
            assert_eq!(nearest, least, "{}", case(start));
            ties += usize::from(k == K::Any && all_near(&at_once, nearest) > 1);
        }
    }
    [counts[0], counts[1], ties]
}

/// Two goals that are equally far, one in sight and one around two corners: the first is the nearest.
#[test]
fn lengths_at_any_angle_are_compared_exactly() {
    let map = AsciiMap::parse("..\n#.\n..\n..").expect("the drawing is a map");
    let corners = FreeSpace::<Corners>::new(std::sync::Arc::new(map.grid), DiagonalGap::Closed);
    let labels = labels(&corners, K::Any);
    let mut planner = HubLabelSearch::new(&corners, &labels).expect("the labels are for this space");
    let ends = [(0, 4), (0, 0)].map(Vertex::from);
    for goals in [ends, [ends[1], ends[0]]] {
        let prepared = labels.goals(&corners, goals).expect("the goals are free");
        let nearest = planner.nearest(Vertex::new(2, 2), &prepared).expect("the start is free");
        assert_eq!(nearest.map(|(number, _)| number), Some(0), "{goals:?}");
    }
}

#[test]
fn many_goals_at_once_are_as_far_as_each() {
    let of = |seed: u64| {
        let mut rng = Rng::new(seed);
        let (width, height) = (5 + rng.below(40), 5 + rng.below(40));
        let grid = if seed.is_multiple_of(2) {
            caves(&mut rng, width, height)
        } else {
            rooms(&mut rng, width, height)
        };
        let gap = GAPS[seed as usize / 2 % 2];
        let any = [k(2), k(3), k(4), k(6), K::Any][seed as usize % 5];
        let corners = check::<Corners>(&grid, any, gap, seed);
        let at_two =
            check::<Centers>(&grid, k(2), [CornerRule::Always, CornerRule::Never][seed as usize % 2], seed);
        let at_three = check::<Centers>(&grid, k(3), CornerRule::Never, seed);
        [0, 1, 2].map(|part| corners[part] + at_two[part] + at_three[part])
    };
    let counts = on_all_cores(seeds(40), of);
    let [unreachable, found, ties] =
        [0, 1, 2].map(|part| counts.iter().map(|counts| counts[part]).sum::<usize>());
    let maps = seeds(40).end as usize;
    // A fifth of the maps is searched at any angle.
    let is_enough = unreachable > 15 * maps && found > 100 * maps && ties > maps / 5;
    assert!(is_enough, "{unreachable}, {found}, {ties}");
}

const HALL: &str = "
    a..#...d
    .#.#.##.
    b..#.##.
    .#.#...c
    ...#####
    s.......
";

/// Four goals as far as one another, in any order: the first is the nearest.
#[test]
fn of_equally_near_goals_the_first_is_the_nearest() {
    let grid =
        Grid::from_fn(9, 9, |x, y| [(2, 2), (6, 2), (2, 6), (6, 6)].contains(&(x, y))).expect("a valid size");
    for k in [k(2), k(3), k(5), K::Any] {
        let space = space::<Centers>(&grid, CornerRule::Never);
        let corners = FreeSpace::<Corners>::new(space.grid().clone(), DiagonalGap::Open);
        let labels = labels(&corners, k);
        let mut planner = HubLabelSearch::new(&corners, &labels).expect("the labels are for this space");
        // From the middle of the left side; the first two behind obstacles, the others plain to see.
        let start = Vertex::new(4, 4);
        let goals: Vec<Vertex> = [(1, 1), (7, 1), (1, 7), (7, 7), (4, 8), (8, 4)].map(Vertex::from).into();
        let cost = |planner: &mut HubLabelSearch<_, _>, goal| {
            planner.cost(Ends::new(start, goal)).expect("both ends are free").expect("there is a path")
        };
        let costs: Vec<Cost> = goals.iter().map(|&goal| cost(&mut planner, goal)).collect();
        for turn in 0..goals.len() {
            let (mut turned, mut costs) = (goals.clone(), costs.clone());
            turned.rotate_left(turn);
            costs.rotate_left(turn);
            let prepared = labels.goals(&corners, turned).expect("the goals are free");
            let least = costs.iter().min().copied();
            let expected = costs.iter().position(|&cost| Some(cost) == least).zip(least);
            assert_eq!(planner.nearest(start, &prepared), Ok(expected), "k = {k}, turn {turn}: {costs:?}");
        }
    }
}

#[test]
fn no_goals_unreachable_goals_and_wrong_ones() {
    let map = AsciiMap::parse(HALL).expect("the drawing is a map");
    let mark = |name| map.mark(name).expect("it is drawn");
    let space = space::<Centers>(&map.grid, CornerRule::Never);
    let labels = labels(&space, k(3));
    let mut planner = HubLabelSearch::new(&space, &labels).expect("the labels are for this space");
    let (start, mut distances) = (mark('s'), vec![None; 3]);
    let none = labels.goals(&space, []).expect("no goal is wrong");
    assert_eq!(planner.distances(start, &none, &mut distances), Ok(()));
    assert_eq!((distances.len(), planner.nearest(start, &none)), (0, Ok(None)));
    let closed = labels.goals(&space, [mark('d'), mark('c'), mark('d')]).expect("the goals are free");
    assert_eq!(planner.distances(start, &closed, &mut distances), Ok(()));
    assert_eq!((&distances[..], planner.nearest(start, &closed)), (&[None; 3][..], Ok(None)));
    let mixed =
        labels.goals(&space, [mark('d'), mark('a'), start, mark('b'), start]).expect("the goals are free");
    assert_eq!(planner.nearest(start, &mixed), Ok(Some((2, Cost::ZERO))));
    planner.distances(start, &mixed, &mut distances).expect("the start is free");
    assert_eq!((distances[0], distances[2], distances[4]), (None, Some(Cost::ZERO), Some(Cost::ZERO)));
    assert_eq!(distances[1].zip(distances[3]).map(|(a, b)| a > b), Some(true));
    let outside = Vertex::new(-1, 3);
    for wrong in [outside, Vertex::new(3, 0), Vertex::new(i32::MAX, 0), Vertex::new(8, 0)] {
        let is_error = |end: End, result: Result<(), QueryError>| match result {
            Err(QueryError::Outside { end: of, at, .. } | QueryError::Blocked { end: of, at }) => {
                of == end && at == wrong
            }
            _ => false,
        };
        let goals = labels.goals(&space, [start, wrong, outside]).map(|_| ());
        assert!(is_error(End::Goal, goals), "{goals:?}");
        let at_once = planner.distances(wrong, &mixed, &mut distances);
        assert!(is_error(End::Start, at_once), "{at_once:?}");
        let nearest = planner.nearest(wrong, &mixed).map(|_| ());
        assert!(is_error(End::Start, nearest), "{nearest:?}");
        assert!(is_error(End::Start, planner.cost(Ends::new(wrong, start)).map(|_| ())));
        assert!(is_error(End::Goal, planner.solve(Ends::new(start, wrong)).map(|_| ())));
    }
}

/// More queries than a planner can number: each answers as a planner that is new.
#[test]
fn a_planner_answers_the_thousandth_query_as_the_first() {
    for (seed, k) in (0..).zip([k(2), k(3), k(5), K::Any]) {
        let mut rng = Rng::new(seed);
        let space = space::<Corners>(&rooms(&mut rng, 30, 22), GAPS[seed as usize % 2]);
        let (labels, free) = (labels(&space, k), free(&space));
        let planner = || HubLabelSearch::new(&space, &labels).expect("the labels are for this space");
        let (mut old, mut ends, mut over) = (planner(), BTreeSet::new(), 0);
        let goals = labels.goals(&space, free.iter().copied().step_by(29)).expect("the goals are free");
        for turn in 0..700 {
            let [start, goal] = [0, 1].map(|_| *rng.pick(&free).expect("some are free"));
            ends.insert((start, goal));
            let query = Ends::new(start, goal);
            let (found, expected) = (old.solve(query), planner().solve(query));
            assert_eq!(found, expected, "query {turn}: {query:?}, k = {k}");
            over += usize::from(
                expected.is_ok_and(|answer| answer.path().is_some_and(|p| p.waypoints().len() > 3)),
            );
            if rng.chance(20) {
                let (mut distances, mut others) = (Vec::new(), Vec::new());
                old.distances(start, &goals, &mut distances).expect("the start is free");
                planner().distances(start, &goals, &mut others).expect("the start is free");
                assert_eq!(distances, others, "query {turn}: from {start}, k = {k}");
                assert_eq!(old.nearest(start, &goals), planner().nearest(start, &goals), "query {turn}");
            }
        }
        assert!(over > 300 && ends.len() > 600, "{over} of {}", ends.len());
    }
}

/// Goals of other labels are refused, without a panic.
#[test]
fn goals_of_other_labels_are_refused() {
    let small = space::<Corners>(&rooms(&mut Rng::new(1), 9, 9), DiagonalGap::Open);
    let large = space::<Corners>(&rooms(&mut Rng::new(2), 40, 30), DiagonalGap::Open);
    let goals = |space: &FreeSpace<Corners>, labels: &HubLabels<Corners>| {
        labels.goals(space, free(space).into_iter().step_by(7)).expect("the goals are free")
    };
    let (of_small, of_large) = (labels(&small, k(3)), labels(&large, k(3)));
    let (few, many) = (goals(&small, &of_small), goals(&large, &of_large));
    for (space, own, other) in [(&small, &of_small, &many), (&large, &of_large, &few)] {
        let mut planner = HubLabelSearch::new(space, own).expect("the labels are for this space");
        let start = free(space)[0];
        let refused = planner.distances(start, other, &mut Vec::new());
        assert_eq!(refused, Err(QueryError::OtherGoals));
        assert_eq!(planner.nearest(start, other), Err(QueryError::OtherGoals));
    }
    // Another space than that of the labels, and another k.
    let refused = of_small.goals(&large, free(&large));
    assert_eq!(refused.map(|_| ()), Err(QueryError::OtherGoals));
    let of_k = labels(&small, k(4));
    let mut planner = HubLabelSearch::new(&small, &of_k).expect("the labels are for this space");
    assert_eq!(planner.nearest(free(&small)[0], &few), Err(QueryError::OtherGoals));
}
