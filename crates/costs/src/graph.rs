//! The search graph of a cost surface.

use std::sync::Arc;

use mediant_grid::{DiagonalGap, Identity, PlacementKind, Rules, Vertex};
use mediant_moves::{Cost, CostTable, FiniteK, Vector};
use mediant_search::{End, Path, PathCosts, QueryError};

use crate::{
    error::CostsError,
    gaps::Gaps,
    layout::{Layout, Steps},
    moves::{Move, Moves},
    scan::{Scanner, Visit, by_kind},
    surface::CostSurface,
};

/// The search graph of a cost surface: its vertices by a placement, joined by the moves of N(k) that are
/// legal by a rule of motion. A move costs the integral of the cells' costs along it, as an integer of the
/// map's [unit](CostSurface::unit).
///
/// No edge is stored, and searches share it.
///
/// ```
/// use std::sync::Arc;
/// use mediant_costs::{CostGraph, CostSurface};
/// use mediant_grid::{CornerRule, Rules, Vertex};
/// use mediant_moves::{FiniteK, Vector};
///
/// let map = Arc::new(CostSurface::from_fn(3, 2, |x, y| Some(f64::from(1 + 2 * x + y)))?);
/// let graph = CostGraph::new(map, Rules::Center(CornerRule::Never), FiniteK::N16)?;
/// // (2, 1) crosses cells of cost 1, 3, 4 and 6, a quarter of its length each.
/// let cost = graph.move_cost(Vertex::new(0, 0), Vector::new(2, 1));
/// let expected = 5.0_f64.sqrt() * (1.0 + 3.0 + 4.0 + 6.0) / 4.0;
/// assert!(cost.is_some_and(|cost| (graph.to_f64(cost) - expected).abs() < 1e-9));
/// # Ok::<(), mediant_costs::CostsError>(())
/// ```
#[derive(Clone, Debug)]
pub struct CostGraph {
    map: Arc<CostSurface>,
    k: FiniteK,
    scanner: Scanner,
    /// h_k over cells of the least cost.
    least: CostTable,
}

impl CostGraph {
    /// The greatest k: 256 moves, up to 13 cells long along an axis.
    pub const MAX_K: u32 = 8;

    /// The search graph of a surface under some rules and N(k).
    ///
    /// # Errors
    /// [`CostsError::K`] above [`MAX_K`](Self::MAX_K); [`CostsError::Rules`] for those of any angle;
    /// [`CostsError::Size`] for so many closed gaps on a map of nearly 2³² cells that they have no numbers.
    pub fn new(map: Arc<CostSurface>, rules: Rules, k: FiniteK) -> Result<Self, CostsError> {
        let too_large = CostsError::K { k, max: Self::MAX_K };
        if k.get() > Self::MAX_K {
            return Err(too_large);
        }
        if let Rules::CenterGap(_) = rules {
            return Err(CostsError::Rules { rules });
        }
        let moves = Moves::new(rules.placement(), k, map.scale()).map_err(|_| too_large)?;
        let least = CostTable::with_costs(k, |v| moves.least(v)).map_err(|_| too_large)?;
        let steps = Steps::new(map.layout());
        let gaps = if is_closed(rules) { Gaps::of(&map, &steps) } else { Gaps::default() };
        let scanner = Scanner::new(moves, steps, gaps, rules);
        Self { map, k, scanner, least }.with_numbers()
    }

    /// This graph, if all of its states have numbers of 32 bits.
    fn with_numbers(self) -> Result<Self, CostsError> {
        let (width, height) = (self.map.width().into(), self.map.height().into());
        if self.states() as u64 > 1 << 32 { Err(CostsError::Size { width, height }) } else { Ok(self) }
    }

