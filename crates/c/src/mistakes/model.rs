//! Objects by slow definitions: those of the oracle.

use std::{
    cell::{OnceCell, RefCell},
    collections::HashMap,
    rc::Rc,
    sync::Arc,
};

use library::{
    DiagonalGap, Guarantee, K, Motion, PlacementKind, Rules, Setup, Vertex, grid::Grid, moves::FiniteK,
};
use mediant_oracle::{
    Explicit, PointKind, PointVisibility, Rng, WeightedGraph, WeightedMap, point_is_free, random_free_point,
    random_free_vertex, random_point, random_vertex, segment_between_points_is_legal, validate,
    validate_between_points, vertex_is_free,
};

use super::watchers::Caller;
use crate::{code::Code, points::Point};

/// The end of a path that a point is for, or another argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    Start,
    Goal,
    Other,
}

/// A map: its cells, row by row.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MapModel {
    pub(super) size: (u32, u32),
    pub(super) blocked: Vec<bool>,
    pub(super) costs: Option<Vec<f64>>,
}

impl MapModel {
    pub(super) fn index(&self, x: i64, y: i64) -> Option<usize> {
        let is_inside = |at: i64, side: u32| at >= 0 && at < i64::from(side);
        (is_inside(x, self.size.0) && is_inside(y, self.size.1))
            .then(|| y as usize * self.size.0 as usize + x as usize)
    }

    /// All outside is blocked.
    pub(super) fn is_blocked(&self, x: i64, y: i64) -> bool {
        self.index(x, y).is_none_or(|at| self.blocked[at])
    }

    pub(super) fn grid(&self) -> Grid {
        let (width, height) = self.size;
        Grid::from_fn(width, height, |x, y| self.is_blocked(x.into(), y.into())).expect("a small map")
    }
}

/// A space: a map, and rules of motion.
pub(super) struct SpaceModel {
    pub(super) map: Rc<MapModel>,
    pub(super) motion: Motion,
    pub(super) grid: Grid,
    /// Points that most calls ask for, so that the costs between them are found once.
    pub(super) popular: Vec<Point>,
    explicit: OnceCell<Explicit>,
    weighted: OnceCell<WeightedGraph>,
    known: RefCell<HashMap<[library::Point; 2], Option<f64>>>,
}

/// The sides of maps are so short that a slow reference answers at once.
pub(super) const LONGEST: u32 = 9;

impl SpaceModel {
    pub(super) fn new(map: Rc<MapModel>, motion: Motion, rng: &mut Rng) -> Self {
        let grid = map.grid();
        let mut popular = Vec::new();
        for _ in 0..7 {
            let is_free = rng.chance(93);
            let at = if motion.k == K::Any {
                let kind = *rng.pick(&PointKind::ALL).expect("some");
                let any = random_point(rng, &grid, kind);
                let free = if is_free { random_free_point(rng, &grid) } else { None };
                let at = free.unwrap_or(any);
                let corner = library::Point::from_parts(at.0, at.1);
                if motion.rules.placement() == PlacementKind::Center { corner.at_centers() } else { corner }
            } else {
                let placement = motion.rules.placement();
                let any = random_vertex(rng, &grid, placement);
                let free = if is_free { random_free_vertex(rng, &grid, placement) } else { None };
                free.unwrap_or(any).into()
            };
            popular.push(Point::from(at));
        }
        let (explicit, weighted, known) = (OnceCell::new(), OnceCell::new(), RefCell::default());
        Self { map, motion, grid, popular, explicit, weighted, known }
    }

    /// A space whose map has other cells, for one query.
    pub(super) fn with_cells(&self, map: MapModel) -> Self {
        let mut space = Self::new(Rc::new(map), self.motion, &mut Rng::new(0));
        space.popular.clone_from(&self.popular);
        space
    }

    /// A point in the coordinates of corners, in parts of a cell.
    pub(super) fn parts(&self, at: library::Point) -> (i64, i64) {
        let is_center = self.motion.rules.placement() == PlacementKind::Center;
        if is_center { at.at_corners().parts() } else { at.parts() }
    }

    /// The codes of what is wrong with an end whatever the map is.
    pub(super) fn known_wrong(at: Point, end: End) -> Vec<Code> {
        match library::Point::nearest(at.x, at.y) {
            None => vec![Self::outside(end)],
            Some(_) => Vec::new(),
        }
    }

    const fn outside(end: End) -> Code {
        match end {
            End::Start => Code::StartOutside,
            End::Goal => Code::GoalOutside,
            End::Other => Code::Argument,
        }
    }

