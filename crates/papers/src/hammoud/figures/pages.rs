//! The section of figures 8 to 13.

use mediant_report::{Axis, Chart, Claim, Mark, Record, Row, Series, Table, number, stats, thousands};

use super::{ENGINES, RULES};
use crate::experiment::Section;

/// The two searches that the paper compares: its A* cuts no corners, its JPS does.
const ASTAR: (&str, &str) = ("never", "astar");
const JPS: (&str, &str) = ("one", "jps");

/// The section.
pub(in crate::hammoud) fn show(record: &Record) -> Section {
    let mut section = Section::default();
    let sizes = sizes(record);
    section.text(
        "As in the paper, A* cuts no corners (`never`) and JPS may (`one`) in figures 8 to 13; the engines \
         that the paper does not have are drawn under the rule of their kin. Dijkstra's paths are as long as \
         those of A*, and those of block JPS and JPS+ as long as those of JPS. Wavefront finds the fewest \
         moves, not the shortest path. A point is the mean over the queries of one map; the maps of a size \
         stand in the order of their mean A* length.",
    );
    summary(&mut section, &sizes);
    for size in &sizes {
        size.charts(&mut section);
    }
    growth(&mut section, &sizes);
    table(&mut section, &sizes);
    section.claims(claims(&sizes), true);
    section
}

/// The maps of one size.
struct Size<'a> {
    side: u32,
    rows: Vec<&'a Row>,
    /// The maps, by mean A* length.
    maps: Vec<&'a str>,
}

/// The sizes of a record, in their order.
fn sizes(record: &Record) -> Vec<Size<'_>> {
    let mut sides: Vec<u32> = record.distinct("size").iter().filter_map(|side| side.parse().ok()).collect();
    sides.sort_unstable();
    sides.into_iter().map(|side| Size::new(record, side)).collect()
}

impl<'a> Size<'a> {
    fn new(record: &'a Record, side: u32) -> Self {
        let size = side.to_string();
        let rows: Vec<&Row> = record.rows.iter().filter(|row| row.text("size") == size).collect();
        let key = [("rule", ASTAR.0), ("engine", ASTAR.1)];
        let mut maps: Vec<(&str, f64)> = rows
            .iter()
            .filter(|row| row.is(&key))
            .filter_map(|row| Some((row.text("map"), row.number("cost")?)))
            .collect();
        maps.sort_by(|a, b| a.1.total_cmp(&b.1));
        Self { side, rows, maps: maps.into_iter().map(|(map, _)| map).collect() }
    }

    fn name(&self) -> String {
        format!("{0} × {0}", self.side)
    }