    /// The search graph of another surface under the same rules and k: that after an edit, which changed
    /// these cells at most. Where the surface has kept its units, it shares all tables, and closed gaps are
    /// looked for around the cells alone. Cells outside the map are left out.
    ///
    /// # Errors
    /// [`CostsError::Size`] as for [`new`](Self::new).
    pub fn after(&self, map: Arc<CostSurface>, cells: &[(u32, u32)]) -> Result<Self, CostsError> {
        if map.scale() != self.map.scale() || map.layout() != self.map.layout() {
            return Self::new(map, self.rules(), self.k);
        }
        let mut after = self.clone();
        if is_closed(self.rules()) {
            let is_on = |&&(x, y): &&(u32, u32)| x < map.width() && y < map.height();
            let cells: Vec<_> = cells.iter().filter(is_on).copied().collect();
            after.scanner.gaps = self.scanner.gaps.after(&map, &after.scanner.steps, &cells);
        }
        after.map = map;
        after.with_numbers()
    }

    /// The surface.
    #[must_use]
    pub const fn map(&self) -> &Arc<CostSurface> {
        &self.map
    }

    /// The k of the neighborhood.
    #[must_use]
    pub const fn k(&self) -> FiniteK {
        self.k
    }

    /// The placement and its rule of motion.
    #[must_use]
    pub const fn rules(&self) -> Rules {
        self.scanner.rules
    }

    /// The identity: its surface, rules and k.
    #[must_use]
    pub fn identity(&self) -> Identity {
        Identity { map: Some(self.map.id()), rules: self.rules(), k: Some(self.k.into()) }
    }

    /// The numbers of columns and rows of vertices.
    #[must_use]
    pub fn size(&self) -> (u32, u32) {
        let more = match self.rules().placement() {
            PlacementKind::Center => 0,
            PlacementKind::Corner => 1,
        };
        (self.map.width() + more, self.map.height() + more)
    }

    /// Whether a vertex is free: at centers its cell, at corners one of the four cells around it. Those
    /// outside the map are not.
    #[must_use]
    pub fn is_free(&self, at: Vertex) -> bool {
        let Some(position) = self.position(at) else { return false };
        let from = self.scanner.steps.from(position);
        let cells: &[(i8, i8)] = match self.rules().placement() {
            PlacementKind::Center => &[(0, 0)],
            PlacementKind::Corner => &[(0, 0), (-1, 0), (0, -1), (-1, -1)],
        };
        cells.iter().any(|&(dx, dy)| self.map.weights()[from.to(dx, dy)] > 0)
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
        let at = self.position(from)?;
        self.cost_of(self.known_move(v)?, at).map(Cost::from_bits)
    }

    /// The cost of a move over cells whose weights have this sum, each times its share of the move's length:
    /// `None` for a vector that is no move of N(k). A weight is the cell's cost in the map's own integers;
    /// the shares are in parts of 2 |dx| |dy| between centers and |dx| |dy| between corners, where 0 counts
    /// as 1.
    #[doc(hidden)]
    #[must_use]
    pub fn cost_of_sum(&self, v: Vector, sum: u64) -> Option<Cost> {
        self.known_move(v).map(|of| Cost::from_bits(of.factor.cost(sum)))
    }

    /// The cost of a path over N(k), whose waypoints are joined by one move each, repeated; `None` if a move
    /// is not legal. (It is not asked whether the path passes a closed gap.)
    #[must_use]
    pub fn path_cost(&self, path: &Path) -> Option<Cost> {
        if !self.is_on(path) {
            return None;
        }
        steps(path).try_fold(Cost::ZERO, |cost, (from, v)| Some(cost + self.move_cost(from, v)?))
    }

    /// A cost as a number: times the map's unit.
    #[must_use]
    pub fn to_f64(&self, cost: Cost) -> f64 {
        cost.to_bits() as f64 * self.map.unit()
    }

    /// The cost of the cheapest path by a displacement over cells of the least cost: h_k, consistent.
    #[must_use]
    #[inline]
    pub fn least_cost(&self, d: Vector) -> Cost {
        self.least.distance(d)
    }

