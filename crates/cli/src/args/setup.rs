//! The arguments that say what is searched and by which engine, and the setup that they make.

use clap::{Args, ValueEnum};
use mediant::{Engine, Setup};
use mediant_grid::{PlacementKind, Rules};
use mediant_moves::K;

use super::{
    motion::{KArgs, RuleArgs},
    value::one_of,
};
use crate::failure::Failure;

/// The arguments of a setup but the engine's options.
#[derive(Args, Debug)]
pub(crate) struct SetupArgs {
    /// The algorithm; `mediant engines` says what each can do
    #[arg(long, default_value_t, value_parser = one_of(Engine::ALL, Engine::name))]
    pub(crate) engine: Engine,
    #[command(flatten)]
    pub(crate) k: KArgs,
    /// Where the vertices are: at cell centers or at cell corners. center by default, corner for anya,
    /// subgoal-theta and k = any
    #[arg(long, value_enum, hide_possible_values = true, value_name = "center|corner")]
    pub(crate) placement: Option<PlacementArg>,
    #[command(flatten)]
    pub(crate) rules: RuleArgs,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum PlacementArg {
    #[value(alias = "centers")]
    Center,
    #[value(alias = "corners")]
    Corner,
}

impl PlacementArg {
    /// The placement that it names.
    pub(crate) const fn kind(self) -> PlacementKind {
        match self {
            Self::Center => PlacementKind::Center,
            Self::Corner => PlacementKind::Corner,
        }
    }
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
        let k = self.k.given().unwrap_or(self.engine.capabilities().default_k);
        Ok(Setup::new(self.engine, k, self.rules(k)?))
    }

    /// The rules of motion. The rule of the other placement is an error.
    fn rules(&self, k: K) -> Result<Rules, Failure> {
        let default = || self.engine.capabilities().default_rules(k).placement();
        self.rules.at(self.placement.map_or_else(default, PlacementArg::kind))
    }
}
