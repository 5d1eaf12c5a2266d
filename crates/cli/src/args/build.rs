//! The arguments of `mediant build`.

use std::path::PathBuf;

use clap::Args;

use super::{
    costs::CostsArgs,
    flags::{ENGINE, Flags, INDEX_OPTIONS, MOTION},
    map::MapArgs,
};

#[derive(Args, Debug)]
pub(crate) struct BuildArgs {
    #[command(flatten)]
    pub(crate) map: MapArgs,
    #[command(flatten)]
    pub(crate) costs: CostsArgs,
    #[command(flatten)]
    pub(crate) flags: Flags<{ MOTION | ENGINE | INDEX_OPTIONS }>,
    /// The index file to write
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: PathBuf,
}
