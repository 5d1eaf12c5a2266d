//! `--format table`: a report for people.

use std::io::{self, Write};

use mediant::{Engine, Limit, Path, PlacementKind, Point, Stopped, files::WorldFrame, options::OptionValue};

use super::{
    answer::{EditRecord, Found, QueryAnswer, QueryRecord, RunHead},
    queries::NO_PATH,
    report::{Report, by_auto, ends_in_words, falls_back, k_in_words},
    summary::{Edits, Ratios, References, Summary},
};
use crate::terminal::{
    numbers::{count, excess, grouped, percent_over, time},
    screen::{BOLD, Screen},
    table::{Align, TextTable},
    text::{printable, wrap},
};

/// Keeps its rows until the end, since columns are as wide as their widest cell. Few queries have a row each;
/// of many queries only errors have a row, and only the first of them.
pub(crate) struct TableReport<'s> {
    screen: &'s mut Screen,
    queries: usize,
    from_scenario: bool,
    /// Whether the scenario's lengths are those of the paths: not where cells have costs.
    has_references: bool,
    /// Whether a query may be answered by another path than the one that was asked for.
    may_differ: bool,
    /// Whether only the lengths of paths are asked for.
    only_lengths: bool,
    /// Whether the engine finds paths of the lengths that scenarios give.
    is_reference: bool,
    /// The engine of `--reference`, or nothing.
    any_angle: &'static str,
    /// Whether the engine may leave its plan.
    may_fall_back: bool,
    /// Where vertices are in the world.
    world: Option<(WorldFrame, PlacementKind)>,
    /// The distance by which the ends were moved to vertices, or points, in meters.
    moved: Option<[f64; 2]>,
    /// The ends of paths, in words.
    ends: &'static str,
    rows: Vec<QueryRecord>,
    /// The number of errors that have no row.
    more_errors: u64,
}

impl<'s> TableReport<'s> {
    /// The largest number of rows.
    const ROWS: usize = 20;

    pub(crate) const fn new(screen: &'s mut Screen) -> Self {
        Self {
            screen,
            queries: 0,
            from_scenario: false,
            has_references: false,
            may_differ: false,
            only_lengths: false,
            is_reference: false,
            any_angle: "",
            may_fall_back: false,
            world: None,
            moved: None,
            ends: "",
            rows: Vec::new(),
            more_errors: 0,
        }
    }

    /// Whether there is a column for the numbers of waypoints.
    const fn has_waypoints(&self) -> bool {
        !self.may_differ && !self.only_lengths
    }

    /// Writes the table of queries or errors.
    fn rows(&mut self) -> io::Result<()> {
        let few = self.queries <= Self::ROWS;
        let mut heads = vec![("index", Align::Right), ("start", Align::Left), ("goal", Align::Left)];
        if self.may_differ {
            heads.push(("answer", Align::Left));
        }
        heads.push(("cost", Align::Right));
        if self.has_references {
            heads.push(("reference", Align::Right));
        }
        // There is not room for both columns in 80.
        if self.has_waypoints() {
            heads.push(("waypoints", Align::Right));
        }
        heads.extend([("expanded", Align::Right), ("time", Align::Right)]);
        let mut table = TextTable::new(if few {
            heads
        } else {
            vec![heads[0], heads[1], heads[2], ("error", Align::Left)]
        });
        for row in &self.rows {
            table.row(if few { self.answer_cells(row) } else { error_cells(row) });
        }
        table.write(self.screen)?;
        let mut gap = "\n";
        // The error of a single query goes to stderr.
        for row in self.rows.iter().filter(|_| few && self.queries > 1) {
            if let Err(error) = &row.answer {
                writeln!(self.screen, "{gap}  {}: {error}", row.item.index)?;
                gap = "";
            }
        }
        if self.more_errors > 0 {
            writeln!(
                self.screen,
                "  … and {}; --format jsonl shows all",
                count(self.more_errors, "more error", "more errors")
            )?;
        }
        Ok(())
    }

    /// The row of a query, if all have rows.
    fn answer_cells(&self, row: &QueryRecord) -> Vec<String> {
        let (start, goal) = row.ends();
        let mut cells = vec![row.item.index.to_string(), start.to_string(), goal.to_string()];
        let (answer, cost) = match &row.answer {
            Err(_) => ("error", None),
            Ok(QueryAnswer::Unreachable) => ("unreachable", None),
            Ok(QueryAnswer::Found(Found { cost, .. })) => ("found", Some(format!("{cost:.4}"))),
            Ok(QueryAnswer::Nearest(path)) => ("nearest", Some(format!("{:.4}", path.cost()))),
            Ok(QueryAnswer::Stopped(Stopped { lower_bound, .. })) => {
                ("stopped", Some(format!("≥ {lower_bound:.4}")))
            }
        };
        if self.may_differ {
            cells.extend([answer.to_owned(), cost.unwrap_or_default()]);
        } else {
            cells.push(cost.unwrap_or_else(|| answer.to_owned()));
        }
        if self.has_references {
            let reference = row.item.reference;
            cells.push(reference.map_or_else(String::new, |reference| {
                if reference == NO_PATH { "none".to_owned() } else { format!("{reference:.4}") }
            }));
        }
        if row.answer.is_err() {
            return cells;
        }
        if self.has_waypoints() {
            cells.push(row.path().map_or_else(String::new, |path| path.len().to_string()));
        }
        cells.push(grouped(row.counters.expanded));
        cells.push(time(row.nanos as f64));
        cells
    }

