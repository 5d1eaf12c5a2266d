//! The summary of a run.

use mediant::{Path, call::Wishes};
use mediant_formats::scenario_tolerance;
use serde::Serialize;

use super::answer::{Found, QueryAnswer, QueryRecord};

/// The sums and means of a run: times and counts of the answered queries, costs of those whose path was
/// found.
#[derive(Clone, Debug, Serialize)]
#[serde(tag = "type", rename = "summary")]
pub(crate) struct Summary {
    pub(crate) queries: u64,
    pub(crate) found: u64,
    /// Only with `--nearest`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) nearest: Option<u64>,
    pub(crate) unreachable: u64,
    /// Only with limits.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) stopped: Option<u64>,
    pub(crate) errors: u64,
    pub(crate) total_nanos: u64,
    pub(crate) mean_nanos: f64,
    pub(crate) median_nanos: u64,
    pub(crate) max_nanos: u64,
    pub(crate) mean_expanded: f64,
    pub(crate) mean_generated: f64,
    pub(crate) mean_percolations: f64,
    pub(crate) mean_updated: f64,
    pub(crate) mean_scanned: f64,
    /// The number of times that CHPA* left its plan, in all.
    pub(crate) fallbacks: u64,
    /// `null` if no path was found.
    pub(crate) mean_cost: Option<f64>,
    /// `null` if no path was found, and with `--distance`.
    pub(crate) mean_smoothness: Option<f64>,
    /// The certificates: how many times as long as the shortest any-angle paths the paths are at most. `null`
    /// if no path was found.
    pub(crate) bound: Option<Ratios>,
    /// The ratios of the paths to the shortest any-angle paths, in length; `null` without `--reference` or a
    /// path.
    pub(crate) ratio: Option<Ratios>,
    /// `null` if no answered query can be compared with a reference.
    pub(crate) reference: Option<References>,
    /// Only on a map that changes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) edits: Option<Edits>,
}

/// The edits of a run, and the times of the changes that they make.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Edits {
    pub(crate) edits: u64,
    /// Each of one edit or more.
    pub(crate) changes: u64,
    /// The number of cells that were altered.
    pub(crate) cells: u64,
    pub(crate) total_nanos: u64,
    pub(crate) mean_nanos: f64,
    pub(crate) max_nanos: u64,
}

/// Ratios to the lengths of the shortest any-angle paths.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) struct Ratios {
    pub(crate) mean: f64,
    pub(crate) worst: f64,
    /// The index of the first query with the worst ratio.
    pub(crate) worst_index: usize,
}

/// A comparison of the costs of paths between the scenario's ends with its lengths. No path counts as length
/// 0, as in scenarios.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct References {
    /// The number of queries that are compared.
    pub(crate) compared: u64,
    /// The number of costs within [`scenario_tolerance`] of the reference.
    pub(crate) equal: u64,
    /// The cost minus the reference, of the query for which they differ most.
    pub(crate) worst_deviation: f64,
    /// The index of that query.
    pub(crate) worst_index: usize,
    /// The sum of the costs, divided by the sum of the references.
    pub(crate) cost_ratio: f64,
}

/// Sums up answers one by one. Of each it keeps only the time, for the median.
#[derive(Debug, Default)]
pub(crate) struct Tally {
    nanos: Vec<u64>,
    found: u64,
    nearest: Option<u64>,
    unreachable: u64,
    stopped: Option<u64>,
    errors: u64,
    expanded: u64,
    generated: u64,
    percolations: u64,
    updated: u64,
    scanned: u64,
    fallbacks: u64,
    cost: f64,
    /// The paths that were found and made.
    made: u64,
    smoothness: f64,
    bound: RatioTally,
    ratio: RatioTally,
    compared: u64,
    equal: u64,
    worst: (f64, usize),
    compared_cost: f64,
    reference: f64,
    edits: Option<Edits>,
}

impl Tally {
    /// No answers yet to queries with these wishes.
    pub(crate) fn new(wishes: &Wishes) -> Self {
        let (nearest, stopped) = (wishes.nearest.then_some(0), wishes.has_limits().then_some(0));
        Self { nearest, stopped, ..Self::default() }
    }

    /// Adds a change of the map.
    pub(crate) fn add_change(&mut self, edits: usize, cells: u64, nanos: u64) {
        let sum = self.edits.get_or_insert_default();
        sum.edits += edits as u64;
        sum.changes += 1;
        sum.cells += cells;
        sum.total_nanos += nanos;
        sum.max_nanos = sum.max_nanos.max(nanos);
        sum.mean_nanos = sum.total_nanos as f64 / sum.changes as f64;
    }

