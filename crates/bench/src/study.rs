//! Studies: the answers, counts and times of setups on the queries of one map.

use std::{hint::black_box, sync::Arc, time::Instant};

use mediant::{Error, Index, Map, Planner, Setup, Space};
use mediant_grid::{Grid, Vertex};
use mediant_report::stats::median;
use mediant_search::{Answer, Counters, Ends, Path};

use crate::Preparation;

/// The queries of a map, to be answered by several setups one after the other.
#[derive(Debug)]
pub struct Study<'a> {
    grid: &'a Arc<Grid>,
    queries: &'a [Ends],
    passes: u32,
    /// The last space: setups of the same k and rules share it, if they search the same of it.
    space: Option<ReadySpace>,
    /// The last index, and the seconds that it took.
    index: Option<(Index, f64)>,
}

/// A space in which what an engine searches is made.
#[derive(Debug)]
struct ReadySpace {
    space: Space,
    /// Whether that is the grid graph.
    has_grid_graph: bool,
    seconds: f64,
}

impl ReadySpace {
    fn new(map: &Map, setup: Setup) -> Result<Self, Error> {
        let begin = Instant::now();
        let space = setup.space(map)?;
        space.make_ready(setup.engine)?;
        let seconds = begin.elapsed().as_secs_f64();
        Ok(Self { space, has_grid_graph: setup.capabilities().grid_graph, seconds })
    }

    fn serves(&self, setup: Setup) -> bool {
        self.space.motion() == setup.motion && self.has_grid_graph == setup.capabilities().grid_graph
    }
}

/// The answers of a setup to the queries of a [`Study`], and their time.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// The answers, in the order of the queries. `None` where there is no path, or none was found.
    pub answers: Vec<Option<PathFigures>>,
    /// The mean time of a query in microseconds, paths included: the median of the timed passes. `None` if no
    /// pass was timed.
    pub micros: Option<f64>,
    /// The preparation before the first query; its time was measured once.
    pub preparation: Preparation,
}

/// One path, and the counts of the search that found it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathFigures {
    /// Its Euclidean length in cells.
    pub cost: f64,
    /// The number of its moves, if it is a path over N(k).
    pub moves: u32,
    /// The number of its waypoints, with both ends.
    pub waypoints: u32,
    /// The sum of its turning angles in degrees: PS of Hammoud & Lupin 2023, Eq. 1.
    pub smoothness: f64,
    /// The counts of the search.
    pub counters: Counters,
}

impl PathFigures {
    fn new(path: &Path, counters: Counters) -> Self {
        let step = |ends: &[Vertex]| ends[0].to(ends[1]).gcd();
        let moves = path.waypoints().windows(2).map(step).sum();
        let waypoints = u32::try_from(path.waypoints().len()).unwrap_or(u32::MAX);
        Self { cost: path.cost(), moves, waypoints, smoothness: path.smoothness(), counters }
    }
}

impl<'a> Study<'a> {
    /// A study whose runs have so many timed passes, or none.
    #[must_use]
    pub const fn new(grid: &'a Arc<Grid>, queries: &'a [Ends], passes: u32) -> Self {
        Self { grid, queries, passes, space: None, index: None }
    }