    /// Writes the path of a single query, and what is known of it.
    fn path(&mut self) -> io::Result<()> {
        let Some(row) = self.rows.first() else { return Ok(()) };
        let Some(path) = row.path() else {
            // Of a path that was only measured there is the certificate.
            let Some(found) = row.found() else { return Ok(()) };
            writeln!(self.screen)?;
            return certificate(self.screen, found, self.any_angle);
        };
        let last = path.len().saturating_sub(1);
        let words = path.points().enumerate();
        let words = words.map(|(i, at)| format!("{at}{}", if i < last { " →" } else { "" }));
        let text = wrap("  path  ", words, self.screen.columns().min(100));
        writeln!(self.screen, "\n{text}")?;
        if self.may_fall_back {
            writeln!(self.screen, "  plan  {}", left(row.counters.fallbacks))?;
        }
        writeln!(self.screen, "  turns {:.1}° in all", path.smoothness())?;
        if let Some((frame, placement)) = self.world {
            let meters = path.cost() * frame.resolution();
            writeln!(self.screen, "  world {meters:.3} m, {}", in_world(frame, placement, path))?;
            if let Some([start, goal]) = self.moved {
                let to = self.ends;
                let line = format!("  moved to {to}: the start by {start:.3} m, the goal by {goal:.3} m");
                writeln!(self.screen, "{line}")?;
            }
        }
        match &row.answer {
            Ok(QueryAnswer::Found(found)) => certificate(self.screen, found, self.any_angle),
            Ok(QueryAnswer::Nearest(_)) => {
                writeln!(
                    self.screen,
                    "  no way leads to the goal: the path ends at the nearest reachable vertex"
                )
            }
            Ok(QueryAnswer::Stopped(stopped)) => stop(self.screen, stopped),
            Ok(QueryAnswer::Unreachable) | Err(_) => Ok(()),
        }
    }

    /// Writes how much longer than the shortest any-angle paths the paths are, or can be.
    fn ratios(&mut self, name: &str, ratios: Option<Ratios>, at_most: &str, source: &str) -> io::Result<()> {
        let Some(Ratios { mean, worst, worst_index }) = ratios else { return Ok(()) };
        let text = if worst > NO_LONGER {
            let [mean, worst] = [mean, worst].map(excess);
            format!("{at_most}+{mean} on average, +{worst} at index {worst_index} ({source})")
        } else {
            format!("every path is a shortest one at any angle ({source})")
        };
        self.fact(name, &text)
    }

    /// Writes how many changes of the map there were, and their times.
    fn changes(&mut self, edits: &Edits) -> io::Result<()> {
        let &Edits { edits, changes, cells, mean_nanos, max_nanos, .. } = edits;
        let by = if edits == changes { String::new() } else { format!(" by {} edits", grouped(edits)) };
        let cells = count(cells, "cell", "cells");
        let [mean, max] = [mean_nanos, max_nanos as f64].map(time);
        self.fact("changes", &format!("{}{by}, {cells} altered: mean {mean}, max {max}", grouped(changes)))
    }

    /// Writes how the costs compare with the scenario's lengths.
    fn references(&mut self, references: &References) -> io::Result<()> {
        let &References { compared, equal, worst_deviation, worst_index, cost_ratio } = references;
        let (equal, compared) = (grouped(equal), grouped(compared));
        // A deviation that is too small for the printed digits is printed without a sign.
        let worst = if worst_deviation.abs() < 0.000_05 { 0.0 } else { worst_deviation };
        self.fact("reference", &format!("{equal} of {compared} equal (within 0.005 or 0.001 %)"))?;
        self.fact("", &format!("furthest off {worst:+.4} at index {worst_index}"))?;
        if self.is_reference {
            return Ok(());
        }
        let over = percent_over(cost_ratio, 3);
        self.fact("", &format!("costs {over} in all (references: k = 3, center, corners never)"))
    }

    /// Writes a line of the summary.
    fn fact(&mut self, name: &str, text: &str) -> io::Result<()> {
        writeln!(self.screen, "  {}  {text}", self.screen.paint(BOLD, format_args!("{name:<9}")))
    }
}

