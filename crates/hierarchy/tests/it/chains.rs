//! Long chains of repairs, of which older versions are held for a while: each is the index of its own map.

use std::sync::Arc;

use crate::common::{
    Setting, any_clustering, any_grid_graph, ask, chpa, clusters, grid_graph, hpa, map, random_queries,
    segments,
};
use mediant_grid::{Centers, Change, Grid, GridGraph, Interrupt, Rectangle};
use mediant_hierarchy::{ClusterGraph, Clustering, SegmentGraph};
use mediant_oracle::{Rng, describe, on_all_cores, seeds};

/// A version: a map with what was repaired for it.
struct Version {
    grid_graph: Arc<GridGraph<Centers>>,
    clusters: ClusterGraph,
    segments: SegmentGraph,
}

impl Version {
    /// Both indexes made anew.
    fn new(grid_graph: Arc<GridGraph<Centers>>, (clustering, side): (Clustering, u32)) -> Self {
        let (clusters, segments) = (clusters(&grid_graph, clustering), segments(&grid_graph, side));
        Self { grid_graph, clusters, segments }
    }

    fn repaired(&self, change: &Change) -> Self {
        let (k, rule) = (self.grid_graph.k(), self.grid_graph.rule());
        Self {
            grid_graph: Arc::new(grid_graph(change.after(), k, rule)),
            clusters: self.clusters.repaired(change, &Interrupt::NEVER).expect("its map"),
            segments: self.segments.repaired(change, &Interrupt::NEVER).expect("its map"),
        }
    }

    /// Panics unless it is the version that is made anew of its map, and answers as that.
    fn check(&self, cut: (Clustering, u32), rng: &mut Rng, case: &impl Fn(&Grid) -> String) {
        let (new, grid) = (Self::new(Arc::clone(&self.grid_graph), cut), self.grid_graph.grid());
        assert_eq!(self.clusters.to_bytes(), new.clusters.to_bytes(), "clusters; {}", case(grid));
        assert_eq!(self.segments.to_bytes(), new.segments.to_bytes(), "segments; {}", case(grid));
        assert!(self.clusters == new.clusters && self.segments == new.segments, "{}", case(grid));
        let setting = Setting::any(rng);
        let [mut one, mut other] = [self, &new].map(|version| {
            let graph = &*version.grid_graph;
            [hpa(graph, &version.clusters, true), chpa(graph, &version.segments, setting)]
        });
        for query in random_queries(rng, grid, 1) {
            for (one, other) in one.iter_mut().zip(&mut other) {
                assert_eq!(ask(one, query), ask(other, query), "{query:?}; {}", case(grid));
            }
        }
    }
}

/// An edit of any kind: one cell or many scattered ones, rectangles that are closed, opened or shuffled, a
/// wall with a door, and several of them as one change.
fn any_change(rng: &mut Rng, grid: &Arc<Grid>) -> Change {
    let (width, height) = (grid.width(), grid.height());
    let mut change = Change::new(Arc::clone(grid));
    for _ in 0..1 + rng.below(4) / 3 * rng.below(3) {
        let now = Arc::clone(change.after());
        let (x, y) = (rng.below(width), rng.below(height));
        let flipped = |x: u32, y: u32| (x, y, now.is_free(x as i32, y as i32));
        change = match rng.below(8) {
            0..=2 => change.edit_cells([flipped(x, y)]),
            3 => {
                let count = 1 + rng.below(30);
                change.edit_cells((0..count).map(|_| flipped(rng.below(width), rng.below(height))))
            }
            4 => {
                let percent = [0, 30, 100][rng.below(3) as usize];
                let at = Rectangle::new(x, y, 1 + rng.below(12), 1 + rng.below(12));
                change.edit(at, |_, _| rng.chance(percent))
            }
            5 => {
                let door = rng.below(height);
                change.edit(Rectangle::new(x, 0, 1, height), |_, y| y != door)
            }
            6 => {
                let door = rng.below(width);
                change.edit(Rectangle::new(0, y, width, 1), |x, _| x != door)
            }
            _ if rng.chance(20) => change.edit(Rectangle::new(0, 0, width, height), |_, _| rng.chance(25)),
            // The same cells twice: the second edit undoes part of the first.
            _ => {
                let at = Rectangle::new(x, y, 9, 9);
                let closed = change.edit(at, |_, _| true);
                closed.edit(at, |x, y| now.is_blocked(x as i32, y as i32) || rng.chance(5))
            }
        };
    }
    change
}

#[test]
fn every_version_of_a_chain_is_the_one_made_anew() {
    let check = |seed: u64| {
        let mut rng = Rng::new(seed ^ 0xC4A1);
        let first = any_grid_graph(&mut rng, &map(seed));
        let cut = (any_clustering(&mut rng), 1 + rng.below(9));
        let mut held = vec![Version::new(Arc::new(first), cut)];
        let mut changed = 0;
        for turn in 0..20 {
            let case = |grid: &Grid| {
                let map = describe(grid, held[0].grid_graph.rules(), (-1, -1).into(), (-1, -1).into(), seed);
                format!("k = {}, {cut:?}, change {turn}; {map}", held[0].grid_graph.k())
            };
            // Mostly the last version is repaired, sometimes an older one: then there are branches.
            let from = if rng.chance(85) { held.len() - 1 } else { rng.below(held.len() as u32) as usize };
            let change = any_change(&mut rng, held[from].grid_graph.grid());
            let next = held[from].repaired(&change);
            next.check(cut, &mut rng, &case);
            changed += usize::from(next.clusters.to_bytes() != held[from].clusters.to_bytes());
            held.push(next);
            while held.len() > 1 + rng.below(4) as usize {
                let keeps_last = u32::from(rng.chance(80));
                let at = rng.below(held.len() as u32 - keeps_last) as usize;
                let given_up = held.remove(at);
                given_up.check(cut, &mut rng, &|grid| {
                    describe(grid, given_up.grid_graph.rules(), (-1, -1).into(), (-1, -1).into(), seed)
                });
            }
        }
        changed
    };
    let changed: usize = on_all_cores(seeds(60), check).into_iter().sum();
    let chains = seeds(60).end as usize;
    assert!(changed > 10 * chains, "only {changed} changes in {chains} chains");
}
