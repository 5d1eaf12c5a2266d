//! A map of a benchmark set, ground by ground, with the instances of its scenario.

use std::path::Path;

use mediant::{Ends, Map};
use mediant_formats::Scenario;

use super::ProveError;
use crate::grounds::Grounds;

/// One instance of a scenario.
#[derive(Clone, Copy, Debug)]
pub(super) struct Instance {
    /// Its number in the scenario, from 0.
    pub(super) index: usize,
    pub(super) ends: Ends,
    /// The length of a shortest path between centers at k = 3 without cut corners, as the scenario states it;
    /// `None` where it states that there is no path.
    pub(super) stated: Option<f64>,
}

/// One ground of a map, with the instances that start on it.
pub(super) struct Terrain {
    pub(super) map: Map,
    pub(super) instances: Vec<Instance>,
    /// Whether the scenario was made on another map, so that what it states need not be right.
    pub(super) is_of_other_map: bool,
}

/// The instances that are asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Choice {
    /// All whose number this divides.
    Every(usize),
    /// An even sample of about so many.
    Few(usize),
}

/// Reads a map and the chosen ones of its instances. Each instance is in one terrain.
pub(super) fn read(path: &Path, set: &str, choice: Choice) -> Result<Vec<Terrain>, ProveError> {
    let grounds = Grounds::read(path, set)?;
    let scenario = Scenario::read(path.with_extension("map.scen"))?;
    let every = match choice {
        Choice::Every(every) => every,
        Choice::Few(few) => scenario.instances().len().div_ceil(few).max(1),
    };
    let mut found: Vec<(_, Vec<Instance>)> = Vec::new();
    for (index, instance) in scenario.instances().iter().enumerate().step_by(every) {
        let is_reachable = instance.optimal > 0.0 || instance.start == instance.goal;
        let ends = Ends::new(instance.start, instance.goal);
        let own = Instance { index, ends, stated: is_reachable.then_some(instance.optimal) };
        let ground = grounds.ground(ends.start);
        match found.iter_mut().find(|(of, _)| *of == ground) {
            Some((_, instances)) => instances.push(own),
            None => found.push((ground, vec![own])),
        }
    }
    let is_of_other_map = grounds.are_of_other_maps();
    let terrain = |(ground, instances)| Terrain { map: grounds.map(ground), instances, is_of_other_map };
    Ok(found.into_iter().map(terrain).collect())
}
