//! The oracle's knowledge of a map to walk on: times in floating point, from the ground below each move.

use std::{cell::RefCell, collections::BTreeMap};

use mediant::{FiniteK, Pace, Path, PlacementKind, Rules, Vertex};
use mediant_grid::Grid;
use mediant_moves::Vector;
use mediant_oracle::{Shares, WeightedMap, neighborhood, segment_is_legal};

/// Times differ by less than this part of themselves: the library's table of a pace is coarser than floats.
pub(super) const ROOM: f64 = 1e-5;

/// The friction of a weight of 1 beyond the first.
pub(super) const FRICTION: f64 = 0.125;

pub(super) struct Known {
    /// Its weights are the frictions, and 1.
    pub(super) map: WeightedMap,
    pub(super) elevations: Vec<f64>,
    pub(super) pace: Pace,
    pub(super) rules: Rules,
    pub(super) k: FiniteK,
    moves: Vec<(Vector, Shares)>,
    /// Of each source all times from it.
    from: RefCell<BTreeMap<(i32, i32), Vec<Option<f64>>>>,
}

impl Known {
    pub(super) fn new(map: WeightedMap, elevations: Vec<f64>, pace: Pace, rules: Rules, k: FiniteK) -> Self {
        let (width, height) = (map.grid().width(), map.grid().height());
        let moves = neighborhood(Some(k), width, height);
        let moves = moves.into_iter().map(|by| (by, Shares::new(PlacementKind::Center, by))).collect();
        Self { map, elevations, pace, rules, k, moves, from: RefCell::default() }
    }

    fn grid(&self) -> &Grid {
        self.map.grid()
    }

    fn index(&self, at: Vertex) -> usize {
        at.y as usize * self.grid().width() as usize + at.x as usize
    }

    pub(super) fn is_free(&self, at: Vertex) -> bool {
        self.map.weight(at.x, at.y).is_some()
    }

    /// All free vertices, row by row.
    pub(super) fn free(&self) -> Vec<Vertex> {
        let (width, height) = (self.grid().width() as i32, self.grid().height() as i32);
        let all = (0..height).flat_map(|y| (0..width).map(move |x| Vertex::new(x, y)));
        all.filter(|&at| self.is_free(at)).collect()
    }

    fn elevation(&self, x: i32, y: i32) -> Option<f64> {
        self.map.weight(x, y)?;
        Some(self.elevations[self.index(Vertex::new(x, y))])
    }

    /// The time of a legal move: it is cut where it meets the lines between centers, and the ground is linear
    /// along those.
    fn time(&self, from: Vertex, shares: &Shares) -> f64 {
        let by = shares.by();
        let (dx, dy) = (f64::from(by.x), f64::from(by.y));
        let (width, height) = self.map.cell_size();
        let length = (dx * width).hypot(dy * height);
        let between = |low: Option<f64>, high: Option<f64>, part: f64| {
            low.zip(high).map(|(low, high)| low + (high - low) * part)
        };
        let end = from + by;
        let mut cuts = vec![(0.0, self.elevation(from.x, from.y)), (1.0, self.elevation(end.x, end.y))];
        for column in 1..by.x.abs() {
            let t = f64::from(column) / dx.abs();
            let (x, y) = (from.x + column * by.x.signum(), f64::from(from.y) + t * dy);
            let [low, high] = [y.floor(), y.ceil()].map(|y| self.elevation(x, y as i32));
            cuts.push((t, between(low, high, y - y.floor())));
        }
        for row in 1..by.y.abs() {
            let t = f64::from(row) / dy.abs();
            let (x, y) = (f64::from(from.x) + t * dx, from.y + row * by.y.signum());
            let [low, high] = [x.floor(), x.ceil()].map(|x| self.elevation(x as i32, y));
            cuts.push((t, between(low, high, x - x.floor())));
        }
        cuts.sort_by(|one, other| one.0.total_cmp(&other.0));
        let cuts: Vec<(f64, f64)> = cuts.into_iter().filter_map(|(t, of)| Some((t, of?))).collect();
        let pieces = cuts.windows(2).map(|ends| {
            let piece = length * (ends[1].0 - ends[0].0);
            if piece > 0.0 { piece * self.pace.time((ends[1].1 - ends[0].1) / piece) } else { 0.0 }
        });
        let friction = shares.integral(&self.map, from).expect("a legal move has free cells").mean() - 1.0;
        pieces.sum::<f64>() + length * friction * FRICTION
    }

    /// The least time from a vertex to another.
    pub(super) fn least(&self, from: Vertex, to: Vertex) -> Option<f64> {
        let mut known = self.from.borrow_mut();
        let times = known.entry((from.x, from.y)).or_insert_with(|| self.times(from));
        times[self.index(to)]
    }

    /// By Bellman and Ford: on a few cells that is soon done.
    fn times(&self, source: Vertex) -> Vec<Option<f64>> {
        let free = self.free();
        let mut edges = Vec::new();
        for &at in &free {
            for (by, shares) in &self.moves {
                let to = at + *by;
                if self.is_free(to) && segment_is_legal(self.grid(), self.rules, at, to) {
                    edges.push((self.index(at), self.index(to), self.time(at, shares)));
                }
            }
        }
        let mut times = vec![None; self.elevations.len()];
        times[self.index(source)] = Some(0.0);
        let mut is_shorter = true;
        while is_shorter {
            is_shorter = false;
            for &(from, to, time) in &edges {
                let Some(time) = times[from].map(|known: f64| known + time) else { continue };
                if times[to].is_none_or(|known| time < known) {
                    times[to] = Some(time);
                    is_shorter = true;
                }
            }
        }
        times
    }

    /// The time of a path, move by move; `None` if it is not legal.
    pub(super) fn time_along(&self, path: &Path) -> Option<f64> {
        let mut sum = 0.0;
        for ends in path.waypoints().windows(2) {
            let (mut at, to) = (ends[0], ends[1]);
            while at != to {
                let rest = at.to(to);
                let is_step = |by: &Vector| {
                    let times = if by.x == 0 { rest.y / by.y } else { rest.x / by.x };
                    times > 0 && (by.x * times, by.y * times) == (rest.x, rest.y)
                };
                let (by, shares) = self.moves.iter().find(|(by, _)| is_step(by))?;
                if !segment_is_legal(self.grid(), self.rules, at, at + *by) {
                    return None;
                }
                sum += self.time(at, shares);
                at = at + *by;
            }
        }
        Some(sum)
    }
}
