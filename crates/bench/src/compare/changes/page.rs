//! The page and its figures, drawn from the record alone.

use std::{fs, path::Path};

use mediant::{Demand, Map, Setup, Space};
use mediant_report::{Axis, Chart, Mark, Record, Row, Series, Table, number};

use super::{EDITS, Part};
use crate::{Baseline, compare::CompareError};

/// So many paths are asked for between two edits.
pub const PATHS: [u64; 5] = [1, 10, 100, 1_000, 10_000];

/// The time over that of the fastest engine that a choice should not pass.
pub const MOST: f64 = 1.3;

/// The maps whose timelines are drawn, at k = 3 between centers.
const DRAWN: [&str; 3] = ["noise-512", "rooms-512", "brc202d"];
/// The record, in the project.
pub(super) const RECORD: &str = "docs/results/data/changes.json";
const EIGHT: &str = "3:never";
/// The folder of the figures, beside the page. The folder `figures` belongs to `reproduce-tables`.
const FIGURES: &str = "changes";

/// The mean milliseconds of an edit and of the paths that are asked for after it: of our engines and of other
/// crates.
fn millis(row: &Row, paths: u64) -> Option<f64> {
    let finish = row.number("finish").unwrap_or_default() / EDITS as f64;
    Some((row.number("edit")? + finish + paths as f64 * row.number("query")?) / 1e3)
}

/// A map and a motion of the record, and the rows of our engines.
pub struct Case<'a> {
    /// The name of the map.
    pub map: &'a str,
    /// The motion, as setups write it.
    pub motion: &'a str,
    /// Our engines.
    pub rows: Vec<&'a Row>,
    /// A space for which the library chooses as for that of the map.
    space: Option<Space>,
}

impl Case<'_> {
    /// The best engine for so many paths between two edits, and its time.
    #[must_use]
    pub fn best(&self, paths: u64) -> Option<(&str, f64)> {
        let times = self.rows.iter().filter_map(|row| Some((row.text("engine"), millis(row, paths)?)));
        times.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The engine that [`Space::engine_for`](mediant::Space::engine_for) names, and its time; `None` if
    /// that was not measured.
    #[must_use]
    pub fn taken(&self, paths: u64) -> Option<(&str, f64)> {
        let space = self.space.as_ref()?;
        let engine = space.engine_for(Demand::Changing { paths }).ok()?.engine.to_string();
        let row = self.rows.iter().find(|row| row.text("engine") == engine)?;
        Some((row.text("engine"), millis(row, paths)?))
    }
}

/// The choice goes by the size of a map, by whether it is noise, and by whether obstacles stand alone.
fn space_like(row: &Row, motion: &str) -> Option<Space> {
    let side = |column: &str| Some(row.number(column)? as u32);
    let setup: Setup = format!("{}:{motion}", row.text("engine")).parse().ok()?;
    let (is_noise, is_alone) = (row.number("corners")? > 0.1, row.number("lines")? > 0.6);
    let blocked =
        |x: u32, y: u32| y.is_multiple_of(3) && if is_noise { x.is_multiple_of(3) } else { !is_alone };
    setup.space(&Map::from_fn(side("width")?, side("height")?, blocked).ok()?).ok()
}

/// The maps and motions of the record.
#[must_use]
pub fn cases(record: &Record) -> Vec<Case<'_>> {
    let mut cases: Vec<Case<'_>> = Vec::new();
    for row in record.rows.iter().filter(|row| row.text("part") == Part::Timelines.name()) {
        let (map, motion) = (row.text("map"), row.text("motion"));
        if Baseline::ALL.iter().any(|baseline| baseline.name() == row.text("engine")) {
            continue;
        }
        match cases.iter_mut().find(|case| (case.map, case.motion) == (map, motion)) {
            Some(case) => case.rows.push(row),
            None => cases.push(Case { map, motion, rows: vec![row], space: space_like(row, motion) }),
        }
    }
    cases
}

