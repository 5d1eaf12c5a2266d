//! The arguments that say what is searched and by which engine, and the setup that they make.

use clap::{Args, ValueEnum};
use mediant::{Engine, Setup};
use mediant_grid::{CornerRule, DiagonalGap, PlacementKind, Rules};
use mediant_moves::K;

use super::value::{one_of, parse_k};
use crate::failure::Failure;

/// The arguments of a setup but the engine's options.
#[derive(Args, Debug)]
pub(crate) struct SetupArgs {
    /// The algorithm; `mediant engines` says what each can do
    #[arg(long, default_value_t, value_parser = one_of(Engine::ALL, Engine::name))]
    pub(crate) engine: Engine,
    /// The neighborhood: 2 to 12, or any, which is every direction. 3 by default, any for anya
    #[arg(long, allow_negative_numbers = true, value_parser = parse_k)]
    pub(crate) k: Option<K>,
    /// Where the vertices are: at cell centers or at cell corners. center by default, corner for anya,
    /// subgoal-theta and k = any
    #[arg(long, value_enum, hide_possible_values = true, value_name = "center|corner")]
    pub(crate) placement: Option<PlacementArg>,
    /// At centers, whether a path may cut the corner of a blocked cell: never (the default), one (if the cell
    /// across is free), always
    #[arg(long, value_enum, hide_possible_values = true, value_name = "never|one|always")]
    pub(crate) corners: Option<CornersArg>,
    /// At corners, whether a path may pass between two blocked cells that touch diagonally: open (the
    /// default), closed
    #[arg(long, value_enum, hide_possible_values = true, value_name = "open|closed")]
    pub(crate) gap: Option<GapArg>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum PlacementArg {
    Center,
    Corner,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum CornersArg {
    Never,
    One,
    Always,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum GapArg {
    Open,
    Closed,
}

impl SetupArgs {
    /// The setup without the engine's options. It may be one that [`Setup::check`] refuses.
    pub(super) fn without_options(&self) -> Result<Setup, Failure> {
        let k = self.k.unwrap_or(self.engine.capabilities().default_k());
        Ok(Setup::new(self.engine, k, self.rules(k)?))
    }

    /// The rules of motion. The rule of the other placement is an error.
    fn rules(&self, k: K) -> Result<Rules, Failure> {
        let not_applicable =
            |option, placement, other| Err(Failure::NotApplicable { option, placement, other });
        let placement = match self.placement {
            None => self.engine.capabilities().default_rules(k).placement(),
            Some(PlacementArg::Center) => PlacementKind::Center,
            Some(PlacementArg::Corner) => PlacementKind::Corner,
        };
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
