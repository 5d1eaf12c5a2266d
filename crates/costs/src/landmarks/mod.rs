//! Landmarks: the index of cost surfaces.
//!
//! **Bound.** A field from a landmark (or from several) has for the ends of every move costs that differ by
//! the move's cost at most, since moves cost the same both ways. So the difference of the field's costs at
//! two vertices is a lower bound of the cost between them: a *differential heuristic* (Goldberg & Harrelson
//! 2005; Sturtevant et al. 2009). The greatest of several bounds is one.
//!
//! **Components.** One field has a landmark in each component of the map, so none of its costs there is
//! infinite. Small components have no landmark; all their states hold the same greatest number.
//!
//! **32 bits.** A cost d is kept as q = ⌊x d⌋ in units of 2ˢ, with x = (m − 2ˢ) / (m 2ˢ), where m is the
//! least cost of a move. For a move of cost c between a and b, |d(a) − d(b)| ≤ c and c ≥ m. So
//!
//! 2ˢ |q(a) − q(b)| ≤ 2ˢ (x c + 1) = c − c 2ˢ / m + 2ˢ ≤ c.
//!
//! The bound 2ˢ |q(a) − q(b)| is therefore **consistent**, and, as it is 0 between a vertex and itself,
//! admissible. What it loses is a part 2ˢ / m of the exact one: mostly a millionth, never more than a
//! thousandth. A cost beyond the greatest number is kept as that number, which takes nothing of this away.
//!
//! **Edits.** All that a search needs of the numbers is that 2ˢ |q(a) − q(b)| is at most the cost of each
//! move. Where costs rise and cells close, moves cost more or vanish, and the old numbers remain right. Where
//! costs fall and cells open, the numbers are lowered until they are right again. That holds in the same
//! units; a surface in units of its own has new landmarks.

mod bytes;
mod choice;
mod error;
mod lines;
mod repair;

use std::sync::Arc;

use mediant_grid::{Identity, Interrupt, Vertex};
use mediant_moves::Cost;

pub use self::error::LandmarksError;
use self::{choice::Components, lines::Lines};
use crate::{CostField, CostFieldError, CostFieldQuery, graph::CostGraph};

/// Lower bounds of the costs between all vertices of a graph, by fields from a few landmarks: the index of a
/// cost surface. Immutable; share it between planners.
///
/// It takes 4 bytes a vertex and landmark. The bounds are consistent, so that paths by them are the cheapest
/// ones.
///
/// ```
/// use std::sync::Arc;
/// use mediant_costs::{CostAStar, CostGraph, CostSurface, Landmarks};
/// use mediant_grid::{CornerRule, Interrupt, Rules, Vertex};
/// use mediant_moves::FiniteK;
/// use mediant_search::{Ends, Planner};
///
/// let map = Arc::new(CostSurface::from_fn(30, 20, |x, y| Some(f64::from(1 + (7 * x + 5 * y) % 11)))?);
/// let graph = Arc::new(CostGraph::new(map, Rules::Center(CornerRule::Never), FiniteK::N8)?);
/// let landmarks = Arc::new(Landmarks::new(&graph, Landmarks::DEFAULT_COUNT, &Interrupt::NEVER)?);
/// let (from, to) = (Vertex::new(2, 3), Vertex::new(28, 17));
/// let mut planner = CostAStar::with_landmarks(Arc::clone(&graph), Arc::clone(&landmarks))?;
/// let answer = planner.solve(Ends::new(from, to))?;
/// let cost = answer.path().and_then(|path| graph.path_cost(path));
/// assert!(landmarks.least_cost(&graph, from, to)? <= cost.expect("all cells are free"));
/// // The bytes can be saved; they are checked when they come back.
/// assert_eq!(Landmarks::from_bytes(&graph, &landmarks.to_bytes(&graph)?, &Interrupt::NEVER)?, *landmarks);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Landmarks {
    identity: Identity,
    lines: Arc<Lines>,
    shift: u32,
}

/// The number of a state that no landmark reaches.
const NONE: u32 = u32::MAX;

/// The rounding of a field's costs to numbers of 32 bits.
#[derive(Clone, Copy, Debug)]
struct Rounding {
    /// The s of the module's documentation.
    shift: u32,
    /// Its x, as a fraction of 2⁶⁴, rounded down.
    factor: u64,
}

impl Rounding {
    /// The greatest part of a cost that is lost: 2 to minus this.
    const LOSS: u32 = 10;

    /// For moves of at least a cost, and fields up to another one, if that does not cost too much.
    fn new(least_move: u64, greatest: u64) -> Self {
        let needed = (u64::BITS - greatest.leading_zeros()).saturating_sub(u32::BITS);
        let most = least_move.max(1).ilog2().saturating_sub(Self::LOSS);
        let shift = needed.min(most).min(31);
        let (least, unit) = (u128::from(least_move), 1 << shift);
        Self { shift, factor: ((least.saturating_sub(unit) << 64) / (least.max(1) << shift)) as u64 }
    }

    fn number(self, cost: u64) -> u32 {
        let product = (u128::from(cost) * u128::from(self.factor)) >> 64;
        product.min(u128::from(NONE - 1)) as u32
    }
}

impl Landmarks {
    /// The number of landmarks with which searches are the quickest on most surfaces.
    pub const DEFAULT_COUNT: usize = 8;

    /// The greatest number of landmarks.
    pub const MAX_COUNT: usize = lines::MOST;

