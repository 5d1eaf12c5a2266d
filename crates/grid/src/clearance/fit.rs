//! Options of a clearance: the points that keep an agent's distance, and the outside of the map.

use mediant_moves::{FiniteK, K};

use crate::{CornerRule, Rules, names};

/// The points of a cell that keep an agent's distance: they decide which cells are free on its map. The
/// guarantees for a disc that moves are proven [in `Clearance`](super::Clearance#guarantees).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Fit {
    /// The centers of cells: a cell is free if the disc around its center fits. Robots' costmaps do so.
    ///
    /// The disc keeps its radius on paths between centers over N(2), and over N(3) under
    /// [`CornerRule::Never`]. On others it comes up to ½ cell nearer, and at corners √½.
    Centers,
    /// Whole cells: a cell is free if the disc fits around every point of its closed square.
    ///
    /// The disc keeps its radius on all paths: both placements, all rules, every k and any angle. The price:
    /// some discs do not pass where they could. A corridor of w cells lets discs up to the radius (w − 1)/2,
    /// rounded down, pass; with [`Centers`](Self::Centers) up to w/2 if w is odd. A disc of any radius
    /// above 0 keeps off all cells that touch a blocked one.
    WholeCells,
}

names!(Fit: Centers => "centers", WholeCells => "whole-cells");

impl Fit {
    /// The looser one of the fits that keep a disc's radius along every path over N(k) under these rules.
    ///
    /// ```
    /// use mediant_grid::{CornerRule, DiagonalGap, Fit};
    /// use mediant_moves::K;
    /// assert_eq!(Fit::exact(CornerRule::Never.into(), K::N8), Fit::Centers);
    /// assert_eq!(Fit::exact(CornerRule::Never.into(), K::ANY), Fit::WholeCells);
    /// assert_eq!(Fit::exact(DiagonalGap::Open.into(), K::N8), Fit::WholeCells);
    /// ```
    #[must_use]
    pub fn exact(rules: Rules, k: K) -> Self {
        match (rules, k.finite()) {
            (Rules::Center(_), Some(FiniteK::N4)) => Self::Centers,
            (Rules::Center(CornerRule::Never), Some(FiniteK::N8)) => Self::Centers,
            _ => Self::WholeCells,
        }
    }
}

/// The outside of the map, over which an agent may stick out or not. (The point that moves never leaves the
/// map.)
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Outside {
    /// It may not: the outside is an obstacle, as the rules of motion have it.
    #[default]
    Blocked,
    /// It may: only blocked cells of the map are obstacles. So do robots' costmaps, in which obstacles
    /// inflate and the edge of the map does not.
    Open,
}

names!(Outside: Blocked => "blocked", Open => "open");
