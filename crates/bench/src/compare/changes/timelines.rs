//! Part 1: single cells change, and paths are asked for between the edits.

use std::time::Instant;

use mediant::{Engine, Index, Map, Motion, Setup, Space};
use mediant_grid::{DiagonalGap, Rules, Vertex, sight::line_of_sight_under};
use mediant_moves::K;
use mediant_oracle::Rng;
use mediant_report::{Row, stats::median};
use mediant_search::Ends;

use super::{
    EDITS, PASSES, Part,
    contestant::{Contestant, Follower},
    text,
};
use crate::{Baseline, compare::CompareError};

/// A motion of the study, and the engines that are asked: all of them find shortest paths.
struct Race {
    motion: Motion,
    engines: &'static [Engine],
    baselines: &'static [Baseline],
}

/// The largest map on which A\* and its kin are timed at every motion: on larger ones they are far behind.
const LARGE: u32 = 1 << 20;

/// The largest map on which many paths are asked for.
const MANY_QUERIES: u32 = 300_000;

fn races(is_large: bool) -> Vec<Race> {
    use Engine as E;
    let race = |motion: Motion, engines| Race { motion, engines, baselines: &[] };
    let mut races = vec![
        Race {
            motion: Motion::centers(K::N8),
            engines: &[E::AStar, E::Canonical, E::Jps, E::JpsBlock, E::JpsPlus, E::Subgoal],
            baselines: &Baseline::ALL,
        },
        race(Motion::corners(K::ANY), &[E::Anya, E::Subgoal]),
    ];
    if !is_large {
        races.extend([
            race(Motion::centers(K::N4), &[E::Canonical, E::JpsBlock, E::JpsPlus, E::Subgoal]),
            race(Motion::centers(K::N16), &[E::AStar, E::Canonical, E::Jps]),
            race(Motion::corners(K::N8), &[E::Canonical, E::JpsBlock, E::JpsPlus, E::Anya, E::Subgoal]),
            race(Motion::corners(K::N16), &[E::Jps, E::Anya, E::Subgoal]),
        ]);
    }
    races
}

/// The edits of a pass, and the paths that are asked for after some of them.
struct Script {
    edits: Vec<(Vertex, bool)>,
    queries: Vec<Vec<Ends>>,
}

impl Script {
    /// Random cells become what they were not; random ends have a path between them.
    fn new(mut space: Space, rng: &mut Rng, queries: usize) -> Result<Self, CompareError> {
        let mut script = Self { edits: Vec::new(), queries: Vec::new() };
        let [width, height] = [space.map().width(), space.map().height()];
        for edit in 0..EDITS {
            let at = Vertex::from((rng.below(width) as i32, rng.below(height) as i32));
            let blocked = space.map().is_free(at);
            space = space.edit_cells([(at, blocked)])?.after().clone();
            script.edits.push((at, blocked));
            // In the middle of each eight edits, so that the mean is that of the chain.
            let count = if edit % 8 == 4 { queries } else { 0 };
            script.queries.push((0..count).map(|_| connected_ends(&space, rng)).collect());
        }
        Ok(script)
    }
}

/// Two random vertices with a path between them.
pub(super) fn connected_ends(space: &Space, rng: &mut Rng) -> Ends {
    let [width, height] = [space.map().width(), space.map().height()];
    loop {
        let [start, goal] =
            [(); 2].map(|()| Vertex::from((rng.below(width) as i32, rng.below(height) as i32)));
        if start != goal && space.is_free(start) && space.is_free(goal) && space.connected(start, goal) {
            return Ends::new(start, goal);
        }
    }
}

/// A contestant with its name and its times.
struct Timed {
    name: String,
    contestant: Contestant,
    /// Where it begins anew in each pass, if labels do: the time of these, and of the first edit after them.
    start: Option<(Index, f64)>,
    prepared: Option<f64>,
    edits: Vec<f64>,
    queries: Vec<f64>,
    /// Answers that labels of an earlier map have proven, and those that they could have.
    proven: [u32; 2],
}

fn micros(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e6
}

impl Timed {
    fn engine(map: &Map, setup: Setup) -> Result<Self, CompareError> {
        let space = setup.space(map)?;
        space.make_ready(setup.engine)?;
        let begin = Instant::now();
        let follower = Follower::new(map, setup)?;
        let prepared = micros(begin);
        let start = (setup.engine.kind() == Engine::Subgoal).then(|| (follower.index.clone(), prepared));
        let contestant = Contestant::Engine(Box::new(follower));
        Ok(Self { start, prepared: Some(prepared), ..Self::new(setup.engine.kind().to_string(), contestant) })
    }

    fn new(name: String, contestant: Contestant) -> Self {
        let (edits, queries) = (Vec::new(), Vec::new());
        Self { name, contestant, start: None, prepared: None, edits, queries, proven: [0; 2] }
    }

