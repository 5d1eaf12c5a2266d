//! The wavefront algorithm against breadth-first search on the explicit graph, and against Dijkstra where all
//! moves have the same length.

use std::{
    collections::{BTreeSet, VecDeque},
    sync::Arc,
};

use mediant_grid::{AsciiMap, Centers, Corners, DiagonalGap, Grid, GridGraph, Placement, Rules, Vertex};
use mediant_moves::FiniteK;
use mediant_oracle::{
    Explicit, Rng, describe, is_gap, neighborhood, random_free_vertex, segment_is_legal, suite_grid,
    turn_is_legal, validate, vertex_is_free,
};
use mediant_search::{
    Answer, Counters, Distances, End, Ends, Guarantee, Path, Planner, QueryError, Wavefront,
};

/// All legal moves of a map, for a plain breadth-first search.
struct Graph<'g> {
    grid: &'g Grid,
    rules: Rules,
    k: FiniteK,
    size: (i32, i32),
    successors: Vec<Vec<Vertex>>,
}

impl<'g> Graph<'g> {
    fn new(grid: &'g Grid, rules: Rules, k: FiniteK) -> Self {
        let extra = u32::from(matches!(rules, Rules::Corner(_)));
        let (columns, rows) = (grid.width() + extra, grid.height() + extra);
        let moves = neighborhood(Some(k), columns, rows);
        let size = (columns as i32, rows as i32);
        let vertices = (0..size.1).flat_map(|y| (0..size.0).map(move |x| Vertex::new(x, y)));
        let successors = vertices.map(|at| {
            moves.iter().map(|&v| at + v).filter(|&to| segment_is_legal(grid, rules, at, to)).collect()
        });
        Self { grid, rules, k, size, successors: successors.collect() }
    }

    fn index(&self, at: Vertex) -> usize {
        (at.y * self.size.0 + at.x) as usize
    }

    fn is_closed_gap(&self, at: Vertex) -> bool {
        self.rules == Rules::Corner(DiagonalGap::Closed) && is_gap(self.grid, at)
    }

    /// The least number of moves from `start` to every vertex, row by row, by a search that knows at a closed
    /// gap from where the path came; for k = 2 by Dijkstra on a graph with a vertex for each quadrant of a
    /// gap.
    fn moves_from(&self, start: Vertex) -> Vec<Option<u32>> {
        if self.k == FiniteK::N4 {
            let graph = Explicit::new(self.grid, self.rules, Some(self.k));
            let costs = graph.costs_from(start);
            let vertices = (0..self.size.1).flat_map(|y| (0..self.size.0).map(move |x| Vertex::new(x, y)));
            return vertices.map(|at| costs.to(at).map(|cost| cost as u32)).collect();
        }
        let may_turn =
            |before, at, after| !self.is_closed_gap(at) || turn_is_legal(self.grid, before, at, after);
        let mut moves = vec![None; self.successors.len()];
        moves[self.index(start)] = Some(0);
        let mut known = BTreeSet::new();
        let mut queue = VecDeque::from([(None, start, 0)]);
        while let Some((before, at, count)) = queue.pop_front() {
            for &to in &self.successors[self.index(at)] {
                // Elsewhere it does not matter from where a path comes.
                let from = self.is_closed_gap(to).then_some((at.x, at.y));
                if may_turn(before, at, Some(to)) && known.insert((to.x, to.y, from)) {
                    queue.push_back((Some(at), to, count + 1));
                    let least = &mut moves[self.index(to)];
                    if least.is_none() && may_turn(Some(at), to, None) {
                        *least = Some(count + 1);
                    }
                }
            }
        }
        moves
    }
}

/// The algorithm on a map, whatever the placement: the moves to every vertex, and the answer to a query, by
/// the same planner.
trait Waves {
    fn distances(&mut self, start: Vertex) -> Result<Distances<u32>, QueryError>;
    fn answer(&mut self, query: Ends) -> Result<(Answer, Counters), QueryError>;
    fn promise(&self) -> Guarantee;
}

impl<P: Placement> Waves for Wavefront<SharedGraph<P>> {
    fn distances(&mut self, start: Vertex) -> Result<Distances<u32>, QueryError> {
        Wavefront::distances(self, start)
    }

    fn answer(&mut self, query: Ends) -> Result<(Answer, Counters), QueryError> {
        let mut counters = Counters::default();
        Ok((self.solve_observed(query, &mut counters)?, counters))
    }

    fn promise(&self) -> Guarantee {
        self.guarantee()
    }
}

type SharedGraph<P> = Arc<GridGraph<P>>;

