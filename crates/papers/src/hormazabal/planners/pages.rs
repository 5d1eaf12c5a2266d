//! The section of the page.

use mediant_report::{Axis, Chart, Claim, Mark, Record, Row, Series, Table, number, stats, thousands};

use super::{ANYA, ANYA_CLOSED, CONTRACTED, KS, SMOOTHINGS, SUB2_A_STAR, SUB2_THETA};
use crate::experiment::Section;

/// A column of a planner on a set.
fn of(record: &Record, set: &str, engine: &str, k: &str, smoothing: &str, column: &str) -> Option<f64> {
    record.number(&[("set", set), ("engine", engine), ("k", k), ("smoothing", smoothing)], column)
}

/// A column of Sub2-A*(k) on a set.
fn a_star(record: &Record, set: &str, k: u32, smoothing: &str, column: &str) -> Option<f64> {
    of(record, set, SUB2_A_STAR, &k.to_string(), smoothing, column)
}

fn theta(record: &Record, set: &str, column: &str) -> Option<f64> {
    of(record, set, SUB2_THETA, "3", "none", column)
}

fn anya(record: &Record, set: &str, column: &str) -> Option<f64> {
    of(record, set, ANYA, "any", "none", column)
}

/// A column of Sub2-Theta* divided by that of Sub2-A*(k).
fn ratio(record: &Record, set: &str, k: u32, smoothing: &str, column: &str) -> Option<f64> {
    Some(theta(record, set, column)? / a_star(record, set, k, smoothing, column)?)
}

pub(in crate::hormazabal) fn show(record: &Record) -> Section {
    let mut section = Section::default();
    let smoothed = |smoothing| match smoothing {
        "smooth" => "smoothed",
        "taut" => "pulled taut",
        _ => "not smoothed",
    };
    section.heading("Excess and time against Sub2-Theta* (Figures 2 and 3)");
    section.text(
        "Ratios over 1 are in favor of Sub2-A*(k). The excess is the mean of the lengths over the any-angle \
         optimum, less 1.",
    );
    for (_, smoothing) in SMOOTHINGS {
        let name = format!("hormazabal2017-planners-excess-{smoothing}");
        let title = format!("Excess of Sub2-Theta* over that of Sub2-A*(k), {}", smoothed(smoothing));
        section.figure(&name, &title, ratios(record, &title, smoothing, "excess"));
    }
    for (_, smoothing) in SMOOTHINGS {
        let name = format!("hormazabal2017-planners-time-{smoothing}");
        let title = format!("Time of Sub2-Theta* over that of Sub2-A*(k), {}", smoothed(smoothing));
        section.figure(&name, &title, ratios(record, &title, smoothing, "micros"));
    }
    section.heading("Excess and time beside Anya (Figure 4)");
    for set in record.distinct("set") {
        let name = format!("hormazabal2017-planners-scatter-{set}");
        section.figure(&name, &format!("Time and excess of the planners on {set}"), scatter(record, set));
    }
    section.heading("The planners");
    section.text(
        "Without smoothing, smoothed (one pass, a straight line where two points of the path see each other) \
         and pulled taut. `subgoal` is the project's contraction hierarchy on the same graph \
         (`levels=contracted`), which the paper does not have.",
    );
    section.table(&table(record));
    section.heading("Published and here");
    section.claims(claims(record), true);
    section
}

fn ticks() -> impl Iterator<Item = (f64, String)> {
    KS.map(|k| (f64::from(k), k.to_string()))
}

fn sample(record: &Record) -> String {
    let count = |set: &str| theta(record, set, "found").map_or_else(String::new, thousands);
    let counts: Vec<String> =
        record.distinct("set").into_iter().map(|set| format!("{set} {}", count(set))).collect();
    format!("n: {}", counts.join(", "))
}

fn ratios(record: &Record, title: &str, smoothing: &str, column: &str) -> String {
    let axis = if column == "micros" { Axis::new("time ratio") } else { Axis::new("excess ratio").log() };
    let mut chart = Chart::new(title, Axis::new("k").ticks(ticks()), axis).note(sample(record));
    let (first, last) = (f64::from(*KS.start()), f64::from(*KS.end()));
    chart.push(Series::new("equal", Mark::Reference, [(first, 1.0), (last, 1.0)]));
    for set in record.distinct("set") {
        let points = KS.filter_map(|k| Some((f64::from(k), ratio(record, set, k, smoothing, column)?)));
        chart.push(Series::new(set, Mark::Line, points));
    }
    chart.svg()
}

