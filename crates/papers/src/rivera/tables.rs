//! The measurements of Tables 1 and 2.

pub(super) mod pages;

use std::sync::Arc;

use mediant_bench::Study;
use mediant_grid::{Grid, Rules};
use mediant_report::{Column, Row};
use mediant_search::Ends;

use super::searches::{Algorithm, Heuristic, Measure, SearchKey};
use crate::{
    Error,
    context::{Context, How},
    experiment::Findings,
    maps::{Map, random_queries},
    setups::{run, setup},
};

/// The five StarCraft maps.
const STARCRAFT: [&str; 5] = ["Cauldron", "Expedition", "Octopus", "PrimevalIsles", "TheFrozenSea"];
/// The counts, in the order of the numbers of [`Counted`].
const COUNTS: [Measure; 4] = [Measure::Cost, Measure::Moves, Measure::Expanded, Measure::Percolations];
/// The part of the problems of a map that are timed.
const TIMED: usize = 10;

/// For each search and query, the numbers of [`COUNTS`].
type Counted = Vec<Vec<[f64; 4]>>;

/// For each search, the microseconds of all timed queries of a map, if it was timed.
type Timed = Vec<Option<f64>>;

pub(super) fn measure(context: &Context<'_>) -> Result<Findings, Error> {
    let mut maps = Vec::new();
    for set in context.sets() {
        maps.extend(self::maps(context, set)?);
    }
    let counted = context.each("counts", How::Counted, &maps, |map| counts(context, map))?;
    let timed = if context.passes() == 0 {
        vec![Vec::new(); maps.len()]
    } else {
        context.each("times", How::Timed, &maps, |map| times(context, map))?
    };
    let mut rows = Vec::new();
    for set in context.sets() {
        let of = |at: &usize| maps[*at].set == set;
        let counted: Vec<&Counted> = (0..maps.len()).filter(of).map(|at| &counted[at]).collect();
        let timed: Vec<&Timed> = (0..maps.len()).filter(of).map(|at| &timed[at]).collect();
        rows.extend(rows_of(set, &counted, &timed));
    }
    let instances =
        counted.iter().filter_map(|searches| searches.first()).map(|queries| queries.len() as u64);
    Ok(Findings {
        columns: columns(),
        rows,
        maps: maps.len(),
        instances: instances.sum(),
        drawn: format!(
            "{} random solvable problems on each StarCraft map, {} on each other, as many as in the paper, \
             whose own are lost; one in {TIMED} is timed",
            problems(context, "sc1"),
            problems(context, "bg512")
        ),
        seeded: true,
    })
}

/// The maps of a set.
pub(super) fn maps(context: &Context<'_>, set: &str) -> Result<Vec<Map>, Error> {
    match set {
        "sc1" => context.named(set, &STARCRAFT[..context.quick_or(1, STARCRAFT.len())]),
        "bundled" => context.maps(set, 2),
        _ => context.maps(set, 3),
    }
}

fn columns() -> Vec<Column> {
    let mut columns = vec![
        Column::key("set", "the set of maps"),
        Column::key("algorithm", "A*, canonical A* as published, or canonical A* with the exact rule"),
        Column::key("heuristic", "h_k or the Euclidean distance"),
        Column::key("k", "the neighborhood has 2^k moves"),
        Column::count("queries", "", "problems"),
    ];
    for measure in COUNTS {
        let unit = if measure == Measure::Cost { "cells" } else { "" };
        columns.push(Column::count(
            measure.column(),
            unit,
            &format!("mean {} of a problem", measure.words()),
        ));
    }
    for measure in COUNTS {
        let about = format!(
            "standard error, by the draw of the problems, of the {} over those of k = 3; of k = 3, over \
             those of the other heuristic or of A*; where there is neither, of the mean itself; a part of it",
            measure.words()
        );
        columns.push(Column::count(&error_column(measure), "", &about));
    }
    columns.extend([
        Column::count("timed", "", "problems that were timed"),
        Column::count("timed_expanded", "", "mean expansions of these"),
        Column::time("micros", "µs", "mean time of these"),
    ]);
    columns
}

