//! `mediant check`: whether paths hold on a map, and where not.

use std::{io, io::Write, sync::Arc};

use mediant::{CornerRule, K, Motion, Path, Point, Rules as MotionRules, Space};
use mediant_formats::{Ground, PlacedPatch};
use serde::Serialize;

use crate::{
    args::{CheckArgs, CheckFormat},
    check::{
        fault::Fault,
        file::{Entry, Listed, RunSetup, Waypoints, read, shown},
    },
    edit::{CellCosts, LastCosts, check_place},
    failure::{Ending, Failure},
    map::NamedMap,
    terminal::{
        numbers::grouped,
        screen::{BOLD, Screen},
        text::printable,
    },
};

/// The line of a path in `--format jsonl`.
#[derive(Debug, Serialize)]
#[serde(tag = "type", rename = "path")]
struct PathLine<'a> {
    file: &'a str,
    index: usize,
    holds: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    holds_up_to: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    segment: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    from: Option<Point>,
    #[serde(skip_serializing_if = "Option::is_none")]
    to: Option<Point>,
    #[serde(skip_serializing_if = "Option::is_none")]
    cell: Option<[i32; 2]>,
    /// By the costs of cells, or by the elevations, where there are such.
    #[serde(skip_serializing_if = "Option::is_none")]
    cost: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<String>,
}

/// The last line in `--format jsonl`.
#[derive(Debug, Serialize)]
#[serde(tag = "type", rename = "summary")]
struct SummaryLine<'a> {
    map: &'a str,
    paths: u64,
    broken: u64,
}

/// The largest k that is searched on costs.
const MAX_K_ON_COSTS: u32 = 8;

/// The rules by which a path is checked.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Rules {
    /// The motion, which also says which map an agent has.
    motion: Motion,
    /// The neighborhood whose moves are to make the segments.
    over: K,
}

impl Rules {
    /// The rules of the arguments, else of the run, else the usual ones.
    fn new(args: &CheckArgs, said: Option<RunSetup>) -> Result<Self, Failure> {
        let call = &args.motion.0;
        let over = call.k()?.or(said.map(|said| said.over)).unwrap_or(K::Any);
        let motion = match said {
            Some(RunSetup { setup, .. }) => call.motion_from(setup.motion)?,
            None => call.motion()?,
        };
        Ok(Self { motion, over })
    }

    /// The map of the agent that the arguments name, with the rules.
    fn space(self, args: &CheckArgs, map: NamedMap) -> Result<Space, Failure> {
        let map = map.for_agent(&args.map, self.motion)?;
        let Motion { k, rules, .. } = self.motion;
        // No engine searches others. For sight, and for what a path costs, every k is as good.
        let is_searched = match k {
            K::Finite(k) => !map.has_costs() || k.get() <= MAX_K_ON_COSTS,
            K::Any => rules.gap().is_some() && !map.has_costs(),
        };
        let rules = match rules {
            MotionRules::CenterGap(_) if !is_searched => CornerRule::default().into(),
            rules => rules,
        };
        let k = if is_searched { k } else { K::N8 };
        Ok(map.space(Motion::new(k, rules))?)
    }
}

/// Checks one path after another, on a map that edits change.
struct Checker<'a> {
    args: &'a CheckArgs,
    map: NamedMap,
    is_edited: bool,
    last: LastCosts,
    /// The space of the last path, with its rules and the ground of its start.
    ready: Option<((Rules, Option<Ground>), Space)>,
}

impl<'a> Checker<'a> {
    fn new(args: &'a CheckArgs, map: &NamedMap) -> Self {
        let last = LastCosts::new(map.costs.as_ref());
        Self { args, map: map.clone(), is_edited: false, last, ready: None }
    }

    /// Begins a run, on the map as it was read.
    fn begin(&mut self, map: &NamedMap) {
        if self.is_edited {
            *self = Self::new(self.args, map);
        }
    }

