//! Ends of intervals of a grid line: where rays from a vertex, or from a place between vertices, cross it.

use super::place::Place;

/// A ray from a place of the map, its root, given by the vector from the root to another place on it, in
/// parts of a cell ([`Place`]), or by any other vector of this direction. `dy` > 0 counts away from the
/// root, whether up or down.
///
/// The end of an interval is never kept as a point, but as the ray that bounds it: the vector from the root
/// to the corner at which the interval was clipped or, if a path turned at the root, the vector from the
/// previous root. So it is always the difference of two places of the map, of which one at least is a vertex.
///
/// **No overflow.** With sides of at most 2¹⁵ cells ([`Grid::MAX_SIDE`](crate::Grid::MAX_SIDE)) of 2¹⁰ parts,
/// |dx| ≤ 2²⁵ and 1 ≤ dy ≤ 2²⁵. Products of two such numbers are at most 2⁵⁰: 64 bits hold them, and so does
/// the mantissa of an `f64`. Rays are never added, multiplied or intersected with each other, so numbers do
/// not grow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ray {
    /// To the right.
    pub dx: i32,
    /// Away from the root, at least 1.
    pub dy: i32,
}

impl Ray {
    /// Straight away from the root.
    pub const VERTICAL: Self = Self { dx: 0, dy: 1 };

    /// The ray through a vertex in column `x`, from a root at `root`, `n` away from the vertex's line: both
    /// in parts.
    #[inline]
    #[must_use]
    pub const fn through(x: i32, root: i32, n: i32) -> Self {
        Self { dx: Place::parts(x) - root, dy: n }
    }

    /// The column where the ray crosses a line, `n` parts from a root at `root` parts, rounded to `f64`.
    #[inline]
    #[must_use]
    pub fn column(self, root: i32, n: i32) -> f64 {
        const PART: f64 = 1.0 / Place::parts(1) as f64;
        let aside = f64::from(n) * f64::from(self.dx) / f64::from(self.dy);
        (f64::from(root) + aside) * PART
    }

    /// Whether it leads further to the right than another one from the same root.
    #[inline]
    #[must_use]
    pub const fn is_right_of(self, other: Self) -> bool {
        self.dx as i64 * other.dy as i64 > other.dx as i64 * self.dy as i64
    }
}

/// Where a ray crosses a line, in columns: a fixed-point number with 44 binary places whose floor, ceiling
/// and 'is it a vertex?' are exact.
///
/// One of the two places that a ray is made of is a vertex, so from that vertex on it moves by dx / dy
/// columns a line. Therefore it crosses a line at a rational with denominator at most 2²⁵: either at a
/// vertex, or at least 2⁻²⁵ away from every vertex. A crossing is that rational plus 2⁻²⁷, up or down an
/// error below 2⁻²⁷:
///
/// - *A step* is a quotient s of 53 binary digits, cut off after 44 binary places. n steps are off by n · s ·
///   2⁻⁵³ < 2⁻³⁴, as the ray is on the map or a few lines further, and by n · 2⁻⁴⁴ ≤ 2⁻²⁹.
/// - *Anew*, it is the root's column, exact, and n steps, whole or not, cut off once more.
/// - *Anew along a flat ray*, whose step is cut (below), it is the root's column and n · (dx / dy), the
///   quotient and the product rounded to 53 binary digits: on the map at most 2¹⁵ columns, so off by at most
///   2⁻³⁷.
///
/// Together that is less than 2⁻²⁸. So the fractional part of a crossing is between 0 and 2⁻²⁶ at a vertex,
/// and between 2⁻²⁶ and 1 elsewhere.
///
/// **Flat rays.** From a root 1/1024 beside a line, a ray may move by 2²⁵ columns a line. A step is cut to
/// 2¹⁵ columns: from a place on the map it leads to the map's border or beyond, as the ray does, and on the
/// same side. At the border an interval ends anyway, since all cells beyond are blocked. So crossings stay
/// within 2¹⁵ columns of the map for a step, and within 2¹⁸ for eight at once; their fixed-point values stay
/// below 2⁶³.
#[derive(Clone, Copy, Debug)]
pub struct Crossing(i64);

