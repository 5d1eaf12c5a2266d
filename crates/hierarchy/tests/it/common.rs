//! Maps, indexes, planners and queries that several suites share.
#![allow(dead_code, reason = "each suite uses a part")]

use std::{num::NonZeroU32, ops::Deref, sync::Arc};

use mediant_grid::{Centers, CornerRule, Grid, GridGraph, Placement, Vector, Vertex};
use mediant_hierarchy::{ChpaStar, ClusterGraph, Clustering, FallbackPolicy, HpaStar, SegmentGraph};
use mediant_moves::{Cost, FiniteK};
use mediant_oracle::{Rng, caves, describe, maze, noise, rooms, suite_grid, validate};
use mediant_search::{
    Answer, Counters, Ends, Euclidean, Heuristic, Hk, Path, Planner, QueryError, SquaredEuclidean, Zero,
};

pub(crate) const CORNER_RULES: [CornerRule; 3] = [CornerRule::Never, CornerRule::One, CornerRule::Always];

pub(crate) fn k(number: u32) -> FiniteK {
    FiniteK::new(number).expect("k is at least 2")
}

pub(crate) fn number(number: u32) -> NonZeroU32 {
    NonZeroU32::new(number).expect("it is at least 1")
}

pub(crate) fn grid_graph(grid: &Grid, k: FiniteK, rule: CornerRule) -> GridGraph<Centers> {
    GridGraph::new(Arc::new(grid.clone()), k, rule).expect("k is in range")
}

/// The grid graph of a map with one of the moves and rules that there are hierarchies for.
pub(crate) fn any_grid_graph(rng: &mut Rng, grid: &Grid) -> GridGraph<Centers> {
    if rng.chance(50) {
        grid_graph(grid, k(3), CornerRule::Never)
    } else {
        grid_graph(grid, k(2), CORNER_RULES[rng.below(3) as usize])
    }
}

/// The map of a seed: three in four are small maps as in the other crates' tests, one in four has room for
/// clusters of several levels.
pub(crate) fn map(seed: u64) -> Grid {
    if seed % 4 != 3 {
        return suite_grid(seed).0;
    }
    let mut rng = Rng::new(seed ^ 0x3A9);
    let (width, height) = (20 + rng.below(40), 20 + rng.below(40));
    match rng.below(4) {
        0 => {
            let percent = rng.below(45);
            noise(&mut rng, width, height, percent)
        }
        1 => rooms(&mut rng, width, height),
        2 => maze(&mut rng, width, height),
        _ => caves(&mut rng, width, height),
    }
}

/// A random clustering of up to four levels, with mostly small clusters, since the maps are small.
pub(crate) fn any_clustering(rng: &mut Rng) -> Clustering {
    let side = match rng.below(12) {
        0 => 64,
        1..=6 => 2 + rng.below(4),
        _ => 2 + rng.below(11),
    };
    let fitting = (1..=4).filter(|level| side << (level - 1) <= Clustering::MAX_SIDE).count() as u32;
    Clustering { side, levels: 1 + rng.below(fitting) }
}

pub(crate) fn clusters(grid_graph: &GridGraph<Centers>, clustering: Clustering) -> ClusterGraph {
    ClusterGraph::new(grid_graph, clustering).expect("there is an index for these moves")
}

pub(crate) fn segments(grid_graph: &GridGraph<Centers>, side: u32) -> SegmentGraph {
    SegmentGraph::new(grid_graph, side).expect("there is an index for these moves")
}

/// The heuristics that are lower bounds, as one type.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Bound {
    GridGraph,
    Euclidean,
    Zero,
}

impl Heuristic for Bound {
    fn estimate<P: Placement>(self, grid_graph: &GridGraph<P>, to_goal: Vector) -> Cost {
        match self {
            Self::GridGraph => Hk.estimate(grid_graph, to_goal),
            Self::Euclidean => Euclidean.estimate(grid_graph, to_goal),
            Self::Zero => Zero.estimate(grid_graph, to_goal),
        }
    }
}

/// The heuristic of a phase of CHPA*: a lower bound, or `None` for `SquaredEuclidean`, which is none.
pub(crate) type Phase = Option<Bound>;

/// The options of CHPA*.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Setting {
    pub(crate) phases: [Phase; 2],
    pub(crate) step: NonZeroU32,
    pub(crate) fallback: FallbackPolicy,
}