    /// The codes of what is wrong with an end.
    pub(super) fn wrong_end(&self, at: Point, end: End) -> Vec<Code> {
        let Some(inner) = library::Point::nearest(at.x, at.y) else { return vec![Self::outside(end)] };
        let blocked = if end == End::Start { Code::StartBlocked } else { Code::GoalBlocked };
        if end == End::Other || self.is_free(inner) {
            return Vec::new();
        }
        if self.map.blocked.iter().all(|&is| is) {
            return vec![blocked, Self::outside(end), Code::Between];
        }
        let (width, height) = (i64::from(self.map.size.0) * 1024, i64::from(self.map.size.1) * 1024);
        if self.motion.k == K::Any {
            let (x, y) = self.parts(inner);
            let is_inside = (0..=width).contains(&x) && (0..=height).contains(&y);
            return vec![if is_inside { blocked } else { Self::outside(end) }];
        }
        match inner.vertex() {
            None => vec![Code::Between, Self::outside(end)],
            Some(at) => {
                let extra = i32::from(self.motion.rules.placement() == PlacementKind::Corner);
                let is_inside = |at: i32, side: u32| (0..side as i32 + extra).contains(&at);
                let is_inside = is_inside(at.x, self.map.size.0) && is_inside(at.y, self.map.size.1);
                vec![if is_inside { blocked } else { Self::outside(end) }]
            }
        }
    }

    /// Whether a path may stand there.
    pub(super) fn is_free(&self, at: library::Point) -> bool {
        if self.motion.k == K::Any {
            return point_is_free(&self.grid, self.parts(at));
        }
        at.vertex().is_some_and(|at| vertex_is_free(&self.grid, self.motion.rules.placement(), at))
    }

    /// Whether the straight line between two points, at any angle, obeys the rules of motion.
    pub(super) fn is_segment(&self, from: library::Point, to: library::Point) -> bool {
        let gap = self.motion.rules.gap().unwrap_or_default();
        let (from, to) = (self.parts(from), self.parts(to));
        let is_free = |at| point_is_free(&self.grid, at);
        is_free(from) && is_free(to) && segment_between_points_is_legal(&self.grid, gap, from, to)
    }

    pub(super) fn finite(&self) -> Option<FiniteK> {
        match self.motion.k {
            K::Finite(k) => Some(k),
            K::Any => None,
        }
    }

    /// The cost of the best path between two free points.
    pub(super) fn cost(&self, from: Point, to: Point) -> Option<f64> {
        let inner = |at: Point| library::Point::nearest(at.x, at.y).filter(|&at| self.is_free(at));
        let (from, to) = (inner(from)?, inner(to)?);
        if let Some(known) = self.known.borrow().get(&[from, to]) {
            return *known;
        }
        // To all that may be asked for next.
        let others = self.popular.iter().map(|&at| inner_of(at)).filter(|&at| self.is_free(at));
        let goals: Vec<_> = others.chain([to]).collect();
        let costs = self.costs(from, &goals);
        let mut known = self.known.borrow_mut();
        known.extend(goals.iter().zip(costs).map(|(&goal, cost)| ([from, goal], cost)));
        known[&[from, to]]
    }

    fn costs(&self, from: library::Point, goals: &[library::Point]) -> Vec<Option<f64>> {
        let Some(k) = self.finite() else {
            let gap = self.motion.rules.gap().unwrap_or_default();
            let oracle = PointVisibility::new(&self.grid, gap);
            let costs = oracle.costs_from(self.parts(from));
            return goals.iter().map(|&goal| costs.to(self.parts(goal))).collect();
        };
        let vertex = |at: library::Point| at.vertex().expect("free");
        if let Some(costs) = &self.map.costs {
            let of = |x: u32, y: u32| costs[(y * self.map.size.0 + x) as usize].max(1.0) as u32;
            let map = || WeightedMap::from_fn(self.map.grid(), of);
            let graph = self.weighted.get_or_init(|| WeightedGraph::new(&map(), self.motion.rules, Some(k)));
            let all = graph.lengths(&[vertex(from)]);
            return goals.iter().map(|&goal| graph.index(vertex(goal)).and_then(|at| all[at])).collect();
        }
        let graph = self.explicit.get_or_init(|| Explicit::new(&self.grid, self.motion.rules, Some(k)));
        let costs = graph.costs_from(vertex(from));
        goals.iter().map(|&goal| costs.to(vertex(goal))).collect()
    }