impl Crossing {
    const FRACTION: u32 = 44;
    const ONE: i64 = 1 << Self::FRACTION;
    const BIAS: i64 = Self::ONE >> 27;
    const VERTEX: i64 = Self::ONE >> 26;

    /// The crossing at a vertex in column x.
    #[inline]
    pub const fn vertex(x: i32) -> Self {
        Self(((x as i64) << Self::FRACTION) + Self::BIAS)
    }

    /// The nearest column of vertices at or to the left of it.
    #[inline]
    pub const fn floor(self) -> i32 {
        (self.0 >> Self::FRACTION) as i32
    }

    /// The nearest column of vertices at or to the right of it.
    #[inline]
    pub const fn ceil(self) -> i32 {
        ((self.0 + (Self::ONE - Self::VERTEX)) >> Self::FRACTION) as i32
    }

    /// The column of cells that holds it, or that ends at it.
    #[inline]
    pub const fn cell_before(self) -> i32 {
        ((self.0 - Self::VERTEX) >> Self::FRACTION) as i32
    }

    /// Whether it is left of another by more than 2⁻²⁶ columns, and so its floor below the other's ceiling.
    #[inline]
    pub const fn is_left_of(self, other: Self) -> bool {
        self.0 + Self::VERTEX < other.0
    }

    /// Whether it is at a vertex.
    #[inline]
    pub const fn is_vertex(self) -> bool {
        self.0 & (Self::ONE - 1) < Self::VERTEX
    }
}

/// An end of an interval, followed from line to line by additions.
#[derive(Clone, Copy, Debug)]
pub struct IntervalEnd {
    /// The ray that bounds the interval.
    pub ray: Ray,
    /// Where the ray crosses the line.
    pub here: Crossing,
    /// How far it moves from one line to the next ([`Crossing`]).
    step: i64,
}

impl IntervalEnd {
    /// The end on the line that is `n` parts from the root, for a ray from a root at `root` parts.
    #[inline]
    pub const fn new(ray: Ray, root: i32, n: i32) -> Self {
        let step = Self::step(ray);
        let from = ((root as i64) << (Crossing::FRACTION - Place::PLACES)) + Crossing::BIAS;
        let aside = if step.abs() < Self::STEEPEST_FLAT {
            ((n as i128 * step as i128) >> Place::PLACES) as i64
        } else {
            Self::flat(ray, n)
        };
        Self { ray, here: Crossing(from + aside), step }
    }

    /// The end at a vertex in column `x`, `n` parts from a root at `root` parts, and the ray through it.
    #[inline]
    pub const fn corner(x: i32, root: i32, n: i32) -> Self {
        let ray = Ray::through(x, root, n);
        Self { ray, here: Crossing::vertex(x), step: Self::step(ray) }
    }

    /// The step of a ray that is cut, or nearly.
    const STEEPEST_FLAT: i64 = i64::MAX >> Self::CUT;
    /// The binary places that a step is shorter than the greatest integer: to which the conversion cuts it.
    const CUT: u32 = 4;

    /// The way of a ray from one line to the next ([`Crossing`]). In floating point: an integer division
    /// takes a branch for the sign and cannot overlap with the next.
    #[inline]
    const fn step(ray: Ray) -> i64 {
        const SCALE: f64 = (Crossing::ONE << IntervalEnd::CUT) as f64;
        (ray.dx as f64 / ray.dy as f64 * SCALE) as i64 >> Self::CUT
    }

    /// The distance aside of a ray whose step is cut, `n` parts from its root; cut to twice the largest map.
    #[cold]
    const fn flat(ray: Ray, n: i32) -> i64 {
        const PART: f64 = Crossing::ONE as f64 / Place::parts(1) as f64;
        const MOST: i64 = Crossing::ONE << 16;
        let aside = (n as f64 * (ray.dx as f64 / ray.dy as f64 * PART)) as i64;
        if aside > MOST {
            MOST
        } else if aside < -MOST {
            -MOST
        } else {
            aside
        }
    }

    /// The same end on the line that its ray crosses at `next`.
    #[inline]
    pub const fn moved_to(self, next: Crossing) -> Self {
        Self { here: next, ..self }
    }

