//! Queries over costs, and what their answers must be.

use mediant::{Answer, Field, Guarantee, Limit, Limits, Path, Query, Vertex, errors::QueryError};

use super::{Run, known::ROOM};
use crate::{bytes::Bytes, sequence::NthLook};

impl Run {
    /// A vertex on the map, or in a column left of it.
    fn vertex(&self, bytes: &mut Bytes<'_>) -> Vertex {
        let (width, height) = self.known.size();
        let at = Vertex::new(bytes.below(width as usize) as i32, bytes.below(height as usize) as i32);
        if bytes.byte() >= 240 { Vertex::new(-1, at.y) } else { at }
    }

    /// Some free vertices; none if there is none.
    fn free(&self, bytes: &mut Bytes<'_>, most: usize) -> Vec<Vertex> {
        let free = self.known.free();
        if free.is_empty() {
            return Vec::new();
        }
        let count = 1 + bytes.below(most);
        (0..count).map(|_| free[bytes.below(free.len())]).collect()
    }

    fn is_exact(&self) -> bool {
        matches!(self.planner.guarantee(), Guarantee::Cheapest(_))
    }

    /// Checks that a path is legal, and costs what it states.
    fn check_legal(&self, path: &Path) {
        let (told, cost) = (self.space.cost(path), path.cost());
        let measured = self.known.measured(path);
        let is_same = measured.is_some_and(|measured| (measured - cost).abs() <= ROOM * measured);
        self.check(is_same, || format!("{path} costs {cost}, not {measured:?}"));
        if self.is_exact() {
            self.check(told == Some(cost), || format!("{path} costs {cost}, then {told:?}"));
            let exact = self.known.exact(path);
            self.check(exact == Some(cost), || format!("{path} costs {cost}, not {exact:?}"));
        }
    }

    /// Checks a path that was found as the best between some of these ends.
    fn check_path(&mut self, path: &Path, pairs: &[(Vertex, Vertex)]) {
        let ends = path.waypoints().first().copied().zip(path.waypoints().last().copied());
        self.check(ends.is_some_and(|ends| pairs.contains(&ends)), || format!("{path}: other ends"));
        self.check_legal(path);
        let least = self.least(pairs);
        let fits = match self.planner.guarantee() {
            Guarantee::Cheapest(_) => Some(path.cost()) == least,
            Guarantee::AtMostCheapest(_) => least.is_none_or(|least| path.cost() <= least * (1.0 + ROOM)),
            _ => true,
        };
        self.check(fits, || format!("{path} costs {}, not {least:?}", path.cost()));
        self.path = Some(path.clone());
    }

    fn least(&self, pairs: &[(Vertex, Vertex)]) -> Option<f64> {
        pairs.iter().filter_map(|&(from, to)| self.known.cost(from, to)).min_by(f64::total_cmp)
    }

    /// Checks an answer without limits between some of these ends, which are free.
    fn check_answer(&mut self, answer: Result<Answer, QueryError>, pairs: &[(Vertex, Vertex)]) {
        match answer {
            Ok(Answer::Found(path)) => self.check_path(&path, pairs),
            Ok(Answer::Unreachable) => {
                let least = self.least(pairs);
                self.check(least.is_none(), || format!("{least:?} leads there"));
            }
            other => self.check(false, || format!("{other:?}")),
        }
    }

