//! The search graph of a map to walk on.

use std::sync::Arc;

use mediant_grid::{CornerRule, Identity, Rules, Vertex};
use mediant_moves::{Cost, CostTable, FiniteK, Vector};
use mediant_search::{End, Path, PathCosts, QueryError};

use super::{
    Heading, WalkingError,
    map::{BLOCKED, WalkingMap},
    moves::{Move, Moves},
};
use crate::{
    error::CostsError,
    graph::at_any_angle,
    graph::{CostGraph, steps},
    layout::Steps,
    scan::{Scanning, Visit},
};

/// The search graph of a map to walk on: the centers of its cells, joined by the moves of N(k) that are legal
/// by a rule of corners. It is directed: a move uphill and the one back cost different times.
///
/// ```
/// use std::sync::Arc;
/// use mediant_costs::{Langmuir, Pace, WalkingGraph, WalkingMap};
/// use mediant_grid::{CornerRule, Interrupt, Rules, Vertex};
/// use mediant_moves::{FiniteK, Vector};
///
/// let pace = Pace::Langmuir(Langmuir::default());
/// let hill = |x: u32, _| Some(f64::from(x));
/// let map = Arc::new(WalkingMap::new((3, 2), (10.0, 10.0), &pace, &Interrupt::NEVER, hill)?);
/// let graph = WalkingGraph::new(map, Rules::Center(CornerRule::Always), FiniteK::N16)?;
/// let time = |x, dx| graph.move_cost(Vertex::new(x, 0), Vector::new(dx, 0)).map(|cost| graph.to_f64(cost));
/// // 10 m at 0.72 s, and 6 s for the meter up; 1.9998 s less downhill.
/// assert!(time(0, 1).is_some_and(|time| (time - 13.2).abs() < 1e-6));
/// assert!(time(1, -1).is_some_and(|time| (time - 5.2002).abs() < 1e-6));
/// # Ok::<(), mediant_costs::WalkingError>(())
/// ```
#[derive(Clone, Debug)]
pub struct WalkingGraph {
    map: Arc<WalkingMap>,
    rule: CornerRule,
    k: FiniteK,
    moves: Moves,
    steps: Steps,
    /// Whether a corner may be cut between two cells, by which of the two are free: a bit each.
    allowed: u8,
    /// h_k where a unit of length takes the least time.
    least: CostTable,
}

impl WalkingGraph {
    /// The greatest k.
    pub const MAX_K: u32 = CostGraph::MAX_K;

    /// The search graph of a map under some rules, which are those of centers, and N(k).
    ///
    /// # Errors
    /// [`WalkingError::Corners`]; [`WalkingError::Costs`] for a k above [`MAX_K`](Self::MAX_K).
    pub fn new(map: Arc<WalkingMap>, rules: Rules, k: FiniteK) -> Result<Self, WalkingError> {
        let Rules::Center(rule) = rules else { return Err(WalkingError::Corners) };
        let too_large = WalkingError::Costs(CostsError::K { k, max: Self::MAX_K });
        if k.get() > Self::MAX_K {
            return Err(too_large);
        }
        let moves = Moves::new(k, &map).map_err(|_| too_large)?;
        let least = CostTable::with_costs(k, |v| moves.least(v)).map_err(|_| too_large)?;
        let allowed = match rule {
            CornerRule::Never => 0b1000,
            CornerRule::One => 0b1110,
            CornerRule::Always => 0b1111,
        };
        let steps = Steps::new(map.layout());
        Ok(Self { map, rule, k, moves, steps, allowed, least })
    }

    /// The map.
    #[must_use]
    pub const fn map(&self) -> &Arc<WalkingMap> {
        &self.map
    }

    /// The k of the neighborhood.
    #[must_use]
    pub const fn k(&self) -> FiniteK {
        self.k
    }

    /// The rule of corners, at centers.
    #[must_use]
    pub const fn rules(&self) -> Rules {
        Rules::Center(self.rule)
    }

