//! Queries, and what their answers must be.

use std::sync::{Arc, atomic::AtomicBool};

use mediant::{
    Answer, ErrorCode, Exceptions, Field, Guarantee, K, Limit, Limits, Path, Point, Query, Rules, Vertex,
    errors::QueryError,
};

use super::{
    Run,
    known::{self, Known, ROOM},
};
use crate::bytes::Bytes;

/// The parts of a cell in which points are kept.
const PARTS: i64 = 1024;

fn vertex(point: Option<Point>) -> Option<Vertex> {
    point.and_then(Point::vertex)
}

impl Run {
    /// A vertex on the map, or in one of eight just outside.
    pub(super) fn vertex(&self, bytes: &mut Bytes<'_>) -> Vertex {
        let (width, height) = self.known.size();
        let at = Vertex::new(bytes.below(width as usize) as i32, bytes.below(height as usize) as i32);
        if bytes.byte() >= 224 { Vertex::new(at.x - width, at.y) } else { at }
    }

    /// Some free vertices; none if there is none.
    pub(super) fn free(&self, bytes: &mut Bytes<'_>, most: usize) -> Vec<Vertex> {
        let free = self.known.free();
        if free.is_empty() {
            return Vec::new();
        }
        let count = 1 + bytes.below(most);
        (0..count).map(|_| free[bytes.below(free.len())]).collect()
    }

    pub(super) fn guarantee(&self) -> Guarantee {
        self.planner.guarantee()
    }

    /// Checks a path that was found between some of these ends.
    pub(super) fn check_path(&mut self, path: &Path, pairs: &[(Vertex, Vertex)]) {
        let ends = vertex(path.start()).zip(vertex(path.goal()));
        self.check(ends.is_some_and(|ends| pairs.contains(&ends)), || format!("{path}: other ends"));
        self.check(self.known.holds(path), || format!("{path} is not legal"));
        self.check(self.space.check(path).is_ok(), || format!("{path} is not legal, it is said"));
        let fits = self.known.fits(self.guarantee(), path.cost(), pairs);
        self.check(fits, || format!("{path} costs {}", path.cost()));
        self.path = Some(path.clone());
    }

    /// Checks an answer without limits between some of these ends, which are free.
    pub(super) fn check_answer(&mut self, answer: Result<Answer, QueryError>, pairs: &[(Vertex, Vertex)]) {
        let is_reachable = pairs.iter().any(|&(from, to)| self.known.cost(from, to).is_some());
        match answer {
            Ok(Answer::Found(path)) => self.check_path(&path, pairs),
            Ok(Answer::Unreachable) => self.check(!is_reachable, || "there is a path".to_owned()),
            // Its windows do not recognize all obstacles.
            Err(QueryError::GaveUp { .. }) => {
                let may = matches!(self.guarantee(), Guarantee::Suboptimal | Guarantee::AtMost(_));
                self.check(may, || "it gave up".to_owned());
            }
            other => self.check(false, || format!("{other:?}")),
        }
    }

    /// A plain query, also with ends that are blocked or outside the map, at once and in steps.
    pub(super) fn path(&mut self, bytes: &mut Bytes<'_>) {
        let (start, goal) = (self.vertex(bytes), self.vertex(bytes));
        self.say(&format!("path {start} {goal}"));
        let answer = self.planner.find(Query::new(start, goal));
        if !self.known.is_free(start) || !self.known.is_free(goal) {
            return self.check(answer.is_err(), || format!("{answer:?}, though an end is not free"));
        }
        self.check_answer(answer.clone(), &[(start, goal)]);
        let expansions = u64::from(1 + bytes.byte() % 7);
        self.say(&format!("in steps of {expansions}"));
        self.planner.begin(Query::new(start, goal)).expect("free ends");
        let in_steps = loop {
            match self.planner.step(expansions) {
                Ok(None) => {}
                Ok(Some(answer)) => break Ok(answer),
                Err(error) => break Err(error),
            }
        };
        self.check(in_steps == answer, || format!("{in_steps:?}, not {answer:?}"));
    }

    pub(super) fn several_ends(&mut self, bytes: &mut Bytes<'_>) {
        let (starts, goals) = (self.free(bytes, 3), self.free(bytes, 3));
        if starts.is_empty() {
            return;
        }
        self.say(&format!("path {starts:?} {goals:?}"));
        let pairs: Vec<_> = starts.iter().flat_map(|&from| goals.iter().map(move |&to| (from, to))).collect();
        let answer = self.planner.find(Query::between(starts, goals));
        self.check_answer(answer, &pairs);
    }