impl Report for TableReport<'_> {
    fn begin(&mut self, run: &RunHead<'_>) -> io::Result<()> {
        let setup = run.setup;
        self.queries = run.queries;
        self.world = run.map.frame.map(|frame| (frame, setup.rules().placement()));
        self.ends = ends_in_words(setup.k());
        self.moved = run.query.moved.filter(|moved| moved.iter().any(|&meters| meters > 0.0));
        self.from_scenario = run.scenario.is_some();
        self.has_references = self.from_scenario && !run.map.has_costs();
        self.may_differ = run.query.wishes.nearest || run.query.wishes.has_limits();
        self.only_lengths = run.query.distance;
        self.is_reference = setup.solves_scenarios();
        self.any_angle = run.reference.map_or("", Engine::name);
        self.may_fall_back = setup.engine.detour().is_some();
        let kind = if setup.rules().gap().is_some() { "gap" } else { "corners" };
        let rule = format!("{kind} {}", setup.rule_name());
        let grid = &run.map.grid;
        let size = format!("{} × {} cells, {} free", grid.width(), grid.height(), grouped(grid.free_cells()));
        writeln!(self.screen, "{} · {size}", self.screen.paint(BOLD, printable(&run.map.name)))?;
        let name = setup.engine.kind().name();
        let mut parts = vec![name.to_owned()];
        parts.extend(options(run));
        parts.extend(setup.smoothing.map(|smoothing| format!("smoothing {smoothing}")));
        let last = parts.len() - 1;
        let words = parts.iter().enumerate();
        let words = words.map(|(i, part)| format!("{part}{}", if i < last { "," } else { " ·" }));
        let problem =
            [format!("{} ·", k_in_words(setup.k())), format!("{}, {rule}", setup.rules().placement())];
        let text = wrap("", words.chain(problem), self.screen.columns());
        let rest = text.strip_prefix(name).unwrap_or_default();
        writeln!(self.screen, "{}{rest}", self.screen.paint(BOLD, name))?;
        if let Some(choice) = run.choice {
            writeln!(self.screen, "{}", by_auto(choice))?;
        }
        if run.searched_by != setup.engine.kind() {
            writeln!(self.screen, "{}", falls_back(setup.engine.kind(), run.searched_by))?;
        }
        if run.map.radius > 0.0 {
            let meters = run.map.frame.map(|frame| run.map.radius * frame.resolution());
            let meters = meters.map_or_else(String::new, |meters| format!(" ({meters} m)"));
            writeln!(self.screen, "a disc of radius {:.4} cells{meters}", run.map.radius)?;
        }
        let preparation = time(run.preparation.as_nanos() as f64);
        writeln!(self.screen, "{} · prepared in {preparation}", run.guarantee)?;
        let wishes = run.query.in_words();
        if !wishes.is_empty() {
            let words = wishes.join(" · ");
            let words = words.split(' ').map(str::to_owned);
            writeln!(self.screen, "{}", wrap("", words, self.screen.columns()))?;
        }
        writeln!(self.screen)
    }

    fn edit(&mut self, _: &EditRecord<'_>) -> io::Result<()> {
        Ok(())
    }

    fn query(&mut self, record: QueryRecord) -> io::Result<()> {
        let is_error = record.answer.is_err();
        if self.rows.len() < Self::ROWS && (is_error || self.queries <= Self::ROWS) {
            self.rows.push(record);
        } else if is_error {
            self.more_errors += 1;
        }
        Ok(())
    }

    fn end(&mut self, summary: &Summary) -> io::Result<()> {
        if !self.rows.is_empty() {
            self.rows()?;
        }
        if !self.from_scenario {
            return self.path();
        }
        if !self.rows.is_empty() {
            writeln!(self.screen)?;
        }
        if let Some(edits) = &summary.edits {
            self.changes(edits)?;
        }
        let &Summary { queries, found, nearest, unreachable, stopped, errors, .. } = summary;
        let counts = [
            (Some(found), "found"),
            (nearest, "nearest"),
            (Some(unreachable), "unreachable"),
            (stopped, "stopped"),
        ];
        let counts =
            counts.into_iter().filter_map(|(number, name)| Some(format!("{} {name}", grouped(number?))));
        let counts: Vec<String> = counts.chain([count(errors, "error", "errors")]).collect();
        self.fact("queries", &format!("{}: {}", grouped(queries), counts.join(", ")))?;
        if queries == errors {
            return Ok(());
        }
        let [median, mean, max] =
            [summary.median_nanos as f64, summary.mean_nanos, summary.max_nanos as f64].map(time);
        self.fact("time", &format!("median {median}, mean {mean}, max {max}"))?;
        if let Some(edits) = &summary.edits {
            let (changes, paths) = (edits.total_nanos, summary.total_nanos);
            let [changes, paths, all] = [changes, paths, changes + paths].map(|nanos| time(nanos as f64));
            self.fact("in all", &format!("changes {changes}, queries {paths}, together {all}"))?;
        }
        let [expanded, generated] = [summary.mean_expanded, summary.mean_generated].map(mean_count);
        let updated = mean_count(summary.mean_updated);
        self.fact("nodes", &format!("mean {expanded} expanded, {generated} generated, {updated} updated"))?;
        if summary.mean_scanned > 0.0 {
            self.fact("jumps", &format!("mean {} vertices scanned", mean_count(summary.mean_scanned)))?;
        }
        if self.may_fall_back {
            self.fact("plans", &left(summary.fallbacks))?;
        }
        if let Some(cost) = summary.mean_cost {
            let smoothness = summary.mean_smoothness;
            let turns = smoothness.map_or_else(String::new, |mean| format!(", smoothness {mean:.1}°"));
            self.fact("paths", &format!("mean cost {cost:.4}{turns}"))?;
        }
        self.ratios("any angle", summary.bound, "at most ", "certified")?;
        let found = format!("found by {}", self.any_angle);
        self.ratios("", summary.ratio, "", &found)?;
        match &summary.reference {
            Some(references) => self.references(references),
            None => Ok(()),
        }
    }
}

