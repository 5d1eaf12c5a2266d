//! 'Iterative h_{2^k} in Practice': the time of h_k by iteration and by linear search.

use std::{hint::black_box, path::Path, time::Instant};

use mediant_moves::{CostTable, FiniteK, LinearSearch, Vector, distance, distance_16, distance_32, octile};
use mediant_oracle::Rng;
use mediant_report::{Axis, Chart, Claim, Column, Mark, Record, Row, Series, Table, stats::median};

use crate::{
    Error,
    context::Context,
    experiment::{Experiment, Findings, Page, Section},
    maps::Map,
};

mod chain;
use chain::{algorithm_2, chain_32, chain_64, chain_128};

pub(crate) const DISTANCE: Experiment = Experiment {
    id: "hormazabal2017-distance",
    page: Page::Hormazabal2017,
    title: "The iterative h_k (Algorithm 2)",
    sets: &[],
    measure,
    show,
};

const FIRST_K: u32 = 3;
const LAST_K: u32 = 12;
const MAX_COORDINATE: i32 = 512;
/// How many times the distances of all vectors are taken in each pass; the median time counts.
const REPEATS: u32 = 7;

/// Random displacements with coordinates up to the largest.
fn displacement(rng: &mut Rng) -> Vector {
    let mut coordinate = || rng.below(2 * MAX_COORDINATE as u32 + 1) as i32 - MAX_COORDINATE;
    Vector::new(coordinate(), coordinate())
}

fn at_random(rng: &mut Rng, count: usize) -> Vec<Vector> {
    (0..count).map(|_| displacement(rng)).collect()
}

/// Walks of 32 steps over the 8-neighborhood, each from a random displacement. As in A*, the distances of all
/// eight neighbors are asked for. A processor predicts the branches of such searches.
fn walks(rng: &mut Rng, count: usize) -> Vec<Vector> {
    let eight = [(0, 1), (1, 1), (1, 0), (1, -1), (0, -1), (-1, -1), (-1, 0), (-1, 1)]
        .map(|(x, y)| Vector::new(x, y));
    let mut vectors = Vec::with_capacity(count);
    while vectors.len() < count {
        let mut at = displacement(rng);
        for _ in 0..32 {
            vectors.extend(eight.map(|step| at + step));
            at = at + eight[rng.below(8) as usize];
        }
    }
    vectors.truncate(count);
    vectors
}

/// The only place that calls `h`, so that the compiler inlines it; a sum would add the latency of its
/// additions.
#[inline(never)]
fn fill(lengths: &mut [f64], vectors: &[Vector], h: &impl Fn(Vector) -> f64) {
    for (length, &vector) in lengths.iter_mut().zip(vectors) {
        *length = h(vector);
    }
}

/// The same by one call for each distance, as a search asks for them: the compiler cannot take several
/// vectors at once.
#[inline(never)]
fn fill_by_calls(lengths: &mut [f64], vectors: &[Vector], h: &dyn Fn(Vector) -> f64) {
    for (length, &vector) in lengths.iter_mut().zip(vectors) {
        *length = h(vector);
    }
}

/// One way to compute h_k, on vectors whose lengths are known.
struct Bench<'a> {
    vectors: &'a [Vector],
    expected: &'a [f64],
    repeats: u32,
    called: bool,
}

impl Bench<'_> {
    /// Nanoseconds for a distance, and how many distances are not as expected.
    fn time(&self, h: impl Fn(Vector) -> f64) -> (Option<f64>, u32) {
        let mut lengths = vec![0.0; self.vectors.len()];
        fill(&mut lengths, self.vectors, &h);
        let differs = |(a, b): (&f64, &f64)| u32::from((a - b).abs() > 1e-6);
        let wrong = lengths.iter().zip(self.expected).map(differs).sum();
        let mut repeat = || {
            let begin = Instant::now();
            if self.called {
                fill_by_calls(black_box(&mut lengths), black_box(self.vectors), &h);
            } else {
                fill(black_box(&mut lengths), black_box(self.vectors), &h);
            }
            begin.elapsed().as_secs_f64() * 1e9 / self.vectors.len() as f64
        };
        let times: Vec<f64> = (0..self.repeats).map(|_| repeat()).collect();
        (median(&times), wrong)
    }
}

