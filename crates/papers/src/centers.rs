//! The excess of paths over N(k) between centers over the shortest path at any angle, which bends at corners.

use mediant::{CornerRule, DiagonalGap, Engine, K, Motion, Planner, Rules};
use mediant_report::{Axis, Chart, Column, Mark, Record, Row, Series, Table, thousands};
use mediant_search::Ends;
use serde::{Deserialize, Serialize};

use super::{
    context::{Context, How},
    experiment::{Experiment, Findings, Page, Section},
    maps::{Map, evenly},
};
use crate::Error;

/// True excess at centers.
pub(super) const EXCESS: Experiment = Experiment {
    id: "center-excess",
    page: Page::Beyond,
    title: "True excess between centers",
    sets: &["bg512", "dao", "sc1", "wc3maps512", "random", "room", "street"],
    measure,
    show,
};

/// The largest k of the rules that cut corners, and of the scenarios' own.
const MOST: u32 = 7;
const MOST_UNDER_NEVER: u32 = 12;

/// The ratios of paths to the optimum, by set, rule and k.
#[derive(Clone, Copy, Default, Serialize, Deserialize)]
struct Ratios {
    sum: f64,
    greatest: f64,
    count: u64,
}

impl Ratios {
    fn add(&mut self, other: &Self) {
        self.sum += other.sum;
        self.greatest = self.greatest.max(other.greatest);
        self.count += other.count;
    }
}

/// Each rule and k, with the gap rule that connects the same.
fn motions(is_quick: bool) -> impl Iterator<Item = (CornerRule, DiagonalGap, u32)> {
    let rules = [
        (CornerRule::Never, DiagonalGap::Closed, MOST_UNDER_NEVER),
        (CornerRule::One, DiagonalGap::Closed, MOST),
        (CornerRule::Always, DiagonalGap::Open, MOST),
    ];
    rules.into_iter().flat_map(move |(rule, gap, most)| {
        (2..=if is_quick { most.min(5) } else { most }).map(move |k| (rule, gap, k))
    })
}

fn measure(context: &Context<'_>) -> Result<Findings, Error> {
    let (is_quick, (maps_of, queries_of)) = (context.quick_or(true, false), context.quick_or((1, 4), (4, 4)));
    let (mut rows, mut maps_in_all, mut instances) = (Vec::new(), 0, 0);
    for set in context.sets() {
        let maps = evenly(&context.maps(set, usize::MAX)?, maps_of);
        let on_map = |map: &Map| on_map(map, queries_of, is_quick);
        let measured = context.each(set, How::Counted, &maps, on_map)?;
        maps_in_all += maps.len();
        for (at, (rule, _, k)) in motions(is_quick).enumerate() {
            let mut ratios = Ratios::default();
            measured.iter().for_each(|of_map| ratios.add(&of_map[at]));
            if ratios.count == 0 {
                continue;
            }
            instances += if (rule, k) == (CornerRule::Never, 2) { ratios.count } else { 0 };
            let row = Row::new().key("set", set).key("rule", rule.name()).key("k", k);
            let mean = ratios.sum / ratios.count as f64;
            rows.push(
                row.with("mean", mean).with("greatest", ratios.greatest).with("count", ratios.count as f64),
            );
        }
    }
    let columns = vec![
        Column::key("set", "the set of maps"),
        Column::key("rule", "the corner rule"),
        Column::key("k", "the neighborhood"),
        Column::count("mean", "", "mean length of a shortest path over N(k) over that at any angle"),
        Column::count("greatest", "", "the greatest of these ratios"),
        Column::count("count", "", "queries"),
    ];
    let drawn = format!(
        "of each set {maps_of} maps, evenly, of each scenario {queries_of} instances, evenly, that have a path"
    );
    Ok(Findings { columns, rows, maps: maps_in_all, instances, drawn, seeded: false })
}

