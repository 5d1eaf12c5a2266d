//! Setups by their text, and sums over their runs.

use mediant::Setup;
use mediant_bench::{Run, Study};
use mediant_report::{Column, Row};
use serde::{Deserialize, Serialize};

use crate::Error;

/// The setup of a text that is written in the sources.
pub(super) fn setup(text: &str) -> Result<Setup, Error> {
    text.parse().map_err(|wrong| Error::Reproduce(format!("{text}: {wrong}")))
}

/// Runs the queries of a study by the setup of a text.
pub(super) fn run(study: &mut Study<'_>, text: &str) -> Result<Run, Error> {
    study.run(setup(text)?).map_err(|wrong| Error::Reproduce(format!("{text}: {wrong}")))
}

/// Sums over the queries of runs; every query has the same weight.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Sums {
    pub(super) queries: u64,
    /// The queries that were answered by a path; the following sums are over these.
    pub(super) found: u64,
    pub(super) cost: f64,
    pub(super) moves: f64,
    pub(super) smoothness: f64,
    /// Of the queries whose optimum is known and not 0: their number, the sum of the ratios length / optimum,
    /// and the largest ratio.
    pub(super) compared: u64,
    pub(super) ratios: f64,
    pub(super) worst: f64,
    pub(super) expanded: f64,
    pub(super) percolations: f64,
    pub(super) scanned: f64,
    pub(super) fallbacks: f64,
    /// The queries that were timed, and their times in microseconds.
    pub(super) timed: u64,
    pub(super) micros: f64,
    /// Over maps: their number, and the seconds and bytes of what was prepared.
    pub(super) maps: u64,
    pub(super) seconds: f64,
    pub(super) bytes: f64,
}

impl Sums {
    /// The sums of a run. `optima` is empty, or has the optimal length of each query, 0 where it is not
    /// known.
    pub(super) fn of(run: &Run, optima: &[f64]) -> Self {
        let mut sums = Self { maps: 1, queries: run.answers.len() as u64, ..Self::default() };
        for (at, answer) in run.answers.iter().enumerate() {
            let Some(answer) = answer else { continue };
            sums.found += 1;
            sums.cost += answer.cost;
            sums.moves += f64::from(answer.moves);
            sums.smoothness += answer.smoothness;
            sums.expanded += answer.counters.expanded as f64;
            sums.percolations += answer.counters.percolations as f64;
            sums.scanned += answer.counters.scanned as f64;
            sums.fallbacks += answer.counters.fallbacks as f64;
            if let Some(&optimum) = optima.get(at).filter(|&&optimum| optimum > 0.0) {
                sums.compared += 1;
                sums.ratios += answer.cost / optimum;
                sums.worst = sums.worst.max(answer.cost / optimum);
            }
        }
        if let Some(micros) = run.micros {
            sums.timed = sums.queries;
            sums.micros = micros * sums.queries as f64;
        }
        (sums.seconds, sums.bytes) = (run.preparation.seconds, run.preparation.bytes as f64);
        sums
    }

    /// Adds the sums of other queries.
    pub(super) fn add(&mut self, other: &Self) {
        self.queries += other.queries;
        self.found += other.found;
        self.cost += other.cost;
        self.moves += other.moves;
        self.smoothness += other.smoothness;
        self.compared += other.compared;
        self.ratios += other.ratios;
        self.worst = self.worst.max(other.worst);
        self.expanded += other.expanded;
        self.percolations += other.percolations;
        self.scanned += other.scanned;
        self.fallbacks += other.fallbacks;
        self.timed += other.timed;
        self.micros += other.micros;
        self.maps += other.maps;
        self.seconds += other.seconds;
        self.bytes += other.bytes;
    }