    fn of(&self, (rule, engine): (&str, &str)) -> Vec<&'a Row> {
        let keys = [("rule", rule), ("engine", engine)];
        self.rows.iter().copied().filter(|row| row.is(&keys)).collect()
    }

    fn on(&self, setup: (&str, &str), map: &str, column: &str) -> Option<f64> {
        self.of(setup).iter().find(|row| row.text("map") == map)?.number(column)
    }

    /// The mean over all queries of a column that holds the mean of each map.
    fn mean(&self, setup: (&str, &str), column: &str) -> Option<f64> {
        let weight = if column == "micros" { "queries" } else { "found" };
        let mut sums = (0.0, 0.0);
        for row in self.of(setup) {
            if let (Some(mean), Some(weight)) = (row.number(column), row.number(weight)) {
                sums = (sums.0 + mean * weight, sums.1 + weight);
            }
        }
        (sums.1 > 0.0).then(|| sums.0 / sums.1)
    }

    /// The mean of the first setup divided by that of the second.
    fn ratio(&self, first: (&str, &str), second: (&str, &str), column: &str) -> Option<f64> {
        Some(self.mean(first, column)? / self.mean(second, column)?)
    }

    /// The maps on which a JPS takes less time than A*, and those on which it takes more; none if nothing was
    /// timed.
    fn faster(&self, engine: &str) -> Option<(Vec<&'a str>, Vec<&'a str>)> {
        let mut maps = (Vec::new(), Vec::new());
        for &map in &self.maps {
            let (jps, astar) = (self.on((JPS.0, engine), map, "micros")?, self.on(ASTAR, map, "micros")?);
            if jps < astar { maps.0.push(map) } else { maps.1.push(map) }
        }
        (!self.maps.is_empty()).then_some(maps)
    }

    /// The median over these maps of the vertices that the jumps of JPS look at for each node that A*
    /// expands.
    fn steps_a_node(&self, maps: &[&str]) -> Option<f64> {
        let ratio = |map: &&str| Some(self.on(JPS, map, "scanned")? / self.on(ASTAR, map, "expanded")?);
        stats::median(&maps.iter().filter_map(ratio).collect::<Vec<f64>>())
    }

    /// The mean of one column divided by that of another.
    fn ratio_within(&self, setup: (&str, &str), column: &str, other: &str) -> Option<f64> {
        Some(self.mean(setup, column)? / self.mean(setup, other)?)
    }

    fn queries(&self) -> f64 {
        self.of(ASTAR).iter().filter_map(|row| row.number("queries")).sum()
    }

    /// The series of a column over the maps.
    fn series(&self, setup: (&str, &str), column: &str) -> Series {
        let points = self.maps.iter().enumerate();
        let points = points.filter_map(|(at, map)| Some((at as f64 + 1.0, self.on(setup, map, column)?)));
        let at = ENGINES.iter().position(|(engine, _)| *engine == setup.1).unwrap_or_default();
        let series = Series::new(format!("{} ({})", ENGINES[at].1, setup.0), Mark::Points, points).style(at);
        // Where two curves coincide, both are seen.
        if setup == ASTAR { series } else { series.hollow() }
    }

    /// The two figures of a size.
    fn charts(&self, section: &mut Section) {
        let kin = |engine: &'static str| {
            if engine.starts_with("jps") { (JPS.0, engine) } else { (ASTAR.0, engine) }
        };
        let all: Vec<(&str, &str)> = ENGINES.map(|(engine, _)| kin(engine)).to_vec();
        let charts = [
            ("length", "Path length", "mean path length (cells)", "cost", vec![ASTAR, JPS, kin("wavefront")]),
            ("time", "Time", "mean time of a query (µs)", "micros", all),
        ];
        for (at, (file, what, axis, column, setups)) in charts.into_iter().enumerate() {
            let published = [256, 512, 1024].iter().position(|side| *side == self.side);
            let title = match published {
                Some(place) => {
                    format!("Figure {}: {} on {} maps", 8 + 2 * place + at, what.to_lowercase(), self.name())
                }
                None => format!("{what} on {} maps", self.name()),
            };
            let step = if self.maps.len() > 10 { 5 } else { 1 };
            let ticks = (1..=self.maps.len()).filter(|at| *at == 1 || at % step == 0);
            let x = Axis::new("map, by mean length of the A* paths")
                .ticks(ticks.map(|at| (at as f64, at.to_string())));
            let note = format!(
                "{} maps, {} queries, corner rule in brackets",
                self.maps.len(),
                thousands(self.queries())
            );
            let y = if column == "cost" { Axis::new(axis) } else { Axis::new(axis).log() };
            let mut chart = Chart::new(title.clone(), x, y).note(note);
            for setup in setups {
                let series = self.series(setup, column);
                chart.push(series);
            }
            section.figure(&format!("hammoud2023-figures-{file}-{}", self.side), &title, chart.svg());
        }
    }
}

fn text(number: Option<f64>, digits: usize) -> String {
    number.map_or("–".to_owned(), |number| format!("{number:.digits$}"))
}

/// `all 30` or `28 of 30`.
fn counted(some: usize, all: usize) -> String {
    if some == all { format!("all {all}") } else { format!("{some} of {all}") }
}

fn short(value: Option<f64>) -> String {
    value.map_or("–".to_owned(), number)
}

