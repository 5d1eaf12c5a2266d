//! The arguments of `mediant demo`.

use clap::Args;

#[derive(Args, Debug)]
pub(crate) struct DemoArgs {
    /// The bundled map: archipelago, cave, maze or town
    #[arg(default_value = "archipelago")]
    pub(crate) name: String,
}
