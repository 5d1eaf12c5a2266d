//! The section of Tables 1 and 2, and Figure 3.

use mediant_report::{Claim, Record, Table, thousands};

use super::{
    super::{
        causes, charts,
        published::SETS,
        searches::{Algorithm, BASE, Heuristic, KS, Measure, SearchKey},
    },
    error_column,
};
use crate::experiment::Section;

pub(in crate::rivera) fn show(record: &Record) -> Section {
    let mut section = Section::default();
    section.text(
        "The paper's problems are lost, so numbers are compared as ratios: each to that of 2^3 = 8 neighbors \
         in its own column, with the same problems in both. Of 8 neighbors itself, those with the Euclidean \
         heuristic to those with h_k, and canonical A* to A*; what remains (cost, moves, expansions and \
         percolations of A* with h_k) as it is. The draw's error is that of the problems on each map.",
    );
    let sets: Vec<&str> = record.distinct("set");
    for (number, algorithm) in [(1, Algorithm::AStar), (2, Algorithm::Paper)] {
        section.heading(&format!("Table {number}: {}", algorithm.words()));
        for &set in &sets {
            section.text(format!("{}, {} problems", title(set), queries(record, set)));
            section.table(&table(record, set, algorithm));
        }
    }
    section.claims(claims(record, |search| search.k != BASE), false);
    section.heading("Columns beside each other, at 8 neighbors");
    section.claims(claims(record, |search| search.k == BASE), true);
    section.heading("Figure 3: time against the number of neighbors");
    for &set in sets.iter().take(1) {
        if let Some(svg) = charts::runtime(record, set) {
            section.figure(
                "rivera2017-tables-time",
                "Time of a query against the number of neighbors, of A* and canonical A* with both \
                 heuristics",
                svg,
            );
        }
        if let Some(svg) = charts::expansion(record, set) {
            section.figure(
                "rivera2017-tables-expansion",
                "Time of an expansion against the number of neighbors, of the same searches",
                svg,
            );
        }
    }
    section.heading("What the text says");
    section.claims(sentences(record), true);
    section.heading("The published rule of canonical A*, and an exact one");
    section.text(
        "Canonical A* as published does not always find a shortest path over N(k) for k ≥ 4; the exact rule \
         does. Longer: mean cost over that of A*, less 1.",
    );
    section.table(&rules(record, &sets));
    section
}

/// A set's name in the paper.
fn title(set: &str) -> &str {
    SETS.iter().find(|(name, _)| *name == set).map_or(set, |(_, title)| title)
}

fn queries(record: &Record, set: &str) -> String {
    let queries = record.select(&[("set", set)]).next().and_then(|row| row.number("queries"));
    thousands(queries.unwrap_or_default())
}

/// The columns of a table of the paper.
fn printed(algorithm: Algorithm) -> impl Iterator<Item = (Heuristic, Measure)> {
    let all =
        Heuristic::ALL.into_iter().flat_map(|heuristic| Measure::ALL.map(|measure| (heuristic, measure)));
    all.filter(move |&(heuristic, measure)| match measure {
        // Printed once for both heuristics.
        Measure::Cost | Measure::Moves => algorithm == Algorithm::AStar && heuristic == Heuristic::Hk,
        Measure::Expanded | Measure::Percolations | Measure::Time => true,
    })
}

/// The name of a column.
fn column((heuristic, measure): (Heuristic, Measure)) -> String {
    let unit = if measure == Measure::Time { " (ms)" } else { "" };
    match measure {
        Measure::Cost | Measure::Moves => measure.words().to_owned(),
        _ => format!("{}{unit}, {}", measure.words(), heuristic.words()),
    }
}

/// Our value of a published number, in its unit.
fn ours(record: &Record, set: &str, search: SearchKey, measure: Measure) -> Option<f64> {
    let unit = if measure == Measure::Time { 1000.0 } else { 1.0 };
    Some(search.number(record, set, measure.column())? / unit)
}

fn written(measure: Measure, number: Option<f64>) -> String {
    match (measure, number) {
        (_, None) => String::new(),
        (Measure::Cost, Some(number)) => format!("{number:.1}"),
        (Measure::Time, Some(number)) => format!("{number:.2}"),
        (_, Some(number)) => thousands(number),
    }
}

