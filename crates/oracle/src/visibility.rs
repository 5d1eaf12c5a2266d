//! Shortest paths under corner placement for every k, from one visibility graph.
//!
//! **Why one graph is enough for every k.** h_k is a norm: its unit ball is a symmetric polygon. Every norm
//! of the plane is a sum Σ cᵢ·|⟨nᵢ, d⟩|, or a limit of such sums. So the length of a path is a weighted count
//! of how often it crosses the lines with normals nᵢ. A *taut* path bends only around convex corners of
//! obstacles. It crosses each piece of such a line in free space at most once, and then every path that
//! passes the obstacles on the same sides crosses it too. Therefore the taut path is shortest among these
//! paths, in all norms at once. Its straight pieces can be followed over N(k) at cost h_k (Kramm 2018, Lemma
//! 13), and the h_k-length of a path over N(k) is its length. It remains to choose the sides, which
//! Dijkstra's algorithm does.
//!
//! **Closed gaps** are cuts through free space. Seen from either of its free quadrants a gap is concave, so a
//! taut path does not bend there; at most it starts or ends there. This also holds for k = 2. But the path
//! over N(2) that follows a taut path may have to touch a gap: from one corner of a cell to the opposite one,
//! if both other corners are gaps. It bends there within one quadrant, which the rule allows, so its cost is
//! still h_2.

use std::{cmp::Reverse, collections::BinaryHeap, sync::OnceLock};

use mediant_grid::{DiagonalGap, Grid, PlacementKind, Rules, Vertex};
use mediant_moves::{FiniteK, Vector};

use crate::{
    legality::{Footprint, free_quadrants, is_gap, turn_is_legal, vertex_is_free},
    neighborhood,
};

/// The convex corners of the obstacles of a grid, and which of them see each other.
///
/// A vertex is a convex corner if one of its four cells is blocked or, under [`DiagonalGap::Open`], if it is
/// a gap. Two vertices see each other if the segment between them is legal
/// ([`segment_is_legal`](crate::segment_is_legal)). The graph is the same for all k; [`over`](Self::over)
/// adds lengths.
///
/// Meant for maps up to about 40 × 40 or 1,000 × 4: it stores the cells that each requested displacement
/// meets.
#[derive(Clone, Debug)]
pub struct Visibility<'g> {
    sight: Sight<'g>,
    corners: Vec<Vertex>,
    /// For each corner the corners that it sees, by their indices in `corners`.
    seen: Vec<Vec<u32>>,
}

impl<'g> Visibility<'g> {
    /// Tests the segments between all pairs of convex corners.
    #[must_use]
    pub fn new(grid: &'g Grid, gap: DiagonalGap) -> Self {
        let (width, height) = (grid.width() as i32, grid.height() as i32);
        let vertices = (0..=height).flat_map(|y| (0..=width).map(move |x| Vertex::new(x, y)));
        let corners: Vec<Vertex> = vertices.filter(|&at| is_convex(grid, gap, at)).collect();
        let sight = Sight::new(grid, gap);
        let mut seen = vec![Vec::new(); corners.len()];
        for (i, &a) in corners.iter().enumerate() {
            for (j, &b) in corners.iter().enumerate().skip(i + 1) {
                if sight.is_legal(a, b) {
                    seen[i].push(j as u32);
                    seen[j].push(i as u32);
                }
            }
        }
        Self { sight, corners, seen }
    }

    /// The convex corners, row by row.
    #[must_use]
    pub fn corners(&self) -> &[Vertex] {
        &self.corners
    }

    /// Dijkstra's algorithm over the corners, from a start outside the graph. `first` is the length from
    /// there to each corner that it sees, `None` for the others; `length` that of an edge.
    ///
    /// For each corner, the optimal cost, infinite if it is not reached, and the corner before it, `None` if
    /// that is the start.
    pub(crate) fn spread(
        &self,
        first: Vec<Option<f64>>,
        length: impl Fn(Vertex, Vertex) -> f64,
    ) -> (Vec<f64>, Vec<Option<u32>>) {
        let Self { corners, seen, .. } = self;
        let mut costs: Vec<f64> = first.into_iter().map(|cost| cost.unwrap_or(f64::INFINITY)).collect();
        let mut previous = vec![None; corners.len()];
        // Floats that are not negative have the same order as their bits.
        let reached =
            |(i, cost): (usize, &f64)| cost.is_finite().then(|| Reverse((cost.to_bits(), i as u32)));
        let mut open: BinaryHeap<_> = costs.iter().enumerate().filter_map(reached).collect();
        while let Some(Reverse((bits, from))) = open.pop() {
            let cost = f64::from_bits(bits);
            if cost > costs[from as usize] {
                continue;
            }
            for &to in &seen[from as usize] {
                let next = cost + length(corners[from as usize], corners[to as usize]);
                if next < costs[to as usize] {
                    costs[to as usize] = next;
                    previous[to as usize] = Some(from);
                    open.push(Reverse((next.to_bits(), to)));
                }
            }
        }
        (costs, previous)
    }

