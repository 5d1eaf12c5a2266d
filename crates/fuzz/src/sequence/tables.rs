//! Lengths from many to many, and to prepared goals.

use mediant::{Error, ErrorCode, Guarantee, Vertex};

use super::Run;
use crate::bytes::Bytes;

impl Run {
    /// Checks a length as a table tells it. An engine that gives up fails as a whole.
    fn check_length(&self, length: f64, from: Vertex, to: Vertex) {
        let is_right = match self.known.cost(from, to) {
            Some(_) => self.known.fits(self.planner.guarantee(), length, &[(from, to)]),
            None => length.is_infinite(),
        };
        self.check(is_right, || format!("{from} to {to}: {length}, not {:?}", self.known.cost(from, to)));
    }

    fn check_gives_up(&self, error: &Error) {
        let may = matches!(self.planner.guarantee(), Guarantee::Suboptimal | Guarantee::AtMost(_));
        self.check(may && error.code() == ErrorCode::GaveUp, || error.to_string());
    }

    pub(super) fn table(&mut self, bytes: &mut Bytes<'_>) {
        let (starts, goals) = (self.free(bytes, 4), self.free(bytes, 4));
        self.say(&format!("table {starts:?} {goals:?}"));
        match self.index.table(starts.iter().copied(), goals.iter().copied()) {
            Ok(table) => {
                self.check(table.values().len() == starts.len() * goals.len(), || format!("{table:?}"));
                for (row, &from) in starts.iter().enumerate() {
                    for (&length, &to) in table.row(row).iter().zip(&goals) {
                        self.check_length(length, from, to);
                    }
                }
            }
            Err(error) => self.check_gives_up(&error),
        }
    }

    /// Goals that are prepared once: the lengths to all, and the nearest of them.
    pub(super) fn goals(&mut self, bytes: &mut Bytes<'_>) {
        let (starts, goals) = (self.free(bytes, 2), self.free(bytes, 5));
        let Some(&start) = starts.first() else { return };
        self.say(&format!("goals {goals:?}, from {start}"));
        let prepared = self.index.goals(goals.iter().copied()).expect("free goals");
        let lengths = match self.planner.distances(start, &prepared) {
            Ok(lengths) => lengths,
            Err(error) => return self.check_gives_up(&error),
        };
        for (&length, &to) in lengths.iter().zip(&goals) {
            self.check_length(length, start, to);
        }
        match self.planner.nearest(start, &prepared) {
            Ok(Some((number, length))) => {
                self.check(number < goals.len(), || format!("goal {number}"));
                self.check_length(length, start, goals[number]);
                let least = lengths.iter().copied().fold(f64::INFINITY, f64::min);
                let is_least = !self.planner.guarantee().is_optimal() || length <= least * (1.0 + 1e-9);
                self.check(is_least, || format!("goal {number} at {length}, not {least}"));
            }
            Ok(None) => {
                let is_none = lengths.iter().all(|length| length.is_infinite());
                self.check(is_none, || format!("no nearest goal, but {lengths:?}"));
            }
            Err(error) => self.check_gives_up(&error),
        }
        self.goals = Some(prepared);
    }

    /// Goals of the map before an edit are refused, unless the map is the same.
    pub(super) fn earlier_goals(&mut self, bytes: &mut Bytes<'_>) {
        let at = self.vertex(bytes);
        let Some(goals) = self.goals.clone() else { return };
        self.say(&format!("goals of before, from {at}"));
        let answer = self.planner.distances(at, &goals);
        if goals.identity() != self.space.identity() {
            let code = answer.map_err(|error| error.code());
            self.check(code == Err(ErrorCode::Mismatch), || format!("{code:?}, though the map is another"));
        }
    }
}
