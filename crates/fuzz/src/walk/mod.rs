//! Programs on maps to walk on: queries with wishes, limits and steps, tables, and fields to and from
//! sources. Each answer is held to times in floating point from the ground below each move.

mod known;

use std::fmt::Write as _;

use mediant::{
    Answer, CornerRule, Engine, FiniteK, Index, Limit, Limits, Motion, Pace, Path, Planner, Query, Rules,
    Space, Vertex,
};
use mediant_grid::Grid;
use mediant_oracle::WeightedMap;

use self::known::{FRICTION, Known, ROOM};
use crate::{bytes::Bytes, costs::KS, sequence::NthLook};

/// The most operations of a program.
const MOST: usize = 8;

struct Run {
    space: Space,
    index: Index,
    planner: Planner,
    known: Known,
    text: String,
}

/// A map, elevations, a pace, an engine, and operations.
pub(crate) fn run(bytes: &mut Bytes<'_>) {
    let known = known(bytes);
    let engine = [Engine::AStar, Engine::Dijkstra][bytes.below(2)];
    let (map, grid) = (&known.map, known.map.grid());
    let text = format!("{engine}, {}, k = {}\n{map}\n{:?}", known.rules, known.k, known.elevations);
    let text = format!("{text}, {:?}, cells of {:?}\n", known.pace, map.cell_size());
    let width = grid.width();
    let ground = |x: u32, y: u32| {
        let friction = f64::from(map.weight(x as i32, y as i32).unwrap_or(1) - 1) * FRICTION;
        (known.elevations[(y * width + x) as usize], friction)
    };
    let walking =
        mediant::Map::from(grid.clone()).walking_by(map.cell_size(), &known.pace, Limits::new(), ground);
    let walking = walking.unwrap_or_else(|error| panic!("{error}\n{text}"));
    let space = walking.space(Motion::new(known.k, known.rules));
    let space = space.unwrap_or_else(|error| panic!("{error}\n{text}"));
    let index = space.prepare(engine).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let planner = index.planner();
    let mut run = Run { space, index, planner, known, text };
    for _ in 0..MOST {
        if bytes.is_empty() || run.known.free().is_empty() {
            return;
        }
        run.operation(bytes);
    }
}

/// A map of up to 5 × 4 cells with elevations that differ by less than their width, or by some widths.
fn known(bytes: &mut Bytes<'_>) -> Known {
    let (width, height) = (1 + bytes.below(5) as u32, 1 + bytes.below(4) as u32);
    let cell_size = [(1.0, 1.0), (10.0, 10.0), (10.0, 20.0), (3.5, 1.5)][bytes.below(4)];
    let scale = [0.0, 0.01, 0.125, 1.0][bytes.below(4)];
    let rule = CornerRule::ALL[bytes.below(CornerRule::ALL.len())];
    let k = FiniteK::new(KS[bytes.below(KS.len())]).expect("a k");
    let pace = match bytes.below(4) {
        0 => Pace::Tobler,
        1 => Pace::Langmuir(mediant::Langmuir::default()),
        2 => Pace::Table(vec![(-1.0, 2.0), (0.0, 0.5), (2.0, 4.0)]),
        _ => Pace::Table(vec![(-0.9, 3.0), (-0.31, 0.9), (-0.05, 0.4), (0.03, 0.5), (0.8, 7.0)]),
    };
    let cells: Vec<(u8, u8)> = (0..width * height).map(|_| (bytes.byte(), bytes.byte())).collect();
    let of = |x: u32, y: u32| cells[(y * width + x) as usize];
    let grid = Grid::from_fn(width, height, |x, y| of(x, y).1 >= 208).expect("a small map");
    let map = WeightedMap::from_fn(grid, |x, y| [1, 1, 2, 9][usize::from(of(x, y).1 % 4)]);
    let elevations = cells.iter().map(|&(elevation, _)| f64::from(elevation) * scale).collect();
    let map = map.with_cell_size(cell_size.0, cell_size.1);
    Known::new(map, elevations, pace, Rules::Center(rule), k)
}

impl Run {
    fn say(&mut self, text: &str) {
        let _ = writeln!(self.text, "{text}");
    }

    fn check(&self, holds: bool, message: impl FnOnce() -> String) {
        assert!(holds, "{}\n{}", message(), self.text);
    }

    fn ends(&self, bytes: &mut Bytes<'_>, most: usize) -> Vec<Vertex> {
        let free = self.known.free();
        (0..1 + bytes.below(most)).map(|_| free[bytes.below(free.len())]).collect()
    }

    fn operation(&mut self, bytes: &mut Bytes<'_>) {
        match bytes.below(6) {
            0 => self.fields(bytes),
            1 => self.table(bytes),
            _ => self.path(bytes),
        }
    }

    fn is_same(found: Option<f64>, expected: Option<f64>) -> bool {
        match (found, expected) {
            (Some(found), Some(expected)) => (found - expected).abs() <= ROOM * expected,
            (found, expected) => found == expected,
        }
    }

    fn least(&self, starts: &[Vertex], goals: &[Vertex]) -> Option<f64> {
        let pairs = starts.iter().flat_map(|&from| goals.iter().map(move |&to| (from, to)));
        pairs.filter_map(|(from, to)| self.known.least(from, to)).min_by(f64::total_cmp)
    }

