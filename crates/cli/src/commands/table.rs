//! `mediant table`: the lengths of paths from many starts to many goals.

use std::{
    io::{self, Write},
    path::Path,
    time::{Duration, Instant},
};

use mediant::{
    Choice, Demand, Error, Index, Motion, Point,
    options::{EngineName, EngineOption, ValueKind},
};
use serde::Serialize;

use crate::{
    args::{Asked, Format, Place, TableArgs, parse_place},
    check::file::{bytes, lines, shown},
    failure::{Ending, Failure},
    map::NamedMap,
    run::{
        query_error::explain,
        report::{by_auto, ends_in_words, falls_back, k_in_words, without_path},
    },
    terminal::{
        numbers::{count, rounded, time},
        screen::{BOLD, Screen},
        table::{Align, TextTable},
        text::printable,
    },
};

/// Runs the command.
pub(crate) fn table(args: &TableArgs, screen: &mut Screen) -> Result<Ending, Failure> {
    let asked =
        Asked::of_numbers(&args.flags.0, args.index.is_some(), &args.map, &args.costs, &args.walking)?;
    let map = NamedMap::load_ground(&args.map, args.costs.reading)?.without_tiles();
    let map = map.for_agent(&args.map, asked.motion)?;
    let map = map.with_numbers(&args.map, &args.costs, &args.walking)?;
    let (starts, starts_moved) =
        ends(&map, asked.motion, (&args.from, args.from_file.as_deref()), ("starts", "--from"))?;
    let (goals, goals_moved) =
        ends(&map, asked.motion, (&args.to, args.to_file.as_deref()), ("goals", "--to"))?;
    let begin = Instant::now();
    let space = map.space(asked.motion)?;
    let pairs = Demand::Paths(starts.len() as u64 * goals.len() as u64);
    let (index, choice) = asked.index(&space, pairs, args.index.as_deref())?;
    let preparation = begin.elapsed();
    let begin = Instant::now();
    let measured = match measure(args.nearest, &index, &starts, &goals) {
        Ok(measured) => measured,
        Err(Error::Query(error)) => {
            return Ok(Ending::QueryErrors(explain(error, &map, asked.motion.rules.placement())));
        }
        Err(error) => return Err(error.into()),
    };
    let report = LengthReport {
        map: &map,
        index: &index,
        choice,
        starts,
        goals,
        moved: starts_moved.zip(goals_moved).map(Into::into),
        measured,
        preparation,
        took: begin.elapsed(),
    };
    match args.format {
        Format::Table => report.table(screen)?,
        Format::Jsonl => report.jsonl(screen)?,
        Format::Csv => report.csv(screen)?,
    }
    let (missing, all) = report.measured.missing();
    if args.require_path && missing > 0 {
        return Ok(Ending::NoPaths(without_path(missing, all)));
    }
    Ok(Ending::Answered)
}

impl MeasuredLengths {
    /// The number of pairs without a path, and of all pairs.
    fn missing(&self) -> (u64, u64) {
        match self {
            Self::All(table) => {
                let lengths = table.values();
                (lengths.iter().filter(|length| length.is_infinite()).count() as u64, lengths.len() as u64)
            }
            Self::Nearest(nearest) => {
                (nearest.iter().filter(|goal| goal.is_none()).count() as u64, nearest.len() as u64)
            }
        }
    }
}

/// The starts or the goals, those that were named before those of a file, and their greatest
/// [distance](NamedMap::moved) from the places that were asked for.
fn ends(
    map: &NamedMap,
    motion: Motion,
    (named, file): (&[Place], Option<&Path>),
    (ends, option): (&'static str, &'static str),
) -> Result<(Vec<Point>, Option<f64>), Failure> {
    let mut places = named.to_vec();
    if let Some(path) = file {
        for (line, text) in lines(&bytes(path)?) {
            let place = std::str::from_utf8(text).map_err(|error| error.to_string()).and_then(parse_place);
            let wrong = |problem| Failure::PathFile { path: shown(path), line, problem };
            places.push(place.map_err(wrong)?);
        }
    }
    if places.is_empty() {
        return Err(Failure::NoEnds { ends, option });
    }
    let at = places.iter().map(|&place| map.end(motion, place)).collect::<Result<Vec<_>, _>>()?;
    let moved = map.moved(motion.rules.placement(), &places, &at);
    Ok((at, moved))
}

/// The lengths that were measured, for each start.
enum MeasuredLengths {
    /// The lengths to all goals; infinite where there is no way.
    All(mediant::Table),
    /// The number of the nearest goal, and the length.
    Nearest(Vec<Option<(usize, f64)>>),
}