    /// Landmarks for a graph: 4, 8 or 16 of them, the first of these that is not less than `count`, in each
    /// component. One after the other is the vertex that is farthest from those before it. It takes as long
    /// as so many fields and two more. Its [progress](Interrupt::progress) is the number of those that are
    /// made.
    ///
    /// # Errors
    /// [`LandmarksError::Count`]; [`LandmarksError::Interrupted`].
    pub fn new(graph: &Arc<CostGraph>, count: usize, interrupt: &Interrupt) -> Result<Self, LandmarksError> {
        let mut lines = Lines::new(graph.states(), count)?;
        let components = Components::of(graph, interrupt)?;
        let of_field = interrupt.unheard();
        let field = |sources: &[Vertex]| {
            CostField::new(Arc::clone(graph), CostFieldQuery::new(sources), &of_field).map_err(|error| {
                match error {
                    CostFieldError::Interrupted(interrupted) => LandmarksError::Interrupted(interrupted),
                    // Sources are free, and there is no limit.
                    _ => LandmarksError::Bytes("a source of a field is blocked"),
                }
            })
        };
        interrupt.tell(0, lines.count());
        // From anywhere to the first landmarks. No two vertices of a component are farther apart than twice
        // the greatest cost.
        let anywhere = field(components.first())?;
        let mut cost = |state| anywhere.known(state).unwrap_or_default();
        let (mut sources, farthest) = components.farthest(graph, &mut cost);
        drop(anywhere);
        let (least_move, _) = graph.scanner().bounds(graph.map().scale());
        let rounding = Rounding::new(least_move, farthest.saturating_mul(2));
        for slot in 0..lines.count() {
            let field = field(&sources)?;
            let mut writer = lines.writer();
            for state in components.states() {
                if let Some(cost) = field.known(state) {
                    writer.row_mut(state)[slot] = rounding.number(cost);
                }
            }
            interrupt.check("placing the landmarks")?;
            let mut nearest =
                |state| lines.row(state)[..=slot].iter().min().map_or(0, |&nearest| u64::from(nearest));
            sources = components.farthest(graph, &mut nearest).0;
            interrupt.tell(slot + 1, lines.count());
        }
        Ok(Self { identity: graph.identity(), lines: Arc::new(lines), shift: rounding.shift })
    }

    /// The number of landmarks that are made for a count: 4, 8 or 16.
    #[must_use]
    pub fn rounded(count: usize) -> usize {
        lines::rounded(count)
    }

    /// The memory that so many landmarks of a graph take, in bytes.
    #[must_use]
    pub fn bytes(graph: &CostGraph, count: usize) -> usize {
        graph.states().saturating_mul(size_of::<u32>() * lines::rounded(count))
    }

    /// The number of landmarks in each component.
    #[must_use]
    pub fn count(&self) -> usize {
        self.lines.count()
    }

    /// The identity of the graph: its surface, rules and k.
    #[must_use]
    pub const fn identity(&self) -> Identity {
        self.identity
    }

    /// The memory used, in bytes.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        self.lines.memory_bytes()
    }

    /// A lower bound of the cost between two vertices of the graph, by the landmarks alone: 0 where one of
    /// them is none on the map.
    ///
    /// # Errors
    /// [`LandmarksError::Mismatch`] for another graph.
    pub fn least_cost(&self, graph: &CostGraph, from: Vertex, to: Vertex) -> Result<Cost, LandmarksError> {
        self.identity.check_equal("the landmarks", ("the graph", graph.identity()))?;
        let states = graph.end(from).zip(graph.end(to));
        Ok(states.map_or(Cost::ZERO, |(from, to)| self.bound(from, &self.numbers(to))))
    }

    /// The numbers of a state.
    pub(crate) fn numbers(&self, state: usize) -> lines::Numbers {
        self.lines.numbers(state)
    }

    /// A lower bound of the cost from a state to one with these numbers.
    #[inline]
    pub(crate) fn bound(&self, state: usize, goal: &lines::Numbers) -> Cost {
        Cost::from_bits(u64::from(self.lines.greatest_difference(state, goal)) << self.shift)
    }
}

pub(crate) use lines::Numbers;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_differ_by_the_cost_of_a_move_at_most() {
        let farthest = [1, 1 << 20, 1 << 31, (1 << 33) + 7, 1 << 45, 1 << 62, u64::MAX];
        for least_move in [1, 2, 1 << 14, 12_345_678, 1 << 32, (1 << 33) - 1, 1 << 50] {
            for farthest in farthest {
                let rounding = Rounding::new(least_move, farthest);
                let mut seed = 7_u64;
                for _ in 0..2_000 {
                    seed = seed.wrapping_mul(0x5851_F42D_4C95_7F2D).wrapping_add(0x1405_7B7E_F767_814F);
                    let from = (seed >> 1) % farthest.clamp(1, 1 << 62);
                    let cost = least_move + (seed >> 40) % least_move;
                    let [a, b] = [from, from + cost].map(|cost| rounding.number(cost));
                    let bound = u64::from(a.abs_diff(b)) << rounding.shift;
                    assert!(bound <= cost, "{from}, {cost}, {rounding:?}");
                    // Nearly nothing is lost.
                    if least_move > 1 << 13 && b < NONE - 1 {
                        let lost = cost - bound;
                        assert!(lost >> 3 <= cost >> Rounding::LOSS, "{from}, {cost}, {rounding:?}");
                    }
                }
            }
        }
    }
}
