//! The arguments that say how paths may run, for commands without an engine.

use clap::Args;
use mediant::Motion;
use mediant_grid::{CornerRule, DiagonalGap, PlacementKind, Rules};
use mediant_moves::K;

use super::{
    setup::{CornersArg, GapArg, PlacementArg},
    value::{parse_k, parse_neighbors},
};
use crate::failure::Failure;

/// The rules of motion at each placement.
#[derive(Args, Clone, Copy, Debug)]
pub(crate) struct RuleArgs {
    /// At centers, whether a path may cut the corner of a blocked cell: never (the default), one (if the cell
    /// across is free), always
    #[arg(long, value_enum, hide_possible_values = true, value_name = "never|one|always")]
    pub(crate) corners: Option<CornersArg>,
    /// At corners, whether a path may pass between two blocked cells that touch diagonally: open (the
    /// default), closed
    #[arg(long, value_enum, hide_possible_values = true, value_name = "open|closed")]
    pub(crate) gap: Option<GapArg>,
}

impl RuleArgs {
    /// The rules of motion at a placement. The rule of the other placement is an error.
    pub(crate) fn at(self, placement: PlacementKind) -> Result<Rules, Failure> {
        let not_applicable =
            |option, placement, other| Err(Failure::NotApplicable { option, placement, other });
        match placement {
            PlacementKind::Center if self.gap.is_some() => not_applicable("--gap", "center", "corner"),
            PlacementKind::Corner if self.corners.is_some() => {
                not_applicable("--corners", "corner", "center")
            }
            PlacementKind::Center => Ok(Rules::Center(match self.corners {
                None | Some(CornersArg::Never) => CornerRule::Never,
                Some(CornersArg::One) => CornerRule::One,
                Some(CornersArg::Always) => CornerRule::Always,
            })),
            PlacementKind::Corner => Ok(Rules::Corner(match self.gap {
                None | Some(GapArg::Open) => DiagonalGap::Open,
                Some(GapArg::Closed) => DiagonalGap::Closed,
            })),
        }
    }
}

/// The neighborhood, by its k or by its moves.
#[derive(Args, Clone, Copy, Debug)]
pub(crate) struct KArgs {
    /// The neighborhood, of 2^k moves: k = 3 has 8, k = 8 has 256. From 2 to 12, or any, which is every
    /// direction. 3 by default
    #[arg(id = "k", long = "k", value_name = "K", allow_negative_numbers = true, value_parser = parse_k)]
    by_k: Option<K>,
    /// The neighborhood by its number of moves, instead of --k: 4, 8, 16, … 4096
    #[arg(id = "neighbors", long = "neighbors", value_name = "N", conflicts_with = "k")]
    #[arg(allow_negative_numbers = true, value_parser = parse_neighbors)]
    by_moves: Option<K>,
}

impl KArgs {
    /// The k that was given, in one way or the other.
    pub(crate) fn given(self) -> Option<K> {
        self.by_k.or(self.by_moves)
    }
}

/// The k, the placement and its rule.
#[derive(Args, Clone, Copy, Debug)]
pub(crate) struct MotionArgs {
    #[command(flatten)]
    pub(crate) k: KArgs,
    /// Where the vertices are: at cell centers or at cell corners. center by default, corner for k = any
    #[arg(long, value_enum, hide_possible_values = true, value_name = "center|corner")]
    pub(crate) placement: Option<PlacementArg>,
    #[command(flatten)]
    pub(crate) rules: RuleArgs,
}

impl MotionArgs {
    /// The motion that the arguments ask for. It may be one that no engine searches.
    pub(crate) fn motion(&self) -> Result<Motion, Failure> {
        let k = self.k.given().unwrap_or(K::N8);
        Ok(Motion::new(k, self.rules.at(self.placement_for(k))?))
    }

    /// The placement: that which was given, else the one by default.
    pub(crate) fn placement_for(&self, k: K) -> PlacementKind {
        let default = if k == K::Any { PlacementKind::Corner } else { PlacementKind::Center };
        self.placement.map_or(default, PlacementArg::kind)
    }
}