fn measure(
    nearest: bool,
    index: &Index,
    starts: &[Point],
    goals: &[Point],
) -> Result<MeasuredLengths, Error> {
    if !nearest {
        return index.table(starts.iter().copied(), goals.iter().copied()).map(MeasuredLengths::All);
    }
    let goals = index.goals(goals.iter().copied())?;
    let mut planner = index.try_planner()?;
    let nearest = starts.iter().map(|&start| planner.nearest(start, &goals));
    nearest.collect::<Result<_, Error>>().map(MeasuredLengths::Nearest)
}

/// A report of distances, in each format.
struct LengthReport<'r> {
    map: &'r NamedMap,
    index: &'r Index,
    /// The choice of `auto`.
    choice: Option<Choice>,
    starts: Vec<Point>,
    goals: Vec<Point>,
    /// The greatest distances of starts and of goals from their vertices, in meters; with `--world`.
    moved: Option<[f64; 2]>,
    measured: MeasuredLengths,
    preparation: Duration,
    took: Duration,
}

/// The first line of jsonl: what is measured.
#[derive(Serialize)]
#[serde(tag = "type", rename = "table")]
struct TableLine<'r> {
    /// The map's file name.
    map: &'r str,
    /// The setup as text.
    setup: String,
    /// As in the line of a run, as are the next two.
    engine: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    asked: Option<&'static str>,
    searched_by: &'static str,
    starts: usize,
    goals: usize,
    /// As in the line of a run: of all starts and of all goals the greatest.
    #[serde(skip_serializing_if = "Option::is_none")]
    moved: Option<[f64; 2]>,
    /// The time to prepare the index, or to load it.
    preprocess_ns: u64,
    /// The memory of the search space and the index, beyond the map.
    index_bytes: u64,
}

/// The line of a start.
#[derive(Serialize)]
#[serde(tag = "type", rename = "row")]
struct RowLine {
    start: Point,
    #[serde(flatten)]
    found: RowFound,
}

#[derive(Serialize)]
#[serde(untagged)]
enum RowFound {
    All {
        /// `null` where there is no way.
        distances: Vec<Option<f64>>,
    },
    /// All are `null` if there is no way to any goal.
    Nearest { goal: Option<Point>, number: Option<usize>, distance: Option<f64> },
}

/// The last line.
#[derive(Serialize)]
#[serde(tag = "type", rename = "summary")]
struct SummaryLine {
    /// The time to measure everything.
    nanos: u64,
}