    /// Follows an edit. The map of an agent with a radius is made anew for the next path.
    fn edit(&mut self, cells: &PlacedPatch, costs: Option<CellCosts>) -> Result<(), Failure> {
        self.is_edited = true;
        if let Some((costs, known)) = costs.zip(self.map.costs.as_ref()) {
            let edited = known.edit_cells(costs.iter().copied())?;
            if let Some((_, space)) = &mut self.ready {
                *space = space.edit_costs(costs)?.after().clone();
            }
            let grid = Arc::clone(edited.map().grid());
            self.map.take_edited(&grid, &grid);
            self.map.costs = Some(edited);
            return Ok(());
        }
        let (at, blocked) = (cells.rectangle(), |x, y| cells.is_blocked(x, y));
        let ready = self.ready.take().filter(|_| self.args.map.radius.is_none());
        if let Some((of, space)) = ready {
            self.ready = Some((of, space.edit(at, blocked)?.after().clone()));
        }
        let grid = match &self.ready {
            Some((_, space)) => Arc::clone(space.map().grid()),
            None => Arc::new(self.map.ground.with_rectangle(at, blocked)),
        };
        self.map.take_edited(&grid, &grid);
        Ok(())
    }

    /// The first fault of a path in a file, and its cost where paths have costs.
    fn fault(&mut self, file: &str, path: &Listed) -> Result<(Option<Fault>, Option<f64>), Failure> {
        let rules = Rules::new(self.args, path.said)?;
        let waypoints = points(file, path, rules, &self.map)?;
        let start = waypoints.first().filter(|_| by_ground(path));
        let ground = start.map(|&start| self.map.ground_at(rules.motion.rules.placement(), start));
        let space = match self.ready.take() {
            Some((of, space)) if of == (rules, ground) => space,
            _ => {
                let on_ground = ground.map(|ground| self.map.on_ground(ground)).transpose()?;
                rules.space(self.args, on_ground.unwrap_or_else(|| self.map.clone()))?
            }
        };
        let way = Path::through(waypoints);
        let cost = space.cost(&way).filter(|_| self.map.has_costs());
        let fault = Fault::of(&way, &space, rules.over).or_else(|| Fault::of_cost(path.cost, cost));
        self.ready = Some(((rules, ground), space));
        Ok((fault, cost))
    }
}

/// Whether a path is on the ground of its start.
fn by_ground(path: &Listed) -> bool {
    path.said.is_some_and(|said| said.grounds)
}

/// Runs the command.
pub(crate) fn check(args: &CheckArgs, screen: &mut Screen) -> Result<Ending, Failure> {
    let files = args.paths.iter().map(|path| Ok((shown(path).display().to_string(), read(path)?)));
    let files = files.collect::<Result<Vec<_>, Failure>>()?;
    let is_by_ground = |entry: &Entry| matches!(entry, Entry::Path(path) if by_ground(path));
    let of_grounds = files.iter().find(|(_, entries)| entries.iter().any(is_by_ground));
    let map = NamedMap::load_ground(&args.map, args.costs.reading)?;
    let map = if of_grounds.is_some() { map } else { map.without_tiles() };
    let map = map.with_numbers(&args.map, &args.costs, &args.walking)?;
    map.refuse_on_costs("a run with --grounds", of_grounds.is_some())?;
    if let Some((file, _)) = of_grounds.filter(|_| !map.has_tiles()) {
        return Err(Failure::NoGrounds { path: file.into(), map: map.name });
    }
    let (mut paths, mut broken) = (0_u64, 0_u64);
    let mut checker = Checker::new(args, &map);
    for (file, entries) in &files {
        checker.begin(&map);
        for entry in entries {
            let path = match entry {
                Entry::Path(path) => path,
                Entry::Run => {
                    checker.begin(&map);
                    continue;
                }
                Entry::Edit(line, cells) => {
                    let wrong = |problem| Failure::PathFile { path: file.into(), line: *line, problem };
                    check_place(&cells.patch, &map.ground).map_err(wrong)?;
                    let costs = checker.last.after(cells).map_err(wrong)?;
                    checker.edit(&cells.patch, costs)?;
                    continue;
                }
            };
            let (fault, cost) = checker.fault(file, path)?;
            paths += 1;
            broken += u64::from(fault.is_some());
            match (args.format, fault) {
                (CheckFormat::Jsonl, fault) => line(screen, &path_line(file, path.index, fault, cost))?,
                (CheckFormat::Table, Some(fault)) => say(screen, &map, (file, path.index), fault)?,
                (CheckFormat::Table, None) => {}
            }
        }
    }
    match args.format {
        CheckFormat::Jsonl => line(screen, &SummaryLine { map: &map.name, paths, broken })?,
        CheckFormat::Table => summary(screen, &map, paths, broken)?,
    }
    Ok(if broken == 0 { Ending::Answered } else { Ending::BrokenPaths })
}