/// One table of the paper, of one set: four rows for each of its columns.
fn table(record: &Record, set: &str, algorithm: Algorithm) -> Table {
    let heading = ["".to_owned(), "2^k".to_owned()].into_iter().chain(KS.map(|k| (1 << k).to_string()));
    let mut table = Table::new(heading).names(2);
    for (heuristic, measure) in printed(algorithm) {
        let searches = KS.map(|k| SearchKey { algorithm, heuristic, k });
        let row = |first: &str, second: &str, texts: [String; 6]| {
            [first.to_owned(), second.to_owned()].into_iter().chain(texts).collect::<Vec<_>>()
        };
        let known = SETS.iter().any(|(name, _)| *name == set);
        let name = column((heuristic, measure));
        let here = searches.map(|search| written(measure, ours(record, set, search, measure)));
        if !known {
            table.row(row(&name, "here", here));
            continue;
        }
        table.row(row(
            &name,
            "published",
            searches.map(|search| written(measure, search.published(set, measure))),
        ));
        table.row(row("", "here", here));
        let claims =
            searches.map(|search| (search.k != BASE).then(|| claim(record, set, search, measure)).flatten());
        let published = |claim: &Option<Claim>| {
            claim.as_ref().map_or("1".to_owned(), |claim| claim.text(claim.published))
        };
        let ours = |claim: &Option<Claim>| match claim {
            None => "1".to_owned(),
            Some(claim) => {
                let text = claim.ours.map(|ours| claim.text(ours)).unwrap_or_default();
                format!("{text} {}", claim.verdict().mark())
            }
        };
        table.row(row("", "to 8, published", claims.each_ref().map(published)));
        table.row(row("", "to 8, here", claims.each_ref().map(ours)));
    }
    table
}

/// A number of the tables as a claim: a ratio, if the search has a reference. None for a time without a
/// reference.
fn claim(record: &Record, set: &str, search: SearchKey, measure: Measure) -> Option<Claim> {
    let number = if search.algorithm == Algorithm::AStar { 1 } else { 2 };
    let source = format!("Table {number}, {}", column((search.heuristic, measure)));
    let (mut published, mut here) = (search.published(set, measure)?, ours(record, set, search, measure));
    let mut what = format!("{}, 2^k = {}", title(set), 1 << search.k);
    let digits = match (search.reference(), measure) {
        (None, Measure::Time) => return None,
        (None, Measure::Cost) => 1,
        (None, _) => 0,
        (Some(reference), _) => {
            what += &match (reference.k == search.k, reference.algorithm == search.algorithm) {
                (false, _) => format!(" over {}", 1 << BASE),
                (true, true) => format!(", over {}", reference.heuristic.words()),
                (true, false) => format!(", over {}", reference.algorithm.words()),
            };
            published /= reference.published(set, measure)?;
            here = here.zip(ours(record, set, reference, measure)).map(|(a, b)| a / b);
            3
        }
    };
    let error = search.number(record, set, &error_column(measure));
    let claim = Claim::new(source, what, published, here).standard_error(error).written(digits, "");
    Some(claim.of_times(measure == Measure::Time).because(causes::of(record, search, measure)))
}

/// The claims of those searches of both tables that are asked for.
fn claims(record: &Record, asked: impl Fn(SearchKey) -> bool) -> Vec<Claim> {
    let mut claims = Vec::new();
    for algorithm in [Algorithm::AStar, Algorithm::Paper] {
        for (heuristic, measure) in printed(algorithm) {
            for (set, _) in SETS {
                let searches = KS
                    .map(|k| SearchKey { algorithm, heuristic, k })
                    .into_iter()
                    .filter(|&search| asked(search));
                claims.extend(searches.filter_map(|search| claim(record, set, search, measure)));
            }
        }
    }
    claims
}

/// In how many cases `holds` is true; none if a case was not measured.
fn count(holds: impl Iterator<Item = Option<bool>>) -> Option<f64> {
    let all: Option<Vec<bool>> = holds.collect();
    Some(all?.into_iter().filter(|&holds| holds).count() as f64)
}

