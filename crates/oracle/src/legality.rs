//! The rules of motion by brute force: every cell around a segment is clipped against it, in exact fractions.

use std::collections::BTreeMap;

use mediant_grid::{CornerRule, DiagonalGap, Grid, PlacementKind, Rules, Vertex};
use mediant_moves::Vector;

use crate::geometry::{Contact, Rectangle, Segment};

/// The cells, edges and vertices that a segment with a given displacement meets, relative to its first
/// vertex.
///
/// Legality depends on nothing else of a map, so the footprint of a move can be used at every vertex.
#[derive(Clone, Debug, Default)]
pub(crate) struct Footprint {
    /// Center: the cells that the segment meets in more than a corner of cells. Corner: the cells whose open
    /// interior it meets.
    crossed: Vec<Vector>,
    /// Center only: for each corner of cells on the way, the cells that the segment meets in this point
    /// alone.
    touched: Vec<Vec<Vector>>,
    /// Corner only: the two cells beside each edge along which the segment runs.
    edges: Vec<[Vector; 2]>,
    /// Corner only: the vertices strictly between the ends.
    between: Vec<Vector>,
}

impl Footprint {
    /// The footprint of displacement `d` ≠ (0, 0). Time is proportional to |x|·|y|.
    pub(crate) fn new(placement: PlacementKind, d: Vector) -> Self {
        match placement {
            PlacementKind::Center => Self::at_centers(d),
            PlacementKind::Corner => Self::at_corners(d),
        }
    }

    fn at_centers(d: Vector) -> Self {
        let segment = Segment { from: [1, 1], by: doubled(d) };
        let mut footprint = Self::default();
        let mut touched: BTreeMap<[i128; 2], Vec<Vector>> = BTreeMap::new();
        for cell in box_and_ring(d) {
            match segment.contact(&square(cell)) {
                Contact::Nothing => {}
                Contact::Point(t) => match segment.corner_at(t) {
                    Some(corner) => touched.entry(corner).or_default().push(cell),
                    None => footprint.crossed.push(cell),
                },
                Contact::Rim | Contact::Inside => footprint.crossed.push(cell),
            }
        }
        footprint.touched = touched.into_values().collect();
        footprint
    }

    fn at_corners(d: Vector) -> Self {
        let segment = Segment { from: [0, 0], by: doubled(d) };
        let mut footprint = Self::default();
        for cell in box_and_ring(d) {
            if segment.contact(&square(cell)) == Contact::Inside {
                footprint.crossed.push(cell);
            }
            for other in [cell + Vector::new(1, 0), cell + Vector::new(0, 1)] {
                if segment.contact(&shared_edge(cell, other)) == Contact::Rim {
                    footprint.edges.push([cell, other]);
                }
            }
            let corner = Rectangle { low: doubled(cell), high: doubled(cell) };
            if matches!(segment.contact(&corner), Contact::Point(t) if segment.corner_at(t).is_some()) {
                footprint.between.push(cell);
            }
        }
        footprint
    }

    /// Whether the segment that starts at `at` is legal, both its ends being vertices of the map.
    pub(crate) fn is_legal(&self, grid: &Grid, rules: Rules, at: Vertex) -> bool {
        let free = |cell: &Vector| grid.is_free(at.x + cell.x, at.y + cell.y);
        let corners = match rules {
            Rules::Center(CornerRule::Never) => self.touched.iter().flatten().all(free),
            Rules::Center(CornerRule::One) => self.touched.iter().all(|cells| cells.iter().any(free)),
            Rules::Center(CornerRule::Always) => true,
            Rules::Corner(DiagonalGap::Open) => true,
            // No move has them: paths bend at corners then.
            Rules::CenterGap(_) => false,
            Rules::Corner(DiagonalGap::Closed) => {
                !self.between.iter().any(|&vertex| is_gap(grid, at + vertex))
            }
        };
        corners && self.crossed.iter().all(free) && self.edges.iter().all(|cells| cells.iter().any(free))
    }
}

/// In half cells.
fn doubled(d: Vector) -> [i64; 2] {
    [2 * i64::from(d.x), 2 * i64::from(d.y)]
}

/// A cell as a closed square, in half cells.
fn square(cell: Vector) -> Rectangle {
    let low = doubled(cell);
    Rectangle { low, high: low.map(|coordinate| coordinate + 2) }
}

/// The closed edge between two cells side by side.
fn shared_edge(cell: Vector, other: Vector) -> Rectangle {
    Rectangle { low: doubled(other), high: square(cell).high }
}

