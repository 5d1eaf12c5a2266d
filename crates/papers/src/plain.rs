//! A plain A*, whose choices are parameters: what a published program may have done otherwise.
//!
//! With the engines' choices it makes their searches: the same expansions, swaps and costs, which a test
//! holds. So a figure that it finds with another choice differs from the engines' by that choice alone.

mod heap;

use mediant_grid::{Centers, Grid, GridGraph, Vertex, VertexId};
use mediant_moves::Cost;
use mediant_search::{Ends, Euclidean, Heuristic, Hk};

use heap::Heap;
pub(super) use heap::Ties;

/// An estimate of the cost to the goal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Estimate {
    Hk,
    Euclidean,
}

/// The legal moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Legal {
    /// All cells that the segment touches are free.
    Segment,
    /// All cells of the rectangle around it are free.
    Rectangle,
}

/// The vertices at which all legal moves are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Expands {
    /// All vertices: A*.
    Everywhere,
    /// Canonical A* as published: the vertices at the corners of obstacles.
    Corners,
    /// These, and the vertices around them.
    AroundCorners,
}

/// The choices of the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Choices {
    pub(super) estimate: Estimate,
    pub(super) ties: Ties,
    pub(super) legal: Legal,
    pub(super) expands: Expands,
}

/// The counts of a search that found a path.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Found {
    /// The length of the path in cells, and its moves.
    pub(super) cost: f64,
    pub(super) moves: u32,
    pub(super) expanded: u64,
    pub(super) percolations: u64,
}

/// A vertex that a path is known to.
#[derive(Clone, Copy)]
struct Node {
    g: Cost,
    parent: VertexId,
    by: usize,
    is_closed: bool,
}

/// The searches on a map, from one to the next.
pub(super) struct Plain<'g> {
    graph: &'g GridGraph<Centers>,
    choices: Choices,
    /// For each vertex, whether canonical A* takes all moves there.
    takes_all: Vec<bool>,
    blocked: Sums,
    nodes: Vec<Option<Node>>,
    /// The vertices that the last search touched.
    touched: Vec<VertexId>,
    heap: Heap,
}

impl<'g> Plain<'g> {
    pub(super) fn new(graph: &'g GridGraph<Centers>, choices: Choices) -> Self {
        let count = graph.vertex_count();
        let reach = if choices.expands == Expands::AroundCorners { 1 } else { 0 };
        let takes_all = |id: usize| {
            choices.expands == Expands::Everywhere
                || touches_corner(graph.grid(), graph.vertex(VertexId(id as u32)), reach)
        };
        Self {
            graph,
            choices,
            takes_all: (0..count).map(takes_all).collect(),
            blocked: Sums::of(graph.grid()),
            nodes: vec![None; count],
            touched: Vec::new(),
            heap: Heap::new(choices.ties, count),
        }
    }

    /// The search from start to goal; none if there is no path.
    pub(super) fn solve(&mut self, query: Ends) -> Option<Found> {
        let mut found = Found::default();
        let (start, goal) = (self.graph.id(query.start)?, self.graph.id(query.goal)?);
        // The published rule misses a path now and then: the search is made again with all moves.
        let is_found = self.search(start, goal, false, &mut found)
            || self.choices.expands != Expands::Everywhere && self.search(start, goal, true, &mut found);
        if !is_found {
            return None;
        }
        let mut at = goal;
        found.cost = self.nodes[goal.0 as usize]?.g.to_f64();
        while at != start {
            at = self.nodes[at.0 as usize]?.parent;
            found.moves += 1;
        }
        Some(found)
    }

    /// Whether a path is found.
    fn search(&mut self, start: VertexId, goal: VertexId, all: bool, found: &mut Found) -> bool {
        let goal_at = self.graph.vertex(goal);
        for id in self.touched.drain(..) {
            self.nodes[id.0 as usize] = None;
        }
        self.touched.push(start);
        self.heap.clear();
        let h = self.estimate(self.graph.vertex(start), goal_at);
        self.nodes[start.0 as usize] = Some(Node { g: Cost::ZERO, parent: start, by: 0, is_closed: false });
        self.heap.push(start, h, h);
        loop {
            let Some((id, swaps)) = self.heap.pop() else { return false };
            found.percolations += swaps;
            if id == goal {
                return true;
            }
            let Some(node) = self.nodes[id.0 as usize].as_mut() else { return false };
            node.is_closed = true;
            let node = *node;
            found.expanded += 1;
            let by = (id != start || node.g != Cost::ZERO).then_some(node.by);
            for by in self.moves(id, by, all) {
                found.percolations += self.relax(id, node.g, by, goal_at);
            }
        }
    }

