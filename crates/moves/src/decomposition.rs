//! Decompositions: of a vector into two adjacent moves, α·v + β·w, and of a move into a tree of moves of
//! lower levels.

use crate::{FiniteK, Parity, Vector};

/// d = α·v + β·w: the two adjacent moves of N(k) that contain d, and how often an optimal path on an empty
/// grid takes each of them (Rivera 2017, Theorems 2 and 3, Corollary 1; Kramm 2018, Theorem 1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Decomposition {
    /// The move nearer to the axis on which the quadrant begins.
    pub v: Vector,
    /// The number of times that v is taken.
    pub alpha: u32,
    /// The next move in angular order.
    pub w: Vector,
    /// The number of times that w is taken.
    pub beta: u32,
    /// The parity of the index of v; that of w is the other one.
    parity: Parity,
}

impl Decomposition {
    /// The canonical path: the odd-indexed move first, then the even-indexed one, each with its count, which
    /// may be 0 (Rivera 2017, 'Canonical Orderings').
    #[must_use]
    pub const fn canonical(self) -> [(Vector, u32); 2] {
        match self.parity {
            Parity::Odd => [(self.v, self.alpha), (self.w, self.beta)],
            Parity::Even => [(self.w, self.beta), (self.v, self.alpha)],
        }
    }

    /// α‖v‖ + β‖w‖ = h_k(d).
    #[must_use]
    pub fn length(self) -> f64 {
        f64::from(self.alpha) * self.v.norm() + f64::from(self.beta) * self.w.norm()
    }
}

/// The decomposition of d over N(k), for d of any quadrant (Hormazábal 2017, Algorithm 2). Takes about as
/// many steps as Euclid's algorithm takes on d, or fewer. The zero vector gets two moves of the first
/// quadrant and α = β = 0.
///
/// If d is a multiple of a move of N(k), this move is v or w, and the other factor is 0.
///
/// `None` if a coordinate of d is `i32::MIN`, or if one of the two moves has a coordinate beyond `i32`. (The
/// factor of that move is then 0, and a much smaller k gives the same path.)
///
/// ```
/// use mediant_moves::{decompose, FiniteK, Vector};
/// let parts = decompose(Vector::new(7, 9), FiniteK::new(5)?).unwrap();
/// assert_eq!((parts.alpha, parts.v, parts.beta, parts.w), (2, Vector::new(2, 3), 3, Vector::new(1, 1)));
/// # Ok::<(), mediant_moves::KError>(())
/// ```
#[must_use]
pub fn decompose(d: Vector, k: FiniteK) -> Option<Decomposition> {
    if d.x == i32::MIN || d.y == i32::MIN {
        return None;
    }
    let turns = d.quadrant().unwrap_or(0);
    let u = d.turned_by(4 - turns);
    let parts = factorize(u.x as u32, u.y as u32, k.depth());
    let turned = |(x, y): (u64, u64)| {
        Some(Vector::new(i32::try_from(x).ok()?, i32::try_from(y).ok()?).turned_by(turns))
    };
    // At k = 2 a quarter turn swaps the parities: (0, ±1) has index 0 in every quadrant, (±1, 0) index 1.
    let parity = match parts.last_beyond {
        Some(true) => Parity::Odd,
        None if turns % 2 == 1 => Parity::Odd,
        _ => Parity::Even,
    };
    let (v, w) = (turned(parts.low)?, turned(parts.high)?);
    Some(Decomposition { v, alpha: parts.times_low, w, beta: parts.times_high, parity })
}

/// The two adjacent moves of N(k) that contain d (Kramm 2018, 'Pairs'), in angular order; see [`decompose`].
#[must_use]
pub fn containing(d: Vector, k: FiniteK) -> Option<(Vector, Vector)> {
    decompose(d, k).map(|parts| (parts.v, parts.w))
}

/// |d| = times_low·low + times_high·high, for two adjacent moves of the first quadrant as (x, y). In `u64` the move with factor 0 fits as well, however large k is.
pub(crate) struct Factors {
    pub(crate) times_low: u32,
    pub(crate) low: (u64, u64),
    pub(crate) times_high: u32,
    pub(crate) high: (u64, u64),
    /// Whether the last round replaced `low`, which is then the mediant that N(k) inserts; `None` if there
    /// was no round.
    last_beyond: Option<bool>,
}

