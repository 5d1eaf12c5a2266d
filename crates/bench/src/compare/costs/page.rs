//! The page and its charts, drawn from the records alone.

use std::{fs, path::Path};

use mediant_moves::{FiniteK, bound_at_corners};
use mediant_report::{Axis, Chart, Mark, Record, Row, Series, Table, number, stats::geometric_mean};

use super::Part;
use crate::compare::CompareError;

/// The surfaces of which pictures are drawn.
pub(super) const PICTURES: [&str; 2] = ["elevation", "patches"];
/// The record, in the project.
pub(super) const RECORD: &str = "docs/results/data/costs.json";
/// The record of other programs, which `.ci/agreement` writes.
const ELSEWHERE: &str = "docs/results/data/costs-elsewhere.json";
/// The folder of the charts and pictures, beside the page.
const FIGURES: &str = "costs";

/// The page and its charts: of each the place in `docs/results` and the text.
#[must_use]
pub fn drawn(record: &Record, elsewhere: Option<&Record>) -> Vec<(String, String)> {
    let mut page = Page { record, text: String::new(), figures: Vec::new() };
    page.head();
    page.worth();
    page.fields();
    if let Some(elsewhere) = elsewhere {
        page.elsewhere(elsewhere);
    }
    page.paths();
    page.figures.push(("costs.md".to_owned(), page.text));
    page.figures
}

/// The page while it is drawn.
struct Page<'a> {
    record: &'a Record,
    text: String,
    figures: Vec<(String, String)>,
}