fn waves(grid: &Arc<Grid>, rules: Rules, k: FiniteK) -> Box<dyn Waves> {
    fn on<P: Placement>(grid: &Arc<Grid>, k: FiniteK, rule: P::Rule) -> Box<dyn Waves> {
        let grid_graph = GridGraph::<P>::new(Arc::clone(grid), k, rule).expect("k is in range");
        Box::new(Wavefront::new(Arc::new(grid_graph)))
    }
    match rules {
        Rules::Center(corners) => on::<Centers>(grid, k, corners),
        Rules::Corner(gap) | Rules::CenterGap(gap) => on::<Corners>(grid, k, gap),
    }
}

/// The number of moves of a path, whose waypoints stand where the move changes.
fn moves_of(path: &Path) -> u32 {
    let gcd = |mut a: u32, mut b: u32| {
        while b > 0 {
            (a, b) = (b, a % b);
        }
        a
    };
    path.waypoints()
        .windows(2)
        .map(|ends| gcd(ends[0].x.abs_diff(ends[1].x), ends[0].y.abs_diff(ends[1].y)))
        .sum()
}

/// Checks the moves to every vertex from one start. Returns the number of vertices reached.
fn check_distances(
    waves: &mut dyn Waves,
    graph: &Graph<'_>,
    start: Vertex,
    case: &dyn Fn() -> String,
) -> usize {
    let distances = waves.distances(start).unwrap_or_else(|error| panic!("{error}; {}", case()));
    let size = (distances.width() as i32, distances.height() as i32);
    assert_eq!(size, graph.size, "{}", case());
    let expected = graph.moves_from(start);
    for (index, &moves) in expected.iter().enumerate() {
        let at = Vertex::new(index as i32 % size.0, index as i32 / size.0);
        assert_eq!(distances.get(at), moves, "moves to {at}; {}", case());
    }
    let listed: Vec<_> = distances.iter().map(|(at, moves)| (graph.index(at), Some(moves))).collect();
    let known: Vec<_> = expected.into_iter().enumerate().filter(|(_, moves)| moves.is_some()).collect();
    assert_eq!(listed, known, "{}", case());
    known.len()
}

fn check_path(waves: &mut dyn Waves, graph: &Graph<'_>, query: Ends, case: &dyn Fn() -> String) {
    let k = graph.k;
    let (answer, counters) = waves.answer(query).unwrap_or_else(|error| panic!("{error}; {}", case()));
    let expected = graph.moves_from(query.start)[graph.index(query.goal)];
    assert_eq!(answer.path().map(moves_of), expected, "{}", case());
    let Some(path) = answer.path() else {
        assert_eq!(counters, Counters::default(), "the components know without a search; {}", case());
        return;
    };
    let Ends { start, goal, .. } = query;
    let fault = validate(graph.grid, graph.rules, Some(k), start, goal, path.waypoints(), path.cost());
    assert_eq!(fault, Ok(()), "{}", case());
    assert!(counters.expanded < counters.generated, "{counters:?}; {}", case());
    assert_eq!((counters.updated, counters.percolations), (0, 0), "{}", case());
    assert_eq!(waves.answer(query), Ok((answer.clone(), counters)), "the same again; {}", case());
    assert_eq!(waves.promise() == Guarantee::Optimal(k), k == FiniteK::N4);
}

#[test]
fn moves_are_the_fewest_on_random_maps() {
    let (mut reached, mut paths) = (0, 0);
    for seed in mediant_oracle::seeds(40) {
        let grid = Arc::new(suite_grid(seed).0);
        for rules in Rules::ALL {
            for k in (2..=6).map(|k| FiniteK::new(k).unwrap()) {
                let graph = Graph::new(&grid, rules, k);
                let mut waves = waves(&grid, rules, k);
                let mut rng = Rng::new(seed ^ 0xFACE);
                let mut free = || random_free_vertex(&mut rng, &grid, rules.placement());
                for _ in 0..3 {
                    let (Some(start), Some(goal)) = (free(), free()) else { continue };
                    let case = || format!("k = {k}; {}", describe(&grid, rules, start, goal, seed));
                    reached += check_distances(&mut *waves, &graph, start, &case);
                    check_path(&mut *waves, &graph, Ends::new(start, goal), &case);
                    paths += 1;
                }
            }
        }
    }
    let maps = mediant_oracle::seeds(40).end as usize;
    assert!(paths > 40 * maps && reached > 1_500 * maps, "{paths} paths, {reached} vertices reached");
}

