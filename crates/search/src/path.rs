//! What a search returns.

use mediant_grid::{CornerRule, GridGraph, Placement, Rules, Vector, Vertex, VertexId};
use mediant_moves::{BOUND_WITHOUT_CORNER_CUTTING, FiniteK, bound_at_centers, bound_at_corners, decompose};

use crate::{NodeStore, ParentPointer};

/// A path by its waypoints, with its length.
///
/// Two consecutive waypoints are joined by one move of N(k), taken once or several times in a row, or in any-angle paths by
/// a straight legal segment. A path from a vertex to itself has that vertex alone.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    waypoints: Vec<Vertex>,
    cost: f64,
}

impl Path {
    /// The path along these waypoints; its cost is the sum of the lengths of the segments between them.
    #[must_use]
    pub fn new(waypoints: Vec<Vertex>) -> Self {
        // Not `sum`, which makes −0 of no segments.
        let cost = waypoints.windows(2).fold(0.0, |cost, ends| cost + ends[0].distance(ends[1]));
        Self { waypoints, cost }
    }

    /// The path that a search found. Allocates nothing else.
    pub(crate) fn trace_back<P: Placement, N: ParentPointer>(
        graph: &GridGraph<P>,
        nodes: &NodeStore<N>,
        start: VertexId,
        goal: VertexId,
    ) -> Self {
        let turns = LegsBack::new(graph, nodes, start, goal).turns().count();
        let mut waypoints = Vec::with_capacity(turns + 1);
        waypoints.push(graph.vertex(start));
        extend_back(graph, nodes, start, goal, &mut waypoints);
        Self::new(waypoints)
    }

    /// The waypoints, start and goal included.
    #[must_use]
    pub fn waypoints(&self) -> &[Vertex] {
        &self.waypoints
    }

    /// The waypoints, given away.
    #[must_use]
    pub fn into_waypoints(self) -> Vec<Vertex> {
        self.waypoints
    }

    /// The Euclidean length in cells, recomputed from the waypoints rather than taken from the search's fixed-point sum.
    #[must_use]
    pub const fn cost(&self) -> f64 {
        self.cost
    }

    /// The path smoothness PS of Hammoud & Lupin 2023, Eq. 1: the sum of 180° − φ over the waypoints between start and
    /// goal, φ being the angle between the two segments that meet there. In degrees; 0 for a straight path, and the
    /// greater the more the path turns.
    ///
    /// ```
    /// use mediant_search::Path;
    /// let path = Path::new(vec![(0, 0).into(), (3, 0).into(), (5, 2).into()]);
    /// assert_eq!(path.smoothness(), 45.0);
    /// ```
    #[must_use]
    pub fn smoothness(&self) -> f64 {
        let mut last = None;
        // A segment without length has no direction: it turns nothing.
        let segments = self.waypoints.windows(2).filter(|ends| ends[0] != ends[1]);
        segments.fold(0.0, |sum, ends| {
            let x = f64::from(ends[1].x) - f64::from(ends[0].x);
            let y = f64::from(ends[1].y) - f64::from(ends[0].y);
            let turn = last.replace((x, y)).map_or(0.0, |(a, b)| (a * y - b * x).atan2(a * x + b * y));
            sum + turn.abs().to_degrees()
        })
    }
}

/// Adds the waypoints after the start of the path that a search found, told from the goal back by its nodes. A waypoint stands where the direction changes.
pub(crate) fn extend_back<P: Placement, N: ParentPointer>(
    graph: &GridGraph<P>,
    nodes: &NodeStore<N>,
    start: VertexId,
    goal: VertexId,
    waypoints: &mut Vec<Vertex>,
) {
    let first = waypoints.len();
    waypoints.extend(LegsBack::new(graph, nodes, start, goal).turns());
    waypoints[first..].reverse();
}

/// The straight legs of a path, from the goal back to the start: where each ends, and its move.
struct LegsBack<'s, P: Placement, N> {
    graph: &'s GridGraph<P>,
    nodes: &'s NodeStore<N>,
    start: VertexId,
    node: (VertexId, Vertex),
    corner: Option<(Vertex, Vector)>,
}

impl<'s, P: Placement, N: ParentPointer> LegsBack<'s, P, N> {
    fn new(graph: &'s GridGraph<P>, nodes: &'s NodeStore<N>, start: VertexId, goal: VertexId) -> Self {
        Self { graph, nodes, start, node: (goal, graph.vertex(goal)), corner: None }
    }

    /// Where the legs end after which the direction changes.
    fn turns(self) -> impl Iterator<Item = Vertex> {
        let mut last = None;
        self.filter(move |&(_, v)| last.replace(v) != Some(v)).map(|(end, _)| end)
    }
}

impl<P: Placement, N: ParentPointer> Iterator for LegsBack<'_, P, N> {
    type Item = (Vertex, Vector);

    fn next(&mut self) -> Option<Self::Item> {
        if let Some(leg) = self.corner.take() {
            return Some(leg);
        }
        let (id, at) = self.node;
        let node = self.nodes.get(id).filter(|_| id != self.start)?;
        let step = self.graph.step(node.arrived_by());
        self.node = node.pointer.parent(self.graph, step, id, at);
        let (from, v) = (self.node.1, step.vector());
        let d = from.to(at);
        if i64::from(d.x) * i64::from(v.y) != i64::from(d.y) * i64::from(v.x) {
            // Two legs in canonical order, the first by the odd move: an intermediate vertex that became no node.
            let [(first, times), _] = decompose(d, self.graph.k())?.canonical();
            let times = times as i32;
            self.corner = Some((from + Vector::new(first.x * times, first.y * times), first));
        }
        Some((at, v))
    }
}

