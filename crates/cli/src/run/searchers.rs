//! The planners of a run: one, or with `--grounds` one for each ground that is stood on.

use std::time::{Duration, Instant};

use mediant::{Change, Choice, Demand, Index, PlacementKind, Planner, Point, Setup, Space};
use mediant_formats::Ground;

use super::{
    queries::Queries,
    timeline::{Edit, Timeline},
};
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
        let demand = demand(queries);
        let mut preparation = Duration::ZERO;
        let mut make = |ground: Option<Ground>| {
            let map = match ground {
                None => map.clone(),
                Some(ground) => map.on_ground(ground)?.for_agent(&args.map, asked.motion)?,
            };
            let begin = Instant::now();
            let space = map.space(asked.motion)?;
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
    pub(crate) fn of(&mut self, start: Point) -> &mut Searcher {
        if self.first.ground.is_none() {
            return &mut self.first;
        }
        let ground = self.map.ground_at(self.placement, start);
        let other = self.others.iter_mut().find(|searcher| searcher.ground == Some(ground));
        other.unwrap_or(&mut self.first)
    }

    /// Follows a change of the map, and tells the time of it. Only runs on one ground have edits.
    pub(crate) fn follow(&mut self, change: &[Edit]) -> Result<Duration, Failure> {
        self.first.follow(change)
    }

    /// The memory of the search spaces and the indexes, beyond the maps.
    pub(crate) fn memory_bytes(&self) -> u64 {
        let all = self.others.iter().chain([&self.first]);
        all.map(|searcher| searcher.space.memory_bytes() + searcher.index.memory_bytes()).sum()
    }
}

impl Searcher {
    /// Takes the index and the planner to the map after a change. The time has all of it, but for the
    /// reference.
    fn follow(&mut self, edits: &[Edit]) -> Result<Duration, Failure> {
        let begin = Instant::now();
        let mut change = Change::new(&self.space);
        if let Some(mut disc) = self.map.disc.take() {
            for Edit { cells, .. } in edits {
                disc = disc.edit(cells.rectangle(), |x, y| cells.is_blocked(x, y))?;
            }
            change = Change::to(&self.space, disc.map());
            self.map.disc = Some(disc);
        } else {
            for Edit { cells, costs, .. } in edits {
                change = match costs {
                    Some(costs) => change.edit_costs(costs.iter().copied())?,
                    None => change.edit(cells.rectangle(), |x, y| cells.is_blocked(x, y))?,
                };
            }
        }
        let index = self.index.repair(&change)?;
        self.planner.follow(&index)?;
        self.index = index;
        self.space = change.after().clone();
        let grid = self.space.map().grid();
        let ground = self.map.disc.as_ref().map_or(grid, |disc| disc.obstacles().grid());
        self.map.take_edited(&ground.clone(), grid);
        self.map.costs = self.space.costs().cloned();
        // An edit takes the memory of a version that nobody holds any more.
        drop(change);
        let time = begin.elapsed();
        if let Some(planner) = &mut self.any_angle {
            let index = planner.index().repair(&Change::to(planner.index().space(), self.space.map()))?;
            planner.follow(&index)?;
        }
        Ok(time)
    }
}

/// The demand on an engine. An index that is prepared anew after each change has to pay until the next one.
fn demand(queries: &Queries) -> Demand {
    let (paths, changes) = (queries.len() as u64, Timeline::changes(queries.edits()));
    let stretches = 1 + changes.filter(|change| change.iter().all(|edit| !edit.initial)).count() as u64;
    Demand::Paths(if stretches == 1 { paths } else { paths.min((paths / stretches).max(2)) })
}
