//! The moves of one quadrant and of the whole neighborhood, in angular order.
//!
//! Moves are computed, not stored: the j-th move of Q(i) is (s(j), s(2^i − j)) with Stern's diatomic sequence
//! s, and each move follows from the two before in constant time.

use crate::{FiniteK, KError, Vector};

/// The parity of a move's index in its quadrant (Rivera 2017, 'Canonical Orderings').
///
/// For k ≥ 3 the odd-indexed moves of N(k) are those that N(k − 1) lacks, the moves of level k.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Parity {
    /// Odd index: taken first by a canonical path.
    Odd,
    /// Even index.
    Even,
}

/// Q(k − 2): the first-quadrant moves of N(k) in angular order, from (0, 1) at index 0 to (1, 0) at index
/// 2^(k−2) (Rivera 2017, Eq. 1–5; Kramm 2018, 'The 2^k Neighborhood').
///
/// ```
/// use mediant_moves::{FiniteK, Quadrant};
/// let moves: Vec<(i32, i32)> = Quadrant::new(FiniteK::new(4)?)?.iter().map(|v| (v.x, v.y)).collect();
/// assert_eq!(moves, [(0, 1), (1, 2), (1, 1), (2, 1), (1, 0)]);
/// # Ok::<(), mediant_moves::KError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quadrant {
    k: FiniteK,
}

impl Quadrant {
    /// The quadrant of N(k).
    ///
    /// # Errors
    /// [`KError::TooLarge`] above [`FiniteK::MAX_MOVES`].
    pub const fn new(k: FiniteK) -> Result<Self, KError> {
        match k.radius() {
            Ok(_) => Ok(Self { k }),
            Err(error) => Err(error),
        }
    }

    /// The k of the neighborhood.
    #[must_use]
    pub const fn k(self) -> FiniteK {
        self.k
    }

    /// The index of the last move, (1, 0): 2^(k−2).
    #[must_use]
    pub const fn last(self) -> u64 {
        1 << self.k.depth()
    }

    /// The number of moves: |Q(i)| = 2^i + 1 (Rivera 2017, Proposition 2, whose proof misprints it as
    /// 2^(i+1)).
    #[must_use]
    #[expect(clippy::len_without_is_empty, reason = "a quadrant is never empty")]
    pub const fn len(self) -> u64 {
        self.last() + 1
    }

    /// The move at `index`, `None` beyond [`last`](Self::last). Takes k − 2 steps.
    #[must_use]
    pub const fn get(self, index: u64) -> Option<Vector> {
        if index > self.last() {
            return None;
        }
        if index == self.last() {
            return Some(Vector::new(1, 0));
        }
        Some(self.pair(index).0)
    }

    /// The moves at `index` and `index + 1`, for `index` below [`last`](Self::last). Each bit of the index
    /// says on which side of a mediant the pair lies.
    const fn pair(self, index: u64) -> (Vector, Vector) {
        let (mut low, mut high) = (Vector::new(0, 1), Vector::new(1, 0));
        let mut level = self.k.depth();
        while level > 0 {
            level -= 1;
            let mediant = Vector::new(low.x + high.x, low.y + high.y);
            if index >> level & 1 == 1 {
                low = mediant;
            } else {
                high = mediant;
            }
        }
        (low, high)
    }

    /// The index of a first-quadrant vector among the moves, if it is one of them. Takes k − 2 steps.
    #[must_use]
    pub const fn index_of(self, v: Vector) -> Option<u64> {
        if v.x < 0 || v.y < 0 || (v.x == 0 && v.y == 0) {
            return None;
        }
        let (mut x, mut y) = (v.x as u32, v.y as u32);
        let mut index = 0;
        let mut level = self.k.depth();
        while level > 0 {
            level -= 1;
            if x > y {
                x -= y;
                index |= 1 << level;
            } else {
                y -= x;
            }
        }
        match (x, y) {
            (0, 1) => Some(index),
            (1, 0) => Some(index + 1),
            _ => None,
        }
    }

    /// The parity of an index.
    #[must_use]
    pub const fn parity(index: u64) -> Parity {
        if index % 2 == 1 { Parity::Odd } else { Parity::Even }
    }

    /// All moves in angular order, each in constant time.
    #[must_use]
    pub fn iter(self) -> QuadrantMoves {
        let (previous, next) = self.pair(0);
        QuadrantMoves { index: 0, len: self.len(), current: previous, next }
    }

    /// The indices in canonical order: first the odd ones, then the even ones, each in ascending order
    /// (Rivera 2017, 'Canonical Orderings', which leaves the order among odd and among even indices open).
    pub fn canonical_order(self) -> impl Iterator<Item = u64> {
        (1..self.len()).step_by(2).chain((0..self.len()).step_by(2))
    }
}

impl IntoIterator for Quadrant {
    type Item = Vector;
    type IntoIter = QuadrantMoves;

