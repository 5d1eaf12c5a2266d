//! The oracle's knowledge of a map.

use std::{
    cell::{OnceCell, RefCell},
    collections::BTreeMap,
};

use mediant::{Guarantee, K, Path, Point, Setup, Vertex};
use mediant_grid::{DiagonalGap, Grid, PlacementKind, Rectangle, Rules};
use mediant_moves::CostTable;
use mediant_oracle::{Explicit, PointVisibility, validate, validate_between_points, vertex_is_free};

/// Costs are equal if they differ by less than this part of themselves: sums of rounded lengths.
pub(super) const ROOM: f64 = 1e-7;

/// A map, and what the oracle knows of it once it is asked.
pub(super) struct Known {
    grid: Grid,
    setup: Setup,
    of_k: OnceCell<Explicit>,
    of_any: OnceCell<Explicit>,
    /// The costs of all paths from a start, over one of the two.
    from: RefCell<BTreeMap<(bool, i32, i32), BTreeMap<(i32, i32), f64>>>,
}

/// The map with some cells changed.
pub(super) fn edited(grid: &Grid, cells: &[(Vertex, bool)]) -> Grid {
    cells.iter().fold(grid.clone(), |grid, &(cell, blocked)| {
        grid.with_rectangle(Rectangle::new(cell.x as u32, cell.y as u32, 1, 1), |_, _| blocked)
    })
}

/// The oracle's coordinates of a point between centers: those of corners.
fn parts(point: Point) -> (i64, i64) {
    point.at_corners().parts()
}

impl Known {
    pub(super) const fn new(grid: Grid, setup: Setup) -> Self {
        Self {
            grid,
            setup,
            of_k: OnceCell::new(),
            of_any: OnceCell::new(),
            from: RefCell::new(BTreeMap::new()),
        }
    }

    pub(super) const fn grid(&self) -> &Grid {
        &self.grid
    }

    fn rules(&self) -> Rules {
        self.setup.rules()
    }

    fn over(&self, k: K, from: Vertex, to: Vertex) -> Option<f64> {
        let is_any = k == K::Any;
        let mut known = self.from.borrow_mut();
        let costs = known.entry((is_any, from.x, from.y)).or_insert_with(|| {
            if let Rules::CenterGap(gap) = self.rules() {
                return self.between_centers(gap, from);
            }
            let cell = if is_any { &self.of_any } else { &self.of_k };
            let graph = cell.get_or_init(|| Explicit::new(&self.grid, self.rules(), k.finite()));
            let costs = graph.costs_from(from);
            graph.free_vertices().filter_map(|at| Some(((at.x, at.y), costs.to(at)?))).collect()
        });
        costs.get(&(to.x, to.y)).copied()
    }

    /// The costs from the center of a cell to all others.
    fn between_centers(&self, gap: DiagonalGap, from: Vertex) -> BTreeMap<(i32, i32), f64> {
        let visibility = PointVisibility::new(&self.grid, gap);
        let costs = visibility.costs_from(parts(from.into()));
        let to = |at: Vertex| Some(((at.x, at.y), costs.to(parts(at.into()))?));
        self.free().into_iter().filter_map(to).collect()
    }

    /// The least cost over the motion's own N(k).
    pub(super) fn cost(&self, from: Vertex, to: Vertex) -> Option<f64> {
        self.over(self.setup.k(), from, to)
    }

    /// The least cost of the paths that the engine finds.
    fn least(&self, from: Vertex, to: Vertex) -> Option<f64> {
        self.over(self.setup.paths(), from, to)
    }

    /// The least cost of the paths that the engine finds between some of these ends.
    pub(super) fn best(&self, pairs: &[(Vertex, Vertex)]) -> Option<f64> {
        pairs.iter().filter_map(|&(from, to)| self.least(from, to)).min_by(f64::total_cmp)
    }

