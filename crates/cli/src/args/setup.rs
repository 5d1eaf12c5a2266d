//! The arguments that say what is searched and by which engine, and the setup that they make.

use std::path::Path;

use clap::{Args, ValueEnum};
use mediant::{
    Choice, ConfiguredEngine, Demand, Engine, EngineName, Index, K, Motion, Setup, Smoothing, Space,
};
use mediant_grid::PlacementKind;

use super::{
    motion::{KArgs, RuleArgs},
    options::Given,
    value::one_of,
};
use crate::failure::Failure;

/// The arguments of a setup but the engine's options.
#[derive(Args, Debug)]
pub(crate) struct SetupArgs {
    /// The algorithm; `mediant engines` says what each can do. auto is the one that is best for as many paths
    /// as are asked for, or the best that has an index
    #[arg(long, default_value_t, value_parser = one_of(EngineName::all(), EngineName::name))]
    engine: EngineName,
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
    /// The engine, its options and the motion. [`Setup::check`] may refuse them.
    pub(super) fn asked(&self, options: Given, smoothing: Option<Smoothing>) -> Result<Asked, Failure> {
        let capabilities = self.engine.engine().map(Engine::capabilities);
        let k = self.k.given().unwrap_or(capabilities.map_or(K::N8, |capabilities| capabilities.default_k));
        let placement = match (self.placement, capabilities) {
            (Some(placement), _) => placement.kind(),
            (None, Some(capabilities)) => capabilities.default_rules(k).placement(),
            (None, None) if k == K::Any => PlacementKind::Corner,
            (None, None) => PlacementKind::Center,
        };
        let motion = Motion::new(k, self.rules.at(placement)?);
        Ok(Asked { engine: self.engine, motion, options, smoothing })
    }
}

/// A setup as the command line names it: its engine may be `auto`.
#[derive(Clone, Debug)]
pub(crate) struct Asked {
    pub(crate) engine: EngineName,
    pub(crate) motion: Motion,
    options: Given,
    smoothing: Option<Smoothing>,
}

impl Asked {
    /// Checks, before a map is read, what can be known without it; `needs_index` asks for an engine that has
    /// one.
    pub(crate) fn check(&self, needs_index: bool) -> Result<(), Failure> {
        let Some(engine) = self.engine.engine() else { return Ok(()) };
        let setup = self.with(engine)?;
        setup.check()?;
        if needs_index {
            setup.index_version()?;
        }
        Ok(())
    }

    /// The setup of an engine.
    fn with(&self, engine: Engine) -> Result<Setup, Failure> {
        let mut engine = ConfiguredEngine::from(engine);
        self.options.iter().try_for_each(|&(option, value)| engine.set(option, value))?;
        Ok(self.of(engine))
    }

    fn of(&self, engine: ConfiguredEngine) -> Setup {
        Setup { smoothing: self.smoothing, ..Setup::new(engine, self.motion.k, self.motion.rules) }
    }

    /// The setup for what is asked of a space, and why it is this one, if that was left open.
    pub(crate) fn setup(&self, space: &Space, demand: Demand) -> Result<(Setup, Option<Choice>), Failure> {
        match self.engine {
            EngineName::Engine(engine) => Ok((self.with(engine)?, None)),
            EngineName::Auto => {
                let (engine, choice) = space.engine_with(demand, &self.options)?;
                Ok((self.of(engine), Some(choice)))
            }
        }
    }

    /// The index of a space: a new one for what is asked, or that of a file, whose engine is the one that was
    /// left open; and why its engine is this one.
    pub(crate) fn index(
        &self,
        space: &Space,
        demand: Demand,
        file: Option<&Path>,
    ) -> Result<(Index, Option<Choice>), Failure> {
        let (index, choice) = match (file, self.engine) {
            (None, _) => {
                let (setup, choice) = self.setup(space, demand)?;
                (space.prepare(setup.engine)?, choice)
            }
            (Some(path), EngineName::Engine(engine)) => {
                (space.load_for(self.with(engine)?.engine, path)?, None)
            }
            (Some(path), EngineName::Auto) => {
                let index = space.load(path)?;
                let engine = index.setup().engine.kind();
                let choice = Choice { engine, why: "the index is of this engine" };
                (index.with_options(self.with(engine)?.engine)?, Some(choice))
            }
        };
        Ok((index.with_smoothing(self.smoothing), choice))
    }
}
