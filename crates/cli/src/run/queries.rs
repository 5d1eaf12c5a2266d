//! The queries of a run.

use std::path::Path;

use mediant::{Motion, PointEnds, Vertex, grid::Grid, search::End};
use mediant_formats::{Instance, Scenario};

use super::timeline::{Edit, Timeline};

use crate::{
    args::{QueryArgs, RunArgs, parse_pair},
    builtin::is_builtin,
    check::file::{bytes, lines, shown},
    failure::Failure,
    map::{NamedMap, file_name, load_scenario},
    terminal::message::say_warning,
};

/// A query with its number and its length in the scenario.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Item {
    /// The number of the instance, counted from 0; 0 for a single query.
    pub(crate) index: usize,
    /// Its start and goal; of several the first.
    pub(crate) ends: PointEnds,
    /// The length that the scenario gives, if it knows it: optimal for k = 3 at centers under `never`.
    /// [`NO_PATH`] if it knows that there is no path.
    pub(crate) reference: Option<f64>,
}

/// The length of a path that is known not to be there, as scenarios of maps that change write it.
pub(crate) const NO_PATH: f64 = -1.0;

/// A single query, or some of a scenario's, of a list of pairs, or of a timeline.
pub(crate) enum Queries {
    Single(PointEnds),
    Pairs {
        name: String,
        pairs: Vec<PointEnds>,
        every: usize,
        limit: usize,
    },
    /// The lengths that it gives are not `known` to be costs where cells have costs.
    Scenario {
        name: String,
        scenario: Scenario,
        known: bool,
        every: usize,
        limit: usize,
    },
    Timeline {
        name: String,
        timeline: Timeline,
    },
}

impl Queries {
    /// The queries that the arguments name.
    pub(crate) fn load(
        args: &RunArgs,
        wishes: &QueryArgs,
        map: &NamedMap,
        motion: Motion,
    ) -> Result<Self, Failure> {
        let every = args.every.map_or(1, usize::from);
        let limit = args.limit.map_or(usize::MAX, usize::from);
        if let Some(path) = &args.pairs {
            let pairs = read_pairs(&bytes(path)?, path, map, motion)?;
            return Ok(Self::Pairs { name: file_name(&shown(path)), pairs, every, limit });
        }
        if let Some(path) = &args.edits {
            let timeline = Timeline::read(path, map)?.take(every, limit);
            return Ok(Self::Timeline { name: file_name(&shown(path)), timeline });
        }
        let path = match (&args.scen, wishes.from.first(), wishes.to.first()) {
            (None, Some(&from), Some(&to)) => return Ok(Self::Single(PointEnds::new(from, to))),
            (Some(path), ..) => path,
            (None, ..) if is_builtin(&args.map.map) => &args.map.map,
            (None, ..) => {
                let scenario = map.scenario.as_ref().ok_or(Failure::NoQueries)?;
                map.refuse_on_costs("a scenario of a map that changes", true)?;
                let timeline = Timeline::of_scenario(scenario, &map.ground).take(every, limit);
                return Ok(Self::Timeline { name: map.name.clone(), timeline });
            }
        };
        let (name, scenario) = load_scenario(path)?;
        scenario.check_map(&map.grid, &map.name)?;
        check_names(scenario.instances(), map)?;
        // Whatever `every` and `limit` are, instance 0 is taken: only a scenario without instances has no
        // query.
        if scenario.instances().is_empty() {
            return Err(Failure::NoInstances { scenario: name });
        }
        Ok(Self::Scenario { name, scenario, known: !map.has_costs(), every, limit })
    }

    /// The scenario's file name, if there is one.
    pub(crate) fn scenario_name(&self) -> Option<&str> {
        match self {
            Self::Single(_) => None,
            Self::Pairs { name, .. } | Self::Scenario { name, .. } | Self::Timeline { name, .. } => {
                Some(name)
            }
        }
    }

    /// The edits between the queries.
    pub(crate) fn edits(&self) -> &[Edit] {
        match self {
            Self::Timeline { timeline, .. } => &timeline.edits,
            _ => &[],
        }
    }