    /// The moves by which a vertex is expanded that was reached by the move `by`.
    fn moves(&self, id: VertexId, by: Option<usize>, all: bool) -> Vec<usize> {
        let (graph, at, count) = (self.graph, self.graph.vertex(id), self.graph.steps().len());
        let is_legal = |by: usize| {
            let to = at + graph.step(by).vector();
            graph.sees(at, to) && (self.choices.legal == Legal::Segment || self.blocked.is_free(at, to))
        };
        let mut moves = Vec::new();
        match by.filter(|&by| !all && !self.takes_all[id.0 as usize] && is_legal(by)) {
            Some(by) if by % 2 == 1 => {
                moves.extend(
                    [(by + count - 1) % count, by, (by + 1) % count].iter().filter(|&&by| is_legal(by)),
                );
            }
            Some(by) => moves.push(by),
            None => graph.for_each_legal_move(at, |by| {
                let to = at + graph.step(by).vector();
                if self.choices.legal == Legal::Segment || self.blocked.is_free(at, to) {
                    moves.push(by);
                }
            }),
        }
        moves
    }

    /// Makes a path by one more move known. Returns the swaps of the open list.
    fn relax(&mut self, from: VertexId, g: Cost, by: usize, goal: Vertex) -> u64 {
        let step = self.graph.step(by);
        let (to, g) = (step.target(from), g + step.cost);
        let known = self.nodes[to.0 as usize];
        if known.is_some_and(|node| node.g <= g) {
            return 0;
        }
        self.nodes[to.0 as usize] = Some(Node { g, parent: from, by, is_closed: false });
        match known {
            Some(node) if !node.is_closed => self.heap.decrease(to, node.g - g),
            _ => {
                self.touched.push(to);
                let h = self.estimate(self.graph.vertex(to), goal);
                self.heap.push(to, g + h, h)
            }
        }
    }

    fn estimate(&self, from: Vertex, goal: Vertex) -> Cost {
        let to_goal = from.to(goal);
        match self.choices.estimate {
            Estimate::Hk => Hk.estimate(self.graph, to_goal),
            Estimate::Euclidean => Euclidean.estimate(self.graph, to_goal),
        }
    }
}

/// Whether a cell, or one at most `reach` cells from it, touches a convex corner of an obstacle: a grid point
/// around which one cell is blocked, or two that touch diagonally.
fn touches_corner(grid: &Grid, at: Vertex, reach: i32) -> bool {
    let blocked = |x: i32, y: i32| grid.is_blocked(x, y);
    let is_corner =
        |x: i32, y: i32| (blocked(x - 1, y - 1) || blocked(x, y)) != (blocked(x, y - 1) || blocked(x - 1, y));
    let around = |at: i32| at - reach..=at + 1 + reach;
    around(at.x).any(|x| around(at.y).any(|y| is_corner(x, y)))
}

/// The blocked cells above and to the left of each grid point.
struct Sums {
    width: usize,
    sums: Vec<u32>,
}

impl Sums {
    fn of(grid: &Grid) -> Self {
        let width = grid.width() as usize + 1;
        let mut sums = vec![0; width * (grid.height() as usize + 1)];
        for y in 1..=grid.height() as usize {
            for x in 1..width {
                let cell = u32::from(grid.is_blocked(x as i32 - 1, y as i32 - 1));
                let (above, left) = (sums[(y - 1) * width + x], sums[y * width + x - 1]);
                sums[y * width + x] = cell + above + left - sums[(y - 1) * width + x - 1];
            }
        }
        Self { width, sums }
    }