    fn into_iter(self) -> QuadrantMoves {
        self.iter()
    }
}

/// The moves of a [`Quadrant`] in angular order.
///
/// After two neighbors u, v the next move is (2t + 1)·v − u, where t is the number of trailing zeros of the
/// index of v. For v was inserted t levels before the last one, and each level since has added v once to both
/// of its neighbors.
#[derive(Clone, Debug)]
pub struct QuadrantMoves {
    index: u64,
    len: u64,
    current: Vector,
    next: Vector,
}

impl Iterator for QuadrantMoves {
    type Item = Vector;

    fn next(&mut self) -> Option<Vector> {
        if self.index == self.len {
            return None;
        }
        self.index += 1;
        let result = self.current;
        self.current = self.next;
        // After the last move the recurrence would leave the quadrant.
        if self.index + 1 < self.len {
            let times = 2 * self.index.trailing_zeros() as i32 + 1;
            // The product can leave the i32 range near the middle of the largest quadrants; the difference
            // never does.
            let next = |v: i32, u: i32| v.wrapping_mul(times).wrapping_sub(u);
            self.next = Vector::new(next(self.current.x, result.x), next(self.current.y, result.y));
        }
        Some(result)
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        // This is not an `ExactSizeIterator`, because from k = 34 on the number of moves does not fit in a
        // 32-bit `usize`.
        let left = usize::try_from(self.len - self.index);
        (left.unwrap_or(usize::MAX), left.ok())
    }
}

/// N(k): all 2^k moves (Rivera 2017, Eq. 6), in angular order around the circle from (0, 1) over (1, 0), (0,
/// −1) and (−1, 0). Neighbors in this cyclic order are adjacent moves.
///
/// The quadrants are quarter turns of the first one, while the papers reflect it. The set is the same, and
/// the index of a move has the same parity as its index in the papers' quadrant.
///
/// ```
/// use mediant_moves::{FiniteK, Neighborhood, Vector};
/// let eight = Neighborhood::new(FiniteK::N8)?;
/// assert_eq!(eight.len(), 8);
/// assert_eq!(eight.get(3), Some(Vector::new(1, -1)));
/// assert_eq!(eight.index_of(Vector::new(1, -1)), Some(3));
/// assert_eq!(eight.index_of(Vector::new(2, 1)), None);
/// # Ok::<(), mediant_moves::KError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Neighborhood {
    quadrant: Quadrant,
}

impl Neighborhood {
    /// The neighborhood N(k).
    ///
    /// # Errors
    /// [`KError::TooLarge`] above [`FiniteK::MAX_MOVES`].
    pub const fn new(k: FiniteK) -> Result<Self, KError> {
        match Quadrant::new(k) {
            Ok(quadrant) => Ok(Self { quadrant }),
            Err(error) => Err(error),
        }
    }

    /// The k of the neighborhood.
    #[must_use]
    pub const fn k(self) -> FiniteK {
        self.quadrant.k
    }

    /// The first quadrant.
    #[must_use]
    pub const fn quadrant(self) -> Quadrant {
        self.quadrant
    }

    /// The number of moves: 2^k (Rivera 2017, Proposition 2).
    #[must_use]
    #[expect(clippy::len_without_is_empty, reason = "a neighborhood is never empty")]
    pub const fn len(self) -> u64 {
        1 << self.k().get()
    }

    /// The move at `index`, `None` from [`len`](Self::len) on. Takes k − 2 steps.
    #[must_use]
    pub const fn get(self, index: u64) -> Option<Vector> {
        if index >= self.len() {
            return None;
        }
        let (turns, index) = (index >> self.k().depth(), index & (self.quadrant.last() - 1));
        match self.quadrant.get(index) {
            Some(v) => Some(v.turned_by(turns as u32)),
            None => None,
        }
    }

    /// The index of a vector, `None` if it is not one of the moves. Takes k − 2 steps.
    #[must_use]
    pub const fn index_of(self, v: Vector) -> Option<u64> {
        if v.x == i32::MIN || v.y == i32::MIN {
            return None;
        }
        let Some(turns) = v.quadrant() else { return None };
        match self.quadrant.index_of(v.turned_by(4 - turns)) {
            Some(index) => Some(((turns as u64) << self.k().depth()) + index),
            None => None,
        }
    }

    /// Whether the vector is one of the moves.
    #[must_use]
    pub const fn contains(self, v: Vector) -> bool {
        self.index_of(v).is_some()
    }

    /// All moves in angular order.
    pub fn iter(self) -> impl Iterator<Item = Vector> {
        // The last move of a quadrant is the first one of the next. Not by `take`: the number may exceed a
        // 32-bit `usize`.
        let moves = QuadrantMoves { len: self.quadrant.last(), ..self.quadrant.iter() };
        (0..4).flat_map(move |turns| moves.clone().map(move |v| v.turned_by(turns)))
    }
}