fn error_column(measure: Measure) -> String {
    format!("{}_error", measure.column())
}

/// How many problems a map has.
fn problems(context: &Context<'_>, set: &str) -> usize {
    match set {
        "sc1" => context.quick_or(20, 150),
        _ => context.quick_or(20, 50),
    }
}

/// How many of a map's problems are timed: the first ones, since their order is random.
const fn timed_of(problems: usize) -> usize {
    problems.div_ceil(TIMED)
}

/// The first `count` of a map's random problems, on its grid or one like it.
pub(super) fn queries(
    context: &Context<'_>,
    map: &Map,
    grid: &Arc<Grid>,
    count: usize,
) -> Result<Vec<Ends>, Error> {
    let setup = setup("astar:3:never")?;
    let space = setup
        .space(&mediant::Map::from(Arc::clone(grid)))
        .map_err(|wrong| Error::Reproduce(wrong.to_string()))?;
    let rules: Rules = setup.rules();
    let solvable = |query: Ends| space.connected(query.start, query.goal);
    Ok(random_queries(&mut context.rng(map), grid, rules, count, solvable))
}

fn counts(context: &Context<'_>, map: &Map) -> Result<Counted, Error> {
    let grid = map.grid()?;
    let queries = queries(context, map, &grid, problems(context, &map.set))?;
    let mut study = Study::new(&grid, &queries, 0);
    let one = |search: SearchKey| {
        let found = run(&mut study, &search.setup())?.answers.into_iter().map(|answer| {
            let answer = answer.ok_or_else(|| {
                Error::Reproduce(format!(
                    "{}, {}: a problem with a path and no answer",
                    map.name,
                    search.setup()
                ))
            })?;
            let counters = answer.counters;
            Ok([answer.cost, answer.moves.into(), counters.expanded as f64, counters.percolations as f64])
        });
        found.collect()
    };
    SearchKey::all().map(one).collect()
}

fn times(context: &Context<'_>, map: &Map) -> Result<Timed, Error> {
    let grid = map.grid()?;
    let mut queries = queries(context, map, &grid, problems(context, &map.set))?;
    queries.truncate(timed_of(queries.len()));
    let mut study = Study::new(&grid, &queries, context.passes());
    let one = |search: SearchKey| {
        if search.algorithm == Algorithm::Exact && search.heuristic == Heuristic::Euclidean {
            return Ok(None);
        }
        let micros = run(&mut study, &search.setup())?.micros;
        Ok(micros.map(|micros| micros * queries.len() as f64))
    };
    SearchKey::all().map(one).collect()
}

/// The rows of a set from the numbers of its maps.
fn rows_of(set: &str, counted: &[&Counted], timed: &[&Timed]) -> Vec<Row> {
    let searches: Vec<SearchKey> = SearchKey::all().collect();
    let row = |(at, &search): (usize, &SearchKey)| {
        let reference =
            search.reference().and_then(|reference| searches.iter().position(|&search| search == reference));
        let all = || counted.iter().flat_map(|searches| &searches[at]);
        let queries = all().count() as f64;
        let mut row = Row::new()
            .key("set", set)
            .key("algorithm", search.algorithm.name())
            .key("heuristic", search.heuristic.name())
            .key("k", search.k)
            .with("queries", queries);
        for (number, measure) in COUNTS.into_iter().enumerate() {
            let sum: f64 = all().map(|query| query[number]).sum();
            let pairs: Vec<Vec<(f64, f64)>> = counted
                .iter()
                .map(|searches| {
                    let other =
                        |query: usize| reference.map_or(1.0, |reference| searches[reference][query][number]);
                    let numbers = searches[at].iter().enumerate();
                    numbers.map(|(query, numbers)| (numbers[number], other(query))).collect()
                })
                .collect();
            row = row
                .with(measure.column(), sum / queries)
                .with(&error_column(measure), relative_error(&pairs));
        }
        let first = || counted.iter().flat_map(|searches| &searches[at][..timed_of(searches[at].len())]);
        let count = first().count() as f64;
        let expanded: f64 = first().map(|query| query[2]).sum();
        let micros: Option<f64> = timed.iter().map(|searches| *searches.get(at)?).sum();
        row.with("timed", count)
            .with("timed_expanded", expanded / count)
            .with("micros", micros.map(|sum| sum / count))
    };
    searches.iter().enumerate().map(row).collect()
}