    /// Checks that points are a path from one to the other of this length, over moves or at any angle.
    pub(super) fn check(&self, points: &[Point], (from, to): (Point, Point), length: f64, over_moves: bool) {
        let case = || format!("{points:?} from {from:?} to {to:?}; {}\n{:?}", self.motion, self.map);
        let inner: Vec<_> = points.iter().map(|&at| inner_of(at)).collect();
        let (from, to) = (inner_of(from), inner_of(to));
        if self.motion.k == K::Any {
            let gap = self.motion.rules.gap().unwrap_or(DiagonalGap::Closed);
            let waypoints: Vec<_> = inner.iter().map(|&at| self.parts(at)).collect();
            let (from, to) = (self.parts(from), self.parts(to));
            let result = validate_between_points(&self.grid, gap, from, to, &waypoints, length);
            assert!(result.is_ok(), "{result:?}: {}", case());
            return;
        }
        let vertex =
            |at: library::Point| at.vertex().unwrap_or_else(|| panic!("between vertices: {}", case()));
        let waypoints: Vec<Vertex> = inner.iter().map(|&at| vertex(at)).collect();
        let k = self.finite().filter(|_| over_moves);
        let (from, to) = (vertex(from), vertex(to));
        let result = validate(&self.grid, self.motion.rules, k, from, to, &waypoints, length);
        assert!(result.is_ok(), "{result:?}: {}", case());
    }

    /// The rules of what has no corners to cut.
    pub(super) const fn rules(&self) -> Rules {
        self.motion.rules
    }
}

/// The library's point.
pub(super) fn inner_of(at: Point) -> library::Point {
    library::Point::nearest(at.x, at.y).expect("a point of a path")
}

/// Whether two lengths are the same but for rounding.
pub(super) fn is_near(found: f64, expected: f64) -> bool {
    found == expected || (found - expected).abs() <= 1e-8 * expected.abs().max(1.0)
}

/// The length of a path.
pub(super) fn length(points: &[Point]) -> f64 {
    points.windows(2).map(|pair| (pair[0].x - pair[1].x).hypot(pair[0].y - pair[1].y)).sum()
}

/// An index.
pub(super) struct IndexModel {
    pub(super) space: Rc<SpaceModel>,
    pub(super) setup: Setup,
}

impl IndexModel {
    /// Whether its paths are those that cost least.
    pub(super) fn is_exact(&self) -> bool {
        matches!(
            self.setup.guarantee(),
            Guarantee::Optimal(_) | Guarantee::Cheapest(_) | Guarantee::OptimalAnyAngle
        )
    }

    /// Whether it may find a path where moves lead nowhere: Theta* cuts corners by which k = 2 has no move.
    pub(super) fn is_beyond_moves(&self) -> bool {
        !self.is_exact() && self.space.motion == Motion::new(2, Rules::Center(library::CornerRule::Always))
    }

    /// Codes of queries that may find no path.
    pub(super) fn maybe(&self) -> &'static [Code] {
        if self.is_exact() { &[] } else { &[Code::GaveUp] }
    }

    /// Checks the cost of a path that was found between free points, in another space or its own.
    pub(super) fn check_cost(&self, space: &SpaceModel, ends: (Point, Point), cost: f64) {
        let expected = space.cost(ends.0, ends.1).unwrap_or(f64::INFINITY);
        if expected.is_infinite() && self.is_beyond_moves() {
            return;
        }
        let is_right = match self.setup.guarantee() {
            _ if self.is_exact() => is_near(cost, expected),
            Guarantee::AtMost(_) | Guarantee::AtMostCheapest(_) => {
                cost.is_infinite() == expected.is_infinite() && (cost <= expected || is_near(cost, expected))
            }
            _ => cost.is_infinite() == expected.is_infinite(),
        };
        assert!(is_right, "{cost}, not {expected}, {ends:?} by {}\n{:?}", self.setup, space.map);
    }

    /// Checks a path that was found between free points.
    pub(super) fn check_path(&self, space: &SpaceModel, ends: (Point, Point), points: &[Point], cost: f64) {
        self.check_cost(space, ends, cost);
        assert_eq!(points.is_empty(), cost.is_infinite(), "{points:?} of {cost}");
        if !points.is_empty() {
            let told = if space.map.costs.is_some() { length(points) } else { cost };
            space.check(points, ends, told, self.is_exact());
        }
    }
}

/// A planner.
pub(super) struct PlannerModel {
    pub(super) index: Rc<IndexModel>,
    /// The points of its last path.
    pub(super) points: Vec<Point>,
    /// The ends of the search that was begun, and what its answer may be.
    pub(super) begun: Option<Begun>,
    /// Whether it may have forgotten that search.
    pub(super) is_lost: bool,
    /// The watchers of the search that was begun.
    pub(super) callers: Vec<Arc<Caller>>,
}

/// A search that was begun.
#[derive(Clone, Debug)]
pub(super) struct Begun {
    pub(super) starts: Vec<Point>,
    pub(super) goals: Vec<Point>,
    pub(super) wish: super::queries::Wish,
    pub(super) can_stop: bool,
}

pub(super) struct GoalsModel {
    pub(super) space: Rc<SpaceModel>,
    pub(super) goals: Vec<Point>,
}

pub(super) struct FieldModel {
    pub(super) space: Rc<SpaceModel>,
    pub(super) sources: Vec<Point>,
    pub(super) limit: f64,
}

pub(super) struct BytesModel {
    pub(super) index: Rc<IndexModel>,
}