    /// The number of queries.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Single(_) => 1,
            Self::Pairs { pairs, every, limit, .. } => pairs.len().div_ceil(*every).min(*limit),
            Self::Scenario { scenario, every, limit, .. } => {
                scenario.instances().len().div_ceil(*every).min(*limit)
            }
            Self::Timeline { timeline, .. } => timeline.queries.len(),
        }
    }

    /// The queries, in the order of the file.
    pub(crate) fn iter(&self) -> impl Iterator<Item = Item> {
        let known = !matches!(self, Self::Scenario { known: false, .. });
        let (single, pairs, instances, every, limit): (_, &[PointEnds], &[Instance], _, _) = match self {
            Self::Single(query) => (Some(*query), &[], &[], 1, 0),
            Self::Pairs { pairs, every, limit, .. } => (None, pairs, &[], *every, *limit),
            Self::Scenario { scenario, every, limit, .. } => {
                (None, &[], scenario.instances(), *every, *limit)
            }
            Self::Timeline { .. } => (None, &[], &[], 1, 0),
        };
        let of_timeline: &[Item] = match self {
            Self::Timeline { timeline, .. } => &timeline.queries,
            _ => &[],
        };
        let single = single.into_iter().map(|ends| Item { index: 0, ends, reference: None });
        let pairs = pairs.iter().enumerate().step_by(every).take(limit);
        let pairs = pairs.map(|(index, &ends)| Item { index, ends, reference: None });
        let instances = instances.iter().enumerate().step_by(every).take(limit);
        single
            .chain(pairs)
            .chain(instances.map(move |(index, instance)| Item {
                index,
                ends: PointEnds::new(instance.start, instance.goal),
                reference: instance.known_optimal().filter(|_| known),
            }))
            .chain(of_timeline.iter().copied())
    }
}

/// Reads a CSV of pairs: a line `x1,y1,x2,y2` for each query.
pub(crate) fn read_pairs(
    bytes: &[u8],
    path: &Path,
    map: &NamedMap,
    motion: Motion,
) -> Result<Vec<PointEnds>, Failure> {
    let mut pairs = Vec::new();
    for (index, (line, text)) in lines(bytes).enumerate() {
        let wrong = |problem: String| Failure::PathFile { path: shown(path), line, problem };
        let text = std::str::from_utf8(text).map_err(|error| wrong(error.to_string()))?;
        let is_heading = index == 0 && text.starts_with(|letter: char| letter.is_alphabetic());
        if is_heading {
            continue;
        }
        let [start, goal] = parse_pair(text).map_err(wrong)?;
        let end = |place| map.end(motion, place).map_err(|error| wrong(error.to_string()));
        pairs.push(PointEnds::new(end(start)?, end(goal)?));
    }
    if pairs.is_empty() { Err(Failure::NoPairs { path: shown(path) }) } else { Ok(pairs) }
}

/// Checks that a scenario is for this map. Maps of equal size differ by their names, but a renamed map is
/// still the same map. So if the names differ, the queries decide: they start and end on free cells of their
/// map. (Some of the set wc3maps512 do not; its maps must keep their names.)
fn check_names(instances: &[Instance], map: &NamedMap) -> Result<(), Failure> {
    let Some(named) = instances.iter().find(|instance| instance.map_file_name() != map.name) else {
        return Ok(());
    };
    let expected = named.map_file_name().to_owned();
    if let Some((index, end, at)) = first_blocked(instances, &map.ground) {
        return Err(Failure::MisfitScenario { expected, found: map.name.clone(), end, at, index });
    }
    say_warning(&format!(
        "the scenario names the map `{expected}`, not `{}`; every query fits, so it is used",
        map.name
    ));
    Ok(())
}

/// The first instance with a blocked end: its number, and that end.
fn first_blocked(instances: &[Instance], grid: &Grid) -> Option<(usize, End, Vertex)> {
    instances.iter().enumerate().find_map(|(index, instance)| {
        let ends = [(End::Start, instance.start), (End::Goal, instance.goal)];
        let (end, at) = ends.into_iter().find(|(_, at)| grid.is_blocked(at.x, at.y))?;
        Some((index, end, at))
    })
}