fn measure(ctx: &Context<'_>) -> Result<Findings, Error> {
    let (count, mut rng) = (ctx.quick_or(16_384, 65_536), ctx.rng(&Map::new("", Path::new("displacements"))));
    let mut rows = Vec::new();
    for (name, vectors) in [("random", at_random(&mut rng, count)), ("walk", walks(&mut rng, count))] {
        for (how, called) in [("inlined", false), ("called", true)] {
            for n in FIRST_K..=LAST_K {
                let row = row(n, &vectors, REPEATS * ctx.passes(), called)?;
                rows.push(row.key("order", name).key("how", how).key("k", n));
            }
        }
    }
    Ok(Findings {
        columns: columns(),
        rows,
        maps: 0,
        instances: 2 * count as u64,
        drawn: format!(
            "displacements of coordinates up to {MAX_COORDINATE}, half of them at random, half along walks; \
             each way of each k takes all in turn"
        ),
        seeded: true,
    })
}

fn row(n: u32, vectors: &[Vector], repeats: u32, called: bool) -> Result<Row, Error> {
    let wrong = |wrong| Error::Reproduce(format!("k = {n}: {wrong}"));
    let k = black_box(FiniteK::new(n).map_err(wrong)?);
    let (table, linear) = (CostTable::new(k).map_err(wrong)?, LinearSearch::new(k).map_err(wrong)?);
    let expected: Vec<f64> = vectors.iter().map(|&vector| linear.distance(vector)).collect();
    let bench = Bench { vectors, expected: &expected, repeats, called };
    let chain = match n {
        5 => Some(bench.time(chain_32)),
        6 => Some(bench.time(chain_64)),
        7 => Some(bench.time(chain_128)),
        _ => None,
    };
    let closed = match n {
        3 => Some(bench.time(octile)),
        4 => Some(bench.time(distance_16)),
        5 => Some(bench.time(distance_32)),
        _ => None,
    };
    let ways = [
        ("printed", Some(bench.time(|d| algorithm_2(d, n)))),
        ("iterative", Some(bench.time(|d| distance(d, k)))),
        ("linear", Some(bench.time(|d| linear.distance(d)))),
        ("chain", chain),
        ("closed", closed),
        ("table", Some(bench.time(|d| table.distance(d).to_f64()))),
    ];
    let mut row = Row::new().with("sum", expected.iter().sum::<f64>());
    let mut differing = 0;
    for (column, way) in ways {
        let Some((nanos, wrong)) = way else { continue };
        differing += wrong;
        row = row.with(column, nanos);
    }
    Ok(row.with("differing", f64::from(differing)))
}

fn columns() -> Vec<Column> {
    vec![
        Column::key("order", "displacements at random, or along walks, each near the last"),
        Column::key("how", "inlined into the loop over the vectors, or called for each"),
        Column::key("k", "h_k"),
        Column::count("sum", "cells", "the sum of all distances"),
        Column::count(
            "differing",
            "",
            "distances that two ways differ in by more than a millionth of a cell",
        ),
        Column::time("printed", "ns", "Algorithm 2, as the paper prints it, without its misprints"),
        Column::time(
            "iterative",
            "ns",
            "Algorithm 2 as the project has it: without branches, unrolled for k up to 10",
        ),
        Column::time("linear", "ns", "the linear search over a table of moves and lengths"),
        Column::time(
            "chain",
            "ns",
            "the linear search as the papers' Algorithm 1 prints it: an `if` a move, moves and lengths \
             constants",
        ),
        Column::time("closed", "ns", "the closed forms of h_3, h_4 and h_5"),
        Column::time("table", "ns", "in fixed-point costs, from a table, as searches take it"),
    ]
}

/// The ways by their columns and names.
const WAYS: [(&str, &str); 6] = [
    ("printed", "Algorithm 2, as printed"),
    ("iterative", "Algorithm 2, ours"),
    ("linear", "linear search, table"),
    ("chain", "linear search, `if`s"),
    ("closed", "closed form"),
    ("table", "fixed point"),
];