impl Page<'_> {
    fn head(&mut self) {
        let provenance = &self.record.provenance;
        let cpu = provenance.machine.cpu.as_deref().unwrap_or("a machine");
        let revision = provenance.revision.get(..12).unwrap_or(&provenance.revision);
        self.text += &format!(
            "# Cost surfaces\n\n\
             [All results](README.md). `cargo xtask compare --costs` writes this page. Costs are the same on\n\
             every machine; times are those of {cpu}, one thread unless two are named. Revision {revision}.\n\
             [All figures](data/costs.json). `docs/measurements/costs.md` has more on landmarks, edits and\n\
             paths at any angle.\n\n\
             The surfaces: *terrain* is a map of a game, where ground costs 1, trees 3, shallow water 4 and\n\
             water 9; *elevation* a fractal, the dearer the steeper; *patches* land cover of costs 1, 2, 5\n\
             and 10; *friction* costs of 16 to 159 at random; *rooms* a robot's map, dear beside walls;\n\
             *equal* ground of one cost. Vertices are centers of cells; corners are never cut.\n",
        );
    }

    /// Adds a chart.
    fn figure(&mut self, about: &str, name: &str, chart: &Chart) {
        let place = format!("{FIGURES}/{name}.svg");
        self.text += &format!("\n![{about}]({place})\n");
        self.figures.push((place, chart.svg()));
    }

    fn rows(&self, part: Part) -> impl Iterator<Item = &Row> {
        self.record.rows.iter().filter(move |row| row.text("part") == part.name())
    }

    /// The row of a part with these keys.
    fn row(&self, part: Part, keys: &[(&str, &str)]) -> Option<&Row> {
        self.rows(part).find(|row| row.is(keys))
    }

    /// The texts of a key in a part, in their order.
    fn keys(&self, part: Part, key: &str) -> Vec<String> {
        let mut found: Vec<String> = Vec::new();
        for row in self.rows(part) {
            if !found.iter().any(|known| known == row.text(key)) {
                found.push(row.text(key).to_owned());
            }
        }
        found
    }

    fn worth(&mut self) {
        let (surfaces, ks) = (self.keys(Part::Worth, "surface"), self.keys(Part::Worth, "k"));
        let side = self.rows(Part::Worth).next().map_or("", |row| row.text("side")).to_owned();
        self.text += &format!(
            "\n## What k is worth\n\n\
             {side} × {side} cells, two sources, all cells that are reached: the surplus of the least cost for\n\
             k over that for k = 12, in percent; the mean, and behind it the greatest. *Bound*: the most that\n\
             it can be on free ground of one cost.\n\n"
        );
        let heading = ["surface".to_owned()].into_iter().chain(ks.iter().map(|k| format!("k = {k}")));
        let mut table = Table::new(heading);
        let percent = |value: f64| if value < 0.0005 { "0".to_owned() } else { format!("{value:.3}") };
        for surface in &surfaces {
            let cells = ks.iter().map(|k| {
                let row = self.row(Part::Worth, &[("surface", surface), ("k", k)]);
                let of = |column| row.and_then(|row| row.number(column)).map_or("–".to_owned(), percent);
                format!("{}; {}", of("mean"), of("worst"))
            });
            table.row([surface.clone()].into_iter().chain(cells));
        }
        let bound = |k: &String| k.parse().ok().and_then(|k| FiniteK::new(k).ok()).map(bound_at_corners);
        let bounds = |k| bound(k).map(|bound| 100.0 * (bound - 1.0));
        let texts = ks.iter().map(|k| bounds(k).map_or("–".to_owned(), percent));
        table.row(["*bound*".to_owned()].into_iter().chain(texts));
        self.text += &table.markdown();
        let mut chart = Chart::new("Surplus of the least cost", Axis::new("k"), Axis::new("%").log())
            .note("over that for k = 12, mean");
        for surface in &surfaces {
            let points = ks.iter().filter_map(|k| {
                let mean = self.row(Part::Worth, &[("surface", surface), ("k", k)])?.number("mean")?;
                Some((k.parse().ok()?, mean))
            });
            chart.push(Series::new(surface, Mark::Line, points.collect::<Vec<_>>()));
        }
        let points = ks.iter().filter_map(|k| Some((k.parse().ok()?, bounds(k)?)));
        chart.push(Series::new("bound on free ground", Mark::Reference, points.collect::<Vec<_>>()));
        self.figure("The mean surplus of the least cost over that for k = 12, by k", "worth", &chart);
        self.text += "\nWhere costs differ from cell to cell paths follow the cheap cells, and little is lost \
             by few\ndirections; the wider the patches of one cost, the more k is worth. So k = 4 or 5 does on \
             most\nsurfaces, and k = 3 on rough ones.\n";
        for name in PICTURES.iter().filter(|name| surfaces.iter().any(|surface| surface == *name)) {
            self.text += &format!(
                "\n![Cheapest paths over {name} for k = 2, 3 and 5](costs/{name}.png)\n\n*{name}*: the darker a \
                 cell, the dearer; the cheapest paths for k = 2 (red), 3 (black)\nand 5 (orange).\n"
            );
        }
    }

    fn fields(&mut self) {
        self.text += "\n## Fields\n\n\
             Friction, one source in the middle: nanoseconds a cell on one thread, of three fields the median\n\
             after a first one; costs in units, neither reading them nor putting rows in order. Behind it the\n\
             time on two threads, which find the same integers.\n\n";
        let (sides, ks) = (self.keys(Part::Fields, "side"), self.keys(Part::Fields, "k"));
        let heading = ["cells".to_owned()].into_iter().chain(ks.iter().map(|k| format!("k = {k}")));
        let mut table = Table::new(heading);
        for side in &sides {
            let cells = ks.iter().map(|k| {
                let row = self.row(Part::Fields, &[("side", side), ("k", k)]);
                let of = |column| row.and_then(|row| row.number(column));
                match (of("cell"), of("two")) {
                    (Some(one), Some(two)) => format!("{}; {}", number(one), number(two)),
                    _ => String::new(),
                }
            });
            table.row([format!("{side}²")].into_iter().chain(cells));
        }
        self.text += &table.markdown();
        let mut chart =
            Chart::new("Time of a field", Axis::new("cells of a side").log(), Axis::new("ns a cell"))
                .note("one thread");
        for k in &ks {
            let points = sides.iter().filter_map(|side| {
                let time = self.row(Part::Fields, &[("side", side), ("k", k)])?.number("cell")?;
                Some((side.parse().ok()?, time))
            });
            let points: Vec<_> = points.collect();
            if points.len() > 1 {
                chart.push(Series::new(format!("k = {k}"), Mark::Line, points));
            }
        }
        self.figure("The time of a cell of a field, by the side of the surface", "fields", &chart);
    }

    fn paths(&mut self) {
        let rows: Vec<&Row> = self.rows(Part::Paths).collect();
        let side = rows.first().map_or("", |row| row.text("side"));
        let mut text = format!(
            "\n## Paths\n\n\
             {side} × {side} cells, 100 random queries, mean of three warm passes: A\\* on the surface alone,\n\
             and with 8 landmarks. The costs of both are the same integers.\n\n"
        );
        let mut table = Table::new([
            "surface",
            "k",
            "expanded",
            "ms",
            "landmarks made, s",
            "expanded",
            "ms",
            "times as fast",
        ])
        .names(2);
        let (mut factors, mut where_costs_differ) = (Vec::new(), Vec::new());
        for row in &rows {
            let of = |column: &str| row.number(column).unwrap_or(f64::NAN);
            let factor = of("query") / of("landmarks");
            factors.push(factor);
            if row.text("surface") != "equal" {
                where_costs_differ.push(factor);
            }
            table.row([
                row.text("surface").to_owned(),
                row.text("k").to_owned(),
                number(of("expanded")),
                number(of("query")),
                number(of("prepared")),
                number(of("guided")),
                number(of("landmarks")),
                format!("{factor:.1}"),
            ]);
        }
        text += &table.markdown();
        let mean = |factors: &[f64]| geometric_mean(factors).unwrap_or(f64::NAN);
        text += &format!(
            "\nGeometric mean of the times as fast where costs differ: {:.2}; of all: {:.2}. On equal ground h_k is\n\
             close, and landmarks only cost time: `auto` takes A\\* there.\n",
            mean(&where_costs_differ),
            mean(&factors)
        );
        self.text += &text;
    }

    /// The agreement with other programs, and their times.
    fn elsewhere(&mut self, record: &Record) {
        let revision = record.provenance.revision.get(..12).unwrap_or(&record.provenance.revision);
        let cpu = record.provenance.machine.cpu.as_deref().unwrap_or("a machine");
        self.text += &format!(
            "\n## Beside other programs\n\n\
             `.ci/agreement` writes [these figures](data/costs-elsewhere.json): surfaces of its own, one\n\
             source, corners always cut, as these programs do. *Reached*: cells that both reach, and no other.\n\
             *Differs*: the greatest difference of a cost, as a part of it. Revision {revision}.\n\n"
        );
        let mut table = Table::new(["surface", "k", "program", "reached", "differs"]).names(3);
        for row in record.select(&[("part", "agreement")]) {
            let same = row.number("same") == Some(1.0);
            table.row([
                row.text("surface").to_owned(),
                row.text("k").to_owned(),
                format!("`{}`", row.text("program")),
                if same { number(row.number("cells").unwrap_or_default()) } else { "differ".to_owned() },
                row.number("differs").map_or("–".to_owned(), |value| format!("{value:.1e}")),
            ]);
        }
        self.text += &table.markdown();
        self.text += &format!(
            "\nTheir times on friction, in nanoseconds of processor time a cell ({cpu}), over ours of the same \
             side\nand k in the table above. That of `r.cost` holds its reading and writing; \
             `MCP_Geometric` is given an\narray.\n\n"
        );
        let mut table = Table::new(["cells", "k", "program", "ns", "ours", "times"]).names(3);
        for row in record.select(&[("part", "times")]) {
            let (side, k) = (row.text("side"), row.text("k"));
            let ours = self.row(Part::Fields, &[("side", side), ("k", k)]);
            let ours = ours.and_then(|ours| ours.number("cell")).unwrap_or(f64::NAN);
            let theirs = row.number("ns").unwrap_or(f64::NAN);
            table.row([
                format!("{side}²"),
                k.to_owned(),
                format!("`{}`", row.text("program")),
                number(theirs),
                number(ours),
                format!("{:.1}", theirs / ours),
            ]);
        }
        self.text += &table.markdown();
    }
}

/// Writes the record, the page and the charts.
pub(super) fn write(root: &Path, record: &Record) -> Result<(), CompareError> {
    let elsewhere = root.join(ELSEWHERE);
    let elsewhere = match fs::read_to_string(&elsewhere) {
        Ok(text) => Some(Record::parse(&text)?),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => None,
        Err(source) => return Err(CompareError::Read { path: elsewhere, source }),
    };
    let files = [("data/costs.json".to_owned(), record.json())].into_iter();
    for (name, text) in files.chain(drawn(record, elsewhere.as_ref())) {
        let path = root.join("docs/results").join(name);
        let write = || {
            path.parent().map_or(Ok(()), fs::create_dir_all)?;
            fs::write(&path, &text)
        };
        write().map_err(|source| CompareError::Write { path: path.clone(), source })?;
    }
    Ok(())
}