    /// Plays the script once, and goes back to its beginning. Returns the length of all paths.
    fn pass(&mut self, script: &Script, is_timed: bool) -> Result<f64, CompareError> {
        let [mut edits, mut queries, mut length] = [0.0; 3];
        let mut first = None;
        for (&(at, blocked), ends) in script.edits.iter().zip(&script.queries) {
            let begin = Instant::now();
            self.contestant.set(at, blocked)?;
            let time = micros(begin);
            // The first edit of labels prepares the other engine.
            if self.start.is_some() && first.is_none() {
                first = Some(time);
            } else {
                edits += time;
            }
            let begin = Instant::now();
            for &ends in ends {
                length += self.contestant.solve(ends)?.unwrap_or_default();
                if let Some(is_proven) = self.contestant.is_proven() {
                    self.proven[0] += u32::from(is_proven);
                    self.proven[1] += 1;
                }
            }
            queries += micros(begin);
        }
        if is_timed {
            self.edits.push(edits / (script.edits.len() - usize::from(first.is_some())) as f64);
            self.queries.push(queries / script.queries.iter().flatten().count() as f64);
        } else if let (Some((_, time)), Some(first)) = (&mut self.start, first) {
            *time += first;
        }
        match (&self.start, &mut self.contestant) {
            (Some((index, _)), Contestant::Engine(engine)) => engine.go_to(index)?,
            _ => {
                for &(at, blocked) in script.edits.iter().rev() {
                    self.contestant.set(at, !blocked)?;
                }
            }
        }
        Ok(length)
    }

    fn row(&self, row: Row) -> Row {
        let [proven, asked] = self.proven.map(f64::from);
        row.key("engine", &self.name)
            .with("edit", median(&self.edits))
            .with("query", median(&self.queries))
            .with("finish", self.start.as_ref().map(|(_, time)| *time))
            .with("prepared", self.prepared)
            .with("proven", (asked > 0.0).then(|| 100.0 * proven / asked))
    }
}

/// The convex corners of blocked cells, by the cells of the map.
fn corners(map: &Map) -> f64 {
    let is_corner = |&(x, y): &(i32, i32)| {
        let around = [(x - 1, y - 1), (x, y - 1), (x - 1, y), (x, y)];
        around.into_iter().filter(|&cell| map.is_blocked(cell)).count() == 1
    };
    let [width, height] = [map.width(), map.height()].map(|side| side as i32);
    let vertices = (1..height).flat_map(|y| (1..width).map(move |x| (x, y)));
    vertices.filter(is_corner).count() as f64 / (f64::from(width) * f64::from(height))
}

/// Of the free cells, those from which a straight line to 16 columns and 5 rows beyond is free.
fn lines(map: &Map) -> f64 {
    let [width, height] = [map.width(), map.height()].map(|side| side as i32);
    let cells = (0..height).flat_map(|y| (0..width).map(move |x| Vertex::new(x, y)));
    let open = Rules::Corner(DiagonalGap::Open);
    let is_seen = |&Vertex { x, y }: &Vertex| {
        line_of_sight_under(map.grid(), open, (x, y).into(), (x + 16, y + 5).into())
    };
    let free: Vec<Vertex> = cells.filter(|&at| map.is_free(at)).collect();
    free.iter().filter(|at| is_seen(at)).count() as f64 / free.len().max(1) as f64
}

/// The rows of a map.
pub(super) fn measure(name: &str, map: &Map) -> Result<Vec<Row>, CompareError> {
    let cells = map.width() * map.height();
    let mut rows = Vec::new();
    for Race { motion, engines, baselines } in races(cells > LARGE) {
        let mut all = Vec::new();
        for &engine in engines {
            all.push(Timed::engine(map, Setup::new(engine, motion))?);
        }
        for &baseline in baselines {
            all.push(Timed::new(baseline.name().to_owned(), Contestant::baseline(map, baseline)));
        }
        let queries = if cells > MANY_QUERIES { 6 } else { 20 };
        let script = Script::new(map.space(motion)?, &mut Rng::new(super::SEED), queries)?;
        let mut expected = None;
        for round in 0..=PASSES {
            for timed in &mut all {
                // Other crates take too long there.
                if cells > LARGE && round > 1 && timed.prepared.is_none() {
                    continue;
                }
                // The first pass warms the memory.
                let found = timed.pass(&script, round > 0)?;
                let expected = *expected.get_or_insert(found);
                let solves_another = timed.name == Baseline::GridPathfinding.name();
                if !solves_another && (found - expected).abs() > 1e-9 * expected {
                    let (engine, map) = (format!("{}, {motion}", timed.name), name.to_owned());
                    return Err(CompareError::Lengths { engine, map, expected, found });
                }
            }
        }
        let row = || {
            let row = Part::Timelines.row(name, map).key("motion", text(motion));
            row.with("corners", corners(map)).with("lines", lines(map))
        };
        rows.extend(all.iter().map(|timed| timed.row(row())));
    }
    Ok(rows)
}