    /// The graph with edges of length h_k or, for k = `None`, of Euclidean length.
    #[must_use]
    pub fn over(&self, k: Option<FiniteK>) -> VisibilityGraph<'_> {
        let grid = self.sight.grid;
        let (width, height) = (grid.width() as i32, grid.height() as i32);
        VisibilityGraph { visibility: self, columns: width as usize + 1, lengths: lengths(k, width, height) }
    }
}

/// Whether a vertex is a convex corner: an optimal path may bend there.
fn is_convex(grid: &Grid, gap: DiagonalGap, at: Vertex) -> bool {
    free_quadrants(grid, at).count() == 3 || (gap == DiagonalGap::Open && is_gap(grid, at))
}

/// Which vertices of a map see each other.
#[derive(Clone, Debug)]
struct Sight<'g> {
    grid: &'g Grid,
    gap: DiagonalGap,
    /// The footprint of each displacement (x, y) of the map with y ≥ 0, row by row, computed when first
    /// needed.
    footprints: Vec<OnceLock<Footprint>>,
}

impl<'g> Sight<'g> {
    fn new(grid: &'g Grid, gap: DiagonalGap) -> Self {
        let displacements = (2 * grid.width() as usize + 1) * (grid.height() as usize + 1);
        Self { grid, gap, footprints: vec![OnceLock::new(); displacements] }
    }

    /// [`segment_is_legal`](crate::segment_is_legal) between two free vertices of the map, with stored
    /// footprints.
    fn is_legal(&self, a: Vertex, b: Vertex) -> bool {
        let (a, b) = if a.y <= b.y { (a, b) } else { (b, a) };
        let (d, width) = (a.to(b), self.grid.width() as i32);
        let place = d.y as usize * (2 * width as usize + 1) + (d.x + width) as usize;
        let footprint = || self.footprints[place].get_or_init(|| Footprint::new(PlacementKind::Corner, d));
        a == b || footprint().is_legal(self.grid, Rules::Corner(self.gap), a)
    }

    /// Whether a path may start or end at `end`, where `other` is the next or the previous vertex.
    fn may_end(&self, end: Vertex, other: Vertex) -> bool {
        self.gap == DiagonalGap::Open || turn_is_legal(self.grid, None, end, Some(other))
    }
}

/// A [`Visibility`] with lengths of edges.
#[derive(Clone, Debug)]
pub struct VisibilityGraph<'v> {
    visibility: &'v Visibility<'v>,
    /// The number of columns of vertices.
    columns: usize,
    /// The length of each displacement (x, y) of the map with x, y ≥ 0, row by row.
    lengths: Vec<f64>,
}

impl VisibilityGraph<'_> {
    /// The optimal costs from `start` to every corner, and thereby to every vertex. If `start` is blocked or
    /// outside the map, no vertex is reached.
    #[must_use]
    pub fn costs_from(&self, start: Vertex) -> VisibilityCosts<'_> {
        let Visibility { sight, corners, .. } = self.visibility;
        let is_free = vertex_is_free(sight.grid, PlacementKind::Corner, start);
        let first = |&corner: &Vertex| {
            let is_seen = is_free && sight.may_end(start, corner) && sight.is_legal(start, corner);
            is_seen.then(|| self.length(start, corner))
        };
        let first = corners.iter().map(first).collect();
        let (cost, previous) = self.visibility.spread(first, |a, b| self.length(a, b));
        VisibilityCosts { graph: self, start, cost, previous }
    }

    /// The length of the straight segment between two vertices of the map.
    fn length(&self, a: Vertex, b: Vertex) -> f64 {
        let d = a.to(b);
        self.lengths[d.y.unsigned_abs() as usize * self.columns + d.x.unsigned_abs() as usize]
    }
}

/// The optimal costs from one start, over the convex corners.
#[derive(Clone, Debug)]
pub struct VisibilityCosts<'a> {
    graph: &'a VisibilityGraph<'a>,
    start: Vertex,
    /// The cost of each corner.
    cost: Vec<f64>,
    /// For each corner the corner before it; `None` if that is the start.
    previous: Vec<Option<u32>>,
}

impl VisibilityCosts<'_> {
    /// The cost of an optimal path to `goal`, 0 for the start itself; `None` if there is no path, or if start
    /// or goal is blocked or outside the map.
    #[must_use]
    pub fn to(&self, goal: Vertex) -> Option<f64> {
        self.last_step(goal).map(|(cost, _)| cost)
    }

    /// The waypoints of an optimal path to `goal`, each in sight of the next. Over N(k) there is a shortest
    /// path from one to the next along the segment between them. `None` as for [`to`](Self::to).
    #[must_use]
    pub fn path_to(&self, goal: Vertex) -> Option<Vec<Vertex>> {
        let (_, mut last) = self.last_step(goal)?;
        let mut path = vec![goal];
        while let Some(corner) = last {
            path.push(self.graph.visibility.corners[corner as usize]);
            last = self.previous[corner as usize];
        }
        path.push(self.start);
        // Start or goal may be a corner itself.
        path.dedup();
        path.reverse();
        Some(path)
    }

    /// The cost to `goal`, and the corner from which it is reached; `None` for the corner if it is reached
    /// straight from the start.
    fn last_step(&self, goal: Vertex) -> Option<(f64, Option<u32>)> {
        let Visibility { sight, corners, .. } = self.graph.visibility;
        let is_free = |at| vertex_is_free(sight.grid, PlacementKind::Corner, at);
        if !is_free(self.start) || !is_free(goal) {
            return None;
        }
        let is_straight = self.start == goal
            || (sight.may_end(self.start, goal)
                && sight.may_end(goal, self.start)
                && sight.is_legal(self.start, goal));
        let mut best = is_straight.then(|| (self.graph.length(self.start, goal), None));
        for (i, &corner) in corners.iter().enumerate() {
            let cost = self.cost[i] + self.graph.length(corner, goal);
            let is_less = cost < best.map_or(f64::INFINITY, |(cost, _)| cost);
            if is_less && sight.may_end(goal, corner) && sight.is_legal(corner, goal) {
                best = Some((cost, Some(i as u32)));
            }
        }
        best
    }
}