/// The paper's statements on its figures, with our numbers.
fn summary(section: &mut Section, sizes: &[Size<'_>]) {
    let mut table = Table::new([
        "maps",
        "number",
        "queries",
        "JPS paths",
        "A* expands / JPS expands",
        "A* time / JPS time",
        "JPS faster on",
        "A* time / block JPS time",
        "block JPS faster on",
        "A* time / JPS+ time",
    ]);
    for size in sizes {
        let percent = size.ratio(JPS, ASTAR, "cost").map(|ratio| 100.0 * (1.0 - ratio));
        let times = |engine| short(size.ratio(ASTAR, (JPS.0, engine), "micros"));
        let faster = |engine| match size.faster(engine) {
            Some((wins, losses)) => counted(wins.len(), wins.len() + losses.len()),
            None => "–".to_owned(),
        };
        table.row([
            size.name(),
            size.maps.len().to_string(),
            thousands(size.queries()),
            format!("{} % shorter", text(percent, 2)),
            short(size.ratio(ASTAR, JPS, "expanded")),
            times("jps"),
            faster("jps"),
            times("jps-block"),
            faster("jps-block"),
            times("jps-plus"),
        ]);
    }
    section.table(&table);
    section.text(
        "The paper says that JPS finds about the same path as A*, and faster. The paths are a little \
         shorter, as they may cut a corner, and under one rule both are equally long. Faster it is by far in \
         nodes; in time, only as far as its jumps are fast.",
    );
}

/// Measures over the size of the maps.
fn growth(section: &mut Section, sizes: &[Size<'_>]) {
    let charts = [
        ("time", "Time by size of the map", "mean time of a query (µs)", "micros"),
        ("visited", "Visited nodes by size of the map", "mean number of nodes expanded", "expanded"),
        ("smoothness", "Smoothness by size of the map", "mean sum of turns, PS (degrees)", "smoothness"),
    ];
    section.heading("Beyond the paper: six engines under one rule");
    for (file, title, axis, column) in charts {
        let ticks = sizes.iter().map(|size| (f64::from(size.side), size.side.to_string()));
        let x = Axis::new("side of the map (cells)").log().ticks(ticks);
        let maps: usize = sizes.iter().map(|size| size.maps.len()).sum();
        let queries: f64 = sizes.iter().map(Size::queries).sum();
        let note = format!("Rule {}, {maps} maps, {} queries", JPS.0, thousands(queries));
        let mut chart = Chart::new(title, x, Axis::new(axis).log()).note(note);
        for (engine, name) in ENGINES {
            let mean = |size: &Size<'_>| Some((f64::from(size.side), size.mean((JPS.0, engine), column)?));
            chart.push(Series::new(name, Mark::Line, sizes.iter().filter_map(mean)));
        }
        section.figure(&format!("hammoud2023-figures-{file}"), title, chart.svg());
    }
}

/// A table of the means.
fn table(section: &mut Section, sizes: &[Size<'_>]) {
    section.heading("Means by size, rule and engine");
    let mut table = Table::new([
        "maps",
        "rule",
        "engine",
        "length",
        "over A*",
        "time (µs)",
        "A* time over it",
        "expands",
        "scans",
        "turns (°)",
    ])
    .names(3);
    for size in sizes {
        for (rule, (engine, name)) in RULES.into_iter().flat_map(|rule| ENGINES.map(|engine| (rule, engine)))
        {
            let mean = |column| size.mean((rule, engine), column);
            let longer =
                size.ratio((rule, engine), (rule, ASTAR.1), "cost").map(|ratio| 100.0 * (ratio - 1.0));
            table.row([
                size.name(),
                format!("`{rule}`"),
                name.to_owned(),
                text(mean("cost"), 2),
                longer.map_or("–".to_owned(), |longer| format!("{longer:+.2} %")).replace("-0.00", "+0.00"),
                short(mean("micros")),
                short(size.ratio((rule, ASTAR.1), (rule, engine), "micros")),
                short(mean("expanded")),
                mean("scanned").map_or(String::new(), number),
                short(mean("smoothness")),
            ]);
        }
    }
    section.table(&table);
    let prepared = |size: &Size<'_>| {
        let (bytes, seconds) =
            (size.mean((JPS.0, "jps-plus"), "bytes")?, size.mean((JPS.0, "jps-plus"), "preparation")?);
        Some(format!("{:.1} MB and {:.0} ms on {}", bytes / 1e6, 1e3 * seconds, size.name()))
    };
    let prepared: Vec<String> = sizes.iter().filter_map(prepared).collect();
    if !prepared.is_empty() {
        section.text(format!("What JPS+ prepares of a map: {}.", prepared.join(", ")));
    }
}

/// The claims of the paper's two sentences about all maps.
fn claims(sizes: &[Size<'_>]) -> Vec<Claim> {
    let mut claims = Vec::new();
    for side in [256, 512, 1024] {
        let size = sizes.iter().find(|size| size.side == side);
        let length = size.and_then(|size| size.ratio(JPS, ASTAR, "cost"));
        let what = format!("JPS length over A* length, {side} × {side}");
        claims.push(Claim::new("Abstract, same path length", what, 1.0, length).written(4, ""));
        let faster = size.and_then(|size| size.faster(JPS.1));
        let share =
            faster.map(|(wins, losses)| 100.0 * wins.len() as f64 / (wins.len() + losses.len()) as f64);
        let what = format!("maps on which JPS is faster than A*, {side} × {side}");
        let claim = Claim::new("Section V, JPS finds a path faster", what, 100.0, share).written(0, " %");
        claims.push(claim.of_times(true).because(size.and_then(slower).unwrap_or_default()));
    }
    claims
}

/// Why JPS is slower than A* on some maps.
fn slower(size: &Size<'_>) -> Option<String> {
    let ((wins, losses), (blocks, _)) = (size.faster(JPS.1)?, size.faster("jps-block")?);
    let (wins, losses) = (size.steps_a_node(&wins), size.steps_a_node(&losses)?);
    let node = 1e3 * size.ratio_within(ASTAR, "micros", "expanded")?;
    let step = 1e3 * size.ratio_within(JPS, "micros", "scanned")?;
    let others = wins.map_or(String::new(), |wins| format!("; on the others {}", number(wins)));
    Some(format!(
        "Each vertex that a jump of JPS looks at takes {} ns, each node that A* expands {} ns, as much as {} \
         vertices. On the maps of {} on which A* is faster, the jumps look at {} vertices for each node of \
         A* (median){others}. An A* whose open list is a list, as the times of tables I and II show the \
         paper's to be, pays far more for a node. Block JPS, which looks at 64 cells at once, is faster than \
         A* on {} of these maps.",
        number(step),
        number(node),
        number(node / step),
        size.name(),
        number(losses),
        counted(blocks.len(), size.maps.len()),
    ))
}

#[cfg(test)]
mod tests {
    use mediant_report::Column;

    use super::*;

    /// Two maps of a size; JPS takes half the time of A* on the first and twice the time on the second.
    fn record() -> Record {
        let row = |map: &str, setup: (&str, &str), queries: f64, cost: f64, micros: f64| -> Row {
            let row =
                Row::new().key("size", "256").key("map", map).key("rule", setup.0).key("engine", setup.1);
            let row =
                row.with("queries", queries).with("found", queries).with("cost", cost).with("micros", micros);
            row.with("expanded", 10.0).with("scanned", micros)
        };
        let keys = ["size", "map", "rule", "engine"].map(|name| Column::key(name, ""));
        let counts =
            ["queries", "found", "cost", "expanded", "scanned"].map(|name| Column::count(name, "", ""));
        Record {
            id: "hammoud2023-figures".to_owned(),
            title: String::new(),
            provenance: mediant_report::Provenance::default(),
            columns: [&keys[..], &counts[..], &[Column::time("micros", "µs", "")]].concat(),
            rows: vec![
                row("B_0_256", ASTAR, 3.0, 200.0, 100.0),
                row("B_0_256", JPS, 3.0, 199.0, 50.0),
                row("A_0_256", ASTAR, 1.0, 100.0, 20.0),
                row("A_0_256", JPS, 1.0, 99.0, 40.0),
                row("A_0_256", ("one", "jps-block"), 1.0, 99.0, 4.0),
                row("B_0_256", ("one", "jps-block"), 3.0, 199.0, 5.0),
            ],
        }
    }

    #[test]
    fn maps_are_weighted_by_queries_and_sorted_by_length() {
        let record = record();
        assert_eq!(record.check().map_err(|wrong| wrong.to_string()), Ok(()));
        let sizes = sizes(&record);
        let [size] = &sizes[..] else { panic!("{} sizes", sizes.len()) };
        assert_eq!((size.maps.clone(), size.queries()), (vec!["A_0_256", "B_0_256"], 4.0));
        assert_eq!(size.mean(ASTAR, "cost"), Some(175.0));
        assert_eq!(size.ratio(JPS, ASTAR, "micros"), Some(47.5 / 80.0));
        assert_eq!(size.faster("jps"), Some((vec!["B_0_256"], vec!["A_0_256"])));
        assert_eq!(size.faster("jps-plus"), None);
        assert_eq!(size.steps_a_node(&["A_0_256"]), Some(4.0));
    }

    #[test]
    fn what_was_not_measured_is_a_claim_all_the_same() {
        let section = show(&record());
        let measured: Vec<bool> = section.claims.iter().map(|claim| claim.ours.is_some()).collect();
        assert_eq!(measured, [true, true, false, false, false, false]);
        let share = &section.claims[1];
        assert_eq!(share.ours, Some(50.0));
        assert!(share.cause.contains("faster than A* on all 2 of"), "{}", share.cause);
    }
}
