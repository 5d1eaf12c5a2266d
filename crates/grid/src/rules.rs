//! The rules of motion as values, for the edge of a program. Inside, a placement is a type
//! ([`Placement`](crate::Placement)) with its rule.

use std::fmt;

use crate::names;

/// Where the vertices of the search graph are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "lowercase"))]
pub enum PlacementKind {
    /// One vertex a cell, at its center: the setting of Rivera 2017 and of the MovingAI scenario files.
    Center,
    /// One vertex a cell corner, (W + 1) × (H + 1) of them: the setting of Hormazábal 2017 and of any-angle
    /// search.
    Corner,
}

/// At centers: whether a move may cut corners. Where it passes exactly through a corner of cells, it only
/// touches two of the four cells there. The rule says which of these two must be free; all other cells that
/// the move touches must be.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{Centers, CornerRule, FreeSpace, Grid};
///
/// // From the lower left cell to the upper right one, past a blocked cell.
/// let grid = Arc::new(Grid::from_fn(2, 2, |x, y| (x, y) == (0, 0))?);
/// let may_pass = |rule| FreeSpace::<Centers>::new(Arc::clone(&grid), rule).sees((0, 1).into(), (1, 0).into());
/// assert!(!may_pass(CornerRule::Never) && may_pass(CornerRule::One) && may_pass(CornerRule::Always));
/// # Ok::<(), mediant_grid::GridError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "lowercase"))]
pub enum CornerRule {
    /// Both must be free: no corner is cut (Rivera 2017; the MovingAI scenarios).
    #[default]
    Never,
    /// At least one must be free.
    One,
    /// Neither need be free.
    Always,
}

/// At corners: whether a path may pass through a *gap*, a vertex where two blocked cells touch diagonally and
/// the two others are free.
///
/// In any case a move may enter the open interior of no blocked cell, and may not run along an edge between
/// two blocked cells. The outside of the map counts as blocked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "lowercase"))]
pub enum DiagonalGap {
    /// It may (Uras and Koenig; Kramm 2018, (APP2)).
    #[default]
    Open,
    /// It may not. A path that starts or ends at a gap stays in the quadrant of the vertex's own cell (Anya;
    /// the any-angle track of the Grid-based Path Planning Competition).
    Closed,
}

/// A placement with its rule of motion.
///
/// ```
/// use mediant_grid::{CornerRule, PlacementKind, Rules};
/// let rules = Rules::Center(CornerRule::Never);
/// assert_eq!(rules.placement(), PlacementKind::Center);
/// assert_eq!(rules.to_string(), "center, corners never");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "lowercase"))]
pub enum Rules {
    /// Vertices at cell centers.
    Center(CornerRule),
    /// Vertices at cell corners.
    Corner(DiagonalGap),
    /// Vertices at cell centers, at any angle: paths start and end there, or anywhere, and bend at corners of
    /// obstacles, by the rule for corners.
    CenterGap(DiagonalGap),
}

impl Rules {
    /// The five under which N(k) is searched.
    pub const ALL: [Self; 5] = [
        Self::Center(CornerRule::Never),
        Self::Center(CornerRule::One),
        Self::Center(CornerRule::Always),
        Self::Corner(DiagonalGap::Open),
        Self::Corner(DiagonalGap::Closed),
    ];

    /// The two under which paths at any angle lead from center to center.
    pub const BETWEEN_CENTERS: [Self; 2] =
        [Self::CenterGap(DiagonalGap::Open), Self::CenterGap(DiagonalGap::Closed)];

    /// The number of all of them.
    pub(crate) const COUNT: usize = Self::ALL.len() + Self::BETWEEN_CENTERS.len();

    /// The place in [`ALL`](Self::ALL), or after it in [`BETWEEN_CENTERS`](Self::BETWEEN_CENTERS).
    pub(crate) const fn number(self) -> usize {
        match self {
            Self::Center(CornerRule::Never) => 0,
            Self::Center(CornerRule::One) => 1,
            Self::Center(CornerRule::Always) => 2,
            Self::Corner(DiagonalGap::Open) => 3,
            Self::Corner(DiagonalGap::Closed) => 4,
            Self::CenterGap(DiagonalGap::Open) => 5,
            Self::CenterGap(DiagonalGap::Closed) => 6,
        }
    }

    /// The rules in this place.
    pub(crate) fn of_number(number: usize) -> Option<Self> {
        Self::ALL.into_iter().chain(Self::BETWEEN_CENTERS).nth(number)
    }

    /// The placement alone.
    #[must_use]
    pub const fn placement(self) -> PlacementKind {
        match self {
            Self::Center(_) | Self::CenterGap(_) => PlacementKind::Center,
            Self::Corner(_) => PlacementKind::Corner,
        }
    }

    /// The rule at gaps, if paths bend at corners.
    #[must_use]
    pub const fn gap(self) -> Option<DiagonalGap> {
        match self {
            Self::Corner(gap) | Self::CenterGap(gap) => Some(gap),
            Self::Center(_) => None,
        }
    }

    /// The corner rule, if paths bend at centers.
    #[must_use]
    pub const fn corners(self) -> Option<CornerRule> {
        if let Self::Center(rule) = self { Some(rule) } else { None }
    }
}

impl From<CornerRule> for Rules {
    fn from(rule: CornerRule) -> Self {
        Self::Center(rule)
    }
}

impl From<DiagonalGap> for Rules {
    fn from(gap: DiagonalGap) -> Self {
        Self::Corner(gap)
    }
}

names!(PlacementKind: Center => "center" | "centers", Corner => "corner" | "corners");
names!(CornerRule: Never => "never", One => "one", Always => "always");
names!(DiagonalGap: Open => "open", Closed => "closed");

impl fmt::Display for Rules {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Center(corners) => write!(f, "center, corners {corners}"),
            Self::Corner(gap) => write!(f, "corner, gap {gap}"),
            Self::CenterGap(gap) => write!(f, "center, gap {gap}"),
        }
    }
}
