//! Figures of the tables.

use mediant_report::{Axis, Chart, Mark, Record, Series};

use super::{
    published::SETS,
    searches::{Algorithm, Heuristic, KS, Measure, SearchKey},
};

/// The searches that are shown.
const SHOWN: [(Algorithm, Heuristic); 4] = [
    (Algorithm::AStar, Heuristic::Hk),
    (Algorithm::AStar, Heuristic::Euclidean),
    (Algorithm::Paper, Heuristic::Hk),
    (Algorithm::Paper, Heuristic::Euclidean),
];

fn neighbors() -> Axis {
    let ticks = KS.map(|k| (f64::from(1_u32 << k), (1_u32 << k).to_string()));
    Axis::new("neighbors, 2^k").log().ticks(ticks)
}

/// The points of a curve: for each k, what `number` finds of its search.
fn points(
    (algorithm, heuristic): (Algorithm, Heuristic),
    number: impl Fn(SearchKey) -> Option<f64>,
) -> Vec<(f64, f64)> {
    let point = |k: u32| Some((f64::from(1_u32 << k), number(SearchKey { algorithm, heuristic, k })?));
    KS.into_iter().filter_map(point).collect()
}

fn name((algorithm, heuristic): (Algorithm, Heuristic), whose: &str) -> String {
    format!("{}, {}{whose}", algorithm.words(), heuristic.words())
}

/// Figure 3: the time of each search against the number of neighbors. None if no time was taken on that set.
pub(super) fn runtime(record: &Record, set: &str) -> Option<String> {
    let ours = |search: SearchKey| Some(search.number(record, set, "micros")? / 1000.0);
    let mut chart =
        Chart::new(format!("Time of a query on {}", title(set)), neighbors(), Axis::new("ms").log())
            .note(note(record, set)?);
    for (style, search) in SHOWN.into_iter().enumerate() {
        chart.push(Series::new(name(search, ""), Mark::Line, points(search, ours)).style(style));
    }
    for (style, search) in SHOWN.into_iter().enumerate() {
        let published = points(search, |search| search.published(set, Measure::Time));
        if !published.is_empty() {
            chart.push(
                Series::new(name(search, ", published"), Mark::Points, published).style(style).hollow(),
            );
        }
    }
    Some(chart.svg())
}

/// The time of an expansion against the number of neighbors.
pub(super) fn expansion(record: &Record, set: &str) -> Option<String> {
    let ours = |search: SearchKey| {
        Some(1000.0 * search.number(record, set, "micros")? / search.number(record, set, "timed_expanded")?)
    };
    let theirs = |search: SearchKey| {
        Some(1e6 * search.published(set, Measure::Time)? / search.published(set, Measure::Expanded)?)
    };
    let title = format!("Time of an expansion on {}", title(set));
    let mut chart = Chart::new(title, neighbors(), Axis::new("ns").log()).note(note(record, set)?);
    for (style, search) in SHOWN.into_iter().enumerate() {
        chart.push(Series::new(name(search, ""), Mark::Line, points(search, ours)).style(style));
    }
    for (style, search) in SHOWN.into_iter().enumerate() {
        let published = points(search, theirs);
        if !published.is_empty() {
            chart.push(
                Series::new(name(search, ", published"), Mark::Points, published).style(style).hollow(),
            );
        }
    }
    Some(chart.svg())
}

fn title(set: &str) -> &str {
    SETS.iter().find(|(name, _)| *name == set).map_or(set, |(_, title)| title)
}

/// The note on the chart's problems; none if nothing was timed.
fn note(record: &Record, set: &str) -> Option<String> {
    let keys = [("set", set)];
    let first = record.select(&keys).find(|row| row.number("micros").is_some())?;
    Some(format!("{} random problems", first.number("timed")?))
}
