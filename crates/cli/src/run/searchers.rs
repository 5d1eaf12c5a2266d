//! The planners of a run: one, or with `--grounds` one for each ground that is stood on.

use std::time::{Duration, Instant};

use mediant::{Choice, Demand, Index, PlacementKind, Planner, Setup, Space, Vertex};
use mediant_formats::Ground;

use super::queries::Queries;
use crate::{
    args::{Asked, RunArgs},
    failure::Failure,
    map::NamedMap,
};

/// A map with what answers queries on it.
pub(crate) struct Searcher {
    /// The ground that is free on it; `None` without `--grounds`.
    ground: Option<Ground>,
    pub(crate) map: NamedMap,
    space: Space,
    pub(crate) index: Index,
    /// Why its engine is this one, if that was left open.
    pub(crate) choice: Option<Choice>,
    pub(crate) planner: Planner,
    /// The planner of `--reference`, which finds the shortest any-angle paths to compare with.
    pub(crate) any_angle: Option<Planner>,
}

/// All of them; at least one.
pub(crate) struct Searchers {
    first: Searcher,
    others: Vec<Searcher>,
    /// The map whose tiles say which ground a vertex is on.
    map: NamedMap,
    placement: PlacementKind,
    /// The time to prepare the search spaces, and to prepare or load the indexes.
    pub(crate) preparation: Duration,
}

impl Searchers {
    /// The searchers of the queries on a map.
    pub(crate) fn new(
        args: &RunArgs,
        asked: &Asked,
        reference: Option<Setup>,
        map: &NamedMap,
        queries: &Queries,
    ) -> Result<Self, Failure> {
        let placement = asked.motion.rules.placement();
        // For all grounds together, so that one engine searches them all.
        let demand = Demand::Paths(queries.len() as u64);
        let mut preparation = Duration::ZERO;
        let mut make = |ground: Option<Ground>| {
            let map = match ground {
                None => map.clone(),
                Some(ground) => map.on_ground(ground)?.for_agent(&args.map, asked.motion)?,
            };
            let begin = Instant::now();
            let space = map.to_library().space(asked.motion)?;
            let (index, choice) = asked.index(&space, demand, args.index.as_deref())?;
            preparation += begin.elapsed();
            let planner = index.try_planner()?;
            let any_angle = reference.map(|setup| setup.planner(&map.to_library())).transpose()?;
            Ok::<_, Failure>(Searcher { ground, map, space, index, choice, planner, any_angle })
        };
        let stood_on =
            |ground: &Ground| queries.iter().any(|item| map.ground_at(placement, item.ends.start) == *ground);
        let grounds: Vec<Ground> =
            Ground::ALL.into_iter().filter(|ground| args.grounds && stood_on(ground)).collect();
        let first = make(grounds.first().copied())?;
        let others = grounds.into_iter().skip(1).map(|ground| make(Some(ground)));
        let others = others.collect::<Result<_, _>>()?;
        Ok(Self { first, others, map: map.clone(), placement, preparation })
    }

    /// The one of the first ground that is stood on.
    pub(crate) const fn first(&self) -> &Searcher {
        &self.first
    }

    /// The one that answers a query with this start.
    pub(crate) fn of(&mut self, start: Vertex) -> &mut Searcher {
        if self.first.ground.is_none() {
            return &mut self.first;
        }
        let ground = self.map.ground_at(self.placement, start);
        let other = self.others.iter_mut().find(|searcher| searcher.ground == Some(ground));
        other.unwrap_or(&mut self.first)
    }

    /// The memory of the search spaces and the indexes, beyond the maps.
    pub(crate) fn memory_bytes(&self) -> u64 {
        let all = self.others.iter().chain([&self.first]);
        all.map(|searcher| searcher.space.memory_bytes() + searcher.index.memory_bytes()).sum()
    }
}