/// The relative standard error of the ratio of means of pairs (a, b) that are drawn at random on each of
/// several fixed maps: by the residuals on each map. `None` if a map has only one pair, or if there is no
/// ratio or it is 0.
fn relative_error(maps: &[Vec<(f64, f64)>]) -> Option<f64> {
    let (a, b) = maps.iter().flatten().fold((0.0, 0.0), |(a, b), pair| (a + pair.0, b + pair.1));
    if a == 0.0 || b == 0.0 || maps.iter().any(|pairs| pairs.len() < 2) {
        return None;
    }
    let variance = |pairs: &Vec<(f64, f64)>| {
        let n = pairs.len() as f64;
        let residuals: Vec<f64> = pairs.iter().map(|pair| pair.0 - a / b * pair.1).collect();
        let mean = residuals.iter().sum::<f64>() / n;
        residuals.iter().map(|residual| (residual - mean).powi(2)).sum::<f64>() * n / (n - 1.0)
    };
    Some(maps.iter().map(variance).sum::<f64>().sqrt() / a)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_of_each_map() {
        // Maps of different ratios that do not vary within: no draw of their problems changes that.
        let maps = [vec![(1.0, 1.0), (1.0, 1.0)], vec![(3.0, 1.0), (3.0, 1.0)]];
        assert_eq!(relative_error(&maps), Some(0.0));
        // One map: that of the ratio of means.
        let pairs = vec![(1.0, 2.0), (3.0, 4.0), (2.0, 5.0)];
        let (ratio, error) = mediant_report::stats::ratio_of_means(&pairs).unwrap();
        let ours = relative_error(&[pairs]).unwrap();
        assert!((ours - error / ratio).abs() < 1e-12, "{ours}, not {}", error / ratio);
        assert_eq!(relative_error(&[vec![(1.0, 1.0)]]), None);
        assert_eq!(relative_error(&[vec![(0.0, 1.0); 2]]), None);
    }

    #[test]
    fn rows_are_of_their_searches() {
        let searches: Vec<SearchKey> = SearchKey::all().collect();
        assert_eq!((searches.len(), timed_of(50), timed_of(1)), (36, 5, 1));
        let setups: Vec<String> = searches.iter().map(|search| search.setup()).collect();
        assert_eq!(setups[0], "astar:2:never");
        assert!(setups.contains(&"canonical:7:never,paper,euclidean".to_owned()));
        assert!(setups.iter().all(|text| setup(text).is_ok()));
        // The number of a search in all its columns, twice for the second problem.
        let counted: Counted = (1..=36).map(|n| vec![[f64::from(n); 4], [f64::from(2 * n); 4]]).collect();
        let timed: Timed = (1..=36).map(|n| (n > 1).then_some(f64::from(n))).collect();
        let rows = rows_of("sc1", &[&counted], &[&timed]);
        for ((n, row), search) in (1..).zip(&rows).zip(&searches) {
            assert_eq!(row.number("cost"), Some(1.5 * f64::from(n)));
            assert_eq!(row.number("timed_expanded"), Some(f64::from(n)));
            assert_eq!(row.number("micros"), (n > 1).then_some(f64::from(n)));
            assert_eq!(row.text("k"), search.k.to_string());
            // All ratios are the same, but one is no ratio.
            let error = row.number("moves_error").unwrap();
            assert_eq!(error < 1e-12, search.reference().is_some(), "{search:?}: {error}");
        }
    }
}
