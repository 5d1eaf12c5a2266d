//! The arguments of `mediant build`.

use std::path::PathBuf;

use clap::Args;

use super::{
    map::MapArgs,
    options::IndexOptions,
    setup::{Asked, SetupArgs},
};
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
    /// The engine, its options and the motion of the arguments.
    pub(crate) fn asked(&self) -> Result<Asked, Failure> {
        self.setup.asked(self.options.given(), None)
    }
}