/// The waypoints of a path.
fn points(file: &str, path: &Listed, rules: Rules, map: &NamedMap) -> Result<Vec<Point>, Failure> {
    match &path.waypoints {
        Waypoints::Points(points) => Ok(points.clone()),
        Waypoints::Places(places) => {
            // A list of points is a path at any angle, whatever rules were named.
            let rules = rules.motion.rules;
            let motion =
                if rules.gap().is_some() { Motion::new(K::Any, rules) } else { Motion::new(3, rules) };
            let point = |&(line, place): &(usize, _)| {
                map.end(motion, place).map_err(|error| Failure::PathFile {
                    path: file.into(),
                    line,
                    problem: error.to_string(),
                })
            };
            places.iter().map(point).collect()
        }
    }
}

/// The record of a path.
fn path_line(file: &str, index: usize, fault: Option<Fault>, cost: Option<f64>) -> PathLine<'_> {
    let segment = fault.and_then(|fault| fault.segment());
    PathLine {
        file,
        index,
        holds: fault.is_none(),
        holds_up_to: fault.and_then(|fault| fault.holds_up_to()),
        segment: segment.map(|(index, ..)| index),
        from: segment.map(|(_, from, _)| from),
        to: segment.map(|(.., to)| to),
        cell: fault.and_then(|fault| fault.cell()).map(|(x, y)| [x, y]),
        cost,
        error: fault.map(|fault| fault.to_string()),
    }
}

/// Writes a record.
fn line(screen: &mut Screen, record: &impl Serialize) -> io::Result<()> {
    serde_json::to_writer(&mut *screen, record)?;
    screen.write_all(b"\n")
}

/// Says what is wrong with a path.
fn say(screen: &mut Screen, map: &NamedMap, (file, index): (&str, usize), fault: Fault) -> io::Result<()> {
    write!(screen, "{}, path {index}: {fault}", printable(file))?;
    if let (Some(frame), Some((x, y))) = (map.frame, fault.cell()) {
        let (x, y) = frame.center_of((x, y).into());
        write!(screen, ", whose center is at ({x:.3}, {y:.3}) m")?;
    }
    writeln!(screen)
}

/// Says how many paths hold.
fn summary(screen: &mut Screen, map: &NamedMap, paths: u64, broken: u64) -> io::Result<()> {
    let name = screen.paint(BOLD, printable(&map.name)).to_string();
    match (broken, paths) {
        (0, 1) => writeln!(screen, "{name} · the path holds"),
        (0, _) => writeln!(screen, "{name} · all {} paths hold", grouped(paths)),
        (1, 1) => writeln!(screen, "{name} · the path does not hold"),
        (1, _) => writeln!(screen, "{name} · 1 of {} paths does not hold", grouped(paths)),
        _ => writeln!(screen, "{name} · {} of {} paths do not hold", grouped(broken), grouped(paths)),
    }
}