/// Every map of 3 × 3 cells, from every vertex: the smallest maps hold the oddest cases.
#[test]
fn moves_are_the_fewest_on_every_map_of_nine_cells() {
    let mut starts = 0;
    for cells in 0..1_u32 << 9 {
        let grid = Arc::new(Grid::from_fn(3, 3, |x, y| cells >> (3 * y + x) & 1 == 1).unwrap());
        for rules in Rules::ALL {
            let free = Explicit::new(&grid, rules, None);
            // From k = 5 on paths may pass closed gaps.
            let largest = if rules == Rules::Corner(DiagonalGap::Closed) { 5 } else { 4 };
            for k in (2..=largest).map(|k| FiniteK::new(k).unwrap()) {
                let graph = Graph::new(&grid, rules, k);
                let mut waves = waves(&grid, rules, k);
                for start in free.free_vertices() {
                    let case = || format!("k = {k}; {}", describe(&grid, rules, start, start, 0));
                    check_distances(&mut *waves, &graph, start, &case);
                    starts += 1;
                }
            }
        }
    }
    assert_eq!(starts, 62_848);
}

/// A path of fewest moves may pass a closed gap, within one of its free quadrants.
#[test]
fn fewest_moves_may_pass_a_closed_gap() {
    let map = AsciiMap::parse("..#.\n#...\n.#..").unwrap();
    let (grid, rules) = (Arc::new(map.grid), Rules::Corner(DiagonalGap::Closed));
    let k = FiniteK::new(5).unwrap();
    let query = Ends::new((2, 0), (4, 1));
    let (answer, _) = waves(&grid, rules, k).answer(query).unwrap();
    let path = answer.into_path().unwrap();
    assert_eq!(path.waypoints(), [(2, 0), (1, 2), (4, 1)].map(Vertex::from));
    // No path leads to that gap, whose own cell is blocked; but the one that stays there.
    let gap = Vertex::new(1, 2);
    assert!(Graph::new(&grid, rules, k).is_closed_gap(gap));
    let answer = |start: Vertex| waves(&grid, rules, k).answer(Ends::new(start, gap)).unwrap().0;
    assert_eq!(answer((2, 0).into()), Answer::Unreachable);
    assert_eq!(answer(gap), Answer::Found(Path::new(vec![gap])));
}

#[test]
fn ties_go_to_the_vertex_reached_first() {
    let grid = Arc::new(Grid::from_fn(4, 3, |_, _| false).unwrap());
    let path = |k: u32, goal: (i32, i32)| {
        let rules = Rules::Center(mediant_grid::CornerRule::Never);
        let mut waves = waves(&grid, rules, FiniteK::new(k).unwrap());
        let (answer, _) = waves.answer(Ends::new((0, 0), goal)).unwrap();
        answer.path().unwrap().waypoints().iter().map(|at| (at.x, at.y)).collect::<Vec<_>>()
    };
    // The first move is (0, 1), so the vertex to which it leads is expanded first.
    assert_eq!(path(2, (3, 2)), [(0, 0), (0, 2), (3, 2)]);
    // Three moves. So has [(0, 0), (2, 0), (3, 1)], which is shorter, but (2, 2) is reached before (2, 1) and
    // (2, 0).
    assert_eq!(path(3, (3, 1)), [(0, 0), (2, 2), (3, 1)]);
    assert_eq!(path(3, (2, 2)), [(0, 0), (2, 2)]);
}

#[test]
fn starts_that_are_no_vertices_are_errors() {
    let grid = Arc::new(Grid::from_fn(3, 2, |x, y| (x, y) == (1, 1)).unwrap());
    let rules = Rules::Center(mediant_grid::CornerRule::Never);
    let mut waves = waves(&grid, rules, FiniteK::N8);
    let (end, last) = (End::Start, Vertex::new(2, 1));
    for at in [(3, 0), (0, 2), (-1, 0), (i32::MIN, i32::MAX)].map(Vertex::from) {
        assert_eq!(waves.distances(at), Err(QueryError::Outside { end, at: at.into(), last }));
    }
    let at = Vertex::new(1, 1);
    assert_eq!(waves.distances(at), Err(QueryError::Blocked { end, at: at.into() }));
    // There are no distances to vertices outside the map.
    let distances = waves.distances(Vertex::new(0, 1)).unwrap();
    assert_eq!(distances.get(Vertex::new(0, 0)), Some(1));
    for at in [(3, 0), (-1, 1), (0, 2), (0, -1), (i32::MAX, i32::MAX), (i32::MIN, i32::MIN)] {
        assert_eq!(distances.get(at.into()), None, "{at:?}");
    }
    assert!(vertex_is_free(&grid, rules.placement(), Vertex::new(0, 1)));
}
