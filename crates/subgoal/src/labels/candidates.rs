//! The subgoals to which the ends of a query are joined.

use mediant_grid::{FreeSpace, Placement, Vector, Vertex};
use mediant_moves::{FiniteK, K};

use super::HubLabels;
use crate::placement::SubgoalPlacement;

/// The displacement from an end to a subgoal.
pub(super) type Step = (i32, i32);

/// The joint of an end and a subgoal: a displacement in cells, or in parts of a cell.
pub(super) trait Joint: Copy {
    /// The cost of the line between both.
    fn cost<P: SubgoalPlacement>(self, index: &HubLabels<P>) -> u64;

    /// The direction in which a path arrives at the subgoal, by which it is known how it may lead on.
    fn arrival(self) -> Vector;
}

impl Joint for Step {
    #[inline]
    fn cost<P: SubgoalPlacement>(self, index: &HubLabels<P>) -> u64 {
        index.metric.estimate(Vector::new(self.0, self.1)).to_bits()
    }

    #[inline]
    fn arrival(self) -> Vector {
        Vector::new(self.0, self.1)
    }
}

/// The slots that an end of a query is joined to.
#[derive(Debug)]
pub(super) struct Candidates<J> {
    pub(super) slots: Vec<u32>,
    /// The joints with their subgoals.
    pub(super) steps: Vec<J>,
    /// Lower bounds on the costs of paths over them, in cells.
    pub(super) bounds: Vec<f32>,
    pub(super) count: usize,
    /// The numbers of those over which paths lead on.
    pub(super) leading: Vec<u32>,
}

impl Candidates<Step> {
    pub(super) fn new(room: usize) -> Self {
        let (slots, leading) = (vec![0; room], vec![0; room]);
        Self { slots, steps: vec![(0, 0); room], bounds: vec![0.0; room], count: 0, leading }
    }

    /// Makes room for so many slots.
    pub(super) fn fit(&mut self, room: usize) {
        let Self { slots, steps, bounds, count, leading } = self;
        slots.resize(room, 0);
        steps.resize(room, (0, 0));
        bounds.resize(room, 0.0);
        leading.resize(room, 0);
        *count = 0;
    }

    /// Looks up what an end sees.
    #[inline]
    pub(super) fn find<P: SubgoalPlacement>(
        &mut self,
        index: &HubLabels<P>,
        space: &FreeSpace<P>,
        end: Vertex,
    ) {
        self.count = index.geometry.seen.slots(end, &mut self.slots);
        if space.is_closed_gap(end) {
            self.keep_legal(index, space, end);
        }
        for (slot, step) in self.slots[..self.count].iter().zip(&mut self.steps) {
            let v = end.to(index.geometry.subgoals.vertex(slot / P::SIDES));
            *step = (v.x, v.y);
        }
    }

    /// Finds bounds on the costs of paths to the other end, which is at `other` from here.
    #[inline]
    pub(super) fn find_bounds(&mut self, k: K, other: Vector) {
        let bounds = self.bounds[..self.count].iter_mut().zip(&self.steps);
        let (x, y) = (other.x, other.y);
        match k {
            K::Finite(FiniteK::N4) => {
                bounds.for_each(|(bound, v)| *bound = manhattan(*v) + manhattan((x - v.0, y - v.1)));
            }
            K::Finite(FiniteK::N8) => {
                bounds.for_each(|(bound, v)| *bound = octile(*v) + octile((x - v.0, y - v.1)));
            }
            _ => bounds.for_each(|(bound, v)| *bound = straight(*v) + straight((x - v.0, y - v.1))),
        }
    }
}

impl<J: Joint> Candidates<J> {
    /// A path leaves a closed gap through the quadrant of the vertex's own cell.
    #[cold]
    pub(super) fn keep_legal<P: SubgoalPlacement, Q: Placement>(
        &mut self,
        index: &HubLabels<P>,
        space: &FreeSpace<Q>,
        end: Vertex,
    ) {
        let mut kept = 0;
        for i in 0..self.count {
            let at = index.geometry.subgoals.vertex(self.slots[i] / P::SIDES);
            self.slots[kept] = self.slots[i];
            kept += usize::from(space.may_turn(None, end, Some(at)) && space.sees(end, at));
        }
        self.count = kept;
    }

    /// Finds the candidates over which shortest paths can lead on to other subgoals. Returns their number.
    #[inline]
    pub(super) fn find_leading<P: SubgoalPlacement>(&mut self, index: &HubLabels<P>) -> usize {
        let mut count = 0;
        for ((slot, &step), i) in self.slots[..self.count].iter().zip(&self.steps).zip(0..) {
            let side = index.packed.sides[*slot as usize];
            self.leading[count] = i;
            count += usize::from(P::leads_on(index.k, side.bends(), step.arrival(), side.edges));
        }
        count
    }

    /// Puts the leading one with the least bound first.
    #[inline]
    pub(super) fn leading_first(&mut self, leading: usize) {
        let bounds = &self.bounds;
        let bound = |&i: &u32| bounds[i as usize];
        let leading = &mut self.leading[..leading];
        let least =
            (1..leading.len()).fold(0, |a, b| if bound(&leading[b]) < bound(&leading[a]) { b } else { a });
        if least > 0 {
            leading.swap(0, least);
        }
    }
}

/// Less than 1 by more than the relative error of a bound in single precision.
pub(super) const BELOW: f32 = 1.0 - 1e-6;

#[inline]
fn manhattan((x, y): (i32, i32)) -> f32 {
    (x.abs() + y.abs()) as f32 * BELOW
}

#[inline]
fn octile((x, y): (i32, i32)) -> f32 {
    let (x, y) = (x.abs(), y.abs());
    // Half of √2 − 1 is with the sum, half with the difference.
    ((x + y) as f32 * 0.707_106_77 + (x - y).abs() as f32 * 0.292_893_2) * BELOW
}

/// Not more than h_k for any k.
#[inline]
fn straight((x, y): (i32, i32)) -> f32 {
    let (x, y) = (x as f32, y as f32);
    (x * x + y * y).sqrt() * BELOW
}