    /// A plain query, also with ends that are blocked or outside the map, at once and in steps.
    pub(super) fn path(&mut self, bytes: &mut Bytes<'_>) {
        let (start, goal) = (self.vertex(bytes), self.vertex(bytes));
        let expansions = 1 + u64::from(bytes.byte() % 5);
        self.say(&format!("path {start} {goal}, and in steps of {expansions}"));
        let answer = self.planner.find(Query::new(start, goal));
        if !self.known.is_free(start) || !self.known.is_free(goal) {
            return self.check(answer.is_err(), || format!("{answer:?}, though an end is not free"));
        }
        self.check_answer(answer.clone(), &[(start, goal)]);
        let least = self.known.cost(start, goal);
        self.planner.begin(Query::new(start, goal)).expect("free ends");
        let mut last = 0.0;
        let in_steps = loop {
            match self.planner.step(expansions) {
                Ok(None) => {}
                Ok(Some(answer)) => break Ok(answer),
                Err(error) => break Err(error),
            }
            let bound = self.planner.lower_bound();
            self.check(bound >= last * (1.0 - 1e-9), || format!("a bound of {bound} after {last}"));
            let is_bound = !self.is_exact() || least.is_none_or(|least| bound <= least * (1.0 + 1e-9));
            self.check(is_bound, || format!("a bound of {bound} on {least:?}"));
            last = bound;
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

    /// A goal counts as reached anywhere near it.
    pub(super) fn tolerance(&mut self, bytes: &mut Bytes<'_>) {
        let (starts, goals) = (self.free(bytes, 1), self.free(bytes, 1));
        let (Some(&start), Some(&goal)) = (starts.first(), goals.first()) else { return };
        let cells = f64::from(bytes.byte() % 6) / 2.0;
        self.say(&format!("path {start} {goal}, tolerance {cells}"));
        let near = self.known.free().into_iter().filter(|at| at.distance(goal) <= cells * (1.0 + 1e-9));
        let pairs: Vec<_> = near.map(|at| (start, at)).collect();
        let answer = self.planner.find(Query::new(start, goal).tolerance(cells));
        self.check_answer(answer, &pairs);
    }

    /// Limits on the cost and on expansions.
    pub(super) fn limits(&mut self, bytes: &mut Bytes<'_>) {
        let (starts, goals) = (self.free(bytes, 1), self.free(bytes, 1));
        let (Some(&start), Some(&goal)) = (starts.first(), goals.first()) else { return };
        let least = self.known.cost(start, goal);
        let (is_of_cost, number) = (bytes.below(2) == 0, bytes.byte());
        let limit = least.unwrap_or(3.0) * [1.0, 0.999, 1.001, 0.5][usize::from(number) % 4];
        let (limits, by) = if is_of_cost {
            (Limits::new().cost(limit), Limit::Cost)
        } else {
            (Limits::new().expansions(u64::from(number % 24)), Limit::Expansions)
        };
        self.say(&format!("path {start} {goal} within {limits:?}"));
        match self.planner.find(Query::new(start, goal).within(limits)) {
            Ok(Answer::Stopped(stopped)) => {
                self.check(stopped.by == by, || format!("{stopped:?}"));
                if let Some(least) = least.filter(|_| self.is_exact()) {
                    let is_bound = stopped.lower_bound <= least * (1.0 + 1e-9);
                    self.check(is_bound, || format!("{stopped:?}, but {least} leads there"));
                    self.check(!is_of_cost || least > limit, || format!("{least} is within {limit}"));
                }
                let best = stopped.best;
                self.check(best.waypoints().first() == Some(&start), || format!("{best}"));
                self.check_legal(&best);
                let is_within = !is_of_cost || best.cost() <= limit * (1.0 + 1e-9);
                self.check(is_within, || format!("{best} costs {}, not within {limit}", best.cost()));
            }
            Ok(Answer::Found(path)) => {
                let is_within = !is_of_cost || path.cost() <= limit * (1.0 + 1e-9);
                self.check(is_within, || format!("{path} costs {}, not within {limit}", path.cost()));
                self.check_path(&path, &[(start, goal)]);
            }
            answer => self.check_answer(answer, &[(start, goal)]),
        }
    }

    /// The costs of all paths from some starts to some goals.
    pub(super) fn table(&mut self, bytes: &mut Bytes<'_>) {
        let (starts, goals) = (self.free(bytes, 3), self.free(bytes, 3));
        self.say(&format!("table {starts:?} {goals:?}"));
        let table = self.index.table(starts.iter().copied(), goals.iter().copied());
        let table = table.unwrap_or_else(|error| panic!("{error}\n{}", self.text));
        for (row, &from) in starts.iter().enumerate() {
            for (&cost, &to) in table.row(row).iter().zip(&goals) {
                let (found, least) = (Some(cost).filter(|cost| cost.is_finite()), self.known.cost(from, to));
                let is_right = match found.zip(least) {
                    Some((found, least)) if !self.is_exact() => found <= least * (1.0 + ROOM),
                    _ => found == least,
                };
                self.check(is_right, || format!("{from} to {to}: {found:?}, not {least:?}"));
            }
        }
    }

    /// A query that is stopped at the n-th look at its deadline, or answered as without one.
    pub(super) fn stopped(&mut self, bytes: &mut Bytes<'_>) {
        let (starts, goals, look) = (self.free(bytes, 2), self.free(bytes, 3), NthLook::new(bytes));
        if starts.is_empty() {
            return;
        }
        self.say(&format!("path {starts:?} {goals:?}, within {:?}", look.limits()));
        let query = Query::between(starts, goals);
        let answer = self.planner.find(query.clone().within(look.limits()));
        let is_stopped = matches!(&answer, Ok(Answer::Stopped(stopped)) if stopped.by == Limit::Timeout);
        self.check(is_stopped == look.is_heard(), || format!("heard: {}, {answer:?}", look.is_heard()));
        match answer {
            Ok(Answer::Stopped(stopped)) => self.check_legal(&stopped.best),
            answer => {
                let whole = self.planner.find(query);
                self.check(answer == whole, || format!("{answer:?}, not {whole:?}"));
            }
        }
    }

    /// The least cost of every vertex.
    pub(super) fn make_field(&mut self, bytes: &mut Bytes<'_>) {
        let sources = self.free(bytes, 3);
        if sources.is_empty() {
            return;
        }
        self.say(&format!("field {sources:?}"));
        let field = self.space.field(sources.iter().copied()).expect("free sources");
        self.check_field(field, sources);
    }

    /// Checks a field, and keeps it.
    pub(super) fn check_field(&mut self, field: Field, sources: Vec<Vertex>) {
        for at in self.known.free() {
            let pairs: Vec<_> = sources.iter().map(|&from| (at, from)).collect();
            let (found, least) = (field.get(at), self.least(&pairs));
            self.check(found == least, || format!("{at}: {found:?}, not {least:?}"));
        }
        self.field = Some((field, sources));
    }
}