    /// Whether it stays in its column.
    #[inline]
    pub const fn is_vertical(&self) -> bool {
        self.step == 0
    }

    /// An end that stays in column `x` on every line.
    #[inline]
    pub const fn standing(x: i32) -> Self {
        Self { ray: Ray::VERTICAL, here: Crossing::vertex(x), step: 0 }
    }

    /// Where the ray crosses the next line.
    #[inline]
    pub const fn next(&self) -> Crossing {
        self.after(1)
    }

    /// Where the ray crosses the line that is `lines` lines further on.
    #[inline]
    pub const fn after(&self, lines: i32) -> Crossing {
        Crossing(self.here.0 + lines as i64 * self.step)
    }
}

/// The left or right end of an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Toward smaller x.
    Left,
    /// Toward larger x.
    Right,
}

impl Side {
    /// −1 on the left, 1 on the right.
    pub const fn sign(self) -> i32 {
        match self {
            Self::Left => -1,
            Self::Right => 1,
        }
    }

    /// The columns of cells beside a vertex in column x, the outer one first.
    pub const fn columns(self, x: i32) -> (i32, i32) {
        match self {
            Self::Left => (x - 1, x),
            Self::Right => (x, x - 1),
        }
    }

    /// Whether a crossing is strictly on the inner side of column x of vertices.
    #[inline]
    pub const fn is_inside(self, at: Crossing, x: i32) -> bool {
        match self {
            Self::Left => at.ceil() > x,
            Self::Right => at.floor() < x,
        }
    }

