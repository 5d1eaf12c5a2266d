//! The bends of paths are legal paths of the same cost over N(k), and smoothing starts from them, on seeded
//! random maps.

use mediant_grid::{Centers, CornerRule, Corners, FreeSpace, Vertex};
use mediant_moves::K;
use mediant_oracle::{Visibility, describe, on_all_cores, seeds, suite_grid, validate};
use mediant_search::{Ends, Path, Planner, Smoothed, Smoothing};
use mediant_subgoal::{Hierarchy, HubLabelSearch, SubgoalAStar};

use crate::{
    common::{GAPS, graph, k, labels, length, levels, space},
    exact::ends,
};

/// The number of paths that were made shorter.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    paths: usize,
    /// Whose bends, joined by straight segments, are shorter than the moves of N(k).
    straightened: usize,
    /// Paths over N(k) that bend once, elsewhere than the paths over their bends: mostly those that are free
    /// on the empty grid, between ends that do not see each other.
    around: usize,
    /// Smoothed by either kind to less than the path over the bends.
    smoothed: [usize; 2],
}

/// A map and the lengths at any angle on it.
struct Suite<'t> {
    space: &'t FreeSpace<Corners>,
    visibility: &'t Visibility<'t>,
    ends: Vec<Vertex>,
    k: K,
    seed: u64,
}

impl Suite<'_> {
    /// Checks a planner, made anew for smoothing; `all` says that it knows the bends of all its paths.
    fn check<E: Planner>(&self, planner: impl Fn() -> E, all: bool, tally: &mut Tally) {
        let smoothed = |smoothing| {
            Smoothed::new(planner(), self.space, Some(smoothing)).expect("the planner is of this space")
        };
        let mut smoothed = [Smoothing::Linear, Smoothing::Taut].map(smoothed);
        let mut planner = planner();
        let any = self.visibility.over(None);
        for &start in &self.ends {
            let best = any.costs_from(start);
            for &goal in &self.ends {
                let query = Ends::new(start, goal);
                if !planner.seek(query, &mut ()).expect("both ends are free") {
                    assert_eq!(planner.bends_to(goal), None, "{}", self.case(query));
                    continue;
                }
                let bends = self.check_bends(&mut planner, query, all, tally);
                let best = best.to(goal).expect("there is a path");
                for (planner, count) in smoothed.iter_mut().zip(&mut tally.smoothed) {
                    let answer = planner.solve(query).expect("both ends are free");
                    let path = answer.path().expect("there is a path");
                    self.check_legal(query, path.waypoints());
                    let (most, slack) = (bends.cost(), 1.0 + 1e-9);
                    let is_between = best <= path.cost() * slack && path.cost() <= most * slack;
                    assert!(is_between, "{best}, {path}, {most}; {}", self.case(query));
                    *count += usize::from(path.cost() * slack < most);
                }
            }
        }
    }

    /// Checks the bends of the path that a planner has found. Returns the path from which smoothing starts.
    fn check_bends(&self, planner: &mut impl Planner, query: Ends, all: bool, tally: &mut Tally) -> Path {
        let (goal, case) = (query.goal, || self.case(query));
        let path = planner.path_to(goal).expect("a path was found");
        let bends = planner.bends_to(goal);
        assert_eq!(planner.path_to(goal).as_ref(), Some(&path), "asked again; {}", case());
        assert_eq!(planner.bends_to(query.start), Some(vec![query.start]), "{}", case());
        tally.paths += 1;
        let Some(bends) = bends else {
            // It turns at most once, where no subgoal is.
            assert!(!all && path.len() == 3, "{path} has no bends; {}", case());
            return path;
        };
        self.check_legal(query, &bends);
        let [straight, moves] = [&bends[..], path.waypoints()].map(|way| length(self.k, way));
        assert_eq!(straight, moves, "{path} by {bends:?}; {}", case());
        let bends = Path::new(bends);
        assert!(bends.cost() <= path.cost() * (1.0 + 1e-12), "{path}, {bends}; {}", case());
        tally.straightened += usize::from(bends.cost() < path.cost() * (1.0 - 1e-9));
        tally.around += usize::from(path.len() == 3 && bends.len() > 2 && bends[1] != path[1]);
        bends
    }

    fn check_legal(&self, query: Ends, way: &[Vertex]) {
        let (grid, rules, cost) = (self.space.grid(), self.space.rules(), Path::new(way.to_vec()).cost());
        let fault = validate(grid, rules, None, query.start, query.goal, way, cost);
        assert_eq!(fault, Ok(()), "{way:?}; {}", self.case(query));
        let turns = |at: &[Vertex]| at[0].to(at[1]).det(at[1].to(at[2])) != 0;
        assert!(way.windows(3).all(turns), "{way:?} goes straight on; {}", self.case(query));
    }

    fn case(&self, query: Ends) -> String {
        let map = describe(self.space.grid(), self.space.rules(), query.start, query.goal, self.seed);
        format!("k = {}; {map}", self.k)
    }
}