    /// Adds an answer.
    pub(crate) fn add(&mut self, record: &QueryRecord) {
        let found = record.found();
        match &record.answer {
            Err(_) => {
                self.errors += 1;
                return;
            }
            Ok(QueryAnswer::Found(_)) => self.found += 1,
            Ok(QueryAnswer::Unreachable) => self.unreachable += 1,
            Ok(QueryAnswer::Nearest(_)) => *self.nearest.get_or_insert(0) += 1,
            Ok(QueryAnswer::Stopped(_)) => *self.stopped.get_or_insert(0) += 1,
        }
        let (index, counters) = (record.item.index, &record.counters);
        self.nanos.push(record.nanos);
        self.expanded += counters.expanded;
        self.generated += counters.generated;
        self.percolations += counters.percolations;
        self.updated += counters.updated;
        self.scanned += counters.scanned;
        self.fallbacks += counters.fallbacks;
        self.made += u64::from(found.is_some_and(|found| found.path.is_some()));
        self.smoothness += record.path().filter(|_| found.is_some()).map_or(0.0, Path::smoothness);
        let cost = found.map_or(0.0, |found| found.cost);
        self.cost += cost;
        self.bound.add(index, found.and_then(Found::bound));
        self.ratio.add(index, found.and_then(Found::ratio));
        if let Some(reference) = record.item.reference.filter(|_| is_comparable(record)) {
            self.compare(index, cost, reference.max(0.0));
        }
    }

    /// Adds a cost and its reference.
    fn compare(&mut self, index: usize, cost: f64, reference: f64) {
        let deviation = cost - reference;
        if self.compared == 0 || deviation.abs() > self.worst.0.abs() {
            self.worst = (deviation, index);
        }
        self.compared += 1;
        self.equal += u64::from(deviation.abs() <= scenario_tolerance(reference));
        self.compared_cost += cost;
        self.reference += reference;
    }

    /// The summary of all answers that were added.
    pub(crate) fn finish(mut self) -> Summary {
        self.nanos.sort_unstable();
        let total: u64 = self.nanos.iter().sum();
        let mean = |sum: f64, count: u64| if count == 0 { 0.0 } else { sum / count as f64 };
        let answered = self.nanos.len() as u64;
        let (worst_deviation, worst_index) = self.worst;
        let references = References {
            compared: self.compared,
            equal: self.equal,
            worst_deviation,
            worst_index,
            cost_ratio: if self.reference > 0.0 { self.compared_cost / self.reference } else { 1.0 },
        };
        Summary {
            queries: answered + self.errors,
            found: self.found,
            nearest: self.nearest,
            unreachable: self.unreachable,
            stopped: self.stopped,
            errors: self.errors,
            total_nanos: total,
            mean_nanos: mean(total as f64, answered),
            median_nanos: median(&self.nanos),
            max_nanos: self.nanos.last().copied().unwrap_or(0),
            mean_expanded: mean(self.expanded as f64, answered),
            mean_generated: mean(self.generated as f64, answered),
            mean_percolations: mean(self.percolations as f64, answered),
            mean_updated: mean(self.updated as f64, answered),
            mean_scanned: mean(self.scanned as f64, answered),
            fallbacks: self.fallbacks,
            mean_cost: (self.found > 0).then(|| mean(self.cost, self.found)),
            mean_smoothness: (self.made > 0).then(|| mean(self.smoothness, self.made)),
            bound: self.bound.finish(),
            ratio: self.ratio.finish(),
            reference: (self.compared > 0).then_some(references),
            edits: self.edits,
        }
    }
}

/// Whether an answer is one to the scenario's own query: a path between its ends, or that there is none.
fn is_comparable(record: &QueryRecord) -> bool {
    let ends = record.item.ends;
    matches!(record.answer, Ok(QueryAnswer::Found(_) | QueryAnswer::Unreachable))
        && record.ends() == (ends.start, ends.goal)
}

/// Sums up ratios.
#[derive(Clone, Copy, Debug, Default)]
struct RatioTally {
    sum: f64,
    count: u64,
    worst: Option<(f64, usize)>,
}

impl RatioTally {
    fn add(&mut self, index: usize, ratio: Option<f64>) {
        let Some(ratio) = ratio else { return };
        self.sum += ratio;
        self.count += 1;
        if self.worst.is_none_or(|(worst, _)| ratio > worst) {
            self.worst = Some((ratio, index));
        }
    }

