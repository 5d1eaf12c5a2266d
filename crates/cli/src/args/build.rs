//! The arguments of `mediant build`.

use std::path::PathBuf;

use clap::Args;
use mediant::Setup;

use super::{options::IndexOptions, setup::SetupArgs};
use crate::failure::Failure;

#[derive(Args, Debug)]
pub(crate) struct BuildArgs {
    /// A MovingAI map file, or builtin:NAME (archipelago, cave, maze, town)
    pub(crate) map: PathBuf,
    #[command(flatten)]
    pub(crate) setup: SetupArgs,
    #[command(flatten)]
    pub(crate) options: IndexOptions,
    /// The index file to write
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: PathBuf,
}

impl BuildArgs {
    /// The setup that the arguments ask for.
    pub(crate) fn setup(&self) -> Result<Setup, Failure> {
        let mut setup = self.setup.without_options()?;
        self.options.choose(&mut setup.engine)?;
        setup.check()?;
        Ok(setup)
    }
}
