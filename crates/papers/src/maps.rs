//! Maps, their scenarios, and queries drawn on them.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use mediant_formats::{Instance, MapFile, Scenario};
use mediant_grid::{Grid, PlacementKind, Rules};
use mediant_oracle::{Rng, random_free_vertex};
use mediant_search::Ends;

use crate::Error;

/// A map of a set.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Map {
    /// Its set, or `bundled`.
    pub(super) set: String,
    /// Its name, without extension.
    pub(super) name: String,
    pub(super) path: PathBuf,
}

impl Map {
    pub(super) fn new(set: &str, path: &Path) -> Self {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Self { set: set.to_owned(), name, path: path.to_owned() }
    }

    /// Its grid.
    pub(super) fn grid(&self) -> Result<Arc<Grid>, Error> {
        Ok(Arc::new(MapFile::read(&self.path)?.to_grid()))
    }

    /// The instances of its scenario.
    pub(super) fn instances(&self) -> Result<Vec<Instance>, Error> {
        Ok(Scenario::read(self.path.with_extension("map.scen"))?.instances().to_vec())
    }

    /// The queries of its scenario whose index `every` divides, without those that start at their goal.
    pub(super) fn queries(&self, every: usize) -> Result<Vec<Ends>, Error> {
        let instances = self.instances()?;
        let picked =
            instances.iter().step_by(every.max(1)).filter(|instance| instance.start != instance.goal);
        Ok(picked.map(|instance| Ends::new(instance.start, instance.goal)).collect())
    }

    /// Random numbers by the seed and the map's name: other maps do not change them.
    pub(super) fn rng(&self, seed: u64) -> Rng {
        let digest = self.name.bytes().fold(0xCBF2_9CE4_8422_2325_u64, |digest, byte| {
            (digest ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3)
        });
        Rng::new(seed ^ digest)
    }
}

/// An even sample of `count` items (all, if there are fewer): the middles of equal parts.
pub(super) fn evenly<T: Clone>(all: &[T], count: usize) -> Vec<T> {
    let count = count.min(all.len());
    (0..count).map(|part| all[(2 * part + 1) * all.len() / (2 * count)].clone()).collect()
}

/// `count` random queries between different free vertices that `solvable` accepts; fewer if 1,000 · `count`
/// draws do not find so many.
pub(super) fn random_queries(
    rng: &mut Rng,
    grid: &Grid,
    rules: Rules,
    count: usize,
    mut solvable: impl FnMut(Ends) -> bool,
) -> Vec<Ends> {
    let placement: PlacementKind = rules.placement();
    let mut queries = Vec::with_capacity(count);
    for _ in 0..1000 * count {
        if queries.len() == count {
            break;
        }
        let mut draw = || random_free_vertex(rng, grid, placement);
        let (Some(start), Some(goal)) = (draw(), draw()) else { break };
        let query = Ends::new(start, goal);
        if start != goal && solvable(query) {
            queries.push(query);
        }
    }
    queries
}

#[cfg(test)]
mod tests {
    use mediant_grid::CornerRule;

    use super::*;

    #[test]
    fn samples_are_even() {
        let all: Vec<u32> = (0..10).collect();
        assert_eq!((evenly(&all, 1), evenly(&all, 2), evenly(&all, 3)), (vec![5], vec![2, 7], vec![1, 5, 8]));
        assert_eq!((evenly(&all, 10), evenly(&all, 99), evenly(&all, 0)), (all.clone(), all.clone(), vec![]));
    }

    #[test]
    fn random_queries_are_solvable_and_repeatable() {
        let grid = Grid::from_fn(9, 4, |x, _| x == 4).unwrap();
        let same_side = |query: Ends| (query.start.x < 4) == (query.goal.x < 4);
        let rules = Rules::Center(CornerRule::Never);
        let map = Map::new("set", Path::new("folder/wall.map"));
        let draw = |seed| random_queries(&mut map.rng(seed), &grid, rules, 50, same_side);
        let queries = draw(1);
        assert_eq!((queries.len(), map.name.as_str()), (50, "wall"));
        assert!(queries.iter().all(|&query| same_side(query) && query.start != query.goal));
        assert!(queries == draw(1) && queries != draw(2));
        assert_eq!(random_queries(&mut map.rng(1), &grid, rules, 3, |_| false), []);
        let blocked = Grid::from_fn(2, 2, |_, _| true).unwrap();
        assert_eq!(random_queries(&mut map.rng(1), &blocked, rules, 3, |_| true), []);
    }
}