fn scatter(record: &Record, set: &str) -> String {
    let count = theta(record, set, "found").map_or_else(String::new, thousands);
    let mut chart = Chart::new(
        format!("Time and excess: {set}"),
        Axis::new("mean time of a query in µs").log(),
        Axis::new("excess over the any-angle optimum in %").log(),
    )
    .note(format!("n = {count} queries; Sub2-A* by k"));
    let point = |row: &Row| Some((row.number("micros")?, row.number("excess")?.max(0.0)));
    for (_, smoothing) in SMOOTHINGS {
        let keys = [("set", set), ("engine", SUB2_A_STAR), ("smoothing", smoothing)];
        let points: Vec<(f64, f64)> = record.select(&keys).filter_map(point).collect();
        let labels =
            record.select(&keys).filter(|row| point(row).is_some()).map(|row| row.text("k").to_owned());
        let name = if smoothing == "none" { "Sub2-A*".to_owned() } else { format!("Sub2-A*, {smoothing}") };
        chart.push(Series::new(name, Mark::Points, points).labels(labels));
    }
    for (engine, name) in [(SUB2_THETA, "Sub2-Theta*"), (CONTRACTED, "subgoal, contracted")] {
        let keys = [("set", set), ("engine", engine)];
        let rows = || record.select(&keys).filter(|row| row.text("k") != "any" && point(row).is_some());
        let labels =
            rows().map(|row| if engine == CONTRACTED { row.text("k").to_owned() } else { String::new() });
        chart.push(Series::new(name, Mark::Points, rows().filter_map(point)).labels(labels));
    }
    // Both are optimal: their points stand on the lower border.
    for (engine, name) in [(ANYA, "Anya"), (CONTRACTED, "subgoal, any angle")] {
        if let Some(micros) = of(record, set, engine, "any", "none", "micros") {
            chart.push(Series::new(name, Mark::Points, [(micros, 0.0)]));
        }
    }
    chart.svg()
}

fn table(record: &Record) -> Table {
    let mut table = Table::new([
        "set",
        "planner",
        "k",
        "smoothing",
        "excess in %",
        "largest ratio",
        "expanded",
        "time in µs",
        "preparation in s",
        "index in MB",
    ])
    .names(4);
    for row in &record.rows {
        let text = |column: &str| row.number(column).map_or("–".to_owned(), number);
        table.row([
            row.text("set").to_owned(),
            row.text("engine").to_owned(),
            row.text("k").to_owned(),
            row.text("smoothing").to_owned(),
            row.number("excess").map_or("–".to_owned(), |excess| format!("{:.6}", excess.max(0.0))),
            row.number("worst").map_or("–".to_owned(), |worst| format!("{worst:.5}")),
            row.number("expanded").map_or("–".to_owned(), thousands),
            text("micros"),
            text("preparation"),
            row.number("bytes").map_or("–".to_owned(), |bytes| number(bytes / 1e6)),
        ]);
    }
    table
}

/// The values of all sets; none if one is missing.
fn of_sets(record: &Record, of_set: impl Fn(&str) -> Option<f64>) -> Option<Vec<f64>> {
    record.distinct("set").into_iter().map(of_set).collect()
}

/// The text of a number; a dash for none.
fn told(value: Option<f64>, digits: usize) -> String {
    value.map_or("–".to_owned(), |value| format!("{value:.digits$}"))
}

/// Our Anya takes so much of the time of Anya16: the geometric mean of 18 maps on the page `compared.md`,
/// `anya:any:closed`.
const OF_JAVA_ANYA: f64 = 0.23;

const LAST_K: u32 = *KS.end();

