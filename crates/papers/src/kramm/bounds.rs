//! The bounds Γ_k at corners and at centers, how tight they are, and the trees of decompositions behind their
//! proof.

use mediant_moves::{
    DecompositionTree, FiniteK, Vector, bound_at_centers, bound_at_corners, decompose, distance, level,
};
use mediant_report::{Axis, Chart, Claim, Column, Mark, Record, Row, Series, Table, TreeDrawing};

use super::{SLACK, center::Worst};
use crate::{
    Error,
    context::Context,
    experiment::{Experiment, Findings, Page, Section},
};

pub(crate) const BOUNDS: Experiment = Experiment {
    id: "kramm2018-bounds",
    page: Page::Kramm2018,
    title: "The bounds, and instances that attain them (Theorems 2 and 3, Figures 5 and 6)",
    sets: &[],
    measure,
    show,
};

const FIRST_K: u32 = 2;
const LAST_K: u32 = 12;
/// The k at which the rate of Γ_k is read off: the next term, in 1/k³, is about 4/k of it there.
const LARGE_K: u32 = 10_000;

fn finite_k(k: u32) -> Result<FiniteK, Error> {
    FiniteK::new(k).map_err(|wrong| Error::Reproduce(wrong.to_string()))
}

/// The displacement within `side` cells each way whose length over N(k) exceeds the straight line most; the
/// first, if there are several.
fn tightest(k: FiniteK, side: i32) -> (f64, Vector) {
    let mut worst = (0.0, Vector::ZERO);
    for y in 1..=side {
        for x in 0..=y {
            let d = Vector::new(x, y);
            let ratio = distance(d, k) / d.norm();
            if ratio > worst.0 {
                worst = (ratio, d);
            }
        }
    }
    worst
}

/// The paper's goal (n, ⌊n(s + m)⌋), m = k − 2, s = √(m² + 1), with the largest n of those within `side`
/// cells.
fn bisecting(k: FiniteK, side: i32) -> Vector {
    let m = f64::from(k.depth());
    let slope = (m * m + 1.0).sqrt() + m;
    let goal = |n: i32| Vector::new(n, (f64::from(n) * slope).floor() as i32);
    (1..=side).map(goal).take_while(|goal| goal.y <= side).last().unwrap_or(Vector::ZERO)
}

fn measure(ctx: &Context<'_>) -> Result<Findings, Error> {
    let side = ctx.quick_or(500, 2000);
    let worst = Worst::new()?;
    let mut rows = Vec::new();
    for k in FIRST_K..=LAST_K {
        let neighborhood = finite_k(k)?;
        let (tight, at) = tightest(neighborhood, side);
        let goal = bisecting(neighborhood, side);
        let (bound, center) = (bound_at_corners(neighborhood), worst.ratio(k)?);
        let row = Row::new().key("k", k).with("bound", bound).with("tight", tight);
        let row = row.with("x", f64::from(at.x)).with("y", f64::from(at.y));
        let row = row.with("bisecting", distance(goal, neighborhood) / goal.norm());
        let row = row.with("violations", f64::from(u8::from(tight > bound * SLACK)));
        rows.push(row.with("center_bound", bound_at_centers(neighborhood)).with("center", center));
    }
    let large = bound_at_corners(finite_k(LARGE_K)?);
    rows.push(Row::new().key("k", LARGE_K).with("bound", large));
    let vectors = i64::from(side) * i64::from(side + 3) / 2;
    Ok(Findings {
        columns: columns(),
        rows,
        maps: 0,
        instances: vectors as u64,
        drawn: format!("all displacements (x, y) with 0 ≤ x ≤ y and 0 < y ≤ {side}, on an empty grid"),
        seeded: false,
    })
}

fn columns() -> Vec<Column> {
    vec![
        Column::key("k", "paths over the 2^k neighborhood"),
        Column::count("bound", "", "Γ_k with vertices at cell corners (Theorem 2)"),
        Column::count("tight", "", "largest ratio of h_k to the straight line on an empty grid"),
        Column::count("x", "cells", "the displacement that has this ratio"),
        Column::count("y", "cells", "the displacement that has this ratio"),
        Column::count(
            "bisecting",
            "",
            "the ratio at the paper's goal in the direction that bisects (0, 1) and (1, k - 2)",
        ),
        Column::count("violations", "", "1 if a ratio exceeds the bound"),
        Column::count("center_bound", "", "the bound with vertices at cell centers (Theorem 3)"),
        Column::count("center", "", "the ratio of the instance of Figure 6"),
    ]
}