/// The factorization rounds of Hormazábal 2017, Algorithm 2, for |d| = (x, y).
///
/// Consecutive rounds on the same side are taken together by one division, which makes about as many steps as
/// Euclid's algorithm takes on (x, y), whatever k is.
pub(crate) fn factorize(mut x: u32, mut y: u32, mut rounds: u32) -> Factors {
    let (mut low, mut high) = ((0_u64, 1_u64), (1_u64, 0_u64));
    let mut last_beyond = None;
    while rounds > 0 {
        // A round subtracts the smaller factor from the larger one (y from x only if x > y). Once a factor is
        // 0, all remaining rounds are on the same side.
        let beyond = x > y;
        let n = if beyond { (x - 1).checked_div(y) } else { y.checked_div(x) }.unwrap_or(rounds).min(rounds);
        let times = u64::from(n);
        if beyond {
            x -= n * y;
            low = (low.0 + times * high.0, low.1 + times * high.1);
        } else {
            y -= n * x;
            high = (high.0 + times * low.0, high.1 + times * low.1);
        }
        rounds -= n;
        last_beyond = Some(beyond);
    }
    Factors { times_low: y, low, times_high: x, high, last_beyond }
}

#[cfg(feature = "alloc")]
pub use tree::{DecompositionTree, TreeNode};

#[cfg(feature = "alloc")]
mod tree {
    use alloc::vec::Vec;

    use crate::{FiniteK, Vector, level, parents};

    /// One node of a [`DecompositionTree`].
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub struct TreeNode {
        /// The move that labels the node.
        pub label: Vector,
        /// The indices of its two children in [`DecompositionTree::nodes`], `None` for a leaf.
        pub children: Option<(u32, u32)>,
    }

    /// The decomposition tree of level k for a move (Kramm 2018, Algorithm 2): the children of each node
    /// above level k are the two adjacent moves whose mediant is its label.
    ///
    /// Its leaves, from left to right, are the moves of a path over N(k). This path enters only cells that
    /// the move itself enters (Lemma 11), and on an empty grid no path over N(k) is shorter (Lemma 13).
    ///
    /// ```
    /// use mediant_moves::{DecompositionTree, FiniteK, Vector};
    /// let tree = DecompositionTree::new(Vector::new(7, 5), FiniteK::new(4)?).unwrap();
    /// let path: Vec<(i32, i32)> = tree.leaves().map(|v| (v.x, v.y)).collect();
    /// assert_eq!(path, [(1, 1), (1, 1), (2, 1), (1, 1), (2, 1)]);
    /// # Ok::<(), mediant_moves::KError>(())
    /// ```
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub struct DecompositionTree {
        nodes: Vec<TreeNode>,
    }

    impl DecompositionTree {
        /// The tree of level k for `v`; `None` if v is not a move or its level is below k (the paper's
        /// 'failure').
        ///
        /// It has at most 2·(|x| + |y|) nodes, of 20 bytes each.
        #[must_use]
        pub fn new(v: Vector, k: FiniteK) -> Option<Self> {
            if level(v)? < k.get() {
                return None;
            }
            let mut nodes = Vec::from([TreeNode { label: v, children: None }]);
            let mut next = 0;
            while next < nodes.len() {
                let label = nodes[next].label;
                if level(label)? > k.get() {
                    let (left, right) = parents(label)?;
                    let first = nodes.len() as u32;
                    nodes[next].children = Some((first, first + 1));
                    nodes.extend([left, right].map(|label| TreeNode { label, children: None }));
                }
                next += 1;
            }
            Some(Self { nodes })
        }

        /// All nodes, breadth first, the root at index 0.
        #[must_use]
        pub fn nodes(&self) -> &[TreeNode] {
            &self.nodes
        }

        /// The labels of the leaves from left to right: the moves of a path from (0, 0) to the root's label.
        pub fn leaves(&self) -> impl Iterator<Item = Vector> {
            let mut stack = Vec::from([0_u32]);
            core::iter::from_fn(move || {
                loop {
                    let node = self.nodes[stack.pop()? as usize];
                    match node.children {
                        None => return Some(node.label),
                        Some((left, right)) => stack.extend([right, left]),
                    }
                }
            })
        }

        /// The vertices of the path that the leaves form, from (0, 0) on (Kramm 2018, Lemma 13).
        pub fn path(&self) -> impl Iterator<Item = Vector> {
            let mut at = Vector::ZERO;
            core::iter::once(at).chain(self.leaves().map(move |step| {
                at = at + step;
                at
            }))
        }
    }
}