impl Setting {
    pub(crate) fn any(rng: &mut Rng) -> Self {
        let bounds = [Some(Bound::GridGraph), Some(Bound::Euclidean), Some(Bound::Zero), None];
        let phases = [(); 2].map(|()| bounds[rng.below(4) as usize]);
        let detour = number(1 + rng.below(4));
        Self { phases, step: number(1 + rng.below(4)), fallback: FallbackPolicy::Complete { detour } }
    }

    /// The same options with the published fallback policy.
    pub(crate) fn of_the_paper(self) -> Self {
        Self { fallback: FallbackPolicy::Paper, ..self }
    }
}

/// A planner of any type.
pub(crate) type Solve<'i> = Box<dyn FnMut(Ends, &mut Counters) -> Result<Answer, QueryError> + Send + 'i>;

fn boxed<'i>(mut planner: impl Planner + Send + 'i) -> Solve<'i> {
    Box::new(move |query, counters| planner.solve_observed(query, counters))
}

pub(crate) fn hpa<'i, G, I>(grid_graph: G, graph: I, straightens: bool) -> Solve<'i>
where
    G: Deref<Target = GridGraph<Centers>> + Send + 'i,
    I: Deref<Target = ClusterGraph> + Send + 'i,
{
    boxed(HpaStar::new(grid_graph, graph).expect("the index fits").with_straightening(straightens))
}

pub(crate) fn chpa<'i, G, I>(grid_graph: G, graph: I, setting: Setting) -> Solve<'i>
where
    G: Deref<Target = GridGraph<Centers>> + Clone + Send + 'i,
    I: Deref<Target = SegmentGraph> + Send + 'i,
{
    let Setting { phases, step, fallback } = setting;
    macro_rules! planner {
        ($first:expr, $second:expr) => {
            boxed(
                ChpaStar::new(grid_graph, graph, $first, $second)
                    .expect("the index fits")
                    .with_step(step)
                    .with_fallback_policy(fallback),
            )
        };
    }
    match phases {
        [Some(first), Some(second)] => planner!(first, second),
        [Some(first), None] => planner!(first, SquaredEuclidean),
        [None, Some(second)] => planner!(SquaredEuclidean, second),
        [None, None] => planner!(SquaredEuclidean, SquaredEuclidean),
    }
}

/// An answer, and the counts of its search.
pub(crate) type CountedAnswer = (Result<Answer, QueryError>, Counters);

pub(crate) fn ask(solve: &mut Solve<'_>, query: Ends) -> CountedAnswer {
    let mut counters = Counters::default();
    let answer = solve(query, &mut counters);
    (answer, counters)
}

/// The free cells of a map.
pub(crate) fn free_cells(grid: &Grid) -> Vec<Vertex> {
    let (width, height) = (grid.width() as i32, grid.height() as i32);
    let cells = (0..height).flat_map(|y| (0..width).map(move |x| Vertex::new(x, y)));
    cells.filter(|at| grid.is_free(at.x, at.y)).collect()
}

/// Queries between random free cells; none where no cell is free.
pub(crate) fn random_queries(rng: &mut Rng, grid: &Grid, count: usize) -> Vec<Ends> {
    let free = free_cells(grid);
    (0..count).filter_map(|_| Some(Ends::new(*rng.pick(&free)?, *rng.pick(&free)?))).collect()
}

/// Panics unless this is a legal path of the query that turns at each waypoint but its ends.
pub(crate) fn check_path(
    grid_graph: &GridGraph<Centers>,
    query: Ends,
    path: &Path,
    case: &impl Fn() -> String,
) {
    let (grid, rules, way) = (grid_graph.grid(), grid_graph.rules(), path.waypoints());
    let fault = validate(grid, rules, Some(grid_graph.k()), query.start, query.goal, way, path.cost());
    assert_eq!(fault, Ok(()), "{way:?}; {}", case());
    let turns = |at: &[Vertex]| {
        let (came, goes) = (at[0].to(at[1]), at[1].to(at[2]));
        came.det(goes) != 0 || came.dot(goes) < 0
    };
    assert!(way.windows(3).all(turns), "{way:?} goes straight on; {}", case());
}

/// The map and query of a failure, to be pasted into a test.
pub(crate) fn describe_query(grid_graph: &GridGraph<Centers>, query: Ends, seed: u64) -> String {
    let map = describe(grid_graph.grid(), grid_graph.rules(), query.start, query.goal, seed);
    format!("k = {}; {map}", grid_graph.k())
}