    /// Whether a crossing is strictly on the outer side of column x of vertices.
    #[inline]
    pub const fn is_outside(self, at: Crossing, x: i32) -> bool {
        match self {
            Self::Left => at.floor() < x,
            Self::Right => at.ceil() > x,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIDE: i32 = crate::Grid::MAX_SIDE as i32;

    /// A ray from a root through a vertex in column `through` on line 0, or with a direction of its own from
    /// a root that is a vertex of line 0: `slope` is what it moves in a line, as a quotient.
    #[derive(Clone, Copy, Debug)]
    struct Line {
        ray: Ray,
        /// The column where it crosses line 0, which is a vertex.
        through: i32,
    }

    impl Line {
        /// Floor, ceiling and 'is it a vertex?' on line `n`, by division.
        fn on(self, n: i32) -> (i32, i32, bool) {
            let (product, dy) = (i64::from(n) * i64::from(self.ray.dx), i64::from(self.ray.dy));
            let floor = i64::from(self.through) + product.div_euclid(dy);
            let is_vertex = product % dy == 0;
            (floor as i32, (floor + i64::from(!is_vertex)) as i32, is_vertex)
        }

        /// Whether it is on the largest map on line `n`.
        fn is_on_map(self, n: i32) -> bool {
            let (floor, ceil, _) = self.on(n);
            floor >= 0 && ceil <= SIDE
        }
    }

    fn seen(at: Crossing) -> (i32, i32, bool) {
        (at.floor(), at.ceil(), at.is_vertex())
    }

    /// Follows a ray by steps over all lines on which it is on the largest map, and one line further; `root`
    /// is the place of its root, on line 0 or above. On each line it is made anew, too.
    #[track_caller]
    fn follow(line: Line, (root_x, root_y): (i32, i32)) {
        let ray = line.ray;
        let mut end = match root_y {
            0 => IntervalEnd::new(ray, root_x, Place::parts(1)),
            _ => IntervalEnd::corner(line.through, root_x, -root_y),
        };
        for n in i32::from(root_y == 0)..=SIDE {
            let case = || format!("{line:?} from ({root_x}, {root_y}), line {n}");
            if !line.is_on_map(n) {
                // Outside, on the same side as the ray.
                let (floor, _, _) = line.on(n);
                assert_eq!(
                    (end.here.floor() <= 0, end.here.ceil() >= SIDE),
                    (floor < 0, floor >= SIDE),
                    "{}",
                    case()
                );
                break;
            }
            assert_eq!(seen(end.here), line.on(n), "{}", case());
            let anew = IntervalEnd::new(ray, root_x, Place::parts(n) - root_y);
            assert_eq!(seen(anew.here), line.on(n), "{}, anew", case());
            end = end.moved_to(end.next());
        }
    }

    /// The ray from a place above line 0, or to the left of its vertex on it, through a vertex of line 0.
    fn from_place(x: i32, above: i32, through: i32) -> (Line, (i32, i32)) {
        (Line { ray: Ray::through(through, x, above), through }, (x, -above))
    }

    /// A random integer below n, by a linear congruential generator.
    fn generator() -> impl FnMut(i32) -> i32 {
        let mut state = 1_u32;
        move |n| {
            state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            ((u64::from(state) * n as u64) >> 32) as i32
        }
    }

    #[test]
    fn crossings_from_vertices_decide_as_rationals_do() {
        // The steepest rays, the flattest ones, and those that come closest to a vertex without meeting it.
        for (dx, dy) in
            [(0, 1), (1, 1), (1, SIDE), (SIDE, 1), (SIDE, SIDE - 1), (SIDE - 1, SIDE), (1, SIDE - 1)]
        {
            follow(Line { ray: Ray { dx, dy }, through: 0 }, (0, 0));
            follow(Line { ray: Ray { dx: -dx, dy }, through: SIDE }, (Place::parts(SIDE), 0));
        }
        let mut below = generator();
        for _ in 0..400 {
            let ray = Ray { dx: below(2 * SIDE + 1) - SIDE, dy: 1 + below(SIDE) };
            let root = if ray.dx < 0 { SIDE } else { 0 };
            follow(Line { ray, through: root }, (Place::parts(root), 0));
            let root = below(SIDE + 1);
            let ray = Ray { dx: below(65) - 32, dy: 1 + below(64) };
            follow(Line { ray, through: root }, (Place::parts(root), 0));
        }
    }

    /// Directions in parts of a cell, from a vertex: those of paths that turn at their first vertex.
    #[test]
    fn crossings_of_fine_directions_decide_as_rationals_do() {
        let most = Place::parts(SIDE);
        for (dx, dy) in
            [(1, 1), (1, most), (most, 1), (most, most - 1), (most - 1, most), (1, most - 1), (most, 1025)]
        {
            follow(Line { ray: Ray { dx, dy }, through: 0 }, (0, 0));
            follow(Line { ray: Ray { dx: -dx, dy }, through: SIDE }, (Place::parts(SIDE), 0));
        }
        let mut below = generator();
        for _ in 0..600 {
            let ray = Ray { dx: below(2 * most) - most, dy: 1 + below(most) };
            let root = if ray.dx < 0 { SIDE } else { 0 };
            follow(Line { ray, through: root }, (Place::parts(root), 0));
            let root = below(SIDE + 1);
            let ray = Ray { dx: below(65) - 32, dy: 1 + below(64) };
            follow(Line { ray, through: root }, (Place::parts(root), 0));
            // Nearly along a line of vertices: one part aside after many lines.
            let ray = Ray { dx: below(3) - 1 + Place::parts(below(3)), dy: most - below(4) };
            follow(Line { ray, through: root }, (Place::parts(root), 0));
        }
    }

    /// From places between vertices, through vertices: as far away as can be, and 1/1024 beside a line.
    #[test]
    fn crossings_from_places_decide_as_rationals_do() {
        let most = Place::parts(SIDE);
        let mut below = generator();
        for above in [1, 2, 512, 1023, 1024, 1025, 3 * 1024 + 1, most / 2 + 1, most - 1] {
            for x in [0, 1, 511, 512, 1023, most / 2 + 1, most - 1, most] {
                for through in [0, 1, 2, SIDE / 2, SIDE - 1, SIDE] {
                    let (line, root) = from_place(x, above, through);
                    follow(line, root);
                }
            }
        }
        for _ in 0..1000 {
            let (line, root) = from_place(below(most + 1), 1 + below(most), below(SIDE + 1));
            follow(line, root);
            let near = below(SIDE);
            let (line, root) = from_place(Place::parts(near) + below(1024), 1 + below(4096), near + below(2));
            follow(line, root);
        }
    }
}