    /// The memory used beyond the surface, in bytes.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        self.scanner.moves.memory_bytes() + self.scanner.gaps.len() * size_of::<u32>()
    }

    /// The cells that a path of straight segments crosses, in their order on the way, each with the length in
    /// it, in the unit of the cell size: the sum of length · cost is the cost of the path. Of a move along a
    /// grid line it is the cell whose cost counts. Cells that are touched in a corner alone are left out.
    /// Empty for a path with a segment that is not legal.
    #[must_use]
    pub fn crossings(&self, path: &Path) -> Vec<((u32, u32), f64)> {
        let mut crossings: Vec<((u32, u32), f64)> = Vec::new();
        if !self.is_on(path) {
            return crossings;
        }
        let mut add = |cell, length| match crossings.last_mut().filter(|(last, _)| *last == cell) {
            Some((_, known)) => *known += length,
            None => crossings.push((cell, length)),
        };
        for ends in path.waypoints().windows(2).filter(|ends| ends[0] != ends[1]) {
            let v = primitive(ends[0].to(ends[1])).0;
            let is_legal = match self.known_move(v) {
                Some(of) => steps_between(ends[0], ends[1]).all(|(from, _)| {
                    let at = self.position(from).filter(|&at| self.cost_of(of, at).is_some());
                    at.is_some_and(|at| {
                        let crossed = self.scanner.crossed(self.map.as_ref(), at, of);
                        crossed.for_each(|(cell, length)| add(cell, length));
                        true
                    })
                }),
                None => self.cells_along(ends[0], ends[1], &mut add),
            };
            if !is_legal {
                return Vec::new();
            }
        }
        crossings
    }

    /// Whether all waypoints are free. Others may be so far apart that no difference of coordinates holds.
    fn is_on(&self, path: &Path) -> bool {
        path.waypoints().iter().all(|&at| self.is_free(at))
    }

    pub(crate) fn known_move(&self, v: Vector) -> Option<&Move> {
        self.scanner.moves.all().iter().find(|known| known.vector == v)
    }

    /// The cost of a move from a state; `None` if it is not legal there.
    pub(crate) fn cost_of(&self, of: &Move, state: usize) -> Option<u64> {
        let at = self.scanner.gaps.position(state);
        self.scanner.sum(self.map.weights(), at, of).map(|sum| of.factor.cost(sum))
    }

    /// The moves from a state that closed gaps allow, each with the state to which it leads.
    pub(crate) fn moves_from(&self, state: usize) -> impl Iterator<Item = (&Move, usize)> {
        self.scanner
            .moves
            .all()
            .iter()
            .filter_map(move |of| Some((of, self.scanner.target(self.map.weights(), state, of)?)))
    }

    /// Visits the legal moves from a state whose cost is known, by the scan that is made for the graph's k.
    /// It is compiled once for all visits, which it calls by a table: for those that do much themselves, or
    /// that are rare.
    pub(crate) fn scan(&self, from: (usize, u64), mut visit: &mut dyn Visit) {
        let (scanner, weights) = (&self.scanner, self.map.weights());
        by_kind!(self, [scanner.scan](weights, from, &mut visit));
    }

    /// Whether a state is blocked whatever the moves: then no scan asks for more of it.
    #[inline]
    pub(crate) fn is_blocked(&self, state: usize) -> bool {
        self.is_center() && self.map.weights()[state] == 0
    }

    /// The number of states.
    pub(crate) fn states(&self) -> usize {
        self.layout().len() + self.scanner.gaps.len()
    }

    /// The state of a path that ends at a vertex; `None` outside, and at a closed gap whose own cell is
    /// blocked.
    pub(crate) fn end(&self, at: Vertex) -> Option<usize> {
        self.scanner.gaps.end(self.map.weights(), self.position(at)?)
    }

    /// The greatest cost within a limit, with room for the rounding of both.
    pub(crate) fn greatest_cost(&self, limit: f64) -> u64 {
        // The cast saturates.
        let cost = (limit / self.map.unit()) as u64;
        cost.saturating_add(cost >> 31).saturating_add(1)
    }

    /// Whether vertices are the centers of cells.
    pub(crate) const fn is_center(&self) -> bool {
        matches!(self.rules().placement(), PlacementKind::Center)
    }

    pub(crate) const fn scanner(&self) -> &Scanner {
        &self.scanner
    }

    pub(crate) fn layout(&self) -> Layout {
        self.map.layout()
    }

    /// The position of a vertex; `None` outside the map.
    pub(crate) fn position(&self, at: Vertex) -> Option<usize> {
        let (width, height) = self.size();
        let is_on = (0..width as i32).contains(&at.x) && (0..height as i32).contains(&at.y);
        is_on.then(|| self.layout().position(at.x, at.y))
    }

    /// The vertex of a state.
    pub(crate) fn vertex(&self, state: usize) -> Vertex {
        let (x, y) = self.layout().cell(self.scanner.gaps.position(state));
        Vertex::new(x, y)
    }
}

