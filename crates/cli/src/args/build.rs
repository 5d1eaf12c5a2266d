//! The arguments of `mediant build`.

use std::path::PathBuf;

use clap::Args;
use mediant::Setup;

use super::{map::MapArgs, options::IndexOptions, setup::SetupArgs};
use crate::failure::Failure;

#[derive(Args, Debug)]
pub(crate) struct BuildArgs {
    #[command(flatten)]
    pub(crate) map: MapArgs,
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