/// The claims of the paper's text about its tables. Where the printed numbers allow counting, the count is
/// what is claimed.
fn sentences(record: &Record) -> Vec<Claim> {
    let time = |set: &str, algorithm, heuristic, k| {
        ours(record, set, SearchKey { algorithm, heuristic, k }, Measure::Time)
    };
    let less = |a: Option<f64>, b: Option<f64>| a.zip(b).map(|(a, b)| a < b);
    let all = || SETS.into_iter().flat_map(|(set, _)| KS.map(|k| (set, k)));
    let steps = || all().filter(|&(_, k)| k > KS[0]);
    let source = "Empirical Findings";
    let (a_star, paper, hk, euclidean) =
        (Algorithm::AStar, Algorithm::Paper, Heuristic::Hk, Heuristic::Euclidean);
    let cost = |set, k| ours(record, set, SearchKey { algorithm: a_star, heuristic: hk, k }, Measure::Cost);
    let said = |what: &str, published: f64, of: usize, ours, cause: &str| {
        let claim = Claim::new(source, what, published, ours).within(0.0).written(0, &format!(" of {of}"));
        claim.because(cause)
    };
    let mut claims = vec![
        said(
            "steps of k that shorten the mean path",
            15.0,
            15,
            count(steps().map(|(set, k)| less(cost(set, k), cost(set, k - 1)))),
            "",
        ),
        said(
            "steps of k that make A* with h_k slower",
            15.0,
            15,
            count(steps().map(|(set, k)| less(time(set, a_star, hk, k - 1), time(set, a_star, hk, k)))),
            causes::SLOWER,
        )
        .of_times(true),
        said(
            "sets and k at which A* is faster with h_k than with the Euclidean heuristic",
            18.0,
            18,
            count(all().map(|(set, k)| less(time(set, a_star, hk, k), time(set, a_star, euclidean, k)))),
            &causes::faster(record, Algorithm::AStar),
        )
        .of_times(true),
        said(
            "sets, k and heuristics at which canonical A* is faster than A* (in the tables all but BG, 4 \
             neighbors, h_k)",
            35.0,
            36,
            count(all().flat_map(|(set, k)| {
                Heuristic::ALL
                    .map(|heuristic| less(time(set, paper, heuristic, k), time(set, a_star, heuristic, k)))
            })),
            &causes::canonical(record),
        )
        .of_times(true),
    ];
    claims.extend(SETS.into_iter().map(|(set, name)| {
        let faster = |k: &u32| less(time(set, paper, hk, *k), time(set, paper, euclidean, *k));
        let measured = KS.iter().all(|k| faster(k).is_some());
        let largest = KS.into_iter().rfind(|k| faster(k) == Some(true)).map_or(0.0, f64::from);
        let what = format!("{name}: largest k at which canonical A* is faster with h_k");
        let claim = Claim::new(source, what, 5.0, measured.then_some(largest)).within(0.0).written(0, "");
        claim.of_times(true).because(causes::faster(record, Algorithm::Paper))
    }));
    claims
}

/// A table of what the published pruning rule saves and what it costs.
fn rules(record: &Record, sets: &[&str]) -> Table {
    let mut table = Table::new([
        "set",
        "2^k",
        "longer, published rule (%)",
        "expansions, published rule",
        "expansions, exact",
        "ms, A*",
        "ms, published rule",
        "ms, exact",
    ]);
    for &set in sets {
        for k in KS {
            let of = |algorithm, measure| {
                ours(record, set, SearchKey { algorithm, heuristic: Heuristic::Hk, k }, measure)
            };
            let longer = of(Algorithm::Paper, Measure::Cost).zip(of(Algorithm::AStar, Measure::Cost));
            let longer = longer
                .map_or(String::new(), |(paper, optimal)| format!("{:.3}", 100.0 * (paper / optimal - 1.0)));
            let text = |algorithm, measure| written(measure, of(algorithm, measure));
            table.row([
                title(set).to_owned(),
                (1 << k).to_string(),
                longer,
                text(Algorithm::Paper, Measure::Expanded),
                text(Algorithm::Exact, Measure::Expanded),
                text(Algorithm::AStar, Measure::Time),
                text(Algorithm::Paper, Measure::Time),
                text(Algorithm::Exact, Measure::Time),
            ]);
        }
    }
    table
}