/// The answer to a query.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// A path, as good as the engine's [`Guarantee`] says.
    Found(Path),
    /// There is no path.
    Unreachable,
}

impl Outcome {
    /// The path, if there is one.
    #[must_use]
    pub const fn path(&self) -> Option<&Path> {
        match self {
            Self::Found(path) => Some(path),
            Self::Unreachable => None,
        }
    }
}

/// What an engine promises of the paths that it returns. Every engine finds a path whenever there is one, but for those that say that they
/// [gave up](crate::QueryError::GaveUp).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Guarantee {
    /// No path over N(k) is shorter: in fixed-point costs exactly, in real lengths up to a factor of 1 + 2⁻³¹ (see
    /// [`Cost`](mediant_moves::Cost)).
    Optimal(FiniteK),
    /// No path over N(k) is shorter, in the same sense; the segments of this one run at any angle.
    AtMost(FiniteK),
    /// No legal path at all is shorter.
    OptimalAnyAngle,
    /// None.
    Suboptimal,
}

impl Guarantee {
    /// What a path may cost at most, as a multiple of the any-angle optimum between the same two vertices under the same rules, as far as
    /// that is proven: for N(k) by Kramm 2018, Theorems 2 and 3, see [`bound_at_corners`] and [`bound_at_centers`]. `None` where
    /// nothing is.
    ///
    /// ```
    /// use mediant_grid::{CornerRule, DiagonalGap, Rules};
    /// use mediant_moves::FiniteK;
    /// use mediant_search::Guarantee;
    /// let promised = Guarantee::Optimal(FiniteK::new(3)?);
    /// assert!(promised.bound(Rules::Corner(DiagonalGap::Open)).is_some_and(|bound| (bound - 1.0824).abs() < 1e-4));
    /// assert_eq!(promised.bound(Rules::Center(CornerRule::Always)), None);
    /// # Ok::<(), mediant_moves::KError>(())
    /// ```
    #[must_use]
    pub fn bound(self, rules: Rules) -> Option<f64> {
        match (self, rules) {
            (Self::OptimalAnyAngle, _) => Some(1.0),
            (Self::Suboptimal, _) | (_, Rules::Center(CornerRule::Always)) => None,
            (Self::Optimal(k) | Self::AtMost(k), Rules::Corner(_)) => Some(bound_at_corners(k)),
            (Self::Optimal(k) | Self::AtMost(k), Rules::Center(CornerRule::One)) => Some(bound_at_centers(k)),
            (_, Rules::Center(CornerRule::Never)) => Some(BOUND_WITHOUT_CORNER_CUTTING),
        }
    }

    /// The guarantee of the same paths once they are smoothed.
    #[must_use]
    pub const fn smoothed(self) -> Self {
        match self {
            Self::Optimal(k) => Self::AtMost(k),
            Self::AtMost(_) | Self::OptimalAnyAngle | Self::Suboptimal => self,
        }
    }

    /// What every path between two vertices costs at least, given that one with this guarantee costs `cost` and that the straight line
    /// between them measures `straight`: the larger of that and `cost` over the [bound](Self::bound). All in cells, and up to the
    /// rounding that the guarantee allows.
    #[must_use]
    pub fn lower_bound(self, rules: Rules, cost: f64, straight: f64) -> f64 {
        self.bound(rules).map_or(straight, |bound| straight.max(cost / bound))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(waypoints: &[(i32, i32)], degrees: f64) {
        let path = Path::new(waypoints.iter().map(|&at| at.into()).collect());
        let back = Path::new(waypoints.iter().rev().map(|&at| at.into()).collect());
        for found in [path.smoothness(), back.smoothness()] {
            assert!((found - degrees).abs() <= 1e-12 * degrees, "{found}° of {waypoints:?}");
            assert!(found.is_sign_positive());
        }
    }

    #[test]
    fn smoothness_adds_up_the_turns() {
        check(&[], 0.0);
        check(&[(4, 4)], 0.0);
        check(&[(4, 4), (9, 5)], 0.0);
        // A right angle, to either side and however long the segments are.
        check(&[(0, 0), (5, 0), (5, 1)], 90.0);
        check(&[(0, 0), (1, 0), (1, -7)], 90.0);
        check(&[(0, 0), (2, 1), (1, 3)], 90.0);
        check(&[(0, 0), (5, 0), (7, 2)], 45.0);
        check(&[(0, 0), (5, 0), (4, 1)], 135.0);
        // There and back.
        check(&[(0, 0), (5, 2), (0, 0)], 180.0);
        // Waypoints on a straight line, or twice on the same place, turn nothing.
        check(&[(0, 0), (2, 1), (4, 2), (10, 5)], 0.0);
        check(&[(0, 0), (5, 0), (5, 0), (5, 1), (5, 4)], 90.0);
        check(&[(3, 3), (3, 3)], 0.0);
        // Turns do not cancel: around a square.
        check(&[(0, 0), (4, 0), (4, 4), (0, 4), (0, 0)], 270.0);
        check(&[(0, 0), (1, 0), (1, 1), (2, 1), (2, 2)], 270.0);
        check(&[(0, 0), (1, 0), (3, 1)], 1.0_f64.atan2(2.0).to_degrees());
        // The ends of the coordinates.
        check(&[(i32::MIN, 0), (i32::MAX, 0), (i32::MAX, i32::MIN)], 90.0);
    }
}
