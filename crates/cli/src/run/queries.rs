//! The queries of a run.

use mediant_formats::{Instance, Scenario};
use mediant_grid::{Grid, Vertex};
use mediant_search::{End, Query};

use crate::{
    args::{RunArgs, WishArgs},
    builtin::is_builtin,
    failure::Failure,
    map::{Map, load_scenario},
    terminal::message::say_warning,
};

/// A query with its number and its length in the scenario.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Item {
    /// The number of the instance, counted from 0; 0 for a single query.
    pub(crate) index: usize,
    /// Its start and goal; of several the first.
    pub(crate) query: Query,
    /// The length that the scenario gives, if it knows it: optimal for k = 3 at centers under `never`.
    pub(crate) reference: Option<f64>,
}

/// A single query, or some of a scenario's.
pub(crate) enum Queries {
    Single(Query),
    Scenario { name: String, scenario: Scenario, every: usize, limit: usize },
}

impl Queries {
    /// The queries that the arguments name.
    pub(crate) fn load(args: &RunArgs, wishes: &WishArgs, map: &Map) -> Result<Self, Failure> {
        let path = match (&args.scen, wishes.from.first(), wishes.to.first()) {
            (None, Some(&from), Some(&to)) => return Ok(Self::Single(Query::new(from, to))),
            (Some(path), ..) => path,
            (None, ..) if is_builtin(&args.map.map) => &args.map.map,
            (None, ..) => return Err(Failure::NoQueries),
        };
        let (name, scenario) = load_scenario(path)?;
        scenario.check_map(&map.grid, &map.name)?;
        check_names(scenario.instances(), map)?;
        let every = args.every.map_or(1, usize::from);
        let limit = args.limit.map_or(usize::MAX, usize::from);
        // Whatever `every` and `limit` are, instance 0 is taken: only a scenario without instances has no
        // query.
        if scenario.instances().is_empty() {
            return Err(Failure::NoInstances { scenario: name });
        }
        Ok(Self::Scenario { name, scenario, every, limit })
    }

    /// The scenario's file name, if there is one.
    pub(crate) fn scenario_name(&self) -> Option<&str> {
        match self {
            Self::Single(_) => None,
            Self::Scenario { name, .. } => Some(name),
        }
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Single(_) => 1,
            Self::Scenario { scenario, every, limit, .. } => {
                scenario.instances().len().div_ceil(*every).min(*limit)
            }
        }
    }

    /// The queries, in the order of the file.
    pub(crate) fn iter(&self) -> impl Iterator<Item = Item> {
        let (single, instances, every, limit): (_, &[Instance], _, _) = match self {
            Self::Single(query) => (Some(*query), &[], 1, 0),
            Self::Scenario { scenario, every, limit, .. } => (None, scenario.instances(), *every, *limit),
        };
        let single = single.into_iter().map(|query| Item { index: 0, query, reference: None });
        let instances = instances.iter().enumerate().step_by(every).take(limit);
        single.chain(instances.map(|(index, instance)| Item {
            index,
            query: Query::new(instance.start, instance.goal),
            reference: instance.known_optimal(),
        }))
    }
}

/// Checks that a scenario is for this map. Maps of equal size differ by their names, but a renamed map is
/// still the same map. So if the names differ, the queries decide: they start and end on free cells of their
/// map. (Some of the set wc3maps512 do not; its maps must keep their names.)
fn check_names(instances: &[Instance], map: &Map) -> Result<(), Failure> {
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