fn on_map(map: &Map, count: usize, is_quick: bool) -> Result<Vec<Ratios>, Error> {
    let library = mediant::Map::from(map.grid()?);
    let told = |wrong: mediant::Error| Error::Reproduce(wrong.to_string());
    let planner = |motion: Motion, engine: Engine| -> Result<Planner, Error> {
        library.space(motion).and_then(|space| space.planner(engine)).map_err(told)
    };
    let candidates = map.queries(1)?;
    let mut optima = Vec::new();
    for gap in [DiagonalGap::Open, DiagonalGap::Closed] {
        optima.push((gap, planner(Motion::new(K::ANY, Rules::CenterGap(gap)), Engine::Anya)?));
    }
    let mut length = |gap: DiagonalGap, ends: Ends| {
        let planner = optima.iter_mut().find(|(of, _)| *of == gap);
        planner.and_then(|(_, planner)| planner.distance(ends).ok().flatten()).filter(|&length| length > 0.0)
    };
    let is_whole = |ends: &Ends| length(DiagonalGap::Closed, *ends).is_some();
    let step = (candidates.len() / (2 * count)).max(1);
    let queries: Vec<Ends> = candidates.iter().step_by(step).copied().filter(is_whole).take(count).collect();
    let mut all = Vec::new();
    for (rule, gap, k) in motions(is_quick) {
        let engine = if k <= 3 { Engine::JpsBlock } else { Engine::AStar };
        let mut over = planner(Motion::new(k, rule), engine)?;
        let mut ratios = Ratios::default();
        for &ends in &queries {
            let moves = over.distance(ends).map_err(|wrong| told(wrong.into()))?;
            if let Some((moves, best)) = moves.zip(length(gap, ends)) {
                ratios.add(&Ratios { sum: moves / best, greatest: moves / best, count: 1 });
            }
        }
        all.push(ratios);
    }
    Ok(all)
}

fn show(record: &Record) -> Section {
    let mut section = Section::default();
    section.text(
        "A shortest path over N(k) between two centers is measured against the shortest path at any angle \
         between them, which bends at corners of obstacles (`Motion::centers(K::ANY)`). Gaps are closed for \
         `never` and `one`, open for `always`, so that both connect the same. The excess does not go to 0 \
         with k: paths over N(k) bend at centers, half a cell from the corners.",
    );
    for rule in record.distinct("rule") {
        section.heading(&format!("Corners {rule}"));
        let id = format!("center-excess-{rule}");
        section.figure(
            &id,
            &format!("Mean excess over the shortest path at any angle by k, corners {rule}, by set"),
            chart(record, rule).svg(),
        );
        section.table(&table(record, rule));
    }
    section
}

/// The values of k of a rule, in order.
fn ks(record: &Record, rule: &str) -> Vec<u32> {
    let mut ks: Vec<u32> =
        record.select(&[("rule", rule)]).filter_map(|row| row.text("k").parse().ok()).collect();
    ks.sort_unstable();
    ks.dedup();
    ks
}

/// The mean excess of a row, in percent.
fn excess(row: &Row) -> Option<f64> {
    row.number("mean").map(|mean| 100.0 * (mean - 1.0))
}

fn chart(record: &Record, rule: &str) -> Chart {
    let instances: f64 =
        record.select(&[("rule", rule), ("k", "2")]).filter_map(|row| row.number("count")).sum();
    let mut chart = Chart::new(
        format!("True excess between centers, corners {rule}"),
        Axis::new("k"),
        Axis::new("mean excess over the shortest path at any angle, percent"),
    )
    .note(format!("{} queries for each k", thousands(instances)));
    for set in record.distinct("set") {
        let point = |row: &Row| Some((row.text("k").parse().ok()?, excess(row)?));
        let points: Vec<(f64, f64)> =
            record.select(&[("rule", rule), ("set", set)]).filter_map(point).collect();
        if !points.is_empty() {
            chart.push(Series::new(set.to_owned(), Mark::Line, points));
        }
    }
    chart
}

fn table(record: &Record, rule: &str) -> Table {
    let ks = ks(record, rule);
    let mut table =
        Table::new(["mean excess, %".to_owned()].into_iter().chain(ks.iter().map(|k| format!("k = {k}"))));
    for set in record.distinct("set") {
        let cell = |k: &u32| {
            let k = k.to_string();
            let of = [("rule", rule), ("set", set), ("k", k.as_str())];
            record.select(&of).find_map(excess).map_or("–".to_owned(), |excess| format!("{excess:.3}"))
        };
        table.row([set.to_owned()].into_iter().chain(ks.iter().map(cell)));
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn excess_is_told_by_set_and_k() {
        let row = |set: &str, k: u32, mean: f64| {
            Row::new().key("set", set).key("rule", "never").key("k", k).with("mean", mean).with("count", 4.0)
        };
        let rows = vec![row("room", 2, 1.25), row("room", 10, 1.015), row("dao", 2, 1.2)];
        let provenance = mediant_report::Provenance::default();
        let (id, title) = ("center-excess".to_owned(), String::new());
        let record = Record { id, title, provenance, columns: Vec::new(), rows };
        let text = table(&record, "never").markdown();
        assert!(text.contains("| mean excess, % | k = 2 | k = 10 |"), "{text}");
        assert!(
            text.contains("| room | 25.000 | 1.500 |") && text.contains("| dao | 20.000 | – |"),
            "{text}"
        );
    }
}