    /// The identity: its map, rules and k.
    #[must_use]
    pub fn identity(&self) -> Identity {
        Identity { map: Some(self.map.id()), rules: self.rules(), k: Some(self.k.into()) }
    }

    /// The numbers of columns and rows of vertices.
    #[must_use]
    pub fn size(&self) -> (u32, u32) {
        (self.map.width(), self.map.height())
    }

    /// Whether a vertex is free: its cell is on the map, and has an elevation.
    #[must_use]
    pub fn is_free(&self, at: Vertex) -> bool {
        !self.map.is_blocked(at.x, at.y)
    }

    /// Checks that a vertex can be this end of a path.
    ///
    /// # Errors
    /// [`QueryError::Outside`] or [`QueryError::Blocked`].
    pub fn check(&self, end: End, at: Vertex) -> Result<(), QueryError> {
        if self.position(at).is_none() {
            let (width, height) = self.size();
            let last = Vertex::new(width as i32 - 1, height as i32 - 1);
            return Err(QueryError::Outside { end, at: at.into(), last });
        }
        if self.is_free(at) { Ok(()) } else { Err(QueryError::Blocked { end, at: at.into() }) }
    }

    /// The cost of a move from a vertex; `None` if it is no legal move of N(k) there.
    #[must_use]
    pub fn move_cost(&self, from: Vertex, v: Vector) -> Option<Cost> {
        let at = self.position(from).filter(|_| self.is_free(from))?;
        let of = self.moves.all.iter().find(|known| known.vector == v)?;
        self.cost_of(of, Heading::FromSources, at).map(Cost::from_bits)
    }

    /// The cost of a path over N(k) in its direction, whose waypoints are joined by one move each, repeated;
    /// `None` if a move is not legal.
    #[must_use]
    pub fn path_cost(&self, path: &Path) -> Option<Cost> {
        if !path.waypoints().iter().all(|&at| self.position(at).is_some()) {
            return None;
        }
        steps(path).try_fold(Cost::ZERO, |cost, (from, v)| Some(cost + self.move_cost(from, v)?))
    }

    /// A cost as a number: times the map's unit.
    #[must_use]
    pub fn to_f64(&self, cost: Cost) -> f64 {
        cost.to_bits() as f64 * self.map.unit()
    }

    /// The cost of the cheapest path by a displacement where a unit of length takes the least time: h_k,
    /// consistent, whatever the direction.
    #[must_use]
    #[inline]
    pub fn least_cost(&self, d: Vector) -> Cost {
        self.least.distance(d)
    }

    /// The memory used beyond the map, in bytes.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        self.moves.memory_bytes()
    }

    /// The greatest cost within a limit, with room for the rounding of both.
    pub(super) fn greatest_cost(&self, limit: f64) -> u64 {
        // The cast saturates.
        let cost = (limit / self.map.unit()) as u64;
        cost.saturating_add(cost >> 31).saturating_add(1)
    }

    pub(super) const fn moves(&self) -> &Moves {
        &self.moves
    }

    /// The cost of a move from a position, or, towards sources, of the move against it, which ends there;
    /// `None` if it is not legal.
    pub(super) fn cost_of(&self, of: &Move, heading: Heading, at: usize) -> Option<u64> {
        let (from, cells) = (self.steps.from(at), &self.moves.cells);
        let place = |cell: u16| {
            let (dx, dy) = cells[usize::from(cell)];
            from.to(dx, dy)
        };
        let height = |cell| self.map.heights()[place(cell)];
        let friction =
            self.map.frictions().map(|(of, shift)| move |cell| u64::from(of[place(cell)]) << shift);
        self.moves.cost((of, heading), &self.map, self.allowed, height, friction)
    }

    /// The position to which a vector leads from another one.
    pub(super) fn target(&self, at: usize, v: Vector) -> usize {
        self.steps.from(at).to(v.x as i8, v.y as i8)
    }

    /// The position of a vertex; `None` outside the map.
    pub(super) fn position(&self, at: Vertex) -> Option<usize> {
        let (width, height) = self.size();
        let is_on = (0..width as i32).contains(&at.x) && (0..height as i32).contains(&at.y);
        is_on.then(|| self.map.layout().position(at.x, at.y))
    }

    /// The vertex of a position.
    pub(super) fn vertex(&self, at: usize) -> Vertex {
        let (x, y) = self.map.layout().cell(at);
        Vertex::new(x, y)
    }
}

