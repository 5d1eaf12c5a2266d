//! The oracle: times in floating point, from the ground below each move.

use std::{cmp::Reverse, collections::BinaryHeap, sync::Arc};

use mediant_costs::{Heading, Langmuir, Pace, WalkingGraph, WalkingMap};
use mediant_grid::{Grid, Interrupt, PlacementKind, Rules, Vertex};
use mediant_moves::{FiniteK, Vector};
use mediant_oracle::{Rng, Shares, WeightedMap, neighborhood, random_weighted, seeds, segment_is_legal};

/// The time of a move, from the ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// As here.
    Cut,
    /// By the slope from end to end, as by `r.walk`.
    EndToEnd,
    /// With friction once a move, whatever its length.
    FrictionOnce,
}

/// A map, with all that a time follows from.
pub(super) struct Ground {
    map: WeightedMap,
    /// Row by row.
    elevations: Vec<f64>,
    /// The time of a unit of length for a weight of 1.
    friction: f64,
    /// The weight of no friction.
    smooth: f64,
    pace: Pace,
}

impl Ground {
    /// Of rows of elevations and frictions with the pace of Langmuir. Frictions are multiples of 1/8.
    pub(super) fn of_rows(
        elevations: &[Vec<Option<f64>>],
        frictions: &[Vec<Option<f64>>],
        (x, y): (f64, f64),
    ) -> Self {
        let (width, height) = (elevations[0].len() as u32, elevations.len() as u32);
        let is_blocked = |x: u32, y: u32| elevations[y as usize][x as usize].is_none();
        let grid = Grid::from_fn(width, height, is_blocked).expect("a small grid");
        let weight = |x: u32, y: u32| (frictions[y as usize][x as usize].unwrap_or(0.0) * 8.0) as u32 + 1;
        let elevations = elevations.iter().flatten().map(|of| of.unwrap_or(f64::NAN)).collect();
        let map = WeightedMap::from_fn(grid, weight).with_cell_size(x, y);
        Self { map, elevations, friction: 0.125, smooth: 1.0, pace: Pace::Langmuir(Langmuir::default()) }
    }

    pub(super) const fn pace(&self) -> &Pace {
        &self.pace
    }

    fn random(seed: u64) -> (Self, String) {
        let (map, about) = random_weighted(seed);
        let mut rng = Rng::new(seed ^ 0xE1E7);
        let (width, height) = (map.grid().width(), map.grid().height());
        let length = map.cell_size().0.min(map.cell_size().1);
        let kind = rng.below(5);
        let elevation = |x: u32, y: u32, rng: &mut Rng| match kind {
            0 => 250.0,
            1 => f64::from(rng.below(40)) / 4.0,
            2 => 0.1 * length * f64::from(x) - 0.23 * length * f64::from(y),
            3 => {
                length
                    * ((f64::from(x) - 9.0).hypot(f64::from(y) - 7.0) * 0.4
                        + f64::from(rng.below(100)) / 999.0)
            }
            _ => -8e3 + length * f64::from(rng.below(1 << 20)) / f64::from(1 << 20),
        };
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let elevations = places.map(|(x, y)| elevation(x, y, &mut rng)).collect();
        let table = vec![(-0.9, 3.0), (-0.31, 0.9), (-0.31, 0.5), (-0.05, 0.4), (0.03, 0.5), (0.8, 7.0)];
        let pace = match rng.below(4) {
            0 => Pace::Tobler,
            1 => Pace::Table(table),
            _ => Pace::Langmuir(Langmuir::default()),
        };
        let greatest = f64::from(*map.weights().iter().max().expect("a cell"));
        let friction = if rng.below(3) == 0 { 0.0 } else { 5.0 / greatest };
        let about = format!("elevation {kind}, {pace:?}, friction {friction}, seed {seed}: {about}\n{map}");
        (Self { map, elevations, friction, smooth: 0.0, pace }, about)
    }

    fn elevation(&self, x: i32, y: i32) -> Option<f64> {
        self.map.weight(x, y)?;
        Some(self.elevations[y as usize * self.map.grid().width() as usize + x as usize])
    }

    pub(super) fn map(&self, about: &str) -> Arc<WalkingMap> {
        let grid = self.map.grid();
        let ground = |x: u32, y: u32| {
            let (x, y) = (x as i32, y as i32);
            Some((self.elevation(x, y)?, (f64::from(self.map.weight(x, y)?) - self.smooth) * self.friction))
        };
        let size = (grid.width(), grid.height());
        let map =
            WalkingMap::with_friction(size, self.map.cell_size(), &self.pace, &Interrupt::NEVER, ground);
        Arc::new(map.unwrap_or_else(|error| panic!("{error}: {about}")))
    }

    /// By how much of a time a map may differ: its table of Tobler's function is coarse.
    pub(super) fn tolerance(&self) -> f64 {
        if self.pace == Pace::Tobler { 2e-6 } else { 1e-6 }
    }