fn check_map(seed: u64) -> Tally {
    let mut tally = Tally::default();
    let grid = suite_grid(seed).0;
    for gap in GAPS {
        let space = space::<Corners>(&grid, gap);
        let visibility = Visibility::new(&grid, gap);
        let ends = ends(&grid, visibility.corners(), seed);
        for k in [k(2 + seed as u32 % 2), k(4 + seed as u32 % 3), K::Any] {
            let suite = Suite { space: &space, visibility: &visibility, ends: ends.clone(), k, seed };
            let (labels, graph) = (labels(&space, k), graph(&space, k, Hierarchy::Contracted));
            let by_labels = || HubLabelSearch::new(&space, &labels).expect("the labels are of this space");
            suite.check(by_labels, true, &mut tally);
            let by_graph = || SubgoalAStar::new(&space, &graph).expect("the graph is of this space");
            suite.check(by_graph, false, &mut tally);
        }
    }
    tally
}

#[test]
fn smoothing_starts_from_bends_that_see_each_other() {
    let maps = seeds(150).end as usize;
    let mut sum = Tally::default();
    for tally in on_all_cores(seeds(150), check_map) {
        sum.paths += tally.paths;
        sum.straightened += tally.straightened;
        sum.around += tally.around;
        sum.smoothed.iter_mut().zip(tally.smoothed).for_each(|(sum, count)| *sum += count);
    }
    assert!(sum.paths > 100 * maps && sum.straightened > 20 * maps, "{sum:?} on {maps} maps");
    assert!(sum.around > maps && sum.smoothed.iter().all(|&count| count > maps), "{sum:?} on {maps} maps");
}

/// Where edges are no lines of sight that a path follows, smoothing looks for them.
#[test]
fn there_are_bends_along_taut_edges_alone() {
    let mut found = 0;
    for seed in 0..20 {
        let grid = suite_grid(seed).0;
        let corners = space::<Corners>(&grid, GAPS[0]);
        let graph = graph(&corners, k(3), levels(2));
        let centers = space::<Centers>(&grid, CornerRule::Never);
        let labels = labels(&centers, k(3));
        let mut by_graph = SubgoalAStar::new(&corners, &graph).expect("the graph is of this space");
        let mut by_labels = HubLabelSearch::new(&centers, &labels).expect("the labels are of this space");
        for x in 0..grid.width() as i32 {
            let ends = Ends::new((x, 0), (grid.width() as i32 - 1 - x, grid.height() as i32 - 1));
            for (is_found, bends) in [
                (by_graph.seek(ends, &mut ()), by_graph.bends_to(ends.goal)),
                (by_labels.seek(ends, &mut ()), by_labels.bends_to(ends.goal)),
            ] {
                assert_eq!(bends, None, "seed {seed}: {ends:?}");
                found += usize::from(is_found == Ok(true));
            }
        }
    }
    assert!(found > 40, "{found} paths");
}