impl PathCosts for WalkingGraph {
    fn least(&self, v: Vector) -> Cost {
        self.least_cost(v)
    }

    fn least_at_any_angle(&self, v: Vector) -> Cost {
        at_any_angle([Vector::new(1, 0), Vector::new(0, 1)].map(|step| self.least_cost(step)), v)
    }

    fn cost(&self, path: &Path) -> Cost {
        self.path_cost(path).unwrap_or(Cost::MAX)
    }

    fn unit(&self) -> f64 {
        self.map.unit()
    }
}

/// The moves of a graph, with room for `N` cells around a vertex.
#[derive(Clone, Copy)]
pub(super) struct OfWalking<'g, const N: usize> {
    graph: &'g WalkingGraph,
    heading: Heading,
}

impl<'g, const N: usize> OfWalking<'g, N> {
    pub(super) const fn new(graph: &'g WalkingGraph, heading: Heading) -> Self {
        Self { graph, heading }
    }
}

/// At least as many cells as the moves of N(k) read, up to k = 5 and up to k = 8.
pub(super) const ROOMS: [usize; 2] = [1 << 6, 1 << 10];

impl<const N: usize> Scanning for OfWalking<'_, N> {
    fn bounds(self) -> (u64, u64) {
        let Self { graph, .. } = self;
        let least = graph.moves.all.iter().map(|of| of.least).min();
        (least.unwrap_or(1), graph.moves.greatest(&graph.map))
    }

    #[inline]
    fn scan(self, (state, cost): (usize, u64), visit: &mut impl Visit) {
        let Self { graph, heading } = self;
        let WalkingGraph { map, moves, .. } = graph;
        let (from, heights) = (graph.steps.from(state), map.heights());
        let frictions = map.frictions();
        // Read when the first move needs them.
        let (mut window, mut friction_window) = ([BLOCKED; N], [0; N]);
        let mut is_read = false;
        for (by, of) in moves.all.iter().enumerate() {
            let to = from.to(of.vector.x as i8, of.vector.y as i8);
            let known = visit.known(to);
            if cost + of.least >= known {
                continue;
            }
            if !std::mem::replace(&mut is_read, true) {
                for (read, &(dx, dy)) in window.iter_mut().zip(&moves.cells) {
                    *read = heights[from.to(dx, dy)];
                }
                if let Some((frictions, _)) = frictions {
                    for (read, &(dx, dy)) in friction_window.iter_mut().zip(&moves.cells) {
                        *read = frictions[from.to(dx, dy)];
                    }
                }
            }
            let height = |cell: u16| window[usize::from(cell) % N];
            let friction = frictions.map(|(_, shift)| {
                let window = &friction_window;
                move |cell: u16| u64::from(window[usize::from(cell) % N]) << shift
            });
            let Some(more) = moves.cost((of, heading), map, graph.allowed, height, friction) else {
                continue;
            };
            if cost + more < known {
                visit.relax(by, to, cost + more);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::walking::Pace;

    #[test]
    fn there_is_room_for_all_cells() {
        let interrupt = &mediant_grid::Interrupt::NEVER;
        let map = WalkingMap::new((3, 3), (1.0, 1.0), &Pace::Tobler, interrupt, |_, _| Some(0.0));
        let map = map.expect("flat ground");
        for k in 2..=WalkingGraph::MAX_K {
            let moves = Moves::new(FiniteK::new(k).expect("a small k"), &map).expect("a small k");
            assert!(moves.cells.len() <= ROOMS[usize::from(k > 5)], "k = {k}: {}", moves.cells.len());
        }
    }
}