/// All cells between (0, 0) and d, and a ring of cells around those.
fn box_and_ring(d: Vector) -> impl Iterator<Item = Vector> {
    let range = |n: i32| n.min(0) - 1..=n.max(0) + 1;
    range(d.y).flat_map(move |y| range(d.x).map(move |x| Vector::new(x, y)))
}

/// Whether a cell is blocked, at coordinates that may exceed those of a map.
pub(crate) fn is_blocked(grid: &Grid, x: i64, y: i64) -> bool {
    match (i32::try_from(x), i32::try_from(y)) {
        (Ok(x), Ok(y)) => grid.is_blocked(x, y),
        _ => true,
    }
}

/// Whether the cell in the quadrant with signs (`sx`, `sy`) of a corner vertex is blocked.
fn quadrant_is_blocked(grid: &Grid, at: Vertex, (sx, sy): (i64, i64)) -> bool {
    is_blocked(grid, i64::from(at.x) + sx.min(0), i64::from(at.y) + sy.min(0))
}

/// The signs of the four quadrants of a corner vertex; (1, 1) is that of its own cell.
const QUADRANTS: [(i64, i64); 4] = [(1, 1), (-1, 1), (-1, -1), (1, -1)];

/// The free quadrants of a corner vertex, as signs of x and y.
pub(crate) fn free_quadrants(grid: &Grid, at: Vertex) -> impl Iterator<Item = (i64, i64)> {
    QUADRANTS.into_iter().filter(move |&signs| !quadrant_is_blocked(grid, at, signs))
}

/// Whether the segment from `at` to `other` lies in this closed quadrant of `at`.
pub(crate) fn is_in_quadrant(at: Vertex, other: Vertex, (sx, sy): (i64, i64)) -> bool {
    let (dx, dy) = (i64::from(other.x) - i64::from(at.x), i64::from(other.y) - i64::from(at.y));
    dx * sx >= 0 && dy * sy >= 0
}

/// Whether `at` is a free vertex: at centers a free cell, at corners a vertex with a free cell among its
/// four.
///
/// Vertices outside the map are not free.
#[must_use]
pub fn vertex_is_free(grid: &Grid, placement: PlacementKind, at: Vertex) -> bool {
    match placement {
        PlacementKind::Center => grid.is_free(at.x, at.y),
        PlacementKind::Corner => free_quadrants(grid, at).next().is_some(),
    }
}

/// Whether two blocked cells meet diagonally at corner vertex `at` while the two others are free.
#[must_use]
pub fn is_gap(grid: &Grid, at: Vertex) -> bool {
    let free: Vec<_> = free_quadrants(grid, at).collect();
    matches!(free[..], [(ax, ay), (bx, by)] if ax == -bx && ay == -by)
}

/// Whether the straight segment from `a` to `b`, by itself, is legal under the rules of motion. Where
/// segments meet at a gap, [`turn_is_legal`] decides.
///
/// * Centers: all cells that the closed segment meets must be free, except those that it only meets in a
///   corner of cells. Of the latter, all must be free, or at least one at each corner, or none, depending on
///   the [`CornerRule`].
/// * Corners: the segment may not meet the open interior of a blocked cell, and may not run along the edge
///   between two blocked cells (outside counts as blocked). With closed gaps, no gap may lie strictly between
///   its ends.
///
/// A segment of length 0 is legal at a free vertex. Time is proportional to the area of the bounding box.
#[must_use]
pub fn segment_is_legal(grid: &Grid, rules: Rules, a: Vertex, b: Vertex) -> bool {
    let placement = rules.placement();
    vertex_is_free(grid, placement, a)
        && vertex_is_free(grid, placement, b)
        && (a == b || Footprint::new(placement, a.to(b)).is_legal(grid, rules, a))
}

/// Whether a path under [`DiagonalGap::Closed`] may come from `before` to corner vertex `at` and go on to
/// `after`, given that both segments are legal. `None` stands for the start or end of the path at `at`.
///
/// At a gap a path must stay in one closed free quadrant. A path that starts or ends there must stay in the
/// quadrant of the vertex's own cell (x, y), which must be free. There is no restriction elsewhere, nor for a
/// path that consists of `at` alone.
#[must_use]
pub fn turn_is_legal(grid: &Grid, before: Option<Vertex>, at: Vertex, after: Option<Vertex>) -> bool {
    if !is_gap(grid, at) || (before.is_none() && after.is_none()) {
        return true;
    }
    let is_end = before.is_none() || after.is_none();
    free_quadrants(grid, at).any(|signs| {
        let holds = |other: Option<Vertex>| other.is_none_or(|other| is_in_quadrant(at, other, signs));
        holds(before) && holds(after) && (!is_end || signs == (1, 1))
    })
}