fn percent(ratio: f64) -> f64 {
    100.0 * (ratio - 1.0)
}

/// The rows of the table, with their k.
fn tabled(record: &Record) -> impl Iterator<Item = (u32, &Row)> {
    let with_k = |row| Some((Row::text(row, "k").parse().ok()?, row));
    record.rows.iter().filter_map(with_k).filter(|(k, _)| *k <= LAST_K)
}

fn show(record: &Record) -> Section {
    let mut section = Section::default();
    let mut table = Table::new([
        "k",
        "Γ_k",
        "largest ratio",
        "at",
        "Γ_k less it",
        "bisecting",
        "centers: bound",
        "Figure 6",
    ]);
    for (k, row) in tabled(record) {
        let text =
            |column: &str| row.number(column).map_or("–".to_owned(), |number| format!("{number:.7}"));
        let at = |column: &str| row.number(column).map_or("–".to_owned(), |number| format!("{number:.0}"));
        table.row([
            k.to_string(),
            text("bound"),
            text("tight"),
            format!("({}, {})", at("x"), at("y")),
            gap(row),
            text("bisecting"),
            text("center_bound"),
            text("center"),
        ]);
    }
    section.table(&table);
    section.text(
        "The largest ratio on an empty grid comes as near to Γ_k as a displacement comes to the direction \
         that bisects (0, 1) and (1, k − 2). `bisecting` is the ratio at the paper's goal (n, ⌊n(√((k − 2)² \
         + 1) + k − 2)⌋). (The paper subtracts n there from the number of moves (0, 1); it is n(k − 2).) \
         Between centers no k ≥ 3 helps: the instance of Figure 6 attains the bound at each.",
    );
    section.figure("kramm2018-bounds-gamma", "Bounds and largest ratios by k", chart(record));
    if let Ok(svg) = Worst::new().and_then(|worst| worst.drawing()) {
        section.figure(
            "kramm2018-bounds-centers",
            "The worst case between cell centers, with its paths",
            svg,
        );
    }
    section.heading("Decomposition trees (Figure 5)");
    section.figure(
        "kramm2018-bounds-trees",
        "The decomposition trees of the move (7, 5) of levels 7 to 4",
        trees(),
    );
    section.heading("Published and here");
    section.claims(claims(record), true);
    section
}

/// The text of the bound less the largest ratio: below 1e-12 it is only rounding.
fn gap(row: &Row) -> String {
    match row.number("bound").zip(row.number("tight")) {
        Some((bound, tight)) if bound - tight >= 1e-12 => format!("{:.1e}", bound - tight),
        Some(_) => "< 1e-12".to_owned(),
        None => "–".to_owned(),
    }
}

fn chart(record: &Record) -> String {
    let points = |column: &str| -> Vec<(f64, f64)> {
        tabled(record).filter_map(|(k, row)| Some((f64::from(k), percent(row.number(column)?)))).collect()
    };
    let ticks = (FIRST_K..=LAST_K).map(|k| (f64::from(k), k.to_string()));
    Chart::new(
        "How much longer a path over N(k) can be",
        Axis::new("k").ticks(ticks),
        Axis::new("excess in %").log(),
    )
    .note(format!(
        "Against any angle; empty grid: largest of {} displacements",
        mediant_report::thousands(record.provenance.instances as f64)
    ))
    .series(Series::new("bound Γ_k, corners", Mark::Reference, points("bound")))
    .series(Series::new("bound, centers", Mark::Reference, points("center_bound")))
    .series(Series::new("corners, empty grid", Mark::Points, points("tight")))
    .series(Series::new("centers, Figure 6", Mark::Points, points("center")))
    .svg()
}

fn trees() -> String {
    let mut drawing = TreeDrawing::new("Decomposition trees of (7, 5)").note(
        "A node above level k has the two adjacent moves for children of which it is the sum; the \
         leaves are a path over N(k)",
    );
    for k in [7, 6, 5, 4] {
        if let Some(tree) = FiniteK::new(k).ok().and_then(|k| DecompositionTree::new(Vector::new(7, 5), k)) {
            drawing = drawing.tree(format!("level {k}"), &tree);
        }
    }
    drawing.svg()
}