/// Whether closed gaps are in the way.
fn is_closed(rules: Rules) -> bool {
    rules == Rules::Corner(DiagonalGap::Closed)
}

/// A lower bound of the cost of segments by a displacement, by the least costs of a step along each axis.
pub(crate) fn at_any_angle(steps: [Cost; 2], v: Vector) -> Cost {
    // A unit less: the costs of moves and of segments are rounded.
    let [across, down] = steps.map(|step| step.to_bits().saturating_sub(1) as f64);
    let (x, y) = v.abs();
    let (x, y) = (f64::from(x) * across, f64::from(y) * down);
    Cost::from_bits(((x * x + y * y).sqrt() * (1.0 - 4.0 * f64::EPSILON)) as u64)
}

impl PathCosts for CostGraph {
    fn least(&self, v: Vector) -> Cost {
        self.least_cost(v)
    }

    fn least_at_any_angle(&self, v: Vector) -> Cost {
        at_any_angle([Vector::new(1, 0), Vector::new(0, 1)].map(|step| self.least_cost(step)), v)
    }

    fn cost(&self, path: &Path) -> Cost {
        self.segments_cost(path).unwrap_or(Cost::MAX)
    }

    fn unit(&self) -> f64 {
        self.map.unit()
    }
}

/// The moves of a path over N(k), each with the vertex where it begins.
pub(crate) fn steps(path: &Path) -> impl Iterator<Item = (Vertex, Vector)> {
    let ends = path.waypoints().windows(2).filter(|ends| ends[0] != ends[1]);
    ends.flat_map(|ends| steps_between(ends[0], ends[1]))
}

/// The repetitions of the vector between two vertices, each with the vertex where it begins.
fn steps_between(from: Vertex, to: Vertex) -> impl Iterator<Item = (Vertex, Vector)> {
    let (v, times) = primitive(from.to(to));
    (0..times as i32).map(move |step| (Vertex::new(from.x + step * v.x, from.y + step * v.y), v))
}

/// The shortest vector of which this one is a multiple, and how many times that is repeated.
pub(crate) fn primitive(d: Vector) -> (Vector, u32) {
    let times = d.gcd().max(1);
    (Vector::new(d.x / times as i32, d.y / times as i32), times)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of the length of a segment in steps, whose costs differ along the two axes, at most a unit a step is
    /// missing, and nothing is too much.
    #[test]
    fn segments_at_any_angle_cost_no_less_than_their_bound() {
        for [across, down] in [[1_u64 << 32, 1 << 32], [3 << 31, 7 << 33], [1 << 20, 1 << 40], [0, 1 << 32]] {
            for (x, y) in [(0, 0), (5, 0), (0, -9), (-3, 4), (1, 1), (-1_000, 999), (12_000, 70)] {
                let bound =
                    at_any_angle([across, down].map(Cost::from_bits), Vector::new(x, y)).to_bits() as f64;
                let length = |less: f64| {
                    let [across, down] = [across, down].map(|step| (step as f64 - less).max(0.0));
                    (f64::from(x) * across).hypot(f64::from(y) * down)
                };
                assert!(
                    bound <= length(0.0) && bound >= length(1.0) * (1.0 - 1e-15) - 1.0,
                    "({x}, {y}): {bound}"
                );
            }
        }
    }
}