    /// The columns that [`Self::row`] fills.
    pub(super) fn columns() -> Vec<Column> {
        vec![
            Column::count("queries", "", "queries"),
            Column::count("found", "", "queries that were answered by a path; means are over these"),
            Column::count("cost", "cells", "mean length of a path"),
            Column::count("moves", "", "mean number of steps of a path"),
            Column::count("smoothness", "degrees", "mean sum of the angles by which a path turns"),
            Column::count("excess", "%", "mean of the lengths over the optima, less 1"),
            Column::count("worst", "", "largest length over its optimum"),
            Column::count("expanded", "", "mean number of nodes expanded"),
            Column::count("percolations", "", "mean number of swaps in the heap"),
            Column::count("scanned", "", "mean number of vertices looked at by jumps"),
            Column::count("fallbacks", "", "how often searches left their plan, in all"),
            Column::count("bytes", "bytes", "mean size of what is prepared of a map, beyond the map"),
            Column::time("micros", "µs", "mean time of a query"),
            Column::time("preparation", "s", "mean time to prepare a map"),
        ]
    }

    /// Fills these columns of a row.
    pub(super) fn row(&self, row: Row) -> Row {
        let mean = |sum: f64, of: u64| (of > 0).then(|| sum / of as f64);
        let found = |sum| mean(sum, self.found);
        let excess = mean(self.ratios, self.compared).map(|ratio| 100.0 * (ratio - 1.0));
        row.with("queries", self.queries as f64)
            .with("found", self.found as f64)
            .with("cost", found(self.cost))
            .with("moves", found(self.moves))
            .with("smoothness", found(self.smoothness))
            .with("excess", excess)
            .with("worst", (self.compared > 0).then_some(self.worst))
            .with("expanded", found(self.expanded))
            .with("percolations", found(self.percolations))
            .with("scanned", found(self.scanned))
            .with("fallbacks", self.fallbacks)
            .with("bytes", mean(self.bytes, self.maps))
            .with("micros", mean(self.micros, self.timed))
            .with("preparation", mean(self.seconds, self.maps))
    }
}

/// The lengths of a run's paths, 0 where there is no path: optima for [`Sums::of`], if the run is optimal.
pub(super) fn costs(run: &Run) -> Vec<f64> {
    run.answers.iter().map(|answer| answer.map_or(0.0, |answer| answer.cost)).collect()
}

#[cfg(test)]
mod tests {
    use mediant_bench::{PathFigures, Preparation};
    use mediant_search::Counters;

    use super::*;

    fn answer(cost: f64, expanded: u64) -> Option<PathFigures> {
        let counters = Counters { expanded, percolations: 10 * expanded, ..Counters::default() };
        Some(PathFigures { cost, moves: 3, waypoints: 2, smoothness: 45.0, counters })
    }

    #[test]
    fn sums_are_over_queries() {
        let preparation = |seconds, bytes| Preparation { seconds, bytes, ..Preparation::default() };
        let first = Run {
            answers: vec![answer(11.0, 4), None, answer(30.0, 8)],
            micros: Some(2.0),
            preparation: preparation(0.5, 100),
        };
        let second =
            Run { answers: vec![answer(5.0, 0)], micros: Some(6.0), preparation: preparation(1.5, 300) };
        // The optimum of the third is not known.
        let mut sums = Sums::of(&first, &[10.0, 7.0, 0.0]);
        sums.add(&Sums::of(&second, &[4.0]));
        let row = sums.row(Row::new());
        let number = |column: &str| row.number(column).unwrap_or(f64::NAN);
        assert_eq!((number("queries"), number("found")), (4.0, 3.0));
        assert_eq!((number("cost"), number("moves"), number("smoothness")), (46.0 / 3.0, 3.0, 45.0));
        assert_eq!((number("expanded"), number("percolations")), (4.0, 40.0));
        assert!((number("excess") - 17.5).abs() < 1e-9 && (number("worst") - 1.25).abs() < 1e-12);
        assert_eq!((number("micros"), number("preparation"), number("bytes")), (3.0, 1.0, 200.0));
        assert_eq!(costs(&first), [11.0, 0.0, 30.0]);
        let untimed = Sums::of(&Run { micros: None, ..second }, &[]).row(Row::new());
        assert_eq!((untimed.number("micros"), untimed.number("excess")), (None, None));
        let columns = Sums::columns();
        assert!(row.values().all(|(name, _)| columns.iter().any(|column| column.name == name)));
    }
}
