//! Ends anywhere on subgoal graphs and hub labels, against the oracle of points.

use std::sync::Arc;

use mediant_grid::{Corners, FreeSpace, Point};
use mediant_moves::K;
use mediant_oracle::{
    PointVisibility, Rng, describe_points, random_free_point, seeds, suite_grid, validate_between_points,
};
use mediant_search::{Answer, Planner, PointEnds, QueryError};
use mediant_subgoal::{HubLabelSearch, SubgoalAStar};

use crate::common::{GAPS, HIERARCHIES, graph, k, labels};

/// Answers a query by one planner, and checks the path.
fn solve(
    planner: &mut impl Planner,
    space: &FreeSpace<Corners>,
    [from, to]: [(i64, i64); 2],
    expected: Option<f64>,
    case: &str,
) {
    let ends = PointEnds::new(Point::from_parts(from.0, from.1), Point::from_parts(to.0, to.1));
    let answer = planner.solve_at(ends).expect("any angle").expect("both ends are free");
    match (&answer, expected) {
        (Answer::Unreachable, None) => {}
        (Answer::Found(path), Some(best)) => {
            assert!((path.cost() - best).abs() <= 1e-9 * best, "{path}, best {best}; {case}");
            let points: Vec<_> = path.points().map(Point::parts).collect();
            let fault = validate_between_points(space.grid(), space.rule(), from, to, &points, path.cost());
            assert_eq!(fault, Ok(()), "{path}; {case}");
            let turns = |at: &[(i64, i64)]| {
                let [v, w] = [1, 2].map(|i| [at[i].0 - at[i - 1].0, at[i].1 - at[i - 1].1].map(i128::from));
                v[0] * w[1] != v[1] * w[0]
            };
            assert!(points.windows(3).all(turns), "{path} goes straight on at a bend; {case}");
        }
        _ => panic!("{answer:?}, not {expected:?}; {case}"),
    }
}

#[test]
fn paths_between_points_are_the_shortest() {
    let mut answers = [0; 2];
    for (seed, gap) in seeds(400).flat_map(|seed| GAPS.map(|gap| (seed, gap))) {
        let (grid, mut rng) = (Arc::new(suite_grid(seed).0), Rng::new(seed));
        let space = FreeSpace::<Corners>::new(Arc::clone(&grid), gap);
        let oracle = PointVisibility::new(&grid, gap);
        let labels = labels(&space, K::Any);
        let mut on_labels = HubLabelSearch::new(&space, &labels).expect("the labels are for this space");
        let hierarchy = HIERARCHIES[seed as usize % HIERARCHIES.len()];
        let graph = graph(&space, K::Any, hierarchy);
        let mut on_graph = SubgoalAStar::new(&space, &graph).expect("the graph is for this space");
        for _ in 0..16 {
            let Some(ends) = random_free_point(&mut rng, &grid).zip(random_free_point(&mut rng, &grid))
            else {
                break;
            };
            let expected = oracle.cost(ends.0, ends.1);
            let case = describe_points(&grid, gap, ends.0, ends.1, seed);
            solve(&mut on_labels, &space, ends.into(), expected, &format!("labels: {case}"));
            solve(&mut on_graph, &space, ends.into(), expected, &format!("{hierarchy:?}: {case}"));
            answers[usize::from(expected.is_some())] += 1;
        }
    }
    assert!(answers.iter().all(|&count| count > 1_000), "{answers:?}");
}

#[test]
fn over_moves_and_outside_of_the_map_points_are_refused() {
    let grid = Arc::new(mediant_grid::Grid::from_fn(8, 8, |x, y| (x, y) == (4, 4)).expect("a small map"));
    let space = FreeSpace::<Corners>::new(grid, GAPS[0]);
    let between = PointEnds::new((0.5, 0.5), (7.5, 7.5));
    let of_k = labels(&space, k(3));
    let mut planner = HubLabelSearch::new(&space, &of_k).expect("the labels are for this space");
    assert!(planner.solve_at(between).is_none());
    let of_any = labels(&space, K::Any);
    let mut planner = HubLabelSearch::new(&space, &of_any).expect("the labels are for this space");
    assert!(matches!(planner.solve_at(between), Some(Ok(Answer::Found(_)))));
    for (start, is_outside) in [((-0.5, 0.0), true), ((4.5, 4.5), false), ((8.001, 1.0), true)] {
        let error =
            planner.solve_at(PointEnds::new(start, (0, 0))).expect("any angle").expect_err("not free");
        let outside = matches!(error, QueryError::Outside { .. });
        assert_eq!(
            (outside, matches!(error, QueryError::Blocked { .. })),
            (is_outside, !is_outside),
            "{error}"
        );
    }
}