impl LengthReport<'_> {
    fn jsonl(&self, screen: &mut Screen) -> io::Result<()> {
        let Self { map, index, choice, starts, goals, moved, measured, preparation, took } = self;
        let setup = index.setup();
        let head = TableLine {
            map: &map.name,
            setup: setup.to_string(),
            engine: choice.map_or(setup.engine.kind(), |_| index.searched_by()).name(),
            asked: choice.map(|_| EngineName::Auto.name()),
            searched_by: index.searched_by().name(),
            starts: starts.len(),
            goals: goals.len(),
            moved: *moved,
            preprocess_ns: preparation.as_nanos() as u64,
            index_bytes: index.space().memory_bytes() + index.memory_bytes(),
        };
        line(screen, &head)?;
        for (row, start) in starts.iter().enumerate() {
            let found = match measured {
                MeasuredLengths::All(table) => {
                    RowFound::All { distances: table.row(row).iter().map(|&length| finite(length)).collect() }
                }
                MeasuredLengths::Nearest(nearest) => {
                    let nearest = nearest.get(row).copied().flatten();
                    RowFound::Nearest {
                        goal: nearest.map(|(goal, _)| goals[goal]),
                        number: nearest.map(|(goal, _)| goal),
                        distance: nearest.map(|(_, length)| length),
                    }
                }
            };
            line(screen, &RowLine { start: *start, found })?;
        }
        line(screen, &SummaryLine { nanos: took.as_nanos() as u64 })
    }

    fn csv(&self, screen: &mut Screen) -> io::Result<()> {
        writeln!(screen, "start_x,start_y,goal_x,goal_y,distance")?;
        for (row, start) in self.starts.iter().enumerate() {
            match &self.measured {
                MeasuredLengths::All(table) => {
                    for (goal, &length) in self.goals.iter().zip(table.row(row)) {
                        let length =
                            finite(length).map_or_else(String::new, |length| rounded(length).to_string());
                        writeln!(screen, "{},{},{},{},{length}", start.x(), start.y(), goal.x(), goal.y())?;
                    }
                }
                MeasuredLengths::Nearest(nearest) => match nearest.get(row).copied().flatten() {
                    Some((goal, length)) => {
                        let (goal, length) = (self.goals[goal], rounded(length));
                        writeln!(screen, "{},{},{},{},{length}", start.x(), start.y(), goal.x(), goal.y())?;
                    }
                    None => writeln!(screen, "{},{},,,", start.x(), start.y())?,
                },
            }
        }
        Ok(())
    }

    /// For people: as many starts and goals as fit.
    fn table(&self, screen: &mut Screen) -> io::Result<()> {
        self.head(screen)?;
        let (columns, heads) = match &self.measured {
            MeasuredLengths::All(_) => {
                let columns = self.goals.len().min((screen.columns().saturating_sub(16) / 14).max(1));
                let goals = self.goals[..columns].iter().map(|&goal| (goal.to_string(), Align::Right));
                (columns, [("start".to_owned(), Align::Left)].into_iter().chain(goals).collect())
            }
            MeasuredLengths::Nearest(_) => {
                let heads = [("start", Align::Left), ("nearest goal", Align::Left), ("length", Align::Right)];
                (self.goals.len(), heads.map(|(head, align)| (head.to_owned(), align)).to_vec())
            }
        };
        let mut table = TextTable::new::<String>(heads);
        for (row, &start) in self.starts.iter().enumerate().take(ROWS) {
            table.row([start.to_string()].into_iter().chain(self.cells(row, columns)).collect::<Vec<_>>());
        }
        table.write(screen)?;
        let more = [
            (self.starts.len().saturating_sub(ROWS), "more start", "more starts"),
            (self.goals.len() - columns, "more goal", "more goals"),
        ];
        let more = more.into_iter().filter(|&(number, ..)| number > 0);
        let more: Vec<String> = more.map(|(number, one, many)| count(number as u64, one, many)).collect();
        if more.is_empty() {
            return Ok(());
        }
        writeln!(screen, "  … and {}; --format csv shows all", more.join(", "))
    }

    /// Writes the map, the setup, the numbers of ends, and the times.
    fn head(&self, screen: &mut Screen) -> io::Result<()> {
        let (setup, searched_by) = (self.index.setup(), self.index.searched_by());
        let name = screen.paint(BOLD, printable(&self.map.name)).to_string();
        let made = EngineOption::ALL.into_iter().find(|option| option.kind == ValueKind::Levels);
        let made = made.and_then(|option| Some(option.describe(self.index.value(option)?)));
        let made = made.map_or_else(String::new, |made| format!(" · {made}"));
        writeln!(screen, "{name} · {setup}{made} · {}", k_in_words(setup.k()))?;
        if let Some(choice) = self.choice {
            writeln!(screen, "{}", by_auto(choice))?;
        }
        if searched_by != setup.engine.kind() {
            writeln!(screen, "{}", falls_back(setup.engine.kind(), searched_by))?;
        }
        let starts = count(self.starts.len() as u64, "start", "starts");
        let goals = count(self.goals.len() as u64, "goal", "goals");
        let [preparation, took] = [self.preparation, self.took].map(|span| time(span.as_nanos() as f64));
        writeln!(screen, "{starts}, {goals} · prepared in {preparation} · measured in {took}")?;
        if let Some([starts, goals]) = self.moved.filter(|moved| moved.iter().any(|&meters| meters > 0.0)) {
            writeln!(
                screen,
                "moved to {}: the starts by at most {starts:.3} m, the goals by at most {goals:.3} m",
                ends_in_words(self.index.setup().k())
            )?;
        }
        writeln!(screen)
    }

    /// The cells of a start's row.
    fn cells(&self, row: usize, columns: usize) -> Vec<String> {
        let shown =
            |length| finite(length).map_or_else(|| "no way".to_owned(), |length| format!("{length:.4}"));
        match &self.measured {
            MeasuredLengths::All(table) => {
                table.row(row).iter().take(columns).map(|&length| shown(length)).collect()
            }
            MeasuredLengths::Nearest(nearest) => match nearest.get(row).copied().flatten() {
                Some((goal, length)) => vec![self.goals[goal].to_string(), shown(length)],
                None => vec!["no way to any".to_owned()],
            },
        }
    }
}

/// The most rows of a table for people.
const ROWS: usize = 20;

/// Writes a record as a line.
fn line(screen: &mut Screen, record: &impl Serialize) -> io::Result<()> {
    serde_json::to_writer(&mut *screen, record)?;
    screen.write_all(b"\n")
}

/// A length; `None` where there is no way.
fn finite(length: f64) -> Option<f64> {
    Some(length).filter(|length| length.is_finite())
}