    /// Whether all cells of the rectangle with these corners are free. Both lie on the map.
    fn is_free(&self, a: Vertex, b: Vertex) -> bool {
        let at = |x: i32, y: i32| self.sums[y as usize * self.width + x as usize];
        let (left, right) = (a.x.min(b.x), a.x.max(b.x) + 1);
        let (top, bottom) = (a.y.min(b.y), a.y.max(b.y) + 1);
        at(right, bottom) + at(left, top) == at(left, bottom) + at(right, top)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use mediant_bench::Study;
    use mediant_grid::{CornerRule, PlacementKind};
    use mediant_moves::FiniteK;
    use mediant_oracle::{Rng, random_free_vertex};

    use super::*;
    use crate::setups::run;

    const ENGINE: Choices = Choices {
        estimate: Estimate::Hk,
        ties: Ties::NearerFirst,
        legal: Legal::Segment,
        expands: Expands::Everywhere,
    };

    fn graph(grid: &Arc<Grid>, k: u32) -> GridGraph<Centers> {
        GridGraph::new(Arc::clone(grid), FiniteK::new(k).unwrap(), CornerRule::Never).unwrap()
    }

    /// With the engines' choices: their expansions, swaps, moves and costs.
    #[test]
    fn it_makes_the_searches_of_the_engines() {
        let cases = [
            ("", ENGINE),
            (",euclidean", Choices { estimate: Estimate::Euclidean, ..ENGINE }),
            (",paper", Choices { expands: Expands::Corners, ..ENGINE }),
        ];
        let mut compared = 0;
        for seed in 0..6 {
            let mut rng = Rng::new(seed);
            let grid = Arc::new(Grid::from_fn(40, 30, |_, _| rng.below(100) < 12).unwrap());
            let mut vertex = || random_free_vertex(&mut rng, &grid, PlacementKind::Center).unwrap();
            let queries: Vec<Ends> = (0..12).map(|_| Ends::new(vertex(), vertex())).collect();
            for k in 2..=7 {
                for (option, choices) in cases {
                    let engine = if option == ",paper" { "canonical" } else { "astar" };
                    let setup = format!("{engine}:{k}:never{option}");
                    let engine = run(&mut Study::new(&grid, &queries, 0), &setup).unwrap();
                    let graph = graph(&grid, k);
                    let mut plain = Plain::new(&graph, choices);
                    for (&query, theirs) in queries.iter().zip(engine.answers) {
                        let case = format!("seed {seed}, {setup}, {query:?}");
                        let ours = plain.solve(query);
                        assert_eq!(ours.is_some(), theirs.is_some(), "{case}");
                        let (Some(ours), Some(theirs)) = (ours, theirs) else { continue };
                        let counters = theirs.counters;
                        assert_eq!(ours.expanded, counters.expanded, "{case}");
                        assert_eq!(ours.percolations, counters.percolations, "{case}");
                        assert_eq!(ours.moves, theirs.moves, "{case}");
                        assert!((ours.cost - theirs.cost).abs() < 1e-6, "{case}");
                        compared += 1;
                    }
                }
            }
        }
        assert!(compared > 1000, "{compared}");
    }

    #[test]
    fn other_choices_are_other_searches() {
        let grid = Arc::new(Grid::from_fn(6, 3, |x, y| (x, y) == (2, 0)).unwrap());
        let graph = graph(&grid, 4);
        let moves = |choices| Plain::new(&graph, choices).solve(Ends::new((0, 0), (2, 1))).unwrap().moves;
        // The knight's move touches free cells alone, but the rectangle around it holds the blocked one.
        assert_eq!((moves(ENGINE), moves(Choices { legal: Legal::Rectangle, ..ENGINE })), (1, 2));
        let blocked = Sums::of(&grid);
        let is_free = |a: (i32, i32), b: (i32, i32)| blocked.is_free(a.into(), b.into());
        assert!(is_free((2, 2), (0, 1)) && !is_free((0, 1), (3, 0)) && !is_free((2, 0), (2, 0)));
        // Below the blocked cell, and farther to the right.
        let touches = |x, reach| touches_corner(&grid, Vertex::new(x, 1), reach);
        assert_eq!([touches(3, 0), touches(4, 0), touches(4, 1), touches(5, 1)], [true, false, true, false]);
    }

    /// On open ground at k = 2 all paths that lead nearer have the same f: the nearer vertex first goes
    /// straight. A heap that compares f alone swaps less.
    #[test]
    fn ties_decide_on_open_ground() {
        let grid = Arc::new(Grid::from_fn(9, 9, |_, _| false).unwrap());
        let graph = graph(&grid, 2);
        let query = Ends::new((0, 0), (8, 8));
        let of = |ties| Plain::new(&graph, Choices { ties, ..ENGINE }).solve(query).unwrap();
        let (nearer, alone) = (of(Ties::NearerFirst), of(Ties::Unordered));
        assert_eq!(nearer.expanded, 16);
        let swaps = |found: Found| found.percolations as f64 / found.expanded as f64;
        assert!(swaps(alone) < swaps(nearer), "{alone:?}, {nearer:?}");
        assert!([nearer, alone].iter().all(|found| found.cost == 16.0 && found.moves == 16));
    }
}