    /// The time of a legal move.
    fn time(&self, from: Vertex, shares: &Shares, way: Way) -> f64 {
        let v = shares.by();
        let (dx, dy) = (f64::from(v.x), f64::from(v.y));
        let (width, height) = self.map.cell_size();
        let length = (dx * width).hypot(dy * height);
        // Where it meets lines between centers, and the elevation there: linear between the two.
        let mut cuts =
            vec![(0.0, self.elevation(from.x, from.y)), (1.0, self.elevation(from.x + v.x, from.y + v.y))];
        for column in 1..v.x.abs() {
            let t = f64::from(column) / dx.abs();
            let (x, y) = (from.x + column * v.x.signum(), f64::from(from.y) + t * dy);
            let ends = [y.floor(), y.ceil()].map(|y| self.elevation(x, y as i32));
            cuts.push((t, ends[0].zip(ends[1]).map(|(low, high)| low + (high - low) * (y - y.floor()))));
        }
        for row in 1..v.y.abs() {
            let t = f64::from(row) / dy.abs();
            let (x, y) = (f64::from(from.x) + t * dx, from.y + row * v.y.signum());
            let ends = [x.floor(), x.ceil()].map(|x| self.elevation(x as i32, y));
            cuts.push((t, ends[0].zip(ends[1]).map(|(low, high)| low + (high - low) * (x - x.floor()))));
        }
        if way == Way::EndToEnd {
            cuts.truncate(2);
        }
        cuts.sort_by(|one, other| one.0.total_cmp(&other.0));
        let cuts: Vec<(f64, f64)> =
            cuts.into_iter().filter_map(|(t, elevation)| Some((t, elevation?))).collect();
        let pieces = cuts.windows(2).map(|ends| {
            let [(from, before), (to, after)] = [ends[0], ends[1]];
            let piece = length * (to - from);
            piece * self.pace.time((after - before) / piece)
        });
        let friction = shares.integral(&self.map, from).expect("a legal move has free cells").mean();
        let length = if way == Way::FrictionOnce { width } else { length };
        pieces.sum::<f64>() + length * (friction - self.smooth) * self.friction
    }

    /// The times of all vertices from a source, or to it, row by row.
    pub(super) fn times(
        &self,
        rules: Rules,
        k: u32,
        source: Vertex,
        heading: Heading,
        way: Way,
    ) -> Vec<Option<f64>> {
        let grid = self.map.grid();
        let (width, height) = (grid.width(), grid.height());
        let index = |at: Vertex| (at.y as u32 * width + at.x as u32) as usize;
        // Of a field to the source, the moves are those against the steps of the search.
        let moves: Vec<(Vector, Shares)> = neighborhood(FiniteK::new(k).ok(), width, height)
            .into_iter()
            .map(|v| {
                (v, Shares::new(PlacementKind::Center, if heading == Heading::FromSources { v } else { -v }))
            })
            .collect();
        let mut times = vec![None::<f64>; (width * height) as usize];
        times[index(source)] = Some(0.0);
        // Times from 0 on are in the order of their bits.
        let mut queue = BinaryHeap::from([Reverse((0_u64, source.x, source.y))]);
        while let Some(Reverse((time, x, y))) = queue.pop() {
            let (at, time) = (Vertex::new(x, y), f64::from_bits(time));
            if times[index(at)].is_some_and(|known| known < time) {
                continue;
            }
            for (v, shares) in &moves {
                let to = at + *v;
                if self.map.weight(to.x, to.y).is_none() || !segment_is_legal(grid, rules, at, to) {
                    continue;
                }
                let begin = if heading == Heading::FromSources { at } else { to };
                let time = time + self.time(begin, shares, way);
                if times[index(to)].is_none_or(|known| time < known) {
                    times[index(to)] = Some(time);
                    queue.push(Reverse((time.to_bits(), to.x, to.y)));
                }
            }
        }
        times
    }

    /// A free vertex.
    pub(super) fn source(&self, rng: &mut Rng) -> Option<Vertex> {
        mediant_oracle::random_free_vertex(rng, self.map.grid(), PlacementKind::Center)
    }
}

/// Calls `check` for random maps with all rules of centers, and for each a k, which differs from map to map.
pub(super) fn for_random_grounds(maps: u64, mut check: impl FnMut(&Ground, &Arc<WalkingGraph>, &str)) {
    for seed in seeds(maps) {
        let (ground, about) = Ground::random(seed);
        let map = ground.map(&about);
        let rules = Rules::ALL.into_iter().filter(|rules| rules.placement() == PlacementKind::Center);
        for (rules, number) in rules.zip(0..) {
            let k = FiniteK::new(2 + ((seed / 3 + number) % 7) as u32).expect("a small k");
            let graph = Arc::new(WalkingGraph::new(Arc::clone(&map), rules, k).expect("a small k"));
            check(&ground, &graph, &format!("{rules}, k = {k}, {about}"));
        }
    }
}

/// All vertices of a graph, row by row.
pub(super) fn vertices(graph: &WalkingGraph) -> impl Iterator<Item = Vertex> + use<> {
    let (width, height) = graph.size();
    (0..height as i32).flat_map(move |y| (0..width as i32).map(move |x| Vertex::new(x, y)))
}