    /// The least cost between two points, in parts of a cell, between corners.
    pub(super) fn between_points(&self, from: (i64, i64), to: (i64, i64)) -> Option<f64> {
        let (Rules::Corner(gap) | Rules::CenterGap(gap)) = self.rules() else { return None };
        PointVisibility::new(&self.grid, gap).cost(from, to)
    }

    /// The columns and rows of vertices.
    pub(super) fn size(&self) -> (i32, i32) {
        let more = i32::from(self.rules().placement() == PlacementKind::Corner);
        (self.grid.width() as i32 + more, self.grid.height() as i32 + more)
    }

    pub(super) fn is_free(&self, at: Vertex) -> bool {
        vertex_is_free(&self.grid, self.rules().placement(), at)
    }

    /// All free vertices, row by row.
    pub(super) fn free(&self) -> Vec<Vertex> {
        let (width, height) = self.size();
        let all = (0..height).flat_map(|y| (0..width).map(move |x| Vertex::new(x, y)));
        all.filter(|&at| self.is_free(at)).collect()
    }

    /// The distance on an empty map, by which a vertex is near; comparable, not in cells.
    pub(super) fn distance(&self, from: Vertex, to: Point) -> u64 {
        if let (Some(k), Some(to)) = (self.setup.k().finite(), to.vertex()) {
            return CostTable::new(k).expect("a small k").distance(from.to(to)).to_bits();
        }
        let ((x, y), (column, row)) = (Point::from(from).parts(), to.parts());
        (x - column).unsigned_abs().pow(2) + (y - row).unsigned_abs().pow(2)
    }

    /// The place on the map that is nearest to a vertex along each axis: between centers at any angle points
    /// are on it up to its edges.
    pub(super) fn clamped(&self, at: Vertex) -> Point {
        let (width, height) = self.size();
        let margin = if let Rules::CenterGap(_) = self.rules() { Point::PARTS / 2 } else { 0 };
        let clamp = |at: i32, count: i32| {
            (i64::from(at) * Point::PARTS).clamp(-margin, i64::from(count - 1) * Point::PARTS + margin)
        };
        Point::from_parts(clamp(at.x, width), clamp(at.y, height))
    }

    /// Whether a path is legal from its first to its last waypoint.
    pub(super) fn holds(&self, path: &Path) -> bool {
        if let Rules::CenterGap(gap) = self.rules() {
            let points: Vec<_> = path.points().map(parts).collect();
            let ([start, .., goal] | [start @ goal]) = *points else { return true };
            return validate_between_points(&self.grid, gap, start, goal, &points, path.cost()).is_ok();
        }
        let waypoints = path.waypoints();
        let (Some(&start), Some(&goal)) = (waypoints.first(), waypoints.last()) else { return true };
        let k = self.setup.paths().finite();
        validate(&self.grid, self.rules(), k, start, goal, waypoints, path.cost()).is_ok()
    }

    /// Whether a cost can be that of an answer between these ends: the least, or not below it.
    pub(super) fn fits(&self, guarantee: Guarantee, cost: f64, pairs: &[(Vertex, Vertex)]) -> bool {
        let best = |cost: &dyn Fn(Vertex, Vertex) -> Option<f64>| {
            pairs.iter().filter_map(|&(from, to)| cost(from, to)).min_by(f64::total_cmp)
        };
        // Another engine than the own one may have answered, over N(k).
        let paths = if let Guarantee::Optimal(k) = guarantee { K::Finite(k) } else { self.setup.paths() };
        let Some(least) = best(&|from, to| self.over(paths, from, to)) else { return false };
        let is_not_below = cost >= least * (1.0 - ROOM);
        match guarantee {
            Guarantee::Optimal(_) | Guarantee::OptimalAnyAngle => {
                is_not_below && cost <= least * (1.0 + ROOM)
            }
            Guarantee::AtMost(_) => {
                let most = best(&|from, to| self.cost(from, to));
                is_not_below && most.is_none_or(|most| cost <= most * (1.0 + ROOM))
            }
            _ => is_not_below,
        }
    }
}
