//! The rules of motion, as closed enums for the edge of a program.

use std::fmt;

/// Where the vertices of the search graph are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PlacementKind {
    /// One vertex a cell, at its center: the setting of Rivera 2017 and of the MovingAI scenario files.
    Center,
    /// One vertex a cell corner, (W + 1) × (H + 1) of them: the setting of Hormazábal 2017 and of any-angle search.
    Corner,
}

/// At centers: what becomes of the two cells that a move only touches, at a lattice corner point that it passes through.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum CornerRule {
    /// Both must be free: no corner is cut (Rivera 2017; the MovingAI scenarios).
    #[default]
    Never,
    /// At least one must be free.
    One,
    /// Neither need be free.
    Always,
}

/// At corners: whether a path may pass through a vertex where two blocked cells touch diagonally.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum DiagonalGap {
    /// It may (Uras & Koenig; Kramm 2018, (APP2)).
    #[default]
    Open,
    /// It may not, and one that starts or ends there stays in the quadrant of the vertex's own cell (Anya; the any-angle
    /// track of the Grid-based Path Planning Competition).
    Closed,
}

/// A placement with the rule that belongs to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Rules {
    /// Vertices at cell centers.
    Center(CornerRule),
    /// Vertices at cell corners.
    Corner(DiagonalGap),
}

impl Rules {
    /// All five.
    pub const ALL: [Self; 5] = [
        Self::Center(CornerRule::Never),
        Self::Center(CornerRule::One),
        Self::Center(CornerRule::Always),
        Self::Corner(DiagonalGap::Open),
        Self::Corner(DiagonalGap::Closed),
    ];

    /// The placement alone.
    #[must_use]
    pub const fn placement(self) -> PlacementKind {
        match self {
            Self::Center(_) => PlacementKind::Center,
            Self::Corner(_) => PlacementKind::Corner,
        }
    }
}

/// Writes the names that the `mediant` program takes and prints.
macro_rules! names {
    ($type:ty: $($variant:path => $name:literal),+) => {
        impl fmt::Display for $type {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.pad(match self { $($variant => $name),+ })
            }
        }
    };
}

names!(PlacementKind: PlacementKind::Center => "center", PlacementKind::Corner => "corner");
names!(CornerRule: CornerRule::Never => "never", CornerRule::One => "one", CornerRule::Always => "always");
names!(DiagonalGap: DiagonalGap::Open => "open", DiagonalGap::Closed => "closed");

impl fmt::Display for Rules {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Center(corners) => write!(f, "center, corners {corners}"),
            Self::Corner(gap) => write!(f, "corner, gap {gap}"),
        }
    }
}