/// h_k of each displacement (x, y) with 0 ≤ x ≤ `width` and 0 ≤ y ≤ `height`, both at least 1, row by row.
///
/// From the definition: d = p·a + q·b with p, q ≥ 0 for two moves a, b that are adjacent in angle, and its
/// length is p·|a| + q·|b|. Moves beyond the rectangle are not needed for displacements in it.
fn lengths(k: Option<FiniteK>, width: i32, height: i32) -> Vec<f64> {
    let displacements = || (0..=height).flat_map(|y| (0..=width).map(move |x| Vector::new(x, y)));
    if k.is_none() {
        return displacements().map(norm).collect();
    }
    let mut moves = neighborhood(k, width as u32, height as u32);
    moves.retain(|u| u.x >= 0 && u.y >= 0);
    moves.sort_by(|&u, &v| 0.cmp(&det(u, v)));
    let length = |d: Vector| {
        let mut pairs = moves.windows(2).map(|pair| (pair[0], pair[1]));
        let (a, b) = pairs.find(|&(a, b)| det(a, d) >= 0 && det(d, b) >= 0).expect("d is in the quadrant");
        let (p, q) = (det(d, b) / det(a, b), det(a, d) / det(a, b));
        debug_assert_eq!(a * p as i32 + b * q as i32, d, "p and q are whole numbers");
        p as f64 * norm(a) + q as f64 * norm(b)
    };
    displacements().map(length).collect()
}

/// Positive if v comes after u in the order of angles from (1, 0) to (0, 1).
fn det(u: Vector, v: Vector) -> i64 {
    i64::from(u.x) * i64::from(v.y) - i64::from(u.y) * i64::from(v.x)
}

fn norm(d: Vector) -> f64 {
    f64::from(d.x).hypot(f64::from(d.y))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Rng, describe, random_free_vertex, segment_is_legal, suite_grid};

    #[test]
    fn sight_is_legality() {
        let (mut legal, mut illegal) = (0, 0);
        for seed in 0..300 {
            let grid = suite_grid(seed).0;
            let mut rng = Rng::new(seed ^ 0x5EED);
            for gap in [DiagonalGap::Open, DiagonalGap::Closed] {
                let (rules, sight) = (Rules::Corner(gap), Sight::new(&grid, gap));
                for _ in 0..20 {
                    let mut free = || random_free_vertex(&mut rng, &grid, PlacementKind::Corner);
                    let Some((a, b)) = free().zip(free()) else { continue };
                    let expected = segment_is_legal(&grid, rules, a, b);
                    // The second and third time, from the stored footprint.
                    for (a, b) in [(a, b), (b, a), (a, b)] {
                        assert_eq!(sight.is_legal(a, b), expected, "{}", describe(&grid, rules, a, b, seed));
                    }
                    *if expected { &mut legal } else { &mut illegal } += 1;
                }
            }
        }
        assert!(legal > 2000 && illegal > 2000, "{legal} legal, {illegal} illegal");
    }

    /// Tries all combinations of all pairs of moves, so that neither adjacency nor the two factors matter.
    #[test]
    fn lengths_are_the_least_over_all_pairs_of_moves() {
        let (width, height) = (9, 6);
        for k in [2, 3, 4, 5, 8] {
            let k = FiniteK::new(k).ok();
            let moves = neighborhood(k, width as u32, height as u32);
            let found = lengths(k, width, height);
            for (place, &found) in found.iter().enumerate() {
                let d = Vector::new(place as i32 % (width + 1), place as i32 / (width + 1));
                let mut least = f64::INFINITY;
                for (&a, p) in moves.iter().flat_map(|a| (0..=width + height).map(move |p| (a, p))) {
                    let rest = d - a * p;
                    for &b in &moves {
                        let q = (0..=width + height).find(|&q| b * q == rest);
                        least = least.min(
                            q.map_or(f64::INFINITY, |q| f64::from(p) * norm(a) + f64::from(q) * norm(b)),
                        );
                    }
                }
                assert!((found - least).abs() <= 1e-12 * least, "k = {k:?}, {d:?}: {found}, not {least}");
            }
        }
        assert_eq!(lengths(None, 4, 3).last(), Some(&5.0));
    }
}