    /// The way to what is nearest to a goal that cannot be reached.
    pub(super) fn nearest(&mut self, bytes: &mut Bytes<'_>) {
        let ends = self.free(bytes, 1).into_iter().next().zip(Some(self.vertex(bytes)));
        let Some((start, goal)) = ends.filter(|&(_, goal)| self.known.is_free(goal)) else { return };
        self.say(&format!("nearest {start} {goal}"));
        match self.planner.find(Query::new(start, goal).nearest()) {
            Ok(Answer::Nearest(path)) => {
                self.check(self.known.cost(start, goal).is_none(), || "there is a path".to_owned());
                let reached = self.known.free().into_iter();
                let reached = reached.filter(|&at| self.known.cost(start, at).is_some());
                let least = reached.map(|at| self.known.distance(at, goal.into())).min();
                let Some(end) = vertex(path.goal()) else {
                    return self.check(false, || "no path".to_owned());
                };
                let found = Some(self.known.distance(end, goal.into()));
                self.check(found == least, || format!("{end} is not the nearest"));
                self.check_path(&path, &[(start, end)]);
            }
            answer => self.check_answer(answer, &[(start, goal)]),
        }
    }

    /// A goal counts as reached anywhere near it.
    pub(super) fn tolerance(&mut self, bytes: &mut Bytes<'_>) {
        let ends = self.free(bytes, 1).into_iter().next().zip(self.free(bytes, 1).into_iter().next());
        let Some((start, goal)) = ends else { return };
        let cells = f64::from(bytes.byte() % 8) / 2.0;
        self.say(&format!("path {start} {goal}, tolerance {cells}"));
        let near = self.known.free().into_iter().filter(|at| at.distance(goal) <= cells * (1.0 + 1e-9));
        let pairs: Vec<_> = near.map(|at| (start, at)).collect();
        let answer = self.planner.find(Query::new(start, goal).tolerance(cells));
        self.check_answer(answer, &pairs);
    }

    /// Limits on the cost and on expansions, and a flag that is set.
    pub(super) fn limits(&mut self, bytes: &mut Bytes<'_>) {
        let ends = self.free(bytes, 1).into_iter().next().zip(self.free(bytes, 1).into_iter().next());
        let Some((start, goal)) = ends else { return };
        let least = self.known.cost(start, goal);
        let (what, number) = (bytes.below(3), bytes.byte());
        let limit = least.unwrap_or(3.0) * [1.0, 1.0 - 1e-6, 1.0 + 1e-6, 0.5][usize::from(number) % 4];
        let limits = match what {
            0 => Limits::new().cost(limit),
            1 => Limits::new().expansions(u64::from(number % 32)),
            _ => Limits::new().cancel(Arc::new(AtomicBool::new(true))),
        };
        self.say(&format!("path {start} {goal} within {limits:?} ({limit})"));
        let is_optimal = matches!(self.guarantee(), Guarantee::Optimal(_) | Guarantee::OptimalAnyAngle);
        match self.planner.find(Query::new(start, goal).within(limits)) {
            Ok(Answer::Stopped(stopped)) => {
                let by = [Limit::Cost, Limit::Expansions, Limit::Cancelled][what];
                self.check(stopped.by == by, || format!("{stopped:?}"));
                let bound = stopped.lower_bound;
                if let Some(least) = least.filter(|_| is_optimal) {
                    self.check(bound <= least * (1.0 + ROOM), || format!("at least {bound}, it is said"));
                    let is_beyond = what != 0 || least > limit * (1.0 + 1e-9);
                    self.check(is_beyond, || format!("{least} is within {limit}"));
                }
                let best = stopped.best;
                self.check(best.start() == Some(start.into()), || format!("{best}"));
                self.check(self.known.holds(&best), || format!("{best} is not legal"));
            }
            Ok(Answer::Found(path)) => {
                if what == 0 {
                    self.check(path.cost() <= limit * (1.0 + ROOM), || format!("{} found", path.cost()));
                }
                self.check_path(&path, &[(start, goal)]);
            }
            answer => self.check_answer(answer, &[(start, goal)]),
        }
    }