fn claims(record: &Record) -> Vec<Claim> {
    let mut claims: Vec<Claim> = record
        .distinct("set")
        .into_iter()
        .flat_map(|set| ["none", "smooth"].map(|smoothing| faster(record, set, smoothing)))
        .collect();
    let excess = |smoothing: &str| {
        let excesses = of_sets(record, |set| a_star(record, set, LAST_K, smoothing, "excess"))?;
        stats::mean(&excesses)
    };
    let (smoothed, taut) = (excess("smooth"), excess("taut").map(|taut| taut.max(0.0)));
    let cause = format!(
        "How far smoothing goes decides. At k = {LAST_K}, in the mean of the sets, paths are {} % too long \
         as they come, {} % after one pass that replaces steps by a straight line where the ends see each \
         other, and {} % pulled taut. The published values lie between the last two; the paper says neither \
         for which k they are nor how its pass picks the ends.",
        told(excess("none"), 4),
        told(smoothed, 5),
        told(taut, 6)
    );
    for (source, published) in [("Abstract", 0.0005), ("Introduction", 0.0003)] {
        let what = format!("excess of Sub2-A*({LAST_K}), smoothed, mean of the sets");
        claims.push(Claim::new(source, what, published, smoothed).written(5, " %").because(&cause));
    }
    let sets = record.distinct("set").len() as f64;
    let within = of_sets(record, |set| a_star(record, set, LAST_K, "taut", "excess"));
    let within = within.map(|excesses| excesses.iter().filter(|&&excess| excess <= 0.0005).count() as f64);
    let what =
        format!("sets on which Sub2-A*({LAST_K}), pulled taut, is at most 0.0005 % longer than any angle");
    claims.push(Claim::new("Abstract", what, sets, within).exact(0));
    claims.push(beside_anya(record));
    claims
}

/// The claim at how many k Sub2-A* is faster than Sub2-Theta*.
fn faster(record: &Record, set: &str, smoothing: &str) -> Claim {
    let ratios: Option<Vec<f64>> = KS.map(|k| ratio(record, set, k, smoothing, "micros")).collect();
    let ours = ratios.map(|ratios| ratios.iter().filter(|&&ratio| ratio > 1.0).count() as f64);
    let what =
        format!("{set}, smoothing {smoothing}: k, of 7, at which Sub2-A*(k) is faster than Sub2-Theta*");
    let claim = Claim::new("Comparing Sub2-Theta* with Sub2-A*(k)", what, 7.0, ours).exact(0).of_times(true);
    claim.because(format!(
        "On {set}, at k = {LAST_K}, Sub2-A* expands {} nodes, Sub2-Theta*, on the graph of k = 3, {}: the \
         former takes {} µs, and {} µs with smoothing, the latter {} µs. (The paper shows no plot of random \
         maps.)",
        told(a_star(record, set, LAST_K, "none", "expanded"), 0),
        told(theta(record, set, "expanded"), 0),
        told(a_star(record, set, LAST_K, "none", "micros"), 0),
        told(a_star(record, set, LAST_K, "smooth", "micros"), 0),
        told(theta(record, set, "micros"), 0),
    ))
}

/// The claim how many times as fast as Anya Sub2-A* is.
fn beside_anya(record: &Record) -> Claim {
    let mean = |of_set: &dyn Fn(&str) -> Option<f64>| stats::geometric_mean(&of_sets(record, of_set)?);
    let over = |smoothing: &'static str, reference: fn(&Record, &str, &str) -> Option<f64>| {
        mean(&|set: &str| {
            Some(reference(record, set, "micros")? / a_star(record, set, LAST_K, smoothing, "micros")?)
        })
    };
    let ours = over("smooth", anya);
    let closed = over("smooth", |record, set, column| of(record, set, ANYA_CLOSED, "any", "none", column));
    let subgoal = mean(&|set: &str| {
        Some(anya(record, set, "micros")? / of(record, set, CONTRACTED, "any", "none", "micros")?)
    });
    let cause = format!(
        "Anya is another program here: ours takes {OF_JAVA_ANYA} of the time of Anya16, the Java program of \
         its authors, which the paper ran (geometric mean of 18 maps, both under closed gaps: \
         [compared](compared.md)). Over Sub2-A*({LAST_K}), smoothed, ours takes {} times as long, {} times \
         not smoothed, {} times with closed gaps; so that Java program would take some {} times as long. The \
         contraction hierarchy at any angle, with nothing longer than optimal, is faster than our Anya by \
         {}.",
        told(ours, 1),
        told(over("none", anya), 1),
        told(closed, 1),
        told(closed.map(|ratio| ratio / OF_JAVA_ANYA), 0),
        told(subgoal, 1),
    );
    let what =
        format!("times that Sub2-A*({LAST_K}), smoothed, is as fast as Anya, geometric mean of the sets");
    Claim::new("Abstract", what, 10.0, ours).written(1, "").of_times(true).because(cause)
}