/// The page and its figures: of each the place in `docs/results` and the text.
#[must_use]
pub fn drawn(record: &Record) -> Vec<(String, String)> {
    let mut page = Page { record, text: String::new(), figures: Vec::new() };
    page.choices();
    page.timelines();
    page.details();
    page.sizes();
    page.frames();
    page.door();
    page.figures.push(("changes.md".to_owned(), page.text));
    page.figures
}

/// The page while it is drawn.
struct Page<'a> {
    record: &'a Record,
    text: String,
    figures: Vec<(String, String)>,
}

/// The number in a column, as text.
fn value(row: &Row, column: &str, scale: f64) -> String {
    row.number(column).map_or("–".to_owned(), |value| number(value * scale))
}

impl Page<'_> {
    /// Adds a figure.
    fn figure(&mut self, about: &str, name: &str, chart: &Chart) {
        let place = format!("{FIGURES}/{name}.svg");
        self.text += &format!("\n![{about}]({place})\n");
        self.figures.push((place, chart.svg()));
    }

    /// The head, and the fastest engine of each map, motion and number of paths.
    fn choices(&mut self) {
        let record = self.record;
        let provenance = &record.provenance;
        let cpu = provenance.machine.cpu.as_deref().unwrap_or("a machine");
        let revision = provenance.revision.get(..12).unwrap_or(&provenance.revision);
        self.text += &format!(
            "# Maps that change\n\n\
         [All results](README.md). `cargo xtask compare --changes` writes this page. {} maps, {EDITS} edits of\n\
         single random cells on each map and motion, random ends between which there is a path. One thread,\n\
         warm, paths included; the median of {} passes; {cpu}, two cores that others used too: times vary by\n\
         a third from run to run, and engines are compared within the run. Revision {revision}.\n\
         [All figures](data/changes.json).\n\n\
         ## Which engine\n\n\
         *n* paths are asked for between two edits, on and on. A time is that of one edit (of map, space,\n\
         index and planner) and of the *n* paths after it, in milliseconds. Subgoals are finished after every\n\
         {EDITS} edits, on the same thread: each edit has 1/{EDITS} of that. All engines of a motion find\n\
         shortest paths, and their lengths agree. A cell names the fastest engine; where `space.engine_for`\n\
         names another one, it stands behind, with its time over that of the fastest.\n\n",
            provenance.maps,
            provenance.passes.unwrap_or_default(),
        );
        let cases = cases(record);
        let mut table =
            Table::new(["motion", "map"].into_iter().map(str::to_owned).chain(heading())).names(2);
        for case in &cases {
            let cells = PATHS.map(|paths| {
                let Some((best, least)) = case.best(paths) else { return "–".to_owned() };
                let other = case.taken(paths).filter(|(taken, _)| *taken != best);
                let other = other
                    .map_or_else(String::new, |(taken, time)| format!("; `{taken}` {:.2} ×", time / least));
                format!("`{best}` {}{other}", number(least))
            });
            table.row([format!("`{}`", case.motion), case.map.to_owned()].into_iter().chain(cells));
        }
        self.text += &table.markdown();
        let ratios: Vec<f64> = cases
            .iter()
            .flat_map(|case| PATHS.map(|paths| Some(case.taken(paths)?.1 / case.best(paths)?.1)))
            .flatten()
            .collect();
        self.text += &format!(
            "\n`engine_for` goes by the motion, the size of the map, *n*, and a sample of places: whether their\n\
         corners look like noise, and whether lines of 17 cells are free, as where obstacles stand alone\n\
         (icecrown, Paris_1_512): there paths are so direct that labels pay from some 200 or 300 paths on at\n\
         any angle, in rooms and caves (arena2, AR0700SR) from 30 to 50. In {} of {} cells it is within {MOST}\n\
         of the fastest, at worst {:.2} times it (a test lists the others).\n",
            ratios.iter().filter(|&&ratio| ratio <= MOST).count(),
            ratios.len(),
            ratios.iter().copied().fold(1.0, f64::max),
        );
    }

    /// Times beside other crates.
    fn timelines(&mut self) {
        let record = self.record;
        self.text += "\n## Beside other crates\n\n\
             Centers, k = 3, milliseconds likewise. `pathfinding` is its A\\* over an array of `bool`, to whom\n\
             an edit costs nothing; `grid_pathfinding` keeps components, and makes them anew after a cell was\n\
             blocked (it cuts corners: another problem).\n\n";
        let mut table =
            Table::new(["map", "engine"].into_iter().map(str::to_owned).chain(heading())).names(2);
        let timelines = |map| {
            record
                .select(&[("part", "timelines"), ("motion", EIGHT)])
                .filter(move |row: &&Row| row.text("map") == map)
        };
        for map in record.distinct("map") {
            for row in timelines(map) {
                let cells = PATHS.map(|paths| millis(row, paths).map_or("–".to_owned(), number));
                table.row([map.to_owned(), format!("`{}`", row.text("engine"))].into_iter().chain(cells));
            }
        }
        self.text += &table.markdown();
        for map in DRAWN {
            let axis = Axis::new("paths between two edits").log();
            let mut chart = Chart::new("Time of an edit and its paths", axis, Axis::new("ms").log())
                .note(format!("{map}, centers, k = 3"));
            for row in timelines(map) {
                let points = PATHS.iter().filter_map(|&paths| Some((paths as f64, millis(row, paths)?)));
                chart.push(Series::new(row.text("engine"), Mark::Line, points.collect::<Vec<_>>()));
            }
            let about = format!("The time of an edit and the paths after it, by their number, on {map}");
            self.figure(&about, &format!("timelines-{map}"), &chart);
        }
    }

    /// Edits and queries.
    fn details(&mut self) {
        let record = self.record;
        self.text += "\n### Edits and queries\n\n\
             Microseconds, but *anew* and *labels*: milliseconds. *Anew*: space, index and planner. *Proven*:\n\
             the answers that labels of the map before have proven; another engine searched the others.\n\n";
        let heading = ["motion", "map", "engine", "an edit", "a path", "anew, ms", "proven, %"];
        let mut table = Table::new(heading).names(3);
        for row in record.select(&[("part", "timelines")]) {
            table.row([
                format!("`{}`", row.text("motion")),
                row.text("map").to_owned(),
                format!("`{}`", row.text("engine")),
                value(row, "edit", 1.0),
                value(row, "query", 1.0),
                value(row, "prepared", 1e-3),
                value(row, "proven", 1.0),
            ]);
        }
        self.text += &table.markdown();
    }

    /// Repairs by the size of the change and of the map.
    fn sizes(&mut self) {
        let record = self.record;
        self.text += "\n## The size of the change, and of the map\n\n\
             Microseconds, edit to planner, the median of twenty: ten places, blocked and given back. A square\n\
             is blocked as a whole; scattered cells become what they were not. *Anew*: space, index and\n\
             planner.\n\n";
        let sizes: Vec<&str> =
            record.distinct("size").into_iter().filter(|size| !["opens", "closes"].contains(size)).collect();
        let heading = ["map", "engine"].into_iter().chain(sizes.iter().copied()).chain(["anew"]);
        let mut table = Table::new(heading).names(2);
        for (map, engine) in rows_of(record, Part::Sizes) {
            let keys = [("part", "sizes"), ("map", map), ("engine", engine)];
            let cells = sizes.iter().map(|size| {
                let row = record.select(&keys).find(|row| row.text("size") == *size);
                row.map_or("–".to_owned(), |row| value(row, "edit", 1.0))
            });
            let anew =
                record.select(&keys).next().map_or("–".to_owned(), |row| value(row, "prepared", 1.0));
            table.row([map.to_owned(), format!("`{engine}`")].into_iter().chain(cells).chain([anew]));
        }
        self.text += &table.markdown();
        for engine in ["jps-block", "anya"] {
            let mut chart = Chart::new(
                format!("Repair of {engine} by the size of the map"),
                Axis::new("cells of the map").log(),
                Axis::new("µs").log(),
            )
            .note("noise, 20 % of the cells blocked");
            let points = |size: &str, column: &'static str| -> Vec<(f64, f64)> {
                let keys = [("part", "sizes"), ("engine", engine), ("size", size)];
                let rows =
                    record.rows.iter().filter(|row| row.is(&keys) && row.text("map").starts_with("noise"));
                rows.filter_map(|row| {
                    Some((row.number("width")? * row.number("height")?, row.number(column)?))
                })
                .collect()
            };
            for size in &sizes {
                chart.push(Series::new(*size, Mark::Line, points(size, "edit")));
            }
            chart.push(Series::new("anew", Mark::Line, points(sizes.first().unwrap_or(&""), "prepared")));
            self.figure(
                &format!("The time of a repair of {engine} by the size of the change and of the map"),
                &format!("sizes-{engine}"),
                &chart,
            );
        }
    }

    /// The game loop.
    fn frames(&mut self) {
        let record = self.record;
        self.text += "\n## A game loop\n\n\
             100 agents walk on rooms of 512 × 512 cells, a cell a frame, each to a random goal, and then to\n\
             another one. Each frame a door opens or closes. `planner.replan` looks at all paths, and searches\n\
             where a path is blocked or a shorter one may lead through the door. *Anew* is the same loop with\n\
             space, index and planner made anew each frame, as it was before these could follow. Microseconds\n\
             a frame, mean of 300 frames.\n\n";
        let mut table = Table::new([
            "motion",
            "engine",
            "the map",
            "edit to planner",
            "paths",
            "a frame",
            "median",
            "worst",
            "searches",
        ])
        .names(3);
        for row in record.select(&[("part", "frames")]) {
            table.row([
                format!("`{}`", row.text("motion")),
                format!("`{}`", row.text("engine")),
                if row.text("way") == "anew" { "is made anew".to_owned() } else { "is followed".to_owned() },
                value(row, "edit", 1.0),
                value(row, "query", 1.0),
                value(row, "frame", 1.0),
                value(row, "median", 1.0),
                value(row, "worst", 1.0),
                value(row, "asked", 1.0),
            ]);
        }
        self.text += &table.markdown();
    }

    /// The door.
    fn door(&mut self) {
        let record = self.record;
        self.text += "\n## A door between two halves\n\n\
             The hardest single cell: a door of one cell is the only way between the halves of 2048 × 2048\n\
             cells, and whatever knows what is connected must learn of it. Microseconds, edit to planner, the\n\
             median and the worst of forty.\n\n";
        let mut table = Table::new(["map", "motion", "engine", "closes", "worst", "opens", "worst"]).names(3);
        for (map, engine) in rows_of(record, Part::Door) {
            let row = |size| {
                record
                    .rows
                    .iter()
                    .find(|row| row.is(&[("part", "door"), ("map", map), ("engine", engine), ("size", size)]))
            };
            let (Some(closes), Some(opens)) = (row("closes"), row("opens")) else { continue };
            table.row([
                map.to_owned(),
                format!("`{}`", closes.text("motion")),
                format!("`{engine}`"),
                value(closes, "edit", 1.0),
                value(closes, "worst", 1.0),
                value(opens, "edit", 1.0),
                value(opens, "worst", 1.0),
            ]);
        }
        self.text += &table.markdown();
    }
}

/// The heading of the columns of [`PATHS`].
fn heading() -> impl Iterator<Item = String> {
    PATHS.iter().map(|paths| format!("n = {}", mediant_report::thousands(*paths as f64)))
}

/// The maps and engines of a part, in the order of its rows.
fn rows_of(record: &Record, part: Part) -> Vec<(&str, &str)> {
    let mut found = Vec::new();
    for row in record.rows.iter().filter(|row| row.text("part") == part.name()) {
        let pair = (row.text("map"), row.text("engine"));
        if !found.contains(&pair) {
            found.push(pair);
        }
    }
    found
}

/// Writes the record, the page and the figures.
pub(super) fn write(root: &Path, record: &Record) -> Result<(), CompareError> {
    let files = [("data/changes.json".to_owned(), record.json())].into_iter().chain(drawn(record));
    for (name, text) in files {
        let path = root.join("docs/results").join(name);
        let write = || {
            path.parent().map_or(Ok(()), fs::create_dir_all)?;
            fs::write(&path, &text)
        };
        write().map_err(|source| CompareError::Write { path: path.clone(), source })?;
    }
    Ok(())
}