fn claims(record: &Record) -> Vec<Claim> {
    let ours = |k: u32, column: &str| record.number(&[("k", &k.to_string())], column);
    let root = std::f64::consts::SQRT_2;
    let mut claims = vec![
        Claim::new("Theorem 2", "Γ_2, √2", root, ours(2, "bound")).exact(7),
        Claim::new("Introduction", "Γ_3, √(4 − 2√2)", 1.0824, ours(3, "bound")).exact(4),
        Claim::new("Introduction", "centers, k = 2: 6/(2 + √2)", 1.7573, ours(2, "center"))
            .exact(4)
            .because("The paper cuts off: 6/(2 + √2) = 1.757359…, which is printed as 1.7573."),
    ];
    for k in 3..=LAST_K {
        let what = format!("centers, k = {k}: 3√2 − 3");
        claims.push(Claim::new("Theorem 3", what, 3.0 * root - 3.0, ours(k, "center")).exact(7));
    }
    for k in FIRST_K..=LAST_K {
        let what = format!("Γ_{k} attained on an empty grid");
        let published = FiniteK::new(k).map_or(f64::NAN, bound_at_corners);
        claims.push(Claim::new("Theorem 2, tightness", what, published, ours(k, "tight")).exact(5));
    }
    let rate = ours(LARGE_K, "bound").map(|bound| 8.0 * f64::from(LARGE_K).powi(2) * (bound - 1.0));
    claims.push(Claim::new("Abstract", format!("8k²(Γ_k − 1) at k = {LARGE_K}"), 1.0, rate).exact(2));
    claims.extend(worked_example());
    claims
}

/// The factorizations of (7, 9) that 'The 2^k Neighborhood' prints, and Figure 5.
fn worked_example() -> Vec<Claim> {
    let source = "The 2^k Neighborhood, (7, 9)";
    let nine = Vector::new(7, 9);
    let printed: [(u32, [(Vector, u32); 2]); 6] = [
        (2, [(Vector::new(1, 0), 7), (Vector::new(0, 1), 9)]),
        (3, [(Vector::new(1, 1), 7), (Vector::new(0, 1), 2)]),
        (4, [(Vector::new(1, 1), 5), (Vector::new(1, 2), 2)]),
        (5, [(Vector::new(1, 1), 3), (Vector::new(2, 3), 2)]),
        (6, [(Vector::new(1, 1), 1), (Vector::new(3, 4), 2)]),
        (7, [(Vector::new(4, 5), 1), (Vector::new(3, 4), 1)]),
    ];
    let mut claims: Vec<Claim> = printed
        .iter()
        .map(|(k, terms)| {
            let ours = FiniteK::new(*k).ok().and_then(|k| decompose(nine, k)).map(|found| found.length());
            let length = terms.iter().map(|(v, times)| f64::from(*times) * v.norm()).sum();
            let [(a, i), (b, j)] = terms;
            let what = format!("{i}({}, {}) + {j}({}, {}): its length over N({k})", a.x, a.y, b.x, b.y);
            Claim::new(source, what, length, ours).exact(6)
        })
        .collect();
    let moves = level(nine).map(|level| f64::from(level).exp2());
    let own = Claim::new(source, "the smallest neighborhood with the move (7, 9)", 512.0, moves).exact(0);
    claims.push(own.because(
        "A misprint: one step after (4, 5) + (3, 4), which the paper has right for the 128-neighborhood, \
         comes the 256-neighborhood, and there (7, 9) = (4, 5) + (3, 4) is a move. By Algorithm 1 its level \
         is 8, and 2^8 = 256.",
    ));
    claims
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn goals_bisect() {
        // √2 + 1 = 2.414…: 4 · 2.414… = 9.66
        assert_eq!(bisecting(FiniteK::N8, 10), Vector::new(4, 9));
        assert_eq!(bisecting(FiniteK::N4, 10), Vector::new(10, 10));
        assert_eq!(bisecting(FiniteK::new(12).unwrap(), 10), Vector::ZERO);
    }

    #[test]
    fn tightest_is_the_diagonal_at_k_2() {
        let (ratio, at) = tightest(FiniteK::N4, 9);
        assert!((ratio - std::f64::consts::SQRT_2).abs() < 1e-12);
        assert_eq!(at.x, at.y);
        let bound = bound_at_corners(FiniteK::N8);
        let (ratio, _) = tightest(FiniteK::N8, 30);
        assert!(ratio <= bound * SLACK && ratio > bound - 1e-3, "{ratio}");
    }

    #[test]
    fn printed_factorizations_are_of_7_9() {
        let claims = worked_example();
        let wrong: Vec<&str> = claims
            .iter()
            .filter(|claim| claim.verdict() != mediant_report::Verdict::Matched)
            .map(|claim| &*claim.what)
            .collect();
        assert_eq!(wrong, ["the smallest neighborhood with the move (7, 9)"]);
    }
}