    /// The queries.
    #[must_use]
    pub const fn queries(&self) -> &'a [Ends] {
        self.queries
    }

    /// Answers all queries by a setup: once to count, which also warms its memory, then in the timed passes.
    ///
    /// A setup of the same engine, k, rules and levels as the one before it, smoothed in another way, takes
    /// over its index.
    ///
    /// # Errors
    /// [`Error`] for a setup that does not exist.
    pub fn run(&mut self, setup: Setup) -> Result<Run, Error> {
        let (mut planner, preparation) = self.planner(setup)?;
        let answer = |query: &Ends| match planner.find_counted(*query) {
            Ok((Answer::Found(path), counters)) => Some(PathFigures::new(&path, counters)),
            // A query with a blocked end, or one at which CHPA* as published gives up.
            Ok(_) | Err(_) => None,
        };
        let answers: Vec<Option<PathFigures>> = self.queries.iter().map(answer).collect();
        let mut pass = || {
            let begin = Instant::now();
            for query in self.queries {
                let _ = black_box(planner.find(black_box(*query)));
            }
            begin.elapsed().as_secs_f64() * 1e6 / self.queries.len().max(1) as f64
        };
        let passes: Vec<f64> = (0..self.passes).map(|_| pass()).collect();
        Ok(Run { answers, micros: median(&passes), preparation })
    }

    fn planner(&mut self, setup: Setup) -> Result<(Planner, Preparation), Error> {
        setup.check()?;
        let ready = match self.space.take() {
            Some(ready) if ready.serves(setup) => ready,
            _ => {
                // Whatever was prepared in another space is not for this one.
                self.index = None;
                ReadySpace::new(&Map::from(Arc::clone(self.grid)), setup)?
            }
        };
        let ReadySpace { space, seconds: space_seconds, .. } = self.space.insert(ready);
        let unsmoothed = Setup { smoothing: None, ..setup };
        let index = match self.index.take() {
            Some((index, seconds)) if index.setup() == unsmoothed => (index, seconds),
            _ => {
                let begin = Instant::now();
                (unsmoothed.prepare(space)?, begin.elapsed().as_secs_f64())
            }
        };
        let (index, index_seconds) = self.index.insert(index);
        let preparation = Preparation::of(space, index, *space_seconds + *index_seconds);
        Ok((index.clone().with_smoothing(setup.smoothing).planner(), preparation))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn setup(text: &str) -> Setup {
        text.parse().expect("a setup")
    }

    /// A wall with a way around, and a cell that none leads to.
    fn grid() -> Arc<Grid> {
        let walls = ["......#.", ".####.##", "........", "........"];
        let blocked = |x: u32, y: u32| walls[y as usize].as_bytes()[x as usize] == b'#';
        Arc::new(Grid::from_fn(8, 4, blocked).expect("a grid"))
    }

    #[test]
    fn answers_are_those_of_a_planner_with_its_counts() {
        let grid = grid();
        let queries =
            [((0, 0), (5, 0)), ((0, 0), (0, 3)), ((0, 0), (7, 0)), ((1, 1), (0, 0)), ((2, 0), (4, 2))];
        let queries = queries.map(|(start, goal)| Ends::new(start, goal));
        let mut study = Study::new(&grid, &queries, 0);
        // The second shares the first one's space, the fourth the third one's index, the last neither.
        for text in [
            "astar:4:never",
            "canonical:4:never",
            "subgoal:5:open",
            "subgoal:5:open,taut",
            "jps-plus:3:never",
        ] {
            let run = study.run(setup(text)).expect("a run");
            let ReadySpace { space, .. } =
                ReadySpace::new(&Map::from(Arc::clone(&grid)), setup(text)).expect("a space");
            let index = setup(text).prepare(&space).expect("an index");
            let mut planner = index.planner();
            for (query, answer) in queries.iter().zip(&run.answers) {
                let Ok((Answer::Found(path), counters)) = planner.find_counted(*query) else {
                    assert_eq!(*answer, None, "{text}");
                    continue;
                };
                let answer = answer.expect("a path");
                assert_eq!((answer.cost, answer.counters), (path.cost(), counters), "{text}");
                assert_eq!(answer.waypoints as usize, path.waypoints().len(), "{text}");
            }
            assert_eq!(run.micros, None);
            let bytes = space.memory_bytes() + index.memory_bytes();
            assert_eq!(run.preparation.bytes, bytes, "{text}");
            assert!(run.preparation.seconds > 0.0);
        }
    }

    #[test]
    fn moves_are_counted_one_by_one() {
        let grid = Arc::new(Grid::from_fn(9, 5, |_, _| false).expect("a grid"));
        let queries = [Ends::new((0, 0), (8, 4)), Ends::new((0, 0), (7, 3)), Ends::new((2, 2), (2, 2))];
        let mut study = Study::new(&grid, &queries, 2);
        let mut moves = |text: &str| {
            let run = study.run(setup(text)).expect("a run");
            assert!(run.micros.is_some_and(|micros| micros > 0.0), "two passes were timed");
            run.answers.iter().map(|answer| answer.map(|answer| answer.moves)).collect::<Vec<_>>()
        };
        assert_eq!(moves("astar:2:never"), [Some(12), Some(10), Some(0)]);
        assert_eq!(moves("astar:3:never"), [Some(8), Some(7), Some(0)]);
        // (8, 4) is four moves (2, 1), (7, 3) three of them and (1, 0).
        assert_eq!(moves("astar:4:never"), [Some(4), Some(4), Some(0)]);
    }
}