fn show(record: &Record) -> Section {
    let mut section = Section::default();
    section.text(
        "Nanoseconds for one distance. What decides is whether the processor predicts the branches of the \
         searches: for random displacements it cannot; along a walk, as in a search, where each displacement \
         is near the last, it can. Inlined into a loop, the compiler may also take several vectors at once; \
         a search calls for one at a time.",
    );
    let mut heading = vec!["order", "how", "k"];
    heading.extend(WAYS.map(|(_, name)| name));
    heading.extend(["printed / `if`s", "printed / table", "ours / table", "sum of distances"]);
    let mut table = Table::new(heading).names(2);
    for row in &record.rows {
        let ratio =
            |a: &str, b: &str| quotient(row, a, b).map_or(String::new(), |ratio| format!("{ratio:.2}"));
        let mut cells =
            vec![row.text("order").to_owned(), row.text("how").to_owned(), row.text("k").to_owned()];
        cells.extend(
            WAYS.map(|(column, _)| row.number(column).map_or(String::new(), |nanos| format!("{nanos:.2}"))),
        );
        cells.extend([ratio("printed", "chain"), ratio("printed", "linear"), ratio("iterative", "linear")]);
        cells.push(row.number("sum").map_or(String::new(), mediant_report::thousands));
        table.row(cells);
    }
    section.table(&table);
    for order in record.distinct("order") {
        for how in record.distinct("how") {
            let alternative = format!("Nanoseconds for a distance by k, {order}, {how}");
            section.figure(
                &format!("hormazabal2017-distance-{order}-{how}"),
                &alternative,
                chart(record, order, how),
            );
        }
    }
    section.claims(claims(record), true);
    section
}

fn quotient(row: &Row, a: &str, b: &str) -> Option<f64> {
    Some(row.number(a)? / row.number(b)?)
}

fn chart(record: &Record, order: &str, how: &str) -> String {
    let which = if order == "walk" { "each near the last" } else { "at random" };
    let ticks = (FIRST_K..=LAST_K).map(|k| (f64::from(k), k.to_string()));
    let note = format!(
        "n = {} displacements, {which}, {how}; median",
        mediant_report::thousands(record.provenance.instances as f64 / 2.0)
    );
    let mut chart =
        Chart::new("Time of h_k", Axis::new("k").ticks(ticks), Axis::new("time of a distance in ns").log())
            .note(note);
    for (column, name) in WAYS {
        let point = |row: &Row| Some((row.text("k").parse().ok()?, row.number(column)?));
        let points: Vec<(f64, f64)> =
            record.select(&[("order", order), ("how", how)]).filter_map(point).collect();
        chart.push(Series::new(name.replace('`', ""), Mark::Line, points));
    }
    chart.svg()
}

fn claims(record: &Record) -> Vec<Claim> {
    let of = |order: &str, k: u32, b: &str| {
        let keys = [("order", order), ("how", "called")];
        let row = record.select(&keys).find(|row| row.text("k") == k.to_string())?;
        quotient(row, "printed", b)
    };
    let told = |order: &str, b: &str| {
        let ratios =
            [5, 6, 7].map(|k| of(order, k, b).map_or("–".to_owned(), |ratio| format!("{ratio:.2}")));
        ratios.join(", ")
    };
    let cause = format!(
        "The ratio depends on what is asked for and on how the linear search is written, both of which the \
         paper leaves open. Algorithm 2 as printed takes, at k = 5, 6, 7: {} of the time of a search over a \
         table of moves on displacements at random, {} along walks, where branches are predicted; {} and {} \
         of that of the printed Algorithm 1, one `if` a move with all moves constants of the program. The \
         published range lies within what these four span.",
        told("random", "linear"),
        told("walk", "linear"),
        told("random", "chain"),
        told("walk", "chain")
    );
    let claim = |k| {
        let what = format!(
            "time of the printed iterative h_{k} over that of the linear search, displacements at random, \
             0.65 to 0.75"
        );
        // The range is its center and so much to each side.
        let claim = Claim::new("Iterative h_2^k in Practice", what, 0.7, of("random", k, "linear"));
        claim.within(0.05 / 0.7 + 1e-9).of_times(true).because(&cause)
    };
    [5, 6, 7].map(claim).to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_ways_agree() {
        let mut rng = Rng::new(7);
        let (random, walk) = (at_random(&mut rng, 2000), walks(&mut rng, 2000));
        assert_eq!((random.len(), walk.len()), (2000, 2000));
        for n in FIRST_K..=LAST_K {
            for vectors in [&random, &walk] {
                let row = row(n, vectors, 0, true).unwrap();
                assert_eq!(row.number("differing"), Some(0.0), "k = {n}");
                assert_eq!(row.number("linear"), None);
            }
        }
    }

    #[test]
    fn walks_step_by_step() {
        let walk = walks(&mut Rng::new(7), 256);
        // The centers of consecutive rounds are neighbors.
        let center = |round: &[Vector]| round[0] + Vector::new(0, -1);
        let centers: Vec<Vector> = walk.chunks(8).map(center).collect();
        assert!(centers.windows(2).all(|pair| (pair[1] + Vector::new(-pair[0].x, -pair[0].y)).norm() < 1.5));
    }
}
