//! How an agent moves.

use std::fmt;

use mediant_grid::{Centers, CornerRule, DiagonalGap, GridGraph, Rules};
use mediant_moves::{FiniteK, K, KError};

/// How an agent moves: where the vertices of its paths are, by which rule, and in which directions (k).
///
/// ```
/// use mediant::{CornerRule, K, Motion};
///
/// // Eight directions between the centers of cells, without cutting corners: the rule of most benchmarks.
/// let walker = Motion::centers(K::N8);
/// assert_eq!([Motion::centers(3), Motion::default()], [walker; 2]);
/// // Any direction between the corners of cells.
/// let drone = Motion::corners(K::ANY);
/// // Any direction between the centers of cells: paths bend at corners of obstacles.
/// assert_eq!(Motion::centers(K::ANY).to_string(), "center, gap closed, k = any");
/// // Sixteen directions; a corner may be cut if one of the two cells beside it is free.
/// let soldier = Motion::new(K::N16, CornerRule::One);
/// assert_eq!(soldier.to_string(), "center, corners one, k = 4");
/// # assert_ne!(walker, drone);
/// ```
///
/// A number that is no k is kept, and [`Map::space`](crate::Map::space) says what is wrong with it:
///
/// ```
/// use mediant::{ErrorCode, Map, Motion};
///
/// let map = Map::new(8, 8)?;
/// let error = map.space(Motion::centers(-3)).unwrap_err();
/// assert_eq!(error.code(), ErrorCode::K);
/// let error = map.space(Motion::corners(99)).unwrap_err();
/// assert_eq!(error.code(), ErrorCode::Motion);
/// # Ok::<(), mediant::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub struct Motion {
    /// The neighborhood: 2^k directions, or all of them. k = 3 has 8 moves, k = 8 has 256:
    /// [`K::from_neighbors`] takes the number of moves.
    ///
    /// Of a motion that was made with a number that is no k this is one that no engine searches; another one
    /// in its place counts.
    pub k: K,
    /// The placement of the vertices, and its rule of motion.
    pub rules: Rules,
    /// The error of the number that `k` stands for, if `k` is still [`NO_K`].
    refused: Option<KError>,
}

/// Stands where a number is no k: larger than any k that an engine searches, so that whatever takes the k
/// alone refuses it, too.
const NO_K: K = match K::new(u32::MAX) {
    Ok(k) => k,
    Err(_) => K::Finite(FiniteK::MAX_MOVES),
};

mod sealed {
    pub trait Sealed {}
}

/// The types of a k: [`K`], [`FiniteK`], and integers of any width.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no k: give a number such as 3, or a `K` such as `K::N8` or `K::ANY`",
    label = "neither an integer nor a `K`"
)]
pub trait IntoK: sealed::Sealed {
    /// The k.
    ///
    /// # Errors
    /// [`KError`] for a number that is none.
    fn into_k(self) -> Result<K, KError>;
}

macro_rules! into_k {
    ($($type:ty),+) => {
        $(
            impl sealed::Sealed for $type {}

            impl IntoK for $type {
                fn into_k(self) -> Result<K, KError> {
                    K::try_from(self)
                }
            }
        )+
    };
}

into_k!(u8, u16, u32, u64, usize, i8, i16, i32, i64, isize);

impl sealed::Sealed for K {}

impl IntoK for K {
    fn into_k(self) -> Result<K, KError> {
        Ok(self)
    }
}

impl sealed::Sealed for FiniteK {}

impl IntoK for FiniteK {
    fn into_k(self) -> Result<K, KError> {
        Ok(self.into())
    }
}

impl Motion {
    /// The largest finite k that an engine searches over.
    pub const MAX_K: u32 = GridGraph::<Centers>::MAX_K;

    /// N(k) under a [`CornerRule`] (vertices at centers), a [`DiagonalGap`] (vertices at corners), or either
    /// of them as [`Rules`]. Paths at any angle between centers have [`Rules::CenterGap`].
    #[must_use]
    pub fn new(k: impl IntoK, rules: impl Into<Rules>) -> Self {
        let (k, refused) = match k.into_k() {
            Ok(k) => (k, None),
            Err(error) => (NO_K, Some(error)),
        };
        Self { k, rules: rules.into(), refused }
    }

    /// N(k) between the centers of cells; corners are never cut.
    ///
    /// At any angle a path bends at corners of obstacles, and starts and ends at centers, or at any other
    /// points. It may not pass where two blocked cells touch diagonally, so that it connects what N(k) does
    /// here: for the other rule make it [`Rules::CenterGap`] of an open gap. No path over N(k) between the
    /// same two centers is shorter, under `never` and `one` with either rule, under `always` with gaps open.
    ///
    /// ```
    /// use mediant::{K, Map, Motion};
    ///
    /// let map = Map::from_rows([".@.", "..."])?;
    /// let length = |motion| -> Result<Option<f64>, mediant::Error> {
    ///     Ok(map.space(motion)?.path((0, 0), (2, 0))?.map(|path| path.length()))
    /// };
    /// assert_eq!(length(Motion::centers(8))?, Some(4.0));
    /// assert_eq!(length(Motion::centers(K::ANY))?, Some(1.0 + 2.0_f64.sqrt()));
    /// # Ok::<(), mediant::Error>(())
    /// ```
    #[must_use]
    pub fn centers(k: impl IntoK) -> Self {
        let motion = Self::new(k, CornerRule::default());
        if motion.k == K::Any { Self::of(K::Any, Rules::CenterGap(DiagonalGap::Closed)) } else { motion }
    }

    /// N(k) between the corners of cells; paths may pass where two blocked cells touch diagonally.
    #[must_use]
    pub fn corners(k: impl IntoK) -> Self {
        Self::new(k, DiagonalGap::default())
    }

    pub(crate) const fn of(k: K, rules: Rules) -> Self {
        Self { k, rules, refused: None }
    }

    /// The error of a number that is no k, if it was not replaced.
    pub(crate) fn refused(self) -> Option<KError> {
        self.refused.filter(|_| self.k == NO_K)
    }
}

/// k = 3 between the centers of cells; corners are never cut.
impl Default for Motion {
    fn default() -> Self {
        Self::centers(K::N8)
    }
}

/// [`Motion::centers`].
impl<T: IntoK> From<T> for Motion {
    fn from(k: T) -> Self {
        Self::centers(k)
    }
}

impl fmt::Display for Motion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rules = self.rules;
        f.pad(&match self.refused() {
            Some(KError::TooSmall { k }) => format!("{rules}, k = {k}"),
            Some(KError::TooLarge { k, .. }) => format!("{rules}, k = {k}"),
            _ => format!("{rules}, k = {}", self.k),
        })
    }
}