    fn check_legal(&self, path: &Path) {
        let (told, along) = (self.space.cost(path), self.known.time_along(path));
        self.check(told == Some(path.cost()), || format!("{path} takes {}, then {told:?}", path.cost()));
        let is_same = Self::is_same(Some(path.cost()), along);
        self.check(is_same, || format!("{path} takes {}, not {along:?}", path.cost()));
        self.check(self.space.check(path).is_ok(), || format!("{path} is not legal, it is said"));
    }

    /// Several ends, a tolerance, and a limit; the same in steps.
    fn path(&mut self, bytes: &mut Bytes<'_>) {
        let (starts, goals) = (self.ends(bytes, 2), self.ends(bytes, 3));
        let tolerance = f64::from([0, 0, 1, 3][bytes.below(4)]) / 2.0;
        let reach = tolerance * (1.0 + 1e-9);
        let free = self.known.free().into_iter();
        let near = free.filter(|at| goals.iter().any(|goal| at.distance(*goal) <= reach)).collect::<Vec<_>>();
        let least = self.least(&starts, &near);
        let (what, number) = (bytes.below(6), bytes.byte());
        let most = least.unwrap_or(9.0) * [1.0 + 1e-4, 1.0 - 1e-4, 0.5, 2.0][usize::from(number % 4)];
        let look = NthLook::new(&mut Bytes::new(&[number]));
        let (limits, by) = match what {
            0 => (Limits::new().cost(most), Some(Limit::Cost)),
            1 => (Limits::new().expansions(u64::from(number % 24)), Some(Limit::Expansions)),
            2 => (look.limits(), Some(Limit::Timeout)),
            _ => (Limits::new(), None),
        };
        self.say(&format!("path {starts:?} {goals:?}, tolerance {tolerance}, within {limits:?} {number}"));
        let query = Query::between(starts.clone(), goals).tolerance(tolerance).within(limits);
        let answer =
            self.planner.find(query.clone()).unwrap_or_else(|error| panic!("{error}\n{}", self.text));
        self.check_answer(&answer, &starts, (least, most, by));
        if by != Some(Limit::Timeout) {
            self.planner.begin(query).unwrap_or_else(|error| panic!("{error}\n{}", self.text));
            let step = 1 + u64::from(number % 5);
            let in_steps = loop {
                if let Some(answer) = self.planner.step(step).expect("it was begun") {
                    break answer;
                }
            };
            self.check(in_steps == answer, || format!("{in_steps:?} in steps of {step}, not {answer:?}"));
        }
    }

    fn check_answer(
        &self,
        answer: &Answer,
        starts: &[Vertex],
        (least, most, by): (Option<f64>, f64, Option<Limit>),
    ) {
        match answer {
            Answer::Found(path) => {
                self.check_legal(path);
                let is_least = Self::is_same(Some(path.cost()), least);
                self.check(is_least, || format!("{path} takes {}, not {least:?}", path.cost()));
                let is_within = by != Some(Limit::Cost) || path.cost() <= most * (1.0 + ROOM);
                self.check(is_within, || format!("{path} takes {}, more than {most}", path.cost()));
            }
            Answer::Stopped(stopped) => {
                self.check(Some(stopped.by) == by, || format!("{stopped:?}"));
                self.check_legal(&stopped.best);
                let is_from_start = stopped.best.waypoints().first().is_some_and(|at| starts.contains(at));
                self.check(is_from_start, || format!("{}", stopped.best));
                let Some(least) = least else { return };
                self.check(stopped.lower_bound <= least * (1.0 + ROOM), || format!("{stopped:?}, {least}"));
                let is_beyond = by != Some(Limit::Cost) || least > most * (1.0 - ROOM);
                self.check(is_beyond, || format!("{least} is within {most}"));
            }
            answer => self.check(least.is_none(), || format!("{answer:?}, but {least:?} leads there")),
        }
    }

    /// The times to the nearest of some sources, and from it.
    fn fields(&mut self, bytes: &mut Bytes<'_>) {
        let sources = self.ends(bytes, 2);
        self.say(&format!("fields {sources:?}"));
        let to = self.space.field(sources.iter().copied()).expect("free sources");
        let from = self.space.field_from(sources.iter().copied()).expect("free sources");
        for at in self.known.free() {
            for (field, least) in [(&to, self.least(&[at], &sources)), (&from, self.least(&sources, &[at]))] {
                let found = field.get(at);
                self.check(Self::is_same(found, least), || format!("{at}: {found:?}, not {least:?}"));
            }
            let exact = sources.iter().filter_map(|&source| self.time(source, at)).min_by(f64::total_cmp);
            self.check(exact == from.get(at), || {
                format!("{at}: {:?}, but a path takes {exact:?}", from.get(at))
            });
        }
    }

    /// The time of the path that another planner finds.
    fn time(&self, from: Vertex, to: Vertex) -> Option<f64> {
        let path = self.space.path(from, to).unwrap_or_else(|error| panic!("{error}\n{}", self.text));
        path.map(|path| path.cost())
    }

    fn table(&mut self, bytes: &mut Bytes<'_>) {
        let (starts, goals) = (self.ends(bytes, 3), self.ends(bytes, 3));
        self.say(&format!("table {starts:?} {goals:?}"));
        let table = self.index.table(starts.iter().copied(), goals.iter().copied()).expect("free ends");
        for (row, &start) in starts.iter().enumerate() {
            for (&found, &goal) in table.row(row).iter().zip(&goals) {
                let (found, least) =
                    (Some(found).filter(|time| time.is_finite()), self.known.least(start, goal));
                self.check(Self::is_same(found, least), || {
                    format!("{start} to {goal}: {found:?}, not {least:?}")
                });
            }
        }
    }
}
