//! Ends of intervals of a grid line: where rays from a vertex through another vertex cross it.

/// A ray from a vertex, its root, given by the vector from the root to another vertex on it. `dy` > 0 counts
/// horizontal lines away from the root, whether up or down.
///
/// The end of an interval is never kept as a point, but as the ray that bounds it: the vector from the root
/// to the corner at which the interval was clipped or, if a path turned at the root, the vector from the
/// previous root. So it is always the difference of two vertices of the map.
///
/// **No overflow.** With sides of at most 2¹⁵ cells ([`Grid::MAX_SIDE`](crate::Grid::MAX_SIDE)), |dx| ≤ 2¹⁵
/// and 1 ≤ dy ≤ 2¹⁵. Products are taken only for a line that has the interval on it, n lines from the root.
/// The interval lies on the map, so the ray is at most 2¹⁵ columns from the root there, and |n · dx| ≤ 2¹⁵ ·
/// dy ≤ 2³⁰. Rays are never added, multiplied or intersected with each other, so numbers do not grow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ray {
    /// Columns to the right.
    pub dx: i32,
    /// Lines away from the root, at least 1.
    pub dy: i32,
}

impl Ray {
    /// Straight away from the root.
    pub const VERTICAL: Self = Self { dx: 0, dy: 1 };

    /// The column where the ray crosses a line, `n` lines from a root in column `root`, rounded to `f64`.
    #[inline]
    pub fn column(self, root: i32, n: i32) -> f64 {
        f64::from(root) + f64::from(n * self.dx) / f64::from(self.dy)
    }
}

/// Where a ray crosses a line, in columns: a fixed-point number with 44 binary places whose floor, ceiling
/// and 'is it a vertex?' are exact.
///
/// A ray crosses a line at a rational with denominator at most 2¹⁵: either at a vertex, or at least 2⁻¹⁵ away
/// from every vertex. A crossing is that rational plus 2⁻¹⁷, up or down the error of n steps. A step is a
/// quotient s of 53 binary digits, cut off after 44 binary places. The first is off by at most s · 2⁻⁵³, and
/// n steps by n · s · 2⁻⁵³ < 2⁻³⁴, as the ray is on the map or a few lines further; cutting off adds at most
/// n · 2⁻⁴⁴ < 2⁻²⁸. Together that is less than 2⁻²⁷. So the fractional part of a crossing is between 0 and
/// 2⁻¹⁶ at a vertex, and between 2⁻¹⁶ and 1 elsewhere.
///
/// An interval lies on the map, so a crossing on its line is between 0 and 2¹⁵. From one line to the next a
/// ray moves by at most 2¹⁵ columns. So all crossings are below 2¹⁷, and their fixed-point values below 2⁶¹.
#[derive(Clone, Copy, Debug)]
pub struct Crossing(i64);

impl Crossing {
    const FRACTION: u32 = 44;
    const ONE: i64 = 1 << Self::FRACTION;
    const BIAS: i64 = Self::ONE >> 17;
    const VERTEX: i64 = Self::ONE >> 16;

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

    /// Whether it is left of another by more than 2⁻¹⁶ columns, and so its floor below the other's ceiling.
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
    /// The end on the line that is `n` lines from the root, for a ray from a root in column `root`.
    #[inline]
    pub const fn new(ray: Ray, root: i32, n: i32) -> Self {
        let step = Self::step(ray);
        Self { ray, here: Crossing(Crossing::vertex(root).0 + n as i64 * step), step }
    }

    /// The end at a vertex in column `x`, `n` lines from a root in column `root`, and the ray through it.
    #[inline]
    pub const fn corner(x: i32, root: i32, n: i32) -> Self {
        let ray = Ray { dx: x - root, dy: n };
        Self { ray, here: Crossing::vertex(x), step: Self::step(ray) }
    }

    /// How far a ray moves from one line to the next. In floating point: an integer division takes a branch
    /// for the sign and cannot overlap with the next.
    #[inline]
    const fn step(ray: Ray) -> i64 {
        (ray.dx as f64 / ray.dy as f64 * Crossing::ONE as f64) as i64
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

    /// Floor, ceiling and 'is it a vertex?' of a ray from column `root` after `n` lines, by division.
    fn rational(Ray { dx, dy }: Ray, root: i32, n: i32) -> (i32, i32, bool) {
        let product = i64::from(n) * i64::from(dx);
        let floor = root + product.div_euclid(i64::from(dy)) as i32;
        let is_vertex = product % i64::from(dy) == 0;
        (floor, floor + i32::from(!is_vertex), is_vertex)
    }

    fn seen(at: Crossing) -> (i32, i32, bool) {
        (at.floor(), at.ceil(), at.is_vertex())
    }

    /// Follows a ray over all lines on which it is on the largest map, and one line further.
    #[track_caller]
    fn follow(ray: Ray, root: i32) {
        const SIDE: i32 = crate::Grid::MAX_SIDE as i32;
        let mut end = IntervalEnd::new(ray, root, 1);
        for n in 1..=SIDE {
            assert_eq!(seen(end.here), rational(ray, root, n), "{ray:?} from {root}, line {n}");
            assert_eq!(
                seen(IntervalEnd::new(ray, root, n).here),
                seen(end.here),
                "{ray:?} from {root}, line {n}"
            );
            end = end.moved_to(end.next());
            assert_eq!(seen(end.here), rational(ray, root, n + 1), "{ray:?} from {root}, line {}", n + 1);
            if !(0..=SIDE).contains(&end.here.floor()) {
                break;
            }
        }
    }

    #[test]
    fn crossings_decide_as_rationals_do() {
        const SIDE: i32 = crate::Grid::MAX_SIDE as i32;
        // The steepest rays, the flattest ones, and those that come closest to a vertex without meeting it.
        for (dx, dy) in
            [(0, 1), (1, 1), (1, SIDE), (SIDE, 1), (SIDE, SIDE - 1), (SIDE - 1, SIDE), (1, SIDE - 1)]
        {
            follow(Ray { dx, dy }, 0);
            follow(Ray { dx: -dx, dy }, SIDE);
        }
        // Vectors spread over the square by a linear congruential generator.
        let mut state = 1_u32;
        let mut below = |n: i32| {
            state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            ((u64::from(state) * n as u64) >> 32) as i32
        };
        for _ in 0..400 {
            let ray = Ray { dx: below(2 * SIDE + 1) - SIDE, dy: 1 + below(SIDE) };
            follow(ray, if ray.dx < 0 { SIDE } else { 0 });
            let root = below(SIDE + 1);
            follow(Ray { dx: below(65) - 32, dy: 1 + below(64) }, root);
        }
    }
}