    /// Cells that count otherwise for one query.
    pub(super) fn except(&mut self, bytes: &mut Bytes<'_>) {
        let cells = self.cells(bytes);
        let (start, goal) = (self.vertex(bytes), self.vertex(bytes));
        self.say(&format!("path {start} {goal}, except {cells:?}"));
        let of = |blocked: bool| cells.iter().filter(move |cell| cell.1 == blocked).map(|cell| cell.0);
        let exceptions = Exceptions::new().blocked(of(true)).free(of(false));
        let known = Known::new(known::edited(self.known.grid(), &cells), self.setup);
        let answer = self.planner.find_except(Query::new(start, goal), &exceptions);
        if !known.is_free(start) || !known.is_free(goal) {
            return self.check(answer.is_err(), || format!("{answer:?}, though an end is not free"));
        }
        let least = known.cost(start, goal);
        match answer.map(|excepted| (excepted.answer, excepted.guarantee)) {
            Ok((Answer::Found(path), guarantee)) => {
                self.check(known.holds(&path), || format!("{path} is not legal"));
                let fits = known.fits(guarantee, path.cost(), &[(start, goal)]);
                self.check(fits, || format!("{path} costs {}, not {least:?}", path.cost()));
            }
            Ok((Answer::Unreachable, _)) => self.check(least.is_none(), || "there is a path".to_owned()),
            Ok(other) => self.check(false, || format!("{other:?}")),
            // CHPA* alone gives up.
            Err(error) => {
                let may = !matches!(self.guarantee(), Guarantee::Optimal(_) | Guarantee::OptimalAnyAngle);
                self.check(may && error.code() == ErrorCode::GaveUp, || error.to_string());
            }
        }
    }

    /// The distance of every vertex.
    pub(super) fn field(&mut self, bytes: &mut Bytes<'_>) {
        let sources = self.free(bytes, 3);
        if sources.is_empty() {
            return;
        }
        self.say(&format!("field {sources:?}"));
        let field = self.space.field(sources.iter().copied()).expect("free sources");
        self.check_field(&field, &sources);
    }

    pub(super) fn check_field(&self, field: &Field, sources: &[Vertex]) {
        for at in self.known.free() {
            let least = sources.iter().filter_map(|&from| self.known.cost(from, at)).min_by(f64::total_cmp);
            let found = field.get(at);
            let is_same = match (found, least) {
                (Some(found), Some(least)) => (found - least).abs() <= ROOM * least,
                (found, least) => found == least,
            };
            self.check(is_same, || format!("{at}: {found:?}, not {least:?}"));
        }
    }

    /// Ends between vertices, of up to four queries: each takes a part of the time of an edit.
    pub(super) fn points(&mut self, bytes: &mut Bytes<'_>) {
        for _ in 0..1 + bytes.below(4) {
            let (from, to) = (self.place(bytes), self.place(bytes));
            self.between_points(from, to);
        }
    }

    /// A place in parts of a cell: at a vertex, at or beside the middle of an edge, or anywhere.
    fn place(&self, bytes: &mut Bytes<'_>) -> (i64, i64) {
        let map = self.space.map();
        let mut coordinate = |cells: u32| {
            let end = i64::from(cells) * PARTS;
            match bytes.byte() {
                byte if byte < 96 => i64::from(byte % 8) * PARTS % (end + 1),
                // Lines from middle to middle pass through vertices exactly; beside them, close by.
                byte if byte < 144 => i64::from(byte % 16) * PARTS / 2 % (end + 1),
                byte if byte < 160 => (i64::from(byte % 16) * PARTS / 2 + 1) % (end + 1),
                byte => (i64::from(byte) << 8 | i64::from(bytes.byte())) % (end + 1),
            }
        };
        (coordinate(map.width()), coordinate(map.height()))
    }

    fn between_points(&mut self, from: (i64, i64), to: (i64, i64)) {
        let rules = self.setup.rules();
        let is_any = self.setup.k() == K::Any && !matches!(rules, Rules::Center(_));
        self.say(&format!("path {from:?} {to:?}, in 1/{PARTS} of a cell"));
        let point = |(x, y)| Point::from_parts(x, y);
        let is_between_centers = matches!(rules, Rules::CenterGap(_));
        let [start, goal] =
            [from, to].map(|at| if is_between_centers { point(at).at_centers() } else { point(at) });
        let are_free = self.space.is_free(start) && self.space.is_free(goal);
        let answer = self.planner.find(Query::new(start, goal));
        if !is_any || !are_free {
            return;
        }
        let is_exact = matches!(self.guarantee(), Guarantee::OptimalAnyAngle);
        let least = self.known.between_points(from, to);
        match answer {
            Ok(Answer::Found(path)) => {
                self.check(self.space.check(&path).is_ok(), || format!("{path} is not legal, it is said"));
                let cost = path.cost();
                let fits = least.is_some_and(|least| {
                    cost >= least * (1.0 - ROOM) && (!is_exact || cost <= least * (1.0 + ROOM))
                });
                self.check(fits, || format!("{path} costs {cost}, not {least:?}"));
            }
            Ok(Answer::Unreachable) => self.check(least.is_none(), || format!("{least:?} leads there")),
            Ok(other) => self.check(false, || format!("{other:?}")),
            // Other engines say that they take vertices alone.
            Err(error) => self.check(!is_exact, || error.to_string()),
        }
    }
}