    fn finish(self) -> Option<Ratios> {
        let (worst, worst_index) = self.worst?;
        Some(Ratios { mean: self.sum / self.count as f64, worst, worst_index })
    }
}

/// The median of sorted numbers. Of an even count it is the mean of the middle two, rounded down; of none it
/// is 0.
fn median(sorted: &[u64]) -> u64 {
    let upper = sorted.get(sorted.len() / 2).copied().unwrap_or(0);
    if sorted.len() % 2 == 1 {
        upper
    } else {
        sorted.get((sorted.len() / 2).wrapping_sub(1)).copied().unwrap_or(0).midpoint(upper)
    }
}

#[cfg(test)]
mod tests {
    use mediant::Vertex;
    use mediant::{Ends, search::Counters};

    use super::*;
    use crate::run::queries::Item;

    /// The answer with a path of this length, right and then down; without one for `None`.
    fn answer(index: usize, cost: Option<i32>, reference: f64, nanos: u64) -> QueryRecord {
        let ends = Ends::new((0, 0), (cost.unwrap_or(1) - 1, 1));
        let answer = cost.map_or(QueryAnswer::Unreachable, |cost| {
            let path = Path::new([(0, 0), (cost - 1, 0), (cost - 1, 1)].map(Vertex::from).to_vec());
            let cost = path.cost();
            QueryAnswer::Found(Found { lower_bound: Some(cost), cost, path: Some(path), any_angle: None })
        });
        let counters = Counters {
            expanded: 10,
            generated: 20,
            percolations: 30,
            updated: 40,
            scanned: 50,
            fallbacks: 60,
        };
        let item = Item { index, ends: ends.into(), reference: Some(reference) };
        QueryRecord { item, query: ends.into(), searched_by: None, answer: Ok(answer), counters, nanos }
    }

    #[test]
    fn figures_are_over_the_queries_that_they_are_about() {
        let mut tally = Tally::default();
        tally.add(&answer(0, Some(10), 10.004, 4));
        tally.add(&answer(1, Some(9), 10.0, 1));
        tally.add(&answer(2, None, 0.0, 3));
        tally.add(&answer(3, Some(30_000), 30_000.2, 100));
        tally.add(&QueryRecord {
            answer: Err(crate::run::answer::Unanswered {
                text: "an end is blocked".to_owned(),
                code: mediant::ErrorCode::GoalBlocked,
            }),
            ..answer(4, None, 1.0, 0)
        });
        let summary = tally.finish();
        assert_eq!((summary.queries, summary.found, summary.unreachable, summary.errors), (5, 3, 1, 1));
        assert_eq!((summary.median_nanos, summary.max_nanos, summary.total_nanos), (3, 100, 108));
        assert_eq!((summary.mean_nanos, summary.mean_expanded), (27.0, 10.0));
        assert_eq!((summary.mean_updated, summary.mean_scanned, summary.fallbacks), (40.0, 50.0, 240));
        assert_eq!(summary.mean_smoothness, Some(90.0));
        let reference = summary.reference.unwrap();
        assert_eq!((reference.compared, reference.equal), (4, 3));
        assert_eq!((reference.worst_deviation, reference.worst_index), (-1.0, 1));
    }

    #[test]
    fn of_ratios_there_are_the_mean_and_the_first_of_the_worst() {
        let mut tally = Tally::default();
        assert_eq!((tally.bound.finish(), tally.ratio.finish()), (None, None));
        let with = |index, lower_bound, any_angle| {
            let mut record = answer(index, Some(3), 3.0, 1);
            if let Ok(QueryAnswer::Found(found)) = &mut record.answer {
                (found.lower_bound, found.any_angle) = (lower_bound, any_angle);
            }
            record
        };
        for (index, lower_bound) in [(0, 3.0), (2, 2.0), (4, 2.0), (6, 2.5)] {
            tally.add(&with(index, Some(lower_bound), None));
        }
        tally.add(&with(8, Some(3.0), Some(2.4)));
        tally.add(&answer(10, None, 0.0, 1));
        let summary = tally.finish();
        let bound = summary.bound.unwrap();
        assert!((bound.mean - 6.2 / 5.0).abs() < 1e-12, "{bound:?}");
        assert_eq!((bound.worst, bound.worst_index), (1.5, 2));
        assert_eq!(summary.ratio, Some(Ratios { mean: 1.25, worst: 1.25, worst_index: 8 }));
    }

    #[test]
    fn medians() {
        assert_eq!([&[][..], &[7], &[1, 4], &[1, 2, 9]].map(median), [0, 7, 2, 2]);
    }
}