/// Up to this ratio a path counts as no longer than another: the difference may be rounding.
const NO_LONGER: f64 = 1.0 + 1e-9;

/// The number of times that plans were left, in words.
fn left(times: u64) -> String {
    match times {
        0 => "never left".to_owned(),
        1 => "left once".to_owned(),
        _ => format!("left {} times", grouped(times)),
    }
}

/// A mean of counts, with a digit after the point if it is small.
fn mean_count(mean: f64) -> String {
    if mean < 1_000.0 { format!("{mean:.1}") } else { grouped(mean.round() as u64) }
}

/// The engine's options in words. A second heuristic that is the same as the first is left out.
fn options(run: &RunHead<'_>) -> impl Iterator<Item = String> {
    let mut heuristics = Vec::new();
    run.options.iter().filter_map(move |&(option, value)| {
        let value = value?;
        if let OptionValue::Heuristic(_) = value {
            if heuristics.contains(&value) {
                return None;
            }
            heuristics.push(value);
        }
        Some(option.describe(value))
    })
}

/// The row of a query that could not be answered, if only those have rows.
fn error_cells(row: &QueryRecord) -> Vec<String> {
    let error = row.answer.as_ref().err().map(|error| error.text.clone()).unwrap_or_default();
    vec![row.item.index.to_string(), row.item.ends.start.to_string(), row.item.ends.goal.to_string(), error]
}

/// Writes the certificate of a path, and how much longer than the path of `any_angle` it is.
fn certificate(screen: &mut Screen, found: &Found, any_angle: &str) -> io::Result<()> {
    let Some(bound) = found.bound() else {
        let Some(path) = &found.path else { return Ok(()) };
        return writeln!(screen, "  length {:.4} cells", path.length());
    };
    let certificate = if bound > NO_LONGER {
        format!("at most {} longer than the shortest path at any angle", excess(bound))
    } else {
        "no path at any angle is shorter".to_owned()
    };
    writeln!(screen, "  {certificate} (certificate)")?;
    let Some((ratio, best)) = found.ratio().zip(found.any_angle) else { return Ok(()) };
    let than =
        if ratio > NO_LONGER { format!("{} longer than", excess(ratio)) } else { "as short as".into() };
    writeln!(screen, "  {than} the one that {any_angle} finds, of length {best:.4}")
}

/// Writes what stopped a search, and what is known of the path that was asked for.
fn stop(screen: &mut Screen, stopped: &Stopped) -> io::Result<()> {
    let Stopped { by, best, lower_bound, .. } = stopped;
    let by = match by {
        Limit::Cost => " by --max-cost",
        Limit::Expansions => " by --max-expansions",
        Limit::Timeout => " by --timeout",
        _ => "",
    };
    writeln!(screen, "  stopped{by}: this path is the best so far, of length {:.4}", best.cost())?;
    writeln!(screen, "  the path that was asked for costs at least {lower_bound:.4}")
}

/// The ends of a path in the world, in meters.
fn in_world(frame: WorldFrame, placement: PlacementKind, path: &Path) -> String {
    let point = |at: Point| {
        let (x, y) = frame.point_of(placement, at);
        format!("({x:.3}, {y:.3})")
    };
    let ends = path.start().zip(path.goal());
    ends.map_or_else(String::new, |(start, goal)| format!("{} to {}", point(start), point(goal)))
}
